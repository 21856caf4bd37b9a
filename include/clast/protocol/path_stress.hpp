// SPDX-License-Identifier: MIT
// The stresses of a specimen by name, as its walls measure them: of a cylinder, and of a box that is driven along three
// axes.
#pragma once

#include <cmath>
#include <span>

#include <clast/boundaries/axial.hpp>
#include <clast/boundaries/touch.hpp>

namespace clast::protocol {

/// Stresses of the walls (Pa, compression positive). Axes, not sizes, give the names: sigma_1 is axial, also in
/// extension, where it is the smallest.
struct path_stress {
    double sigma_1 = 0.0; ///< axial
    double sigma_2 = 0.0; ///< of the walls normal to y, where they are driven apart; else sigma_3
    double sigma_3 = 0.0; ///< of the lateral wall, or of the walls normal to x
    double q = 0.0; ///< sigma_1 - sigma_3, negative in extension; with sigma_2 of its own sqrt(3 J_2), never negative
    double p = 0.0; ///< mean of the three
};

/// q of three principal stresses: sqrt(3 J_2) (in the unit of the stresses).
inline double deviator_of(double a, double b, double c) {
    return std::sqrt(0.5 * ((a - b) * (a - b) + (b - c) * (b - c) + (c - a) * (c - a)));
}

/// A boundary whose three axes are measured apart: `stress(loads, axis)`, 0 to 2 for x to z.
template <class B>
concept has_three_axes = requires(const B& b, std::span<const boundaries::facet_load> loads) {
    b.stress(loads, 0);
};

/// three_axes: whether the walls normal to y are driven apart.
template <class B>
path_stress stress_of(const B& b, std::span<const boundaries::facet_load> loads, [[maybe_unused]] bool three_axes) {
    path_stress s;
    if constexpr (has_three_axes<B>)
        if (three_axes) {
            s.sigma_1 = b.stress(loads, 2), s.sigma_2 = b.stress(loads, 1), s.sigma_3 = b.stress(loads, 0);
            s.q = deviator_of(s.sigma_1, s.sigma_2, s.sigma_3);
            s.p = (s.sigma_1 + s.sigma_2 + s.sigma_3) / 3.0;
            return s;
        }
    s.sigma_2 = s.sigma_3 = b.lateral_stress(loads);
    s.q = boundaries::deviator(b, loads);
    s.sigma_1 = s.sigma_3 + s.q;
    s.p = s.sigma_3 + s.q / 3.0;
    return s;
}

} // namespace clast::protocol
