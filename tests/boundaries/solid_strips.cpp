// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/solid_strips.hpp>

using namespace clast::boundaries;

TEST_CASE("solid strips move as one and enclose the analytic volume", "[boundaries]") {
    cylinder_settings s;
    s.radius = 0.15;
    s.top = 0.7;
    s.smallest_radius = 2e-3;
    s.contact_stiffness_floor = 2e6;
    solid_strips wall(s);
    CHECK(wall.facet_count() == 22);
    std::vector<facet_load> loads(22);
    // one strip carries the force that all should share: nothing moves
    double area = 0.0;
    for (int f = 2; f < 22; ++f) area += wall.area(f);
    CHECK(area == Approx(20 * 0.3 * std::tan(std::numbers::pi / 20) * 0.7).epsilon(1e-12));
    loads[9] = {1e6 * area, 5e6, 3};
    drives d;
    d.lateral = {drive::mode::servo, 1e6, 1.0, 0.5};
    wall.control(loads, d, 1e-5);
    CHECK(wall.fastest() < 1e-9);
    CHECK(wall.confining_error(loads, 1e6) < 1e-12);
    CHECK(wall.confining_rms(loads, 1e6) < 1e-12);
    // then it carries 10 N more: all strips give way by gain * 10 N / K
    loads[9].force += 10.0;
    wall.control(loads, d, 1e-5);
    for (int f = 2; f < 22; ++f) CHECK(wall.velocity(f) == Approx(-0.5 * 10.0 / 5e6 / 1e-5).epsilon(1e-6));
    d.lateral = {drive::mode::velocity, 0.01, 0.0, 0.5};
    d.platens = {drive::mode::velocity, 0.02, 0.0, 0.5};
    wall.control(loads, d, 1e-5);
    wall.advance(0.5);
    const double apothem = 0.145;
    CHECK(wall.height() == Approx(0.68).epsilon(1e-14));
    CHECK(wall.volume() == Approx(20 * apothem * apothem * std::tan(std::numbers::pi / 20) * 0.68).epsilon(1e-12));
}
