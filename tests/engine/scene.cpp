// SPDX-License-Identifier: MIT
#include <clast/engine/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/io/archive.hpp>
#include <clast/spaces/periodic.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using spheres_alone = scenes::unbreakable_spheres<>;
struct in_a_cell : spheres_alone {
    using space = spaces::periodic;
};
template <class P> engine_settings<P> settings() {
    return {.grain_contact = {1e6, 0.0, 0.0},
            .platen_contact = {},
            .lateral_contact = {},
            .breakage = {},
            .replacement = {}};
}

} // namespace

TEST_CASE("what is absent takes no room in a scene: no wall, no space, no breakage") {
    static_assert(std::is_empty_v<boundaries::none> && std::is_empty_v<spaces::open> && std::is_empty_v<unbroken>);
    static_assert(!scene<spheres_alone>::has_walls && scene<scenes::unbreakable<>>::has_walls); // no code either
    static_assert(std::is_same_v<decltype(scene<spheres_alone>::broken), unbroken>);
    static_assert(std::is_same_v<decltype(scene<scenes::breakable<>>::broken), breakage_state>);
    using none = scene<scenes::unbreakable<>>;
    static_assert(std::is_same_v<decltype(none::replacing), nothing_replaced> && std::is_empty_v<nothing_replaced>);
    static_assert(std::is_same_v<none::work, range_work> && !none::replaces && !none::breakable);
    using replaces = replacement_state<replacements::modified>;
    static_assert(sizeof(none) + sizeof(breakage_state) + sizeof(replaces) <= sizeof(scene<scenes::breakable<>>));
    static_assert(sizeof(scene<in_a_cell>) >=
                  sizeof(scene<spheres_alone>) + sizeof(spaces::periodic) + sizeof(spaces::crossings));
    SUCCEED("checked at compile time");
}

TEST_CASE("a pair is as far apart as its image says, and a branch goes through the contact") {
    bodies::spheres two;
    two.add({-0.09, 0.0, 0.0}, 0.01), two.add({0.091, 0.0, 0.0}, 0.012);
    scene<in_a_cell> s(settings<in_a_cell>(), two, {}, spaces::periodic({0.2, 0.3, 0.4}));
    s.heavy.pairs = {{0, 1}};
    s.heavy.image = {no_shift};
    CHECK(norm(s.apart(s.heavy, 0) - vec3{0.181, 0.0, 0.0}) < 1e-15);
    s.heavy.image = {no_shift - 1}; // the one an edge lower along x
    CHECK(norm(s.apart(s.heavy, 0) - vec3{-0.019, 0.0, 0.0}) < 1e-15);
    const force_row row{{}, 0.003, {-1.0, 0.0, 0.0}, 0.0};
    CHECK(norm(s.branch_of(row, {0, 1}) - vec3{-0.019, 0.0, 0.0}) < 1e-15);
}

TEST_CASE("the branch of a contact of clumps leads from centre to centre") {
    using P = scenes::unbreakable<>;
    bodies::clumps two = scenes::empty(shapes::tetrahedron_4(circumscribed(0.02)));
    two.add(0, {-0.01, 0, 0}, {}), two.add(0, {0.01, 0.001, 0.002}, unit(quaternion{1, 1, 0, 0}));
    scene<P> s(scenes::settings<P>(), two, boundaries::solid_strips(scenes::cylinder(0.1, 0.1)), {});
    const vec3 d = s.position(4) - s.position(0);
    const double depth = s.radius(0) + s.radius(4) - norm(d);
    CHECK(norm(s.branch_of({{}, depth, unit(d), 0.0}, {0, 4}) - vec3{0.02, 0.001, 0.002}) < 1e-15);
    CHECK(s.centre_of(5) == two.centre(1));
}

TEST_CASE("heavy contacts are told in the order of one thread, wherever they stand") {
    bodies::spheres many;
    for (int k = 0; k < 5; ++k) many.add({0.02 * k, 0.0, 0.0}, 0.01);
    scene<spheres_alone> s(settings<spheres_alone>(), many, {}, {});
    s.heavy.pairs = {{0, 3}, {2, 4}, {0, 1}, {1, 2}, {3, 4}};
    s.heavy.shared = 2;
    std::vector<pebble_pair> told;
    s.each_heavy([&](std::size_t k) { told.push_back(s.heavy.pairs[k]); });
    CHECK(told == std::vector<pebble_pair>{{0, 1}, {0, 3}, {1, 2}, {2, 4}, {3, 4}});
    s.index_heavy();
    CHECK(s.heavy_of->of(3).size() == 2);
}

TEST_CASE("a scene comes back from an archive") {
    auto e = scenes::packed<scenes::unbreakable<>>(scenes::settings<scenes::unbreakable<>>(),
                                                   shapes::tetrahedron_4(circumscribed(0.02)), 24, 0.055, 2e5, 400);
    auto copy = e.state(), other = e.state();
    other.totals = {}, other.dt = 1.0, other.heavy = {}, other.near.margins.clear();
    CHECK(checksum(other) != checksum(copy));
    from_bytes(to_bytes(copy), other);
    CHECK(checksum(other) == checksum(copy));
    CHECK(other.heavy.pairs == copy.heavy.pairs);
    CHECK(other.dt == copy.dt);
}
