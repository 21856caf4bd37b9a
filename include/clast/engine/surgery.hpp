// SPDX-License-Identifier: MIT
// The only room that changes owners: clumps become clusters of balls, and bonds of clusters fail. Nothing is made or
// lost here: pebbles get other owners, and pairs go from one list to another with what they remember.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <clast/bonds/cluster_pool.hpp>
#include <clast/bonds/parallel.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/grain_load.hpp>
#include <clast/engine/scene.hpp>
#include <clast/integrators/rotation.hpp>
#include <clast/measure/sample.hpp>

namespace clast::rooms {

// ---- which clumps are to be replaced --------------------------------------------------------------------------------

/// The criterion of a clump under the forces just evaluated.
template <class S> bool is_critical(const S& s, std::size_t g) {
    return !s.grains.shape_of(s.grains.grains[g]).bonds.empty() &&
           s.settings.breakage.utilisation(load_of(s, g)) >= s.settings.replacement.trigger;
}
/// The bonds with which a critical clump will be born as a cluster: solved for its present load.
template <class S> birth_certificate certificate(const S& s, std::size_t g) {
    const bonds::cluster_pool& pool = s.broken.pools[s.at(s.grains.grains[g].shape)];
    return {static_cast<std::int32_t>(g),
            s.settings.replacement.born(pool.shape(), pebble_loads(s, g), s.grains.turning[g].q, s.grains.motion[g].w)};
}
/// Whether clumps are looked at in this step.
template <class S> bool looks_at_clumps(const S& s) {
    if constexpr (S::breakable && S::has_criterion)
        return s.breakage_on && s.totals.steps % s.settings.replacement.check_interval == 0;
    return false;
}
/// What a sweep does with a body whose load is complete, in a step that looks at clumps or not.
template <class S> auto marks_critical([[maybe_unused]] const S& s, [[maybe_unused]] bool looks) {
    if constexpr (S::breakable && S::has_criterion)
        return [&s, looks](std::size_t body, range_work& work) {
            if (looks && is_critical(s, body)) work.marked.push_back(certificate(s, body));
        };
    else
        return [](std::size_t, range_work&) {};
}

// ---- clumps become clusters -----------------------------------------------------------------------------------------

/// A clump's pebbles become balls of their own in the same place with the same motion, joined by the bonds it was
/// given.
template <class S> void release(S& s, const birth_certificate& m) {
    auto& b = s.broken;
    const auto g = s.at(m.grain);
    grain& one = s.grains.grains[g];
    s.grains.place(g, s.unlisted.of(g));
    const vec3 spin = spin_of(s.grains.turning[g].q, s.grains.turning[g].l, s.grains.inverse_inertia(one));
    bonds::cluster_pool& pool = b.pools[s.at(one.shape)];
    for (std::size_t k = 0; k < pool.shape().size(); ++k) {
        const auto p = one.first + static_cast<std::int32_t>(k);
        const std::size_t ball = s.grains.ball(p);
        const vec3 x = s.position(p);
        const vec3 v = s.grains.motion[g].v + cross(spin, x - s.grains.motion[g].x);
        s.grains.motion[ball] = {x - b.lag * v, v, spin,
                                 1.0 / s.grains.ball_mass(s.at(p))}; // the motion of a ball trails t_n by the lag
        s.grains.owner[s.at(p)] = static_cast<std::int32_t>(ball);
        b.bonded[s.at(p)] = 1;
        b.balls.push_back(p);
    }
    double strength = 1.0;
    if constexpr (requires { s.settings.breakage.strength_factor(std::int64_t{}); })
        strength = s.settings.breakage.strength_factor(m.grain);
    one.cluster = static_cast<std::int32_t>(pool.add(m.born, strength));
    b.members[s.at(one.shape)].push_back(m.grain);
    s.totals.bond_dissipation -= pool.energy(s.at(one.cluster)); // born with energy that no one paid for
    ++s.totals.replaced;
}
/// Gives the pebbles of critical clumps new owners. At the end of a step, so that the next evaluation of forces already
/// sees balls and bonds: no ball is integrated without its bonds.
template <class S> void replace_marked(S& s) {
    if constexpr (S::breakable) {
        std::vector<birth_certificate>& marked = s.broken.marked;
        for (range_work& r : s.sweeping) {
            std::move(r.marked.begin(), r.marked.end(), std::back_inserter(marked));
            r.marked.clear();
        }
        if (marked.empty()) return;
        for (const birth_certificate& m : marked) release(s, m);
        std::sort(s.broken.balls.begin(), s.broken.balls.end());
        marked.clear();
        s.near.must_search = s.estimate_due = true;
    }
}

// ---- bonds fail -----------------------------------------------------------------------------------------------------

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
    e.mother = g;
    e.bond = r.bond;
    e.normal_force = r.before.n;
    e.shear_force = norm(r.before.v);
    e.bending_moment = norm(r.before.mb);
    e.twisting_moment = std::abs(r.before.mt);
    e.energy = bonds::energy(pool.shape().bond[s.at(r.bond)], r.before);
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
