// SPDX-License-Identifier: MIT
#include <clast/protocol/standstill.hpp>

#include <cmath>
#include <string>

#include <catch.hpp>

#include "small_test.hpp"

using namespace clast;
using namespace small_test;

TEST_CASE("a state that stays the same is a standstill after so many steps, a state that creeps is none") {
    constexpr std::int64_t span = protocol::standstill::span;
    const auto first = [](auto&& at) { // step at which it is seen
        protocol::standstill s;
        for (std::int64_t step = 100; step <= 10 * span; step += 100)
            if (s.look(step, at(static_cast<double>(step)), 2e6)) return step;
        return std::int64_t{0};
    };
    using state = protocol::standstill::state;
    const state one{2e6, 1.99e6, 2e-3, 1e-3};
    CHECK(first([&](double) { return one; }) == span + 100);
    // two states by turns, as walls that turn round in every step
    const auto flicker = [&](double by) {
        return first([&, by](double t) {
            state s = one;
            s[1] += by * (std::fmod(t, 200.0) > 0.0 ? 1.0 : 0.0);
            return s;
        });
    };
    CHECK(flicker(390.0) == span + 100);
    CHECK(flicker(410.0) == 0); // more than 2e-4 of the stress
    for (std::size_t k = 0; k < one.size(); ++k) {
        const state limit{400.0, 400.0, 5e-3, 2e-8};
        const auto creep = [&](double speed) {
            return first([&, speed](double t) {
                state s = one;
                s[k] += speed * limit[k] * t / static_cast<double>(span);
                return s;
            });
        };
        CHECK(creep(1.2) == 0);
        CHECK(creep(0.8) == span + 100);
    }
    CHECK(first([&](double t) { // rests, but later
              state s = one;
              if (t <= 5000.0) s[0] += t;
              return s;
          }) == span + 5100);
    CHECK(first([&](double) { return state{2e6, 2e6, std::nan(""), 1e-3}; }) == 0);
}

namespace {

/// Walls that cannot turn a stress into the one that the end asks for.
stage never(double target) {
    stage s = consolidate();
    s.end = until::axial_strain(99_percent); // whatever the specimen does
    s.axial = s.lateral = drive_by::stress(quantities::stress{target});
    return s;
}
struct listener : recorder {
    std::vector<std::string> notes;
    void on_note(const std::string& text) override { notes.push_back(text); }
};

} // namespace

TEST_CASE("a consolidation in which nothing changes any more ends so, in its record and in a note, or stops the run") {
    listener watch;
    test_type test(setup(), {compact(), never(2e5), rest(100)});
    REQUIRE(test.run(watch));
    CHECK(watch.begun == names{"compact", "consolidate", "rest"});
    const stage_record& end = test.protocol().records().at(1);
    CHECK_FALSE(end.reached);
    CHECK(end.end.find("nothing changes any more: over 20000 steps") == 0);
    CHECK(end.end.find("short of 'axial strain 99 %'") != std::string::npos);
    CHECK(end.steps > protocol::standstill::span);
    CHECK(end.steps < 200'000);
    REQUIRE(watch.notes.size() == 1);
    CHECK(watch.notes[0] == "consolidate: " + end.end);

    // walls that hold still, at a stress that is not the one asked for
    stage held = never(2e5);
    held.axial = held.lateral = drive_by::hold();
    held.end = until::unbalanced_below(0.0);
    listener other;
    test_type stuck(setup(), {compact(), held});
    const failure f = failure_of(stuck, other);
    check_complete(f);
    CHECK(f.why.find("nothing changes any more") == 0);
}
