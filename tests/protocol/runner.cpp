// SPDX-License-Identifier: MIT
#include <clast/protocol/runner.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <clast/boundaries/solid_strips.hpp>
#include <clast/fields/gravity.hpp>
#include <clast/io/archive.hpp>
#include <clast/protocol/triaxial.hpp>

#include <catch.hpp>

#include "small_test.hpp"

using namespace clast;
using namespace clast::literals;
using namespace small_test;

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
    CHECK(rows == 41); // at its end, 2 %, once
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

TEST_CASE("extension goes to the strain that it is asked for, and a drive to the other side is refused") {
    stage extend{.name = "extend",
                 .axial = drive_by::inertial_number(-5e-3),
                 .lateral = drive_by::stress(200_kPa),
                 .end = until::axial_strain(-2_percent),
                 .reference_here = true};
    stage back = extend;
    back.name = "back", back.axial.value *= -1.0, back.end = until::axial_strain(-1_percent);
    back.reference_here = false;
    test_type test(setup(), {compact(), consolidate(), extend, back});
    recorder watch;
    REQUIRE(test.run(watch));
    double least = 0.0;
    for (const sample& s : watch.rows) least = s.stage == "extend" ? std::min(least, s.axial_strain) : least;
    CHECK(least == Approx(-0.02).epsilon(2e-3));
    CHECK(watch.rows.back().axial_strain == Approx(-0.01).epsilon(5e-3));

    extend.axial.value *= -1.0;
    test_type wrong(setup(), {compact(), consolidate(), extend});
    std::string said;
    try {
        wrong.run(watch);
    } catch (const input_error& e) {
        said = e.what();
    }
    INFO(said);
    CHECK(said.find("stage 'extend'") != std::string::npos);
    CHECK(said.find("axial strain -2 % from 0 % on, with platens that shorten it") != std::string::npos);
}

TEST_CASE("cycles of loading turn round at the q that they are asked for, however seldom the test looks") {
    const condition high{"q >= 100 kPa", [](const stage_view& v) { return v.q >= 100e3; },
                         [](const stage_view& v) { return std::clamp(v.q / 100e3, 0.0, 1.0); }};
    std::vector<stage> stages{compact(), consolidate()};
    for (int cycle = 0; cycle < 3; ++cycle) {
        stages.push_back(protocol::shear(200_kPa, 20_percent, 1e-3));
        stages.back().reference_here = cycle == 0;
        stages.back().end = high;
        stages.push_back(protocol::unloading(200_kPa, 20_kPa, 1e-3));
    }
    for (const std::int64_t look_every : {100, 3000}) {
        test_type test(setup(), stages);
        test.protocol().plan.look_every = 100;
        struct turns : recorder {
            engine<rigid>* sim = nullptr;
            std::function<void()> sheared;
            void on_stage(const std::string& name, bool begins) override {
                if (begins && name == "shear") sheared();
                if (begins || rows.back().steps != sim->totals().steps) return;
                if (name == "shear") CHECK(rows.back().q == Approx(100e3).epsilon(5e-3));
                if (name == "unload") CHECK(rows.back().q == Approx(20e3).margin(0.5e3));
            }
        } watch;
        watch.sim = &test.sim();
        watch.sheared = [&] { test.protocol().plan.look_every = look_every; };
        REQUIRE(test.run(watch));
    }
}

TEST_CASE("a test that stops on its peak does so where it was stored and resumed on the way, too") {
    // on the way back, where q falls all the time from what the shear has left
    stage back = protocol::unloading(200_kPa, 0_kPa, 1e-5);
    back.end = until::peak_passed(50_percent) || until::axial_strain(-20_percent);
    const std::vector<stage> stages{compact(), consolidate(), protocol::shear(200_kPa, 2_percent, 5e-3), back};
    test_type whole(setup(), stages);
    recorder watch;
    REQUIRE(whole.run(watch));
    const auto first =
        std::find_if(watch.rows.begin(), watch.rows.end(), [](const auto& s) { return s.stage == "unload"; });
    REQUIRE(first != watch.rows.end());
    const sample& end = watch.rows.back();
    CHECK(end.q == Approx(0.5 * first->q).epsilon(0.02));
    REQUIRE(end.steps > first->steps + 200); // looks ago

    struct stopper : recorder {
        bool stop_requested() override { return true; }
    } often;
    auto parts = std::make_unique<test_type>(setup(), stages);
    while (!parts->run(often)) {
        if (parts->protocol().stage_name() != "unload") continue;
        write_archive out;
        out(*parts);
        parts = std::make_unique<test_type>(setup(), stages);
        read_archive in(out.buffer);
        in(*parts);
    }
    CHECK(parts->sim().totals().steps == end.steps);
    CHECK(checksum(parts->sim()) == checksum(whole.sim()));
}

