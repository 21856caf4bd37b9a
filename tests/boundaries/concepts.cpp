// SPDX-License-Identifier: MIT
#include <catch.hpp>

#include <clast/boundaries/concepts.hpp>
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>

using namespace clast;
using namespace clast::boundaries;

namespace {

// The poorest boundary that satisfies the concept: two platens in free space, without a lateral wall.
struct archetype {
    bool near(const vec3&, double) const { return true; }
    touches touch(const vec3&, double, double = 0.0) const { return {}; }
    bool outside(const vec3&, double) const { return false; }
    int facet_count() const { return 2; }
    double stiffness(int) const { return 1.0; }
    double velocity(int) const { return 0.0; }
    double area(int) const { return 1.0; }
    void control(std::span<const facet_load>, const drives&, double, std::span<const coupling>) {}
    void advance(double) {}
    double fastest() const { return 0.0; }
    double volume() const { return 1.0; }
    double height() const { return 1.0; }
    double section() const { return 1.0; }
    double axial_stress(std::span<const facet_load>) const { return 0.0; }
    double lateral_stress(std::span<const facet_load>) const { return 0.0; }
    double confining_error(std::span<const facet_load>, double) const { return 0.0; }
    double confining_rms(std::span<const facet_load>, double) const { return 0.0; }
    double power(std::span<const facet_load>) const { return 0.0; }
    std::vector<facet_view> view(std::span<const facet_load>) const { return {}; }
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

static_assert(boundary<archetype>);
static_assert(boundary<tiles> && boundary<ring_walls> && boundary<solid_strips>);
static_assert(!saved<without_archive> && !boundary<without_archive>);
static_assert(!driven<deaf_to_couplings> && !boundary<deaf_to_couplings>);
static_assert(!driven<that_cannot_move> && !boundary<that_cannot_move>);
static_assert(!boundary<int>);

TEST_CASE("the poorest boundary satisfies the concept", "[boundaries]") { SUCCEED("checked at compile time"); }
