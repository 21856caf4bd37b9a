// SPDX-License-Identifier: MIT
#include <clast/criteria/one_of.hpp>

#include <cmath>
#include <string>
#include <vector>

#include <clast/criteria/weibull.hpp>

#include <catch.hpp>

#include "crushing.hpp"

static_assert(clast::criteria::evaluated_criterion<clast::criteria::any>);

using namespace clast;
using namespace clast::criteria;

namespace {
const std::vector<std::string> agreeing = {"nominal_force", "hertz_contact", "octahedral", "mean_stress",
                                           "major_principal"};
}

TEST_CASE("all criteria agree on the crushing test of the reference grain") {
    for (const char* strength : {"weak", "medium", "strong"})
        for (const double volume : {1.522e-6, 2.194e-6}) {
            const double f = strength_of_class(strength) * 4e-4;
            for (const std::string& name : agreeing) {
                CAPTURE(name, strength);
                CHECK(by_name(name, strength).utilisation(test::crushed(0.02, volume, f)) ==
                      Approx(1.0).epsilon(1e-12));
                CHECK(by_name(name, strength).utilisation(test::crushed(0.02, volume, 0.3 * f)) ==
                      Approx(0.3).epsilon(1e-12));
            }
            // Eq. 1 as printed is not normalised: it is off by a factor of 4e3 to 1e6
            CHECK(by_name("hertz_literal", strength).utilisation(test::crushed(0.02, volume, f)) > 4e3);
        }
}

TEST_CASE("raw stresses of the crushing test on 14B are 3.65, 1.72 and 1.22 times F/d^2") {
    const auto load = test::crushed(0.02, 2.194e-6, 17280.0);
    const auto i = invariants(load.stress);
    CHECK(largest_principal(i) / 43.2e6 == Approx(3.65).margin(0.005));
    CHECK(std::sqrt(2.0 / 3.0 * i.j2) / 43.2e6 == Approx(1.72).margin(0.005));
    CHECK(i.mean / 43.2e6 == Approx(1.22).margin(0.005));
}

TEST_CASE("criteria differ under a general load") {
    const auto load =
        test::pressed(0.02, 2e-6, {{{1, 0, 0}, 5e3}, {{-1, 0, 0}, 5e3}, {{0, 1, 0}, 3e3}, {{0, -1, 0}, 3e3}});
    const double unit_u = 1e3 / (43.2e6 * 4e-4);
    const auto u = [&](const char* name) { return by_name(name, "medium").utilisation(load) / unit_u; };
    CHECK(u("nominal_force") == Approx(5.0).epsilon(1e-12));
    CHECK(u("hertz_contact") == Approx(5.0).epsilon(1e-12));
    CHECK(u("major_principal") == Approx(5.0).epsilon(1e-12));
    CHECK(u("mean_stress") == Approx(8.0).epsilon(1e-12));
    CHECK(u("octahedral") == Approx(std::sqrt(25.0 + 9.0 - 15.0)).epsilon(1e-12));
}

TEST_CASE("a criterion picked at run time needs only what the picked model needs") {
    CHECK(needs_of(by_name("nominal_force", "weak")) == needs::largest_force);
    CHECK(needs_of(by_name("hertz_contact", "weak")) == needs::largest_force);
    CHECK(needs_of(by_name("mean_stress", "weak")) == needs::stress);
    CHECK(any::needs == (needs::largest_force | needs::largest_contact | needs::stress));
    any c = nominal_force{crushing_strength(1e6)};
    c = octahedral{crushing_strength(1e6)};
    CHECK(needs_of(c) == needs::stress);
    const any copy = c; // NOLINT: copies, does not nest
    CHECK(copy.model.index() == 2);
}

TEST_CASE("strength that scatters is that of the model picked") {
    using scattered = one_of<weibull<nominal_force>, weibull<octahedral>, mean_stress>;
    const crushing_strength s(1e6);
    const scattered first = weibull<nominal_force>{{s}, 5.0, 3}, second = weibull<octahedral>{{s}, 5.0, 4},
                    third = mean_stress{s};
    for (std::int64_t g = 0; g < 5; ++g) {
        CHECK(strength_factor_of(first, g) == weibull_factor(3, g, 5.0));
        CHECK(strength_factor_of(second, g) == weibull_factor(4, g, 5.0));
        CHECK(strength_factor_of(third, g) == 1.0);
        CHECK(strength_factor_of(any(mean_stress{s}), g) == 1.0);
        // scatter of what is picked already scatters
        const weibull<scattered> both{first, 7.0, 9};
        CHECK(strength_factor_of(both, g) == weibull_factor(9, g, 7.0) * weibull_factor(3, g, 5.0));
        grain_load load;
        load.diameter = 0.02, load.grain = g, load.largest_force = 400.0;
        CHECK(both.utilisation(load) == Approx(1.0 / strength_factor_of(both, g)).epsilon(1e-13));
    }
}

TEST_CASE("an unknown criterion is refused with the choices") {
    try {
        by_name("tresca", "weak");
        FAIL("accepted");
    } catch (const input_error& error) {
        CHECK(std::string(error.what()).find("'tresca' is not accepted. Allowed: nominal_force, ") !=
              std::string::npos);
    }
    CHECK_THROWS_AS(by_name("nominal_force", "soft"), input_error);
    CHECK_THROWS_AS(by_name("nominal_force", "weak", -0.02), input_error);
}
