// SPDX-License-Identifier: MIT
// Energies that a scene holds, and what it has lost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/bodies/concepts.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/scene.hpp>
#include <clast/engine/wall_friction.hpp>

namespace clast::rooms {

/// Of all bodies (J).
template <class S> double kinetic_energy(const S& s) {
    const double swept = s.settings.run.sum(s.grains.body_count(), 0.0, [&](std::size_t b) {
        return s.grains.is_swept(b) ? s.grains.kinetic_energy(b) : 0.0;
    });
    return s.broken.add_kinetic_energy(s.grains, swept);
}
/// Of all bodies in the field (J), at the instant of their velocities; 0 where there is none.
template <class S> double potential_energy(const S& s) {
    if constexpr (S::field_type::acts) {
        double e = s.settings.run.sum(s.grains.body_count(), 0.0, [&](std::size_t b) {
            return s.grains.is_swept(b) ? s.potential_energy(b) : 0.0;
        });
        if constexpr (S::breakable)
            s.broken.each_ball(s.grains, [&](std::int32_t p, const body_motion& m) {
                e += s.settings.field.potential({s.grains.ball_mass(s.at(p)), m.x, m.v, s.totals.time - s.broken.lag});
            });
        return e;
    }
    return 0.0;
}
/// Energy in contacts, facets and bonds (J).
template <class S> double elastic_energy(const S& s) {
    using list_type = contact_list<typename S::history>;
    double e = 0.0;
    const auto add = [&](const list_type& list, std::size_t k) {
        const pebble_pair& pair = list.pairs[k];
        const double depth = s.radius(pair.i) + s.radius(pair.j) - norm(s.apart(list, k));
        const typename S::history none{};
        const typename S::history* h = &none;
        if constexpr (list_type::remembers) h = &list.history[k];
        e += s.settings.grain_contact.stored(s.overlap_of(pair, depth), *h);
    };
    s.each_heavy([&](std::size_t k) { add(s.heavy, k); });
    if constexpr (S::breakable)
        for (std::size_t k = 0; k < s.light.size(); ++k) add(s.light, k);
    const auto add_walls = [&](const std::vector<boundaries::wall_row>& wall,
                               const std::vector<typename S::wall_grip>& grips) {
        for (std::size_t k = 0; k < wall.size(); ++k) {
            const boundaries::wall_row& w = wall[k];
            const typename S::wall_grip held = grips.empty() ? typename S::wall_grip{} : grips[k];
            const double lateral = norm(boundaries::lateral_push(w.touch));
            if (lateral > 0.0)
                e += s.settings.lateral_contact.stored(s.overlap_at_wall(w.pebble, lateral),
                                                       held.part[lateral_wall].history);
            for (const boundaries::touch& t : w.touch)
                if (t.at_platen())
                    e += s.settings.platen_contact.stored(s.overlap_at_wall(w.pebble, t.depth),
                                                          held.part[t.platen()].history);
        }
    };
    if constexpr (S::has_walls) add_walls(s.heavy_wall, s.heavy_grip);
    if constexpr (S::has_walls && S::breakable) add_walls(s.light_wall, s.light_grip);
    return s.broken.add_bond_energy(e);
}
/// Lost to friction and damping so far (J).
template <class S> body_losses losses(const S& s) {
    body_losses total;
    for (const body_losses& l : s.grains.losses) total.friction += l.friction, total.damping += l.damping;
    return total;
}

} // namespace clast::rooms
