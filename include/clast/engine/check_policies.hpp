// SPDX-License-Identifier: MIT
// Says in one line what is wrong with a bundle of policies, where the compiler would need a page for it.
//
// A concept that fails makes compilers recite all that it stands on. So the front doors (engine, triaxial_test, runner)
// take any type; for a bundle that does not fit they become a check, whose first error names the family and what is
// missing, and stand on a repaired bundle, so that what follows in a program raises no errors of its own.
//
// Another family: a line in `named`, `repaired`, `names_all` and `families`, and a struct like those below.
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
        requires { typename P::body; }, requires { typename P::space; });
    static constexpr bool all = missing == 8;
    static_assert(missing != 1, "the bundle names no `contact`: derive it from triaxial_policies_default");
    static_assert(missing != 2, "the bundle names no `breakage`: derive it from triaxial_policies_default");
    static_assert(missing != 3, "the bundle names no `replacement`: derive it from triaxial_policies_default");
    static_assert(missing != 4, "the bundle names no `boundary`: derive it from triaxial_policies_default");
    static_assert(missing != 5, "the bundle names no `search`: derive it from triaxial_policies_default");
    static_assert(missing != 6, "the bundle names no `body`: derive it from triaxial_policies_default");
    static_assert(missing != 7, "the bundle names no `space`: derive it from triaxial_policies_default");
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
        replacements::replacement<R>, requires { R::makes_bonds; }, std::copyable<R>, requires(const R r) { r.bond; },
        requires(const R r) { r.trigger; }, requires(const R r) { r.check_interval; },
        requires(const R r, const bonds::lattice& l, const std::vector<bonds::pebble_load>& load, quaternion q,
                 vec3 w) { r.born(l, load, q, w); });
    static_assert(missing != 1, "policy replacement of the bundle lacks `static constexpr bool makes_bonds` "
                                "(clast/replacements/concepts.hpp)");
    static_assert(missing != 2, "policy replacement of the bundle cannot be copied (clast/replacements/concepts.hpp)");
    static_assert(missing != 3, "policy replacement of the bundle lacks `bond` (clast/replacements/concepts.hpp)");
    static_assert(missing != 4, "policy replacement of the bundle lacks `trigger` (clast/replacements/concepts.hpp)");
    static_assert(missing != 5, "policy replacement of the bundle lacks `check_interval` "
                                "(clast/replacements/concepts.hpp)");
    static_assert(missing != 6, "policy replacement of the bundle lacks `born(lattice, loads, orientation, spin) "
                                "const` (clast/replacements/concepts.hpp)");
    static_assert(missing != 7, "policy replacement of the bundle answers with other types than a replacement "
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

/// What policies that fit ask of each other.
template <class P> struct together {
    static constexpr bool bonds = P::replacement::makes_bonds;
    static_assert(P::body::turns || !bonds,
                  "policies body and replacement of the bundle: only bodies that turn can be replaced by bonded "
                  "clusters; take replacements::none or bodies::clumps");
    static_assert(!P::space::has_images || !bonds,
                  "policies space and replacement of the bundle: clusters in a periodic cell are not made; take "
                  "replacements::none or spaces::open");
};

/// A bundle with the default in place of each policy that does not fit.
template <class P, bool Named> struct repaired : triaxial_policies_default {};
template <class P> struct repaired<P, true> {
    using standard = triaxial_policies_default;
    template <bool Fits, class Policy, class Standard> using choice = std::conditional_t<Fits, Policy, Standard>;

    using contact = choice<contacts::contact_law<typename P::contact>, typename P::contact, standard::contact>;
    using breakage = choice<criteria::criterion<typename P::breakage>, typename P::breakage, criteria::none>;
    using boundary = choice<boundaries::surface<typename P::boundary>, typename P::boundary, standard::boundary>;
    using search = choice<searches::search<typename P::search> && std::default_initializable<typename P::search>,
                          typename P::search, standard::search>;
    using body = choice<bodies::swept<typename P::body>, typename P::body, standard::body>;
    using space = choice<spaces::space<typename P::space>, typename P::space, standard::space>;
    using replacement =
        choice<replacements::unbreakable<typename P::replacement> ||
                   (replacements::bonding<typename P::replacement> && body::turns && !space::has_images),
               typename P::replacement, replacements::none>;
};

/// A family, and whether its policy fits. The struct of one that does is never made.
template <bool Fits, class Family> struct check;
/// The first that does not fit; one is enough, and more would not be read.
struct nothing_wrong {};
template <class... Checks> struct first_wrong : std::type_identity<nothing_wrong> {};
template <bool Fits, class Family, class... Others>
struct first_wrong<check<Fits, Family>, Others...>
    : std::conditional_t<Fits, first_wrong<Others...>, std::type_identity<Family>> {};

/// All families of a bundle that names them.
template <class P>
using families =
    first_wrong<check<contacts::contact_law<typename P::contact>, contact<typename P::contact>>,
                check<criteria::criterion<typename P::breakage>, breakage<typename P::breakage>>,
                check<replacements::replacement<typename P::replacement>, replacement<typename P::replacement>>,
                check<boundaries::surface<typename P::boundary>, boundary<typename P::boundary>>,
                check<searches::search<typename P::search> && std::default_initializable<typename P::search>,
                      search<typename P::search>>,
                check<bodies::swept<typename P::body>, body<typename P::body>>,
                check<spaces::space<typename P::space>, space<typename P::space>>,
                check<simulator_policies<P>, together<P>>>;

/// Whether a bundle has a name for every family.
template <class P>
concept names_all = requires {
    typename P::contact;
    typename P::breakage;
    typename P::replacement;
    typename P::boundary;
    typename P::search;
    typename P::body;
    typename P::space;
};

} // namespace policy_checks

namespace policy_checks {
template <class P> struct first_wrong_of : std::type_identity<named<P>> {};
template <names_all P> struct first_wrong_of<P> : families<P> {};
} // namespace policy_checks

/// Compiles for a complete bundle (simulator_policies); else its first error names the family and what is missing. An
/// alias, because compilers print lines for each template between an error and the place that it comes from.
template <class P> using check_policies = typename policy_checks::first_wrong_of<P>::type;

/// A bundle to go on with where one does not fit, so that one error remains one.
template <class P> using repaired_policies = policy_checks::repaired<P, policy_checks::names_all<P>>;

} // namespace clast
