// SPDX-License-Identifier: MIT
// Small scenes that several tests share: a handful of grains in a toy vessel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/criteria/nominal_force.hpp>
#include <clast/criteria/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/grains/shape.hpp>
#include <clast/protocol/packing.hpp>
#include <clast/replacements/modified.hpp>
#include <clast/replacements/none.hpp>
#include <clast/searches/cell_grid.hpp>

namespace clast::scenes {

template <class Boundary = boundaries::solid_strips> struct unbreakable : triaxial_policies_default {
    using breakage = criteria::none;
    using replacement = replacements::none;
    using boundary = Boundary;
};
template <class Boundary = boundaries::none> struct unbreakable_spheres : unbreakable<Boundary> {
    using body = bodies::spheres;
};
template <class Boundary = boundaries::solid_strips> struct breakable : triaxial_policies_default {
    using boundary = Boundary;
};

/// A law in plain double, whose stiffness depends on the overlap, like that of example 03.
struct hertz {
    double modulus;  // E', 1/E' = sum (1 - nu^2)/E (Pa)
    double mu = 0.0; // friction

    using history = contacts::linear::history;
    using overlap = contacts::overlap<double>;

    contacts::response<double> operator()(const overlap& o, const contacts::motion<double>& m, history& h,
                                          double dt) const {
        if (o.depth <= 0.0) {
            h = {};
            return {};
        }
        return contacts::linear{normal_stiffness(o) / 1.5, shear_stiffness(o), mu}(o, m, h, dt);
    }
    double stored(const overlap& o, const history& h) const {
        if (o.depth <= 0.0) return 0.0;
        const double shear2 = h.x * h.x + h.y * h.y + h.z * h.z;
        return normal_stiffness(o) * o.depth * o.depth / 3.75 + shear2 / (2.0 * shear_stiffness(o));
    }
    double normal_stiffness(const overlap& o) const {
        return 2.0 * modulus * std::sqrt(o.reduced_radius() * std::max(o.depth, 0.0));
    }
    double shear_stiffness(const overlap& o) const { return 0.8 * normal_stiffness(o); }
};

inline constexpr contacts::piece pebble{5.8e6, 2.9e6, 0.3}, platen{3.2e8, 1.6e8, 0.0}, membrane{3.2e6, 1.6e6, 0.0};

/// Of all clumps (N s).
inline vec3 momentum(const bodies::clumps& s) {
    vec3 p;
    for (std::size_t g = 0; g < s.grain_count(); ++g) p += s.mass_of(s.grains[g]) * s.motion[g].v;
    return p;
}

/// A cylinder around the origin (m).
inline boundaries::cylinder_settings cylinder(double radius, double height, double smallest_radius = 4e-3) {
    boundaries::cylinder_settings c;
    c.radius = radius;
    c.bottom = -0.5 * height;
    c.top = 0.5 * height;
    c.rings = 4;
    c.tiles_per_ring = 8;
    c.smallest_radius = smallest_radius;
    c.contact_stiffness_floor = contacts::linear::between(pebble, membrane).kn;
    return c;
}

/// A cylinder whose platens touch the lowest and the highest pebble of a specimen around the origin, or reach into them
/// by `squeeze` (m).
inline boundaries::cylinder_settings cylinder_around(const bodies::clumps& sp, double squeeze = 0.0) {
    double low = 0.0, high = 0.0;
    for (const auto& p : sp.pebbles) {
        low = std::min(low, p.x.z - p.radius);
        high = std::max(high, p.x.z + p.radius);
    }
    boundaries::cylinder_settings c = cylinder(0.05, 0.02);
    c.bottom = low + squeeze, c.top = high - squeeze;
    return c;
}

template <class P>
requires(!P::replacement::replaces) engine_settings<P> settings() {
    return {.grain_contact = contacts::linear::between(pebble, pebble),
            .platen_contact = contacts::linear::between(pebble, platen),
            .lateral_contact = contacts::linear::between(pebble, membrane),
            .breakage = {},
            .replacement = {}};
}
/// Grains of crushing strength sigma0 (Pa) that are replaced by what has no bonds.
template <class P>
requires(P::replacement::replaces &&
         !replacements::makes_bonds<typename P::replacement>()) engine_settings<P> settings(double sigma0) {
    return {.grain_contact = contacts::linear::between(pebble, pebble),
            .platen_contact = contacts::linear::between(pebble, platen),
            .lateral_contact = contacts::linear::between(pebble, membrane),
            .breakage = {criteria::crushing_strength(sigma0)},
            .replacement = {}};
}
/// Grains of crushing strength sigma0 (Pa); `bond_strength` scales both strengths of the bonds of Table 1.
template <class P>
requires(replacements::makes_bonds<typename P::replacement>()) engine_settings<P> settings(double sigma0,
                                                                                           double bond_strength = 1.0) {
    bonds::parallel bond;
    bond.tensile_strength *= bond_strength;
    bond.cohesion *= bond_strength;
    return {.grain_contact = contacts::linear::between(pebble, pebble),
            .platen_contact = contacts::linear::between(pebble, platen),
            .lateral_contact = contacts::linear::between(pebble, membrane),
            .breakage = {criteria::crushing_strength(sigma0)},
            .replacement = {.bond = bond}};
}

/// Turns unit vector a into unit vector b (not opposite ones).
inline quaternion turning(const vec3& a, const vec3& b) {
    const vec3 c = cross(a, b);
    return unit(quaternion{1.0 + dot(a, b), c.x, c.y, c.z});
}

/// A specimen of one shape without grains.
inline bodies::clumps empty(shape s) {
    bodies::clumps sp;
    sp.shapes.push_back(std::move(s));
    return sp;
}

/// Servo control of platens and wall to one stress (Pa).
inline boundaries::drives isotropic(double stress, double max_speed) {
    boundaries::drives d;
    d.platens.how = d.lateral.how = boundaries::drive::mode::servo;
    d.platens.value = d.lateral.value = stress;
    d.platens.max_speed = d.lateral.max_speed = max_speed;
    return d;
}

/// `count` grains of a shape, packed from a cloud in a vessel of the given radius and twice that height by servo
/// control to a stress (Pa). Nothing breaks meanwhile.
template <class P>
engine<P> packed(engine_settings<P> s, const shape& grain, std::size_t count, double radius, double stress,
                 std::int64_t steps, std::uint64_t seed = 1) {
    bodies::clumps sp = empty(grain);
    protocol::add_cloud(sp, 0, count, {radius, -radius, radius}, seed);
    double smallest = grain.circumscribed_radius;
    for (const shape_pebble& p : grain.pebbles) smallest = std::min(smallest, p.radius);
    engine<P> e(std::move(s), std::move(sp), typename P::boundary(cylinder(radius, 2.0 * radius, smallest)));
    e.breakage_on = false;
    e.drives = isotropic(stress, 0.5);
    for (std::int64_t k = 0; k < steps; ++k) e.step();
    return e;
}

/// What an audit cannot explain (J).
template <class P> double residual(const engine<P>& e) {
    const engine_totals& t = e.totals();
    const body_losses lost = e.losses();
    return t.boundary_work + t.initial_energy - e.kinetic_energy() - e.elastic_energy() - lost.friction - lost.damping -
           t.bond_dissipation - e.potential_energy();
}

/// Two tumbling clumps that hit each other off centre, far from any wall.
template <class P>
engine<P> collision(engine_settings<P> s, const shape& grain = shapes::tetrahedron_4(circumscribed(0.02))) {
    bodies::clumps sp = empty(grain);
    sp.add(0, {-0.011, 0.002, 0.001}, unit(quaternion{1.0, 0.3, -0.2, 0.5}));
    sp.add(0, {0.011, -0.003, 0.002}, unit(quaternion{0.4, -0.7, 0.6, 0.1}));
    sp.motion[0].v = {1.0, 0.1, -0.2};
    sp.motion[1].v = {-0.8, 0.3, 0.1};
    sp.turning[0].l = {2e-6, -1e-6, 3e-6};
    sp.turning[1].l = {-1e-6, 4e-6, 1e-6};
    for (std::size_t g = 0; g < 2; ++g)
        sp.motion[g].w = spin_of(sp.turning[g].q, sp.turning[g].l, sp.inverse_inertia(sp.grains[g]));
    return engine<P>(std::move(s), std::move(sp), typename P::boundary(cylinder(0.2, 0.4)));
}

/// A breakable 4B clump with three pebbles on the bottom platen and one under the top platen, pressed to about `force`
/// (N) and at rest. Platens stand still.
template <class P> engine<P> pressed(engine_settings<P> s, double force) {
    bodies::clumps sp = empty(shapes::tetrahedron_4(circumscribed(0.02)));
    sp.add(0, {}, turning(unit(vec3{1, 1, 1}), {0, 0, 1}));
    const boundaries::cylinder_settings c = cylinder_around(sp);
    engine<P> e(std::move(s), std::move(sp), typename P::boundary(c));
    e.breakage_on = false;
    e.drives.platens.how = boundaries::drive::mode::velocity;
    e.drives.platens.value = 2e-3;
    while (e.loads()[boundaries::top_platen].force < force) e.step();
    e.drives.platens.how = boundaries::drive::mode::hold;
    for (int k = 0; k < 3000; ++k) e.step();
    return e;
}
/// Force on the top platen (N).
template <class P> double load(const engine<P>& e) { return e.loads()[boundaries::top_platen].force; }
/// Makes the grains' strength such that the present load of one of them is `utilisation` of it.
template <class P> void set_utilisation(engine<P>& e, double utilisation) {
    e.settings.breakage.strength.sigma0 = load(e) / (utilisation * 0.02 * 0.02);
    e.settings.breakage.strength.d0 = 0.02;
    e.breakage_on = true;
}

/// Place of a pair in a contact list, or its size.
template <class List> std::size_t position(const List& list, const clast::pebble_pair& pair) {
    return static_cast<std::size_t>(std::find(list.pairs.begin(), list.pairs.end(), pair) - list.pairs.begin());
}

} // namespace clast::scenes
