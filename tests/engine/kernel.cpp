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

/// Keeps all rows; operands may be changed by `change`.
template <class F> struct row_job {
    list_type& list;
    F change;

    template <class Strip> void adjust(Strip& s, const contact_block& block) const { change(s, block); }
    template <class Width, class Strip> void take(Width, const Strip& s, const contact_block& block) const {
        keep_rows(s, block, list.rows.data());
    }
};

/// Contacts [begin, end) of a scene, rows kept.
template <class Adjust> void evaluate_all(scene& s, std::size_t begin, std::size_t end, Adjust&& adjust) {
    evaluate(s.list, {begin, end}, sphere_view{s.pebbles.data(), nullptr}, s.law, 1e-5,
             row_job<Adjust>{s.list, adjust});
}
void evaluate_all(scene& s, std::size_t begin, std::size_t end) {
    evaluate_all(s, begin, end, [](work_strip&, const contact_block&) {});
}

/// Keeps rows and loads.
struct load_job {
    list_type& list;
    std::vector<contact_load<>>& loads;
    std::vector<pebble_pair>& bodies;
    std::size_t next = 0; ///< row to come
    bool in_order = true;

    void adjust(strip<linear, clump_view>&, const contact_block&) const {}
    template <class Width>
    [[gnu::always_inline]] void take(Width width, const strip<linear, clump_view>& s, const contact_block& block) {
        keep_rows(s, block, list.rows.data());
        in_order = in_order && block.row == next;
        each_load(width, s, block, *this);
        next += block.size;
    }
    template <class Load>
    [[gnu::always_inline]] void operator()(std::size_t row, const pebble_pair& of, const Load& load) const {
        bodies[row] = of;
        load.store(loads[row]);
    }
};

bool same_bits(const list_type& a, const list_type& b) {
    return std::memcmp(a.rows.data(), b.rows.data(), a.size() * sizeof(force_row)) == 0 &&
           std::memcmp(a.history.data(), b.history.data(), a.size() * sizeof(linear::history)) == 0;
}

} // namespace

