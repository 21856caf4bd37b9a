// SPDX-License-Identifier: MIT
// What an engine asks of constraints: what is prescribed of single bodies, and what acts on them from outside.
#pragma once

#include <concepts>
#include <cstddef>

#include <clast/bodies/contact_list.hpp>
#include <clast/core/vector.hpp>

namespace clast::constraints {

/// Bodies whose motion can be set.
template <class B>
concept settable = requires(B& bodies, const B& seen, std::size_t body, vec3 v) {
    { B::turns } -> std::convertible_to<bool>;
    { seen.body_count() } -> std::same_as<std::size_t>;
    { seen.is_swept(body) } -> std::same_as<bool>;
    { seen.velocity(body) } -> std::convertible_to<vec3>;
    { seen.spin(body) } -> std::convertible_to<vec3>;
    { seen.kinetic_energy(body) } -> std::same_as<double>;
    bodies.set_velocity(body, v);
    bodies.set_spin(body, v);
};

namespace detail {
struct any_archive {
    template <class... Members> void operator()(Members&...) {}
};
} // namespace detail

/// Either no constraint (acts is false, nothing else required) ...
template <class C>
concept absent = std::copyable<C> && requires {
    { C::acts } -> std::convertible_to<bool>;
} && !C::acts;

/// ... or a value that a scene holds and saves. Bodies are numbered as in their table.
/// - `begin_step(bodies, time)`: before forces are found at a time (s); may set velocities, and returns the work (J)
///   that this took. Throws input_error or run_error where it cannot hold what it should.
/// - `act(body, load)`: adds to the load of a body, or takes from it; called for every body, and at the same time for
///   different ones. Without a force along an axis a body keeps its velocity to the last bit, and nothing is damped.
/// - `end_step(bodies, dt)`: bodies have moved for dt (s); returns the work (J) done on them, in an order of its own
///   that does not depend on threads.
/// - `outer_force(body)`: what came from outside in the last step, reactions included (N).
/// - `is_fixed(body)`: whether forces move it in no way, so that it does not limit the time step;
/// - `take_change()`: whether that changed for a body since it was last asked;
/// - `archive(a)`: passes the complete state.
template <class C, class Body>
concept holding = std::copyable<C> && std::default_initializable<C> && requires {
    { C::acts } -> std::convertible_to<bool>;
} && C::acts &&
    requires(C& c, const C& seen, Body& bodies, std::size_t body, load_sum& load, double time, detail::any_archive& a) {
    { c.begin_step(bodies, time) } -> std::convertible_to<double>;
    c.act(body, load);
    { c.end_step(bodies, time) } -> std::convertible_to<double>;
    { seen.outer_force(body) } -> std::same_as<vec3>;
    { seen.is_fixed(body) } -> std::same_as<bool>;
    { c.take_change() } -> std::same_as<bool>;
    c.archive(a);
};

template <class C, class Body>
concept constraint = absent<C> || holding<C, Body>;

} // namespace clast::constraints
