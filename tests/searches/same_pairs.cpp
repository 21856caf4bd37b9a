// SPDX-License-Identifier: MIT
// Every search finds the pairs of the double loop, in the same order.
#include <limits>

#include <clast/searches/cell_grid.hpp>
#include <clast/searches/hierarchical_grid.hpp>

#include "clouds.hpp"

using namespace clast;
using namespace clouds;
using searches::cell_grid;
using searches::hierarchical_grid;

TEMPLATE_TEST_CASE("pairs of random clouds, of like and of unlike spheres", "", cell_grid, hierarchical_grid) {
    random_stream random{4, 1};
    std::size_t pairs = 0;
    for (const double ratio : {1.0, 2.0, 5.0, 20.0, 100.0})
        for (const std::size_t n : {std::size_t{2}, std::size_t{3}, std::size_t{50}, std::size_t{700}})
            for (const double margin : {0.0, 1e-3, 0.02, 0.5, -0.01})
                pairs += compare<TestType>(cloud(random, n, {}, {1, 1, 1}, 0.3 / (9.0 + ratio), ratio), margin);
    CHECK(pairs > 10000);
}

TEMPLATE_TEST_CASE("pairs where small spheres fill the space between large ones", "", cell_grid, hierarchical_grid) {
    random_stream random{4, 6};
    for (const double ratio : {1.0, 1.9, 2.1, 4.0, 10.0, 30.0, 100.0})
        for (const double margin : {0.0, 0.01, 0.3, -0.002}) compare<TestType>(graded(random, 2000, ratio), margin);
}

TEMPLATE_TEST_CASE("pairs of a dense packing", "", cell_grid, hierarchical_grid) {
    random_stream random{4, 7};
    const auto spheres = packing(random, 1500);
    std::size_t last = 0;
    for (const double margin : {-0.01, 0.0, 0.03, 0.1, 1.0, 3.0}) {
        const std::size_t pairs = compare<TestType>(spheres, margin);
        CHECK(pairs > last);
        last = pairs;
    }
    CHECK(compare<TestType>(spheres, 100.0) == 1500 * 1499 / 2);
    CHECK(compare<TestType>(spheres, -1.5) == 0);
}

TEMPLATE_TEST_CASE("pairs of a few dense clusters far from each other", "", cell_grid, hierarchical_grid) {
    random_stream random{4, 2};
    std::vector<sphere> all;
    for (const vec3& centre : {vec3{0, 0, 0}, vec3{1000, 0, 0}, vec3{0, -5000, 3}, vec3{1e6, 1e6, 1e6}}) {
        const auto part = cloud(random, 100, centre, {0.3, 0.3, 0.3}, 0.03, 4.0);
        all.insert(all.end(), part.begin(), part.end());
    }
    CHECK(compare<TestType>(all, 0.01) > 100);
}

TEMPLATE_TEST_CASE("pairs of a cloud and of a few spheres that flew away", "", cell_grid, hierarchical_grid) {
    random_stream random{4, 8};
    for (const double far : {10.0, 1e3, 1e7, 1e300}) {
        auto all = cloud(random, 500, {}, {1, 1, 1}, 0.05, 2.0);
        for (const sphere& s : cloud(random, 6, {}, {far, far, far}, 0.05, 2.0)) all.insert(all.begin() + 100, s);
        all.push_back({all[100].centre + vec3{0.05, 0, 0}, 0.05, 506}); // one of them not alone
        CHECK(compare<TestType>(all, 0.01) > 100);
    }
}

TEMPLATE_TEST_CASE("pairs in a plane, on a line, in one point, and of spheres of radius zero", "", cell_grid,
                   hierarchical_grid) {
    random_stream random{4, 3};
    CHECK(compare<TestType>(cloud(random, 300, {}, {1, 1, 0}, 0.03, 3.0), 0.01) > 0);
    CHECK(compare<TestType>(cloud(random, 300, {}, {0, 0, 1}, 0.003, 3.0), 0.001) > 0);
    CHECK(compare<TestType>(cloud(random, 60, {3, 4, 5}, {}, 0.03, 3.0), 0.0) == 60 * 59 / 2);
    CHECK(compare<TestType>(cloud(random, 3000, {3, 4, 5}, {}, 0.03, 3.0), -0.1) < 3000 * 2999 / 2);
    CHECK(compare<TestType>(cloud(random, 200, {}, {1, 1, 1}, 0.0, 1.0), 0.2) > 0);
    CHECK(compare<TestType>(cloud(random, 20, {}, {}, 0.0, 1.0), 0.0) == 0);
    auto mixed = cloud(random, 300, {}, {1, 1, 1}, 0.1, 3.0);
    for (std::size_t i = 0; i < mixed.size(); i += 3) mixed[i].radius = 0.0;
    CHECK(compare<TestType>(mixed, 0.0) > 100);
}

