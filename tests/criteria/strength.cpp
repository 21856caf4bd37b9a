// SPDX-License-Identifier: MIT
#include <clast/criteria/strength.hpp>

#include <cmath>
#include <limits>
#include <string>

#include <catch.hpp>

using namespace clast;
using criteria::crushing_strength;

TEST_CASE("strength falls with size as d^(-3/m)") {
    const crushing_strength s(40e6, 0.02, 3.0);
    CHECK(s.at(0.02) == 40e6);
    CHECK(s.at(0.04) == Approx(20e6).epsilon(1e-14)); // m = 3: half at twice the size
    CHECK(s.at(0.04, 1.5) == Approx(30e6).epsilon(1e-14));
    CHECK(crushing_strength(40e6, 0.02, 10.0).at(0.2) == Approx(40e6 * std::pow(10.0, -0.3)).epsilon(1e-14));
    CHECK(crushing_strength(40e6, 0.02, std::numeric_limits<double>::infinity()).at(0.5) == 40e6);
}

TEST_CASE("the strength classes are those of the paper") {
    CHECK(criteria::strength_of_class("weak") == 23.2e6);
    CHECK(criteria::strength_of_class("medium") == 43.2e6);
    CHECK(criteria::strength_of_class("strong") == 350.7e6);
    try {
        criteria::strength_of_class("brittle");
        FAIL("accepted");
    } catch (const input_error& error) {
        CHECK(std::string(error.what()).find("'brittle' is not accepted. Allowed: weak") != std::string::npos);
    }
}

TEST_CASE("a strength that is not positive is refused") {
    CHECK_THROWS_AS(crushing_strength(0.0), input_error);
    CHECK_THROWS_AS(crushing_strength(-1e6), input_error);
    CHECK_THROWS_AS(crushing_strength(std::nan("")), input_error);
    CHECK_THROWS_AS(crushing_strength(1e6, 0.0), input_error);
    CHECK_THROWS_AS(crushing_strength(1e6, 0.02, 0.0), input_error);
    CHECK_THROWS_AS(crushing_strength(1e6, 0.02, std::nan("")), input_error);
}
