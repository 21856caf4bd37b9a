// SPDX-License-Identifier: MIT
#include <clast/boundaries/cylinder_settings.hpp>

#include <limits>
#include <string>

#include <catch.hpp>

using namespace clast::boundaries;

namespace {

cylinder_settings paper() {
    cylinder_settings s;
    s.radius = 0.15;
    s.bottom = -0.35;
    s.top = 0.35;
    s.smallest_radius = 2.3e-3;
    s.contact_stiffness_floor = 2.06e6;
    return s;
}
/// What is said of settings that were changed; empty if they are taken.
template <class Change> std::string refusal(Change&& change) {
    cylinder_settings s = paper();
    change(s);
    try {
        checked(s);
    } catch (const clast::input_error& e) {
        return e.what();
    }
    return "";
}

} // namespace

TEST_CASE("settings that make no membrane are refused by the name of the member") {
    CHECK(refusal([](auto&) {}).empty());
    const auto names = [](const std::string& text, const char* member) {
        CHECK(text.find(std::string("cylinder_settings.") + member) == 0);
    };
    names(refusal([](auto& s) { s.radius = 0; }), "radius");
    names(refusal([](auto& s) { s.radius = std::numeric_limits<double>::infinity(); }), "radius");
    names(refusal([](auto& s) { s.top = s.bottom; }), "top");
    names(refusal([](auto& s) { s.rings = 0; }), "rings");
    names(refusal([](auto& s) { s.tiles_per_ring = 5; }), "tiles_per_ring");
    names(refusal([](auto& s) { s.smallest_radius = 0; }), "smallest_radius");
    names(refusal([](auto& s) { s.largest_step = -1.0; }), "largest_step");
    names(refusal([](auto& s) { s.platen_stiffness = 0; }), "platen_stiffness");
    names(refusal([](auto& s) { s.tile_stiffness = 0; }), "tile_stiffness");
    names(refusal([](auto& s) { s.contact_stiffness_floor = 0; }), "contact_stiffness_floor");
    names(refusal([](auto& s) { s.gaps.closing = 1.0; }), "gaps.closing");
    names(refusal([](auto& s) { s.gaps.release = 0.0; }), "gaps.release");
    names(refusal([](auto& s) { s.largest_gap = -1.0; }), "largest_gap");
    names(refusal([](auto& s) { s.largest_radius = 0.15; }), "largest_radius");
}

TEST_CASE("gap and radius of a torn membrane follow from the sizes where they are not given") {
    CHECK(checked(paper()).largest_gap == 4.6e-3);
    CHECK(checked(paper()).largest_step == 4.6e-3);
    CHECK(checked(paper()).largest_radius == 1.6 * 0.15);
    cylinder_settings given = paper();
    given.largest_gap = 0.01, given.largest_radius = 0.2;
    CHECK(checked(given).largest_gap == 0.01);
    CHECK(checked(given).largest_radius == 0.2);
}

TEST_CASE("a cylinder takes all that a vessel's settings say of one") {
    vessel_settings v;
    v.radius = 1.0, v.bottom = -2.0, v.top = 3.0, v.rings = 4, v.tiles_per_ring = 7;
    v.smallest_radius = 0.1, v.largest_gap = 0.3, v.contact_stiffness_floor = 5.0;
    v.platen_stiffness = 6.0, v.wall_stiffness = 8.0;
    const cylinder_settings c = cylinder_of(v);
    CHECK((c.radius == 1.0 && c.bottom == -2.0 && c.top == 3.0 && c.rings == 4 && c.tiles_per_ring == 7));
    CHECK((c.smallest_radius == 0.1 && c.largest_gap == 0.3 && checked(c).largest_step == 0.3));
    CHECK((c.contact_stiffness_floor == 5.0 && c.platen_stiffness == 6.0 && c.tile_stiffness == 8.0));
}

TEST_CASE("rings may be lower than a pebble only where they do not move on their own") {
    vessel_settings v;
    v.radius = 0.15, v.bottom = -0.05, v.top = 0.05, v.smallest_radius = 4e-3;
    v.rings = 13; // 7.7 mm
    CHECK_NOTHROW(check_tiles(v, false));
    CHECK_THROWS_AS(check_tiles(v, true), clast::input_error);
    v.rings = 12;
    CHECK_NOTHROW(check_tiles(v, true));
}
