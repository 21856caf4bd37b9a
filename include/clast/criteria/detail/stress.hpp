// SPDX-License-Identifier: MIT
// The common scale of the stress criteria.
#pragma once

#include <algorithm>

#include <clast/core/symmetric.hpp>
#include <clast/criteria/concepts.hpp>
#include <clast/criteria/strength.hpp>

namespace clast::criteria::detail {

/// Utilisation of a stress measure that is `in_crushing` times the major stress under two opposite forces: F at the
/// distance d makes sigma_1 = F d / V, so that measure * V / d^3 / in_crushing is F/d^2, whatever the shape.
inline double stress_utilisation(double measure, double in_crushing, const crushing_strength& strength,
                                 const grain_load& load) {
    const double d = load.diameter;
    const double nominal = std::max(0.0, measure) * load.volume / (d * d * d) / in_crushing;
    return nominal / strength.at(d, load.strength_factor);
}

} // namespace clast::criteria::detail
