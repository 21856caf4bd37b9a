// SPDX-License-Identifier: MIT
#include <clast/engine/grain_load.hpp>

#include <cmath>
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
    const criteria::grain_load load = rooms::load_of(e.state(), 0);
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
