// SPDX-License-Identifier: MIT
#include <clast/protocol/observer.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include <clast/io/archive.hpp>
#include <clast/measure/digest.hpp>

#include <catch.hpp>

#include "small_test.hpp"

using namespace clast;
using namespace small_test;

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
