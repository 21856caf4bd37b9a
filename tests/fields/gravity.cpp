// SPDX-License-Identifier: MIT
#include <clast/fields/gravity.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/core/random.hpp>
#include <clast/engine/engine.hpp>
#include <clast/fields/none.hpp>
#include <clast/measure/stress.hpp>
#include <clast/spaces/periodic.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

static_assert(clast::fields::field<clast::fields::gravity>);

using namespace clast;

namespace {

struct heavy : scenes::unbreakable<> {
    using field = fields::gravity;
};
struct heavy_spheres : heavy {
    using body = bodies::spheres;
    using boundary = boundaries::box;
};
struct falling : heavy_spheres {
    using boundary = boundaries::none;
};
struct falling_in_cell : falling {
    using space = spaces::periodic;
};
struct heavy_brittle : scenes::breakable<> {
    using field = fields::gravity;
};
template <class P> engine_settings<P> soft(double damping, double mu = 0.3) {
    const contacts::linear law{1e5, 5e4, mu};
    return {.grain_contact = law,
            .platen_contact = law,
            .lateral_contact = law,
            .breakage = {},
            .replacement = {},
            .scheme = {.damping = damping}};
}
boundaries::box box(const vec3& low, const vec3& high) {
    return boundaries::box({.low = low, .high = high, .contact_stiffness_floor = 1e5});
}
/// Runs for some time (s), and gives the force on the lower platen (N).
template <class P> double floor_force(engine<P>& e, double time) {
    while (e.time() < time) e.step(100);
    return e.loads()[boundaries::bottom_platen].force;
}

} // namespace

TEST_CASE("gravity is m g, and minus its potential's gradient") {
    const fields::gravity g{{1.0, -2.0, 3.0}};
    fields::body_at b{2.0, {0.1, 0.2, 0.3}, {}, 0.0};
    CHECK((g.force(b) == vec3{2.0, -4.0, 6.0}));
    const double here = g.potential(b);
    for (int a = 0; a < 3; ++a) {
        fields::body_at there = b;
        there.centre[a] += 0.5;
        CHECK(g.potential(there) - here == Approx(-0.5 * g.force(b)[a]));
    }
    CHECK(fields::gravity{}.acceleration.z == -9.81);
}

TEST_CASE("a sphere at rest presses on the floor with its weight, whatever the damping") {
    for (const double damping : {0.1, 0.3, 0.7}) {
        bodies::spheres s;
        s.add({0, 0, 0.01}, 0.01);
        const double weight = 9.81 * s.body_mass(0);
        engine<heavy_spheres> e(soft<heavy_spheres>(damping), s, box({-0.05, -0.05, 0}, {0.05, 0.05, 0.1}));
        CHECK(floor_force(e, 2.0) == Approx(weight).epsilon(1e-6));
        CHECK(measure::contacts_of(e).unbalanced_ratio < 1e-6);
    }
}

TEST_CASE("so does a 4B clump on a platen") {
    for (const double damping : {0.1, 0.3, 0.7}) {
        bodies::clumps s = scenes::empty(shapes::tetrahedron_4(circumscribed(0.02)));
        s.add(0, {}, scenes::turning(unit(vec3{1, 1, 1}), {0, 0, 1}));
        const double weight = 9.81 * s.body_mass(0);
        const boundaries::cylinder_settings c = scenes::cylinder_around(s, -1e-4);
        engine<heavy> e(soft<heavy>(damping), s, boundaries::solid_strips(c));
        CHECK(floor_force(e, 2.0) == Approx(weight).epsilon(1e-6));
    }
}

TEST_CASE("free fall is g t^2 / 2 to the order of the scheme, and keeps kinetic and potential energy") {
    bodies::spheres s;
    s.add({0, 0, 1.0}, 0.01);
    s.pebbles[0].v = {0.3, 0, 2.0};
    const auto settings = [](double step) {
        auto all = soft<falling>(0.0);
        all.largest_step = step;
        return all;
    };
    for (const double step : {1e-4, 2.5e-5}) {
        engine<falling> e(settings(step), s, spaces::open{});
        const double before = e.totals().initial_energy;
        CHECK(before != 0.0);
        e.step(static_cast<std::int64_t>(std::lround(0.5 / step)));
        const double t = e.time();
        REQUIRE(t == Approx(0.5));
        // velocities are those of half a step before, so a leapfrog is off by half a step of the final speed
        CHECK(e.grains.centre(0).z - (1.0 + 2.0 * t - 0.5 * 9.81 * t * t) ==
              Approx(-0.5 * 9.81 * t * e.dt()).epsilon(1e-6));
        CHECK(e.grains.centre(0).x == Approx(0.3 * t));
        CHECK(std::abs(e.kinetic_energy() + e.potential_energy() - before) < 1e-12 * std::abs(before));
        CHECK(std::abs(e.potential_energy()) > 0.1 * std::abs(before));
    }
}

