// SPDX-License-Identifier: MIT
#include <clast/core/spatial_order.hpp>

#include <algorithm>
#include <vector>

#include <clast/core/random.hpp>

#include <catch.hpp>

using namespace clast;

TEST_CASE("the eight cells of a cube come x first, then y, then z, and points of one cell stay as they are") {
    std::vector<vec3> points;
    for (int k = 7; k >= 0; --k)
        for (int twin = 0; twin < 2; ++twin)
            points.push_back({1.0 + (k & 1) + 0.1 * twin, 2.0 + (k >> 1 & 1), -3.0 + (k >> 2 & 1)});
    const std::vector<std::size_t> order = spatial_order(points, 1.0);
    std::vector<std::size_t> expected;
    for (std::size_t k = 8; k-- > 0;) expected.push_back(2 * k), expected.push_back(2 * k + 1);
    CHECK(order == expected);
}

TEST_CASE("every point is named once, and the next one is nearer than chance has it") {
    random_stream random{3, 0};
    std::vector<vec3> points;
    for (int k = 0; k < 8000; ++k)
        points.push_back({uniform(random, 0, 20), uniform(random, 0, 20), uniform(random, -9, 11)});
    std::vector<std::size_t> order = spatial_order(points, 1.0);
    double sorted = 0.0, before = 0.0;
    for (std::size_t k = 1; k < points.size(); ++k) {
        sorted += norm(points[order[k]] - points[order[k - 1]]);
        before += norm(points[k] - points[k - 1]);
    }
    CHECK(sorted < 0.2 * before);
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k < order.size(); ++k) REQUIRE(order[k] == k);
}

TEST_CASE("no point, coincident points and points beyond the curve are put in order, too") {
    CHECK(spatial_order({}, 1.0).empty());
    const std::vector<vec3> same(5, {1, 2, 3});
    CHECK(spatial_order(same, 0.1) == std::vector<std::size_t>{0, 1, 2, 3, 4});
    const std::vector<vec3> far = {{1e12, 0, 0}, {0, 0, 0}, {1e11, 0, 0}};
    CHECK(spatial_order(far, 1.0) == std::vector<std::size_t>{1, 0, 2});
}
