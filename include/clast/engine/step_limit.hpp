// SPDX-License-Identifier: MIT
// The time step from present stiffness: over heavy bodies and their present contacts, at most as large as three typical
// contacts would allow.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <fmt/core.h>

#include <clast/bodies/contact_list.hpp>
#include <clast/core/errors.hpp>
#include <clast/engine/scene.hpp>
#include <clast/engine/walls.hpp>
#include <clast/integrators/time_step.hpp>

namespace clast::rooms {

/// Overlap (m) at which a law is asked for its stiffness where no contact says more: what the smallest of pebbles would
/// reach if the fastest two bodies met head-on, by the energy that the law stores; at least a share of its radius
/// (engine_settings::expected_overlap), because a law may begin without any stiffness.
template <class S> double expected_overlap(const S& s) {
    const double least = s.settings.expected_overlap * s.smallest_radius;
    if constexpr (contacts::is_of_constant_stiffness<typename S::contact>()) return least;
    const vec3 flow = s.space.rates();
    double fastest = s.settings.run.max(s.grains.body_count(), s.boundary.fastest(), [&](std::size_t b) {
        return s.grains.is_swept(b) ? s.grains.surface_speed(b, flow) : 0.0;
    });
    fastest = s.broken.largest(s.grains, s.settings.run, fastest,
                               [](std::int32_t, const body_motion& m) { return norm(m.v); });
    const double energy = s.smallest_mass * fastest * fastest; // m/2 at twice the speed
    double depth = least;
    while (s.settings.grain_contact.stored(s.typical_overlap(depth), {}) < energy && depth < s.smallest_radius)
        depth *= 1.25;
    return depth;
}
/// Stiffness (N/m) of a typical contact, a mean over directions.
template <class S> double typical_stiffness(const S& s) {
    const contacts::overlap<double> typical = s.typical_overlap(expected_overlap(s));
    const auto& law = s.settings.grain_contact;
    return (law.normal_stiffness(typical) + 2.0 * law.shear_stiffness(typical)) / 3.0;
}
/// Step (s) that three contacts of this stiffness (N/m) would allow a body of this mass (kg): an upper bound, because
/// contacts come and go between two estimates.
template <class S> double typical_limit(const S& s, double mass, double stiffness) {
    return s.settings.safety * std::sqrt(mass / (3.0 * stiffness));
}

/// Whether the number of listed contacts is enough to see that a body allows a step (s): each adds at most its
/// stiffness, at the farthest point of the body.
template <class S> bool surely_allows(const S& s, std::size_t body, double step) {
    using contact = typename S::contact;
    if constexpr (contacts::is_of_constant_stiffness<contact>() && !contacts::resists_rotation<contact>) {
        const auto around = s.heavy_of->of(body);
        if (!around.empty() && around.back().row() >= s.heavy.size()) return false; // walls have laws of their own
        if (s.broken.has_balls() && !s.light_of.of(body).empty()) return false;
        const contacts::overlap<double> any = s.typical_overlap(0.0);
        const double shear = s.settings.grain_contact.shear_stiffness(any),
                     normal = std::max(s.settings.grain_contact.normal_stiffness(any), shear);
        const double turning = S::body_type::turns ? normal : shear; // of a sphere forces along n have no arm
        const double reach = s.grains.bounding_radius(body);
        const vec3 inertia = s.grains.body_inertia(body);
        const double largest = std::max(normal / s.grains.body_mass(body),
                                        turning * reach * reach / std::min({inertia.x, inertia.y, inertia.z}));
        return step * step * static_cast<double>(around.size()) * largest <= s.settings.safety * s.settings.safety;
    }
    return false;
}

/// Adds the stiffness of the rows that act on a body; centre: of what they turn (m).
template <class S>
void add_stiffness(const S& s, stiffness_sum& k, const incidence& of, std::size_t body,
                   const contact_list<typename S::history>& list, const std::vector<boundaries::wall_row>& wall,
                   const vec3& centre) {
    for (const incidence::entry& one : of.of(body)) {
        const std::size_t r = one.row();
        if (r < list.size()) {
            const pebble_pair& pair = list.pairs[r];
            const vec3 d = s.apart(list, r);
            const double distance = norm(d), depth = s.radius(pair.i) + s.radius(pair.j) - distance;
            if (depth <= -contacts::reach_of(s.settings.grain_contact)) continue;
            const contacts::overlap<double> o = s.overlap_of(pair, depth);
            const vec3 n = d / distance;
            const auto& law = s.settings.grain_contact;
            k.add(n, law.normal_stiffness(o), law.shear_stiffness(o),
                  s.position(one.pebble) - centre + (one.side() * (s.radius(one.pebble) - 0.5 * o.depth)) * n);
            if constexpr (contacts::resists_rotation<typename S::contact>)
                k.add_rotation(n, law.twisting_stiffness(o), law.rolling_stiffness(o));
        } else if constexpr (S::has_walls) {
            const boundaries::wall_row& w = wall[r - list.size()];
            const double rp = s.radius(w.pebble);
            for (const boundaries::touch& t : w.touch) { // facets that span a face bear a part of its stiffness each
                const auto o = s.overlap_at_wall(w.pebble, t.depth / t.part);
                k.add(t.normal, t.part * law_at(s, t).normal_stiffness(o),
                      s.walls_rub() ? t.part * law_at(s, t).shear_stiffness(o) : 0.0,
                      s.position(w.pebble) - rp * t.normal - centre);
            }
        }
    }
}

/// Whether a body cannot limit the time step, because forces do not move it.
template <class S> bool is_fixed([[maybe_unused]] const S& s, [[maybe_unused]] std::size_t body) {
    if constexpr (S::constraint_type::acts) return s.constraint.is_fixed(body);
    return false;
}
/// Smallest mass (kg) of a body that forces can move; of all bodies if they can move none.
template <class S> double smallest_free_mass(const S& s) {
    if constexpr (S::constraint_type::acts) {
        constexpr double none = -std::numeric_limits<double>::infinity();
        const double least = -s.settings.run.max(
            s.grains.body_count(), none, [&](std::size_t b) { return is_fixed(s, b) ? none : -s.grains.body_mass(b); });
        if (std::isfinite(least)) return least;
    }
    return s.smallest_mass;
}

/// dt of a scene, after some steps or from the beginning (first). Light bodies do not shrink it: they set the number of
/// sub-steps (light_bodies.hpp). At the beginning of a scene without bodies it stays 0; else throws input_error where
/// nothing gives a step.
template <class S> void estimate_step(S& s, bool first) {
    // from the present positions, not from what an earlier step left behind: a restart must see the same
    touch_walls(s, s.heavy_wall), touch_walls(s, s.light_wall);
    const double limit =
        std::min(typical_limit(s, smallest_free_mass(s), typical_stiffness(s)), s.settings.largest_step);
    if (!std::isfinite(limit)) {
        if (first && s.grains.body_count() == 0) return; // bodies may come from an archive
        throw input_error("engine_settings.largest_step", fmt::format("{:g} s", s.settings.largest_step),
                          "finite where there is no body, or grain_contact has no stiffness",
                          "Give bodies and a stiffness, or the step itself.");
    }
    s.index_heavy();
    const auto faster = [&](std::size_t b, double so_far) {
        if (!s.grains.is_swept(b) || is_fixed(s, b) || surely_allows(s, b, -so_far)) return so_far;
        stiffness_sum k(s.grains.body_axes(b));
        add_stiffness(s, k, *s.heavy_of, b, s.heavy, s.heavy_wall, s.grains.centre(b));
        if (s.broken.has_balls()) add_stiffness(s, k, s.light_of, b, s.light, s.light_wall, s.grains.centre(b));
        return -k.time_step(s.grains.body_mass(b), s.grains.body_inertia(b), s.settings.safety, -so_far);
    };
    const double least = -s.settings.run.max(s.grains.body_count(), -limit, faster);
    // grow slowly: contacts that are about to form are not in the sum yet
    s.dt = first ? least : std::min(least, 1.02 * s.dt);
    if constexpr (!S::has_criterion) s.heavy_of.reset(); // a tenth of the memory, and no one else asks for it
    s.estimate_due = false;
}

} // namespace clast::rooms
