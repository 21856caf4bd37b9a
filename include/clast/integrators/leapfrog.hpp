// SPDX-License-Identifier: MIT
// Leapfrog with local damping: the scheme of quasi-static tests.
#pragma once

#include <array>

#include <clast/integrators/concepts.hpp>
#include <clast/integrators/local_damping.hpp>

namespace clast::integrators {

/// v(n+1/2) = v(n-1/2) + dt (F + D) / m, x(n+1) = x(n) + dt v(n+1/2), with the local damping D of local_damping.hpp; in
/// the same way angular momentum and orientation (rotation.hpp). Second order, one evaluation of forces per step,
/// symplectic where nothing is damped.
struct leapfrog {
    double damping = 0.7; ///< coefficient of local damping, in [0, 1)

    struct memory {};
    static constexpr std::array<stage, 1> stages{{{1.0, 1.0}}};

    constexpr bool damps() const { return damping != 0.0; }
    template <class V> [[gnu::always_inline]] constexpr V extra(const V& force, const V& v) const {
        return damping_force(force, v, damping);
    }
    template <class V> [[gnu::always_inline]] constexpr V kick(const V& v, const V& force, double by) const {
        return v + by * force;
    }
};

} // namespace clast::integrators
