// SPDX-License-Identifier: MIT
#include <clast/criteria/octahedral.hpp>

#include <cmath>

#include <catch.hpp>

#include "crushing.hpp"

static_assert(clast::criteria::evaluated_criterion<clast::criteria::octahedral>);

using namespace clast;
using criteria::crushing_strength;
using criteria::octahedral;

TEST_CASE("octahedral shear: two opposite forces use the grain as F / (sigma0 d^2), along any axis and for any shape") {
    const octahedral c{crushing_strength(43.2e6)};
    for (const double volume : {1.522e-6, 2.194e-6, 4.18879e-6})
        for (const vec3& axis : {vec3{1, 0, 0}, vec3{1, 2, -2}, vec3{-0.3, 0.1, 5}})
            CHECK(c.utilisation(test::crushed(0.02, volume, 17280.0, axis)) == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("octahedral shear: the limit force grows as d^(2 - 3/m) and with the strength of the grain") {
    const octahedral c{crushing_strength(43.2e6, 0.02, 5.0)};
    const double u1 = c.utilisation(test::crushed(0.01, 1e-7, 1000.0));
    criteria::grain_load load = test::crushed(0.04, 64e-7, 1000.0);
    CHECK(std::log(u1 / c.utilisation(load)) / std::log(4.0) == Approx(2.0 - 3.0 / 5.0).epsilon(1e-12));
    load.strength_factor = 1.3;
    CHECK(u1 / c.utilisation(load) == Approx(1.3 * std::pow(4.0, 1.4)).epsilon(1e-12));
}

TEST_CASE("octahedral shear: pressure from all sides does not use the grain, whatever its size") {
    const octahedral c{crushing_strength(43.2e6)};
    const auto all = test::pressed(0.02, 2e-6,
                                   {{{1, 0, 0}, 9e3},
                                    {{-1, 0, 0}, 9e3},
                                    {{0, 1, 0}, 9e3},
                                    {{0, -1, 0}, 9e3},
                                    {{0, 0, 1}, 9e3},
                                    {{0, 0, -1}, 9e3}});
    CHECK(c.utilisation(all) == 0.0);
    // four forces in a plane: |tau| as in the crushing test with the same force
    const auto plane =
        test::pressed(0.02, 2e-6, {{{1, 0, 0}, 9e3}, {{-1, 0, 0}, 9e3}, {{0, 1, 0}, 9e3}, {{0, -1, 0}, 9e3}});
    CHECK(c.utilisation(plane) == Approx(9e3 / (43.2e6 * 4e-4)).epsilon(1e-12));
}

TEST_CASE("octahedral shear: a pure shear stress tau gives sqrt(2/3) tau") {
    const octahedral c{crushing_strength(43.2e6)};
    criteria::grain_load load;
    load.diameter = 0.02;
    load.volume = 8e-6;                                          // V = d^3: stress and F / d^2 are the same
    load.stress = {{{5e6, 1e7, 0}, {3e7, 5e6, 0}, {0, 0, 5e6}}}; // symmetric part 2e7
    CHECK(c.utilisation(load) == Approx(std::sqrt(2.0 / 3.0) * 2e7 * 3.0 / std::sqrt(2.0) / 43.2e6).epsilon(1e-12));
}
