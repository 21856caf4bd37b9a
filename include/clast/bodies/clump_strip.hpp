// SPDX-License-Identifier: MIT
// Clumps by strips of 16: their motion over one step, side by side, as compilers vectorise it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <clast/core/lanes.hpp>
#include <clast/core/vector.hpp>
#include <clast/integrators/concepts.hpp>
#include <clast/integrators/rotation.hpp>

namespace clast {

/// State, load and result of up to 16 clumps. Lanes are computed by eights, so those that are not used must hold
/// numbers, too, whichever.
struct clump_strip {
    static constexpr std::size_t length = 16;
    using row = double[length];

    std::size_t size = 0;
    std::size_t body[length];                        ///< numbers of the bodies
    alignas(64) row fx, fy, fz;                      ///< force (N)
    row mx, my, mz;                                  ///< moment about the centre (N m)
    row x, y, z, vx, vy, vz;                         ///< centre (m) and its velocity (m/s)
    row wx, wy, wz;                                  ///< spin of the last step, then of this one (rad/s)
    row lx, ly, lz;                                  ///< angular momentum (kg m^2/s)
    row qw, qx, qy, qz;                              ///< orientation before
    row nw, nx, ny, nz;                              ///< and after the step
    row inverse_mass, ix, iy, iz;                    ///< 1/kg, and 1/(kg m^2) in the body's axes
    row cx, cy, cz, tw, tx, ty, tz;                  ///< centre (m) and orientation from which displacements count
    row reach;                                       ///< radius of the circumscribed sphere (m)
    row scale;                                       ///< size over that of the shape
    row damped;                                      ///< energy lost to damping (J)
    row angle2;                                      ///< upper bound of the squared angle of the step (rad^2)
    row r00, r01, r02, r10, r11, r12, r20, r21, r22; ///< matrix of the new orientation
    row moved;                                       ///< largest way of a point of the clump (m)

    std::size_t lanes() const { return whole_lanes(size); }
};

/// Upper bound (m) of the way of a point of a body that has moved by `by` (m) and turned from one orientation to
/// another; reach: radius around the centre that holds all its points (m).
[[gnu::always_inline]] inline double way_of(const vec3& by, const quaternion& from, const quaternion& to,
                                            double reach) {
    const quaternion d = conjugate(from) * to;
    const double turned_by = 2.0 * std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z); // chord of a unit radius
    return norm(by) + reach * turned_by;
}

