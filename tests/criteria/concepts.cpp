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

/// Optional members of another form would be passed over in silence.
struct active_needs_not_const : archetype {
    criteria::needs active_needs() { return needs; }
};
struct active_needs_as_number : archetype {
    unsigned active_needs() const { return 0; }
};
struct strength_without_grain : archetype {
    double strength_factor() const { return 1.0; }
};
/// And with them.
struct complete : archetype {
    using archetype::archetype;
    criteria::needs active_needs() const { return criteria::needs::stress; }
    float strength_factor(std::int64_t grain) const { return 2.0F * static_cast<float>(grain); }
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
static_assert(!criteria::criterion<active_needs_not_const> && !criteria::criterion<active_needs_as_number>);
static_assert(!criteria::criterion<strength_without_grain>);
static_assert(criteria::evaluated_criterion<complete>);

} // namespace

TEST_CASE("the poorest criterion can be asked, and needs what its type declares") {
    const archetype c(1);
    CHECK(c.utilisation({}) == 0.25);
    CHECK(criteria::needs_of(c) == criteria::needs::nothing);
}

TEST_CASE("strength of a grain over that of its like: the criterion's, or 1") {
    CHECK(criteria::strength_factor_of(archetype(1), 3) == 1.0);
    CHECK(criteria::strength_factor_of(complete(1), 3) == 6.0);
    CHECK(criteria::needs_of(complete(1)) == criteria::needs::stress);
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
    for (const needs one : {needs::largest_force, needs::largest_contact, needs::stress, needs::grain_id,
                            needs::coordination, needs::neighbour_forces, both, needs::nothing})
        CHECK(contains(criteria::everything, one));
    CHECK_FALSE(contains(criteria::everything, static_cast<needs>(64)));
}
