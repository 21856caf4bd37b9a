// SPDX-License-Identifier: MIT
// The inner loop: contacts by strips of 64, gathered from pebbles, answered by the law, and added to the loads of
// bodies.
//
// A strip holds its operands side by side, one array for each component, so that compilers turn the law, written once
// with plain arithmetic, into vector instructions (with the flags of clast::fast). A law with branches or calls that do
// not vectorise works as well, one contact after the other. Every loop over lanes has a length that is a multiple of 8,
// so a contact is computed by the same instructions wherever in a strip it stands: lists may be cut anywhere without
// changing a bit. Between pebbles and arrays stand transposes of small blocks (core/packs.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <clast/contacts/concepts.hpp>
#include <clast/core/lanes.hpp>
#include <clast/core/packs.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/contact_list.hpp>

namespace clast {

/// Operands and results of up to 64 contacts. `View`: sphere_view, or clump_view where bodies have their centre
/// elsewhere.
template <contacts::contact_law Law, class View> struct strip {
    static constexpr std::size_t length = 64;
    static constexpr bool has_arms = std::is_same_v<View, clump_view>;
    using law_type = Law;
    using history_type = typename Law::history;
    using row = double[length];
    using arm_row = double[has_arms ? length : 1];

    std::size_t size = 0;             ///< contacts in it
    alignas(64) row dx, dy, dz;       ///< x_j - x_i (m)
    row vx, vy, vz;                   ///< v_j - v_i of the centres of the bodies (m/s)
    row ix, iy, iz, jx, jy, jz;       ///< w_i and w_j (rad/s)
    row radius_i, radius_j;           ///< m
    arm_row aix, aiy, aiz;            ///< from the centre of the body to x_i (m)
    arm_row ajx, ajy, ajz;            ///< and to x_j
    history_type past[length];        ///< a copy of the history, where the list cannot be worked on itself
    row fx, fy, fz;                   ///< force on i (N)
    row nx, ny, nz;                   ///< normal from i to j
    row tix, tiy, tiz, tjx, tjy, tjz; ///< moments on the bodies of i and j about their centres (N m)
    row depth;                        ///< overlap (m), >= 0
    row dissipated;                   ///< J

    /// Lanes that are computed: `size` rounded up to a multiple of 8.
    std::size_t lanes() const { return whole_lanes(size); }
};

/// Force and moment on a body as the kernel sums them; the fourth numbers fill the register (of the force: nothing of
/// use; of the moment: energy dissipated, J).
struct alignas(64) body_load {
    quad force;  ///< N
    quad moment; ///< about its centre (N m)
};

/// What one contact adds to the loads of its two bodies.
struct alignas(32) contact_load {
    quad force;    ///< on i; j takes the opposite
    quad moment_i; ///< and the energy dissipated, which is booked on i
    quad moment_j;

