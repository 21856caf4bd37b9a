// SPDX-License-Identifier: MIT
#include <clast/spaces/periodic.hpp>

#include <cmath>

#include <clast/io/archive.hpp>

#include <catch.hpp>

static_assert(clast::spaces::space<clast::spaces::periodic>);

using namespace clast;
using spaces::periodic;

TEST_CASE("a cell deforms at the rates of its axes, exponentially, and knows the speed of its edges") {
    periodic cell({2.0, 3.0, 4.0});
    cell.axes[0].rate = 0.5;
    cell.axes[1].rate = -0.1;
    CHECK(cell.edge_speeds() == vec3{1.0, -0.1 * 3.0, 0.0});
    for (int k = 0; k < 1000; ++k) cell.advance(1e-3);
    CHECK(cell.edges().x == Approx(2.0 * std::exp(0.5)).epsilon(1e-12));
    CHECK(cell.edges().y == Approx(3.0 * std::exp(-0.1)).epsilon(1e-12));
    CHECK(cell.edges().z == 4.0);
    CHECK(cell.volume() == Approx(24.0 * std::exp(0.4)).epsilon(1e-12));
}

TEST_CASE(
    "a servo axis closes where the stress is too low, opens where it is too high, and the others keep their rate") {
    periodic cell({1.0, 1.0, 1.0});
    cell.axes[0] = {.target = 1e5, .max_rate = 2.0, .gain = 0.1};
    cell.axes[1] = {.rate = -0.3};
    cell.axes[2] = {.target = 1e5, .max_rate = 0.01, .gain = 0.1};
    cell.observe({1.1e5, 5.0, 0.0}, {1e8, 1e8, 1e8}, 1e-5);
    CHECK(cell.axes[0].rate ==
          Approx(0.1 * 1e4 / 1e8 / (10 * 1e-5)).epsilon(1e-9)); // a tenth of the error by the next look
    CHECK(cell.axes[1].rate == -0.3);
    CHECK(cell.axes[2].rate == -0.01);
    CHECK(cell.stress() == vec3{1.1e5, 5.0, 0.0});
    cell.observe({0, 0, 0}, {0, 0, 0}, 1e-5); // a cloud that does not touch
    CHECK(cell.axes[0].rate == -2.0);
    cell.axes[0].max_rate = 0.0; // then the step says how fast
    for (const double dt : {1e-5, 4e-5}) {
        cell.observe({0, 0, 0}, {0, 0, 0}, dt);
        CHECK(cell.axes[0].rate == -1e-5 / dt);
    }
}

TEST_CASE("an empty cell is refused, and a cell comes back from an archive") {
    CHECK_THROWS_AS(periodic({1.0, 0.0, 1.0}), input_error);
    periodic cell({1.0, 2.0, 3.0}), copy({1, 1, 1});
    cell.axes[1].target = 5.0;
    cell.observe({1, 2, 3}, {1, 1, 1}, 1.0);
    from_bytes(to_bytes(cell), copy);
    CHECK(checksum(copy) == checksum(cell));
    CHECK(copy.edges() == cell.edges());
    CHECK(copy.axes[1].rate == cell.axes[1].rate);
}
