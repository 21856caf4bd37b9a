// SPDX-License-Identifier: MIT
#include <limits>

#include <catch.hpp>

#include <clast/boundaries/drive.hpp>

using clast::boundaries::check;
using clast::boundaries::drive;

TEST_CASE("a drive that cannot work is refused by name", "[boundaries]") {
    using mode = drive::mode;
    CHECK_NOTHROW(check({mode::hold, 0, 0, 0.5}, "x"));
    CHECK_NOTHROW(check({mode::velocity, -0.01, 0, 0.5}, "x"));
    CHECK_NOTHROW(check({mode::servo, 2e6, 0.02, 0.5}, "x"));
    CHECK_THROWS_AS(check({mode::servo, -2e6, 0.02, 0.5}, "x"), clast::input_error); // tension
    CHECK_THROWS_AS(check({mode::servo, 2e6, 0.0, 0.5}, "x"), clast::input_error);   // speed limit forgotten
    CHECK_THROWS_AS(check({mode::servo, 2e6, 0.02, 1.0}, "x"), clast::input_error);  // unstable gain
    CHECK_THROWS_AS(check({mode::velocity, std::numeric_limits<double>::quiet_NaN(), 0, 0.5}, "x"), clast::input_error);
}
