// SPDX-License-Identifier: MIT
// What is missing in one policy, by families: each struct says it in its first static_assert that fails.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <clast/core/vector.hpp>
#include <clast/engine/policies.hpp>

namespace clast {

namespace policy_checks {

// Types that may be missing stand within requires expressions, not in their parameter lists, where Clang 14 takes them
// for errors.

/// Number, from 1, of the first thing that is missing: 0 where the concept holds, whatever else is said; behind the
/// last where something is missing that the list does not know.
template <class... Bool> constexpr int first_missing(bool holds, Bool... there) {
    if (holds) return 0;
    int number = 1;
    (void)((there && ++number != 0) && ...); // counts as long as they are there
    return number;
}

/// Whether a bundle has all its names.
template <class P> struct named {
    static constexpr int missing = first_missing(
        false, requires { typename P::contact; }, requires { typename P::breakage; },
        requires { typename P::replacement; }, requires { typename P::boundary; }, requires { typename P::search; },
        requires { typename P::body; }, requires { typename P::space; }, requires { typename P::scheme; },
        requires { typename P::field; }, requires { typename P::constraint; });
    static constexpr bool all = missing == 11;
    static_assert(missing != 1, "the bundle names no `contact`: derive it from triaxial_policies_default");
    static_assert(missing != 2, "the bundle names no `breakage`: derive it from triaxial_policies_default");
    static_assert(missing != 3, "the bundle names no `replacement`: derive it from triaxial_policies_default");
    static_assert(missing != 4, "the bundle names no `boundary`: derive it from triaxial_policies_default");
    static_assert(missing != 5, "the bundle names no `search`: derive it from triaxial_policies_default");
    static_assert(missing != 6, "the bundle names no `body`: derive it from triaxial_policies_default");
    static_assert(missing != 7, "the bundle names no `space`: derive it from triaxial_policies_default");
    static_assert(missing != 8, "the bundle names no `scheme`: derive it from triaxial_policies_default");
    static_assert(missing != 9, "the bundle names no `field`: derive it from triaxial_policies_default");
    static_assert(missing != 10, "the bundle names no `constraint`: derive it from triaxial_policies_default");
};

template <class L> struct contact {
    using overlap = contacts::overlap<double>;
    static constexpr int missing = first_missing(
        contacts::contact_law<L>, std::copyable<L>, requires { typename L::history; },
        requires {
            requires std::is_trivially_copyable_v<typename L::history> &&
                std::default_initializable<typename L::history>;
        },
        requires(const L l, overlap o, contacts::motion<double> m) {
            l(o, m, std::declval<typename L::history&>(), 1.0);
        },
        requires(const L l, overlap o) { l.stored(o, std::declval<const typename L::history&>()); },
        requires(const L l, overlap o) { l.normal_stiffness(o); },
        requires(const L l, overlap o) { l.shear_stiffness(o); });
    static_assert(missing != 1, "policy contact of the bundle cannot be copied (clast/contacts/concepts.hpp)");
    static_assert(missing != 2, "policy contact of the bundle lacks the type `history` (clast/contacts/concepts.hpp)");
    static_assert(missing != 3,
                  "policy contact of the bundle: its `history` must be trivially copyable and default-constructible "
                  "(clast/contacts/concepts.hpp)");
    static_assert(missing != 4, "policy contact of the bundle lacks `law(overlap, motion, history, dt) const` "
                                "(clast/contacts/concepts.hpp)");
    static_assert(missing != 5, "policy contact of the bundle lacks `stored(overlap, history) const` "
                                "(clast/contacts/concepts.hpp)");
    static_assert(missing != 6, "policy contact of the bundle lacks `normal_stiffness(overlap) const` "
                                "(clast/contacts/concepts.hpp)");
    static_assert(missing != 7, "policy contact of the bundle lacks `shear_stiffness(overlap) const` "
                                "(clast/contacts/concepts.hpp)");
    static_assert(missing != 8, "policy contact of the bundle answers with other types than a contact law "
                                "(clast/contacts/concepts.hpp)");
};

template <class C> struct breakage {
    static constexpr int missing = first_missing(
        criteria::criterion<C>, std::copyable<C>, requires { C::evaluated; }, requires { C::needs; },
        requires(const C c, const criteria::grain_load& load) { c.utilisation(load); });
    static_assert(missing != 1, "policy breakage of the bundle cannot be copied (clast/criteria/concepts.hpp)");
    static_assert(missing != 2, "policy breakage of the bundle lacks `static constexpr bool evaluated` "
                                "(clast/criteria/concepts.hpp)");
    static_assert(missing != 3, "policy breakage of the bundle lacks `static constexpr criteria::needs needs` "
                                "(clast/criteria/concepts.hpp)");
    static_assert(missing != 4, "policy breakage of the bundle lacks `utilisation(grain_load) const` "
                                "(clast/criteria/concepts.hpp)");
    static_assert(missing != 5, "policy breakage of the bundle answers with other types than a criterion "
                                "(clast/criteria/concepts.hpp)");
};

template <class R> struct replacement {
    static constexpr int missing = first_missing(
        replacements::replacement<R>, requires { R::replaces; }, std::copyable<R>, requires { R::makes_bonds; },
        requires(const R r) {
            requires !bool(R::makes_bonds) || requires { r.bond; };
        },
        requires(const R r) { r.looks_every(); },
        requires(const R r) {
            r.wants(std::declval<const replacements::view_archetype<replacements::grain_state_of<R>>&>());
        },
        requires(const R r) {
            r.act(std::int32_t{}, std::declval<const replacements::plan_of<R>&>(),
                  std::declval<replacements::surgery_archetype<replacements::grain_state_of<R>>&>());
        });
    static_assert(missing != 1, "policy replacement of the bundle lacks `static constexpr bool replaces` "
                                "(clast/replacements/concepts.hpp)");
    static_assert(missing != 2, "policy replacement of the bundle cannot be copied (clast/replacements/concepts.hpp)");
    static_assert(missing != 3, "policy replacement of the bundle lacks `static constexpr bool makes_bonds` "
                                "(clast/replacements/concepts.hpp)");
    static_assert(missing != 4, "policy replacement of the bundle lacks `bond` (clast/replacements/concepts.hpp)");
    static_assert(missing != 5, "policy replacement of the bundle lacks `looks_every() const` "
                                "(clast/replacements/concepts.hpp)");
    static_assert(missing != 6, "policy replacement of the bundle lacks `wants(view) const` "
                                "(clast/replacements/concepts.hpp)");
    static_assert(missing != 7, "policy replacement of the bundle lacks `act(grain, plan, surgery) const` "
                                "(clast/replacements/concepts.hpp)");
    static_assert(missing != 8, "policy replacement of the bundle answers with other types than a replacement "
                                "(clast/replacements/concepts.hpp)");
};

template <class B> struct boundary {
    using loads = std::span<const boundaries::facet_load>;
    static constexpr int missing = first_missing(
        boundaries::surface<B>, requires(const B& b, vec3 x) { b.near(x, 1.0); },
        requires(const B& b, vec3 x) { b.touch(x, 1.0); }, requires(const B& b, vec3 x) { b.touch(x, 1.0, 1.0); },
        requires(const B& b) { b.facet_count(); }, requires(const B& b) { b.velocity(0); },
        requires(B& b, loads l, const boundaries::drives& d, std::span<const boundaries::coupling> c) {
            b.control(l, d, 1.0, c);
        },
        requires(B& b) { b.advance(1.0); }, requires(const B& b) { b.fastest(); },
        requires(const B& b, loads l) { b.power(l); }, boundaries::saved<B>);
    static_assert(missing != 1, "policy boundary of the bundle lacks `near(x, reach) const` "
                                "(clast/boundaries/concepts.hpp)");
    static_assert(missing != 2, "policy boundary of the bundle lacks `touch(x, radius) const` "
                                "(clast/boundaries/concepts.hpp)");
    static_assert(missing != 3, "policy boundary of the bundle lacks `touch(x, radius, ahead) const` "
                                "(clast/boundaries/concepts.hpp)");
    static_assert(missing != 4, "policy boundary of the bundle lacks `facet_count() const` "
                                "(clast/boundaries/concepts.hpp)");
    static_assert(missing != 5, "policy boundary of the bundle lacks `velocity(facet) const` "
                                "(clast/boundaries/concepts.hpp)");
    static_assert(missing != 6, "policy boundary of the bundle lacks `control(loads, drives, dt, couplings)` "
                                "(clast/boundaries/concepts.hpp)");
    static_assert(missing != 7, "policy boundary of the bundle lacks `advance(dt)` (clast/boundaries/concepts.hpp)");
    static_assert(missing != 8, "policy boundary of the bundle lacks `fastest() const` "
                                "(clast/boundaries/concepts.hpp)");
    static_assert(missing != 9, "policy boundary of the bundle lacks `power(loads) const` "
                                "(clast/boundaries/concepts.hpp)");
    static_assert(missing != 10, "policy boundary of the bundle lacks `archive(a)`, or cannot be copied "
                                 "(clast/boundaries/concepts.hpp)");
    static_assert(missing != 11, "policy boundary of the bundle answers with other types than a surface "
                                 "(clast/boundaries/concepts.hpp)");
};

template <class S> struct search {
    static constexpr int missing = first_missing(
        searches::search<S> && std::default_initializable<S>, std::copyable<S>, std::default_initializable<S>,
        requires(S s, std::span<const searches::sphere> spheres) { s.pairs(spheres, 1.0); });
    static_assert(missing != 1, "policy search of the bundle cannot be copied (clast/searches/concepts.hpp)");
    static_assert(missing != 2, "policy search of the bundle lacks a default constructor (clast/engine/policies.hpp)");
    static_assert(missing != 3, "policy search of the bundle lacks `pairs(spheres, margin)` "
                                "(clast/searches/concepts.hpp)");
    static_assert(missing != 4, "policy search of the bundle answers with other types than a search "
                                "(clast/searches/concepts.hpp)");
};

template <class S> struct body {
    using items = std::span<const std::int32_t>;
    static constexpr int missing = first_missing(
        bodies::swept<S>, std::movable<S>, requires { S::turns; }, requires { typename S::reference; },
        requires(const S& c) { c.body_count(), c.movable_count(), c.pebble_count(); },
        requires(const S& c) { c.is_swept(std::size_t{}), c.body_of(std::int32_t{}), c.group_of(std::int32_t{}); },
        requires(const S& c) {
            c.centre(std::size_t{}), c.bounding_radius(std::size_t{}), c.pebbles_of(std::size_t{});
        },
        requires(const S& c) { c.velocity_of(std::int32_t{}), c.inverse_mass_of(std::int32_t{}), c.view(); },
        requires(const S& c) { c.body_mass(std::size_t{}), c.body_inertia(std::size_t{}), c.body_axes(std::size_t{}); },
        requires(const S& c) { c.kinetic_energy(std::size_t{}), c.smallest_mass(); },
        requires(const S& c) { c.moved(std::size_t{}, c.refer(std::size_t{}), vec3{}); },
        requires(const S& c) { c.surface_speed(std::size_t{}, vec3{}); },
        requires(S& s) {
            s.place(std::size_t{}), s.place(std::size_t{}, items{}), s.shift(std::size_t{}, vec3{}, vec3{});
        },
        requires(const S& c) { c.pebbles, c.losses; });
    static_assert(missing != 1, "policy body of the bundle cannot be moved (clast/bodies/concepts.hpp)");
    static_assert(missing != 2, "policy body of the bundle lacks `static constexpr bool turns` "
                                "(clast/bodies/concepts.hpp)");
    static_assert(missing != 3, "policy body of the bundle lacks the type `reference` (clast/bodies/concepts.hpp)");
    static_assert(missing != 4, "policy body of the bundle lacks `body_count()`, `movable_count()` or `pebble_count()` "
                                "(clast/bodies/concepts.hpp)");
    static_assert(missing != 5, "policy body of the bundle lacks `is_swept(body)`, `body_of(pebble)` or "
                                "`group_of(pebble)` (clast/bodies/concepts.hpp)");
    static_assert(missing != 6, "policy body of the bundle lacks `centre(body)`, `bounding_radius(body)` or "
                                "`pebbles_of(body)` (clast/bodies/concepts.hpp)");
    static_assert(missing != 7, "policy body of the bundle lacks `velocity_of(pebble)`, `inverse_mass_of(pebble)` or "
                                "`view()` (clast/bodies/concepts.hpp)");
    static_assert(missing != 8, "policy body of the bundle lacks `body_mass(body)`, `body_inertia(body)` or "
                                "`body_axes(body)` (clast/bodies/concepts.hpp)");
    static_assert(missing != 9, "policy body of the bundle lacks `kinetic_energy(body)` or `smallest_mass()` "
                                "(clast/bodies/concepts.hpp)");
    static_assert(missing != 10, "policy body of the bundle lacks `refer(body)` or `moved(body, reference, stretch)` "
                                 "(clast/bodies/concepts.hpp)");
    static_assert(missing != 11, "policy body of the bundle lacks `surface_speed(body, rates)` "
                                 "(clast/bodies/concepts.hpp)");
    static_assert(missing != 12, "policy body of the bundle lacks `place(body)`, `place(body, pebbles)` or "
                                 "`shift(body, by, faster)` (clast/bodies/concepts.hpp)");
    static_assert(missing != 13, "policy body of the bundle lacks the tables `pebbles` or `losses` "
                                 "(clast/bodies/concepts.hpp)");
    static_assert(missing != 14, "policy body of the bundle lacks `advance(...)`, or answers with other types than "
                                 "swept bodies (clast/bodies/concepts.hpp)");
};

template <class S> struct space {
    static constexpr int missing = first_missing(
        spaces::space<S>, std::copyable<S>, requires { typename S::crossings; }, requires { typename S::frame; },
        requires { S::has_images; }, requires(const S& c) { c.here(); },
        requires(const S& c) { c.stretch_since(std::declval<typename S::frame>()); },
        requires(const S& c) { c.rates(); }, requires(const S& c) { c.travel(vec3{}, 1.0); },
        requires(const S& c) { c.room(1.0); }, requires(const S& c) { c.across(vec3{}, std::uint8_t{}); },
        requires(const S& c) { c.looks(std::int64_t{}, true, true); }, requires(S& s) { s.advance(1.0); });
    static_assert(missing != 1, "policy space of the bundle cannot be copied (clast/spaces/concepts.hpp)");
    static_assert(missing != 2, "policy space of the bundle lacks the type `crossings` (clast/spaces/concepts.hpp)");
    static_assert(missing != 3, "policy space of the bundle lacks the type `frame` (clast/spaces/concepts.hpp)");
    static_assert(missing != 4, "policy space of the bundle lacks `static constexpr bool has_images` "
                                "(clast/spaces/concepts.hpp)");
    static_assert(missing != 5, "policy space of the bundle lacks `here() const` (clast/spaces/concepts.hpp)");
    static_assert(missing != 6, "policy space of the bundle lacks `stretch_since(frame) const` "
                                "(clast/spaces/concepts.hpp)");
    static_assert(missing != 7, "policy space of the bundle lacks `rates() const` (clast/spaces/concepts.hpp)");
    static_assert(missing != 8, "policy space of the bundle lacks `travel(strain, reach) const` "
                                "(clast/spaces/concepts.hpp)");
    static_assert(missing != 9, "policy space of the bundle lacks `room(widest) const` (clast/spaces/concepts.hpp)");
    static_assert(missing != 10, "policy space of the bundle lacks `across(x, image) const` "
                                 "(clast/spaces/concepts.hpp)");
    static_assert(missing != 11, "policy space of the bundle lacks `looks(steps, keeps_rows, last_of_many) const` "
                                 "(clast/spaces/concepts.hpp)");
    static_assert(missing != 12, "policy space of the bundle lacks `advance(dt)` (clast/spaces/concepts.hpp)");
    static_assert(missing != 13, "policy space of the bundle answers with other types than a space "
                                 "(clast/spaces/concepts.hpp)");
};

template <class S> struct scheme {
    static constexpr int missing = first_missing(
        integrators::scheme<S>, std::copyable<S>, requires { typename S::memory; }, requires { S::stages.size(); },
        requires(const S s, vec3 v) { s.extra(v, v); },
        requires {
            requires requires(const S s, vec3 v) { s.kick(v, v, 1.0); } || requires(const S s, vec3 v) {
                s.kick(v, v, 1.0, std::declval<typename S::memory&>());
            };
        });
    static_assert(missing != 1, "policy scheme of the bundle cannot be copied (clast/integrators/concepts.hpp)");
    static_assert(missing != 2, "policy scheme of the bundle lacks the type `memory` (clast/integrators/concepts.hpp)");
    static_assert(missing != 3, "policy scheme of the bundle lacks the array `stages` "
                                "(clast/integrators/concepts.hpp)");
    static_assert(missing != 4, "policy scheme of the bundle lacks `extra(force, v) const` "
                                "(clast/integrators/concepts.hpp)");
    static_assert(missing != 5, "policy scheme of the bundle lacks `kick(v, force, by) const` "
                                "(clast/integrators/concepts.hpp)");
    static_assert(missing != 6, "policy scheme of the bundle answers with other types than a scheme "
                                "(clast/integrators/concepts.hpp)");
};

template <class F> struct field {
    static constexpr int missing = first_missing(
        fields::field<F>, std::copyable<F>, requires { F::acts; },
        requires(const F f, const fields::body_at& b) { f.force(b); },
        requires(const F f, const fields::body_at& b) { f.potential(b); });
    static_assert(missing != 1, "policy field of the bundle cannot be copied (clast/fields/concepts.hpp)");
    static_assert(missing != 2, "policy field of the bundle lacks `static constexpr bool acts` "
                                "(clast/fields/concepts.hpp)");
    static_assert(missing != 3, "policy field of the bundle lacks `force(body) const` (clast/fields/concepts.hpp)");
    static_assert(missing != 4, "policy field of the bundle lacks `potential(body) const` "
                                "(clast/fields/concepts.hpp)");
    static_assert(missing != 5, "policy field of the bundle answers with other types than a field "
                                "(clast/fields/concepts.hpp)");
};

template <class C, class Body> struct constraint {
    static constexpr int missing = first_missing(
        constraints::constraint<C, Body>, std::copyable<C>, requires { C::acts; },
        requires(C c) { c.begin_step(std::declval<Body&>(), 1.0); },
        requires(C c) { c.act(std::size_t{}, std::declval<load_sum&>()); },
        requires(C c) { c.end_step(std::declval<Body&>(), 1.0); },
        requires(const C c) { c.outer_force(std::size_t{}), c.is_fixed(std::size_t{}); },
        requires(C c) { c.take_change(); });
    static_assert(missing != 1, "policy constraint of the bundle cannot be copied (clast/constraints/concepts.hpp)");
    static_assert(missing != 2, "policy constraint of the bundle lacks `static constexpr bool acts` "
                                "(clast/constraints/concepts.hpp)");
    static_assert(missing != 3, "policy constraint of the bundle lacks `begin_step(bodies, time)` for these bodies "
                                "(clast/constraints/concepts.hpp)");
    static_assert(missing != 4, "policy constraint of the bundle lacks `act(body, load)` "
                                "(clast/constraints/concepts.hpp)");
    static_assert(missing != 5, "policy constraint of the bundle lacks `end_step(bodies, dt)` "
                                "(clast/constraints/concepts.hpp)");
    static_assert(missing != 6, "policy constraint of the bundle lacks `outer_force(body) const` or "
                                "`is_fixed(body) const` (clast/constraints/concepts.hpp)");
    static_assert(missing != 7, "policy constraint of the bundle lacks `take_change()` "
                                "(clast/constraints/concepts.hpp)");
    static_assert(missing != 8,
                  "policy constraint of the bundle lacks `archive(a)`, or answers with other types than a "
                  "constraint (clast/constraints/concepts.hpp)");
};

} // namespace policy_checks

} // namespace clast
