// SPDX-License-Identifier: MIT
// A small test in a rigid wall, and someone who notes what it reports.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <clast/boundaries/solid_strips.hpp>
#include <clast/protocol/triaxial.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

namespace small_test {

using namespace clast;
using namespace clast::literals;

using rigid = scenes::unbreakable<boundaries::solid_strips>;
using test_type = triaxial_test<rigid>;

inline triaxial_setup<rigid> setup() {
    return {.grain = shapes::tetrahedron_4(circumscribed(0.02)),
            .diameter = 66_mm,
            .height = 75_mm,
            .confining = 200_kPa,
            .breakage = {},
            .replacement = {},
            .porosity = 0.6,
            .tiles_per_ring = 8,
            .materials = table_1::of_pieces(),
            .inertial_number = 5e-3};
}
/// Without regard for what it loads the grains with, so that it takes few steps.
inline stage compact() {
    stage s = protocol::preparation(66_mm, 75_mm)[0];
    s.yields_at = 0.0;
    return s;
}
inline stage consolidate() {
    stage s = protocol::consolidation(200_kPa);
    s.end = until::stresses_within(0.02) && until::unbalanced_below(0.02);
    s.walls_at_rest = false; // in few steps
    return s;
}
inline stage rest(std::int64_t n) { return {.name = "rest", .end = until::steps(n)}; }

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
inline failure failure_of(test_type& test, recorder& watch) {
    try {
        test.run(watch);
    } catch (const run_error& e) {
        return e.details;
    }
    return {};
}
inline void check_complete(const failure& f) {
    CHECK(!f.what.empty());
    CHECK(!f.where.empty());
    CHECK(f.when.find("step") != std::string::npos);
    CHECK(!f.why.empty());
    CHECK(!f.advice.empty());
}

} // namespace small_test