TEMPLATE_TEST_CASE("no sphere has no pairs, nor has one", "", cell_grid, hierarchical_grid) {
    CHECK(compare<TestType>({}, 1.0) == 0);
    CHECK(compare<TestType>({{{1, 2, 3}, 1.0, 0}}, 1.0) == 0);
    CHECK(compare<TestType>({{{1, 2, 3}, 1.0, 0}, {{1, 2, 3}, 1.0, 0}}, 1.0) == 1);
    CHECK(compare<TestType>({{{0, 0, 0}, 1e-6, 0}, {{1e9, 1e9, 1e9}, 1e-6, 1}}, 1e-9) == 0);
}

TEMPLATE_TEST_CASE("pairs far from the origin, where coordinates are coarse", "", cell_grid, hierarchical_grid) {
    random_stream random{4, 4};
    for (const double far : {1e3, 1e6, 1e9, 1e12})
        for (int i = 0; i < 20; ++i) {
            compare<TestType>(cloud(random, 100, {far, -far, far}, {4, 4, 4}, 0.4, 2.0), 0.1);
            compare<TestType>(cloud(random, 100, {}, {far, 1, 1}, 0.1 * far, 2.0), 0.01 * far);
        }
}

TEMPLATE_TEST_CASE("pairs of spheres on the borders of cells, and a last bit beside them", "", cell_grid,
                   hierarchical_grid) {
    // cells are 0.4 and 1.2 of the reach wide
    for (const vec3& step :
         {vec3{0.5, 1.5, 1.5}, vec3{0.5, 0.75, 0.75}, vec3{1.25, 1.5, 0.375}, vec3{1.25, 1.25, 1.25}})
        for (const double low : {0.0, -3.0, 0.1}) {
            auto spheres = lattice(7, {low, low, low}, step, 0.5);
            compare<TestType>(spheres, 0.25);
            for (std::size_t i = 0; i < spheres.size(); ++i)
                for (int a = 0; a < 3; ++a) {
                    double& c = spheres[i].centre[a];
                    c = std::nextafter(c, static_cast<double>(static_cast<int>((i >> a) % 3)) * 100.0 - 100.0);
                }
            compare<TestType>(spheres, 0.25);
        }
}

TEMPLATE_TEST_CASE("where gaps equal the margin but for rounding, all searches round alike", "", cell_grid,
                   hierarchical_grid) {
    for (const double step : {0.1, 0.3, 1.0 / 3.0, 0.7})
        for (const double margin : {0.0, 0.01, -0.01})
            for (const double turn : {0.0, 0.3, 1.1}) {
                auto spheres = lattice(8, {0.1, 0.2, 0.3}, {step, step, step}, 0.5 * (step - margin));
                for (sphere& s : spheres) {
                    const vec3 c = s.centre;
                    s.centre = {std::cos(turn) * c.x - std::sin(turn) * c.y,
                                std::sin(turn) * c.x + std::cos(turn) * c.y, c.z};
                }
                compare<TestType>(spheres, margin);
            }
}

TEMPLATE_TEST_CASE("what is not a number is near to nothing", "", cell_grid, hierarchical_grid) {
    random_stream random{4, 9};
    auto spheres = cloud(random, 200, {}, {1, 1, 1}, 0.1, 2.0);
    const std::size_t whole = compare<TestType>(spheres, 0.01);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    spheres[0].centre.x = nan, spheres[50].centre.z = infinity, spheres[80].centre = {-infinity, nan, 0.0};
    CHECK(compare<TestType>(spheres, 0.01) < whole);
    for (sphere& s : spheres) s.centre.y = infinity;
    CHECK(compare<TestType>(spheres, 0.01) == 0);
    CHECK(compare<TestType>(spheres, nan) == 0);
}
