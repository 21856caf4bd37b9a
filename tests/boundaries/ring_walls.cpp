// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/ring_walls.hpp>

using namespace clast::boundaries;

TEST_CASE("ring walls move ring by ring, and share what would bend them by more than their slope", "[boundaries]") {
    cylinder_settings s;
    s.radius = 0.15;
    s.top = 0.7;
    s.rings = 5;
    s.smallest_radius = 2e-3;
    s.largest_radius = 0.4;
    s.contact_stiffness_floor = 2e6;
    s.bending = 0.0;
    ring_walls wall(s);
    const double regular = 0.15 / std::cos(std::numbers::pi / 20);
    std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    drives d;
    d.lateral = {drive::mode::servo, 1e6, 0.02, 0.5};
    for (int n = 0; n < 7000; ++n) {
        double area = 0.0;
        for (int f = 2; f < wall.facet_count(); ++f) {
            loads[static_cast<std::size_t>(f)] = {1e6 * wall.area(f), 5e6, 3};
            if (f >= 42 && f < 62) area += wall.area(f);
        }
        loads[50].force += 0.5e6 * area; // one node of the middle ring is pushed: the whole ring gives way
        wall.control(loads, d, 1e-3);
        if (n == 0) {
            for (int f = 42; f < 62; ++f) CHECK(wall.velocity(f) == -0.02);
            CHECK(std::abs(wall.velocity(41)) < 1e-9);
            CHECK(std::abs(wall.velocity(62)) < 1e-9);
        }
        wall.advance(1e-3);
        if (n == 5000) {
            CHECK(wall.node_radius(42) == Approx(regular + 0.1).epsilon(1e-3));
            CHECK(wall.node_radius(2) == Approx(regular).epsilon(1e-9));
        }
    }
    for (int f = 42; f < 62; ++f) CHECK(wall.node_radius(f) == wall.node_radius(42));
    // rings stand 140 mm apart, and take along their neighbours at 0.9 of that
    CHECK(wall.node_radius(42) - wall.node_radius(22) == Approx(0.126).epsilon(2e-3));
    CHECK(wall.node_radius(42) - wall.node_radius(62) == Approx(0.126).epsilon(2e-3));
    CHECK(wall.node_radius(22) > regular + 1e-3);
    CHECK(wall.counters().latched_pairs == 2);
}
