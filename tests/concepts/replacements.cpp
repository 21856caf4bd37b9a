// SPDX-License-Identifier: MIT
#include <clast/replacements/concepts.hpp>

#include <type_traits>

#include <clast/replacements/none.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

/// The poorest policy that never replaces.
struct inert {
    static constexpr bool makes_bonds = false;
    inert() = delete;
};

/// The poorest policy that makes bonds: no default constructor, nothing but what the concept asks.
struct archetype {
    static constexpr bool makes_bonds = true;
    explicit archetype(const bonds::parallel& material) : bond(material) {}
    bonds::parallel bond;
    float trigger = 0.5F;     // converts to double
    short check_interval = 1; // converts to int
    std::vector<bonds::state> born(const bonds::lattice& lattice, const std::vector<bonds::pebble_load>&, quaternion,
                                   vec3) const {
        return std::vector<bonds::state>(lattice.ends.size());
    }
};

struct without_birth {
    static constexpr bool makes_bonds = true;
    bonds::parallel bond;
    double trigger = 0.9;
    int check_interval = 10;
};

struct undecided {
    bonds::parallel bond;
};

static_assert(replacements::unbreakable<inert> && replacements::replacement<inert> && !replacements::bonding<inert>);
static_assert(replacements::bonding<archetype> && replacements::replacement<archetype>);
static_assert(!replacements::unbreakable<archetype>);
static_assert(!std::is_default_constructible_v<archetype>);
static_assert(replacements::unbreakable<replacements::none>);
static_assert(!replacements::replacement<without_birth>);
static_assert(!replacements::replacement<undecided>);
static_assert(!replacements::replacement<int>);

} // namespace

TEST_CASE("the poorest bonding policy gives one state per bond") {
    const archetype policy{bonds::parallel{}};
    const bonds::lattice pair(shapes::tetrahedron_4(0.02), policy.bond, 2650.0);
    CHECK(policy.born(pair, std::vector<bonds::pebble_load>(4), {}, {}).size() == 6);
}
