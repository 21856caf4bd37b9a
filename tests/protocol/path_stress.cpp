// SPDX-License-Identifier: MIT
#include <clast/protocol/path_stress.hpp>

#include <cmath>
#include <vector>

#include <clast/boundaries/box.hpp>
#include <clast/boundaries/rigid_cylinder.hpp>

#include <catch.hpp>

using namespace clast;

static_assert(protocol::has_three_axes<boundaries::box>);
static_assert(!protocol::has_three_axes<boundaries::rigid_cylinder>);

TEST_CASE("stresses of a box by axis, and as those of a cylinder where its y walls follow those of x") {
    const boundaries::box b({{0, 0, 0}, {1, 2, 3}, 1e8, 1e6});
    std::vector<boundaries::facet_load> loads(6);
    // x: area 6, y: 3, z: 2
    loads[2].force = loads[3].force = 6.0 * 100e3;
    loads[4].force = loads[5].force = 3.0 * 200e3;
    loads[0].force = loads[1].force = 2.0 * 400e3;
    const protocol::path_stress three = protocol::stress_of(b, loads, true);
    CHECK(three.sigma_1 == Approx(400e3));
    CHECK(three.sigma_2 == Approx(200e3));
    CHECK(three.sigma_3 == Approx(100e3));
    CHECK(three.p == Approx(700e3 / 3.0));
    CHECK(three.q == Approx(std::sqrt(0.5 * (4.0 + 1.0 + 9.0)) * 100e3));
    const protocol::path_stress two = protocol::stress_of(b, loads, false);
    CHECK(two.sigma_1 == Approx(400e3));
    CHECK(two.sigma_2 == two.sigma_3);
    CHECK(two.sigma_3 == Approx(150e3));
    CHECK(two.q == Approx(250e3));
    CHECK(two.p == Approx(700e3 / 3.0));
    CHECK(protocol::deviator_of(4.0, 1.0, 1.0) == Approx(3.0));
    CHECK(protocol::deviator_of(1.0, 4.0, 4.0) == Approx(3.0)); // unsigned
}
