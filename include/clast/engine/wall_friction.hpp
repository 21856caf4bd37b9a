// SPDX-License-Identifier: MIT
// Friction of a surface: what a wall does to a pebble across its normal, and how that goes on while the pebble slides,
// rolls and turns, and the wall moves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/boundaries/concepts.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/contacts/concepts.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/scene.hpp>

namespace clast::rooms {

/// The parts of a surface that keep a history of their own for every pebble.
enum wall_part : std::size_t { bottom_end, top_end, lateral_wall, wall_parts };

/// Where one part of the surface pushes a pebble: the platen, or the lateral facets together, by their shares of the
/// way out.
struct wall_push {
    vec3 normal;        ///< unit vector into the specimen; zero where nothing pushes
    double depth = 0.0; ///< m
    double force = 0.0; ///< along the normal (N)
    vec3 surface;       ///< velocity of the surface there (m/s)
};
template <class S>
std::array<wall_push, wall_parts> pushes_of(const S& s, const boundaries::wall_row& w, double ahead) {
    std::array<wall_push, wall_parts> out;
    const vec3 u = boundaries::lateral_push(w.touch);
    const double way = norm(u);
    if (way > 0.0) out[lateral_wall] = {u / way, way, w.lateral, {}};
    const double r = s.radius(w.pebble);
    const vec3 x = s.position(w.pebble);
    for (const boundaries::touch& t : w.touch) {
        const vec3 v = boundaries::velocity_of(s.boundary, t, x - r * t.normal, ahead);
        if (t.at_platen())
            out[t.platen()] = {t.normal, t.depth, w.platen[t.platen()], v};
        else
            out[lateral_wall].surface += (t.depth * dot(t.normal, out[lateral_wall].normal) / way) * v;
    }
    return out;
}

/// One part of the surface against one pebble over a span h (s): adds force, moment and loss.
template <class S>
void rub(const S& s, const typename S::contact& law, const wall_push& push, std::int32_t pebble, double h,
         typename S::wall_grip& grip, std::size_t part) {
    typename S::wall_grip::hold& hold = grip.part[part];
    if (push.depth <= 0.0) {
        hold = {};
        return;
    }
    const vec3 normal = -push.normal; // from the pebble to the wall
    const vec3 arm = (s.radius(pebble) - 0.5 * push.depth) * normal, spin = s.grains.spin_of_pebble(pebble);
    const vec3 relative = s.grains.velocity_of(pebble) + cross(spin, arm) - push.surface;
    const bool fresh = norm2(hold.normal) == 0.0;
    const vec3 mid = fresh ? normal : normal + hold.normal;
    const double reflect = 2.0 / norm2(mid);
    const vec3 slid = h * (relative - (0.5 * reflect * dot(relative, mid)) * mid), turned = h * spin;
    contacts::overlap<double> o = s.overlap_at_wall(pebble, push.depth);
    o.nx = normal.x, o.ny = normal.y, o.nz = normal.z;
    const contacts::motion<double> m{slid.x,   slid.y,  slid.z, 0.5 * dot(turned, normal), dot(relative, normal),
                                     mid.x,    mid.y,   mid.z,  fresh ? 0.0 : reflect,     turned.x,
                                     turned.y, turned.z};
    const auto answer = law(o, m, hold.history, h);
    const vec3 force = reject(vec3{answer.fx, answer.fy, answer.fz}, normal);
    hold.normal = normal, hold.force = force;
    grip.force += force;
    grip.moment += cross(arm, force);
    if constexpr (requires { answer.mx; }) grip.moment += vec3{answer.mx, answer.my, answer.mz};
    grip.dissipated += answer.dissipated;
}
/// Friction of the whole surface on the pebble of a row whose normal forces have been found, added to the row.
template <class S> void rub(const S& s, boundaries::wall_row& w, typename S::wall_grip& grip, double h, double ahead) {
    grip.force = grip.moment = {}, grip.dissipated = 0.0;
    const auto pushes = pushes_of(s, w, ahead);
    for (std::size_t part = 0; part < wall_parts; ++part)
        rub(s, part == lateral_wall ? s.settings.lateral_contact : s.settings.platen_contact, pushes[part], w.pebble, h,
            grip, part);
    w.force += grip.force, w.friction = grip.force;
}

/// Power (W) of the surface on the specimen through its friction: force times its velocity there.
template <class S>
double friction_power(const S& s, const std::vector<boundaries::wall_row>& wall,
                      const std::vector<typename S::wall_grip>& grips) {
    double power = 0.0;
    for (std::size_t k = 0; k < grips.size(); ++k) {
        if (wall[k].touch.size == 0) continue;
        const auto pushes = pushes_of(s, wall[k], 0.0);
        for (std::size_t part = 0; part < wall_parts; ++part)
            power += dot(grips[k].part[part].force, pushes[part].surface);
    }
    return power;
}
template <class S> double friction_power(const S& s) {
    double power = friction_power(s, s.heavy_wall, s.heavy_grip);
    if constexpr (S::breakable) power += friction_power(s, s.light_wall, s.light_grip);
    return power;
}

/// Gives the rows of new lists what their pebbles had in the old ones.
template <class S>
std::vector<typename S::wall_grip> grips_for(const S& s, const std::vector<boundaries::wall_row>& wall,
                                             const std::vector<std::int32_t>& place,
                                             const std::vector<typename S::wall_grip>& old) {
    std::vector<typename S::wall_grip> grips(wall.size());
    for (std::size_t k = 0; k < wall.size(); ++k)
        if (const std::int32_t p = place[s.at(wall[k].pebble)]; p >= 0) grips[k] = old[s.at(p)];
    return grips;
}

} // namespace clast::rooms
