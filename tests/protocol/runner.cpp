// SPDX-License-Identifier: MIT
#include <clast/protocol/runner.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <clast/boundaries/solid_strips.hpp>
#include <clast/fields/gravity.hpp>
#include <clast/io/archive.hpp>
#include <clast/protocol/triaxial.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;
using namespace clast::literals;

namespace {

using rigid = scenes::unbreakable<boundaries::solid_strips>;
using test_type = triaxial_test<rigid>;

triaxial_setup<rigid> setup() {
    return {.grain = shapes::tetrahedron_4(0.02),
            .diameter = 66_mm,
            .height = 75_mm,
            .confining = 200_kPa,
            .breakage = {},
            .replacement = {},
            .porosity = 0.6,
            .tiles_per_ring = 8,
            .inertial_number = 5e-3};
}
stage compact() { return protocol::preparation(66_mm, 75_mm)[0]; }
stage consolidate() {
    stage s = protocol::consolidation(200_kPa);
    s.end = until::stresses_within(0.02) && until::unbalanced_below(0.02);
    return s;
}
stage rest(std::int64_t n) { return {.name = "rest", .end = until::steps(n)}; }

struct recorder : observer {
    std::vector<std::string> begun;
    std::vector<sample> rows;
    std::function<void()> pause;
    void on_stage(const std::string& name, bool begins) override {
        if (begins) begun.push_back(name);
    }
    void on_row(const sample& s) override { rows.push_back(s); }
    void on_pause() override {
        if (pause) pause();
    }
};
using names = std::vector<std::string>;

/// What a run that must fail says.
failure failure_of(test_type& test, recorder& watch) {
    try {
        test.run(watch);
    } catch (const run_error& e) {
        return e.details;
    }
    return {};
}
void check_complete(const failure& f) {
    CHECK(!f.what.empty());
    CHECK(!f.where.empty());
    CHECK(f.when.find("step") != std::string::npos);
    CHECK(!f.why.empty());
    CHECK(!f.advice.empty());
}

} // namespace

TEST_CASE("a protocol of one's own: isotropic compression, a little shear, and back to no deviator") {
    stage shear = protocol::shear(200_kPa, 2_percent, 5e-3);
    stage unload = protocol::unloading(200_kPa, 5_kPa, 5e-3);
    test_type test(setup(), {compact(), consolidate(), shear, unload});
    recorder watch;
    REQUIRE(test.run(watch));
    CHECK(watch.begun == names{"compact", "consolidate", "shear", "unload"});
    CHECK(test.protocol().finished());
    double peak = 0.0, largest_strain = 0.0;
    bool sheared = false;
    for (const sample& s : watch.rows) {
        if (s.stage == "shear" && !sheared) {
            sheared = true;
            CHECK(s.axial_strain == 0.0); // the reference is here
            CHECK(s.sigma_1 == Approx(2e5).epsilon(0.03));
            CHECK(s.sigma_3 == Approx(2e5).epsilon(0.03));
            CHECK(s.volumetric_strain == 0.0);
        }
        peak = std::max(peak, s.q);
        if (s.stage == "shear") largest_strain = std::max(largest_strain, s.axial_strain);
    }
    CHECK(sheared);
    CHECK(peak > 5e4);
    CHECK(largest_strain == Approx(0.02).epsilon(0.1));
    CHECK(watch.rows.back().q < 5e3);
    CHECK(watch.rows.back().axial_strain < largest_strain);
    // rows of shear are spread by strain
    std::size_t rows = 0;
    for (const sample& s : watch.rows) rows += s.stage == "shear" ? 1 : 0;
    CHECK(rows >= 40);
    CHECK(rows <= 45);
    // columns that follow from others
    const sample& s = watch.rows.back();
    CHECK(s.p == Approx((s.sigma_1 + 2.0 * s.sigma_3) / 3.0));
    CHECK(s.void_ratio == Approx(s.porosity / (1.0 - s.porosity)));
    CHECK(s.volume == Approx(test.sim().boundary.volume()));
    CHECK(std::abs(s.sigma_3_love_weber / s.sigma_3 - 1.0) < 0.03);
}

