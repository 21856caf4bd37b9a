// SPDX-License-Identifier: MIT
// What a bond that fails leaves behind.
#include <clast/engine/bond_failure.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

TEST_CASE("a failed bond is told by its mother and its name there, and its pair goes on as a contact") {
    using brittle = scenes::breakable<>;
    engine<brittle> e = scenes::collision(scenes::settings<brittle>(1e15));
    scene<brittle> s = e.state();
    rooms::surgery<scene<brittle>> room(s);
    room.release(1);
    room.bond(1, std::vector<bonds::state>(6), 1.0);
    room.finish();
    rooms::renew_lists(s);
    REQUIRE((s.asleep.size() == 6 && s.light.size() == 0));
    // as if it were a frozen part of grain 5
    s.grains.grains[1].origin = 5;
    s.grains.shapes[0].bond_numbers = {10, 11, 12, 13, 14, 15};
    rooms::part(s, 0, bonds::break_report{0, 1, break_mode::shear, {1.0, {}, 0.0, {}}, 0});
    REQUIRE(s.broken.events.size() == 1);
    CHECK((s.broken.events[0].mother == 5 && s.broken.events[0].bond == 11));
    CHECK((s.broken.events[0].mode == break_mode::shear && s.totals.broken_shear == 1));
    CHECK(s.totals.bond_dissipation == s.broken.events[0].energy);
    CHECK(s.broken.events[0].energy == Approx(0.5 / 9.6e8));
    CHECK((s.asleep.size() == 5 && s.light.pairs == std::vector<pebble_pair>{{4, 6}})); // bond 1 joins 0 and 2
    CHECK(s.estimate_due);
}
