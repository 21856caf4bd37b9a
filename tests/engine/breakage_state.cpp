// SPDX-License-Identifier: MIT
#include <clast/engine/breakage_state.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

TEST_CASE("nothing is asked of a scene where nothing breaks") {
    static_assert(std::is_empty_v<unbroken> && !unbroken::has_balls());
    static_assert(unbroken::add_bond_energy(3.0) == 3.0);
    int calls = 0;
    const bodies::clumps g = scenes::empty(shapes::sphere(0.02));
    unbroken::each_ball(g, [&](std::int32_t, const body_motion&) { ++calls; });
    CHECK(unbroken::largest(g, execution(1), -1.0, [&](std::int32_t, const body_motion&) { return ++calls * 1.0; }) ==
          -1.0);
    CHECK(calls == 0);
}

TEST_CASE("balls, what is bonded and what is in the halo of a grain that was replaced") {
    auto s = scenes::settings<scenes::breakable<>>(1.0, 1e6); // the first touch replaces, and no bond breaks
    s.replacement.check_interval = 1;
    auto e = scenes::collision(std::move(s));
    CHECK(!e.breakage().has_balls());
    while (e.totals().replaced == 0) e.step();
    e.step();
    REQUIRE(e.totals().replaced == 2);
    const breakage_state& b = e.breakage();
    std::vector<std::int32_t> told;
    b.each_ball(e.grains, [&](std::int32_t p, const body_motion& m) {
        told.push_back(p);
        CHECK(&m == &e.grains.motion[e.grains.ball(p)]);
    });
    CHECK(told == std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7});
    CHECK(b.is_bonded(e.grains, {0, 1}));
    CHECK(!b.is_bonded(e.grains, {3, 4}));
    CHECK(e.bonded_pairs().size() == 12);
    CHECK((b.halo[0] == 0 && b.halo[1] == 0)); // no clump is left
    std::vector<vec3> places;
    b.note_places(e.grains, places);
    CHECK(places[5] == e.grains.pebbles[5].x);
    double fastest =
        b.largest(e.grains, execution(1), -1.0, [](std::int32_t, const body_motion& m) { return norm(m.v); });
    for (std::int32_t p : b.balls) CHECK(norm(e.grains.motion[e.grains.ball(p)].v) <= fastest);
    CHECK(fastest > 0.0);
    CHECK(b.add_kinetic_energy(e.grains, 1.0) > 1.0);
    CHECK(b.add_bond_energy(1.0) >= 1.0);
}
