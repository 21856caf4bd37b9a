// SPDX-License-Identifier: MIT
// What a criterion asks of a clump: the forces that its neighbours exert on it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/bodies/contact_list.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>
#include <clast/criteria/concepts.hpp>
#include <clast/engine/scene.hpp>

namespace clast::rooms {

/// Whether load_of() fills all that a criterion may ask for.
template <class C> inline constexpr bool fills_all_needs = true;
template <criteria::evaluated_criterion C>
inline constexpr bool fills_all_needs<C> = criteria::contains(criteria::everything, C::needs);

/// What one row exerts on a clump.
struct acting_force {
    std::int32_t pebble;    ///< of the clump
    std::int32_t neighbour; ///< what the other pebble is a part of, a clump or a fragment; -1 - part of the surface
    vec3 force;             ///< N
    vec3 point;             ///< m
    double radius;          ///< r1 r2 / (r1 + r2) of the two pebbles, at a facet that of the pebble (m)
};

/// f(acting_force) for every row of one list that acts on a clump.
template <class S, class F>
void each_row_of(const S& s, std::size_t g, const incidence& of, const contact_list<typename S::history>& list,
                 const std::vector<boundaries::wall_row>& wall, F&& f) {
    for (const incidence::entry& one : of.of(g)) {
        const double r = s.radius(one.pebble);
        if (one.row() < list.size()) {
            const force_row& row = list.rows[one.row()];
            if (row.depth == 0.0) continue;
            const double side = one.side();
            const pebble_pair& pair = list.pairs[one.row()];
            const std::int32_t other = one.is_second() ? pair.i : pair.j;
            f(acting_force{one.pebble, static_cast<std::int32_t>(s.broken.piece_of(s.grains, other)), side * row.force,
                           s.position(one.pebble) + (side * (r - 0.5 * row.depth)) * row.normal,
                           r * s.radius(other) / (r + s.radius(other))});
        } else {
            const boundaries::wall_row& w = wall[one.row() - list.size()];
            const vec3 x = s.position(w.pebble);
            const auto wall_of = [&s](const boundaries::touch& t) {
                return -1 - boundaries::part_of(s.boundary, t.facet);
            };
            double pushed = 0.0, depth = 0.0;
            for (const boundaries::touch& t : w.touch) {
                f(acting_force{w.pebble, wall_of(t), w.share(t) * t.normal, x - r * t.normal, r});
                pushed += w.share(t), depth += w.share(t) * t.depth;
            }
            if (norm2(w.friction) > 0.0) // in the middle of the overlap, as in wall_friction.hpp
                f(acting_force{w.pebble, wall_of(*w.touch.begin()), w.friction,
                               x - (r - 0.5 * depth / pushed) * unit(w.force - w.friction), r});
        }
    }
}
/// The same for every row of a clump. Rows must have been kept, and indexed.
template <class S, class F> void each_row_of(const S& s, std::size_t g, F&& f) {
    each_row_of(s, g, *s.heavy_of, s.heavy, s.heavy_wall, f);
    if (s.broken.has_balls()) each_row_of(s, g, s.light_of, s.light, s.light_wall, f);
}

/// What a clump feels of one neighbour.
struct neighbour_load {
    std::int32_t id = 0;  ///< acting_force::neighbour
    vec3 force;           ///< resultant of its contacts (N)
    double largest = 0.0; ///< square of the largest of them (N^2)
    double radius = 0.0;  ///< of that (acting_force::radius)
};
/// All that touch a clump, in the order of its rows: clumps, fragments of what has been replaced (balls that bonds join
/// push as one), each platen, and the lateral wall, whatever number of its facets. f(acting_force) is called for each
/// of these, too.
template <class S, class F> std::vector<neighbour_load> neighbours_of(const S& s, std::size_t g, F&& f) {
    std::vector<neighbour_load> around; // few, but a clump among fragments may have many
    around.reserve(32);
    each_row_of(s, g, [&](const acting_force& one) {
        std::size_t k = 0;
        while (k < around.size() && around[k].id != one.neighbour) ++k;
        if (k == around.size()) around.push_back({one.neighbour, {}});
        around[k].force += one.force;
        if (norm2(one.force) > around[k].largest) around[k].largest = norm2(one.force), around[k].radius = one.radius;
        f(one);
    });
    return around;
}

/// What its criterion may ask of a clump; what it does not ask for stays at zero. forces: room for those of the
/// neighbours, to which the answer points.
template <class S> criteria::grain_load load_of(const S& s, std::size_t g, std::vector<vec3>& forces) {
    using criteria::needs;
    const auto wants = [asked = criteria::needs_of(s.settings.breakage)](needs what) {
        return criteria::contains(asked, what);
    };
    const grain& one = s.grains.grains[g];
    criteria::grain_load load;
    load.diameter = s.grains.diameter_of(one);
    load.volume = s.grains.volume_of(one);
    load.grain = one.origin;
    const bool wants_stress = wants(needs::stress);
    const auto around = neighbours_of(s, g, [&](const acting_force& f) {
        // force into the grain at the arm x - X: f (x) arm is negative in compression
        if (wants_stress) load.stress += (-1.0 / load.volume) * outer(f.force, f.point - s.grains.motion[g].x);
    });
    const neighbour_load* most = nullptr;
    double single = 0.0;
    for (const neighbour_load& n : around) single = std::max(single, n.largest);
    load.largest_single = std::sqrt(single);
    for (const neighbour_load& n : around)
        if (const double size = norm(n.force); size > load.largest_force) load.largest_force = size, most = &n;
    if (most != nullptr && wants(needs::largest_contact))
        load.contact_radius = most->radius, load.contact_at_wall = most->id < 0;
    if (wants(needs::coordination)) load.coordination = around.size();
    forces.clear();
    if (wants(needs::neighbour_forces)) {
        for (const neighbour_load& n : around) forces.push_back(n.force);
        load.neighbour_forces = forces;
    }
    return load;
}

/// Forces and moments on the pebbles of a clump, about their centres.
template <class S> std::vector<bonds::pebble_load> pebble_loads(const S& s, std::size_t g) {
    const grain& one = s.grains.grains[g];
    std::vector<bonds::pebble_load> load(s.grains.shape_of(one).pebbles.size());
    each_row_of(s, g, [&](const acting_force& f) {
        bonds::pebble_load& l = load[s.at(f.pebble - one.first)];
        l.force += f.force;
        l.moment += cross(f.point - s.position(f.pebble), f.force);
    });
    return load;
}

} // namespace clast::rooms
