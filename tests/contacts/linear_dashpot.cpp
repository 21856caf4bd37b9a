// SPDX-License-Identifier: MIT
#include <clast/contacts/linear_dashpot.hpp>

#include <cmath>
#include <numbers>

#include <catch.hpp>

static_assert(clast::contacts::contact_law<clast::contacts::linear_dashpot>);

using namespace clast;
using contacts::linear_dashpot;
using contacts::motion;
using contacts::overlap;

TEST_CASE("a central collision with a dashpot loses what the closed form says, and reports it") {
    const double ri = 0.01, rj = 0.02, density = 2650.0;
    const auto mass = [&](double r) { return density * 4.0 / 3.0 * std::numbers::pi * r * r * r; };
    const double reduced = mass(ri) * mass(rj) / (mass(ri) + mass(rj));
    for (const double gamma : {0.0, 500.0, 2000.0}) {
        const linear_dashpot law{1e6, 5e5, 0.3, gamma};
        linear_dashpot::history h;
        double d = 0.0, v = 0.5, lost = 0.0; // overlap and speed of approach, in the frame of the pair
        const double dt = 1e-3 / std::sqrt(1e6 / reduced);
        do {
            // leapfrog: the force of the half-step velocity that led here
            const auto answer = law(overlap<double>{0, 0, 1, d, 1.0 / ri, 1.0 / rj, 1.0 / mass(ri), 1.0 / mass(rj)},
                                    motion<double>{0, 0, 0, 0, v}, h, dt);
            v += dt * answer.fz / reduced; // the force on i points away from j
            lost += answer.dissipated;
            d += dt * v;
        } while (d > 0.0);
        const double rate = 0.5 * gamma, omega = std::sqrt(1e6 / reduced - rate * rate);
        const double e = std::exp(-std::numbers::pi * rate / omega);
        CHECK(-v / 0.5 == Approx(e).epsilon(3e-3));
        CHECK(lost == Approx(0.5 * reduced * 0.25 * (1.0 - e * e)).epsilon(1e-2).margin(1e-9));
    }
}

TEST_CASE("a dashpot pulls before separation, where nothing rubs, and never without contact") {
    const linear_dashpot law{1e6, 5e5, 0.5, 1e4};
    linear_dashpot::history h;
    const auto pulled =
        law(overlap<double>{0, 0, 1, 1e-6, 100.0, 100.0, 90.0, 90.0}, motion<double>{1e-3, 0, 0, 0, -1.0}, h, 1e-5);
    CHECK(pulled.fz > 0.0);
    CHECK(pulled.fx == 0.0);
    CHECK(pulled.dissipated > 0.0);
    const auto open =
        law(overlap<double>{0, 0, 1, -1e-6, 100.0, 100.0, 90.0, 90.0}, motion<double>{1e-3, 0, 0, 0, -1.0}, h, 1e-5);
    CHECK(open.fx == 0.0);
    CHECK(open.fz == 0.0);
}

TEST_CASE("a dashpot at a wall is that of the whole body, between two of a kind that of half of one") {
    const linear_dashpot law{0.0, 0.0, 0.0, 100.0};
    linear_dashpot::history h;
    const auto force = [&](double inverse_i, double inverse_j) {
        return law(overlap<double>{0, 0, 1, 1e-6, 100.0, 0.0, inverse_i, inverse_j}, motion<double>{0, 0, 0, 0, 1.0}, h,
                   1e-5)
            .fz;
    };
    CHECK(force(5.0, 0.0) == Approx(-20.0).epsilon(1e-12)); // 0.2 kg
    CHECK(force(5.0, 5.0) == Approx(-10.0).epsilon(1e-12));
}

TEST_CASE("a damped impact that slides throughout loses mu (1 + e) v_n along the wall, pulled or not") {
    // the normal force of one sign alone rubs: its impulse is m v_n (1 + e_clipped of it) where the tail pulls
    const double r = 0.01, mass = 0.011, mu = 0.1, kn = 1e6;
    for (const double e : {0.8, 0.5}) {
        const double l = std::log(e), b = -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
        const double gamma = 2.0 * b * std::sqrt(kn / mass), dt = 1e-4 * std::sqrt(mass / kn);
        const linear_dashpot law{kn, 100.0 * kn, mu, gamma}; // slides from the first step on
        linear_dashpot::history h;
        double d = 0.0, v = 1.0, vt = 50.0, pushed = 0.0;
        do {
            const auto f = law(overlap<double>{0, 0, 1, d, 1.0 / r, 0.0, 1.0 / mass, 0.0},
                               motion<double>{vt * dt, 0, 0, 0, v}, h, dt);
            v += dt * f.fz / mass, vt += dt * f.fx / mass, d += dt * v;
            pushed += f.fz < 0.0 ? -dt * f.fz / mass : 0.0;
        } while (d > 0.0);
        CHECK(-v == Approx(e).epsilon(1e-3));
        CHECK(50.0 - vt == Approx(mu * pushed).epsilon(1e-4));
        // closed form of the impulse until the force is 0, at e of the clipped impact
        const double w = std::sqrt(1.0 - b * b);
        const double until = std::exp(-b / w * (std::numbers::pi - std::atan2(2.0 * b * w, w * w - b * b)));
        CHECK(50.0 - vt == Approx(mu * (1.0 + until)).epsilon(1e-3));
    }
}
