// SPDX-License-Identifier: MIT
// Where tiles are, and how far they may go; contact and measures are seen at the membranes in tiles.cpp.
#include <clast/boundaries/tile_rings.hpp>

#include <vector>

#include <catch.hpp>

#include <clast/boundaries/stepped_tiles.hpp>

namespace {

using namespace clast::boundaries;

cylinder_settings sizes() {
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
cylinder_settings paper() {
    cylinder_settings s = sizes();
    s.radius = 0.15, s.bottom = -0.35, s.top = 0.35;
    s.rings = 12, s.tiles_per_ring = 20;
    return s;
}

} // namespace

TEST_CASE("a single pebble may fill the height or the width, and be squeezed to half of it, no further") {
    cylinder_settings s = sizes();
    s.smallest_radius = 0.05;
    s.largest_gap = s.largest_step = 0.01;
    const auto squeezed = [&](double platens, double lateral) {
        stepped_tiles wall(s);
        drives d;
        d.platens = {drive::mode::velocity, platens, 0.0, 0.5};
        d.lateral = {drive::mode::velocity, lateral, 0.0, 0.5};
        const std::vector<facet_load> none(static_cast<std::size_t>(wall.facet_count()));
        wall.control(none, d, 1e-3);
        wall.advance(1.0);
        return wall.touch({0.0, 0.0, 0.0}, 0.05).size;
    };
    CHECK(squeezed(0.001, 0.0) == 2);
    CHECK(squeezed(0.024, 0.0) == 2);
    CHECK_THROWS_AS(squeezed(0.026, 0.0), clast::run_error);
    CHECK(squeezed(-0.1, 0.001) >= 1);
    CHECK(squeezed(-0.1, 0.024) >= 1);
    CHECK_THROWS_AS(squeezed(-0.1, 0.026), clast::run_error);
}

TEST_CASE("rings share the height of the specimen equally, also when it has become shorter") {
    constexpr double r = 4e-3;
    stepped_tiles wall(paper());
    drives d;
    d.platens = {drive::mode::velocity, 0.1, 0.0, 0.5};
    wall.control(std::vector<facet_load>(static_cast<std::size_t>(wall.facet_count())), d, 1e-3);
    for (int n = 0; n < 1000; ++n) wall.advance(1e-3);
    REQUIRE(wall.height() == Approx(0.5).epsilon(1e-12));
    for (int ring = 0; ring < 12; ++ring) {
        const double z = wall.bottom() + (ring + 0.5) * 0.5 / 12;
        const touches t = wall.touch({0.15 - 0.9 * r, 0.0, z}, r);
        REQUIRE(t.size == 1);
        CHECK(t.at[0].facet == first_lateral_facet + 20 * ring);
        CHECK(wall.area(t.at[0].facet) == Approx(wall.area(2)).epsilon(1e-12));
    }
    CHECK(20 * 12 * wall.area(2) == Approx(wall.volume() / 0.5 * 2 / 0.15 * 0.5).epsilon(1e-12)); // a prism
}
