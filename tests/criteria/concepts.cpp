// SPDX-License-Identifier: MIT
#include <clast/criteria/concepts.hpp>

#include <type_traits>

#include <catch.hpp>

using namespace clast;

namespace {

/// The poorest criterion: no default constructor, nothing but what the concept asks.
struct archetype {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::needs::nothing;
    explicit archetype(int) {}
    double utilisation(const criteria::grain_load&) const { return 0.25; }
};

struct without_needs {
    static constexpr bool evaluated = true;
    double utilisation(const criteria::grain_load&) const { return 0.0; }
};

struct not_const {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::needs::nothing;
    double utilisation(const criteria::grain_load&) { return 0.0; }
};

struct absent {
    static constexpr bool evaluated = false;
};

static_assert(criteria::evaluated_criterion<archetype> && criteria::criterion<archetype>);
static_assert(!std::is_default_constructible_v<archetype>);
static_assert(criteria::criterion<absent> && !criteria::evaluated_criterion<absent>);
static_assert(!criteria::criterion<without_needs>);
static_assert(!criteria::criterion<not_const>);
static_assert(!criteria::criterion<int>);

} // namespace

TEST_CASE("the poorest criterion can be asked, and needs what its type declares") {
    const archetype c(1);
    CHECK(c.utilisation({}) == 0.25);
    CHECK(criteria::needs_of(c) == criteria::needs::nothing);
}

TEST_CASE("needs are sets") {
    using criteria::contains;
    using criteria::needs;
    const needs both = needs::largest_force | needs::stress;
    CHECK(contains(both, needs::stress));
    CHECK(contains(both, needs::nothing));
    CHECK(contains(both, both));
    CHECK_FALSE(contains(needs::stress, both));
    CHECK_FALSE(contains(both, needs::grain_id));
}
