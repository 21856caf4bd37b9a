// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/ring_walls.hpp>

using namespace clast::boundaries;

TEST_CASE("ring walls move ring by ring and stop before a pebble could slip between two rings", "[boundaries]") {
    cylinder_settings s;
    s.radius = 0.15;
    s.top = 0.7;
    s.rings = 5;
    s.smallest_radius = 2e-3;
    s.contact_stiffness_floor = 2e6;
    ring_walls wall(s);
    std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    drives d;
    d.lateral = {drive::mode::servo, 1e6, 0.02, 0.5};
    for (int n = 0; n < 600; ++n) {
        double area = 0.0;
        for (int f = 2; f < wall.facet_count(); ++f) {
            loads[static_cast<std::size_t>(f)] = {1e6 * wall.area(f), 5e6, 3};
            if (f >= 42 && f < 62) area += wall.area(f);
        }
        loads[50].force += 0.5e6 * area; // one strip of the middle ring is pushed: the whole ring gives way
        wall.control(loads, d, 1e-3);
        if (n == 0) {
            for (int f = 42; f < 62; ++f) CHECK(wall.velocity(f) == -0.02);
            CHECK(std::abs(wall.velocity(41)) < 1e-9);
            CHECK(std::abs(wall.velocity(62)) < 1e-9);
        }
        wall.advance(1e-3);
    }
    for (int f = 42; f < 62; ++f) CHECK(wall.apothem(f) == wall.apothem(42));
    CHECK(wall.apothem(42) == Approx(0.154).margin(2.1e-5));
    CHECK(wall.counters().latched_pairs == 2);
}
