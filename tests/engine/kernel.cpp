// SPDX-License-Identifier: MIT
#include <clast/engine/kernel.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <random>
#include <type_traits>
#include <vector>

#include <clast/contacts/linear.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

using linear = contacts::linear;
using list_type = contact_list<linear::history>;

/// Pairs of touching and of nearly touching pebbles, all moving and spinning, some with a shear force already.
struct scene {
    std::vector<pebble_motion> pebbles;
    list_type list;
    linear law{2e6, 1e6, 0.3};

    explicit scene(std::size_t n) {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        const auto any = [&](double size) { return vec3{size * u(random), size * u(random), size * u(random)}; };
        for (std::size_t k = 0; k < n; ++k) {
            const vec3 c = any(1.0), d = unit(any(1.0));
            const double r = 0.01 * (1.0 + 0.3 * u(random)), s = 0.01 * (1.0 + 0.3 * u(random));
            const double gap = 1e-4 * u(random); // about half of them touch
            pebbles.push_back({c, r, any(0.5), 1.0, any(20.0), 1.0});
            pebbles.push_back({c + (r + s + gap) * d, s, any(0.5), 1.0, any(20.0), 1.0});
            const auto first = static_cast<std::int32_t>(2 * k);
            list.pairs.push_back({first, first + 1});
        }
        list.resize();
        list.rows.resize(n);
        for (std::size_t k = 0; k < n; k += 3) {
            const vec3 f = reject(any(40.0), unit(pebbles[2 * k + 1].x - pebbles[2 * k].x));
            list.history[k] = {f.x, f.y, f.z};
        }
    }
};

using work_strip = strip<linear, sphere_view>;

/// Contacts [begin, end) of a scene by strips, rows kept.
template <class Adjust> void evaluate_all(scene& s, std::size_t begin, std::size_t end, Adjust&& adjust) {
    work_strip work;
    for (std::size_t at = begin; at < end; at += work_strip::length) {
        evaluate(work, s.list, at, std::min(end, at + work_strip::length), sphere_view{s.pebbles.data()}, s.law, 1e-5,
                 adjust);
        keep_rows(work, s.list, at);
    }
}
void evaluate_all(scene& s, std::size_t begin, std::size_t end) {
    evaluate_all(s, begin, end, [](work_strip&, std::size_t) {});
}

bool same_bits(const list_type& a, const list_type& b) {
    return std::memcmp(a.rows.data(), b.rows.data(), a.size() * sizeof(force_row)) == 0 &&
           std::memcmp(a.history.data(), b.history.data(), a.size() * sizeof(linear::history)) == 0;
}

} // namespace

TEST_CASE("a strip answers every contact as the law does alone, and open pairs exert nothing") {
    scene s(200);
    const list_type before = s.list;
    const double h = 1e-5;
    evaluate_all(s, 0, s.list.size());
    std::size_t touching = 0, sheared = 0;
    double worst = 0.0;
    for (std::size_t k = 0; k < s.list.size(); ++k) {
        const pebble_motion& a = s.pebbles[2 * k];
        const pebble_motion& b = s.pebbles[2 * k + 1];
        const force_row& row = s.list.rows[k];
        // the same from textbook formulas: velocities of the two surfaces at the middle of the overlap
        const double distance = norm(b.x - a.x), depth = a.radius + b.radius - distance;
        const vec3 n = unit(b.x - a.x);
        if (depth <= 0.0) {
            CHECK(row.depth == 0.0);
            CHECK(row.force == vec3{});
            CHECK(s.list.history[k].x == 0.0);
            continue;
        }
        ++touching;
        const vec3 at = a.x + (a.radius - 0.5 * depth) * n;
        const vec3 slip = a.v + cross(a.w, at - a.x) - b.v - cross(b.w, at - b.x);
        const vec3 middle = unit(b.x - a.x - 0.5 * h * (b.v - a.v));
        const vec3 u = h * reject(slip, middle);
        linear::history history = before.history[k];
        const auto answer = s.law(contacts::overlap<double>{n.x, n.y, n.z, depth, a.radius, b.radius},
                                  contacts::motion<double>{u.x, u.y, u.z, 0.5 * h * dot(a.w + b.w, n), dot(slip, n),
                                                           middle.x, middle.y, middle.z, 2.0},
                                  history, h);
        worst = std::max(worst, norm(row.force - vec3{answer.fx, answer.fy, answer.fz}) / norm(row.force));
        worst = std::max(worst, std::abs(row.dissipated - answer.dissipated) * 1e3);
        worst = std::max(worst, norm(row.normal - n));
        worst = std::max(worst, std::abs(row.depth - depth) / distance);
        worst = std::max(worst, std::abs(s.list.history[k].y - history.y) / 100.0);
        sheared += row.dissipated > 0.0;
    }
    CHECK(touching > 60);
    CHECK(touching < 140);
    CHECK(sheared > 20);
    CHECK(worst < 1e-10); // u is a small difference
}

