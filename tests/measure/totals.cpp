// SPDX-License-Identifier: MIT
#include <clast/measure/totals.hpp>

#include <catch.hpp>

#include "protocol/small_test.hpp"

using namespace clast;
using namespace small_test;

TEST_CASE("a row has the time, the counts and the energies of its engine, each in its place") {
    test_type test(setup(), {compact()});
    recorder watch;
    REQUIRE(test.run(watch));
    const auto& e = test.sim();
    sample s;
    measure::add_totals(e, s);
    CHECK((s.time == e.time() && s.time > 0.0));
    CHECK((s.steps == e.totals().steps && s.dt == e.dt() && s.dt > 0.0));
    CHECK((s.kinetic_energy == e.kinetic_energy() && s.kinetic_energy > 0.0));
    CHECK((s.elastic_energy == e.elastic_energy() && s.elastic_energy > 0.0));
    CHECK((s.friction_dissipation == e.losses().friction && s.damping_dissipation == e.losses().damping));
    CHECK((s.damping_dissipation > 0.0 && s.boundary_work == e.totals().boundary_work));
    CHECK(s.friction_dissipation != s.damping_dissipation);

    struct told {
        engine_totals t;
        const engine_totals& totals() const { return t; }
        static double kinetic_energy() { return 0.0; }
        static double elastic_energy() { return 0.0; }
        static body_losses losses() { return {}; }
        static double time() { return 0.0; }
        static double dt() { return 0.0; }
    } counts;
    counts.t.replaced = 1, counts.t.broken_tension = 2, counts.t.broken_shear = 3, counts.t.bond_dissipation = 4.0;
    measure::add_totals(counts, s);
    CHECK((s.replaced == 1 && s.broken_tension == 2 && s.broken_shear == 3 && s.bond_dissipation == 4.0));
}
