// SPDX-License-Identifier: MIT
// The pebbles and bodies of a specimen, and how bodies move. Pebbles are for ever; owners change.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <clast/core/vector.hpp>
#include <clast/engine/contact_list.hpp>
#include <clast/grains/shape.hpp>
#include <clast/integrators/local_damping.hpp>
#include <clast/integrators/rotation.hpp>

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

/// Force (N) and moment about its centre (N m) that act on a body, and the loss to friction booked on it (J).
struct load_sum {
    vec3 force;
    vec3 moment;
    double dissipated = 0.0;
};

/// Indices from begin to end - 1.
struct index_range {
    std::size_t begin, end;
};

/// Grains, pebbles and their bodies. Body g (g < grains) is the clump of grain g; body grains + p is the ball of pebble
/// p, which exists only in a breakable specimen. `owner` says which of them moves a pebble now.
struct specimen {
    std::vector<shape> shapes;
    double density = 2650.0; ///< kg/m^3

    std::vector<grain> grains;
    std::vector<clump_pebble> pebbles;   ///< per pebble; of clumps only those in a contact list are kept up to date
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
            const vec3 arm = rotate(q, p.offset);
            pebbles.push_back({{centre + arm,
                                p.radius,
                                {},
                                1.0 / (density * sphere_volume(p.radius)),
                                {},
                                1.0 / (density * sphere_inertia_per_density(p.radius))},
                               arm});
            mother.push_back(id);
            owner.push_back(id);
        }
        motion.push_back({centre, {}, {}});
        turning.push_back({q, {}});
        losses.push_back({});
        return id;
    }

    // ---- what an engine asks of bodies that are swept (here clumps)
    // --------------------------------------------------
    static constexpr bool turns = true; ///< bodies have an orientation

    /// What displacements are measured from: centre and orientation at the last renewal of the lists.
    struct reference {
        vec3 centre;
        quaternion q;
    };

    std::size_t body_count() const { return grains.size(); }
    bool is_swept(std::size_t g) const { return is_clump(g); }
    std::size_t body_of(std::int32_t pebble) const {
        return static_cast<std::size_t>(owner[static_cast<std::size_t>(pebble)]);
    }
    /// Pebbles of one group stand together; contact lists are sorted by the group of the first pebble.
    std::size_t group_of(std::int32_t pebble) const {
        return static_cast<std::size_t>(mother[static_cast<std::size_t>(pebble)]);
    }
    const vec3& centre(std::size_t g) const { return motion[g].x; }
    double bounding_radius(std::size_t g) const { return shape_of(grains[g]).circumscribed_radius; }
    index_range pebbles_of(std::size_t g) const {
        const auto first = static_cast<std::size_t>(grains[g].first);
        return {first, first + shape_of(grains[g]).pebbles.size()};
    }
    double body_mass(std::size_t g) const { return mass_of(grains[g]); }                                 ///< kg
    vec3 body_inertia(std::size_t g) const { return density * shape_of(grains[g]).inertia_per_density; } ///< kg m^2
    mat3 body_axes(std::size_t g) const { return matrix(turning[g].q); }
    double kinetic_energy(std::size_t g) const {
        return 0.5 * mass_of(grains[g]) * norm2(motion[g].v) +
               rotational_energy(turning[g].q, turning[g].l, inverse_inertia(grains[g]));
    }
    reference refer(std::size_t g) const { return {motion[g].x, turning[g].q}; }
    /// Largest way of a point of the body since then (m); the centre's own way is measured from `from`.
    double displacement(std::size_t g, const reference& since, const vec3& from) const {
        const quaternion d = conjugate(since.q) * turning[g].q;
        const double turned_by = 2.0 * std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z); // chord of a unit radius
        return norm(motion[g].x - from) + bounding_radius(g) * turned_by;
    }
    /// Moves a body by one step h (s) under its load, with local damping of force and moment (in the body frame).
    void advance(std::size_t g, const load_sum& load, double h, double damping) {
        const vec3 inverse = inverse_inertia(grains[g]);
        body_motion& m = motion[g];
        clump_rotation& turn = turning[g];
        const vec3 df = damping_force(load.force, m.v, damping);
        const vec3 dm = damping_moment(turn.q, load.moment, m.w, damping);
        const vec3 v = m.v, w = m.w;
        m.v += (h / mass_of(grains[g])) * (load.force + df);
        turn.l += h * (load.moment + dm);
        const vec3 spin = spin_of(turn.q, turn.l, inverse);
        losses[g].damping -= 0.5 * h * (dot(df, v + m.v) + dot(dm, w + spin));
        losses[g].friction += load.dissipated;
        const turned next = advance_rotation(turn.q, turn.l, inverse, h);
        m.x += h * m.v;
        m.w = next.spin;
        turn.q = next.q;
    }
    /// Places those pebbles of a clump for which chosen(pebble).
    template <class F> void place(std::size_t g, F&& chosen) {
        const shape& s = shape_of(grains[g]);
        const body_motion& m = motion[g];
        const mat3 turn = matrix(turning[g].q);
        for (std::size_t k = 0; k < s.pebbles.size(); ++k) {
            const std::size_t p = static_cast<std::size_t>(grains[g].first) + k;
            if (!chosen(p)) continue;
            const vec3 arm = turn * s.pebbles[k].offset;
            pebbles[p].arm = arm;
            pebbles[p].x = m.x + arm;
            pebbles[p].v = m.v + cross(m.w, arm);
            pebbles[p].w = m.w;
        }
    }
    /// Moves a body elsewhere at another velocity (an image in a periodic cell); its pebbles are not placed.
    void shift(std::size_t g, const vec3& by, const vec3& faster) { motion[g].x += by, motion[g].v += faster; }
    double smallest_mass() const {
        double least = std::numeric_limits<double>::infinity();
        for (const shape& one : shapes) least = std::min(least, density * one.volume);
        return least;
    }

    template <class A> void archive(A& a) {
        a(shapes, density, grains, pebbles, mother, owner, motion, turning, losses);
    }
};

