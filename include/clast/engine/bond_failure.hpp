// SPDX-License-Identifier: MIT
// Bonds of clusters fail: the event, the pieces that are left, and the pair, which goes on as a contact.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <clast/bodies/contact_list.hpp>
#include <clast/bonds/cluster_pool.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/scene.hpp>
#include <clast/grains/shape.hpp>
#include <clast/measure/sample.hpp>

namespace clast::rooms {

/// Connected pieces of a cluster, named by their smallest pebble.
template <class S> void update_fragments(S& s, std::size_t which, std::int32_t cluster) {
    auto& b = s.broken;
    const bonds::cluster_pool& pool = b.pools[which];
    const std::int32_t first = s.grains.grains[s.at(b.members[which][s.at(cluster)])].first;
    const std::size_t n = pool.shape().size();
    for (std::size_t k = 0; k < n; ++k) b.fragment[s.at(first) + k] = first + static_cast<std::int32_t>(k);
    bool changed = true;
    while (changed) {
        changed = false;
        for (std::size_t e = 0; e < pool.bonds(); ++e) {
            if (!pool.is_intact(s.at(cluster), e)) continue;
            std::int32_t& i = b.fragment[s.at(first + pool.shape().ends[e].a)];
            std::int32_t& j = b.fragment[s.at(first + pool.shape().ends[e].b)];
            if (i != j) i = j = std::min(i, j), changed = true;
        }
    }
    if (pool.intact_bonds(s.at(cluster)) == 0)
        for (std::size_t k = 0; k < n; ++k) b.bonded[s.at(first) + k] = 0;
}
/// Reports a bond that has failed; its pair goes on as a frictional contact.
template <class S> void part(S& s, std::size_t which, const bonds::break_report& r) {
    const bonds::cluster_pool& pool = s.broken.pools[which];
    const std::int32_t g = s.broken.members[which][s.at(r.cluster)];
    const std::int32_t first = s.grains.grains[s.at(g)].first;
    const shape_bond& ends = pool.shape().ends[s.at(r.bond)];
    const pebble_pair pair{first + ends.a, first + ends.b};
    fracture_event e;
    e.time = s.broken.time;
    e.mode = r.mode;
    e.normal = unit(s.position(pair.j) - s.position(pair.i));
    e.position = s.position(pair.i) + s.radius(pair.i) * e.normal;
    e.mother = s.grains.grains[s.at(g)].origin;
    e.bond = number_of_bond(s.grains.shape_of(s.grains.grains[s.at(g)]), r.bond);
    e.normal_force = r.before.n;
    e.shear_force = norm(r.before.v);
    e.bending_moment = norm(r.before.mb);
    e.twisting_moment = std::abs(r.before.mt);
    e.energy = pool.energy_of(s.at(r.cluster), s.at(r.bond), r.before);
    s.broken.events.push_back(e);
    s.totals.bond_dissipation += e.energy;
    ++(r.mode == break_mode::tension ? s.totals.broken_tension : s.totals.broken_shear);
    const auto order = s.pair_order();
    const std::size_t k = find_pair(s.asleep, pair, order);
    if (k < s.asleep.size()) {
        s.asleep.erase(s.asleep.begin() + static_cast<std::ptrdiff_t>(k));
        s.light.insert(pair, order);
        s.near.wide.light.insert(pair, order);
    }
    update_fragments(s, which, r.cluster);
    s.estimate_due = true; // a lighter piece may need a smaller sub-step
}

} // namespace clast::rooms
