// SPDX-License-Identifier: MIT
// What is particular to the cell grid; that it finds the right pairs is in same_pairs.cpp.
#include <clast/searches/cell_grid.hpp>

#include <numeric>

#include "clouds.hpp"

static_assert(clast::searches::search<clast::searches::cell_grid>);

using namespace clast;
using namespace clouds;
using searches::detail::cell_rows;

namespace {

cell_rows sorted(const std::vector<sphere>& spheres, double margin) {
    std::vector<std::int32_t> all(spheres.size());
    std::iota(all.begin(), all.end(), 0);
    return cell_rows(spheres, all, margin);
}
/// Spheres in the cell of a point.
std::size_t crowd(const cell_rows& g, const vec3& at) {
    const std::size_t cx = g.cell(0, at.x);
    const auto run = g.run({cx, cx}, g.cell(1, at.y), g.cell(2, at.z));
    return run.last - run.first;
}

} // namespace

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

TEST_CASE("every sphere is in the cell of its centre, and in no other") {
    random_stream random{4, 10};
    const auto spheres = cloud(random, 1000, {1, 2, 3}, {2, 1, 1}, 0.1, 2.0);
    const cell_rows g = sorted(spheres, 0.01);
    REQUIRE(g.size() == spheres.size());
    std::vector<int> seen(spheres.size(), 0);
    for (std::size_t k = 0; k < g.size(); ++k) {
        const sphere& s = spheres[static_cast<std::size_t>(g.index[k])];
        ++seen[static_cast<std::size_t>(g.index[k])];
        REQUIRE(vec3{g.x[k], g.y[k], g.z[k]} == s.centre);
        REQUIRE(g.radius[k] == s.radius);
        const std::size_t cx = g.cell(0, s.centre.x);
        const auto run = g.run({cx, cx}, g.cell(1, s.centre.y), g.cell(2, s.centre.z));
        REQUIRE(run.first <= k);
        REQUIRE(k < run.last);
    }
    CHECK(std::count(seen.begin(), seen.end(), 1) == 1000);
}

TEST_CASE("a few spheres that flew away do not crowd the others into one cell") {
    random_stream random{4, 11};
    auto spheres = cloud(random, 5000, {}, {1, 1, 1}, 0.05, 1.0);
    const cell_rows close = sorted(spheres, 0.005);
    std::size_t most = 0;
    for (const sphere& s : spheres) most = std::max(most, crowd(close, s.centre));
    CHECK(most < 30);
    for (int i = 0; i < 10; ++i) spheres.push_back({1e6 * direction(random), 0.05, 5000 + i});
    const cell_rows wide = sorted(spheres, 0.005);
    for (const sphere& s : spheres) REQUIRE(crowd(wide, s.centre) <= 2 * most);
}

TEST_CASE("the cells suit the radii: the estimate of a search among like spheres does not grow with their number") {
    random_stream random{4, 12};
    const auto few = graded(random, 1000, 1.0), many = graded(random, 20000, 1.0);
    CHECK(sorted(many, 0.1).cost(1.1) < 1.5 * sorted(few, 0.1).cost(1.1));
    CHECK(sorted(many, 0.1).cost(1.1) < 20.0);
    CHECK(sorted(many, 0.1).cost(2.2) > 2.0 * sorted(many, 0.1).cost(1.1));
}
