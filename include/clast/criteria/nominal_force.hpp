// SPDX-License-Identifier: MIT
// Breakage by the largest contact force over d^2: the default criterion.
#pragma once

#include <clast/criteria/concepts.hpp>
#include <clast/criteria/strength.hpp>

namespace clast::criteria {

/// u = F_max / (sigma0 (d/d0)^(-3/m) d^2): the criterion (iv) of the paper's section 2.1 with the strength of its Table
/// 1, which is a platen force over d^2. The limit force grows as d^(2 - 3/m). Of five criteria only this one gave the
/// normal compression line and the fractal grading of sand (de Bono & McDowell 2016, Geotechnique 66).
struct nominal_force {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::needs::largest_force;

    crushing_strength strength;
    force_of which = force_of::neighbour;

    /// Force at which the grain breaks (N).
    double limit(const grain_load& load) const {
        return strength.at(load.diameter, load.strength_factor) * load.diameter * load.diameter;
    }
    double utilisation(const grain_load& load) const { return force(load, which) / limit(load); }
};

} // namespace clast::criteria
