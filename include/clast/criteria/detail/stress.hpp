// SPDX-License-Identifier: MIT
// Invariants of the mean stress of a grain, and the common scale of the stress criteria.
#pragma once

#include <algorithm>
#include <cmath>

#include <clast/criteria/concepts.hpp>
#include <clast/criteria/strength.hpp>

namespace clast::criteria::detail {

/// Invariants of the symmetric part of a stress: mean p, second and third invariant of the deviator.
struct stress_invariants {
    double p = 0.0;  ///< Pa
    double j2 = 0.0; ///< Pa^2
    double j3 = 0.0; ///< Pa^3
};

inline stress_invariants invariants(const mat3& s) {
    const double p = trace(s) / 3.0;
    const double xx = s(0, 0) - p, yy = s(1, 1) - p, zz = s(2, 2) - p;
    const double xy = 0.5 * (s(0, 1) + s(1, 0)), xz = 0.5 * (s(0, 2) + s(2, 0)), yz = 0.5 * (s(1, 2) + s(2, 1));
    return {p, 0.5 * (xx * xx + yy * yy + zz * zz) + xy * xy + xz * xz + yz * yz,
            xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)};
}

/// Largest principal stress by the trigonometric solution of the cubic (Smith 1961).
inline double major(const stress_invariants& i) {
    if (!(i.j2 > 0.0)) return i.p;
    const double cosine = std::clamp(0.5 * i.j3 * std::pow(3.0 / i.j2, 1.5), -1.0, 1.0);
    return i.p + 2.0 * std::sqrt(i.j2 / 3.0) * std::cos(std::acos(cosine) / 3.0);
}

/// Utilisation of a stress measure that is `in_crushing` times the major stress under two opposite forces: F at the
/// distance d makes sigma_1 = F d / V, so that measure * V / d^3 / in_crushing is F/d^2, whatever the shape.
inline double stress_utilisation(double measure, double in_crushing, const crushing_strength& strength,
                                 const grain_load& load) {
    const double d = load.diameter;
    const double nominal = std::max(0.0, measure) * load.volume / (d * d * d) / in_crushing;
    return nominal / strength.at(d, load.strength_factor);
}

} // namespace clast::criteria::detail
