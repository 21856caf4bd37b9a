// SPDX-License-Identifier: MIT
// What a search is for: as long as no sphere has moved by half the skin since the list was made, no touching pair is
// missing from it.
#include <iterator>

#include <clast/searches/cell_grid.hpp>
#include <clast/searches/hierarchical_grid.hpp>

#include "clouds.hpp"

using namespace clast;
using namespace clouds;
using searches::sphere_pair;

namespace {

struct outcome {
    int renewals = 0;
    std::size_t touching = 0; ///< pairs, over all rounds
    std::size_t closed = 0;   ///< of these, pairs that did not touch when the list was made
    std::size_t missed = 0;   ///< of these, pairs that are not in the list of some search
};

/// Moves each sphere in each round by a random step of up to a twentieth of the skin.
outcome wander(random_stream& random, std::vector<sphere> spheres, double skin, int rounds) {
    outcome seen;
    std::vector<sphere> before;
    std::vector<std::vector<sphere_pair>> lists;
    std::vector<sphere_pair> touched, left;
    const auto missing_in = [&](const std::vector<sphere_pair>& list, const std::vector<sphere_pair>& touching) {
        left.clear();
        std::set_difference(touching.begin(), touching.end(), list.begin(), list.end(), std::back_inserter(left));
        return left.size();
    };
    for (int round = 0; round < rounds; ++round) {
        double largest = before.empty() ? skin : 0.0;
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            spheres[i].centre += 0.05 * skin * uniform01(random) * direction(random);
            if (!before.empty()) largest = std::max(largest, norm(spheres[i].centre - before[i].centre));
        }
        const auto touching = searches::brute_force{}.pairs(spheres, 0.0);
        if (2.0 * largest >= skin) {
            lists = {searches::brute_force{}.pairs(spheres, skin), searches::cell_grid{}.pairs(spheres, skin),
                     searches::hierarchical_grid{}.pairs(spheres, skin)};
            before = spheres;
            touched = touching;
            ++seen.renewals;
        }
        seen.touching += touching.size();
        seen.closed += missing_in(touched, touching);
        for (const auto& list : lists) seen.missed += missing_in(list, touching);
    }
    return seen;
}

} // namespace

TEST_CASE("no touching pair is missed in a million random moves of like spheres") {
    random_stream random{5, 1};
    const outcome seen = wander(random, packing(random, 1000), 0.1, 1000);
    CHECK(seen.missed == 0);
    CHECK(seen.renewals > 10); // lists are made anew, but by far not in every round
    CHECK(seen.renewals < 100);
    CHECK(seen.touching > 1000000);
    CHECK(seen.closed > 100000); // a list without skin would miss these
}

TEST_CASE("no touching pair is missed in random moves of spheres of very unlike size") {
    random_stream random{5, 2};
    const outcome seen = wander(random, graded(random, 1000, 20.0), 0.01, 200);
    CHECK(seen.missed == 0);
    CHECK(seen.renewals > 2);
    CHECK(seen.closed > 1000);
}
