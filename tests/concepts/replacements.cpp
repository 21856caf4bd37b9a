// SPDX-License-Identifier: MIT
#include <clast/replacements/concepts.hpp>

#include <concepts>
#include <type_traits>

#include <clast/engine/engine.hpp>
#include <clast/replacements/modified.hpp>
#include <clast/replacements/none.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

/// The poorest policy that never replaces.
struct inert {
    static constexpr bool replaces = false;
    inert() = delete;
};

/// The poorest policy that replaces: no default constructor, no plan, no state, nothing but what the concept asks.
struct archetype {
    static constexpr bool replaces = true;
    static constexpr int makes_bonds = 0; // converts to bool
    explicit archetype(int) {}
    short looks_every() const { return 1; } // converts to int
    template <class View> std::optional<replacements::nothing> wants(const View& clump) const {
        if (clump.utilisation() < 1.0 || clump.shape().pebbles.size() < 2) return std::nullopt;
        return replacements::nothing{};
    }
    template <class Surgery> bool act(std::int32_t grain, replacements::nothing, Surgery& surgery) const {
        const auto n = static_cast<std::int32_t>(surgery.shape_of(grain).pebbles.size());
        surgery.split(grain, std::vector<replacements::pebble_run>{{0, 1}, {1, n - 1}});
        return true; // is not looked at
    }
};
/// The poorest one that makes bonds.
struct bonding : archetype {
    static constexpr bool makes_bonds = true;
    using archetype::archetype;
    bonds::parallel bond;
};

struct without_material : archetype {
    static constexpr bool makes_bonds = true;
};
struct without_looks {
    static constexpr bool replaces = true, makes_bonds = false;
    template <class View> std::optional<replacements::nothing> wants(const View&) const { return {}; }
    template <class Surgery> void act(std::int32_t, replacements::nothing, Surgery&) const {}
};
struct wants_by_a_flag : archetype {
    template <class View> bool wants(const View&) const { return true; }
};
struct acts_and_changes : archetype {
    template <class Surgery> void act(std::int32_t, replacements::nothing, Surgery&) {}
};
struct another_plan : archetype { // answers nothing, but says that it plans
    struct plan {};
};
struct undecided {
    bonds::parallel bond;
};

static_assert(replacements::unbreakable<inert> && replacements::replacement<inert> && !replacements::replacing<inert>);
static_assert(replacements::unbreakable<replacements::none> && std::is_empty_v<replacements::none>);
static_assert(replacements::replacing<archetype> && replacements::replacement<archetype>);
static_assert(!replacements::unbreakable<archetype> && !std::is_default_constructible_v<archetype>);
static_assert(replacements::replacing<bonding> && replacements::replacing<replacements::modified>);
static_assert(!replacements::makes_bonds<inert>() && !replacements::makes_bonds<archetype>());
static_assert(replacements::makes_bonds<bonding>() && replacements::makes_bonds<replacements::modified>());
static_assert(!replacements::replacement<without_material> && !replacements::replacement<without_looks>);
static_assert(!replacements::replacement<wants_by_a_flag> && !replacements::replacement<acts_and_changes>);
static_assert(!replacements::replacement<another_plan>);
static_assert(!replacements::replacement<undecided> && !replacements::replacement<int>);

/// A scene with such a policy.
template <class R> struct with : scenes::breakable<> { using replacement = R; };

/// What a policy sees in an engine has the members, and gives what they give, of what the concept shows it.
template <class View, class Model>
concept stands_for = requires(const View v, const Model m) {
    { v.grain() } -> std::same_as<decltype(m.grain())>;
    { v.id() } -> std::convertible_to<decltype(m.id())>;
    { v.utilisation() } -> std::same_as<decltype(m.utilisation())>;
    { v.pebble_loads() } -> std::same_as<decltype(m.pebble_loads())>;
    { v.neighbours() } -> std::same_as<decltype(m.neighbours())>;
    { v.shape() } -> std::same_as<decltype(m.shape())>;
    { v.centre() } -> std::same_as<decltype(m.centre())>;
    { v.velocity() } -> std::same_as<decltype(m.velocity())>;
    { v.spin() } -> std::same_as<decltype(m.spin())>;
    { v.orientation() } -> std::same_as<decltype(m.orientation())>;
};
template <class View>
concept has_lattice = requires(const View v) {
    v.lattice();
};
using model = replacements::view_archetype<replacements::nothing>;
using view = rooms::grain_view<scene<with<archetype>>>;
using view_with_bonds = rooms::grain_view<scene<with<bonding>>>;
static_assert(stands_for<view, model> && stands_for<view_with_bonds, model>);
static_assert(!has_lattice<view> && has_lattice<view_with_bonds>);

} // namespace

TEST_CASE("the poorest policy that replaces runs, and where it makes no bonds a scene has none") {
    using P = with<archetype>;
    static_assert(simulator_policies<P> && scene<P>::replaces && !scene<P>::breakable);
    static_assert(std::is_same_v<decltype(scene<P>::broken), unbroken>);
    static_assert(sizeof(scene<P>) + sizeof(breakage_state) / 2 < sizeof(scene<with<bonding>>));
    engine<P> e = scenes::collision<P>({.grain_contact = contacts::linear::between(scenes::pebble, scenes::pebble),
                                        .platen_contact = contacts::linear::between(scenes::pebble, scenes::platen),
                                        .lateral_contact = contacts::linear::between(scenes::pebble, scenes::membrane),
                                        .breakage = {criteria::crushing_strength(1.0)},
                                        .replacement = archetype(1)});
    for (int k = 0; k < 400; ++k) e.step();
    CHECK(e.totals().replaced >= 2);
    CHECK(e.grains.grain_count() == 2 + static_cast<std::size_t>(e.totals().replaced));
}

TEST_CASE("the poorest policy that makes bonds runs") {
    using P = with<bonding>;
    engine<P> e = scenes::collision<P>({.grain_contact = contacts::linear::between(scenes::pebble, scenes::pebble),
                                        .platen_contact = contacts::linear::between(scenes::pebble, scenes::platen),
                                        .lateral_contact = contacts::linear::between(scenes::pebble, scenes::membrane),
                                        .breakage = {criteria::crushing_strength(1.0)},
                                        .replacement = bonding(1)});
    for (int k = 0; k < 400; ++k) e.step();
    CHECK(e.totals().replaced >= 2);
    CHECK(e.breakage().pools.size() == e.grains.shapes.size());
}
