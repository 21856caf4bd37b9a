// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/node_rows.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/core/random.hpp>

using namespace clast;
using namespace clast::boundaries;

namespace {

cylinder_settings sizes(int rings, int around) {
    cylinder_settings s;
    s.radius = 0.06, s.bottom = -0.14, s.top = 0.14;
    s.rings = rings, s.tiles_per_ring = around;
    s.smallest_radius = 0.003;
    s.largest_gap = 0.01;
    s.contact_stiffness_floor = 2e6;
    return s;
}

/// A surface whose nodes can be put somewhere.
struct movable : node_rows<> {
    explicit movable(const cylinder_settings& s) : node_rows<>(s.rings, checked(s)) {}
    double& node(int j) { return apothem_[static_cast<std::size_t>(j)]; }
    void speed(int j, double v) {
        velocity_[static_cast<std::size_t>(j)] = v;
        lateral_speed_ = std::max(lateral_speed_, std::abs(v));
    }
    std::array<double, 2>& closing() { return platens_.velocity; }
    void moved() { advance(0.0); }
};

double between(random_stream& random, double low, double high) { return low + (high - low) * uniform01(random); }

/// Nodes up to `by` metres nearer to or further from the axis.
movable crumpled(const cylinder_settings& s, double by, std::uint64_t seed) {
    movable wall(s);
    random_stream random{seed, 0};
    for (int j = 0; j < s.rings * s.tiles_per_ring; ++j) wall.node(j) += by * between(random, -1.0, 1.0);
    wall.moved();
    return wall;
}

double energy(const node_rows<>& wall, const vec3& x, double r) { return 0.5 * norm2(lateral_push(wall.touch(x, r))); }

/// A place near the surface, many of them in touch with it, half of them near the nodes of ten columns, in valleys.
vec3 place(random_stream& random) {
    double angle = between(random, 0.0, 2.0 * std::numbers::pi);
    if (uniform01(random) < 0.5)
        angle = std::numbers::pi / 5 * (std::floor(angle * 5 / std::numbers::pi) + 0.5) + 0.003 * angle;
    const double rho = between(random, 0.053, 0.0575);
    return {rho * std::cos(angle), rho * std::sin(angle), between(random, -0.136, 0.136)};
}

} // namespace

TEST_CASE("nodes at one radius make the prism of solid strips", "[boundaries]") {
    const cylinder_settings s = sizes(14, 10);
    const tiles wall(s);
    const solid_strips strips(s);
    CHECK(wall.volume() == Approx(strips.volume()).epsilon(1e-13));
    CHECK(wall.end_section(0) == Approx(strips.section()).epsilon(1e-13));
    CHECK(wall.radius() == Approx(0.06).epsilon(1e-14));
    double lateral = 0.0;
    for (int f = 2; f < wall.facet_count(); ++f) {
        CHECK(wall.area(f) == Approx(wall.area(2)).epsilon(1e-12)); // each row and column the same
        lateral += wall.area(f);
    }
    // p dV/dR for all nodes together: the faces' areas times how far each goes
    CHECK(lateral * std::cos(std::numbers::pi / 10) ==
          Approx(10 * regular_width(10, 0.06) * 0.28 * std::pow(std::cos(std::numbers::pi / 10), 2)).epsilon(1e-12));
    random_stream random{3, 0};
    int touched = 0;
    for (int k = 0; k < 4000; ++k) {
        const vec3 x = place(random);
        const double r = between(random, 0.003, 0.007);
        const vec3 one = lateral_push(wall.touch(x, r)), other = lateral_push(strips.touch(x, r));
        CHECK(norm(one - other) <= 1e-12 * r);
        if (norm(one) > 0.0) ++touched;
    }
    CHECK(touched > 800);
}

