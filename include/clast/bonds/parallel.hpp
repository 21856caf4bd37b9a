// SPDX-License-Identifier: MIT
// The linear parallel bond: a disc of cement between two balls that carries force and moment until it fails.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::bonds {

/// What the number "linear parallel bond normal stiffness 9.6e8" of the paper's Table 1 means. Table 1 prints N/m;
/// PFC's own property is a stress per displacement (Pa/m), which would let a bond stretch by 3 cm before it fails; read
/// as a modulus (Pa) the bond is about as soft as a contact.
enum class stiffness_reading : std::uint8_t {
    force,    ///< N/m of the whole bond, as printed (default)
    per_area, ///< Pa/m, multiplied by the bond's area
    modulus   ///< Pa, divided by the distance of the balls and multiplied by the bond's area
};

/// Material of a parallel bond (paper Table 1; equations of Potyondy and Cundall 2004,
/// doi:10.1016/j.ijrmms.2004.09.011, and the Itasca PFC manual, "Linear parallel bond").
struct parallel {
    stiffness_reading reading = stiffness_reading::force;
    double normal_stiffness = 9.6e8;  ///< N/m, Pa/m or Pa by `reading`, > 0
    double shear_stiffness = 4.8e8;   ///< same unit, > 0
    double tensile_strength = 0.3e8;  ///< sigma_t (Pa), > 0
    double cohesion = 0.6e8;          ///< c (Pa), > 0
    double friction_angle = 0.0;      ///< phi_b (rad), in [0, pi/2): tau_c = c - s tan(phi_b), s tension positive
    double radius_multiplier = 1.0;   ///< R_b over the smaller radius, > 0
    double moment_contribution = 1.0; ///< beta in [0, 1]: share of bending and twist in the peripheral stresses
};

/// What one bond of a given pair of balls needs in a loop: force stiffnesses and the coefficients of its stresses.
struct constants {
    double kn;          ///< normal (N/m)
    double ks;          ///< shear (N/m)
    double kt;          ///< twist (N m/rad) = k_s J / A
    double kb;          ///< bending (N m/rad) = k_n I / A
    double per_area;    ///< 1 / A (1/m^2)
    double per_bending; ///< beta R / I (1/m^3)
    double per_twist;   ///< beta R / J (1/m^3)
    double tensile_strength;
    double cohesion;
    double tan_friction;
};

/// Constants of a bond between balls of radii r1 and r2 (m).
inline constants constants_of(const parallel& m, double r1, double r2) {
    const double r = m.radius_multiplier * std::min(r1, r2);
    const double area = std::numbers::pi * r * r;
    const double inertia = 0.25 * area * r * r;
    const auto force_stiffness = [&](double k) {
        switch (m.reading) {
        case stiffness_reading::per_area:
            return k * area;
        case stiffness_reading::modulus:
            return k * area / (r1 + r2);
        default:
            return k;
        }
    };
    const double kn = force_stiffness(m.normal_stiffness), ks = force_stiffness(m.shear_stiffness);
    return {kn,
            ks,
            ks * 0.5 * r * r, // J / A = R^2 / 2
            kn * 0.25 * r * r,
            1.0 / area,
            m.moment_contribution * r / inertia,
            m.moment_contribution * r / (2.0 * inertia),
            m.tensile_strength,
            m.cohesion,
            std::tan(m.friction_angle)};
}

/// Internal force and moment of a bond from ball a to ball b, in world axes. Forces act on a as +, on b as -.
struct state {
    double n = 0.0;  ///< normal force (N), tension positive
    vec3 v;          ///< shear force (N), normal to the bond
    double mt = 0.0; ///< twisting moment (N m)
    vec3 mb;         ///< bending moment (N m), normal to the bond

    template <class A> void archive(A& a) { a(n, v, mt, mb); }
};