/// Spheres that move on their own, nothing else: no grain, no orientation, no owner, and no memory for them. A body is
/// its pebble, and the pebble holds the body's motion.
struct sphere_specimen {
    double density = 2650.0; ///< kg/m^3
    std::vector<pebble_motion> pebbles;
    std::vector<body_losses> losses;

    static constexpr bool turns = false;
    struct reference {
        vec3 centre;
    };

    /// Adds a sphere at rest and returns its number.
    std::int32_t add(const vec3& centre, double radius) {
        pebbles.push_back({centre,
                           radius,
                           {},
                           1.0 / (density * sphere_volume(radius)),
                           {},
                           1.0 / (density * sphere_inertia_per_density(radius))});
        losses.push_back({});
        return static_cast<std::int32_t>(pebbles.size() - 1);
    }
    std::size_t pebble_count() const { return pebbles.size(); }
    std::size_t grain_count() const { return pebbles.size(); }
    double solid_volume() const {
        double v = 0.0;
        for (const pebble_motion& p : pebbles) v += sphere_volume(p.radius);
        return v;
    }

    std::size_t body_count() const { return pebbles.size(); }
    static constexpr bool is_swept(std::size_t) { return true; }
    static constexpr std::size_t body_of(std::int32_t pebble) { return static_cast<std::size_t>(pebble); }
    static constexpr std::size_t group_of(std::int32_t pebble) { return static_cast<std::size_t>(pebble); }
    const vec3& centre(std::size_t b) const { return pebbles[b].x; }
    double bounding_radius(std::size_t b) const { return pebbles[b].radius; }
    index_range pebbles_of(std::size_t b) const { return {b, b + 1}; }
    double body_mass(std::size_t b) const { return 1.0 / pebbles[b].inverse_mass; }
    vec3 body_inertia(std::size_t b) const {
        const double i = 1.0 / pebbles[b].inverse_inertia;
        return {i, i, i};
    }
    mat3 body_axes(std::size_t) const { return mat3::identity(); }
    double kinetic_energy(std::size_t b) const {
        const pebble_motion& p = pebbles[b];
        return 0.5 * (norm2(p.v) / p.inverse_mass + norm2(p.w) / p.inverse_inertia);
    }
    reference refer(std::size_t b) const { return {pebbles[b].x}; }
    double displacement(std::size_t b, const reference&, const vec3& from) const { return norm(pebbles[b].x - from); }
    void advance(std::size_t b, const load_sum& load, double h, double damping) {
        pebble_motion& p = pebbles[b];
        losses[b].friction += load.dissipated;
        if (damping == 0.0) {
            p.v += (h * p.inverse_mass) * load.force;
            p.w += (h * p.inverse_inertia) * load.moment;
        } else {
            const vec3 df = damping_force(load.force, p.v, damping);
            const vec3 dm = damping_force(load.moment, p.w, damping);
            const vec3 v = p.v, w = p.w;
            p.v += (h * p.inverse_mass) * (load.force + df);
            p.w += (h * p.inverse_inertia) * (load.moment + dm);
            losses[b].damping -= 0.5 * h * (dot(df, v + p.v) + dot(dm, w + p.w));
        }
        p.x += h * p.v;
    }
    template <class F> void place(std::size_t, F&&) {}
    void shift(std::size_t b, const vec3& by, const vec3& faster) { pebbles[b].x += by, pebbles[b].v += faster; }
    double smallest_mass() const {
        double most = 0.0;
        for (const pebble_motion& p : pebbles) most = std::max(most, p.inverse_mass);
        return 1.0 / most;
    }

    template <class A> void archive(A& a) { a(density, pebbles, losses); }
};

/// What an engine sweeps: `specimen` (clumps, which may break) or `sphere_specimen`.
template <class S>
concept specimen_type = std::movable<S> && requires(S& s, const S& c, std::size_t b, const load_sum& load, vec3 x,
                                                    double h, const typename S::reference& since) {
    { S::turns } -> std::convertible_to<bool>;
    { c.body_count() } -> std::same_as<std::size_t>;
    { c.is_swept(b) } -> std::same_as<bool>;
    { c.body_of(std::int32_t{}) } -> std::same_as<std::size_t>;
    { c.group_of(std::int32_t{}) } -> std::same_as<std::size_t>;
    { c.centre(b) } -> std::convertible_to<vec3>;
    { c.bounding_radius(b) } -> std::same_as<double>;
    { c.pebbles_of(b) } -> std::same_as<index_range>;
    { c.body_mass(b) } -> std::same_as<double>;
    { c.body_inertia(b) } -> std::same_as<vec3>;
    { c.body_axes(b) } -> std::same_as<mat3>;
    { c.kinetic_energy(b) } -> std::same_as<double>;
    { c.refer(b) } -> std::same_as<typename S::reference>;
    { c.displacement(b, since, x) } -> std::same_as<double>;
    s.advance(b, load, h, h);
    s.place(b, [](std::size_t) { return true; });
    s.shift(b, x, x);
};
static_assert(specimen_type<specimen> && specimen_type<sphere_specimen>);

} // namespace clast
