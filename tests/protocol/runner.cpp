// SPDX-License-Identifier: MIT
#include <clast/protocol/runner.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <clast/boundaries/solid_strips.hpp>
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

TEST_CASE("a plan without stages is refused") { CHECK_THROWS_AS(test_type(setup(), {}), input_error); }
