// SPDX-License-Identifier: MIT
// Rotation of rigid bodies: leapfrog in angular momentum (world frame) and orientation (quaternion).
//
// A step is a kick and a drift: L(n+1/2) = L(n-1/2) + dt * torque(n) by the caller, then `advance_rotation` carries the
// orientation from n to n+1 along the torque-free motion at that L. The drift is a fourth-order, time-reversible Magnus
// step about the middle of the interval, so the free motion is nearly exact and the whole is second order with one
// evaluation of the torque per step. World angular momentum is untouched by the drift: conserved to the last bit.
#pragma once

#include <algorithm>
#include <cmath>

#include <clast/core/vector.hpp>

namespace clast {

/// Result of one rotation step.
struct turned {
    quaternion q; ///< orientation after the step, body axes -> world axes, unit to rounding
    vec3 spin;    ///< world angular velocity over the step (rad/s): the step turns by the vector dt * spin
};

/// World angular velocity (rad/s) of a body with orientation q, world angular momentum L (kg m^2/s) and inverse
/// principal moments of inertia (1/(kg m^2)).
constexpr vec3 spin_of(const quaternion& q, const vec3& angular_momentum, const vec3& inverse_inertia_body) {
    return rotate(q, scale(inverse_inertia_body, rotate_back(q, angular_momentum)));
}

/// Kinetic energy of rotation (J), same arguments as spin_of.
constexpr double rotational_energy(const quaternion& q, const vec3& angular_momentum,
                                   const vec3& inverse_inertia_body) {
    const vec3 l = rotate_back(q, angular_momentum);
    return 0.5 * dot(l, scale(inverse_inertia_body, l));
}

/// Square of the angle of a step (rad^2) below which the series about its start is exact to rounding.
inline constexpr double small_step2 = 1e-8;

namespace detail {

/// Mean angular velocity (rotation vector over k, rad/s), in the body axes at the start, of the torque-free motion over
/// the time k from the body angular momentum l: Magnus series, error k^3. A negative k goes back in time.
constexpr vec3 free_spin(const vec3& l, const vec3& inverse_inertia, double k) {
    const vec3 w = scale(inverse_inertia, l);
    const vec3 rate = cross(l, w); // dl/dt as the body sees it
    const vec3 w1 = scale(inverse_inertia, rate);
    const vec3 w2 = scale(inverse_inertia, cross(rate, w) + cross(l, w1)); // second derivative as the body sees it
    return w + (0.5 * k) * (w1 + (k / 3.0) * (w2 + 0.5 * cross(w, w1)));
}

/// Quaternion of a rotation vector below 1e-2 rad: the series is exact to rounding and needs no square root.
constexpr quaternion small_rotation(const vec3& angle) {
    const double h2 = 0.25 * norm2(angle);
    const double s = 0.5 - h2 * (1.0 / 12.0 - h2 / 240.0);
    return {1.0 - h2 * (0.5 - h2 / 24.0), s * angle.x, s * angle.y, s * angle.z};
}

/// One Newton step towards unit length: enough, because a product of unit quaternions is off by rounding only.
constexpr quaternion renormalised(const quaternion& q) {
    const double s = 1.5 - 0.5 * (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {s * q.w, s * q.x, s * q.y, s * q.z};
}

/// Rotation vector (rad) of a unit quaternion that turns by less than pi.
inline vec3 rotation_vector(const quaternion& q) {
    const vec3 v{q.x, q.y, q.z};
    const double sine = norm(v);
    return sine > 0.0 ? (2.0 * std::atan2(sine, q.w) / sine) * v : vec3{};
}

} // namespace detail

/// Torque-free motion of one rigid body over dt (s): call it with the angular momentum at the middle of the step,
/// L(n+1/2) = L(n-1/2) + dt * torque(n), which stays as it is. Order 4 in |w| dt torque-free, order 2 with torques;
/// time-reversible, so that the energy does not drift. Valid for |w| dt up to about 1 rad (quasi-static tests: 1e-5);
/// no error is raised, beyond that limit the step only loses accuracy. Equal moments (bit-equal, as `shape` makes them)
/// take the short cut spin = L / I. Zero inverse inertia means a body that does not turn.
///
/// Method: Magnus expansion about the middle orientation, found by a counted fixed-point iteration; below 1e-4 rad the
/// same series about the start is exact to rounding and no iteration is needed. Series: Blanes, Casas, Oteo & Ros
/// (2009), Physics Reports 470, 151-238.
inline turned advance_rotation(const quaternion& q, const vec3& angular_momentum, const vec3& inverse_inertia_body,
                               double dt) {
    const vec3& inverse = inverse_inertia_body;
    if (inverse.x == inverse.y && inverse.y == inverse.z) {
        const vec3 spin = inverse.x * angular_momentum;
        const vec3 angle = dt * spin;
        const quaternion turn = norm2(angle) < 1e-4 ? detail::small_rotation(angle) : rotation(angle);
        return {detail::renormalised(turn * q), spin};
    }
    const vec3 l = rotate_back(q, angular_momentum);
    const double largest = std::max({inverse.x, inverse.y, inverse.z});
    const double angle2 = norm2(l) * (largest * largest * dt * dt); // bound of (|w| dt)^2
    if (angle2 < small_step2) {
        const vec3 spin = detail::free_spin(l, inverse, dt);
        return {detail::renormalised(q * detail::small_rotation(dt * spin)), rotate(q, spin)};
    }
    // Half a step to the middle, by the series about the middle itself: implicit, and each pass gains a factor of about
    // |w| dt / 2. The numbers of passes reach rounding.
    const bool small = angle2 < 1e-4;
    const int passes = small ? 1 : angle2 < 1e-2 ? 7 : 30;
    const double h = 0.5 * dt;
    const auto turned_by = [small](const vec3& angle) {
        return small ? detail::small_rotation(angle) : rotation(angle);
    };
    vec3 middle = rotate_back(turned_by(h * detail::free_spin(l, inverse, h)), l);
    for (int i = 0; i < passes; ++i) middle = rotate_back(turned_by(h * detail::free_spin(middle, inverse, -h)), l);
    const quaternion turn =
        turned_by(h * detail::free_spin(middle, inverse, -h)) * turned_by(h * detail::free_spin(middle, inverse, h));
    return {detail::renormalised(q * turn), rotate(q, detail::rotation_vector(turn)) / dt};
}

} // namespace clast