TEST_CASE("isotropic compression alone is a test, too, and a run goes on from where it was asked to stop") {
    test_type test(setup(), {compact(), consolidate()}), other(setup(), {compact(), consolidate()});
    struct stopper : recorder {
        int looks = 0;
        bool stop_requested() override { return ++looks % 7 == 0; }
    } often;
    int runs = 0;
    while (!test.run(often)) ++runs;
    CHECK(runs > 2);
    recorder once;
    REQUIRE(other.run(once));
    CHECK(checksum(test.sim()) == checksum(other.sim()));
    CHECK(often.begun == names{"compact", "consolidate"});
    CHECK(test.protocol().measure().sigma_1 == Approx(2e5).epsilon(0.02));
}

TEST_CASE("a stage that does not end says what, where, when, why and what to change") {
    stage never{.name = "wait for strain", .end = until::axial_strain(1_percent), .most_steps = 300};
    never.if_stuck = "Move a platen.";
    test_type test(setup(), {never});
    recorder watch;
    const failure f = failure_of(test, watch);
    check_complete(f);
    CHECK(f.what.find("wait for strain") != std::string::npos);
    CHECK(f.what.find("axial strain 1 %") != std::string::npos);
    CHECK(f.where.find("300") != std::string::npos);
    CHECK(f.advice == "Move a platen.");
}

TEST_CASE("a stage that may give up tries its frictions in turn, then the next stage begins") {
    stage relax = protocol::preparation(66_mm, 75_mm)[1];
    relax.end = until::axial_strain(1_percent); // never
    relax.most_steps = 1200;
    stage seat{.name = "seat", .end = until::steps(100), .friction = 0.2, .skip_if_relaxed = true};
    test_type test(setup(), {relax, seat, rest(100)});
    recorder watch;
    std::vector<double> friction;
    watch.pause = [&] {
        const double mu = test.sim().settings.grain_contact.mu;
        if (friction.empty() || friction.back() != mu) friction.push_back(mu);
    };
    REQUIRE(test.run(watch));
    CHECK(friction == std::vector<double>{0.3, 0.15, 0.05, 0.0, 0.2, 0.3});
    CHECK(watch.begun == names{"relax", "seat", "rest"});
}

TEST_CASE("a stage for the unrelaxed is left out where the one before has ended by itself") {
    stage seat{.name = "seat", .end = until::steps(100), .skip_if_relaxed = true};
    test_type test(setup(), {rest(200), seat, rest(100)});
    recorder watch;
    REQUIRE(test.run(watch));
    CHECK(watch.begun == names{"rest", "rest"});
    test_type last(setup(), {rest(200), seat});
    recorder short_one;
    REQUIRE(last.run(short_one));
    CHECK(short_one.begun == names{"rest"});
}

TEST_CASE("a NaN, an escaped grain and pebbles pressed into each other stop the run with an explanation") {
    {
        test_type test(setup(), {rest(2000)});
        test.sim().grains.motion[5].v.x = std::numeric_limits<double>::quiet_NaN();
        recorder watch;
        const failure f = failure_of(test, watch);
        check_complete(f);
        CHECK(f.where == "grain 5");
    }
    {
        test_type test(setup(), {rest(2000)});
        test.protocol().plan.look_every = 1; // the wall would throw it back
        test.sim().grains.motion[7].x = {0.3, 0.0, 0.0};
        recorder watch;
        const failure f = failure_of(test, watch);
        check_complete(f);
        CHECK(f.what.find("grain 7 escaped") != std::string::npos);
        CHECK(f.where.find("rest") != std::string::npos);
    }
    {
        test_type test(setup(), {rest(2000)});
        test.protocol().plan.look_every = 1;
        bodies::clumps& s = test.sim().grains;
        s.turning[1].q = s.turning[0].q;
        s.motion[1].x = s.motion[0].x + vec3{0.002, 0.0, 0.0};
        for (body_motion& m : s.motion) m.v = {};
        recorder watch;
        int step = 0;
        watch.pause = [&] { // held in place until the lists have seen it
            if (++step < 3) s.motion[1].x = s.motion[0].x + vec3{0.002, 0.0, 0.0};
        };
        const failure f = failure_of(test, watch);
        check_complete(f);
        CHECK(f.what.find("overlap") != std::string::npos);
    }
}

