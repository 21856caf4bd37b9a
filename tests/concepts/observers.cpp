// SPDX-License-Identifier: MIT
// Nothing has to be overridden: the poorest observers watch a test to its end.
#include <clast/protocol/runner.hpp>

#include <type_traits>

#include <clast/boundaries/solid_strips.hpp>
#include <clast/io/archive.hpp>
#include <clast/protocol/triaxial.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;
using namespace clast::literals;

namespace {

using rigid = scenes::unbreakable<>;
struct blind : observer {};
struct idle : scene_observer<rigid> {};
/// Of another bundle: for a runner of `rigid` it is an observer like others.
struct stranger : scene_observer<scenes::breakable<>> {
    int rows = 0, scenes = 0;
    void on_row(const sample&) override { ++rows; }
    void on_scene(const scene<scenes::breakable<>>&, const sample&) override { ++scenes; }
};
static_assert(std::is_base_of_v<observer, idle> && !std::is_abstract_v<idle> && !std::is_abstract_v<blind>);

std::uint64_t end_of(observer& watch) {
    triaxial_test<rigid> test({.grain = shapes::tetrahedron_4(circumscribed(0.02)),
                               .diameter = 66_mm,
                               .height = 75_mm,
                               .confining = 200_kPa,
                               .breakage = {},
                               .replacement = {},
                               .porosity = 0.6,
                               .tiles_per_ring = 8,
                               .inertial_number = 5e-3},
                              {{.name = "rest", .end = until::steps(200)}});
    CHECK(test.run(watch));
    return checksum(test.sim());
}

} // namespace

TEST_CASE("the poorest observers see a test through, and it ends the same") {
    blind nothing;
    idle scenes;
    stranger other;
    const std::uint64_t end = end_of(nothing);
    CHECK(end_of(scenes) == end);
    CHECK(end_of(other) == end);
    CHECK(other.rows == 2);
    CHECK(other.scenes == 0);
}
