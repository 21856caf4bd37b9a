// SPDX-License-Identifier: MIT
#include <clast/engine/wall_friction.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/engine/engine.hpp>
#include <clast/io/archive.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using ball_in_box = scenes::unbreakable_spheres<boundaries::box>;
constexpr double r = 0.01, kn = 1e6, ks = 8e5, mu = 0.4, depth = 1e-4;

/// A ball pressed between floor and ceiling, both frictional or not.
engine<ball_in_box> pressed_ball(double friction, double safety = 0.05) {
    bodies::spheres s;
    s.add({0, 0, 0}, r);
    return engine<ball_in_box>({.grain_contact = {kn, ks, mu},
                                .platen_contact = {kn, ks, friction},
                                .lateral_contact = {kn, ks, 0.0},
                                .breakage = {},
                                .replacement = {},
                                .scheme = {.damping = 0.0},
                                .safety = safety},
                               s, boundaries::box({{-0.5, -0.5, -r + depth}, {0.5, 0.5, r - depth}, kn, kn}));
}

} // namespace

TEST_CASE("a ball that slides between two frictional plates is slowed by 2 mu F, until it rests on the springs") {
    auto e = pressed_ball(mu, 0.01);
    e.grains.pebbles[0].v = {1.0, 0.5, 0.0};
    e.count_initial_energy();
    const double m = e.grains.body_mass(0), force = kn * depth;
    while (e.time() < 9e-5) e.step(); // the springs across the plates have given way
    const vec3 v0 = e.grains.pebbles[0].v;
    const double t0 = e.time(), lost0 = e.losses().friction;
    while (e.time() < 1.3e-4) e.step();
    const vec3 v = e.grains.pebbles[0].v;
    CHECK(norm(v0) - norm(v) == Approx(2.0 * mu * force / m * (e.time() - t0)).epsilon(1e-3));
    CHECK(v.y / v.x == Approx(0.5).epsilon(1e-6)); // straight on
    CHECK(norm(e.grains.pebbles[0].w) < 1e-9);     // moments of floor and ceiling cancel
    CHECK(e.losses().friction - lost0 == Approx(0.5 * m * (norm2(v0) - norm2(v))).epsilon(5e-3));
}

TEST_CASE("without friction nothing is held, and nothing is remembered") {
    auto e = pressed_ball(0.0);
    e.grains.pebbles[0].v = {1.0, 0.5, 0.0};
    e.step(200);
    CHECK(e.grains.pebbles[0].v == vec3{1.0, 0.5, 0.0});
    CHECK(e.state().heavy_grip.empty());
}

TEST_CASE("a plate below its limit of friction is a spring: a ball on one oscillates with the sphere's rolling mass") {
    // one frictional plate: u = x + r theta at the contact, m x'' = -ks u, I theta'' = -r ks u: omega^2 = ks 7 / (2 m)
    bodies::spheres s;
    s.add({0, 0, 0}, r);
    engine<ball_in_box> e({.grain_contact = {kn, ks, mu},
                           .platen_contact = {kn, ks, mu},
                           .lateral_contact = {kn, ks, 0.0},
                           .breakage = {},
                           .replacement = {},
                           .scheme = {.damping = 0.0},
                           .safety = 0.02},
                          s, boundaries::box({{-0.5, -0.5, -r + depth}, {0.5, 0.5, 0.5}, kn, kn}));
    // the normal spring lets go after half a period of its own: look at a quarter of the tangential one
    e.grains.pebbles[0].v = {1e-4, 0.0, 0.0};
    const double m = e.grains.body_mass(0), arm = r - 0.5 * depth;
    const double omega = std::sqrt(ks * (1.0 / m + arm * arm / (0.4 * m * r * r)));
    double before = 1.0, crossed = 0.0;
    while (crossed == 0.0) {
        e.step();
        const auto& p = e.grains.pebbles[0];
        const double slip = p.v.x - arm * p.w.y; // of the contact point
        if (slip <= 0.0) crossed = e.time() - e.dt() * slip / (slip - before);
        before = slip;
        REQUIRE(e.time() < 1.0);
    }
    CHECK(crossed == Approx(0.5 * std::acos(-1.0) / omega).epsilon(0.02));
}

