// SPDX-License-Identifier: MIT
#include <clast/measure/pebbles.hpp>

#include <cstddef>
#include <vector>

#include <catch.hpp>

#include "protocol/small_test.hpp"

using namespace clast;
using namespace small_test;

TEST_CASE("pictures show pebbles where they are, of which grain, and how far from where they were") {
    test_type test(setup(), {rest(100)});
    auto& e = test.sim();
    e.place_all();
    std::vector<vec3> before;
    for (const auto& one : e.grains.pebbles) before.push_back(one.x);
    for (const pebble_view& v : measure::pebbles_of(e, {})) REQUIRE(v.displacement == vec3{});
    e.step(10);
    const std::vector<pebble_view> seen = measure::pebbles_of(e, before);
    REQUIRE(seen.size() == before.size());
    double farthest = 0.0;
    for (std::size_t p = 0; p < seen.size(); ++p) {
        REQUIRE(seen[p].position - before[p] == seen[p].displacement);
        REQUIRE(seen[p].radius == e.grains.pebbles[p].radius);
        REQUIRE(seen[p].grain == static_cast<std::int32_t>(p / 4)); // of four pebbles each
        REQUIRE(seen[p].fragment == static_cast<std::int32_t>(p / 4 * 4));
        REQUIRE(seen[p].state == pebble_state::clump);
        const body_motion& m = e.grains.motion[p / 4];
        REQUIRE(norm(seen[p].velocity - m.v - cross(m.w, seen[p].position - m.x)) < 1e-12);
        farthest = std::max(farthest, norm(seen[p].displacement));
    }
    CHECK(farthest > 0.0);
}
