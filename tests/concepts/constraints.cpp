// SPDX-License-Identifier: MIT
#include <clast/constraints/concepts.hpp>

#include <cstddef>

#include <clast/bodies/clumps.hpp>
#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/constraints/held.hpp>
#include <clast/constraints/none.hpp>
#include <clast/engine/engine.hpp>

#include <catch.hpp>

static_assert(clast::constraints::absent<clast::constraints::none>);

using namespace clast;

namespace {

/// The poorest constraint, for bodies of any kind: body 0 feels no force along x.
struct archetype {
    static constexpr bool acts = true;
    template <class Bodies> int begin_step(Bodies&, double) { return 0; } // converts to double
    void act(std::size_t body, load_sum& load) const {
        if (body == 0) load.force.x = 0.0;
    }
    template <class Bodies> int end_step(const Bodies&, double) const { return 0; }
    vec3 outer_force(std::size_t) const { return {}; }
    bool is_fixed(std::size_t) const { return false; }
    bool take_change() const { return false; }
    template <class A> void archive(A&) {}
};
/// The poorest that does not act.
struct inert {
    static constexpr bool acts = false;
    template <class A> void archive(A&) {}
};
struct never_saved : archetype {
    void archive(int) = delete;
};
struct silent : archetype {
    void take_change() const {}
};
/// Bodies whose motion nobody can set.
struct immovable : bodies::spheres {
    void set_velocity(std::size_t, const vec3&) = delete;
};

static_assert(constraints::holding<archetype, bodies::spheres> && constraints::holding<archetype, bodies::clumps>);
static_assert(constraints::holding<archetype, immovable>);
static_assert(constraints::absent<inert> && constraints::constraint<inert, bodies::clumps>);
static_assert(!constraints::constraint<never_saved, bodies::spheres>);
static_assert(!constraints::constraint<silent, bodies::spheres> && !constraints::constraint<int, bodies::spheres>);
static_assert(constraints::holding<constraints::held, bodies::clumps>);
static_assert(!constraints::constraint<constraints::held, immovable>); // refused before anything runs

struct on_rails : triaxial_policies_default {
    using body = bodies::spheres;
    using boundary = boundaries::none;
    using breakage = criteria::none;
    using replacement = replacements::none;
    using constraint = archetype;
};
struct wrong : on_rails {
    using body = immovable;
    using constraint = constraints::held;
};
static_assert(simulator_policies<on_rails> && !simulator_policies<wrong>);

} // namespace

TEST_CASE("the poorest constraint keeps a force from a body") {
    bodies::spheres s;
    s.add({0.0, 0.0, 0.0}, 0.01);
    s.add({0.019, 0.0, 0.0}, 0.01);
    const contacts::linear law{1e6, 5e5, 0.3};
    engine<on_rails> e(
        {.grain_contact = law, .platen_contact = law, .lateral_contact = law, .breakage = {}, .replacement = {}}, s,
        spaces::open{});
    e.step(100);
    CHECK(e.grains.centre(0).x == 0.0);
    CHECK(e.grains.centre(1).x > 0.0195);
}
