// SPDX-License-Identifier: MIT
#include <clast/protocol/test_plan.hpp>

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
