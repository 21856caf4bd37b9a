// SPDX-License-Identifier: MIT
#include <clast/engine/grain_view.hpp>

#include <algorithm>
#include <vector>

#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

TEST_CASE("a policy sees the load, the neighbours and the motion of a clump") {
    using P = scenes::breakable<>;
    auto e = scenes::pressed(scenes::settings<P>(1e15), 300.0);
    e.settings.replacement.check_interval = 1;
    scenes::set_utilisation(e, 0.6); // below the trigger
    e.step();                        // with rows, indexed
    const rooms::grain_view<scene<P>> view(e.state(), 0);
    CHECK(view.grain() == 0);
    CHECK(view.id() == 0);
    CHECK(view.utilisation() == Approx(0.6).epsilon(1e-6));
    CHECK(view.neighbours() == 2); // platens
    const std::vector<bonds::pebble_load> loads = view.pebble_loads();
    REQUIRE(loads.size() == 4);
    double most = 0.0;
    for (const bonds::pebble_load& l : loads) most = std::max(most, norm(l.force));
    CHECK(most == Approx(scenes::load(e)).epsilon(1e-6));
    CHECK(&view.shape() == &e.grains.shapes[0]);
    CHECK(view.lattice().size() == 4);
    CHECK(&view.centre() == &e.grains.motion[0].x);
    CHECK(&view.velocity() == &e.grains.motion[0].v);
    CHECK(&view.spin() == &e.grains.motion[0].w);
    CHECK(&view.orientation() == &e.grains.turning[0].q);
}
