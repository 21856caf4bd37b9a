// SPDX-License-Identifier: MIT
// Invariants and largest principal value of a symmetric 3 x 3 tensor, in closed form.
#pragma once

#include <algorithm>
#include <cmath>

#include <clast/core/vector.hpp>

namespace clast {

/// Invariants of the symmetric part of a tensor: its mean, and the second and third invariant of its deviator.
struct symmetric_invariants {
    double mean = 0.0; ///< trace / 3
    double j2 = 0.0;   ///< s_ij s_ij / 2, never negative
    double j3 = 0.0;   ///< det s
};

constexpr symmetric_invariants invariants(const mat3& m) {
    const double mean = trace(m) / 3.0;
    const double xx = m(0, 0) - mean, yy = m(1, 1) - mean, zz = m(2, 2) - mean;
    const double xy = 0.5 * (m(0, 1) + m(1, 0)), xz = 0.5 * (m(0, 2) + m(2, 0)), yz = 0.5 * (m(1, 2) + m(2, 1));
    return {mean, 0.5 * (xx * xx + yy * yy + zz * zz) + xy * xy + xz * xz + yz * yz,
            xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)};
}

/// Largest principal value by the trigonometric solution of the cubic (Smith 1961, Communications of the ACM 4).
/// Relative error 1e-15 to 1e-8, the latter near two equal values.
inline double largest_principal(const symmetric_invariants& i) {
    if (!(i.j2 > 0.0)) return i.mean;
    const double root = std::sqrt(i.j2 / 3.0);
    const double cosine = std::clamp(0.5 * i.j3 / (root * root * root), -1.0, 1.0);
    return i.mean + 2.0 * root * std::cos(std::acos(cosine) / 3.0);
}

/// Largest principal value of the symmetric part of m.
inline double largest_principal(const mat3& m) { return largest_principal(invariants(m)); }

} // namespace clast
