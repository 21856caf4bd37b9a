// SPDX-License-Identifier: MIT
#include <clast/searches/cell_grid.hpp>

#include <algorithm>
#include <cmath>

#include <clast/core/random.hpp>
#include <clast/searches/brute_force.hpp>

#include <catch.hpp>

using namespace clast;
using searches::sphere;

namespace {

/// Number of pairs; fails unless both searches name the same ones, sorted.
std::size_t compare(const std::vector<sphere>& spheres, double margin) {
    const auto found = searches::cell_grid{}.pairs(spheres, margin);
    REQUIRE(found == searches::brute_force{}.pairs(spheres, margin));
    REQUIRE(std::is_sorted(found.begin(), found.end()));
    return found.size();
}

/// n spheres in a box around `centre`; radii log-uniform between smallest and smallest * ratio.
std::vector<sphere> cloud(random_stream& random, std::size_t n, const vec3& centre, const vec3& half, double smallest,
                          double ratio) {
    std::vector<sphere> s(n);
    for (std::size_t i = 0; i < n; ++i) {
        const vec3 at{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
        s[i] = {centre + scale(half, at), smallest * std::pow(ratio, uniform01(random)), static_cast<std::int32_t>(i)};
    }
    return s;
}

} // namespace

TEST_CASE("the cell grid finds the pairs of the double loop: spheres of like and of unlike size") {
    random_stream random{4, 1};
    std::size_t pairs = 0;
    for (const double ratio : {1.0, 2.0, 5.0, 20.0})
        for (const std::size_t n : {std::size_t{2}, std::size_t{3}, std::size_t{50}, std::size_t{700}})
            for (const double margin : {0.0, 1e-3, 0.02, 0.5, -0.01})
                pairs += compare(cloud(random, n, {}, {1, 1, 1}, 0.03, ratio), margin);
    CHECK(pairs > 10000);
}

TEST_CASE("the cell grid finds the pairs of a few dense clusters far from each other") {
    random_stream random{4, 2};
    std::vector<sphere> all;
    for (const vec3& centre : {vec3{0, 0, 0}, vec3{1000, 0, 0}, vec3{0, -5000, 3}, vec3{1e6, 1e6, 1e6}}) {
        const auto part = cloud(random, 100, centre, {0.3, 0.3, 0.3}, 0.03, 4.0);
        all.insert(all.end(), part.begin(), part.end());
    }
    CHECK(compare(all, 0.01) > 100);
}

TEST_CASE("the cell grid finds the pairs of spheres in a plane, on a line, in one point, and of radius zero") {
    random_stream random{4, 3};
    CHECK(compare(cloud(random, 300, {}, {1, 1, 0}, 0.03, 3.0), 0.01) > 0);
    CHECK(compare(cloud(random, 300, {}, {0, 0, 1}, 0.003, 3.0), 0.001) > 0);
    CHECK(compare(cloud(random, 60, {3, 4, 5}, {}, 0.03, 3.0), 0.0) == 60 * 59 / 2);
    CHECK(compare(cloud(random, 200, {}, {1, 1, 1}, 0.0, 1.0), 0.2) > 0);
    CHECK(compare(cloud(random, 20, {}, {}, 0.0, 1.0), 0.0) == 0);
    CHECK(compare({}, 1.0) == 0);
    CHECK(compare({{{1, 2, 3}, 1.0, 0}}, 1.0) == 0);
}

TEST_CASE("the cell grid finds the pairs far from the origin, where coordinates are coarse") {
    random_stream random{4, 4};
    for (const double far : {1e3, 1e6, 1e9, 1e12})
        for (int i = 0; i < 20; ++i) {
            compare(cloud(random, 100, {far, -far, far}, {4, 4, 4}, 0.4, 2.0), 0.1);
            compare(cloud(random, 100, {}, {far, 1, 1}, 0.1 * far, 2.0), 0.01 * far);
        }
}

TEST_CASE("no rounding of a cell index parts two spheres that just overlap") {
    // a pair on the two sides of a whole cell: the last coordinate before it and the first one behind it, when cells
    // are exactly as wide as the spheres. In real numbers they do not overlap; with rounded coordinates some of them
    // do.
    random_stream random{4, 5};
    int overlapping = 0, lost = 0;
    for (int i = 0; i < 100000; ++i) {
        const double r = uniform(random, 0.1, 1.0), low = i % 2 == 0 ? 0.0 : uniform(random, -1e3, 1e3);
        const double edge = 2.0 * r, k = std::floor(uniform(random, 1, 40));
        const auto cell = [&](double x) { return std::floor((x - low) / edge); };
        double a = low + k * edge, b = low + (k + 1) * edge;
        while (cell(a) >= k) a = std::nextafter(a, -1e9);
        while (cell(std::nextafter(a, 1e9)) < k) a = std::nextafter(a, 1e9);
        while (cell(b) < k + 1) b = std::nextafter(b, 1e9);
        while (cell(std::nextafter(b, -1e9)) >= k + 1) b = std::nextafter(b, -1e9);
        const sphere row[] = {
            {{low, 0, 0}, r, 0}, {{a, 0, 0}, r, 1}, {{b, 0, 0}, r, 2}, {{low + 45 * edge, 0, 0}, r, 3}};
        if (!searches::within(row[1], row[2], 0.0)) continue;
        ++overlapping;
        if (searches::cell_grid{}.pairs(row, 0.0) != searches::brute_force{}.pairs(row, 0.0)) ++lost;
    }
    CHECK(overlapping > 10); // the trap is real
    CHECK(lost == 0);
}

TEST_CASE("the number of cells stays bounded when two spheres are very far apart") {
    CHECK(compare({{{0, 0, 0}, 1e-6, 0}, {{1e9, 1e9, 1e9}, 1e-6, 1}}, 1e-9) == 0);
}