/// Force and moments that a bond exerts on its two balls.
struct wrench {
    vec3 force_a;  ///< on a (N); on b the opposite
    vec3 moment_a; ///< on a about its centre (N m)
    vec3 moment_b; ///< on b about its centre (N m)
};

/// Adds the increments of one step: dv, dw are the relative velocity at the bond point and the relative spin (b minus
/// a), n the unit normal from a to b.
inline void stretch(const constants& c, state& s, const vec3& n, const vec3& dv, const vec3& dw, double dt) {
    const double un = dot(dv, n), tn = dot(dw, n);
    s.n += c.kn * dt * un;
    s.v += (c.ks * dt) * (dv - un * n);
    s.mt += c.kt * dt * tn;
    s.mb += (c.kb * dt) * (dw - tn * n);
}

/// Relative velocity at the bond point of two balls, b minus a (m/s).
inline vec3 relative_velocity(const vec3& n, double ra, double rb, const vec3& va, const vec3& wa, const vec3& vb,
                              const vec3& wb) {
    return vb - va - cross(ra * wa + rb * wb, n);
}

/// Force and moments on the balls, with the lever arms from their centres to the bond point.
inline wrench loads(const state& s, const vec3& n, double ra, double rb) {
    const vec3 f = s.n * n + s.v;
    const vec3 m = s.mt * n + s.mb;
    const vec3 nf = cross(n, s.v);
    return {f, m + ra * nf, rb * nf - m};
}

/// Turns shear force and bending moment into the plane of the new normal and with the mean spin about it over dt,
/// keeping their size: turning must not do work.
inline void turn(state& s, const vec3& n, const vec3& mean_spin, double dt) {
    const double angle = dot(mean_spin, n) * dt;
    const auto follow = [&](vec3& a) {
        const double before = norm2(a);
        a = reject(a, n);
        a += angle * cross(n, a);
        const double after = norm2(a);
        if (after > 0.0) a *= std::sqrt(before / after);
    };
    follow(s.v);
    follow(s.mb);
}

/// Peripheral stresses (Pa): sigma tension positive, tau >= 0.
struct stresses {
    double sigma;
    double tau;
};
inline stresses stresses_of(const constants& c, const state& s) {
    return {s.n * c.per_area + norm(s.mb) * c.per_bending, norm(s.v) * c.per_area + std::abs(s.mt) * c.per_twist};
}

/// Failure without a square root, so that it vectorises: the peripheral stresses against tensile strength, and against
/// tau_c = c - s tan(phi_b) with s the mean normal stress (no bending), at most the tensile strength.
struct failure_flags {
    bool tension;
    bool shear;
};
inline failure_flags failing(const constants& c, const state& s) {
    const double mean = s.n * c.per_area;
    const double left = c.tensile_strength - mean; // what bending may still add
    const double bending = norm2(s.mb) * c.per_bending * c.per_bending;
    const double strength = c.cohesion - (mean < c.tensile_strength ? mean : c.tensile_strength) * c.tan_friction;
    const double rest = strength - std::abs(s.mt) * c.per_twist; // what shear may still add
    const double shear = norm2(s.v) * c.per_area * c.per_area;
    return {left <= 0.0 || bending >= left * left, rest <= 0.0 || shear >= rest * rest};
}

/// Utilisation: the larger of sigma/sigma_t and tau/tau_c; a bond fails at 1.
inline double utilisation(const constants& c, const state& s) {
    const stresses t = stresses_of(c, s);
    const double strength = c.cohesion - std::min(s.n * c.per_area, c.tensile_strength) * c.tan_friction;
    return std::max(t.sigma / c.tensile_strength, strength > 0.0 ? t.tau / strength : 2.0);
}

/// Elastic energy stored in a bond (J).
inline double energy(const constants& c, const state& s) {
    return 0.5 * (s.n * s.n / c.kn + norm2(s.v) / c.ks + s.mt * s.mt / c.kt + norm2(s.mb) / c.kb);
}

} // namespace clast::bonds
