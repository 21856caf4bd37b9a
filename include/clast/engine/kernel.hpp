// SPDX-License-Identifier: MIT
// The inner loop: contacts by blocks of 8, gathered from pebbles, answered by the law, and handed on to the loads of
// bodies.
//
// A block holds its operands side by side, one array for each component, so that compilers turn the law, written once
// with plain arithmetic, into vector instructions (with the flags of clast::fast). A law with branches or calls that do
// not vectorise works as well, one contact after the other. Every block has the same 8 lanes, so a contact is computed
// by the same instructions wherever it stands: lists may be cut anywhere without changing a bit. Between pebbles and
// arrays stand transposes of small blocks (core/packs.hpp). A law waits for its roots and quotients most of the time;
// so the blocks after it are gathered, where registers are wide their distances found, and the one before it is handed
// on meanwhile.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <clast/bodies/contact_list.hpp>
#include <clast/contacts/concepts.hpp>
#include <clast/core/lanes.hpp>
#include <clast/core/packs.hpp>
#include <clast/core/parallel.hpp>
#include <clast/core/vector.hpp>

namespace clast {

/// Operands and results of the contacts that are being worked on: a ring of blocks. `View`: sphere_view, or clump_view
/// where bodies have their centre elsewhere.
template <contacts::contact_law Law, class View> struct strip {
    static constexpr std::size_t blocks = 4; ///< that are gathered, answered and handed on at the same time
    static constexpr std::size_t length = blocks * lanes;
    static constexpr bool has_arms = std::is_same_v<View, clump_view>;
    static constexpr bool has_masses = contacts::reads_masses<Law>();
    static constexpr bool has_materials = contacts::reads_materials<Law>();
    using row = double[length];
    using arm_row = double[has_arms ? length : 1];
    using mass_row = double[has_masses ? length : 1];
    using material_row = double[has_materials ? length : 1];

    pebble_pair bodies[length];       ///< numbers of the bodies of i and j, in this order
    alignas(64) row dx, dy, dz;       ///< x_j - x_i (m)
    row vx, vy, vz;                   ///< v_j - v_i of the bodies, behind make_lengths of the pebbles (m/s)
    row ix, iy, iz, jx, jy, jz;       ///< w_i and w_j (rad/s)
    row radius_i, radius_j;           ///< m
    row distance, inverse, reflect;   ///< lengths_of the contact, where they are made ahead
    arm_row aix, aiy, aiz;            ///< from the centre of the body to x_i (m)
    arm_row ajx, ajy, ajz;            ///< and to x_j
    alignas(64) row fx, fy, fz;       ///< force on i (N)
    row nx, ny, nz;                   ///< normal from i to j
    row tix, tiy, tiz, tjx, tjy, tjz; ///< moments on the bodies of i and j about their centres (N m)
    row depth;                        ///< overlap (m), >= 0
    row dissipated;                   ///< J
    /// Whether a pair of spheres touches: written where registers hold 4 doubles only. A vectorised loop does as many
    /// lanes at once as numbers of its smallest type fit in a register, here 8 in two registers each, and while one
    /// waits for a root or a quotient the other goes on.
    std::int32_t touching[length];
    /// Inverse masses of the bodies (1/kg), for laws that read them. Last: a short array among the rows would shift
    /// those behind it across cache lines, which takes 6 % of a step of clumps.
    mass_row mass_i, mass_j;
    material_row material_i, material_j; ///< their numbers
};

/// The strip that contacts of a scene are worked on in.
template <class Scene>
using strip_of = strip<typename Scene::contact, decltype(std::declval<const typename Scene::body_type&>().view())>;

/// Up to 8 contacts: row, row + 1, ... of a list, in the lanes at, at + 1, ... of a strip.
struct contact_block {
    std::size_t at, row, size;
};

/// What one contact adds to the loads of its two bodies, in registers of N doubles.
template <std::size_t N = own_width::value> struct alignas(32) contact_load {
    quad<N> force;    ///< on i; j takes the opposite
    quad<N> moment_i; ///< and the energy dissipated, which is booked on i
    quad<N> moment_j;

    [[gnu::always_inline]] void add_to_i(load_sum& i) const {
        (quad<N>::load(&i.force) + force).store(&i.force);
        (quad<N>::load(&i.moment) + moment_i).store(&i.moment);
    }
    [[gnu::always_inline]] void add_to_j(load_sum& j) const {
        (quad<N>::load(&j.force) - force).store(&j.force);
        (quad<N>::load(&j.moment) + moment_j).store(&j.moment);
    }
    /// Into a load of the width that the program is built for.
    [[gnu::always_inline]] void store(contact_load<>& to) const {
        force.store(&to.force), moment_i.store(&to.moment_i), moment_j.store(&to.moment_j);
    }
};

namespace detail {
/// Fills the lanes at to at + 7 of a strip from 8 pairs of pebbles.
template <std::size_t N, class Law, class View>
[[gnu::always_inline]] inline void gather(strip<Law, View>& s, std::size_t at, const pebble_pair* pairs,
                                          const View& from) {
    using row = quad<N>; // whole blocks of four numbers are loaded and subtracted, and transposed last
    constexpr auto difference =
        [](const row(&a)[4], const row(&b)[4], double* x, double* y, double* z) __attribute__((always_inline)) {
        row d[4];
        for (std::size_t l = 0; l < 4; ++l) d[l] = b[l] - a[l];
        row::columns(d, x, y, z);
    };
    constexpr std::size_t centre = 0, velocity = quad_size, spin = 2 * quad_size; // in pebble_ and body_motion
    for (std::size_t k = at; k < at + lanes; k += 4, pairs += 4) {
        const std::byte *pi[4], *pj[4], *bi[4], *bj[4]; // pebbles and bodies
        for (std::size_t l = 0; l < 4; ++l) {
            const pebble_pair& p = pairs[l];
            pi[l] = bytes_of(from.pebbles[p.i]), pj[l] = bytes_of(from.pebbles[p.j]);
            if constexpr (strip<Law, View>::has_arms) {
                const pebble_pair of{from.owner[p.i], from.owner[p.j]};
                bi[l] = bytes_of(from.bodies[of.i]), bj[l] = bytes_of(from.bodies[of.j]);
                s.bodies[k + l] = of;
            } else {
                bi[l] = pi[l], bj[l] = pj[l];
                s.bodies[k + l] = p;
            }
            if constexpr (strip<Law, View>::has_materials)
                s.material_i[k + l] = from.materials[p.i], s.material_j[k + l] = from.materials[p.j];
        }
        row i[4], j[4];
        row::load(pi, centre, i), row::load(pj, centre, j), difference(i, j, s.dx + k, s.dy + k, s.dz + k);
        row::fourth_column(i, s.radius_i + k), row::fourth_column(j, s.radius_j + k);
        if constexpr (strip<Law, View>::has_arms) {
            row body[4];
            row::load(bi, centre, body), difference(body, i, s.aix + k, s.aiy + k, s.aiz + k);
            row::load(bj, centre, body), difference(body, j, s.ajx + k, s.ajy + k, s.ajz + k);
        }
        row::load(bi, velocity, i), row::load(bj, velocity, j), difference(i, j, s.vx + k, s.vy + k, s.vz + k);
        if constexpr (strip<Law, View>::has_masses)
            row::fourth_column(i, s.mass_i + k), row::fourth_column(j, s.mass_j + k);
        row::load(bi, spin, i), row::columns(i, s.ix + k, s.iy + k, s.iz + k);
        row::load(bj, spin, j), row::columns(j, s.jx + k, s.jy + k, s.jz + k);
    }
}

/// Asks for the second pebbles of 8 pairs (the first ones follow each other in memory, which processors see).
template <class View> [[gnu::always_inline]] inline void prefetch(const pebble_pair* pairs, const View& from) {
    for (std::size_t k = 0; k < lanes; ++k) {
        const std::byte* const p = bytes_of(from.pebbles[pairs[k].j]);
        __builtin_prefetch(p);
        if constexpr (sizeof(from.pebbles[0]) > 64) __builtin_prefetch(p + 64);
    }
}

/// What a contact waits for before all else, the first of its roots and two of its quotients, and what they rest on.
struct lengths {
    vec3 centres;    ///< relative velocity of the two pebbles (m/s)
    double distance; ///< |x_j - x_i| (m)
    double inverse;  ///< 1 / distance
    double reflect;  ///< 2 / |x_j - x_i at mid-step|^2
};
/// Of lane k; Made: make_lengths has been there.
template <bool Made, class Law, class View>
[[gnu::always_inline, gnu::flatten]] inline lengths lengths_of(const strip<Law, View>& s, std::size_t k, double h) {
    if constexpr (Made) return {{s.vx[k], s.vy[k], s.vz[k]}, s.distance[k], s.inverse[k], s.reflect[k]};
    const vec3 d{s.dx[k], s.dy[k], s.dz[k]};
    vec3 centres{s.vx[k], s.vy[k], s.vz[k]};
    if constexpr (strip<Law, View>::has_arms) {
        centres += cross(vec3{s.jx[k], s.jy[k], s.jz[k]}, vec3{s.ajx[k], s.ajy[k], s.ajz[k]});
        centres -= cross(vec3{s.ix[k], s.iy[k], s.iz[k]}, vec3{s.aix[k], s.aiy[k], s.aiz[k]});
    }
    const double distance = std::sqrt(norm2(d)), mid2 = norm2(d - (0.5 * h) * centres);
    return {centres, distance, 1.0 / distance, 2.0 / mid2};
}
/// Keeps them in the strip; the velocity of the pebbles takes the place of that of the bodies.
template <class Law, class View>
[[gnu::always_inline, gnu::flatten]] inline void make_lengths(strip<Law, View>& s, std::size_t k, double h) {
    const lengths of = lengths_of<false>(s, k, h);
    if constexpr (strip<Law, View>::has_arms) s.vx[k] = of.centres.x, s.vy[k] = of.centres.y, s.vz[k] = of.centres.z;
    s.distance[k] = of.distance, s.inverse[k] = of.inverse, s.reflect[k] = of.reflect;
}

/// Lane k of a strip. A function of its own: what a loop body declares itself, `omp simd` copies into arrays, and GCC
/// then gives up. Operands are read late, so that few registers hold them.
template <bool InPairs, bool Ahead, class Law, class View>
[[gnu::always_inline, gnu::flatten]] inline void answer(strip<Law, View>& s, std::size_t k,
                                                        typename Law::history& history, const Law& law, double h) {
    const auto [centres, distance, inverse, reflect] = lengths_of<Ahead>(s, k, h);
    const vec3 d{s.dx[k], s.dy[k], s.dz[k]}, mid = d - (0.5 * h) * centres;
    const double overlap = s.radius_i[k] + s.radius_j[k] - distance;
    const double reach_i = s.radius_i[k] - 0.5 * overlap, reach_j = s.radius_j[k] - 0.5 * overlap;
    const vec3 normal = inverse * d;
    const vec3 spin_i{s.ix[k], s.iy[k], s.iz[k]}, spin_j{s.jx[k], s.jy[k], s.jz[k]};
    const vec3 relative = cross(reach_i * spin_i + reach_j * spin_j, normal) - centres;
    const vec3 u = h * (relative - (0.5 * reflect * dot(relative, mid)) * mid);
    const double spin = 0.5 * h * dot(spin_i + spin_j, normal);
    const vec3 rolled = h * (spin_i - spin_j);
    typename Law::history past = history;
    const bool touching = overlap > -contacts::reach_of(law);
    contacts::overlap<double> between{normal.x, normal.y, normal.z, overlap, 1.0 / s.radius_i[k], 1.0 / s.radius_j[k]};
    if constexpr (strip<Law, View>::has_masses)
        between.inverse_mass_i = s.mass_i[k], between.inverse_mass_j = s.mass_j[k];
    if constexpr (strip<Law, View>::has_materials)
        between.material_i = s.material_i[k], between.material_j = s.material_j[k];
    const auto answer = law(between,
                            contacts::motion<double>{u.x, u.y, u.z, spin, dot(relative, normal), mid.x, mid.y, mid.z,
                                                     reflect, rolled.x, rolled.y, rolled.z},
                            past, h);
    if constexpr (!std::is_empty_v<typename Law::history>) history = past;
    const vec3 force{touching ? answer.fx : 0.0, touching ? answer.fy : 0.0, touching ? answer.fz : 0.0};
    const vec3 turn = cross(normal, force);
    vec3 moment_i = reach_i * turn, moment_j = reach_j * turn;
    if constexpr (strip<Law, View>::has_arms) {
        moment_i += cross(vec3{s.aix[k], s.aiy[k], s.aiz[k]}, force);
        moment_j -= cross(vec3{s.ajx[k], s.ajy[k], s.ajz[k]}, force);
    }
    if constexpr (requires { answer.mx; }) {
        const vec3 moment{touching ? answer.mx : 0.0, touching ? answer.my : 0.0, touching ? answer.mz : 0.0};
        moment_i += moment, moment_j -= moment;
    }
    s.fx[k] = force.x, s.fy[k] = force.y, s.fz[k] = force.z;
    s.nx[k] = normal.x, s.ny[k] = normal.y, s.nz[k] = normal.z;
    s.tix[k] = moment_i.x, s.tiy[k] = moment_i.y, s.tiz[k] = moment_i.z;
    s.tjx[k] = moment_j.x, s.tjy[k] = moment_j.y, s.tjz[k] = moment_j.z;
    s.depth[k] = touching ? overlap : 0.0;
    s.dissipated[k] = answer.dissipated;
    if constexpr (InPairs) s.touching[k] = touching ? 1 : 0;
}

/// f(k) for the lanes of a block, side by side.
template <class F> [[gnu::always_inline]] inline void each_lane(F&& f) {
#if defined(_OPENMP) || defined(CLAST_OPENMP_SIMD) // the latter comes with clast::fast and its -fopenmp-simd
#pragma omp simd
#endif
    for (std::size_t k = 0; k < lanes; ++k) f(k);
}
} // namespace detail

/// Whether a list has so many contacts that their pebbles should be fetched from memory before they are gathered; those
/// of others stay in the second cache.
inline bool is_long_list(const pair_list& list) { return list.size() > 1 << 16; }

/// Evaluates some contacts of a list with the histories that it holds, which go on. h: span since their last evaluation
/// (s). Pairs that do not touch exert nothing, whatever the law says; what it makes of their history and energy holds.
///
/// The motion of i against j at the contact point over the last step is split by the normal of mid-step, so that
/// position and velocity belong to the same instant.
///
/// job.adjust(strip, contact_block): may change operands (pebbles that are taken elsewhere in time, images in a
/// periodic cell). job.take(register_width, strip, contact_block): hands results on. Both are called block after block,
/// in order, and should be always_inline. Returns the job.
template <class Law, class View, class Job>
[[gnu::noinline]] Job evaluate(contact_list<typename Law::history>& list, index_range rows, const View from,
                               const Law law, double h, Job job) {
    using history = typename Law::history;
    constexpr bool remembers = contact_list<history>::remembers;
    const pebble_pair* const all_pairs = list.pairs.data();
    constexpr std::size_t far = 16; // contacts
    const std::size_t fetched = is_long_list(list) ? list.size() : 0;
    history* const all_histories = list.history.data();
    return with_widest_registers([=](auto width) __attribute__((always_inline)) {
        constexpr std::size_t ahead = 2, behind = 1; // blocks; measured
        static_assert(ahead + behind < strip<Law, View>::blocks);
        // with eight numbers in a register a block is so few instructions that a processor looks into the next one
        constexpr bool lengths_ahead = width.of_loops == 8;
        // clumps need too many registers for that
        constexpr bool in_pairs = width.of_loops == 4 && !strip<Law, View>::has_arms;
        Job work = job;
        strip<Law, View> s;
        pebble_pair pairs_of_last[lanes];
        history past[lanes];
        const std::size_t blocks = (rows.end - rows.begin + lanes - 1) / lanes;
        const auto block = [&](std::size_t b) {
            const std::size_t row = rows.begin + b * lanes;
            return contact_block{b % strip<Law, View>::blocks * lanes, row, std::min(lanes, rows.end - row)};
        };
        for (std::size_t b = 0; b < blocks + ahead + behind; ++b) {
            if constexpr (lengths_ahead)
                if (b > 0 && b <= blocks)
                    detail::each_lane([&, at = block(b - 1).at ](std::size_t k)
                                          __attribute__((always_inline)) { detail::make_lengths(s, at + k, h); });
            if (b < blocks) {
                const contact_block next = block(b);
                const pebble_pair* pairs = all_pairs + next.row;
                if (next.size < lanes) { // lanes that are not used repeat the last contact
                    for (std::size_t k = 0; k < lanes; ++k) pairs_of_last[k] = pairs[std::min(k, next.size - 1)];
                    pairs = pairs_of_last;
                }
                if (next.row + far + lanes <= fetched) detail::prefetch(all_pairs + next.row + far, from);
                detail::gather<width()>(s, next.at, pairs, from);
                work.adjust(s, next);
            }
            if (b >= ahead && b < blocks + ahead) {
                const contact_block now = block(b - ahead);
                const bool partial = remembers && now.size < lanes;
                history* const own = remembers ? all_histories + now.row : past;
                if (partial)
                    for (std::size_t k = 0; k < lanes; ++k) past[k] = own[std::min(k, now.size - 1)];
                history* const of = partial ? past : own;
                detail::each_lane([&](std::size_t k) __attribute__((always_inline)) {
                    detail::answer<in_pairs, lengths_ahead>(s, now.at + k, of[k], law, h);
                });
                if (partial)
                    for (std::size_t k = 0; k < now.size; ++k) own[k] = past[k];
            }
            if (b >= ahead + behind) work.take(width, s, block(b - ahead - behind));
        }
        return work;
    });
}

/// f(rows) for the first n contacts of a list by chunks, side by side on all threads.
inline constexpr std::size_t rows_at_once = 256; ///< contacts that are evaluated in one go
template <class F> void each_chunk(const execution& run, std::size_t n, F&& f) {
    run.for_each((n + rows_at_once - 1) / rows_at_once,
                 [&](std::size_t k) {
                     f(index_range{k * rows_at_once, std::min(n, (k + 1) * rows_at_once)});
                 },
                 1);
}

/// Writes the rows of contacts of a list from the strip that holds their results.
template <class Law, class View>
[[gnu::noinline]] void keep_rows(const strip<Law, View>& s, const contact_block& block, force_row* rows) {
    for (std::size_t k = block.at; k < block.at + block.size; ++k)
        rows[block.row + k - block.at] = {
            {s.fx[k], s.fy[k], s.fz[k]}, s.depth[k], {s.nx[k], s.ny[k], s.nz[k]}, s.dissipated[k]};
}

/// Calls f(row, bodies of i and j, contact_load) for every contact of a block, in order; f should be always_inline.
template <std::size_t N, std::size_t Loop, class Law, class View, class F>
[[gnu::always_inline]] inline void each_load(register_width<N, Loop>, const strip<Law, View>& s,
                                             const contact_block& block, const F& f) {
    alignas(64) static constexpr double nothing[4] = {};
    for (std::size_t done = 0; done < block.size; done += 4) {
        const std::size_t k = block.at + done;
        quad<N> force[4], moment_i[4], moment_j[4];
        quad<N>::records(s.fx + k, s.fy + k, s.fz + k, nothing, force);
        quad<N>::records(s.tix + k, s.tiy + k, s.tiz + k, s.dissipated + k, moment_i);
        quad<N>::records(s.tjx + k, s.tjy + k, s.tjz + k, nothing, moment_j);
        if (done + 4 <= block.size) // of constant length, so that loads stay in registers
            for (std::size_t l = 0; l < 4; ++l)
                f(block.row + done + l, s.bodies[k + l], contact_load<N>{force[l], moment_i[l], moment_j[l]});
        else
            for (std::size_t l = 0; done + l < block.size; ++l)
                f(block.row + done + l, s.bodies[k + l], contact_load<N>{force[l], moment_i[l], moment_j[l]});
    }
}

} // namespace clast
