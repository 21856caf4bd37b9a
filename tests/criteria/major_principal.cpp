// SPDX-License-Identifier: MIT
#include <clast/criteria/major_principal.hpp>

#include <cmath>

#include <catch.hpp>

#include "crushing.hpp"

static_assert(clast::criteria::evaluated_criterion<clast::criteria::major_principal>);

using namespace clast;
using criteria::crushing_strength;
using criteria::major_principal;

TEST_CASE(
    "major principal stress: two opposite forces use the grain as F / (sigma0 d^2), along any axis and for any shape") {
    const major_principal c{crushing_strength(43.2e6)};
    for (const double volume : {1.522e-6, 2.194e-6, 4.18879e-6})
        for (const vec3& axis : {vec3{1, 0, 0}, vec3{1, 2, -2}, vec3{-0.3, 0.1, 5}})
            CHECK(c.utilisation(test::crushed(0.02, volume, 17280.0, axis)) == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("major principal stress: the limit force grows as d^(2 - 3/m) and with the strength of the grain") {
    const major_principal c{crushing_strength(43.2e6, 0.02, 5.0)};
    const double u1 = c.utilisation(test::crushed(0.01, 1e-7, 1000.0));
    criteria::grain_load load = test::crushed(0.04, 64e-7, 1000.0);
    CHECK(std::log(u1 / c.utilisation(load)) / std::log(4.0) == Approx(2.0 - 3.0 / 5.0).epsilon(1e-12));
    load.strength_factor = 1.3;
    CHECK(u1 / c.utilisation(load) == Approx(1.3 * std::pow(4.0, 1.4)).epsilon(1e-12));
}

TEST_CASE("major principal stress: the largest of three pairs counts, tension counts as nothing") {
    const major_principal c{crushing_strength(43.2e6)};
    const auto three = test::pressed(0.02, 2e-6,
                                     {{{1, 0, 0}, 5e3},
                                      {{-1, 0, 0}, 5e3},
                                      {{0, 1, 0}, 7e3},
                                      {{0, -1, 0}, 7e3},
                                      {{0, 0, 1}, 2e3},
                                      {{0, 0, -1}, 2e3}});
    CHECK(c.utilisation(three) == Approx(7e3 / (43.2e6 * 4e-4)).epsilon(1e-12));
    const auto all = test::pressed(0.02, 2e-6,
                                   {{{1, 0, 0}, 5e3},
                                    {{-1, 0, 0}, 5e3},
                                    {{0, 1, 0}, 5e3},
                                    {{0, -1, 0}, 5e3},
                                    {{0, 0, 1}, 5e3},
                                    {{0, 0, -1}, 5e3}});
    CHECK(c.utilisation(all) == Approx(5e3 / (43.2e6 * 4e-4)).epsilon(1e-12));
    CHECK(c.utilisation(test::crushed(0.02, 2e-6, -5e3)) < 1e-12); // rounding of a zero principal stress
}

TEST_CASE("major principal stress: the largest root of a stress with known principal values") {
    const major_principal c{crushing_strength(43.2e6)};
    // principal values by construction: Q diag Q^T
    for (const vec3& value :
         {vec3{9e6, 4e6, -2e6}, vec3{9e6, 9e6, 1e6}, vec3{9e6, 1e6, 1e6}, vec3{9e6, 9e6 - 1, 8.9e6}}) {
        const mat3 q = matrix(rotation(vec3{0.3, -1.2, 0.7}));
        criteria::grain_load load;
        load.diameter = 0.02;
        load.volume = 8e-6;
        for (int k = 0; k < 3; ++k) load.stress += value[k] * outer(transpose(q).row[k], transpose(q).row[k]);
        CHECK(c.utilisation(load) == Approx(9e6 / 43.2e6).epsilon(1e-9));
    }
}
