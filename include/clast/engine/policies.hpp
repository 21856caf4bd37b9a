// SPDX-License-Identifier: MIT
// A bundle of policies: one type that says what a simulator is made of.
#pragma once

#include <concepts>

#include <clast/bodies/clumps.hpp>
#include <clast/bodies/concepts.hpp>
#include <clast/boundaries/concepts.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/constraints/concepts.hpp>
#include <clast/constraints/none.hpp>
#include <clast/contacts/concepts.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/criteria/concepts.hpp>
#include <clast/criteria/nominal_force.hpp>
#include <clast/criteria/none.hpp>
#include <clast/fields/concepts.hpp>
#include <clast/fields/none.hpp>
#include <clast/integrators/concepts.hpp>
#include <clast/integrators/leapfrog.hpp>
#include <clast/replacements/concepts.hpp>
#include <clast/replacements/modified.hpp>
#include <clast/replacements/none.hpp>
#include <clast/searches/cell_grid.hpp>
#include <clast/searches/concepts.hpp>
#include <clast/spaces/concepts.hpp>
#include <clast/spaces/open.hpp>

namespace clast {

/// The paper's simulator: linear contacts, maximum-force criterion, MPRM, tile membrane. Derive from it and name what
/// shall be different.
struct triaxial_policies_default {
    using contact = contacts::linear;
    using breakage = criteria::nominal_force;
    using replacement = replacements::modified;
    using boundary = boundaries::tiles;
    using search = searches::cell_grid;
    using body = bodies::clumps; // or bodies::spheres, which never break
    using space = spaces::open;
    using scheme = integrators::leapfrog; // integrator and damping
    using field = fields::none;           // or fields::gravity
    using constraint = constraints::none; // or constraints::held
};

/// What policies ask of each other: only clumps in open space are replaced, balls and bonds take steps of their own,
/// and constraints act once in a step.
template <class P>
concept fit_together = requires {
    requires !P::replacement::replaces || (P::body::turns && !P::space::has_images);
    requires !replacements::makes_bonds<typename P::replacement>() || integrators::multirate<typename P::scheme>;
    requires P::scheme::stages.size() == 1 || std::same_as<typename P::constraint, constraints::none>;
};

/// A complete bundle, as an engine uses it. A policy that is missing or does not satisfy its own concept is named by
/// the compiler.
template <class P>
concept simulator_policies = contacts::contact_law<typename P::contact> &&
    replacements::replacement<typename P::replacement> && criteria::criterion<typename P::breakage> &&
    boundaries::surface<typename P::boundary> && searches::search<typename P::search> &&
    std::default_initializable<typename P::search> && bodies::swept<typename P::body> &&
    spaces::space<typename P::space> && integrators::scheme<typename P::scheme> && fields::field<typename P::field> &&
    constraints::constraint<typename P::constraint, typename P::body> && fit_together<P>;

} // namespace clast