TEST_CASE("every contact is answered as by the law alone, and open pairs exert nothing") {
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
        const auto answer = s.law(contacts::overlap<double>{n.x, n.y, n.z, depth, 1.0 / a.radius, 1.0 / b.radius},
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

TEST_CASE("where a list is cut does not change a bit") {
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
    evaluate_all(far, 0, 20, [&](work_strip& s, const contact_block& block) {
        for (std::size_t k = block.at; k < block.at + block.size; ++k) {
            s.dx[k] += edge.x, s.dy[k] += edge.y, s.dz[k] += edge.z;
            s.vx[k] += speed.x, s.vy[k] += speed.y, s.vz[k] += speed.z;
        }
    });
    for (std::size_t k = 0; k < 20; ++k)
        CHECK(norm(near.list.rows[k].force - far.list.rows[k].force) <= 1e-8 * norm(near.list.rows[k].force));
}

TEST_CASE("loads of both bodies are the row's force and its moments about their centres") {
    scene s(70); // whole blocks and a part of one
    // every pebble belongs to a body whose centre is elsewhere, and moves with it
    std::vector<clump_pebble> pebbles;
    std::vector<body_motion> bodies;
    std::vector<std::int32_t> owner;
    for (std::size_t p = 0; p < s.pebbles.size(); ++p) {
        const double u = static_cast<double>(p);
        const vec3 arm{0.01 * std::sin(u), 0.02 * std::cos(3.0 * u), -0.01 * std::sin(2.0 * u)};
        const pebble_motion& one = s.pebbles[p];
        pebbles.push_back({one.x, one.radius});
        bodies.emplace_back(one.x - arm, one.v - cross(one.w, arm), one.w, one.inverse_mass);
        owner.push_back(static_cast<std::int32_t>(s.pebbles.size() - 1 - p));
    }
    std::reverse(bodies.begin(), bodies.end());
    const clump_view clumps{pebbles.data(), owner.data(), bodies.data(), nullptr};
    const auto centre = [&](std::size_t p) { return bodies[static_cast<std::size_t>(owner[p])].x; };
    scene alone = s; // the same contacts of pebbles that are bodies themselves
    evaluate_all(alone, 0, 70);
    std::vector<contact_load<>> loads(70);
    std::vector<pebble_pair> loaded(70);
    const load_job done = evaluate(s.list, {0, 70}, clumps, s.law, 1e-5, load_job{s.list, loads, loaded});
    CHECK(done.in_order);
    CHECK(done.next == 70);
    std::size_t touching = 0, booked = 0;
    for (std::size_t row = 0; row < 70; ++row) {
        const force_row& f = s.list.rows[row];
        CHECK(norm(f.force - alone.list.rows[row].force) <= 1e-9 * norm(f.force));
        const std::size_t i = 2 * row, j = i + 1;
        const vec3 at = pebbles[i].x + (pebbles[i].radius - 0.5 * f.depth) * f.normal;
        load_sum a, b;
        loads[row].add_to_i(a), loads[row].add_to_j(b);
        const auto is = [](const vec3& v, const vec3& w) { return norm(v - w) <= 1e-12 * (norm(w) + 1e-9); };
        CHECK(is(a.force, f.force));
        CHECK(is(b.force, -f.force));
        CHECK(norm(a.moment - cross(at - centre(i), f.force)) <= 1e-12 * norm(f.force));
        CHECK(norm(b.moment + cross(at - centre(j), f.force)) <= 1e-12 * norm(f.force));
        CHECK(a.dissipated == f.dissipated);
        CHECK(b.dissipated == 0.0);
        CHECK(loaded[row] == pebble_pair{owner[i], owner[j]});
        touching += f.depth > 0.0, booked += f.dissipated > 0.0;
    }
    CHECK(touching > 20);
    CHECK(booked > 5);
}

namespace {
/// Answers with what it is given, so that rows and loads show it.
struct told {
    struct history {};
    double at_distance = 0.0;

    contacts::wrench<double> operator()(const contacts::overlap<double>& o, const contacts::motion<double>& m, history&,
                                        double) const {
        return {{o.reduced_radius(), o.reduced_mass(), o.depth, 0.0}, m.rx, m.ry, m.rz};
    }
    double reach() const { return at_distance; }
    double stored(const contacts::overlap<double>&, const history&) const { return 0.0; }
    double normal_stiffness(const contacts::overlap<double>&) const { return 1.0; }
    double shear_stiffness(const contacts::overlap<double>&) const { return 0.0; }
};
struct told_job {
    contact_list<told::history>& list;
    std::vector<contact_load<>>& loads;
    void adjust(strip<told, sphere_view>&, const contact_block&) const {}
    template <class Width> void take(Width width, const strip<told, sphere_view>& s, const contact_block& block) {
        keep_rows(s, block, list.rows.data());
        each_load(width, s, block, *this);
    }
    template <class Load> void operator()(std::size_t row, const pebble_pair&, const Load& load) const {
        load.store(loads[row]);
    }
};
} // namespace

TEST_CASE("a law is given both curvatures and masses and the relative rotation, and may answer a moment") {
    std::vector<pebble_motion> pebbles(3);
    pebbles[0] = {{0, 0, 0}, 0.01, {}, 4.0, {1.0, 2.0, 3.0}, 0.0};
    pebbles[1] = {{0.0395, 0, 0}, 0.03, {}, 12.0, {0.0, -1.0, 0.5}, 0.0};
    pebbles[2] = {{0, 0.0201, 0}, 0.01, {}, 4.0, {}, 0.0}; // 0.1 mm apart from the first
    const double h = 1e-3;
    for (const double reach : {0.0, 2e-4}) {
        contact_list<told::history> list;
        list.pairs = {{0, 1}, {0, 2}};
        list.resize(), list.rows.resize(2);
        std::vector<contact_load<>> loads(2);
        evaluate(list, {0, 2}, sphere_view{pebbles.data(), nullptr}, told{reach}, h, told_job{list, loads});
        CHECK(list.rows[0].force.x == Approx(0.0075)); // 1 / (100 + 33.3)
        CHECK(list.rows[0].force.y == Approx(1.0 / 16.0));
        CHECK(list.rows[0].force.z == Approx(5e-4));
        // its own moment and that of the force, for i and j
        const vec3 own = h * vec3{1.0, 3.0, 2.5};
        const vec3 turn = cross({1, 0, 0}, list.rows[0].force);
        load_sum i, j;
        loads[0].add_to_i(i), loads[0].add_to_j(j);
        CHECK(norm(i.moment - (0.00975 * turn + own)) < 1e-15);
        CHECK(norm(j.moment - (0.02975 * turn - own)) < 1e-15);
        // beyond touch it acts as far as it says
        CHECK(list.rows[1].force.z == Approx(reach > 0.0 ? -1e-4 : 0.0).margin(1e-18));
        CHECK((list.rows[1].depth < 0.0) == (reach > 0.0));
    }
}

TEST_CASE("masses are gathered for laws that read them only") {
    static_assert(!strip<linear, sphere_view>::has_masses && strip<told, sphere_view>::has_masses);
    static_assert(sizeof(strip<linear, sphere_view>::mass_i) == sizeof(double));
    SUCCEED("checked at compile time");
}
