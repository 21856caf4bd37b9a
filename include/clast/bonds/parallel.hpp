// SPDX-License-Identifier: MIT
// The linear parallel bond: a disc of cement between two balls that carries force and moment until it fails.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <clast/core/lanes.hpp>
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

/// Power of the size of a grain by which the force stiffness of its bonds grows, of a material with a reading.
constexpr int stiffness_power(stiffness_reading reading) {
    return reading == stiffness_reading::force ? 0 : reading == stiffness_reading::per_area ? 2 : 1;
}

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

/// The same for eight bonds of a kind, or four.
template <several L> struct state_of {
    L n;
    vec3_of<L> v;
    L mt;
    vec3_of<L> mb;
};

/// Force and moments that a bond exerts on its two balls.
template <class Vector> struct basic_wrench {
    Vector force_a;  ///< on a (N); on b the opposite
    Vector moment_a; ///< on a about its centre (N m)
    Vector moment_b; ///< on b about its centre (N m)
};
using wrench = basic_wrench<vec3>;

/// Adds the increments of one step: dv, dw are the relative velocity at the bond point and the relative spin (b minus
/// a), n the unit normal from a to b. For one bond (state, vec3, double) or several of a kind (state_of, vec3_of,
/// lanes).
template <class State, class Vector, class Real>
inline void stretch(const constants& c, State& s, const Vector& n, const Vector& dv, const Vector& dw, const Real& dt) {
    const auto un = dot(dv, n), tn = dot(dw, n);
    s.n += c.kn * dt * un;
    s.v += (c.ks * dt) * (dv - un * n);
    s.mt += c.kt * dt * tn;
    s.mb += (c.kb * dt) * (dw - tn * n);
}

/// Relative velocity at the bond point of two balls, b minus a (m/s); ra and rb: from their centres to that point (m).
template <class Vector>
inline Vector relative_velocity(const Vector& n, double ra, double rb, const Vector& va, const Vector& wa,
                                const Vector& vb, const Vector& wb) {
    return vb - va - cross(ra * wa + rb * wb, n);
}

/// Force and moments on the balls, with the lever arms from their centres to the bond point.
template <class State, class Vector> inline auto loads(const State& s, const Vector& n, double ra, double rb) {
    const Vector f = s.n * n + s.v;
    const Vector m = s.mt * n + s.mb;
    const Vector nf = cross(n, s.v);
    return basic_wrench<Vector>{f, m + ra * nf, rb * nf - m};
}

/// Turns shear force and bending moment into the plane of the new normal and with the mean spin about it over dt,
/// keeping their size: turning must not do work. For one bond or several of a kind.
template <class State, class Vector> inline void turn(State& s, const Vector& n, const Vector& mean_spin, double dt) {
    const auto angle = dot(mean_spin, n) * dt;
    const auto follow = [&](Vector& a) {
        const auto before = norm2(a);
        a = a - dot(a, n) * n;
        a += angle * cross(n, a);
        a = root(ratio(before, norm2(a))) * a;
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

/// How far a bond is beyond its strength, in squares of stress (Pa^2), so that no root is needed; it fails at 0 or
/// above. The peripheral stresses against tensile strength, and against tau_c = c - s tan(phi_b) with s the mean normal
/// stress (no bending), at most the tensile strength.
template <class Real> struct margins {
    Real tension;
    Real shear;
};
/// `factor` scales both strengths: that of one grain over that of its kind.
template <class State, class Real> inline auto margins_of(const constants& c, const State& s, const Real& factor) {
    using real = decltype(s.n * 1.0);
    const real mean = s.n * c.per_area;
    const real none = mean * 0.0;
    const real tensile = c.tensile_strength * factor;
    const real left = larger(tensile - mean, none); // what bending may still add
    const real strength = c.cohesion * factor + larger(-mean, none - tensile) * c.tan_friction;
    const real rest = larger(strength - magnitude(s.mt) * c.per_twist, none); // what shear may still add
    return margins<real>{norm2(s.mb) * (c.per_bending * c.per_bending) - left * left,
                         norm2(s.v) * (c.per_area * c.per_area) - rest * rest};
}

struct failure_flags {
    bool tension;
    bool shear;
};
inline failure_flags failing(const constants& c, const state& s, double factor = 1.0) {
    const margins<double> m = margins_of(c, s, factor);
    return {m.tension >= 0.0, m.shear >= 0.0};
}

/// Utilisation: the larger of sigma/sigma_t and tau/tau_c; a bond fails at 1.
inline double utilisation(const constants& c, const state& s) {
    const stresses t = stresses_of(c, s);
    const double strength = c.cohesion - std::min(s.n * c.per_area, c.tensile_strength) * c.tan_friction;
    return std::max(t.sigma / c.tensile_strength, strength > 0.0 ? t.tau / strength : 2.0);
}

/// Like utilisation(), but proportional to the load also where strength depends on it (phi_b > 0): a bond fails at 1,
/// and at 1/x of its state if this is x.
inline double load_ratio(const constants& c, const state& s) {
    const stresses t = stresses_of(c, s);
    return std::max(t.sigma / c.tensile_strength, (t.tau + s.n * c.per_area * c.tan_friction) / c.cohesion);
}

/// Elastic energy stored in a bond (J).
inline double energy(const constants& c, const state& s) {
    return 0.5 * (s.n * s.n / c.kn + norm2(s.v) / c.ks + s.mt * s.mt / c.kt + norm2(s.mb) / c.kb);
}

} // namespace clast::bonds