TEST_CASE("the audit of spheres that settle under gravity closes, and the floor carries their weight") {
    bodies::spheres s;
    double weight = 0.0;
    for (int k = 0; k < 125; ++k) {
        random_stream random{1, static_cast<std::uint64_t>(k)};
        s.add({0.024 * (k % 5 - 2), 0.024 * (k / 5 % 5 - 2), 0.03 + 0.024 * (k / 25)}, uniform(random, 0.008, 0.011));
        s.pebbles.back().v = 0.1 * direction(random);
        weight += 9.81 * s.body_mass(static_cast<std::size_t>(k));
    }
    auto settings = soft<heavy_spheres>(0.3, 0.4);
    settings.safety = 0.2;
    settings.platen_contact.mu = settings.lateral_contact.mu = 0.0;
    engine<heavy_spheres> e(settings, s, box({-0.06, -0.06, 0}, {0.06, 0.06, 0.3}));
    const double fall = e.totals().initial_energy;
    double worst = 0.0;
    while (e.time() < 1.5) {
        e.step(200);
        worst = std::max(worst, std::abs(scenes::residual(e)));
    }
    INFO(worst / fall);
    CHECK(fall > 10.0 * e.kinetic_energy());
    CHECK(worst < 5e-4 * fall);
    CHECK(e.loads()[boundaries::bottom_platen].force == Approx(weight).epsilon(1e-3));
    CHECK(measure::contacts_of(e).unbalanced_ratio < 0.01);
}

TEST_CASE("a grain that falls through a periodic cell gains what the field gave, and the audit says so") {
    bodies::spheres s;
    s.add({0, 0, 0}, 0.005);
    auto settings = soft<falling_in_cell>(0.0);
    engine<falling_in_cell> e(settings, s, spaces::periodic({0.1, 0.1, 0.1}));
    while (e.time() < 0.4) e.step();
    const double fallen = 0.5 * 9.81 * e.time() * e.time();
    CHECK(fallen > 0.5); // several times through
    CHECK(e.kinetic_energy() == Approx(s.body_mass(0) * 9.81 * fallen).epsilon(1e-3));
    CHECK(e.totals().boundary_work > 0.5 * e.kinetic_energy());
    CHECK(std::abs(scenes::residual(e)) < 1e-9 * e.kinetic_energy());
}

TEST_CASE("balls and clusters of a broken grain have their weight, too") {
    auto settings = scenes::settings<heavy_brittle>(1e15);
    engine<heavy_brittle> e = scenes::pressed(settings, 400.0);
    const double weight = 9.81 * e.grains.body_mass(0);
    scenes::set_utilisation(e, 0.95);
    for (int k = 0; k < 200; ++k) e.step();
    REQUIRE(e.totals().replaced == 1);
    e.breakage_on = false;
    e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = -0.002}; // let it lie on the lower one
    while (e.loads()[boundaries::top_platen].force > 0.0) e.step();
    const double high = e.potential_energy();
    e.drives.platens.how = boundaries::drive::mode::hold;
    while (e.time() < 0.5) e.step(10);
    CHECK(e.loads()[boundaries::top_platen].force == 0.0);
    CHECK(e.loads()[boundaries::bottom_platen].force == Approx(weight).epsilon(1e-6));
    CHECK(e.potential_energy() < high);
    double potential = 0.0; // of four balls about their places
    for (const auto& p : e.grains.pebbles) potential += 9.81 * p.x.z * e.grains.density * sphere_volume(p.radius);
    CHECK(e.potential_energy() == Approx(potential).epsilon(1e-6));
}

TEST_CASE("without a field a scene is not larger, and with gravity by its acceleration only") {
    struct plain : scenes::unbreakable<> {};
    static_assert(std::is_empty_v<fields::none>);
    static_assert(sizeof(engine_settings<heavy>) == sizeof(engine_settings<plain>) + sizeof(vec3));
    CHECK(engine<plain>(scenes::settings<plain>(), scenes::empty(shapes::sphere(0.01)),
                        boundaries::solid_strips(scenes::cylinder(0.1, 0.1)))
              .potential_energy() == 0.0);
}