    [[gnu::always_inline]] void add_to_i(body_load& i) const { i.force += force, i.moment += moment_i; }
    [[gnu::always_inline]] void add_to_j(body_load& j) const { j.force -= force, j.moment += moment_j; }
};

/// Fills a strip from the pebbles of `pairs` (1 to 64). Unused lanes repeat the last contact.
template <class Law, class View>
[[gnu::always_inline]] inline void gather(strip<Law, View>& s, std::span<const pebble_pair> pairs, const View& from) {
    using columns = pack_columns<pack_size>;
    using records = typename columns::records;
    s.size = pairs.size();
    const std::size_t n = s.lanes();
    const auto bytes = [](const auto& record) { return reinterpret_cast<const std::byte*>(&record); };
    for (std::size_t k = 0; k < n; k += pack_size) {
        const auto difference = [&](const records& a, const records& b, std::size_t at, double* x, double* y,
                                    double* z) {
            const columns xy = columns(b, at) - columns(a, at), zw = columns(b, at + 16) - columns(a, at + 16);
            xy.first(x + k), xy.second(y + k), zw.first(z + k);
        };
        constexpr std::size_t centre = 0, velocity = 32, spin = 64; // bytes, in pebble_motion and in body_motion
        records pi, pj, bi, bj;
        for (std::size_t l = 0; l < pack_size; ++l) {
            const pebble_pair& p = pairs[std::min(k + l, s.size - 1)];
            pi[l] = bytes(from.pebbles[p.i]), pj[l] = bytes(from.pebbles[p.j]);
            if constexpr (strip<Law, View>::has_arms)
                bi[l] = bytes(from.bodies[from.owner[p.i]]), bj[l] = bytes(from.bodies[from.owner[p.j]]);
            else
                bi[l] = pi[l], bj[l] = pj[l];
        }
        difference(pi, pj, centre, s.dx, s.dy, s.dz);
        columns(pi, centre + 16).second(s.radius_i + k);
        columns(pj, centre + 16).second(s.radius_j + k);
        difference(bi, bj, velocity, s.vx, s.vy, s.vz);
        transpose(bi, spin, s.ix + k, s.iy + k, s.iz + k);
        transpose(bj, spin, s.jx + k, s.jy + k, s.jz + k);
        if constexpr (strip<Law, View>::has_arms) {
            difference(bi, pi, centre, s.aix, s.aiy, s.aiz);
            difference(bj, pj, centre, s.ajx, s.ajy, s.ajz);
        }
    }
}

namespace detail {
/// Lane k of a strip. A function of its own: what a loop body declares itself, `omp simd` copies into arrays, and GCC
/// then gives up.
template <class Law, class View>
[[gnu::always_inline, gnu::flatten]] inline void answer(strip<Law, View>& s, typename Law::history* history,
                                                        std::size_t k, const Law& law, double h) {
    const vec3 d{s.dx[k], s.dy[k], s.dz[k]};
    vec3 centres{s.vx[k], s.vy[k], s.vz[k]}; // of the pebbles, relative velocity
    const vec3 spin_i{s.ix[k], s.iy[k], s.iz[k]}, spin_j{s.jx[k], s.jy[k], s.jz[k]};
    if constexpr (strip<Law, View>::has_arms) {
        centres += cross(spin_j, vec3{s.ajx[k], s.ajy[k], s.ajz[k]});
        centres -= cross(spin_i, vec3{s.aix[k], s.aiy[k], s.aiz[k]});
    }
    const vec3 mid = d - (0.5 * h) * centres;
    const double distance = std::sqrt(norm2(d)), mid2 = norm2(mid);
    const double inverse = 1.0 / distance, reflect = 2.0 / mid2;
    const double overlap = s.radius_i[k] + s.radius_j[k] - distance;
    const double reach_i = s.radius_i[k] - 0.5 * overlap, reach_j = s.radius_j[k] - 0.5 * overlap;
    const vec3 normal = inverse * d;
    const vec3 relative = cross(reach_i * spin_i + reach_j * spin_j, normal) - centres;
    const vec3 u = h * (relative - (0.5 * reflect * dot(relative, mid)) * mid);
    const double spin = 0.5 * h * dot(spin_i + spin_j, normal);
    typename Law::history past = history[k];
    const bool touching = overlap > 0.0;
    const contacts::response<double> answer = law(
        contacts::overlap<double>{normal.x, normal.y, normal.z, overlap, s.radius_i[k], s.radius_j[k]},
        contacts::motion<double>{u.x, u.y, u.z, spin, dot(relative, normal), mid.x, mid.y, mid.z, reflect}, past, h);
    if constexpr (!std::is_empty_v<typename Law::history>) history[k] = past;
    const vec3 force{touching ? answer.fx : 0.0, touching ? answer.fy : 0.0, touching ? answer.fz : 0.0};
    const vec3 turn = cross(normal, force);
    vec3 moment_i = reach_i * turn, moment_j = reach_j * turn;
    if constexpr (strip<Law, View>::has_arms) {
        moment_i += cross(vec3{s.aix[k], s.aiy[k], s.aiz[k]}, force);
        moment_j -= cross(vec3{s.ajx[k], s.ajy[k], s.ajz[k]}, force);
    }
    s.fx[k] = force.x, s.fy[k] = force.y, s.fz[k] = force.z;
    s.nx[k] = normal.x, s.ny[k] = normal.y, s.nz[k] = normal.z;
    s.tix[k] = moment_i.x, s.tiy[k] = moment_i.y, s.tiz[k] = moment_i.z;
    s.tjx[k] = moment_j.x, s.tjy[k] = moment_j.y, s.tjz[k] = moment_j.z;
    s.depth[k] = touching ? overlap : 0.0;
    s.dissipated[k] = answer.dissipated;
}

template <class Law, class View>
[[gnu::always_inline]] inline void answer_all(strip<Law, View>& s, typename Law::history* history, const Law& law,
                                              double h) {
    const std::size_t n = s.lanes();
#if defined(_OPENMP) || defined(CLAST_OPENMP_SIMD) // the latter comes with clast::fast and its -fopenmp-simd
#pragma omp simd
#endif
    for (std::size_t k = 0; k < n; ++k) detail::answer(s, history, k, law, h);
}
} // namespace detail

/// Answers all contacts of a strip; `history` holds those of its lanes before, and then after. h: span since their last
/// evaluation (s). Pairs that do not touch exert nothing, whatever the law says; what it makes of their history and
/// energy holds.
///
/// The motion of i against j at the contact point over the last step is split by the normal of mid-step, so that
/// position and velocity belong to the same instant.
template <class Law, class View>
[[gnu::noinline, gnu::flatten]] void evaluate(strip<Law, View>& s, typename Law::history* history, const Law law,
                                              double h) {
    with_widest_registers([&s, history, law, h] { detail::answer_all(s, history, law, h); });
}

/// Evaluates contacts [begin, end) of a list, at most a strip; histories go on in the list, results stay in the strip.
/// adjust(s, begin): may change the operands (pebbles that are taken elsewhere in time, images in a periodic cell).
template <class Law, class View, class Adjust>
[[gnu::always_inline]] inline void evaluate(strip<Law, View>& s, contact_list<typename Law::history>& list,
                                            std::size_t begin, std::size_t end, const View& from, const Law& law,
                                            double h, Adjust&& adjust) {
    gather(s, std::span<const pebble_pair>(list.pairs).subspan(begin, end - begin), from);
    adjust(s, begin);
    if constexpr (contact_list<typename Law::history>::remembers) {
        auto* own = list.history.data() + begin;
        if (s.size == s.lanes()) {
            evaluate(s, own, law, h);
            return;
        }
        for (std::size_t k = 0; k < s.lanes(); ++k) s.past[k] = own[std::min(k, s.size - 1)];
        evaluate(s, s.past, law, h);
        for (std::size_t k = 0; k < s.size; ++k) own[k] = s.past[k];
    } else {
        evaluate(s, s.past, law, h);
    }
}

/// Writes the rows of contacts begin, begin + 1, ... of a list from the strip that holds their results.
template <class Law, class View>
void keep_rows(const strip<Law, View>& s, contact_list<typename Law::history>& list, std::size_t begin) {
    for (std::size_t k = 0; k < s.size; ++k)
        list.rows[begin + k] = {{s.fx[k], s.fy[k], s.fz[k]}, s.depth[k], {s.nx[k], s.ny[k], s.nz[k]}, s.dissipated[k]};
}

/// f(k, load) for every contact k of a strip, in order.
template <class Law, class View, class F>
[[gnu::always_inline]] inline void each_load(const strip<Law, View>& s, F&& f) {
    alignas(64) contact_load load[4];
    alignas(64) static constexpr double nothing[strip<Law, View>::length] = {};
    for (std::size_t k = 0; k < s.size; k += 4) {
        transpose(s.fx + k, s.fy + k, s.fz + k, nothing, [&](std::size_t l, const quad& v) { load[l].force = v; });
        transpose(s.tix + k, s.tiy + k, s.tiz + k, s.dissipated + k,
                  [&](std::size_t l, const quad& v) { load[l].moment_i = v; });
        transpose(s.tjx + k, s.tjy + k, s.tjz + k, nothing,
                  [&](std::size_t l, const quad& v) { load[l].moment_j = v; });
        if (k + 4 <= s.size)
            for (std::size_t l = 0; l < 4; ++l) f(k + l, load[l]);
        else
            for (std::size_t l = 0; k + l < s.size; ++l) f(k + l, load[l]);
    }
}

} // namespace clast
