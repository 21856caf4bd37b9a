// SPDX-License-Identifier: MIT
// Breakage by the major principal stress of the grain.
#pragma once

#include <clast/criteria/detail/stress.hpp>

namespace clast::criteria {

/// u from the largest principal stress, (iii) in the paper's section 2.1, compression positive; tension counts as 0;
/// scaled so that the crushing test gives F / (sigma0 d0^2) for every shape.
struct major_principal {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::needs::stress;

    crushing_strength strength;

    double utilisation(const grain_load& load) const {
        return detail::stress_utilisation(largest_principal(load.stress), 1.0, strength, load);
    }
};

} // namespace clast::criteria
