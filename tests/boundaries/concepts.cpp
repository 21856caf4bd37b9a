// SPDX-License-Identifier: MIT
#include <catch.hpp>

#include <clast/boundaries/concepts.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>

static_assert(clast::boundaries::surface<clast::boundaries::none>);

using namespace clast;
using namespace clast::boundaries;

namespace {

// The poorest boundary that satisfies the concept: two platens in free space, without a lateral wall.
struct archetype {
    bool near(const vec3&, double) const { return true; }
    touches touch(const vec3&, double, double = 0.0) const { return {}; }
    int facet_count() const { return 2; }
    double velocity(int) const { return 0.0; }
    void control(std::span<const facet_load>, const drives&, double, std::span<const coupling>) {}
    void advance(double) {}
    double fastest() const { return 0.0; }
    double power(std::span<const facet_load>) const { return 0.0; }
    template <class A> void archive(A&) {}
};

struct without_archive : archetype {
    template <class A> void archive(A&) = delete;
};
struct deaf_to_couplings : archetype {
    void control(std::span<const facet_load>, const drives&, double) {}
};
struct that_cannot_move : archetype {
    void advance() {}
};

} // namespace

static_assert(surface<archetype>);
static_assert(surface<tiles> && surface<ring_walls> && surface<solid_strips>);
static_assert(!saved<without_archive> && !surface<without_archive>);
static_assert(!driven<deaf_to_couplings> && !surface<deaf_to_couplings>);
static_assert(!driven<that_cannot_move> && !surface<that_cannot_move>);
static_assert(!surface<int>);

TEST_CASE("the poorest surface satisfies the concept", "[boundaries]") { SUCCEED("checked at compile time"); }
