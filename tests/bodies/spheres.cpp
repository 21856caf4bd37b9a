// SPDX-License-Identifier: MIT
#include <clast/bodies/spheres.hpp>

#include <cstddef>
#include <limits>
#include <vector>

#include <clast/core/random.hpp>
#include <clast/integrators/leapfrog.hpp>

#include <catch.hpp>

static_assert(clast::bodies::specimen<clast::bodies::spheres>);

using namespace clast;

TEST_CASE("spheres move by the loads that act on them, damped or not, and say how far they have gone") {
    for (const double damping : {0.0, 0.7}) {
        bodies::spheres s;
        random_stream random{7, 1};
        const auto any = [&](double size) { return uniform(random, 0.0, size) * direction(random); };
        std::vector<moving_body> bodies;
        std::vector<bodies::spheres::reference> since;
        constexpr std::size_t n = 11;
        for (std::size_t b = 0; b < n; ++b) {
            s.add(any(1.0), uniform(random, 0.005, 0.01));
            since.push_back(s.refer(b));
            s.pebbles[b].x += any(1e-5);
            if (b != 3) s.pebbles[b].v = any(0.1), s.pebbles[b].w = any(10.0); // one is at rest
            bodies.push_back({n - 1 - b, {any(10.0), any(0.1), 0.5 * static_cast<double>(b)}});
        }
        const double h = 1e-5;
        const vec3 stretch{1.0 + 1e-6, 1.0, 1.0 - 1e-6};
        const bodies::spheres before = s;
        std::vector<double> margins(n, 1.0);
        const auto move = [&] {
            s = before;
            return s.advance(bodies, integrators::rule<integrators::leapfrog>{{damping}, {}, h, h}, {},
                             {since, margins, stretch}, [](std::size_t) { return 0.0; });
        };
        CHECK(move() == margin_use::within);
        for (const moving_body& one : bodies) {
            const pebble_motion &old = before.pebbles[one.body], &now = s.pebbles[one.body];
            const vec3 df = damping_force(one.load.force, old.v, damping),
                       dm = damping_force(one.load.moment, old.w, damping);
            // the same operations in the same order: the same bits
            CHECK(now.v == old.v + (h * old.inverse_mass) * (one.load.force + df));
            CHECK(now.w == old.w + (h * old.inverse_inertia) * (one.load.moment + dm));
            CHECK(now.x == old.x + h * now.v);
            CHECK(now.radius == old.radius);
            CHECK(now.inverse_mass == old.inverse_mass);
            CHECK(now.inverse_inertia == old.inverse_inertia);
            const body_losses& lost = s.losses[one.body];
            CHECK(lost.friction == one.load.dissipated);
            CHECK(lost.damping == Approx(-0.5 * h * (dot(df, old.v + now.v) + dot(dm, old.w + now.w))).margin(0.0));
            CHECK((lost.damping != 0.0) == (damping > 0.0 && one.body != 3));
        }
        for (std::size_t b = 0; b < n; ++b)
            margins[b] = (1.0 + 1e-9) * norm(s.pebbles[b].x - scale(stretch, since[b].centre));
        CHECK(move() == margin_use::within);
        margins[5] *= 1.0 - 2e-9;
        CHECK(move() == margin_use::used_up);
        bodies[2].load.force.y = std::numeric_limits<double>::quiet_NaN();
        CHECK(move() == margin_use::not_finite);
    }
}

TEST_CASE("a sphere whose inverse inertia is 0 does not turn, and has the energy of its motion") {
    bodies::spheres s;
    s.add({}, 0.01);
    s.pebbles[0].inverse_inertia = 0.0;
    s.set_velocity(0, {3.0, 0.0, 4.0});
    const double energy = 0.5 * s.body_mass(0) * 25.0;
    CHECK(s.kinetic_energy(0) == Approx(energy));
    CHECK(s.body_inertia(0).x == std::numeric_limits<double>::infinity());
    const std::vector<bodies::spheres::reference> since{s.refer(0)};
    const std::vector<moving_body> bodies{{0, {{}, {1.0, 2.0, 3.0}, 0.0}}};
    const std::vector<double> margins{1.0};
    for (const double damping : {0.0, 0.7})
        s.advance(bodies, integrators::rule<integrators::leapfrog>{{damping}, {}, 1e-5, 1e-5}, {},
                  {since, margins, {1.0, 1.0, 1.0}}, [](std::size_t) { return 0.0; });
    CHECK(s.spin(0) == vec3{});
    CHECK(s.kinetic_energy(0) == Approx(energy));
    CHECK(s.losses[0].damping == 0.0);
    s.set_spin(0, {1.0, 0.0, 0.0}); // it would take infinite energy, so there is none
    CHECK(s.kinetic_energy(0) == Approx(energy));
}

TEST_CASE("a sphere is put elsewhere as it is, whatever the orientation") {
    bodies::spheres s;
    s.add({1.0, 2.0, 3.0}, 0.01);
    s.set_velocity(0, {4.0, 5.0, 6.0});
    s.set_place(0, {-1.0, -2.0, -3.0}, {0.5, 0.5, 0.5, 0.5});
    CHECK(s.centre(0) == vec3{-1.0, -2.0, -3.0});
    CHECK(s.velocity(0) == vec3{4.0, 5.0, 6.0});
}
