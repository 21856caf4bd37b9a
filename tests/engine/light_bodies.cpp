// SPDX-License-Identifier: MIT
#include <clast/engine/light_bodies.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using brittle = scenes::breakable<>;
constexpr double never = 1e15; // crushing strength that no load reaches (Pa)

} // namespace

TEST_CASE("a replacement never shrinks the step: light bodies take sub-steps") {
    auto s = scenes::settings<brittle>(never);
    engine<brittle> e = scenes::pressed(s, 400.0);
    const double dt = e.dt();
    CHECK(e.light_steps() == 1);
    scenes::set_utilisation(e, 0.95);
    for (int k = 0; k < 200; ++k) {
        e.step();
        REQUIRE(e.dt() >= dt);
    }
    CHECK(e.totals().replaced == 1);
    CHECK(e.grains.is_clump(0) == false);
}
