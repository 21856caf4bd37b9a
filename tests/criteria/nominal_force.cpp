// SPDX-License-Identifier: MIT
#include <clast/criteria/nominal_force.hpp>

#include <cmath>

#include <catch.hpp>

#include "crushing.hpp"

static_assert(clast::criteria::evaluated_criterion<clast::criteria::nominal_force>);

using namespace clast;
using criteria::crushing_strength;
using criteria::nominal_force;

TEST_CASE("nominal force: limit forces of the paper's strength classes at 2 cm") {
    criteria::grain_load load;
    load.diameter = 0.02;
    CHECK(nominal_force{crushing_strength(23.2e6)}.limit(load) == Approx(9280.0).epsilon(1e-14));
    CHECK(nominal_force{crushing_strength(43.2e6)}.limit(load) == Approx(17280.0).epsilon(1e-14));
    CHECK(nominal_force{crushing_strength(350.7e6)}.limit(load) == Approx(140280.0).epsilon(1e-14));
    load.largest_force = 8352.0;
    CHECK(nominal_force{crushing_strength(23.2e6)}.utilisation(load) == Approx(0.9).epsilon(1e-14));
}

TEST_CASE("nominal force: the limit grows as d^(2 - 3/m) and with the strength of the grain") {
    const nominal_force c{crushing_strength(43.2e6, 0.02, 5.0)};
    criteria::grain_load small;
    small.diameter = 0.01;
    criteria::grain_load large;
    large.diameter = 0.04;
    CHECK(std::log(c.limit(large) / c.limit(small)) / std::log(4.0) == Approx(2.0 - 3.0 / 5.0).epsilon(1e-13));
    large.strength_factor = 1.3;
    CHECK(c.limit(large) / c.limit(small) == Approx(1.3 * std::pow(4.0, 1.4)).epsilon(1e-13));
}

TEST_CASE("nominal force: the resultant of a neighbour counts, or the largest contact where that is asked for") {
    criteria::grain_load load;
    load.diameter = 0.02, load.largest_force = 9280.0, load.largest_single = 2320.0;
    nominal_force c{crushing_strength(23.2e6)};
    CHECK(c.utilisation(load) == Approx(1.0).epsilon(1e-14));
    c.which = criteria::force_of::contact;
    CHECK(c.utilisation(load) == Approx(0.25).epsilon(1e-14));
}

TEST_CASE("nominal force: only the largest force counts, and no force is no utilisation") {
    const nominal_force c{crushing_strength(43.2e6)};
    const double two = c.utilisation(test::crushed(0.02, 2e-6, 5000.0));
    CHECK(two ==
          c.utilisation(test::pressed(0.02, 2e-6, {{{1, 0, 0}, 5000.0}, {{-1, 0, 0}, 5000.0}, {{0, 1, 0}, 4000.0}})));
    CHECK(c.utilisation(test::pressed(0.02, 2e-6, {})) == 0.0);
}
