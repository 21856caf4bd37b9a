// SPDX-License-Identifier: MIT
// One number for all results of an engine, which does not depend on where its members stand or on threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <clast/bodies/contact_list.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/breakage_state.hpp>
#include <clast/io/archive.hpp>
#include <clast/measure/sample.hpp>

namespace clast::measure {

namespace detail {

/// By pebbles: threads decide where in the list a contact stands.
template <class History> void add_contacts(hash_archive& a, const contact_list<History>& list) {
    const auto key = [&](std::size_t k) { return std::tuple(list.pairs[k], list.image_of(k)); };
    std::vector<std::size_t> order(list.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t k, std::size_t l) { return key(k) < key(l); });
    a(static_cast<std::uint64_t>(order.size()));
    for (const std::size_t k : order) {
        a(list.pairs[k].i, list.pairs[k].j);
        if (!list.image.empty()) a(list.image[k]);
        if constexpr (contact_list<History>::remembers) a(list.history[k]); // an empty one is a byte of padding
    }
}

template <class Engine> void add_grains(hash_archive& a, const Engine& e) {
    const auto& s = e.grains;
    a(static_cast<std::uint64_t>(s.pebble_count()), static_cast<std::uint64_t>(s.body_count()));
    for (std::size_t p = 0; p < s.pebble_count(); ++p)
        a(s.pebbles[p].x, s.pebbles[p].radius, static_cast<std::uint64_t>(s.body_of(static_cast<std::int32_t>(p))));
    const auto add = [&a](const auto& body) { a(body.v, body.w, body.x); };
    if constexpr (Engine::body_type::turns) {
        // what is left in the tables of bodies that are no more decides nothing
        for (std::size_t g = 0; g < s.body_count(); ++g)
            if (s.is_swept(g)) add(s.motion[g]), a(s.turning[g].q, s.turning[g].l);
        e.breakage().each_ball(s, [&](std::int32_t, const body_motion& m) { add(m); });
    } else {
        for (const auto& p : s.pebbles) add(p);
    }
    for (const auto& l : s.losses) a(l.friction, l.damping);
}

inline void add_breakage(hash_archive&, const unbroken&) {}
inline void add_breakage(hash_archive& a, const breakage_state& b) {
    a(b.fragment, b.balls, b.bonded);
    for (std::size_t k = 0; k < b.pools.size(); ++k) {
        a(b.members[k]);
        const auto& pool = b.pools[k];
        for (std::size_t c = 0; c < pool.size(); ++c)
            for (std::size_t bond = 0; bond < pool.bonds(); ++bond) {
                a(pool.is_intact(c, bond));
                if (pool.is_intact(c, bond)) a(pool.get(c, bond));
            }
    }
}

template <class Engine> void add_boundary(hash_archive& a, const Engine& e) {
    const auto& b = e.boundary;
    if constexpr (requires { b.volume(); }) a(b.volume(), b.height(), b.section());
    if constexpr (requires { b.area(0); })
        for (int f = 0; f < b.facet_count(); ++f) a(b.velocity(f), b.area(f));
    if constexpr (requires { b.view(e.loads()); })
        for (const facet_view& f : b.view(e.loads())) a(f.corner);
    if constexpr (Engine::space_type::has_images) a(e.space.edges(), e.space.edge_speeds());
}

template <class Engine> void add_totals(hash_archive& a, const Engine& e) {
    const auto& t = e.totals();
    a(t.boundary_work, t.bond_dissipation, t.initial_energy, t.steps, t.rebuilds, t.renewals, t.replaced,
      t.broken_tension, t.broken_shear, t.time, e.dt(), e.light_steps());
}

/// Forces of walls in the last step (N).
template <class Engine> void add_wall_forces(hash_archive& a, const Engine& e) {
    std::vector<std::pair<std::int32_t, vec3>> rows;
    e.each_wall_row([&](const auto& w) { rows.emplace_back(w.pebble, w.force); });
    std::sort(rows.begin(), rows.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    a(rows);
    for (const boundaries::facet_load& l : e.loads()) a(l.force, l.stiffness, l.contacts, l.edge);
}

template <class Engine> hash_archive add_state(Engine& e) {
    e.place_all();
    hash_archive a;
    add_grains(a, e);
    add_breakage(a, e.breakage());
    add_contacts(a, e.heavy_contacts());
    add_contacts(a, e.light_contacts());
    add_boundary(a, e);
    add_totals(a, e);
    return a;
}

} // namespace detail

/// Digest (FNV-1a) of the state of an engine: equal for equal runs, on any number of threads and in any version of
/// clast that gives the same results. (A `checksum` of the engine also holds the order of its members.) Taken in, in
/// this order:
///
/// - pebbles by number: x, radius, body; then v, w, x of the bodies that move, clumps before balls, and q and l of
///   clumps; losses of all bodies
/// - of a breakable scene: fragment, balls, bonded; per shape the grains of clusters, and their intact bonds
/// - listed pairs of clumps, then those with a ball, each by (i, j, image), with their histories
/// - the boundary: volume, height, section, velocity and area of facets, their corners; or edges of a cell and their
/// speeds
/// - totals, dt, and the number of sub-steps
///
/// Settings, drives and the boundary's counters are not in it. The engine is not const because all pebbles are placed
/// first (place_all), which changes nothing that a step reads.
template <class Engine> std::uint64_t digest_of_state(Engine& e) { return detail::add_state(e).value; }

/// The same with the forces of the last step on walls: rows by pebble, then loads of facets. A stored state has none
/// before its first step, so this is for runs that have made one.
template <class Engine> std::uint64_t digest(Engine& e) {
    hash_archive a = detail::add_state(e);
    detail::add_wall_forces(a, e);
    return a.value;
}

} // namespace clast::measure
