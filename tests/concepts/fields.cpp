// SPDX-License-Identifier: MIT
#include <clast/fields/concepts.hpp>

#include <type_traits>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/fields/none.hpp>

#include <catch.hpp>

static_assert(clast::fields::field<clast::fields::none>);

using namespace clast;

namespace {

/// The poorest field: no default constructor, nothing but what the concept asks. Bodies are drawn to the origin.
struct archetype {
    static constexpr bool acts = true;
    explicit archetype(double k) : stiffness(k) {}
    vec3 force(const fields::body_at& b) const { return -stiffness * b.centre; }
    float potential(const fields::body_at& b) const { // converts to double
        return static_cast<float>(0.5 * stiffness * norm2(b.centre));
    }

  private:
    double stiffness;
};
/// The poorest that does not act.
struct inert {
    static constexpr bool acts = false;
    explicit inert(int) {}
};
struct without_potential {
    static constexpr bool acts = true;
    vec3 force(const fields::body_at&) const { return {}; }
};
struct not_const {
    static constexpr bool acts = true;
    vec3 force(const fields::body_at&) { return {}; }
    double potential(const fields::body_at&) const { return 0.0; }
};
struct undecided {
    vec3 force(const fields::body_at&) const { return {}; }
    double potential(const fields::body_at&) const { return 0.0; }
};

static_assert(fields::acting<archetype> && fields::field<archetype> && !fields::absent<archetype>);
static_assert(fields::absent<inert> && fields::field<inert> && fields::absent<fields::none>);
static_assert(!std::is_default_constructible_v<archetype> && !std::is_default_constructible_v<inert>);
static_assert(!fields::field<without_potential> && !fields::field<not_const> && !fields::field<undecided>);
static_assert(!fields::field<int>);

template <class Field> struct with : triaxial_policies_default {
    using body = bodies::spheres;
    using boundary = boundaries::none;
    using breakage = criteria::none;
    using replacement = replacements::none;
    using field = Field;
};
static_assert(simulator_policies<with<archetype>> && simulator_policies<with<inert>>);
static_assert(!simulator_policies<with<undecided>>);

/// A sphere that is let go 0.1 m from the origin, after a time (s).
template <class Field> engine<with<Field>> after(double time, Field field) {
    bodies::spheres s;
    s.add({0.1, 0.0, 0.0}, 0.01);
    const contacts::linear law{1e6, 5e5, 0.3};
    engine<with<Field>> e({.grain_contact = law,
                           .platen_contact = law,
                           .lateral_contact = law,
                           .breakage = {},
                           .replacement = {},
                           .scheme = {.damping = 0.0},
                           .field = field},
                          s, spaces::open{});
    while (e.time() < time) e.step();
    return e;
}

} // namespace

TEST_CASE("the poorest field moves a body, and its potential closes the audit") {
    const double m = 2650.0 * sphere_volume(0.01), pi = 3.14159265358979323846;
    const auto e = after(0.25, archetype(m * pi * pi)); // a period of 2 s: an eighth of it
    CHECK(e.grains.centre(0).x == Approx(0.1 * std::cos(pi * e.time())).epsilon(1e-3));
    CHECK(e.totals().initial_energy == Approx(0.5 * m * pi * pi * 0.01));
    CHECK(e.kinetic_energy() + e.potential_energy() == Approx(e.totals().initial_energy).epsilon(1e-6));
    CHECK(e.kinetic_energy() == Approx(0.5 * e.totals().initial_energy).epsilon(0.01));
}

TEST_CASE("one that does not act moves nothing") {
    const auto e = after(0.01, inert(1));
    CHECK((e.grains.centre(0) == vec3{0.1, 0.0, 0.0}));
    CHECK(e.potential_energy() == 0.0);
}
