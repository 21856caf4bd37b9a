// SPDX-License-Identifier: MIT
// Breakage by the octahedral shear stress of the grain.
#pragma once

#include <cmath>
#include <numbers>

#include <clast/criteria/detail/stress.hpp>

namespace clast::criteria {

/// u from the octahedral shear stress tau = sqrt(2 J2 / 3) of the mean stress, (i) in the paper's section 2.1 (McDowell
/// & de Bono 2013, Geotechnique 63), scaled so that the crushing test gives F / (sigma0 d0^2) for every shape. An
/// isotropic load never breaks the grain.
struct octahedral {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::needs::stress;

    crushing_strength strength;

    double utilisation(const grain_load& load) const {
        const double tau = std::sqrt(2.0 / 3.0 * invariants(load.stress).j2);
        return detail::stress_utilisation(tau, std::numbers::sqrt2 / 3.0, strength, load);
    }
};

} // namespace clast::criteria
