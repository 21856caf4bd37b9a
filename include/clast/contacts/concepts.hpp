// SPDX-License-Identifier: MIT
// What a contact law is: parameters, a history per contact, and one pure call.
#pragma once

#include <concepts>
#include <type_traits>

namespace clast::contacts {

/// Geometry of a contact of pebbles i and j at the present instant. T is any arithmetic-like type.
template <class T> struct overlap {
    T nx, ny, nz; ///< unit normal from i to j
    T depth;      ///< overlap (m), positive when touching
    T radius_i;   ///< (m)
    T radius_j;   ///< (m); a wall passes the radius of i
};

/// Relative motion over the last step, at the contact point.
template <class T> struct motion {
    T ux, uy, uz;       ///< tangential displacement of i relative to j over the step (m), normal to the mid-step normal
    T spin;             ///< mean rotation of both bodies about the normal over the step (rad)
    T approach;         ///< normal speed of approach (m/s)
    T mx{}, my{}, mz{}; ///< normal of mid-step, of any length
    T reflect{};        ///< 2 / (m . m); 0: the normal has not turned
};

/// Turns a vector of the old contact plane into the new one: v - reflect (m . v) m. A reflection keeps its size, and as
/// m halves the angle between the two normals, it takes what is normal to the old one to what is normal to the new one,
/// like the smallest rotation between them.
template <class T> void turn(const motion<T>& m, T& x, T& y, T& z) {
    const T a = m.reflect * (m.mx * x + m.my * y + m.mz * z);
    x -= a * m.mx, y -= a * m.my, z -= a * m.mz;
}

/// What a law answers.
template <class T> struct response {
    T fx, fy, fz; ///< force on i (N); the force on j is opposite
    T dissipated; ///< energy dissipated by the contact in this step (J)
};

/// A law declares its `history` (trivially copyable; empty if it has none) and answers to geometry and motion. It is
/// asked about listed pairs that do not touch (depth <= 0), too: their force is dropped, their history and losses
/// count. `stored` is the elastic energy that it holds (J); the stiffnesses (N/m) feed the time-step estimate and the
/// servo. A law whose stiffnesses do not depend on the overlap may say so, `static constexpr bool constant_stiffness =
/// true`: the estimate is cheaper then.
template <class L>
concept contact_law = std::copyable<L> && std::is_trivially_copyable_v<typename L::history> &&
    std::default_initializable<typename L::history> &&
    requires(const L law, overlap<double> o, motion<double> m, typename L::history& h, const typename L::history& ch,
             double dt) {
    { law(o, m, h, dt) } -> std::same_as<response<double>>;
    { law.stored(o, ch) } -> std::convertible_to<double>;
    { law.normal_stiffness(o) } -> std::convertible_to<double>;
    { law.shear_stiffness(o) } -> std::convertible_to<double>;
};

} // namespace clast::contacts
