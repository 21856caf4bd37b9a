// SPDX-License-Identifier: MIT
// What an engine asks of a field: a force on every body that depends on where it is, how fast and when.
#pragma once

#include <concepts>

#include <clast/core/vector.hpp>

namespace clast::fields {

/// A body as a field sees it: a clump, a sphere, or a ball.
struct body_at {
    double mass = 0.0; ///< kg
    vec3 centre;       ///< m
    vec3 velocity;     ///< of the centre (m/s)
    double time = 0.0; ///< since the beginning of the run (s)
};

/// Either no field (acts is false, nothing else required) ...
template <class F>
concept absent = std::copyable<F> && requires {
    { F::acts } -> std::convertible_to<bool>;
} && !F::acts;

/// ... or a pure value, asked by several threads at once. It enters the load of a body before the integrator damps it.
/// - `force(body)`: on the body, through its centre (N);
/// - `potential(body)`: energy (J) whose negative gradient the force is, for the audit. A force without one (drag) says
///   0: then the residual of the audit shows the work that it does.
template <class F>
concept acting = std::copyable<F> && requires {
    { F::acts } -> std::convertible_to<bool>;
} && F::acts && requires(const F& field, const body_at& body) {
    { field.force(body) } -> std::same_as<vec3>;
    { field.potential(body) } -> std::convertible_to<double>;
};

template <class F>
concept field = absent<F> || acting<F>;

} // namespace clast::fields