TEST_CASE("walls that move drag grains along, and their work is booked") {
    // tiles that close in on a packing with rough platens and membrane
    auto s = scenes::settings<scenes::unbreakable<boundaries::tiles>>();
    s.platen_contact.mu = 0.3, s.platen_contact.ks = 0.5 * s.platen_contact.kn;
    s.lateral_contact.mu = 0.2, s.lateral_contact.ks = 0.5 * s.lateral_contact.kn;
    const auto run = [&](int threads, double platen, double membrane) {
        auto own = s;
        own.run = execution(threads), own.contacts_per_thread = 8;
        own.platen_contact.mu = own.lateral_contact.mu = 0.0; // the same packing for all
        auto e = scenes::packed<scenes::unbreakable<boundaries::tiles>>(own, shapes::tetrahedron_4(circumscribed(0.02)),
                                                                        60, 0.052, 2e5, 3000);
        e.drives = scenes::isotropic(2e5, 0.02);
        for (int k = 0; k < 1500; ++k) e.step();
        e.settings.platen_contact.mu = platen, e.settings.lateral_contact.mu = membrane;
        e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.05};
        const double open = scenes::residual(e), work = e.totals().boundary_work;
        for (int k = 0; k < 2000; ++k) e.step();
        INFO("residual " << scenes::residual(e) - open << " of " << e.totals().boundary_work - work);
        CHECK(std::abs(scenes::residual(e) - open) < 1e-3 * (e.totals().boundary_work - work));
        return e;
    };
    const auto rough = run(1, 0.3, 0.2), three = run(3, 0.3, 0.2), smooth = run(1, 0.0, 0.0);
    CHECK(checksum(rough) == checksum(three));
    CHECK(!rough.state().heavy_grip.empty());
    // a rough membrane takes part of the axial load between the platens, and rough platens hold the ends: stronger
    CHECK(rough.boundary.axial_stress(rough.loads()) > 1.05 * smooth.boundary.axial_stress(smooth.loads()));
    // friction never exceeds its limit
    std::size_t held = 0;
    for (std::size_t k = 0; k < rough.state().heavy_wall.size(); ++k) {
        const auto& w = rough.state().heavy_wall[k];
        const auto& grip = rough.state().heavy_grip[k];
        for (std::size_t end : {0U, 1U})
            CHECK(norm(grip.part[end].force) <= 0.3 * w.platen[end] * (1.0 + 1e-9) + 1e-12);
        CHECK(norm(grip.part[rooms::lateral_wall].force) <= 0.2 * w.lateral * (1.0 + 1e-9) + 1e-12);
        held += norm(grip.force) > 0.0;
    }
    CHECK(held > 20);
    // a checkpoint holds what walls remember
    auto copy = rough, other = smooth;
    other.settings = copy.settings;
    from_bytes(to_bytes(copy), other);
    for (int k = 0; k < 200; ++k) copy.step(), other.step();
    CHECK(checksum(other) == checksum(copy));
}

TEST_CASE("balls of broken grains rub as well") {
    using P = scenes::breakable<boundaries::tiles>;
    auto s = scenes::settings<P>(2e5, 0.03);
    s.platen_contact.mu = 0.3, s.platen_contact.ks = 0.5 * s.platen_contact.kn;
    auto e = scenes::packed<P>(s, shapes::tetrahedron_4(circumscribed(0.02)), 24, 0.055, 2e5, 4000);
    e.breakage_on = true;
    e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.05};
    const double open = scenes::residual(e), work = e.totals().boundary_work;
    for (int k = 0; k < 3000; ++k) e.step();
    CHECK(e.totals().replaced > 3);
    std::size_t held = 0;
    for (const auto& grip : e.state().light_grip) held += norm(grip.force) > 0.0;
    CHECK(held > 0);
    CHECK(std::abs(scenes::residual(e) - open) < 2e-3 * (e.totals().boundary_work - work));
}
