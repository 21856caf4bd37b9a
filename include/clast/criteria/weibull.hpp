// SPDX-License-Identifier: MIT
// Scatter of strength from grain to grain.
#pragma once

#include <cmath>
#include <cstdint>

#include <clast/core/random.hpp>
#include <clast/criteria/concepts.hpp>

namespace clast::criteria {

/// Strength of grain `grain` over the characteristic (37 % survival) strength: (-ln U)^(1/m), Weibull 1951, with U in
/// (0, 1) a function of seed and grain id alone. Mean Gamma(1 + 1/m); m > 0, infinity gives 1.
inline double weibull_factor(std::uint64_t seed, std::int64_t grain, double m) {
    random_stream random{mix(seed ^ 0x776569627564ULL), static_cast<std::uint64_t>(grain)};
    return std::pow(-std::log(uniform01_open(random)), 1.0 / m);
}

/// Modifier: gives every grain its own strength. The scatter goes where the size effect goes: it multiplies the
/// strength (Pa) of the model, so the limit force of hertz_contact varies with its third power. The paper has no
/// scatter.
template <evaluated_criterion C> struct weibull {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = C::needs | criteria::needs::grain_id;

    C model;
    double m = 10.0;        ///< Weibull modulus of the scatter, usually that of the size effect; infinity: no scatter
    std::uint64_t seed = 0; ///< another seed gives other grains the weak ones

    /// Strength of a grain over that of its size; also that of its bonds, once it is a cluster.
    double strength_factor(std::int64_t grain) const {
        return weibull_factor(seed, grain, m) * strength_factor_of(model, grain);
    }
    double utilisation(grain_load load) const {
        load.strength_factor *= weibull_factor(seed, load.grain, m); // the model adds its own
        return model.utilisation(load);
    }
    constexpr criteria::needs active_needs() const { return needs_of(model) | criteria::needs::grain_id; }
};

} // namespace clast::criteria
