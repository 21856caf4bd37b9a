// SPDX-License-Identifier: MIT
#include <clast/searches/brute_force.hpp>

#include <algorithm>
#include <cmath>

#include <clast/core/random.hpp>

#include <catch.hpp>

static_assert(clast::searches::search<clast::searches::brute_force>);

using namespace clast;
using searches::sphere;
using searches::sphere_pair;
using searches::within;

TEST_CASE("two spheres are neighbours when their gap is below the margin, and not when it equals it") {
    const sphere a{{0, 0, 0}, 1.0, 0}, b{{3, 0, 0}, 0.5, 1}; // gap 1.5
    CHECK(within(a, b, 1.5 + 1e-15 * 8));
    CHECK_FALSE(within(a, b, 1.5));
    CHECK_FALSE(within(a, b, 0.0));
    CHECK(within(a, {{1.25, 0, 0}, 0.5, 1}, 0.0));
    CHECK(within(a, {{1.25, 0, 0}, 0.5, 1}, -0.2)); // overlap 0.25: the gap is -0.25
    CHECK_FALSE(within(a, {{1.25, 0, 0}, 0.5, 1}, -0.3));
    CHECK_FALSE(within(a, b, -4.0)); // a margin that no pair can meet
    CHECK_FALSE(within(a, a, -3.0));
}

TEST_CASE("the neighbour predicate is symmetric, grows with the margin and agrees with the gap") {
    random_stream random{3, 1};
    for (int i = 0; i < 10000; ++i) {
        const sphere a{direction(random), uniform(random, 0.0, 0.5), 0};
        const sphere b{2.0 * direction(random), uniform(random, 0.0, 0.5), 1};
        const double margin = uniform(random, -0.5, 2.0);
        const double gap = norm(b.centre - a.centre) - a.radius - b.radius;
        if (std::abs(gap - margin) < 1e-12) continue;
        REQUIRE(within(a, b, margin) == (gap < margin));
        REQUIRE(within(b, a, margin) == within(a, b, margin));
        if (within(a, b, margin)) REQUIRE(within(a, b, margin + 0.1));
    }
}

TEST_CASE("three spheres in a row have two pairs of neighbours") {
    const std::vector<sphere> row = {{{0, 0, 0}, 1, 0}, {{2.1, 0, 0}, 1, 1}, {{4.2, 0, 0}, 1, 2}};
    const searches::brute_force search;
    CHECK(search.pairs(row, 0.2) == std::vector<sphere_pair>{{0, 1}, {1, 2}});
    CHECK(search.pairs(row, 0.05).empty());
    CHECK(search.pairs(row, 2.3) == std::vector<sphere_pair>{{0, 1}, {0, 2}, {1, 2}});
    CHECK(search.pairs({}, 1.0).empty());
}
