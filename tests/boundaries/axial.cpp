// SPDX-License-Identifier: MIT
#include <clast/boundaries/axial.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include <clast/boundaries/box.hpp>
#include <clast/boundaries/rigid_cylinder.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/stepped_tiles.hpp>
#include <clast/core/random.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;
using namespace clast::boundaries;

namespace {

constexpr double contact = 2e6; // N/m
std::size_t at(int f) { return static_cast<std::size_t>(f); }

/// A barrel with a narrow bottom: ends of 2 and 3 m^2, 24 m^3 over 6 m.
struct barrel {
    double sigma_3;
    static double end_section(int platen) { return platen == bottom_platen ? 2.0 : 3.0; }
    static double volume() { return 24.0; }
    static double height() { return 6.0; }
    double lateral_stress(std::span<const facet_load>) const { return sigma_3; }
};

/// Tiles that 60 steps of uneven loads have bent, each ring in its own way.
stepped_tiles bent() {
    cylinder_settings c = scenes::cylinder(0.06, 0.12);
    c.rings = 6;
    stepped_tiles wall(c);
    random_stream random{3, 1};
    std::vector<facet_load> loads(at(wall.facet_count()));
    for (int f = first_lateral_facet; f < wall.facet_count(); ++f)
        loads[at(f)] = {1e5 * wall.area(f) * uniform(random, 0.5, 1.5), contact, 1};
    for (int k = 0; k < 60; ++k) {
        drives d;
        d.lateral = {drive::mode::servo, 1e5, 0.05, 0.5};
        wall.control(loads, d, 1e-3);
        wall.advance(1e-3);
    }
    return wall;
}
/// Area of ring k (m^2): sum of width times apothem / 2, from the areas of its tiles.
double area_of_ring(const stepped_tiles& wall, int k) {
    double sum = 0.0;
    for (int i = 0; i < wall.tiles_per_ring(); ++i) {
        const int f = first_lateral_facet + k * wall.tiles_per_ring() + i;
        sum += 0.5 * wall.apothem(f) * wall.area(f) / (wall.height() / wall.ring_count());
    }
    return sum;
}
/// Loads of one pressure (Pa) on the tiles, and of ends that carry `beyond` (N) more than the pressure does there.
std::vector<facet_load> under(const stepped_tiles& wall, double pressure, double beyond) {
    std::vector<facet_load> loads(at(wall.facet_count()));
    for (int f = 0; f < wall.facet_count(); ++f)
        loads[at(f)] = {pressure * (f < first_lateral_facet ? wall.end_section(f) : wall.area(f)), contact, 1};
    for (const int f : {bottom_platen, top_platen}) loads[at(f)].force += beyond;
    return loads;
}

} // namespace

TEST_CASE("q is force beyond the pressure at the ends, over the mean section") {
    std::vector<facet_load> loads(3);
    loads[bottom_platen].force = 70.0, loads[top_platen].force = 90.0;
    const barrel b{10.0};
    CHECK(mean_end(b) == 2.5);
    CHECK(deviator(b, loads) == (80.0 - 10.0 * 2.5) / 4.0);
    CHECK(axial_stress(b, loads) == 10.0 + 13.75);
    // the force that a servo to a stress aims at is the one at which that stress is there
    const double aim = axial_force(b, loads, 31.0);
    loads[bottom_platen].force = aim - 5.0, loads[top_platen].force = aim + 5.0;
    CHECK(axial_stress(b, loads) == Approx(31.0).epsilon(1e-14));
    CHECK(axial_force(b, loads, 10.0) == Approx(10.0 * 2.5).epsilon(1e-14)); // isotropic: on the ends' own areas
}

TEST_CASE("the axial stress is the mean over the height of what the grains of a bent specimen carry") {
    const stepped_tiles wall = bent();
    const double pressure = 2e5, beyond = 300.0;
    const auto loads = under(wall, pressure, beyond);
    CHECK(wall.end_section(bottom_platen) == Approx(area_of_ring(wall, 0)).epsilon(1e-12));
    CHECK(wall.end_section(top_platen) == Approx(area_of_ring(wall, 5)).epsilon(1e-12));
    CHECK(std::abs(wall.end_section(top_platen) / wall.end_section(bottom_platen) - 1.0) > 1e-3);
    // at a height the membrane has added the pressure on what the section is wider than the end
    double mean = 0.0;
    for (int k = 0; k < wall.ring_count(); ++k)
        mean += (beyond + pressure * area_of_ring(wall, k)) * wall.height() / wall.ring_count() / wall.volume();
    CHECK(wall.axial_stress(loads) == Approx(mean).epsilon(1e-12));
    CHECK(deviator(wall, std::span<const facet_load>(loads)) == Approx(beyond / wall.section()).epsilon(1e-9));
}

TEST_CASE("under one stress all round no platen moves, though the ends are not as wide as the middle") {
    stepped_tiles wall = bent();
    drives d;
    d.platens = d.lateral = {drive::mode::servo, 2e5, 0.05, 0.5};
    wall.control(under(wall, 2e5, 0.0), d, 1e-5);
    CHECK(std::abs(wall.velocity(bottom_platen)) < 1e-12);
    // and where the axial stress shall be another, its force counts on the mean section
    d.platens.value = 3e5;
    wall.control(under(wall, 2e5, 1e5 * wall.section()), d, 1e-5);
    CHECK(std::abs(wall.velocity(bottom_platen)) < 1e-12);
    wall.control(under(wall, 2e5, 0.0), d, 1e-5);
    CHECK(wall.velocity(bottom_platen) == 0.05);
}

TEST_CASE("ends of straight walls are their sections, and sigma_1 is force over section") {
    const auto check = [](const auto& b, double section) {
        std::vector<facet_load> loads(at(b.facet_count()));
        for (int f = 0; f < b.facet_count(); ++f) loads[at(f)].force = 50.0 + f;
        for (const int f : {bottom_platen, top_platen}) CHECK(b.end_section(f) == Approx(section).epsilon(1e-12));
        CHECK(b.volume() == Approx(section * b.height()).epsilon(1e-12));
        const std::span<const facet_load> seen(loads);
        CHECK(boundaries::axial_stress(b, seen) == Approx(50.5 / section).epsilon(1e-12));
        CHECK(b.axial_stress(seen) == Approx(50.5 / section).epsilon(1e-12));
    };
    check(box({{0, 0, 0}, {0.2, 0.3, 0.5}, 3.2e8, contact}), 0.06);
    check(rigid_cylinder(
              {.radius = 0.1, .bottom = 0.0, .top = 0.3, .largest_pebble = 0.01, .contact_stiffness_floor = contact}),
          std::numbers::pi * 0.01);
    check(solid_strips(scenes::cylinder(0.05, 0.1)), 8.0 * 0.05 * 0.05 * std::tan(std::numbers::pi / 8.0));
}
