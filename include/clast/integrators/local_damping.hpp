// SPDX-License-Identifier: MIT
// Local (non-viscous) damping of quasi-static tests.
#pragma once

#include <cstddef>

#include <clast/core/packs.hpp>
#include <clast/core/vector.hpp>

namespace clast {

/// Damping of one degree of freedom: -a |force| sign(velocity) with sign(0) = 0, so that a body at rest stays in
/// balance. `force` is the unbalanced force without damping (N or N m), a in [0, 1) is dimensionless; 0.7 is customary.
/// Not invariant to a moving frame: it also brakes the rigid motion of a zone. Cundall (1987); paper: coefficient not
/// stated.
constexpr double damping_force(double force, double velocity, double a) {
    // no branch: signs of velocities at rest are as good as random, and would be guessed wrong
    const double sign = velocity != 0.0 ? __builtin_copysign(1.0, velocity) : 0.0;
    return -a * __builtin_fabs(force) * sign;
}

/// Local damping of a body's unbalanced force (N) by the components of its velocity (m/s) in the world frame, to be
/// added to the force; a in [0, 1). For the moment of a ball use it with moment (N m) and spin (rad/s).
constexpr vec3 damping_force(const vec3& force, const vec3& velocity, double a) {
    return {damping_force(force.x, velocity.x, a), damping_force(force.y, velocity.y, a),
            damping_force(force.z, velocity.z, a)};
}

/// The same for the first three of four numbers, in registers of N doubles; the fourth is of no use.
template <std::size_t N>
[[gnu::always_inline]] inline quad<N> damping_force(const quad<N>& force, const quad<N>& velocity, double a) {
    return -a * magnitude(force) * sign_of(velocity);
}

/// Local damping of the moment of a clump by components in its body frame: orientation q (body -> world), unbalanced
/// moment (N m) and spin (rad/s) in the world frame, result (N m) in the world frame, to be added to the moment.
constexpr vec3 damping_moment(const quaternion& q, const vec3& moment, const vec3& spin, double a) {
    return rotate(q, damping_force(rotate_back(q, moment), rotate_back(q, spin), a));
}

/// Power (W) that damping_force takes out of the body: a sum |F_i v_i|, never negative. For a clump's moment give
/// moment and spin in the body frame. `velocity` is the one at which the step moves (mid-step), so that power * dt is
/// the work exactly.
constexpr double damping_power(const vec3& force, const vec3& velocity, double a) {
    return -dot(damping_force(force, velocity, a), velocity);
}

} // namespace clast
