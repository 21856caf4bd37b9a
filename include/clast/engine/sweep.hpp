// SPDX-License-Identifier: MIT
// The fused pass over heavy bodies: forces, sums and motion in one order.
//
// Pairs are sorted by their first body, then by their second pebble. So when the sweep has passed the pairs of body i,
// every contact of i has been evaluated, as the first body or as the second, and i may move: no later contact reads it.
// With several threads each sweeps a range of bodies of its own; contacts between two ranges are evaluated before. In
// the order of the list the contacts of a body with lower ranges come first and those with higher ranges last, so
// adding the former before the sweep of a range and the latter when a body moves leaves every sum as one thread would
// have it, to the last bit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <clast/bodies/concepts.hpp>
#include <clast/bodies/contact_list.hpp>
#include <clast/engine/body_ranges.hpp>
#include <clast/engine/kernel.hpp>
#include <clast/engine/scene.hpp>

namespace clast::rooms {

/// Heavy contacts: what they exert is added to their bodies, or kept if they are between two ranges.
template <class S> struct heavy_job {
    S& scene;
    std::size_t gathered, taken; ///< where to go on among the contacts that go across faces of the space
    bool shared;                 ///< between two ranges
    force_row* rows;             ///< of the list, or nullptr if nobody looks at them
    load_sum* const acting = scene.acting.data();
    contact_load<>* const shared_load = scene.shared_load.data();

    [[gnu::always_inline]] void adjust(strip_of<S>& s, const contact_block& block) {
        if (!shared && is_long_list(scene.heavy)) // what take() will add to
            for (std::size_t k = 0; k < block.size; ++k)
                __builtin_prefetch(&acting[static_cast<std::size_t>(s.bodies[block.at + k].j)], 1);
        scene.crossings.adjust(gathered, s, block);
    }
    template <class Width>
    [[gnu::always_inline]] void take(Width width, const strip_of<S>& s, const contact_block& block) {
        each_load(width, s, block, *this);
        scene.crossings.take(taken, s, block);
        if (rows != nullptr) keep_rows(s, block, rows);
    }
    template <class Load>
    [[gnu::always_inline]] void operator()(std::size_t row, const pebble_pair& bodies, const Load& load) const {
        if (shared) {
            load.store(shared_load[row]);
        } else {
            load.add_to_i(acting[static_cast<std::size_t>(bodies.i)]);
            load.add_to_j(acting[static_cast<std::size_t>(bodies.j)]);
        }
    }
};
/// Adds what walls do to a body: the wall rows from `wall` on that are its own.
template <class S>
[[gnu::always_inline]] inline void add_walls(const S& s, std::size_t body, std::size_t& wall, load_sum& load) {
    const std::size_t first = wall;
    for (; wall < s.heavy_wall.size() && s.grains.body_of(s.heavy_wall[wall].pebble) == body; ++wall) {
        const boundaries::wall_row& w = s.heavy_wall[wall];
        load.force += w.force;
        if constexpr (S::body_type::turns) load.moment += cross(s.position(w.pebble) - s.grains.centre(body), w.force);
    }
    if (!s.heavy_grip.empty())
        for (std::size_t k = first; k < wall; ++k) {
            load.moment += s.heavy_grip[k].moment;
            load.dissipated += s.heavy_grip[k].dissipated;
        }
}
/// What acts on a body whose contacts in the range have been evaluated. `shared`, `wall`: the shared contacts and wall
/// rows that come next. Inlined by force: it has few instructions, and is called for every body in every step.
template <class S>
[[gnu::always_inline]] inline load_sum complete_load(S& s, std::size_t body, std::size_t& shared, std::size_t& wall) {
    load_sum& sum = s.acting[body];
    for (; shared < s.heavy.shared && s.grains.body_of(s.heavy.pairs[shared].i) == body; ++shared)
        s.shared_load[shared].add_to_i(sum);
    load_sum load = sum;
    sum = {};
    if constexpr (S::has_walls) add_walls(s, body, wall, load);
    s.broken.add_halo_load(body, load);
    if constexpr (S::field_type::acts) load.force += s.settings.field.force(s.seen(body)); // before it is damped
    if constexpr (S::constraint_type::acts) s.constraint.act(body, load);
    return load;
}
/// What a pass over all bodies goes by.
template <class S> struct sweep_pass {
    typename S::rule_type rule; ///< how bodies go on
    double since;               ///< span since contacts were evaluated last (s)
    vec3 stretch;               ///< of the space since the lists were renewed
    bool keep;                  ///< rows of contacts are kept
};
/// Evaluates some heavy contacts. across: crossings.from(rows.begin); returns that of rows.end.
template <class S> std::size_t evaluate_heavy(S& s, index_range rows, std::size_t across, const sweep_pass<S>& pass) {
    force_row* const kept = pass.keep ? s.heavy.rows.data() : nullptr;
    return evaluate(s.heavy, rows, s.grains.view(), s.settings.grain_contact, pass.since,
                    heavy_job<S>{s, across, across, rows.begin < s.heavy.shared, kept})
        .taken;
}
template <class S> void move_ready(S& s, range_work& work, const sweep_pass<S>& pass) {
    using allowed = allowance<typename S::body_type::reference>;
    // light contacts see a clump along its velocity, half a step ahead
    const auto ahead = [&](std::size_t body) { return s.broken.way_ahead(s.grains, body, s.dt); };
    work.use = std::max(work.use, s.grains.advance(std::span<const moving_body>(work.ready), pass.rule, s.listed,
                                                   allowed{s.near.since.bodies, s.near.margins, pass.stretch}, ahead));
    work.ready.clear();
}
template <class S, class Look>
void sweep_range(S& s, const body_range& r, typename S::work& work, const sweep_pass<S>& pass, Look&& look) {
    for (std::uint32_t k : r.incoming) s.shared_load[k].add_to_j(s.acting[s.grains.body_of(s.heavy.pairs[k].j)]);
    std::size_t row = r.rows.begin, body = r.bodies.begin, shared = r.first_shared, wall = r.first_wall;
    std::size_t across = s.crossings.from(row);
    work.use = margin_use::within;
    for (;;) {
        for (; body < r.bodies.end && s.ranges.end_of(body) <= row; ++body)
            if (s.grains.is_swept(body)) {
                work.ready.push_back({body, complete_load(s, body, shared, wall)});
                look(body, work);
                if (work.ready.size() == clump_strip::length) move_ready(s, work, pass);
            }
        if (row == r.rows.end) break;
        const std::size_t end = std::min(row + rows_at_once, r.rows.end);
        across = evaluate_heavy(s, {row, end}, across, pass);
        row = end;
    }
    move_ready(s, work, pass);
}

/// Evaluates all heavy contacts and moves all heavy bodies, in one stage of the scheme. since: span since contacts were
/// evaluated last (s). keep: rows of contacts are kept. look(body, work): is called for every body when its loads
/// are complete and before it moves, by the thread that sweeps it.
template <class S, class Look>
margin_use sweep(S& s, const integrators::stage& stage, double since, bool keep, Look&& look) {
    s.space.begin_sweep(s);
    if (keep) s.heavy.rows.resize(s.heavy.size());
    const sweep_pass<S> pass{
        {s.settings.scheme, s.space.flow(), stage.kick * s.dt, stage.drift * s.dt, s.memory.data()},
        since,
        s.space.stretch_since(s.near.since.frame),
        keep};
    each_chunk(s.settings.run, s.heavy.shared,
               [&](index_range some) { evaluate_heavy(s, some, s.crossings.from(some.begin), pass); });
    s.settings.run.for_each(
        s.ranges.size(), [&](std::size_t r) { sweep_range(s, s.ranges[r], s.sweeping[r], pass, look); }, 1);
    margin_use use = margin_use::within;
    for (const range_work& r : s.sweeping) use = std::max(use, r.use);
    return use;
}

} // namespace clast::rooms
