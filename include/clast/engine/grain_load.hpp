// SPDX-License-Identifier: MIT
// What a criterion asks of a clump: the forces that its neighbours exert on it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/bodies/contact_list.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>
#include <clast/criteria/concepts.hpp>
#include <clast/engine/scene.hpp>

namespace clast::rooms {

/// f(pebble, neighbour, force, point) for every row of one list that acts on a clump; neighbour: body id, or -1 -
/// facet.
template <class S, class F>
void each_row_of(const S& s, std::size_t g, const incidence& of, const contact_list<typename S::history>& list,
                 const std::vector<boundaries::wall_row>& wall, F&& f) {
    for (const incidence::entry& one : of.of(g)) {
        if (one.row() < list.size()) {
            const force_row& row = list.rows[one.row()];
            if (row.depth == 0.0) continue;
            const double side = one.side();
            const pebble_pair& pair = list.pairs[one.row()];
            f(one.pebble, s.grains.owner[s.at(one.is_second() ? pair.i : pair.j)], side * row.force,
              s.position(one.pebble) + (side * (s.radius(one.pebble) - 0.5 * row.depth)) * row.normal);
        } else {
            const boundaries::wall_row& w = wall[one.row() - list.size()];
            const vec3 x = s.position(w.pebble);
            const double r = s.radius(w.pebble);
            for (const boundaries::touch& t : w.touch)
                f(w.pebble, -1 - t.facet, w.share(t) * t.normal, x - r * t.normal);
            if (norm2(w.friction) > 0.0)
                f(w.pebble, -1 - w.touch.begin()->facet, w.friction, x - r * unit(w.force - w.friction));
        }
    }
}
/// The same for every row of a clump. Rows must have been kept, and indexed.
template <class S, class F> void each_row_of(const S& s, std::size_t g, F&& f) {
    each_row_of(s, g, *s.heavy_of, s.heavy, s.heavy_wall, f);
    if (s.broken.has_balls()) each_row_of(s, g, s.light_of, s.light, s.light_wall, f);
}

/// What a criterion may ask of a clump: the largest resultant over its neighbours and its mean stress.
template <class S> criteria::grain_load load_of(const S& s, std::size_t g) {
    const shape& own = s.grains.shape_of(s.grains.grains[g]);
    criteria::grain_load load;
    load.diameter = own.diameter;
    load.volume = own.volume;
    load.grain = static_cast<std::int64_t>(g);
    const bool wants_stress = criteria::contains(criteria::needs_of(s.settings.breakage), criteria::needs::stress);
    struct neighbour {
        std::int32_t id;
        vec3 force;
    };
    std::vector<neighbour> around; // few, but a clump among fragments may have many
    around.reserve(32);
    each_row_of(s, g, [&](std::int32_t, std::int32_t id, const vec3& f, const vec3& point) {
        std::size_t k = 0;
        while (k < around.size() && around[k].id != id) ++k;
        if (k == around.size()) around.push_back({id, {}});
        around[k].force += f;
        // force into the grain at the arm x - X: f (x) arm is negative in compression
        if (wants_stress) load.stress += (-1.0 / own.volume) * outer(f, point - s.grains.motion[g].x);
    });
    for (const neighbour& n : around) load.largest_force = std::max(load.largest_force, norm(n.force));
    return load;
}

/// Forces and moments on the pebbles of a clump, about their centres.
template <class S> std::vector<bonds::pebble_load> pebble_loads(const S& s, std::size_t g) {
    const grain& one = s.grains.grains[g];
    std::vector<bonds::pebble_load> load(s.grains.shape_of(one).pebbles.size());
    each_row_of(s, g, [&](std::int32_t pebble, std::int32_t, const vec3& f, const vec3& point) {
        bonds::pebble_load& l = load[s.at(pebble - one.first)];
        l.force += f;
        l.moment += cross(point - s.position(pebble), f);
    });
    return load;
}

} // namespace clast::rooms
