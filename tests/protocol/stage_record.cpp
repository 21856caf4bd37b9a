// SPDX-License-Identifier: MIT
#include <clast/protocol/stage_record.hpp>

#include <vector>

#include <clast/io/archive.hpp>

#include <catch.hpp>

#include "small_test.hpp"

using namespace clast;
using namespace small_test;

TEST_CASE("the record of a stage goes through an archive, every member of it") {
    const stage_record before{"relax", "at rest", false, 1.0, 2.0, 0.3, 4.0, 0.5, 6e-4, 7};
    stage_record after;
    from_bytes(to_bytes(before), after);
    CHECK(after.name == "relax");
    CHECK(after.end == "at rest");
    CHECK_FALSE(after.reached);
    CHECK(after.largest_p == 1.0);
    CHECK(after.p == 2.0);
    CHECK(after.friction == 0.3);
    CHECK(after.coordination == 4.0);
    CHECK(after.porosity == 0.5);
    CHECK(after.unbalanced_ratio == 6e-4);
    CHECK(after.steps == 7);
}

TEST_CASE("a run keeps a record of every stage: what ended it, its largest stress, friction and state") {
    stage slide = rest(300);
    slide.name = "slide", slide.friction = 0.1;
    slide.end = until::axial_strain(99_percent) || (until::steps(300) && until::unloaded(1e9_N));
    slide.end = std::move(slide.end) || until::steps(2000);
    test_type test(setup(), {compact(), slide});
    recorder watch;
    REQUIRE(test.run(watch));
    const std::vector<stage_record>& all = test.protocol().records();
    REQUIRE(all.size() == 2);
    CHECK(all[0].name == "compact");
    CHECK(all[0].end == "target size");
    CHECK(all[0].reached);
    CHECK(all[0].friction == 0.3);
    CHECK(all[1].end == "300 steps and mean contact force < 1e+09 N"); // not the other two ways
    CHECK(all[1].friction == 0.1);
    CHECK(all[1].steps ==
          1001);          // `unloaded` waits for a thousand; with a strain in it the condition is asked every step
    double largest = 0.0; // of the rows; looks are more frequent
    for (const sample& s : watch.rows)
        if (s.stage == "compact") largest = std::max(largest, s.p);
    CHECK(all[0].largest_p >= largest);
    CHECK(all[0].largest_p > 0.0);
    CHECK(all[1].p == watch.rows.back().p);
    CHECK(all[1].porosity == watch.rows.back().porosity);
    CHECK(all[1].coordination == watch.rows.back().coordination);
}