TEST_CASE("a stress target of zero has errors, and a stage that goes there ends") {
    const stage release{.name = "release",
                        .axial = drive_by::stress(0_Pa),
                        .lateral = drive_by::stress(0_Pa),
                        .end = until::stresses_within(0.05),
                        .most_steps = 100'000};
    test_type test(setup(), {compact(), consolidate(), release, rest(100)});
    recorder watch;
    REQUIRE(test.run(watch));
    CHECK(watch.begun.back() == "rest");
    double first = -1.0, last = -1.0;
    for (const sample& s : watch.rows) {
        CHECK(std::isfinite(s.confining_error));
        if (s.stage != "release") continue;
        if (first < 0.0 && s.confining_error > 0.0) first = s.confining_error; // the mean since the row before
        last = s.confining_error;
        if (&s == &watch.rows.back() || (&s + 1)->stage != "release") CHECK(s.sigma_3 < 0.05 * 5e-4 * 2e5);
    }
    CHECK(first > 0.0);
    CHECK(last >= 0.0);
}

TEST_CASE("rows of a consolidation are dense enough to draw e against log p', and not more than that") {
    std::vector<stage> stages = protocol::preparation(66_mm, 75_mm);
    stages.push_back(protocol::consolidation(200_kPa));
    triaxial_setup<rigid> slow = setup();
    slow.inertial_number = 1e-3;
    test_type test(slow, stages);
    test.protocol().plan.row_steps = 1'000'000'000;
    recorder watch;
    REQUIRE(test.run(watch));
    std::vector<double> p;
    for (const sample& s : watch.rows)
        if (s.stage == "consolidate" && s.p > 0.02 * 200e3) p.push_back(s.p);
    CHECK(p.size() >= 15);
    CHECK(p.size() <= 60);
    for (std::size_t k = 1; k + 1 < p.size(); ++k) {
        CHECK(p[k] > 1.1 * p[k - 1]);
        if (p[k - 1] > 0.1 * 200e3) CHECK(p[k] < 1.4 * p[k - 1]); // but for jumps, as where the walls meet the grains
    }
}

TEST_CASE("a fracture tells its stage and the strain of its stage") {
    using policies = scenes::breakable<boundaries::solid_strips>;
    policies::replacement weak{};
    weak.bond.tensile_strength *= 0.01, weak.bond.cohesion *= 0.01;
    triaxial_test<policies> test({.grain = shapes::tetrahedron_4(circumscribed(0.02)),
                                  .diameter = 66_mm,
                                  .height = 75_mm,
                                  .confining = 200_kPa,
                                  .breakage = {criteria::crushing_strength(0.6e6)},
                                  .replacement = weak,
                                  .porosity = 0.6,
                                  .tiles_per_ring = 8,
                                  .inertial_number = 5e-3},
                                 {compact(), consolidate(), protocol::shear(200_kPa, 5_percent, 5e-3)});
    struct listener : recorder {
        std::vector<fracture_event> events;
        void on_events(const std::vector<fracture_event>& e) override {
            events.insert(events.end(), e.begin(), e.end());
        }
    } watch;
    REQUIRE(test.run(watch));
    std::size_t before = 0, in_shear = 0;
    double earlier = 0.0;
    for (const fracture_event& e : watch.events) {
        CHECK((e.stage == "consolidate" || e.stage == "shear"));
        (e.stage == "shear" ? in_shear : before) += 1;
        CHECK(e.axial_strain > -0.02);
        CHECK(e.axial_strain < 0.2); // counted from the vessel of the cloud it would be 0.4 and more
        if (e.stage == "shear") {
            CHECK(e.axial_strain >= earlier);
            CHECK(e.axial_strain <= 0.0501);
            earlier = e.axial_strain;
        }
    }
    CHECK(before > 0);
    CHECK(in_shear > 0);
}

TEST_CASE("the energy of a test under gravity closes in the column of its residual") {
    struct heavy : rigid {
        using field = fields::gravity;
    };
    triaxial_test<heavy> test({.grain = shapes::tetrahedron_4(circumscribed(0.02)),
                               .diameter = 66_mm,
                               .height = 75_mm,
                               .confining = 200_kPa,
                               .breakage = {},
                               .replacement = {},
                               .porosity = 0.6,
                               .tiles_per_ring = 8,
                               .inertial_number = 5e-3},
                              {compact(), consolidate()});
    test.sim().settings.field.acceleration = {0.0, 0.0, -98.1}; // so that it counts beside the work of walls
    test.sim().count_initial_energy();
    recorder watch;
    REQUIRE(test.run(watch));
    const sample& last = watch.rows.back();
    CHECK(std::abs(test.sim().potential_energy()) > 2e-3 * last.boundary_work);
    CHECK(std::abs(last.energy_residual) < 5e-3);
}
