// SPDX-License-Identifier: MIT
// Breakage by the mean stress of the grain.
#pragma once

#include <clast/criteria/detail/stress.hpp>

namespace clast::criteria {

/// u from the mean stress p = tr(sigma) / 3, (ii) in the paper's section 2.1, compression positive; tension counts as
/// 0; scaled so that the crushing test gives F / (sigma0 d0^2) for every shape.
struct mean_stress {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::needs::stress;

    crushing_strength strength;

    double utilisation(const grain_load& load) const {
        return detail::stress_utilisation(trace(load.stress) / 3.0, 1.0 / 3.0, strength, load);
    }
};

} // namespace clast::criteria
