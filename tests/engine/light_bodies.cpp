// SPDX-License-Identifier: MIT
#include <clast/engine/light_bodies.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <clast/core/errors.hpp>
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
    bodies::clumps one = scenes::empty(shapes::apollonian_14(circumscribed(0.02)));
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

TEST_CASE("with little damping all bodies go by one step, within what balls and their bonds allow") {
    auto s = scenes::settings<brittle>(never);
    engine<brittle> e = scenes::pressed(s, 400.0);
    const double dt = e.dt();
    e.settings.scheme.damping = 0.0;
    CHECK_FALSE(e.takes_sub_steps());
    e.step(50);
    CHECK(e.dt() == dt); // nothing is replaced yet
    scenes::set_utilisation(e, 0.95);
    while (e.totals().replaced == 0) e.step();
    e.step(2); // what balls trail is half of the long step first
    CHECK(e.light_steps() == 1);
    CHECK(e.breakage().pools[0].substeps(e.dt()) == 1);
    CHECK(e.dt() < 0.5 * dt);
    const double small = e.dt();
    e.step(100);
    CHECK(e.dt() == small);
    CHECK(e.light_steps() == 1);
    e.settings.scheme.damping = 0.7;
    CHECK(e.takes_sub_steps());
    e.step(20000); // a step grows slowly
    CHECK(e.dt() >= dt);
    // by wish
    e.settings.light_bodies = stepping::one_step;
    CHECK_FALSE(e.takes_sub_steps());
    e.step(52);
    CHECK(e.dt() == Approx(small).epsilon(1e-9));
    // undamped in sub-steps, or with longer steps than have been tried: refused, at any time
    e.settings.light_bodies = stepping::sub_steps;
    e.step(50);
    e.settings.scheme.damping = 0.0;
    CHECK_THROWS_AS(e.step(50), input_error);
    e.settings.scheme.damping = 0.7, e.settings.safety = 0.9;
    CHECK_THROWS_AS(e.step(50), input_error);
}

TEST_CASE("small balls that are let go under the load of their grain take no more energy than there is") {
    // a ball that stands on three smaller ones and is pressed on three others, whose bonds fail
    for (const double ratio : {0.1, 0.3, 1.0}) {
        INFO("ratio of radii " << ratio);
        const double r = 0.01;
        std::vector<shape_pebble> balls{{{}, r}};
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-1.0, 1.0}) {
                vec3 at;
                at[axis] = side * r * (1.0 + ratio);
                balls.push_back({at, r * ratio});
            }
        bodies::clumps one = scenes::empty(make_shape("studs", balls));
        one.add(0, {}, scenes::turning(unit(vec3{1, 1, 1}), {0, 0, 1}));
        auto around = scenes::cylinder_around(one);
        around.smallest_radius = r * ratio;
        engine<brittle> e(scenes::settings<brittle>(1.0, 0.2), std::move(one), boundaries::solid_strips(around));
        e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.05};
        const auto broken = [&] { return e.totals().broken_tension + e.totals().broken_shear; };
        for (int k = 0; k < 4000 && broken() == 0; ++k) e.step();
        REQUIRE(broken() > 0);
        e.step(300);
        CHECK(std::abs(scenes::residual(e)) < 0.01 * e.totals().boundary_work);
    }
}
