// SPDX-License-Identifier: MIT
#include <clast/criteria/weibull.hpp>

#include <cmath>
#include <limits>

#include <clast/criteria/hertz_contact.hpp>
#include <clast/criteria/nominal_force.hpp>

#include <catch.hpp>

#include "crushing.hpp"

using namespace clast;
using namespace clast::criteria;

TEST_CASE("Weibull factors have the mean, variation and survival of the distribution") {
    constexpr int n = 40000;
    for (const double m : {3.0, 10.0}) {
        const double mean = std::tgamma(1.0 + 1.0 / m);
        const double variance = std::tgamma(1.0 + 2.0 / m) - mean * mean;
        if (m == 3.0) {
            CHECK(mean == Approx(0.892980).epsilon(1e-6));
            CHECK(std::sqrt(variance) / mean == Approx(0.36345).epsilon(1e-4));
        }
        double sum = 0.0;
        double square = 0.0;
        double power = 0.0;
        int survive = 0;
        for (int g = 0; g < n; ++g) {
            const double f = weibull_factor(7, g, m);
            CHECK_FALSE(!(f > 0.0));
            sum += f;
            square += f * f;
            power += std::pow(f, m);
            survive += f > 1.0 ? 1 : 0;
        }
        const double root = std::sqrt(n);
        CHECK(std::abs(sum / n - mean) < 3.0 * std::sqrt(variance) / root);
        CHECK(std::sqrt(square / n - sum * sum / n / n) == Approx(std::sqrt(variance)).epsilon(0.02));
        CHECK(std::abs(power / n - 1.0) < 3.0 / root);                               // f^m is exponential
        CHECK(std::abs(survive / double(n) - std::exp(-1.0)) < 3.0 * 0.4823 / root); // 37 %
    }
}

TEST_CASE("a grain's strength depends on seed and grain alone, and infinite m switches scatter off") {
    CHECK(weibull_factor(7, 12, 5.0) == weibull_factor(7, 12, 5.0));
    CHECK(weibull_factor(7, 12, 5.0) != weibull_factor(7, 13, 5.0));
    CHECK(weibull_factor(7, 12, 5.0) != weibull_factor(8, 12, 5.0));
    CHECK(weibull_factor(7, 12, std::numeric_limits<double>::infinity()) == 1.0);
}

TEST_CASE("scatter divides the utilisation by the strength, cubed for Hertz") {
    const crushing_strength s(43.2e6);
    const weibull<nominal_force> nominal{{s}, 5.0, 3};
    const weibull<hertz_contact> hertz{hertz_contact::calibrated(s), 5.0, 3};
    STATIC_REQUIRE(evaluated_criterion<weibull<nominal_force>>);
    CHECK(needs_of(nominal) == (needs::largest_force | needs::grain_id));
    CHECK(needs_of(hertz) == (needs::largest_force | needs::grain_id));
    grain_load load = test::crushed(0.02, 2e-6, 17280.0);
    for (int g = 0; g < 20; ++g) {
        load.grain = g;
        const double f = weibull_factor(3, g, 5.0);
        CHECK(nominal.utilisation(load) == Approx(1.0 / f).epsilon(1e-12));
        CHECK(hertz.utilisation(load) == Approx(1.0 / (f * f * f)).epsilon(1e-12));
    }
}