TEST_CASE("a stage is announced before its first row and ends after its last") {
    struct listener : observer {
        names heard;
        void on_stage(const std::string& name, bool begins) override { heard.push_back((begins ? "+" : "-") + name); }
        void on_row(const sample& s) override { heard.push_back(s.stage); }
    } watch;
    test_type test(setup(), {rest(100), {.name = "more", .end = until::steps(100)}});
    REQUIRE(test.run(watch));
    CHECK(watch.heard == names{"+rest", "rest", "rest", "-rest", "+more", "more", "more", "-more"});
}

namespace {
struct looker : scene_observer<rigid> {
    std::vector<double> rows, scenes, forces;
    std::vector<std::int64_t> steps;
    int pauses = 0;
    void on_row(const sample& s) override {
        CHECK(rows.size() == scenes.size());
        rows.push_back(s.time);
    }
    void on_scene(const scene<rigid>& s, const sample& row) override {
        scenes.push_back(row.time);
        CHECK(s.totals.steps == row.steps);
        double sum = 0.0;
        s.each_contact([&](const force_row& c, const pebble_pair&) { sum += norm(c.force); });
        forces.push_back(sum);
        for (std::size_t p = 0; p < s.grains.pebble_count(); ++p) { // all of them are where they are
            const body_motion& m = s.grains.motion[s.grains.body_of(static_cast<std::int32_t>(p))];
            const shape_pebble& own = s.grains.shapes[0].pebbles[p % 4];
            const quaternion& q = s.grains.turning[static_cast<std::size_t>(s.grains.mother[p])].q;
            if (norm(s.grains.pebbles[p].x - m.x - rotate(q, own.offset)) > 1e-12) FAIL("pebble " << p);
        }
    }
    std::int64_t every_steps() const override { return 83; }
    void on_step(const scene<rigid>& s) override { steps.push_back(s.totals.steps); }
    bool stop_requested() override { return ++pauses % 3 == 0; }
};
} // namespace

TEST_CASE("an observer of scenes sees each at its row and every so many steps, and changes no bit") {
    const std::vector<stage> stages{compact(), rest(300)};
    test_type test(setup(), stages), stopped(setup(), stages), unseen(setup(), stages);
    looker watch;
    while (!test.run(watch)) {
    }
    CHECK(watch.scenes == watch.rows);
    CHECK(watch.rows.size() >= 4);
    CHECK(watch.forces.back() > 0.0);
    REQUIRE(watch.steps.size() == static_cast<std::size_t>(test.sim().totals().steps / 83));
    for (std::size_t k = 0; k < watch.steps.size(); ++k) CHECK(watch.steps[k] == 83 * static_cast<std::int64_t>(k + 1));

    looker first, second; // another goes on from a checkpoint
    REQUIRE(!stopped.run(first));
    test_type resumed(setup(), stages);
    from_bytes(to_bytes(stopped), resumed);
    while (!resumed.run(second)) {
    }
    first.steps.insert(first.steps.end(), second.steps.begin(), second.steps.end());
    CHECK(first.steps == watch.steps);

    recorder plain;
    REQUIRE(unseen.run(plain));
    CHECK(checksum(test.sim()) == checksum(unseen.sim()));
    CHECK(checksum(resumed.sim()) == checksum(unseen.sim()));
}

TEST_CASE("the energy of a test under gravity closes in the column of its residual") {
    struct heavy : rigid {
        using field = fields::gravity;
    };
    triaxial_test<heavy> test({.grain = shapes::tetrahedron_4(0.02),
                               .diameter = 66_mm,
                               .height = 75_mm,
                               .confining = 200_kPa,
                               .breakage = {},
                               .replacement = {},
                               .porosity = 0.6,
                               .tiles_per_ring = 8,
                               .inertial_number = 5e-3},
                              {compact(), consolidate()});
    test.sim().settings.field.acceleration = {0.0, 0.0, -981.0}; // so that it counts beside the work of walls
    test.sim().count_initial_energy();
    recorder watch;
    REQUIRE(test.run(watch));
    const sample& last = watch.rows.back();
    CHECK(std::abs(test.sim().potential_energy()) > 2e-3 * last.boundary_work);
    CHECK(std::abs(last.energy_residual) < 5e-3);
}

TEST_CASE("a plan without stages is refused") { CHECK_THROWS_AS(test_type(setup(), {}), input_error); }
