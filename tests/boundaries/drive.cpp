// SPDX-License-Identifier: MIT
#include <limits>

#include <catch.hpp>

#include <clast/boundaries/drive.hpp>
#include <clast/io/archive.hpp>

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

TEST_CASE("drives come back from an archive, that of y walls whether it is there or not") {
    using clast::boundaries::drives;
    using mode = drive::mode;
    drives d, copy;
    d.platens = {mode::velocity, 0.1, 0.2, 0.3};
    d.lateral = {mode::servo, 1e5, 0.5, 0.4};
    clast::from_bytes(clast::to_bytes(d), copy);
    CHECK(copy.platens.value == 0.1);
    CHECK(copy.lateral.how == mode::servo);
    CHECK(copy.lateral.gain == 0.4);
    CHECK_FALSE(copy.lateral_y);
    d.lateral_y = drive{mode::servo, 2e5, 0.6, 0.7};
    clast::from_bytes(clast::to_bytes(d), copy);
    REQUIRE(copy.lateral_y);
    CHECK(copy.lateral_y->value == 2e5);
    CHECK(copy.lateral_y->max_speed == 0.6);
}

TEST_CASE("the largest speed of drives is that of the fastest facet that they may move") {
    using clast::boundaries::drive;
    using clast::boundaries::fastest;
    using mode = drive::mode;
    CHECK(fastest(drive{mode::hold, 3.0, 2.0, 0.5}) == 0.0);
    CHECK(fastest(drive{mode::velocity, -3.0, 2.0, 0.5}) == 3.0); // m/s
    CHECK(fastest(drive{mode::servo, 1e5, 2.0, 0.5}) == 2.0);     // not the stress
    clast::boundaries::drives d;
    d.platens = {mode::velocity, 1.0, 0.0, 0.5}, d.lateral = {mode::servo, 1e5, 2.0, 0.5};
    CHECK(fastest(d) == 2.0);
    d.lateral_y = drive{mode::servo, 1e5, 4.0, 0.5};
    CHECK(fastest(d) == 4.0);
}
