// SPDX-License-Identifier: MIT
// What is particular to the hierarchical grid; that it finds the right pairs is in same_pairs.cpp.
#include <clast/searches/hierarchical_grid.hpp>

#include <clast/searches/cell_grid.hpp>

#include "clouds.hpp"

static_assert(clast::searches::search<clast::searches::hierarchical_grid>);

using namespace clast;
using namespace clouds;
using searches::hierarchical_grid;

TEST_CASE("a large sphere among many small ones finds all of them, from whichever side levels are searched") {
    random_stream random{6, 1};
    // few large among many small, and the other way round: the estimate turns the search
    for (const std::size_t large : {std::size_t{1}, std::size_t{30}, std::size_t{900}})
        for (const double ratio : {2.5, 10.0, 100.0}) {
            auto spheres = cloud(random, 1000 - large, {}, {1, 1, 1}, 0.3 / ratio, 1.0);
            for (const sphere& s : cloud(random, large, {}, {1, 1, 1}, 0.3, 1.0)) spheres.push_back(s);
            CHECK(compare<hierarchical_grid>(spheres, 0.001) > 5 * large);
            std::reverse(spheres.begin(), spheres.end()); // the large ones are the first of their pairs, or the second
            compare<hierarchical_grid>(spheres, 0.001);
        }
}

TEST_CASE("sizes over twenty orders of magnitude share the smallest level") {
    random_stream random{6, 2};
    auto spheres = cloud(random, 1500, {}, {1, 1, 1}, 1e-20, 1e20);
    CHECK(compare<hierarchical_grid>(spheres, 0.0) > 100);
    CHECK(compare<hierarchical_grid>(spheres, 1e-3) > 100);
}

TEST_CASE("like spheres have one level, with the pairs of the cell grid") {
    random_stream random{6, 3};
    const auto spheres = cloud(random, 20000, {}, {1, 1, 1}, 0.03, 1.05);
    CHECK(hierarchical_grid{}.pairs(spheres, 0.003) == searches::cell_grid{}.pairs(spheres, 0.003));
}