TEST_CASE("the area of a node is the derivative of the volume", "[boundaries]") {
    for (const int rings : {1, 2, 7}) {
        movable wall = crumpled(sizes(rings, 9), 0.004, 11);
        for (int j = 0; j < rings * 9; j += 4) {
            const double h = 1e-5, at = wall.node(j), area = wall.area(2 + j);
            wall.node(j) = at + h, wall.moved();
            const double more = wall.volume();
            wall.node(j) = at - h, wall.moved();
            const double less = wall.volume();
            wall.node(j) = at, wall.moved();
            CHECK(area == Approx((more - less) / (2.0 * h)).epsilon(1e-9)); // the volume is of second degree in a node
        }
    }
}

TEST_CASE("the volume of crumpled nodes is that of the tetrahedra under their triangles", "[boundaries]") {
    const int rings = 5, around = 8;
    movable wall = crumpled(sizes(rings, around), 0.005, 4);
    const auto at = [&](int k, int i) {
        const double angle = 2.0 * std::numbers::pi * (i + 0.5) / around,
                     radius = wall.node_radius(2 + k * around + i % around);
        return vec3{radius * std::cos(angle), radius * std::sin(angle), -0.14 + 0.28 * (k + 0.5) / rings};
    };
    const auto tetrahedron = [](const vec3& a, const vec3& b, const vec3& c) { return dot(a, cross(b, c)) / 6.0; };
    double volume = 0.0;
    for (int i = 0; i < around; ++i) {
        for (int k = 0; k + 1 < rings; ++k) {
            const std::array<vec3, 4> c{at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)};
            const vec3 m = 0.25 * (c[0] + c[1] + c[2] + c[3]);
            for (std::size_t t = 0; t < 4; ++t) volume += tetrahedron(c[t], c[(t + 1) % 4], m);
        }
        for (const int k : {0, rings - 1}) {
            vec3 a = at(k, i), b = at(k, i + 1), c = a, d = b;
            const vec3 centre{0, 0, k == 0 ? -0.14 : 0.14};
            c.z = d.z = centre.z;
            if (k > 0) std::swap(a, c), std::swap(b, d);
            volume += tetrahedron(c, d, b) + tetrahedron(c, b, a) +
                      (k == 0 ? tetrahedron(centre, d, c) : tetrahedron(centre, a, b));
        }
    }
    CHECK(wall.volume() == Approx(volume).epsilon(1e-12));
}

TEST_CASE("what a node is loaded with is the derivative of the energy, wherever a sphere is", "[boundaries]") {
    movable wall = crumpled(sizes(7, 10), 0.002, 21);
    random_stream random{5, 0};
    int several = 0, nodes = 0;
    for (int k = 0; k < 3000; ++k) {
        const vec3 x = place(random);
        const double r = between(random, 0.003, 0.007);
        const touches t = wall.touch(x, r);
        if (t.size == 0 || norm(lateral_push(t)) > 0.5 * r) continue; // deeper, several ways may be the shortest
        std::vector<double> load(70, 0.0);
        std::vector<vec3> normals;
        for (const touch& one : t) {
            if (one.at_platen()) continue;
            load[static_cast<std::size_t>(one.facet - 2)] += one.depth * one.along; // k = 1
            if (normals.empty() || !(normals.back() == one.normal)) normals.push_back(one.normal);
        }
        if (normals.size() > 1) ++several;
        const vec3 u = lateral_push(t);
        const double h = 1e-7;
        vec3 slope;
        for (int a = 0; a < 3; ++a) {
            vec3 d;
            d[a] = h;
            slope[a] = (energy(wall, x + d, r) - energy(wall, x - d, r)) / (2.0 * h);
        }
        CHECK(norm(u + slope) <= 2e-6 * r); // F = -dU/dx
        for (int j = 0; j < 70; ++j) {
            if (load[static_cast<std::size_t>(j)] == 0.0) continue;
            ++nodes;
            const double was = wall.node(j);
            wall.node(j) = was - h, wall.moved();
            const double in = energy(wall, x, r);
            wall.node(j) = was + h, wall.moved();
            const double out = energy(wall, x, r);
            wall.node(j) = was, wall.moved();
            CHECK(load[static_cast<std::size_t>(j)] == Approx((in - out) / (2.0 * h)).margin(2e-6 * r));
        }
    }
    CHECK(several > 30);
    CHECK(nodes > 400);
}

