// SPDX-License-Identifier: MIT
#include <clast/engine/light_bodies.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using brittle = scenes::breakable<>;
constexpr double never = 1e15; // crushing strength that no load reaches (Pa)

} // namespace

TEST_CASE("a replacement never shrinks the step: light bodies take sub-steps") {
    auto s = scenes::settings<brittle>(never);
    engine<brittle> e = scenes::pressed(s, 400.0);
    const double dt = e.dt();
    CHECK(e.light_steps() == 1);
    scenes::set_utilisation(e, 0.95);
    for (int k = 0; k < 200; ++k) {
        e.step();
        REQUIRE(e.dt() >= dt);
    }
    CHECK(e.totals().replaced == 1);
    CHECK(e.grains.is_clump(0) == false);
}

TEST_CASE("a sub-step is within what every ball allows by itself, that of a cluster as well") {
    auto s = scenes::settings<brittle>(never);
    bodies::clumps one = scenes::empty(shapes::apollonian_14(0.02));
    one.add(0, {}, {});
    double lightest = 1.0;
    for (const auto& p : one.shapes[0].pebbles) lightest = std::min(lightest, one.density * sphere_volume(p.radius));
    const auto around = scenes::cylinder_around(one, 1e-6);
    engine<brittle> e(s, std::move(one), boundaries::solid_strips(around));
    scenes::set_utilisation(e, 0.95);
    e.settings.breakage.strength.sigma0 = 1e-9; // replaced at once
    e.step(2);
    REQUIRE(e.totals().replaced == 1);
    e.breakage_on = false;
    e.step(100);
    REQUIRE(e.totals().broken_tension + e.totals().broken_shear == 0);
    // on the lightest ball three contacts, whose stiffness is a mean over directions
    const double k = 3.0 * (s.grain_contact.kn + 2.0 * s.grain_contact.ks) / 3.0;
    CHECK(e.dt() / e.light_steps() <= s.safety * std::sqrt(lightest / k));
    // and the one at the platen its spring
    const auto& g = e.grains;
    e.each_wall_row([&](const boundaries::wall_row& w) {
        if (w.touch.size == 0) return;
        const double mass = g.ball_mass(static_cast<std::size_t>(w.pebble));
        CHECK(e.dt() / e.light_steps() <= s.safety * std::sqrt(mass / s.platen_contact.kn));
    });
}
