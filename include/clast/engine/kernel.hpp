// SPDX-License-Identifier: MIT
// The inner loop: contacts by strips of 64, gathered from pebbles, answered by the law, written to rows.
//
// A strip holds its operands side by side, one array for each component, so that compilers turn the law, written once
// with plain arithmetic, into vector instructions (with the flags of clast::fast). A law with branches or calls that do
// not vectorise works as well, one contact after the other. Every loop over lanes has a length that is a multiple of 8,
// so a contact is computed by the same instructions wherever in a strip it stands: lists may be cut anywhere without
// changing a bit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <clast/contacts/concepts.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/contact_list.hpp>

namespace clast {

/// Operands and results of up to 64 contacts.
template <contacts::contact_law Law> struct strip {
    static constexpr std::size_t length = 64;
    using history_type = typename Law::history;
    using row = double[length];

    std::size_t size = 0;      ///< contacts in it
    row dx, dy, dz;            ///< x_j - x_i (m)
    row vx, vy, vz;            ///< v_j - v_i of the centres (m/s)
    row wx, wy, wz;            ///< w_i + w_j (rad/s)
    row sx, sy, sz;            ///< r_i w_i + r_j w_j (m/s)
    row radius_i, radius_j;    ///< m
    history_type past[length]; ///< history before, then after
    row fx, fy, fz;            ///< force on i (N)
    row nx, ny, nz;            ///< normal from i to j
    row depth;                 ///< overlap (m), >= 0
    row dissipated;            ///< J

    /// Lanes that are computed: `size` rounded up to a multiple of 8.
    std::size_t lanes() const { return (size + 7) / 8 * 8; }
};

/// Fills a strip from the pebbles of `pairs` (at most 64). `adjust(k, pair, d, v)` may change the distance vector and
/// relative velocity of contact k (pebbles that are taken elsewhere in time, images in a periodic cell).
template <class Law, class Adjust>
void gather(strip<Law>& s, std::span<const pebble_pair> pairs, const pebble_motion* pebbles, Adjust&& adjust) {
    s.size = pairs.size();
    const std::size_t n = s.lanes();
    for (std::size_t k = 0; k < n; ++k) {
        const pebble_pair& p = pairs[k < s.size ? k : 0]; // unused lanes repeat a contact that is there
        const pebble_motion& a = pebbles[p.i];
        const pebble_motion& b = pebbles[p.j];
        vec3 d = b.x - a.x, v = b.v - a.v;
        adjust(k < s.size ? k : 0, p, d, v);
        s.dx[k] = d.x, s.dy[k] = d.y, s.dz[k] = d.z;
        s.vx[k] = v.x, s.vy[k] = v.y, s.vz[k] = v.z;
        s.wx[k] = a.w.x + b.w.x, s.wy[k] = a.w.y + b.w.y, s.wz[k] = a.w.z + b.w.z;
        s.sx[k] = a.radius * a.w.x + b.radius * b.w.x;
        s.sy[k] = a.radius * a.w.y + b.radius * b.w.y;
        s.sz[k] = a.radius * a.w.z + b.radius * b.w.z;
        s.radius_i[k] = a.radius, s.radius_j[k] = b.radius;
    }
}

namespace detail {
/// Lane k of a strip. A function of its own: what a loop body declares itself, `omp simd` copies into arrays, and GCC
/// then gives up.
template <class Law>
[[gnu::always_inline, gnu::flatten]] inline void answer(strip<Law>& s, std::size_t k, const Law& law, double h) {
    using history = typename Law::history;
    const vec3 d{s.dx[k], s.dy[k], s.dz[k]};
    const vec3 centres{s.vx[k], s.vy[k], s.vz[k]};
    const vec3 spins{s.wx[k], s.wy[k], s.wz[k]};
    const vec3 rims{s.sx[k], s.sy[k], s.sz[k]};
    const double distance = std::sqrt(norm2(d)), inverse = 1.0 / distance;
    const double overlap = s.radius_i[k] + s.radius_j[k] - distance;
    const vec3 normal = inverse * d;
    const vec3 relative = cross(rims - (0.5 * overlap) * spins, normal) - centres;
    const vec3 mid = d - (0.5 * h) * centres;
    const vec3 u = h * (relative - (dot(relative, mid) / norm2(mid)) * mid);
    const double spin = 0.5 * h * dot(spins, normal);
    history past = s.past[k];
    const bool touching = overlap > 0.0;
    const contacts::response<double> answer =
        law(contacts::overlap<double>{normal.x, normal.y, normal.z, overlap, s.radius_i[k], s.radius_j[k]},
            contacts::motion<double>{u.x, u.y, u.z, spin, dot(relative, normal)}, past, h);
    if constexpr (!std::is_empty_v<history>) s.past[k] = past;
    s.fx[k] = touching ? answer.fx : 0.0;
    s.fy[k] = touching ? answer.fy : 0.0;
    s.fz[k] = touching ? answer.fz : 0.0;
    s.nx[k] = normal.x, s.ny[k] = normal.y, s.nz[k] = normal.z;
    s.depth[k] = touching ? overlap : 0.0;
    s.dissipated[k] = answer.dissipated;
}
} // namespace detail

/// Answers all contacts of a strip. h: span since their last evaluation (s). Pairs that do not touch exert
/// nothing, whatever the law says; what it makes of their history and energy holds.
///
/// The motion of i against j at the contact point over the last step is split by the normal of mid-step, so that
/// position and velocity belong to the same instant.
template <class Law> [[gnu::noinline]] void evaluate(strip<Law>& s, const Law law, double h) {
    const std::size_t n = s.lanes();
#if defined(_OPENMP) || defined(CLAST_OPENMP_SIMD) // the latter comes with clast::fast and its -fopenmp-simd
#pragma omp simd
#endif
    for (std::size_t k = 0; k < n; ++k) detail::answer(s, k, law, h);
}
/// Evaluates contacts [begin, end) of a list into its rows and histories. Contacts asleep behind a bond stay as they
/// are, with empty rows.
template <class Law, class Adjust>
void evaluate(contact_list<typename Law::history>& list, std::size_t begin, std::size_t end,
              const pebble_motion* pebbles, const Law& law, double h, strip<Law>& s, Adjust&& adjust) {
    constexpr bool remembers = contact_list<typename Law::history>::remembers;
    const bool may_sleep = !list.bonded.empty();
    for (std::size_t at = begin; at < end; at += strip<Law>::length) {
        const std::size_t n = std::min(strip<Law>::length, end - at);
        gather(s, std::span(list.pairs).subspan(at, n), pebbles,
               [&](std::size_t k, const pebble_pair& p, vec3& d, vec3& v) { adjust(at + k, p, d, v); });
        if constexpr (remembers) std::copy_n(list.history.data() + at, n, s.past);
        evaluate(s, law, h);
        for (std::size_t k = 0; k < n; ++k) {
            if (may_sleep && list.bonded[at + k] != 0) continue; // its row was emptied when it fell asleep
            if constexpr (remembers) list.history[at + k] = s.past[k];
            list.rows[at + k] = {{s.fx[k], s.fy[k], s.fz[k]}, s.depth[k], {s.nx[k], s.ny[k], s.nz[k]}, s.dissipated[k]};
        }
    }
}

} // namespace clast