TEST_CASE("a sphere that goes round returns the work that it took", "[boundaries]") {
    const movable wall = crumpled(sizes(7, 10), 0.003, 8);
    const double r = 0.006;
    // a closed path over plates, edges, corners and the vertical ends
    const auto at = [](double s) {
        const double a = 2.0 * std::numbers::pi * s, rho = 0.0535 + 0.001 * std::sin(5 * a);
        return vec3{rho * std::cos(2 * a), rho * std::sin(2 * a), 0.13 * std::sin(3 * a)};
    };
    const auto velocity = [](double s) {
        const double w = 2.0 * std::numbers::pi, a = w * s, rho = 0.0535 + 0.001 * std::sin(5 * a);
        const double rise = 0.005 * std::cos(5 * a);
        return w * vec3{rise * std::cos(2 * a) - 2.0 * rho * std::sin(2 * a),
                        rise * std::sin(2 * a) + 2.0 * rho * std::cos(2 * a), 0.39 * std::cos(3 * a)};
    };
    const auto power = [&](double s) { return dot(lateral_push(wall.touch(at(s), r)), velocity(s)); };
    // Simpson's rule, halved where it does not agree with itself: the force has kinks where plates come and go
    const auto work = [&](auto&& self, double s, double e, double f, double g, double h, double error) -> double {
        const double m = 0.5 * (s + e), fg = power(0.5 * (s + m)), gh = power(0.5 * (m + e));
        const double whole = (e - s) * (f + 4.0 * g + h) / 6.0;
        const double one = (m - s) * (f + 4.0 * fg + g) / 6.0, two = (e - m) * (g + 4.0 * gh + h) / 6.0;
        if (std::abs(whole - (one + two)) < error || e - s < 1e-12) return one + two;
        return self(self, s, m, f, fg, g, error) + self(self, m, e, g, gh, h, error);
    };
    double sum = 0.0, went = 0.0, highest = 0.0;
    const int pieces = 4000;
    for (int k = 0; k < pieces; ++k) {
        const double s = static_cast<double>(k) / pieces, e = static_cast<double>(k + 1) / pieces;
        const double here = work(work, s, e, power(s), power(0.5 * (s + e)), power(e), 1e-20);
        sum += here, went += std::abs(here);
        highest = std::max(highest, energy(wall, at(s), r));
    }
    INFO("sum " << sum << ", went through " << went << ", highest " << highest);
    REQUIRE(went > 3.0 * highest);
    CHECK(std::abs(sum) < 1e-9 * went);
}

TEST_CASE("a sphere whose centre got out is pushed back in", "[boundaries]") {
    const movable wall = crumpled(sizes(7, 10), 0.003, 30);
    random_stream random{9, 0};
    for (int k = 0; k < 3000; ++k) {
        const double angle = between(random, 0.0, 2.0 * std::numbers::pi), z = between(random, -0.13, 0.13), r = 0.006;
        vec3 x{std::cos(angle), std::sin(angle), 0.0};
        double rho = 0.05;
        const auto out = [&] { // beyond the surface by less than r
            vec3 y = rho * x;
            y.z = z;
            return y;
        };
        while (norm(lateral_push(wall.touch(out(), r))) < 1.3 * r) rho += 1e-4;
        const vec3 u = lateral_push(wall.touch(out(), r));
        INFO("angle " << angle << ", z " << z << ", rho " << rho);
        CHECK(u.x * x.x + u.y * x.y < -0.7 * norm(u));                  // inward
        CHECK(norm(lateral_push(wall.touch(out() + u, r))) < 5e-3 * r); // so deep the way is found to less than that
        CHECK_FALSE(wall.outside(out(), r));
        CHECK(wall.outside(out() + (1.3 * r) * x, r));
        if (k % 100 != 0) continue;
        CHECK(wall.near(out(), r));
    }
}

