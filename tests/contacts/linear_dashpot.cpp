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

TEST_CASE(
    "a dashpot pulls before separation, never without contact, and friction follows the size of the normal force") {
    const linear_dashpot law{1e6, 5e5, 0.5, 1e4};
    linear_dashpot::history h;
    const auto pulled =
        law(overlap<double>{0, 0, 1, 1e-6, 100.0, 100.0, 90.0, 90.0}, motion<double>{1e-3, 0, 0, 0, -1.0}, h, 1e-5);
    CHECK(pulled.fz > 0.0);
    CHECK(std::abs(pulled.fx) == Approx(0.5 * pulled.fz).epsilon(1e-12));
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
