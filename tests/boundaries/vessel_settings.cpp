// SPDX-License-Identifier: MIT
#include <clast/boundaries/vessel_settings.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <clast/boundaries/box.hpp>
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>

#include <catch.hpp>

using namespace clast;
using namespace clast::boundaries;

namespace {
vessel_settings sizes() {
    vessel_settings s;
    s.radius = 0.04;
    s.bottom = -0.05;
    s.top = 0.07;
    s.rings = 5;
    s.tiles_per_ring = 10;
    s.smallest_radius = 4e-3;
    s.largest_gap = 0.01;
    s.contact_stiffness_floor = 2e6;
    s.platen_stiffness = 1e8;
    s.wall_stiffness = 3e6;
    return s;
}
template <class Vessel> std::string refusal(const std::function<void(vessel_settings&)>& change) {
    vessel_settings s = sizes();
    change(s);
    try {
        (void)Vessel::made(s);
    } catch (const input_error& e) {
        return e.what();
    }
    return {};
}
template <class Vessel> void shrink(Vessel& v) {
    drives d;
    d.platens = {drive::mode::velocity, 0.01, 0.0, 0.5};
    d.lateral = {drive::mode::velocity, 0.02, 0.0, 0.5};
    const std::vector<facet_load> loads(static_cast<std::size_t>(v.facet_count()));
    v.control(loads, d, 1.0);
    v.advance(0.1);
}
template <class Vessel> void check_size(const Vessel& v, double section) {
    CHECK(v.radius() == Approx(0.04).epsilon(1e-14));
    CHECK(v.bottom() == Approx(-0.05).epsilon(1e-14));
    CHECK(v.height() == Approx(0.12).epsilon(1e-14));
    CHECK(v.volume() == Approx(section * 0.12).epsilon(1e-12));
    CHECK(v.holds({0.0, 0.029, 0.0}, 0.01));
    CHECK_FALSE(v.holds({0.0, 0.031, 0.0}, 0.01));
    CHECK_FALSE(v.holds({0.0, 0.0, 0.061}, 0.01));
    CHECK_FALSE(v.holds({0.0, 0.0, -0.041}, 0.01));
    Vessel smaller = v;
    shrink(smaller);
    vessel_settings other = sizes();
    other.radius = 7.0, other.bottom = -8.0, other.top = 9.0;
    const Vessel fresh = smaller.resized(other);
    CHECK(fresh.radius() == smaller.radius());
    CHECK(fresh.radius() == Approx(0.038).epsilon(1e-14));
    CHECK(fresh.bottom() == smaller.bottom());
    CHECK(fresh.height() == smaller.height());
    CHECK(fresh.fastest() == 0.0);
}
} // namespace

TEST_CASE("every vessel is made from plain sizes, and made anew where its walls are") {
    const double polygon = 10.0 * std::tan(std::numbers::pi / 10.0) * 0.04 * 0.04;
    check_size(tiles::made(sizes()), polygon);
    check_size(ring_walls::made(sizes()), polygon);
    check_size(solid_strips::made(sizes()), polygon);
    check_size(box::made(sizes()), 0.08 * 0.08);
    CHECK(box::made(sizes()).holds({0.029, 0.029, 0.0}, 0.01)); // a corner, which a cylinder does not have
    CHECK_FALSE(tiles::made(sizes()).holds({0.029, 0.029, 0.0}, 0.01));
    const tiles wall = tiles::made(sizes());
    CHECK(wall.ring_count() == 5);
    CHECK(wall.tiles_per_ring() == 10);
    CHECK(wall.settings().largest_gap == 0.01);
    CHECK(wall.settings().largest_step == 0.01);
    CHECK(wall.settings().contact_stiffness_floor == 2e6);
    CHECK(wall.settings().smallest_radius == 4e-3);
    CHECK(wall.stiffness(bottom_platen) == 1e8);
    CHECK(wall.stiffness(first_lateral_facet) == 3e6);
    CHECK(box::made(sizes()).stiffness(first_lateral_facet) == 1e8);
}

TEST_CASE("a vessel refuses by name what makes no sense for it, says what fits, and ignores what it has not") {
    CHECK(refusal<tiles>([](auto&) {}).empty());
    const auto rings = [](vessel_settings& s) { s.rings = 16; };           // 7.5 mm; pebbles of 8 mm
    const auto around = [](vessel_settings& s) { s.tiles_per_ring = 32; }; // 7.9 mm
    CHECK(refusal<tiles>(rings).find("rings") == 0);
    CHECK(refusal<tiles>(rings).find("Take 15 rings at most.") != std::string::npos);
    CHECK(refusal<tiles>([](vessel_settings& s) { s.rings = 15; }).empty()); // so that the advice can be followed
    CHECK(refusal<ring_walls>(rings) == refusal<tiles>(rings));
    CHECK(refusal<solid_strips>(rings).empty());
    CHECK(refusal<box>(rings).empty());
    CHECK(refusal<tiles>(around).find("Take 31 tiles per ring at most.") != std::string::npos);
    CHECK(refusal<tiles>([](vessel_settings& s) { s.tiles_per_ring = 31; }).empty());
    CHECK_FALSE(refusal<solid_strips>(around).empty());
    CHECK(refusal<box>(around).empty());
    CHECK_FALSE(refusal<tiles>([](vessel_settings& s) { s.tiles_per_ring = 5; }).empty());
    CHECK_FALSE(refusal<tiles>([](vessel_settings& s) { s.rings = 0; }).empty());
    // no number of tiles helps where the pebble is too large
    CHECK(refusal<tiles>([](vessel_settings& s) { s.smallest_radius = 0.03; }).find("wider") != std::string::npos);
}