TEST_CASE("where a list is cut into strips does not change a bit") {
    scene whole(200), parts(200);
    evaluate_all(whole, 0, 200);
    for (std::size_t begin = 0, n = 1; begin < 200; begin += n, n = n * 2 + 1)
        evaluate_all(parts, begin, std::min<std::size_t>(200, begin + n));
    CHECK(same_bits(whole.list, parts.list));
    evaluate_all(parts, 3, 4);
    CHECK_FALSE(same_bits(whole.list, parts.list)); // the comparison sees a single contact
}

TEST_CASE("pebbles can be taken elsewhere, as an image in a periodic cell") {
    scene near(20), far(20);
    const vec3 edge{3.0, -2.0, 0.5}, speed{0.1, 0.0, -0.3};
    for (std::size_t k = 1; k < far.pebbles.size(); k += 2) far.pebbles[k].x -= edge, far.pebbles[k].v -= speed;
    evaluate_all(near, 0, 20);
    evaluate_all(far, 0, 20, [&](work_strip& s, std::size_t) {
        for (std::size_t k = 0; k < s.size; ++k) {
            s.dx[k] += edge.x, s.dy[k] += edge.y, s.dz[k] += edge.z;
            s.vx[k] += speed.x, s.vy[k] += speed.y, s.vz[k] += speed.z;
        }
    });
    for (std::size_t k = 0; k < 20; ++k)
        CHECK(norm(near.list.rows[k].force - far.list.rows[k].force) <= 1e-8 * norm(near.list.rows[k].force));
}

TEST_CASE("loads of both bodies are the row's force and its moments about their centres") {
    scene s(70); // a whole strip and a part of one
    // every pebble belongs to a body whose centre is elsewhere, and moves with it
    std::vector<clump_pebble> pebbles;
    std::vector<body_motion> bodies;
    std::vector<std::int32_t> owner;
    for (std::size_t p = 0; p < s.pebbles.size(); ++p) {
        const double u = static_cast<double>(p);
        const vec3 arm{0.01 * std::sin(u), 0.02 * std::cos(3.0 * u), -0.01 * std::sin(2.0 * u)};
        const pebble_motion& one = s.pebbles[p];
        pebbles.push_back({one.x, one.radius});
        bodies.emplace_back(one.x - arm, one.v - cross(one.w, arm), one.w);
        owner.push_back(static_cast<std::int32_t>(s.pebbles.size() - 1 - p));
    }
    std::reverse(bodies.begin(), bodies.end());
    const clump_view clumps{pebbles.data(), owner.data(), bodies.data()};
    const auto centre = [&](std::size_t p) { return bodies[static_cast<std::size_t>(owner[p])].x; };
    scene alone = s; // the same contacts of pebbles that are bodies themselves
    evaluate_all(alone, 0, 70);
    strip<linear, clump_view> work;
    std::size_t touching = 0, booked = 0;
    for (std::size_t begin = 0; begin < 70; begin += 64) {
        const std::size_t end = std::min<std::size_t>(70, begin + 64);
        evaluate(work, s.list, begin, end, clumps, s.law, 1e-5, [](auto&, std::size_t) {});
        keep_rows(work, s.list, begin);
        std::size_t next = 0;
        each_load(work, [&](std::size_t k, const contact_load& load) {
            CHECK(k == next++);
            const force_row& row = s.list.rows[begin + k];
            CHECK(norm(row.force - alone.list.rows[begin + k].force) <= 1e-9 * norm(row.force));
            const std::size_t i = 2 * (begin + k), j = i + 1;
            const vec3 at = pebbles[i].x + (pebbles[i].radius - 0.5 * row.depth) * row.normal;
            body_load a, b;
            load.add_to_i(a), load.add_to_j(b);
            const auto is = [](const quad& v, const vec3& w) {
                return norm(vec3{v[0], v[1], v[2]} - w) <= 1e-12 * (norm(w) + 1e-9);
            };
            CHECK(is(a.force, row.force));
            CHECK(is(b.force, -row.force));
            CHECK(norm(vec3{a.moment[0], a.moment[1], a.moment[2]} - cross(at - centre(i), row.force)) <=
                  1e-12 * norm(row.force));
            CHECK(norm(vec3{b.moment[0], b.moment[1], b.moment[2]} + cross(at - centre(j), row.force)) <=
                  1e-12 * norm(row.force));
            CHECK(a.moment[3] == row.dissipated);
            CHECK(b.moment[3] == 0.0);
            touching += row.depth > 0.0, booked += row.dissipated > 0.0;
        });
        CHECK(next == end - begin);
    }
    CHECK(touching > 20);
    CHECK(booked > 5);
}
