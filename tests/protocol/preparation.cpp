// SPDX-License-Identifier: MIT
#include <clast/protocol/preparation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <catch.hpp>

#include "small_test.hpp"

using namespace clast;
using namespace small_test;

TEST_CASE("free grains that are moved have the velocities of a uniform strain, no spin, and their energy is booked") {
    test_type test(setup(), {rest(100)});
    auto& sim = test.sim();
    sim.grains.set_spin(3, {1.0, 2.0, 3.0});
    sim.count_initial_energy();
    const double open = sim.totals().initial_energy - sim.kinetic_energy();
    protocol::move_free_grains(sim, 0.7, 0.3);
    double kinetic = 0.0;
    for (std::size_t b = 0; b < sim.grains.body_count(); ++b) {
        const vec3 x = sim.grains.centre(b);
        const vec3 v{-0.3 * x.x, -0.3 * x.y, -0.7 * x.z}; // the vessel stands around 0
        CHECK(norm(sim.grains.velocity(b) - v) < 1e-15);
        CHECK(norm(sim.grains.spin(b)) == 0.0);
        kinetic += 0.5 * sim.grains.body_mass(b) * norm2(v);
    }
    CHECK(sim.kinetic_energy() == Approx(kinetic));
    CHECK(sim.totals().initial_energy - sim.kinetic_energy() == Approx(open).margin(1e-12 * kinetic));
    protocol::stop_grains(sim);
    CHECK(sim.kinetic_energy() == 0.0);
    CHECK(std::abs(sim.totals().initial_energy - open) < 1e-12 * kinetic);
}

TEST_CASE("grains that touch something are left to their contacts until all shall stop") {
    test_type test(setup(), {compact()});
    auto& sim = test.sim();
    recorder watch;
    REQUIRE(test.run(watch));
    protocol::stop_grains(sim);
    CHECK(sim.kinetic_energy() == 0.0);
    sim.step();
    const std::vector<std::uint8_t> touch = protocol::touching(sim);
    const auto before = sim.grains;
    protocol::move_free_grains(sim, 1.0, 1.0);
    std::size_t free = 0, held = 0;
    for (std::size_t b = 0; b < before.body_count(); ++b) {
        const bool as_before = norm(sim.grains.velocity(b) - before.velocity(b)) == 0.0;
        CHECK(as_before == (touch[b] != 0));
        ++(touch[b] != 0 ? held : free);
    }
    CHECK(held > 3);
    CHECK(free > 3);
    std::size_t pressed = 0; // whoever a contact has moved in this step has touched something
    for (std::size_t b = 0; b < before.body_count(); ++b) pressed += norm(before.velocity(b)) > 0.0 ? 1u : 0u;
    CHECK(pressed == held);
}

TEST_CASE("rest is the paper's two conditions, or neither force nor motion where there is no network") {
    const condition rests = protocol::at_rest(5e-4);
    stage_view v;
    v.steps = 5000;
    struct state {
        double unbalanced, spheres, force, kinetic, coordination; // 1, Pa, N, Pa, 1
    };
    const auto ends = [&](double stress, double length, const state& s) {
        v.confining = 2e6 * stress, v.grain_diameter = 0.02 * length;
        v.unbalanced_ratio = s.unbalanced, v.sphere_stress = s.spheres * stress;
        v.mean_contact_force = s.force * stress * length * length, v.kinetic_density = s.kinetic * stress;
        v.coordination = s.coordination;
        return rests.met(v);
    };
    for (const double stress : {1.0, 0.01, 100.0})
        for (const double length : {1.0, 10.0}) {
            const auto at = [&](const state& s) { return ends(stress, length, s); };
            CHECK(at({9e-4, 990.0, 10.0, 1.0, 4.0})); // a network at rest, under hardly any stress
            CHECK(rests.reason(v) ==
                  "unbalanced ratio < 0.1 % and p' < 0.05 % of the confining stress in three spheres");
            CHECK_FALSE(at({1.1e-3, 990.0, 10.0, 1.0, 4.0}));
            CHECK_FALSE(at({9e-4, 1010.0, 10.0, 1.0, 4.0}));
            CHECK(at({177.0, 1e4, 0.79, 0.19, 0.9})); // grains that lie about
            CHECK(rests.reason(v).find("coordination < 1 and mean contact force") == 0);
            CHECK_FALSE(at({177.0, 1e4, 0.81, 0.19, 0.9})); // something presses
            CHECK_FALSE(at({177.0, 1e4, 0.79, 0.21, 0.9})); // they fly
            CHECK_FALSE(at({177.0, 1e4, 0.79, 0.19, 1.1})); // a network that is not at rest
        }
}

namespace {

/// A toy of the paper's stress and rates.
template <class Watch> std::vector<stage_record> prepare(const shape& grain, double porosity, Watch& watch) {
    triaxial_setup<rigid> s = setup();
    s.grain = grain, s.porosity = porosity, s.confining = 2_MPa, s.inertial_number = 1e-3;
    std::vector<stage> stages = protocol::preparation();
    stages.push_back(rest(100)); // in the place of the consolidation
    test_type test(s, stages);
    watch.pause = [&] { watch.last_friction = test.sim().friction(); };
    REQUIRE(test.run(watch));
    return test.protocol().records();
}
struct listener : recorder {
    std::vector<std::string> notes;
    double last_friction = -1.0;
    void on_note(const std::string& text) override { notes.push_back(text); }
};

} // namespace

TEST_CASE("no stage of the preparation loads grains beyond 1 % of the stress to come, whatever their shape") {
    for (const shape& grain :
         {shapes::tetrahedron_4(circumscribed(0.02)), shapes::apollonian_14(circumscribed(0.02))}) {
        INFO(grain.name);
        listener watch;
        const std::vector<stage_record> all = prepare(grain, 0.62, watch);
        for (const stage_record& s : all) CHECK(s.largest_p < 0.01 * 2e6);
        CHECK(watch.last_friction == 0.3); // as the material has it
        const stage_record& relaxed = all[all.size() - 2];
        CHECK(relaxed.reached);
        CHECK(relaxed.p < 2e3);
        // its size, or as near as it gets; then it says so
        if (all[0].reached)
            CHECK(relaxed.porosity == Approx(0.62).margin(0.01)); // a grain more or less
        else
            CHECK(watch.notes.at(0).find("compact: jammed short of 'target size': porosity 0.6") == 0);
        for (const sample& s : watch.rows)
            if (s.stage == "compact") CHECK(std::abs(s.energy_residual) < 0.01);
    }
}

TEST_CASE("a specimen that jams short of its size tries the same frictions in turn, and says that it is out of reach") {
    listener watch;
    const std::vector<stage_record> all =
        prepare(shapes::apollonian_14(circumscribed(0.02)), 0.45, watch); // denser than can be
    CHECK_FALSE(all[0].reached);
    CHECK(all[0].friction == 0.0);
    CHECK(all[0].largest_p > 0.005 * 2e6); // walls have pressed
    CHECK(all[0].porosity > 0.5);
    CHECK(all[0].porosity < 0.64); // dense, though: without friction
    REQUIRE(watch.notes.size() >= 1);
    CHECK(watch.notes[0].find("compact: jammed short of 'target size'") == 0);
    CHECK(watch.notes[0].find("friction 0") != std::string::npos);
    CHECK(watch.last_friction == 0.3);
    for (const stage_record& s : all) CHECK(s.largest_p < 0.01 * 2e6);
}
