// SPDX-License-Identifier: MIT
// The pebbles and bodies of a specimen. Pebbles are for ever; owners change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/core/vector.hpp>
#include <clast/engine/contact_list.hpp>
#include <clast/grains/shape.hpp>

namespace clast {

/// Where a mother grain is in the tables, and what has become of it.
struct grain {
    std::int32_t first = 0;    ///< first pebble; a grain's pebbles are consecutive
    std::int32_t shape = 0;    ///< index into the shapes
    std::int32_t cluster = -1; ///< number in the cluster pool of its shape once replaced; -1 while it is a clump
};

/// Motion of a body (clump or ball): centre at t_n, velocities over the step that led to t_n.
struct body_motion {
    vec3 x; ///< mass centre (m)
    vec3 v; ///< m/s
    vec3 w; ///< rad/s, world axes
};

/// Orientation and angular momentum of a clump (world axes).
struct clump_rotation {
    quaternion q;
    vec3 l; ///< kg m^2/s
};

/// Energy that a body has lost so far (J).
struct body_losses {
    double friction = 0.0;
    double damping = 0.0;
};

/// Grains, pebbles and their bodies. Body g (g < grains) is the clump of grain g; body grains + p is the ball of pebble
/// p, which exists only in a breakable specimen. `owner` says which of them moves a pebble now.
struct specimen {
    std::vector<shape> shapes;
    double density = 2650.0; ///< kg/m^3

    std::vector<grain> grains;
    std::vector<pebble_motion> pebbles;  ///< per pebble; of clumps only those in a contact list are kept up to date
    std::vector<std::int32_t> mother;    ///< per pebble: its grain
    std::vector<std::int32_t> owner;     ///< per pebble: its body
    std::vector<body_motion> motion;     ///< per body
    std::vector<clump_rotation> turning; ///< per grain
    std::vector<body_losses> losses;     ///< per body

    std::size_t grain_count() const { return grains.size(); }
    std::size_t pebble_count() const { return pebbles.size(); }
    const shape& shape_of(const grain& g) const { return shapes[static_cast<std::size_t>(g.shape)]; }
    bool is_clump(std::size_t g) const { return grains[g].cluster < 0; }
    double mass_of(const grain& g) const { return density * shape_of(g).volume; }
    double ball_mass(std::size_t p) const { return density * sphere_volume(pebbles[p].radius); }
    double ball_inertia(std::size_t p) const { return density * sphere_inertia_per_density(pebbles[p].radius); }
    vec3 inverse_inertia(const grain& g) const {
        const vec3 i = density * shape_of(g).inertia_per_density;
        return {1.0 / i.x, 1.0 / i.y, 1.0 / i.z};
    }
    /// Total pebble volume (m^3): invariant under replacement.
    double solid_volume() const {
        double v = 0.0;
        for (const pebble_motion& p : pebbles) v += sphere_volume(p.radius);
        return v;
    }

    /// Adds a clump at rest and returns its grain id.
    std::int32_t add(std::int32_t shape_index, const vec3& centre, const quaternion& q) {
        const auto id = static_cast<std::int32_t>(grains.size());
        const shape& s = shapes[static_cast<std::size_t>(shape_index)];
        grains.push_back({static_cast<std::int32_t>(pebbles.size()), shape_index, -1});
        for (const shape_pebble& p : s.pebbles) {
            pebbles.push_back({centre + rotate(q, p.offset),
                               p.radius,
                               {},
                               1.0 / (density * sphere_volume(p.radius)),
                               {},
                               1.0 / (density * sphere_inertia_per_density(p.radius))});
            mother.push_back(id);
            owner.push_back(id);
        }
        motion.push_back({centre, {}, {}});
        turning.push_back({q, {}});
        losses.push_back({});
        return id;
    }

    template <class A> void archive(A& a) {
        a(shapes, density, grains, pebbles, mother, owner, motion, turning, losses);
    }
};

} // namespace clast
