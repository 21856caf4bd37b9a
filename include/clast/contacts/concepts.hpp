// SPDX-License-Identifier: MIT
// What a contact law is: parameters, a history per contact, and one pure call.
#pragma once

#include <concepts>
#include <type_traits>

namespace clast::contacts {

/// Geometry and inertia of a contact of pebble i with pebble j, or with a wall, at the present instant. A wall is flat
/// and does not yield: its curvature and inverse mass are 0. T is any arithmetic-like type.
template <class T> struct overlap {
    T nx, ny, nz;       ///< unit normal from i to j
    T depth;            ///< overlap (m), positive when touching
    T curvature_i;      ///< 1 / radius of the pebble (1/m)
    T curvature_j;      ///< (1/m); a wall's is 0
    T inverse_mass_i{}; ///< of the body of i (1/kg): the clump, or the ball
    T inverse_mass_j{}; ///< (1/kg); a wall's is 0
    /// Materials of i and j by their numbers, for laws that read them; -1: not known, or a wall.
    T material_i{-1}, material_j{-1};

    /// R of Hertz' theory, 1/R = 1/R_i + 1/R_j (m).
    constexpr T reduced_radius() const { return 1.0 / (curvature_i + curvature_j); }
    /// m of a collision, 1/m = 1/m_i + 1/m_j (kg).
    constexpr T reduced_mass() const { return 1.0 / (inverse_mass_i + inverse_mass_j); }
};

/// Relative motion over the last step, at the contact point.
template <class T> struct motion {
    T ux, uy, uz;       ///< tangential displacement of i relative to j over the step (m), normal to the mid-step normal
    T spin;             ///< mean rotation of both bodies about the normal over the step (rad)
    T approach;         ///< normal speed of approach (m/s)
    T mx{}, my{}, mz{}; ///< normal of mid-step, of any length
    T reflect{};        ///< 2 / (m . m); 0: the normal has not turned
    /// Rotation of i relative to j over the step (rad): along the normal they twist, across it they roll.
    T rx{}, ry{}, rz{};
};

/// Turns a vector of the old contact plane into the new one: v - reflect (m . v) m. A reflection keeps its size, and as
/// m halves the angle between the two normals, it takes what is normal to the old one to what is normal to the new one,
/// like the smallest rotation between them.
template <class T> void turn(const motion<T>& m, T& x, T& y, T& z) {
    const T a = m.reflect * (m.mx * x + m.my * y + m.mz * z);
    x -= a * m.mx, y -= a * m.my, z -= a * m.mz;
}

/// Turns a tangential vector that a contact remembers with it: into the new contact plane and by the spin (rad, small
/// against 1), without a change of size, because a turn must not do work.
template <class T>
[[gnu::always_inline]] inline void turn_with(const overlap<T>& o, const motion<T>& m, T& x, T& y, T& z) {
    T ax = x, ay = y, az = z;
    turn(m, ax, ay, az);
    const T along = ax * o.nx + ay * o.ny + az * o.nz; // what rounding and a change of distance in the step leave
    ax -= along * o.nx, ay -= along * o.ny, az -= along * o.nz;
    // cosine and sine of a small angle, whose squares add up to 1 but for its eighth power
    const T q = m.spin * m.spin;
    const T c = 1.0 - q * (0.5 - q * (1.0 / 24.0 - q * (1.0 / 720.0)));
    const T k = m.spin * (1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0)));
    x = c * ax + k * (o.ny * az - o.nz * ay);
    y = c * ay + k * (o.nz * ax - o.nx * az);
    z = c * az + k * (o.nx * ay - o.ny * ax);
}

/// What a law answers.
template <class T> struct response {
    T fx, fy, fz; ///< force on i (N); the force on j is opposite
    T dissipated; ///< energy dissipated by the contact in this step (J)
};
/// What a law with moments of its own answers. The moments that forces have about the centres are no part of it.
template <class T> struct wrench : response<T> {
    T mx{}, my{}, mz{}; ///< moment on i (N m); the moment on j is opposite
};

/// A law declares its `history` (trivially copyable; empty if it has none) and answers to geometry and motion with a
/// response or a wrench. It is asked about listed pairs that do not touch (depth <= 0), too: their force is dropped,
/// their history and losses count. `stored` is the elastic energy that it holds (J); the stiffnesses (N/m) feed the
/// time-step estimate and the servo. It may also say
/// - `static constexpr bool constant_stiffness = true`: stiffnesses do not depend on the overlap; the estimate is
///   cheaper then;
/// - `static constexpr bool uses_masses = false`: it reads no mass, so none is gathered for it;
/// - `static constexpr bool reads_materials = true`: it reads materials, so they are gathered for it;
/// - `double rolling_stiffness(o) const` and `twisting_stiffness(o)` (N m): of moments that resist a relative rotation;
/// - `history reversed() const`, a member of its history: the same contact seen from pebble j; without, a contact of
///   two fragments of one grain may begin anew when these freeze;
/// - `double reach() const`: how far beyond touch two pebbles feel each other (m), >= 0; at walls it acts on touch.
template <class L>
concept contact_law = std::copyable<L> && std::is_trivially_copyable_v<typename L::history> &&
    std::default_initializable<typename L::history> &&
    requires(const L law, overlap<double> o, motion<double> m, typename L::history& h, const typename L::history& ch,
             double dt) {
    { law(o, m, h, dt) } -> std::convertible_to<response<double>>;
    { law.stored(o, ch) } -> std::convertible_to<double>;
    { law.normal_stiffness(o) } -> std::convertible_to<double>;
    { law.shear_stiffness(o) } -> std::convertible_to<double>;
};

/// A law with Coulomb friction, whose coefficient is its member `mu`.
template <class L>
concept frictional = requires(L law) {
    { law.mu } -> std::convertible_to<double>;
};

/// A law whose moments resist a relative rotation.
template <class L>
concept resists_rotation = requires(const L law, overlap<double> o) {
    { law.rolling_stiffness(o) } -> std::convertible_to<double>;
    { law.twisting_stiffness(o) } -> std::convertible_to<double>;
};

/// How far beyond touch pebbles feel each other (m).
template <class L> constexpr double reach_of([[maybe_unused]] const L& law) {
    if constexpr (requires { law.reach(); }) return law.reach();
    return 0.0;
}
/// What a contact remembers when its pebbles change sides, i for j: what a history says of itself (`reversed() const`);
/// nothing if it does not.
template <class H> constexpr H reversed(const H& h) {
    if constexpr (requires { h.reversed(); })
        return h.reversed();
    else
        return H{};
}
/// Whether masses are gathered for a law.
template <class L> constexpr bool reads_masses() {
    if constexpr (requires { L::uses_masses; }) return L::uses_masses;
    return true;
}
/// Whether materials are gathered for a law.
template <class L> constexpr bool reads_materials() {
    if constexpr (requires { L::reads_materials; }) return L::reads_materials;
    return false;
}
/// Whether its stiffnesses are the same at any overlap.
template <class L> constexpr bool is_of_constant_stiffness() {
    if constexpr (requires { L::constant_stiffness; }) return L::constant_stiffness;
    return false;
}

} // namespace clast::contacts