TEST_CASE("nothing that touches is missed by near, and what will touch is seen ahead", "[boundaries]") {
    movable wall = crumpled(sizes(7, 10), 0.003, 17);
    random_stream random{2, 0};
    for (int j = 0; j < 70; ++j) wall.speed(j, between(random, -0.5, 0.5));
    wall.closing() = {0.1, 0.1};
    movable later = wall;
    later.advance(1e-3);
    int touched = 0;
    for (int k = 0; k < 3000; ++k) {
        const vec3 x = place(random);
        const double r = between(random, 0.003, 0.007);
        if (wall.touch(x, r).size > 0) CHECK(wall.near(x, r));
        const touches now = later.touch(x, r);
        const touches ahead = wall.touch(x, r, 1e-3);
        const vec3 one = lateral_push(now), other = lateral_push(ahead);
        CHECK(norm(one - other) <= 1e-10 * r);
        touched += now.size > 0 ? 1 : 0;
    }
    CHECK(touched > 500);
}

TEST_CASE("the power of a wall is force times velocity of its points", "[boundaries]") {
    movable wall = crumpled(sizes(7, 10), 0.003, 23);
    random_stream random{6, 0};
    for (int j = 0; j < 70; ++j) wall.speed(j, between(random, -0.5, 0.5));
    wall.closing() = {0.3, 0.2};
    const double h = 1e-7;
    movable before = wall, after = wall;
    before.advance(-h), after.advance(h);
    for (int k = 0; k < 300; ++k) {
        const vec3 x = place(random);
        const double r = between(random, 0.003, 0.007);
        std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
        for (const touch& t : wall.touch(x, r))
            if (!t.at_platen()) loads[static_cast<std::size_t>(t.facet)].add(t, t.depth, 1.0);
        const double power = (energy(after, x, r) - energy(before, x, r)) / (2.0 * h);
        CHECK(wall.power(loads) == Approx(power).margin(1e-6 * r));
    }
}

TEST_CASE("a stretched sheet squeezes a cylinder like a hoop, p = E t strain / R, and never pushes", "[boundaries]") {
    cylinder_settings s = sizes(14, 20);
    s.stretching = 3000.0;
    movable wall(s);
    const double at_start = wall.node_radius(2);
    for (const double strain : {0.05, 0.2}) {
        for (int j = 0; j < 280; ++j) wall.node(j) = at_start * (1.0 + strain);
        wall.moved();
        for (int f = 2; f < wall.facet_count(); ++f)
            CHECK(wall.stretching_force(f) / wall.area(f) ==
                  Approx(3000.0 * strain / (0.06 * (1.0 + strain))).epsilon(1e-12));
        CHECK(wall.stretching_energy() ==
              Approx(0.5 * 3000.0 * strain * strain * 0.28 * 40.0 * 0.06 * std::tan(std::numbers::pi / 20))
                  .epsilon(1e-12));
    }
    for (int j = 0; j < 280; ++j) wall.node(j) = 0.9 * at_start;
    wall.moved();
    for (int f = 2; f < wall.facet_count(); ++f) CHECK(wall.stretching_force(f) == 0.0);
    CHECK(wall.stretching_energy() == 0.0);
    CHECK_THROWS_AS(checked([&] {
                        s.stretching = -1.0;
                        return s;
                    }()),
                    input_error);
}

TEST_CASE("what a stretched sheet exerts is the derivative of its energy, whatever its shape", "[boundaries]") {
    cylinder_settings s = sizes(14, 10);
    s.stretching = 3000.0;
    movable wall = crumpled(s, 0.006, 11);
    const double step = 1e-7;
    for (const int j : {0, 5, 47, 63, 77, 100, 139}) {
        const double force = wall.stretching_force(j + 2);
        wall.node(j) += step, wall.moved();
        const double more = wall.stretching_energy();
        wall.node(j) -= 2.0 * step, wall.moved();
        const double less = wall.stretching_energy();
        wall.node(j) += step, wall.moved();
        CHECK(force == Approx((more - less) / (2.0 * step)).epsilon(1e-5).margin(1e-3));
    }
}
