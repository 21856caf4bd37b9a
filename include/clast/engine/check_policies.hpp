// SPDX-License-Identifier: MIT
// Says in one line what is wrong with a bundle of policies, where the compiler would need a page for it.
//
// A concept that fails makes compilers recite all that it stands on. So the front doors (engine, triaxial_test, runner)
// take any type; for a bundle that does not fit they become a check, whose first error names the family and what is
// missing, and stand on a repaired bundle, so that what follows in a program raises no errors of its own.
//
// Another family: a line in `named`, `repaired`, `names_all` and `families`, and a struct in
// detail/policy_checks.hpp.
#pragma once

#include <concepts>
#include <type_traits>

#include <clast/engine/detail/policy_checks.hpp>
#include <clast/engine/policies.hpp>

namespace clast {

namespace policy_checks {

/// What policies that fit ask of each other.
template <class P> struct together {
    static constexpr bool replaces = P::replacement::replaces;
    static constexpr bool bonds = replacements::makes_bonds<typename P::replacement>();
    static_assert(P::body::turns || !replaces,
                  "policies body and replacement of the bundle: only bodies that turn can be replaced; take "
                  "replacements::none or bodies::clumps");
    static_assert(!P::space::has_images || !replaces,
                  "policies space and replacement of the bundle: breakage in a periodic cell is not made; take "
                  "replacements::none or spaces::open");
    static_assert(!bonds || integrators::multirate<typename P::scheme>,
                  "policies scheme and replacement of the bundle: balls and bonds take steps of their own, for which a "
                  "scheme has one stage, no memory, no turn and a member `damping`; take integrators::leapfrog");
    static_assert(P::scheme::stages.size() == 1 || std::same_as<typename P::constraint, constraints::none>,
                  "policies scheme and constraint of the bundle: constraints act on schemes of one stage; take "
                  "constraints::none or integrators::leapfrog");
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
    using scheme = choice<integrators::scheme<typename P::scheme>, typename P::scheme, standard::scheme>;
    using field = choice<fields::field<typename P::field>, typename P::field, standard::field>;
    using replacement = choice<replacements::unbreakable<typename P::replacement> ||
                                   (replacements::replacing<typename P::replacement> && body::turns &&
                                    !space::has_images && integrators::multirate<scheme>),
                               typename P::replacement, replacements::none>;
    using constraint = choice<constraints::constraint<typename P::constraint, body> && scheme::stages.size() == 1,
                              typename P::constraint, constraints::none>;
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
                check<integrators::scheme<typename P::scheme>, scheme<typename P::scheme>>,
                check<fields::field<typename P::field>, field<typename P::field>>,
                check<constraints::constraint<typename P::constraint, typename P::body>,
                      constraint<typename P::constraint, typename P::body>>,
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
    typename P::scheme;
    typename P::field;
    typename P::constraint;
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
