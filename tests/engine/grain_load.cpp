// SPDX-License-Identifier: MIT
#include <clast/engine/grain_load.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <clast/criteria/octahedral.hpp>
#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {
struct by_stress : scenes::breakable<> {
    using breakage = criteria::octahedral;
};
constexpr double never = 1e15;
} // namespace

TEST_CASE("a clump that stands on three points is loaded most by the platen above it, which is one neighbour") {
    auto e = scenes::pressed(scenes::settings<by_stress>(never), 300.0);
    e.breakage_on = true;
    e.settings.replacement.check_interval = 1;
    e.step(); // with rows, indexed
    std::vector<vec3> forces;
    const criteria::grain_load load = rooms::load_of(e.state(), 0, forces);
    const double force = scenes::load(e);
    CHECK(force > 290.0);
    CHECK(load.diameter == Approx(0.02));
    // below: three contacts with one platen, added up as the force of one neighbour
    CHECK(load.largest_force == Approx(force).epsilon(1e-6));
    // mean stress of two forces F at the distance h: sigma_zz V = F h (compression positive); forces act where pebbles
    // would end without overlap, one contact above, three below
    const double volume = e.grains.shapes[0].volume, k = e.settings.platen_contact.kn;
    const double h = e.boundary.height() + force / k + force / (3.0 * k);
    CHECK(load.stress(2, 2) * volume == Approx(force * h).epsilon(1e-4));
    CHECK(std::abs(load.stress(0, 1)) < 1e-6 * load.stress(2, 2));
}

TEST_CASE("loads of pebbles are in balance, and their number is that of the pebbles") {
    auto e = scenes::pressed(scenes::settings<scenes::breakable<>>(never), 300.0);
    e.breakage_on = true;
    e.settings.replacement.check_interval = 1;
    e.step();
    const std::vector<bonds::pebble_load> loads = rooms::pebble_loads(e.state(), 0);
    REQUIRE(loads.size() == 4);
    vec3 force, moment;
    double sizes = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        force += loads[k].force;
        moment += loads[k].moment + cross(e.grains.pebbles[k].x - e.grains.centre(0), loads[k].force);
        sizes += norm(loads[k].force);
    }
    CHECK(sizes == Approx(2.0 * scenes::load(e)).epsilon(1e-6));
    CHECK(norm(force) < 1e-6 * sizes);
    CHECK(norm(moment) < 1e-6 * sizes * 0.01);
}

namespace {
/// Asks for all there is.
struct curious {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::everything;
    double utilisation(const criteria::grain_load& load) const { return 1e-9 * load.largest_force; }
};
struct by_all : scenes::breakable<> {
    using breakage = curious;
};
} // namespace

TEST_CASE("coordination, forces of neighbours and the largest contact are there if asked for, else zero") {
    bonds::parallel bond;
    engine_settings<by_all> s{.grain_contact = contacts::linear::between(scenes::pebble, scenes::pebble),
                              .platen_contact = contacts::linear::between(scenes::pebble, scenes::platen),
                              .lateral_contact = contacts::linear::between(scenes::pebble, scenes::membrane),
                              .breakage = {},
                              .replacement = {.bond = bond, .check_interval = 1}};
    auto e = scenes::pressed(s, 300.0);
    e.breakage_on = true;
    e.step();
    std::vector<vec3> forces;
    const criteria::grain_load load = rooms::load_of(e.state(), 0, forces);
    CHECK(load.coordination == 2);
    REQUIRE(load.neighbour_forces.size() == 2);
    CHECK(norm(load.neighbour_forces[0] + load.neighbour_forces[1]) < 1e-6 * load.largest_force);
    CHECK(norm(load.neighbour_forces[1]) == Approx(load.largest_force).epsilon(1e-6));
    CHECK(load.contact_at_wall);
    CHECK(load.contact_radius == e.grains.pebbles[0].radius);
    CHECK(load.grain == 0);
    CHECK(load.stress(2, 2) > 0.0);

    auto few = scenes::pressed(scenes::settings<scenes::breakable<>>(never), 300.0);
    few.breakage_on = true;
    few.settings.replacement.check_interval = 1;
    few.step();
    const criteria::grain_load less = rooms::load_of(few.state(), 0, forces);
    CHECK(less.largest_force == Approx(load.largest_force).epsilon(1e-6));
    CHECK((less.coordination == 0 && less.neighbour_forces.empty() && less.contact_radius == 0.0));
    CHECK((!less.contact_at_wall && less.stress(2, 2) == 0.0));
}

TEST_CASE("the largest contact of two grains is that of their pebbles, r1 r2 / (r1 + r2)") {
    bodies::clumps rock;
    rock.shapes = {shapes::sphere(0.02), shapes::sphere(0.01)};
    rock.add(0, {}, {});
    rock.add(1, {0.0149, 0, 0}, {});
    engine<by_all> e({.grain_contact = contacts::linear::between(scenes::pebble, scenes::pebble),
                      .platen_contact = {},
                      .lateral_contact = {},
                      .breakage = {},
                      .replacement = {.bond = {}, .check_interval = 1}},
                     std::move(rock), boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
    e.step();
    std::vector<vec3> forces;
    for (std::size_t g = 0; g < 2; ++g) {
        const criteria::grain_load load = rooms::load_of(e.state(), g, forces);
        CHECK(load.contact_radius == Approx(0.01 * 0.005 / 0.015).epsilon(1e-14));
        CHECK(!load.contact_at_wall);
        CHECK(load.coordination == 1);
    }
}
