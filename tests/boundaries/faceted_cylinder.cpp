// SPDX-License-Identifier: MIT
// What tiles, rings and strips share beyond what their own tests see.
#include <clast/boundaries/faceted_cylinder.hpp>

#include <vector>

#include <catch.hpp>

#include <clast/boundaries/stepped_tiles.hpp>

namespace {

using namespace clast::boundaries;

cylinder_settings settings() {
    cylinder_settings s;
    s.radius = 0.05;
    s.bottom = -0.05;
    s.top = 0.05;
    s.rings = 5;
    s.tiles_per_ring = 12;
    s.smallest_radius = 0.002;
    s.contact_stiffness_floor = 2e6;
    return s;
}

/// Largest step between two tiles of a column, after the middle ring was loaded and the others were not.
double largest_step(double largest_gap) {
    cylinder_settings s = settings();
    s.largest_gap = largest_gap;
    stepped_tiles wall(s);
    drives d;
    d.lateral = {drive::mode::servo, 1e5, 0.02, 0.5};
    std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    for (int step = 0; step < 40000; ++step) {
        for (int i = 0; i < 12; ++i) {
            auto& held = loads[static_cast<std::size_t>(first_lateral_facet + 2 * 12 + i)];
            held = {2e5 * wall.area(first_lateral_facet + 2 * 12 + i), 1e7, 1}; // twice the target: moves out
        }
        wall.control(loads, d, 1e-5);
        wall.advance(1e-5);
        if (wall.apothem(first_lateral_facet) < 0.04) break;
    }
    return wall.apothem(first_lateral_facet + 2 * 12) - wall.apothem(first_lateral_facet + 1 * 12);
}

} // namespace

TEST_CASE("the largest step of a tile column is two smallest radii, or what is asked for") {
    CHECK(settings().largest_gap == 0.0);
    CHECK(stepped_tiles(settings()).settings().largest_gap == 0.004);
    CHECK(settings().largest_step == 0.0);
    CHECK(stepped_tiles(settings()).settings().largest_step == 0.004); // around a ring the same
    const double small = largest_step(0.0), wide = largest_step(0.008);
    CHECK(small > 0.0039);
    CHECK(small < 0.0042);
    CHECK(wide > 0.0078);
    CHECK(wide < 0.0083);
}

TEST_CASE("servos of tiles that share a pebble move together") {
    cylinder_settings s = settings();
    stepped_tiles wall(s);
    drives d;
    d.lateral = {drive::mode::servo, 1e5, 1.0, 0.5};
    std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    const int a = first_lateral_facet, b = first_lateral_facet + 1;
    const double target = 1e5 * wall.area(a), k = 2e6, stiff = 1e8;
    // together they carry 10 N less than they should, all of it on b: alone, b would barely move
    loads[static_cast<std::size_t>(a)] = {target, k + stiff, 2};
    loads[static_cast<std::size_t>(b)] = {target - 10.0, k + stiff, 2};
    const coupling shared{a, b, -stiff};
    wall.control(loads, d, 1e-5, std::span(&shared, 1));
    const double together = 0.5 * 10.0 / (2.0 * k) / 1e-5; // gain * missing force / stiffness against both / dt
    CHECK(wall.velocity(a) == Approx(together).epsilon(0.03));
    CHECK(wall.velocity(b) == Approx(together).epsilon(0.03));
    wall.control(loads, d, 1e-5);
    CHECK(wall.velocity(b) < 0.05 * together);
}

TEST_CASE("a wall around the axis refuses a drive for y walls alone") {
    stepped_tiles wall(settings());
    drives d;
    d.lateral_y = drive{drive::mode::hold, 0.0, 0.0, 0.5};
    const std::vector<facet_load> none(static_cast<std::size_t>(wall.facet_count()));
    CHECK_THROWS_AS(wall.control(none, d, 1e-3), clast::input_error);
}