namespace detail {

/// Kick and drift of lane k by a rule; `advance_rotation` for steps of small angle.
template <class Rule>
[[gnu::always_inline, gnu::flatten]] inline void advance_lane(clump_strip& s, std::size_t k, const Rule& rule) {
    using scheme_type = decltype(rule.scheme);
    const quaternion q{s.qw[k], s.qx[k], s.qy[k], s.qz[k]};
    const mat3 turn = matrix(q), back = transpose(turn);
    const vec3 force{s.fx[k], s.fy[k], s.fz[k]}, moment{s.mx[k], s.my[k], s.mz[k]};
    const vec3 x{s.x[k], s.y[k], s.z[k]}, v{s.vx[k], s.vy[k], s.vz[k]}, l{s.lx[k], s.ly[k], s.lz[k]};
    const vec3 inverse{s.ix[k], s.iy[k], s.iz[k]};
    // damping of the force by components in the world frame, of the moment in the body frame
    const vec3 df = rule.scheme.extra(force, rule.flow.relative(v, x, rule.drift));
    const vec3 w = back * vec3{s.wx[k], s.wy[k], s.wz[k]};
    const vec3 dm = rule.scheme.extra(back * moment, w);
    typename scheme_type::memory *of_v = nullptr, *of_l = nullptr;
    if constexpr (!integrators::forgetful<scheme_type>)
        of_v = &rule.memory[s.body[k]].translation, of_l = &rule.memory[s.body[k]].rotation;
    const vec3 faster = rule.kicked(v, force + df, rule.kick * s.inverse_mass[k], of_v);
    const vec3 more = rule.kicked(l, moment + turn * dm, rule.kick, of_l);
    const vec3 in_body = back * more;
    s.damped[k] = -0.5 * rule.kick * (dot(df, v + faster) + dot(dm, w + scale(inverse, in_body)));
    vec3 world_spin;
    quaternion next;
    if constexpr (integrators::turns_itself<scheme_type>) {
        const turned t = rule.scheme.turn(q, more, inverse, rule.drift);
        next = t.q, world_spin = t.spin;
        s.angle2[k] = 0.0;
    } else {
        const vec3 spin = free_spin(in_body, inverse, rule.drift);
        next = renormalised(q * small_rotation(rule.drift * spin));
        world_spin = turn * spin;
        const double largest = larger(inverse.x, larger(inverse.y, inverse.z));
        s.angle2[k] = norm2(more) * (largest * largest * rule.drift * rule.drift);
    }
    s.vx[k] = faster.x, s.vy[k] = faster.y, s.vz[k] = faster.z;
    s.lx[k] = more.x, s.ly[k] = more.y, s.lz[k] = more.z;
    s.x[k] += rule.drift * faster.x, s.y[k] += rule.drift * faster.y, s.z[k] += rule.drift * faster.z;
    s.wx[k] = world_spin.x, s.wy[k] = world_spin.y, s.wz[k] = world_spin.z;
    s.nw[k] = next.w, s.nx[k] = next.x, s.ny[k] = next.y, s.nz[k] = next.z;
}

/// Matrix of the new orientation, and how far the clump has moved.
[[gnu::always_inline, gnu::flatten]] inline void finish_lane(clump_strip& s, std::size_t k) {
    const quaternion q{s.nw[k], s.nx[k], s.ny[k], s.nz[k]};
    const vec3 by{s.x[k] - s.cx[k], s.y[k] - s.cy[k], s.z[k] - s.cz[k]};
    s.moved[k] = way_of(by, {s.tw[k], s.tx[k], s.ty[k], s.tz[k]}, q, s.reach[k]);
    const mat3 m = matrix(q);
    s.r00[k] = m.row[0].x, s.r01[k] = m.row[0].y, s.r02[k] = m.row[0].z;
    s.r10[k] = m.row[1].x, s.r11[k] = m.row[1].y, s.r12[k] = m.row[1].z;
    s.r20[k] = m.row[2].x, s.r21[k] = m.row[2].y, s.r22[k] = m.row[2].z;
}

/// f(k) for the first n lanes, side by side.
template <class F> [[gnu::always_inline]] inline void each_lane_of(std::size_t n, F&& f) {
#if defined(_OPENMP) || defined(CLAST_OPENMP_SIMD)
#pragma omp simd
#endif
    for (std::size_t k = 0; k < n; ++k) f(k);
}
} // namespace detail

/// Moves the clumps of a strip by a rule (integrators/concepts.hpp) under their loads.
template <class Rule> [[gnu::noinline, gnu::flatten]] void advance(clump_strip& s, const Rule rule) {
    // by whole eights, unless a lane that repeats a body would spoil what the scheme remembers of it
    constexpr bool in_eights = integrators::forgetful<decltype(rule.scheme)>;
    with_widest_registers([&s, rule ](auto) __attribute__((always_inline)) {
        detail::each_lane_of(
            in_eights ? s.lanes() : s.size, [&](std::size_t k)
                                                __attribute__((always_inline)) { detail::advance_lane(s, k, rule); });
    });
    for (std::size_t k = 0; k < s.size; ++k) {
        if (s.angle2[k] < small_step2) continue;
        const turned t = advance_rotation({s.qw[k], s.qx[k], s.qy[k], s.qz[k]}, {s.lx[k], s.ly[k], s.lz[k]},
                                          {s.ix[k], s.iy[k], s.iz[k]}, rule.drift); // rare: the full method, one by one
        s.nw[k] = t.q.w, s.nx[k] = t.q.x, s.ny[k] = t.q.y, s.nz[k] = t.q.z;
        s.wx[k] = t.spin.x, s.wy[k] = t.spin.y, s.wz[k] = t.spin.z;
    }
    with_widest_registers([&s](auto) __attribute__((always_inline)) {
        detail::each_lane_of(
            s.lanes(), [&](std::size_t k) __attribute__((always_inline)) { detail::finish_lane(s, k); });
    });
}

} // namespace clast
