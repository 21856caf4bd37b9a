// SPDX-License-Identifier: MIT
#include <clast/criteria/mean_stress.hpp>

#include <cmath>

#include <catch.hpp>

#include "crushing.hpp"

static_assert(clast::criteria::evaluated_criterion<clast::criteria::mean_stress>);

using namespace clast;
using criteria::crushing_strength;
using criteria::mean_stress;

TEST_CASE("mean stress: two opposite forces use the grain as F / (sigma0 d^2), along any axis and for any shape") {
    const mean_stress c{crushing_strength(43.2e6)};
    for (const double volume : {1.522e-6, 2.194e-6, 4.18879e-6})
        for (const vec3& axis : {vec3{1, 0, 0}, vec3{1, 2, -2}, vec3{-0.3, 0.1, 5}})
            CHECK(c.utilisation(test::crushed(0.02, volume, 17280.0, axis)) == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("mean stress: the limit force grows as d^(2 - 3/m) and with the strength of the grain") {
    const mean_stress c{crushing_strength(43.2e6, 0.02, 5.0)};
    const double u1 = c.utilisation(test::crushed(0.01, 1e-7, 1000.0));
    criteria::grain_load load = test::crushed(0.04, 64e-7, 1000.0);
    CHECK(std::log(u1 / c.utilisation(load)) / std::log(4.0) == Approx(2.0 - 3.0 / 5.0).epsilon(1e-12));
    load.strength_factor = 1.3;
    CHECK(u1 / c.utilisation(load) == Approx(1.3 * std::pow(4.0, 1.4)).epsilon(1e-12));
}

TEST_CASE("mean stress: pairs of forces along three axes add up, tension counts as nothing") {
    const mean_stress c{crushing_strength(43.2e6)};
    const auto all = test::pressed(0.02, 2e-6,
                                   {{{1, 0, 0}, 5e3},
                                    {{-1, 0, 0}, 5e3},
                                    {{0, 1, 0}, 5e3},
                                    {{0, -1, 0}, 5e3},
                                    {{0, 0, 1}, 5e3},
                                    {{0, 0, -1}, 5e3}});
    CHECK(c.utilisation(all) == Approx(3.0 * 5e3 / (43.2e6 * 4e-4)).epsilon(1e-12));
    CHECK(c.utilisation(test::crushed(0.02, 2e-6, -5e3)) == 0.0);
}
