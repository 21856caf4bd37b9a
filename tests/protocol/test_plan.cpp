// SPDX-License-Identifier: MIT
#include <clast/protocol/test_plan.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <catch.hpp>

#include "small_test.hpp"

using namespace clast;
using namespace small_test;

TEST_CASE("a plan without stages is refused") { CHECK_THROWS_AS(test_type(setup(), {}), input_error); }

TEST_CASE("drives that count in parts of the setup take its sizes, stress and inertial number, others stay") {
    using kind = axis_drive::kind;
    test_plan p;
    p.radius = 2.0, p.height = 3.0, p.confining = 5.0, p.inertial_number = 7.0;
    const auto add = [&](kind how, bool of_setup) {
        stage s = rest(1);
        s.axial = s.lateral = {how, 0.5, of_setup};
        p.stages.push_back(s);
    };
    add(kind::reach, true), add(kind::stress, true), add(kind::inertial, true), add(kind::rate, true);
    add(kind::stress, false);
    const test_plan done = protocol::completed(p, false);
    CHECK(done.stages[0].axial.value == 1.5);
    CHECK(done.stages[0].lateral.value == 1.0);
    CHECK(done.stages[1].axial.value == 2.5);
    CHECK(done.stages[1].lateral.value == 2.5);
    CHECK(done.stages[2].axial.value == 3.5);
    CHECK(done.stages[3].axial.value == 0.5);
    CHECK(done.stages[4].lateral.value == 0.5);
    for (const stage& s : done.stages) CHECK((!s.axial.of_setup && !s.lateral.of_setup));
}

TEST_CASE("a condition that keeps a state by reference is refused, and one that keeps it in its memory is not") {
    const auto said = [](condition end, axis_drive lateral = {}) -> std::string {
        test_plan p;
        p.stages = {{.name = "shear", .lateral = std::move(lateral), .end = std::move(end)}};
        try {
            (void)protocol::completed(p, false);
        } catch (const input_error& e) {
            return e.what();
        }
        return {};
    };
    const auto none = [](const stage_view&) { return 0.0; };
    double peak = 0.0;
    const condition by_reference{"past its peak",
                                 [&peak](const stage_view& v) {
                                     peak = std::max(peak, v.q);
                                     return v.q < 0.9 * peak;
                                 },
                                 none};
    CHECK(said(by_reference).find("'past its peak'") != std::string::npos);
    peak = 0.0;
    CHECK(said(by_reference).find("stage_view::memory") != std::string::npos);
    peak = 0.0;
    CHECK_FALSE(said(by_reference || until::steps(5)).empty());
    const auto shared = std::make_shared<double>(0.0);
    const auto lowest = [shared](const stage_view& v) { return *shared = std::max(*shared, v.q); };
    CHECK(said(until::steps(5), drive_by::stress_that(lowest)).find("a target") != std::string::npos);
    *shared = 0.0;
    CHECK_FALSE(said({"steps", [](const stage_view& v) { return v.steps > 10; }, lowest}).empty());
    double limit = 2e5; // only read
    CHECK(said({"q", [&limit](const stage_view& v) { return v.q > limit; }, none}).empty());
    CHECK(said(until::peak_passed(quantities::ratio{0.1}) || until::axial_strain(quantities::ratio{0.1})).empty());
    CHECK(said({"nothing", [](const stage_view&) { return false; }, [](const stage_view&) { return std::nan(""); }})
              .empty());
}
