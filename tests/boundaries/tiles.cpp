// SPDX-License-Identifier: MIT
// How joined tiles are driven; where they are and what they touch is seen in node_rows.cpp.
#include <algorithm>
#include <cmath>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/tiles.hpp>
#include <clast/core/random.hpp>

using namespace clast;
using namespace clast::boundaries;

namespace {

constexpr double sigma = 2e6;

cylinder_settings sizes(double bending, double stretching = 0.0) {
    cylinder_settings s;
    s.radius = 0.06, s.bottom = -0.14, s.top = 0.14;
    s.rings = 14, s.tiles_per_ring = 10;
    s.smallest_radius = 0.003;
    s.contact_stiffness_floor = 2e6;
    s.bending = bending;
    s.stretching = stretching;
    return s;
}

/// A wall around a bed of springs, one behind each node, after so many steps: what each pushes back with.
struct bed {
    tiles wall;
    std::vector<double> rest, stiffness; // radius without load (m), N/m
    std::vector<facet_load> loads;

    explicit bed(double bending, double stretching = 0.0)
        : wall(sizes(bending, stretching)), rest(140), stiffness(140),
          loads(static_cast<std::size_t>(wall.facet_count())) {
        random_stream random{7, 0};
        for (std::size_t j = 0; j < rest.size(); ++j)
            rest[j] = 0.062 + 0.003 * uniform01(random), stiffness[j] = 2e6 * (1.0 + 3.0 * uniform01(random));
    }
    void look() {
        for (std::size_t j = 0; j < rest.size(); ++j) {
            const double depth = std::max(0.0, rest[j] - wall.node_radius(static_cast<int>(j) + 2));
            loads[j + 2] = {stiffness[j] * depth, depth > 0.0 ? stiffness[j] : 0.0, depth > 0.0 ? 1 : 0};
        }
    }
    void go(int steps) {
        drives d;
        d.lateral = {drive::mode::servo, sigma, 0.5, 0.5};
        for (int n = 0; n < steps; ++n) {
            look();
            wall.control(loads, d, 1e-5);
            wall.advance(1e-5);
        }
        look();
    }
    /// Sum over a column of the sizes of its kinks, relative to the springs' own.
    double roughness() const {
        double sum = 0.0;
        for (int k = 1; k < 13; ++k)
            for (int i = 0; i < 10; ++i) {
                const int f = 2 + 10 * k + i;
                const double kink = wall.node_radius(f - 10) - 2.0 * wall.node_radius(f) + wall.node_radius(f + 10);
                sum += kink * kink;
            }
        return std::sqrt(sum / 120);
    }
};

} // namespace

TEST_CASE("without bending stiffness every node comes to carry the pressure on its area", "[boundaries]") {
    bed b(0.0);
    b.go(3000);
    for (int f = 2; f < b.wall.facet_count(); ++f)
        CHECK(b.loads[static_cast<std::size_t>(f)].force == Approx(sigma * b.wall.area(f)).epsilon(1e-6));
    CHECK(b.wall.confining_rms(b.loads, sigma) < 1e-6);
}

TEST_CASE("bending stiffness smooths the wall and leaves the sum of its loads what it was", "[boundaries]") {
    bed soft(0.0), stiff(3.0);
    soft.go(3000), stiff.go(20000);
    CHECK(stiff.wall.confining_error(stiff.loads, sigma) < 1e-6);
    CHECK(stiff.wall.confining_rms(stiff.loads, sigma) > 0.05); // not each node's
    CHECK(stiff.roughness() < 0.8 * soft.roughness());
}

TEST_CASE("a node that finds nothing behind it is held by its neighbours", "[boundaries]") {
    bed b(3.0);
    const std::size_t hole = 65;
    b.rest[hole] = 0.0; // no spring
    b.go(20000);
    const auto radius = [&](std::size_t j) { return b.wall.node_radius(static_cast<int>(j) + 2); };
    const double around = 0.25 * (radius(hole - 10) + radius(hole + 10) + radius(hole - 1) + radius(hole + 1));
    // the pressure on its area, 1.4 kN, against 3 sigma_3 times 20 mm of stiffness and more
    CHECK(around - radius(hole) > 0.2e-3);
    CHECK(around - radius(hole) < 5e-3);
    CHECK(b.wall.confining_error(b.loads, sigma) < 1e-6); // what it does not carry they do
}

TEST_CASE("grains in a stretched sheet carry its pull and the pressure of the cell, which is what the wall reads",
          "[boundaries]") {
    bed b(0.0, 1e6);
    b.go(6000);
    double pull = 0.0;
    for (int f = 2; f < b.wall.facet_count(); ++f) {
        pull += b.wall.stretching_force(f);
        CHECK(b.loads[static_cast<std::size_t>(f)].force ==
              Approx(sigma * b.wall.area(f) + b.wall.stretching_force(f)).epsilon(1e-5));
    }
    CHECK(pull > 1e4);
    CHECK(b.wall.lateral_stress(b.loads) == Approx(sigma).epsilon(1e-6));
    CHECK(b.wall.confining_error(b.loads, sigma) < 1e-6);
    CHECK(b.wall.confining_rms(b.loads, sigma) < 1e-5);
}

TEST_CASE("a wall of joined tiles goes where it is told, with its faces", "[boundaries]") {
    tiles wall(sizes(3.0));
    drives d;
    d.lateral = {drive::mode::velocity, 0.01};
    d.platens = {drive::mode::velocity, 0.02};
    const std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    for (int n = 0; n < 100; ++n) wall.control(loads, d, 1e-3), wall.advance(1e-3);
    CHECK(wall.radius() == Approx(0.059).epsilon(1e-12));
    CHECK(wall.height() == Approx(0.276).epsilon(1e-12));
    CHECK(wall.bottom() == Approx(-0.138).epsilon(1e-12));
    CHECK(wall.fastest() >= 0.02);
}

TEST_CASE("a wall that is torn stops the run", "[boundaries]") {
    tiles wall(sizes(0.0));
    drives d;
    d.lateral = {drive::mode::velocity, -1.0};
    const std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    const auto burst = [&] {
        for (int n = 0; n < 100; ++n) wall.control(loads, d, 1e-3), wall.advance(1e-3);
    };
    CHECK_THROWS_AS(burst(), run_error); // at 2.5 times its radius
    CHECK(wall.radius() == Approx(2.5 * 0.06).epsilon(0.02));
}
