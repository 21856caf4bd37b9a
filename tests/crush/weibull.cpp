// SPDX-License-Identifier: MIT
#include "../../examples/crush/weibull.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <catch.hpp>

using crush::statistics_of;

TEST_CASE("strengths at even quantiles of a Weibull distribution give its modulus and scale back") {
    for (const double m : {1.5, 3.0, 10.0}) {
        std::vector<double> x;
        const int n = 20000;
        for (int k = 0; k < n; ++k) x.push_back(23.2e6 * std::pow(-std::log(1.0 - (k + 0.5) / n), 1.0 / m));
        const auto s = statistics_of(x);
        CHECK(s.modulus == Approx(m).epsilon(2e-3));
        CHECK(s.characteristic == Approx(23.2e6).epsilon(1e-3));
        CHECK(s.mean == Approx(23.2e6 * std::tgamma(1.0 + 1.0 / m)).epsilon(1e-3));
        const double variance = std::tgamma(1.0 + 2.0 / m) / std::pow(std::tgamma(1.0 + 1.0 / m), 2) - 1.0;
        CHECK(s.cv == Approx(std::sqrt(variance)).epsilon(2e-3));
        CHECK(s.standard_error == Approx(s.cv * s.mean / std::sqrt(n)).epsilon(1e-12));
    }
}

TEST_CASE("few strengths have what can be said of them") {
    CHECK(statistics_of({}).n == 0);
    const auto one = statistics_of({5.0});
    CHECK((one.mean == 5.0 && one.median == 5.0 && one.cv == 0.0 && one.modulus == 0.0));
    const auto three = statistics_of({1.0, 4.0, 2.0});
    CHECK(three.median == 2.0);
    CHECK(three.mean == Approx(7.0 / 3.0));
    CHECK(statistics_of({1.0, 2.0, 4.0, 8.0}).median == 3.0);
}
