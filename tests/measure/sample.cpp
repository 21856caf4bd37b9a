// SPDX-License-Identifier: MIT
#include <clast/measure/sample.hpp>

#include <catch.hpp>

using namespace clast;

TEST_CASE("a new sample, event and view are empty, with ids that name nothing") {
    const sample s;
    CHECK((s.time == 0.0 && s.steps == 0 && s.broken_tension == 0 && s.broken_shear == 0 && s.stage.empty()));
    CHECK((s.sigma_1 == 0.0 && s.energy_residual == 0.0));
    const fracture_event e;
    CHECK((e.mother == -1 && e.bond == -1 && e.energy == 0.0));
    const pebble_view p;
    CHECK((p.grain == -1 && p.fragment == -1 && p.state == pebble_state::clump));
    const facet_view f;
    CHECK((f.ring == -1 && f.tile == -1 && f.area == 0.0));
}
