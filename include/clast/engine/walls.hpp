// SPDX-License-Identifier: MIT
// What a surface does to pebbles, and the loads that its facets take from them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <clast/boundaries/touch.hpp>
#include <clast/contacts/concepts.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/neighbourhood.hpp>
#include <clast/engine/scene.hpp>
#include <clast/engine/wall_friction.hpp>

namespace clast::rooms {

/// Contacts and forces of one pebble at the surface, `ahead` seconds from now; h: span since the last evaluation (s).
template <class S> void evaluate_wall(const S& s, boundaries::wall_row& w, double h, double ahead) {
    using contact = typename S::contact;
    const boundaries::touches touching = s.boundary.touch(s.position(w.pebble), s.radius(w.pebble), ahead);
    w.force = w.friction = {}, w.lateral = 0.0, w.platen = {}, w.touch.size = 0;
    if (touching.size == 0) return;
    // across the normal see wall_friction.hpp: here the law sees no tangential motion and keeps no history
    const auto push = [&](const contact& law, double depth, double approach) {
        const contacts::overlap<double> o = s.overlap_at_wall(w.pebble, depth);
        const contacts::motion<double> m{0, 0, 0, 0, approach};
        if constexpr (requires { law.normal_force(o, m); })
            return law.normal_force(o, m);
        else {
            typename S::history none{};
            return -law(o, m, none, h).fz;
        }
    };
    const vec3 v = s.grains.velocity_of(w.pebble);
    const auto closing = [&](const boundaries::touch& t) {
        return t.along * s.boundary.velocity(t.facet) - dot(v, t.normal);
    };
    const vec3 u = boundaries::lateral_push(touching);
    const double way = norm(u);
    if (way > 0.0) {
        double approach = 0.0; // rate of the way out: that of each facet by its share
        for (const boundaries::touch& t : touching)
            if (!t.at_platen()) approach += t.depth / way * closing(t);
        w.lateral = push(s.settings.lateral_contact, way, approach);
        w.force += (w.lateral / way) * u;
    }
    for (const boundaries::touch& t : touching)
        if (t.at_platen()) {
            const double f = push(s.settings.platen_contact, t.depth, closing(t));
            w.platen[t.platen()] = f;
            w.force += f * t.normal;
        }
    w.touch = touching; // last: to copy at once what has just been written in pieces takes a fifth of all this
}
/// The same for all rows of one list, with friction where walls have it.
template <class S>
void evaluate_walls(const S& s, std::vector<boundaries::wall_row>& rows, std::vector<typename S::wall_grip>& grips,
                    double h, double ahead) {
    grips.resize(s.walls_rub() ? rows.size() : 0);
    s.settings.run.for_each(rows.size(), [&](std::size_t k) {
        evaluate_wall(s, rows[k], h, ahead);
        if (!grips.empty()) rub(s, rows[k], grips[k], h, ahead);
    });
}
/// What touches pebbles now, without forces.
template <class S> void touch_walls(const S& s, std::vector<boundaries::wall_row>& rows) {
    if constexpr (S::has_walls)
        s.settings.run.for_each(rows.size(), [&](std::size_t k) {
            rows[k].touch = s.boundary.touch(s.position(rows[k].pebble), s.radius(rows[k].pebble));
        });
}
/// Law of a pebble at the facet of a touch.
template <class S> const typename S::contact& law_at(const S& s, const boundaries::touch& t) {
    return t.at_platen() ? s.settings.platen_contact : s.settings.lateral_contact;
}

/// Adds what wall rows exert on facets, in order; names the facets that share a pebble if asked to.
template <class S>
void add_loads(const S& s, const std::vector<boundaries::wall_row>& wall, double share,
               std::vector<boundaries::facet_load>& loads, std::vector<boundaries::coupling>* couplings = nullptr) {
    for (const boundaries::wall_row& w : wall) {
        if (w.touch.size == 0) continue;
        // of all lateral touches of a pebble alike: four nodes to a face would each work them out again
        const double way = norm(boundaries::lateral_push(w.touch));
        const double lateral =
            way > 0.0 ? s.settings.lateral_contact.normal_stiffness(s.overlap_at_wall(w.pebble, way)) : 0.0;
        const auto stiffness = [&](const boundaries::touch& t) {
            return t.at_platen() ? s.settings.platen_contact.normal_stiffness(s.overlap_at_wall(w.pebble, t.depth))
                                 : lateral;
        };
        if (couplings == nullptr || w.touch.size == 1 || boundaries::is_one_face(w.touch)) {
            // a face that several facets span: each against what all of its facets do together
            for (const boundaries::touch& t : w.touch)
                loads[s.at(t.facet)].add(t, share * w.share(t, way), share * stiffness(t) * t.part);
            continue;
        }
        const boundaries::sharing shared(w.touch);
        std::array<const boundaries::touch*, boundaries::most_touches> seen{};
        std::size_t faces = 0;
        for (const boundaries::touch& t : w.touch) {
            const double f = w.share(t, way), k = stiffness(t);
            if (t.at_platen()) {
                loads[s.at(t.facet)].add(t, share * f, share * k);
                continue;
            }
            loads[s.at(t.facet)].add(t, share * f, share * k * shared(faces, faces) * (t.part * t.part));
            for (std::size_t j = 0; j < faces; ++j)
                couplings->push_back({seen[j]->facet, t.facet,
                                      k * shared(faces, j) * seen[j]->along * t.along * (seen[j]->part * t.part)});
            seen[faces++] = &t;
        }
    }
}

/// Loads of this step, the mean of sub-steps included, and the velocities that the boundary takes on from them for the
/// span that it is about to go (s).
template <class S> void control_walls(S& s, double span) {
    if (s.broken.has_balls())
        s.loads = s.light_loads;
    else
        s.loads.assign(s.loads.size(), {}), s.couplings.clear();
    add_loads(s, s.heavy_wall, 1.0, s.loads, &s.couplings);
    // work of the mean velocity around t_n, in step with the kinetic energy of a leapfrog
    double power = s.boundary.power(s.loads);
    power += friction_power(s);
    s.boundary.control(s.loads, s.drives, span, s.couplings);
    power += s.boundary.power(s.loads);
    power += friction_power(s);
    s.totals.boundary_work += 0.5 * power * span;
}
/// Walls and space go on by a span (s).
template <class S> void advance_walls(S& s, double span) {
    s.boundary.advance(span);
    s.space.advance(span);
    count_wall_travel(s, s.boundary.fastest() * std::abs(span));
}

} // namespace clast::rooms
