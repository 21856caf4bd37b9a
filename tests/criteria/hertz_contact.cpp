// SPDX-License-Identifier: MIT
#include <clast/criteria/hertz_contact.hpp>

#include <cmath>
#include <numbers>

#include <catch.hpp>

#include "crushing.hpp"

static_assert(clast::criteria::evaluated_criterion<clast::criteria::hertz_contact>);

using namespace clast;
using criteria::crushing_strength;
using criteria::hertz_contact;
using criteria::hertz_rule;

namespace {

constexpr double weak = 23.2e6;
constexpr double medium = 43.2e6;
constexpr double strong = 350.7e6;

criteria::grain_load grain(double d) {
    criteria::grain_load load;
    load.diameter = d;
    return load;
}

/// Mean pressure of a Hertz contact (Johnson 1985): F / (pi a^2), a^3 = 3 F r / (4 E).
double hertz_pressure(double force, double r, double e) {
    const double a = std::cbrt(0.75 * force * r / e);
    return force / (std::numbers::pi * a * a);
}

} // namespace

TEST_CASE("Eq. 1 as printed gives forces of milli-newtons to newtons") {
    const auto limit = [](double sigma, hertz_rule rule) {
        return hertz_contact::literal(crushing_strength(sigma), 46.8e9, 0.3, rule).limit(grain(0.02));
    };
    CHECK(limit(weak, hertz_rule::average) == Approx(0.0099).margin(0.00005));
    CHECK(limit(medium, hertz_rule::average) == Approx(0.064).margin(0.0005));
    CHECK(limit(strong, hertz_rule::average) == Approx(34.0).margin(0.5));
    CHECK(limit(weak, hertz_rule::pair) == Approx(0.0082).margin(0.00005));
    CHECK(limit(medium, hertz_rule::pair) == Approx(0.053).margin(0.0005));
    CHECK(limit(strong, hertz_rule::pair) == Approx(28.0).margin(0.5));
    // closed form sigma^3 pi^3 (3 r / 4 E)^2
    CHECK(limit(weak, hertz_rule::average) ==
          Approx(std::pow(weak * std::numbers::pi, 3) * std::pow(0.75 * 0.01 / 46.8e9, 2)).epsilon(1e-13));
}

TEST_CASE("at the limit force of Eq. 1 the mean Hertz pressure is the limit pressure") {
    const hertz_contact c = hertz_contact::calibrated(crushing_strength(medium));
    const double e = 46.8e9 / (2.0 * (1.0 - 0.09));
    CHECK(hertz_pressure(c.limit(grain(0.02)), 0.005, e) == Approx(c.limit_pressure.sigma0).epsilon(1e-13));
}

TEST_CASE("calibrated on the crushing test the limit pressure is GPa, and the limit force sigma0 d0^2") {
    const auto check = [](double sigma, double average, double pair, double pebbles) {
        const crushing_strength s(sigma);
        const auto a = hertz_contact::calibrated(s, 46.8e9, 0.3, hertz_rule::average);
        const auto p = hertz_contact::calibrated(s);
        const double r = 0.25 * 0.02 / (1.0 + std::sqrt(1.5)); // two 4B pebbles: r' = r / 2
        const auto c = hertz_contact::calibrated(s, 46.8e9, 0.3, hertz_rule::contact, r);
        CHECK(a.limit_pressure.sigma0 == Approx(average).margin(0.005e9));
        CHECK(p.limit_pressure.sigma0 == Approx(pair).margin(0.005e9));
        CHECK(c.limit_pressure.sigma0 == Approx(pebbles).margin(0.05e9));
        for (const hertz_contact& h : {a, p}) CHECK(h.limit(grain(0.02)) == Approx(sigma * 4e-4).epsilon(1e-13));
        criteria::grain_load load = grain(0.02);
        load.contact_radius = r;
        load.contact_modulus = 46.8e9 / (2.0 * (1.0 - 0.09));
        CHECK(c.limit(load) == Approx(sigma * 4e-4).epsilon(1e-13));
        load.contact_radius *= 2.0; // a rigid wall doubles r' and E': the same limit
        load.contact_modulus *= 2.0;
        CHECK(c.limit(load) == Approx(sigma * 4e-4).epsilon(1e-13));
        load.contact_modulus /= 2.0; // a wall of the grain's modulus: four times
        CHECK(c.limit(load) == Approx(4.0 * sigma * 4e-4).epsilon(1e-13));
    };
    check(weak, 2.27e9, 2.41e9, 4.1e9);
    check(medium, 2.79e9, 2.97e9, 5.1e9);
    check(strong, 5.61e9, 5.97e9, 10.2e9);
}

TEST_CASE("Hertz by the contact itself: where its modulus is not known it is that of two grains, or of a rigid wall") {
    const auto c = hertz_contact::calibrated(crushing_strength(medium), 46.8e9, 0.3, hertz_rule::contact);
    criteria::grain_load load = grain(0.02);
    load.contact_radius = 0.005; // of two equal grains, as calibrated
    CHECK(c.limit(load) == Approx(medium * 4e-4).epsilon(1e-13));
    load.contact_radius = 0.01, load.contact_at_wall = true; // doubles r' and E': the same limit
    CHECK(c.limit(load) == Approx(medium * 4e-4).epsilon(1e-13));
    load.contact_radius = 0.005; // a smaller pebble at the wall
    CHECK(c.limit(load) == Approx(0.25 * medium * 4e-4).epsilon(1e-13));
}

TEST_CASE("Hertz: the limit grows as d^(2 - 9/m), and scatter of strength enters cubed") {
    const auto c = hertz_contact::calibrated(crushing_strength(medium, 0.02, 12.0));
    CHECK(std::log(c.limit(grain(0.04)) / c.limit(grain(0.01))) / std::log(4.0) ==
          Approx(2.0 - 9.0 / 12.0).epsilon(1e-13));
    criteria::grain_load tough = grain(0.02);
    tough.strength_factor = 1.1;
    CHECK(c.limit(tough) / c.limit(grain(0.02)) == Approx(1.331).epsilon(1e-13));
    tough.largest_force = 1000.0;
    CHECK(c.utilisation(tough) == Approx(1000.0 / (1.331 * medium * 4e-4)).epsilon(1e-13));
}

TEST_CASE("Hertz asks for the contact only if its rule reads it, and refuses impossible moduli") {
    const crushing_strength s(medium);
    CHECK(criteria::needs_of(hertz_contact::calibrated(s)) == criteria::needs::largest_force);
    CHECK(criteria::needs_of(hertz_contact::calibrated(s, 46.8e9, 0.3, hertz_rule::contact)) == hertz_contact::needs);
    CHECK(criteria::contains(hertz_contact::needs, criteria::needs::largest_contact));
    CHECK_THROWS_AS(hertz_contact::literal(s, 0.0), input_error);
    CHECK_THROWS_AS(hertz_contact::calibrated(s, 46.8e9, 0.6), input_error);
}
