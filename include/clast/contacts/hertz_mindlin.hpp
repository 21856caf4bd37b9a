// SPDX-License-Identifier: MIT
// Elastic spheres after Hertz, with a tangential spring after Mindlin, Coulomb friction and a damper after Tsuji.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include <fmt/core.h>

#include <clast/contacts/concepts.hpp>
#include <clast/core/errors.hpp>

namespace clast::contacts {

/// An isotropic elastic material.
struct elastic {
    double youngs_modulus; ///< E (Pa), > 0
    double poisson_ratio;  ///< nu, above -1 and up to 0.5
    double friction = 0.0; ///< coefficient; a contact has the smaller one of its two materials
};

/// How the tangential force follows a stiffness k_t = 8 G* a that changes with the contact radius a = sqrt(R depth).
/// All three are called Hertz-Mindlin without slip; they differ by up to 12 % in an oblique impact.
enum class tangential : std::uint8_t {
    incremental, ///< dF = k_t dx: what most programs do. Closed paths can gain energy.
    spring,      ///< F = k_t x: unloading along the normal takes force away, and gives it back
    rescaled     ///< incremental, and F falls with a while that shrinks (Thornton et al. 2013): gains nothing
};

/// What a Hertz-Mindlin contact remembers.
struct hertz_history {
    double x = 0.0, y = 0.0, z = 0.0; ///< shear force on i (N); of tangential::spring the displacement (m)
    double depth = 0.0;               ///< of the last step (m)

    /// Of the same contact seen from j.
    constexpr hertz_history reversed() const { return {-x, -y, -z, depth}; }
};

/// Hertz-Mindlin contact, k_n and k_t from the moduli:
///
///     F_n = 4/3 E* sqrt(R) depth^(3/2) + 2 sqrt(5/6) b sqrt(S_n m) v,     S_n = 2 E* sqrt(R depth)
///     k_t = 8 G* sqrt(R depth),   |F_t| <= mu max(F_n, 0)
///
/// 1/E* = sum (1 - nu^2)/E, 1/G* = sum (2 - nu)/G, R and m of the pair; v the speed of approach. The displacement of a
/// step meets the mean of k_t over the time in touch, so that force, stiffness and displacement belong to one instant
/// and the first and last touch cost no order. Sources: Hertz 1882; Mindlin and Deresiewicz 1953; Tsuji et al. 1992,
/// doi:10.1016/0032-5910(92)88030-L; Thornton et al. 2013, doi:10.1016/j.powtec.2012.08.012; on levels of time Vyas et
/// al. 2025, doi:10.1016/j.cpc.2025.109524.
template <tangential Variant = tangential::incremental> struct hertz_mindlin {
    double modulus = 0.0;       ///< E* (Pa), > 0
    double shear_modulus = 0.0; ///< G* (Pa), >= 0; 0: without tangential force
    double mu = 0.0;            ///< friction coefficient, >= 0
    double damping = 0.0;       ///< b of Tsuji's damper, 0 to below 1: damping_for(e), or damping_for_clipped(e)
    bool clipped = false;       ///< a force that would pull, just before separation, is none

    using history = hertz_history;

    /// Contact of two materials. Throws input_error where a modulus or Poisson's ratio is out of range.
    static hertz_mindlin between(const elastic& a, const elastic& b) {
        const auto check = [](const elastic& m) {
            if (!(m.youngs_modulus > 0.0) || !std::isfinite(m.youngs_modulus))
                throw input_error("Young's modulus", fmt::format("{} Pa", m.youngs_modulus), "positive and finite",
                                  "Rock has 1e10 to 1e11 Pa.");
            if (!(m.poisson_ratio > -1.0 && m.poisson_ratio <= 0.5))
                throw input_error("Poisson's ratio", fmt::format("{}", m.poisson_ratio), "above -1 and up to 0.5",
                                  "Rock has 0.2 to 0.3.");
            if (!(m.friction >= 0.0) || !std::isfinite(m.friction))
                throw input_error("friction", fmt::format("{}", m.friction), "0 and more", "Rock has 0.3 to 0.7.");
        };
        check(a), check(b);
        const auto compliance = [](const elastic& m) {
            return (1.0 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
        };
        const auto shear = [](const elastic& m) {
            return (2.0 - m.poisson_ratio) * 2.0 * (1.0 + m.poisson_ratio) / m.youngs_modulus;
        };
        return {1.0 / (compliance(a) + compliance(b)), 1.0 / (shear(a) + shear(b)),
                a.friction < b.friction ? a.friction : b.friction};
    }

    template <class T>
    [[gnu::always_inline]] response<T> operator()(const overlap<T>& o, const motion<T>& m, history& h,
                                                  double dt) const {
        using std::sqrt;
        const T zero(0.0), one(1.0);
        const T d1 = o.depth > 0.0 ? o.depth : zero;
        const T before = o.depth - m.approach * dt, d0 = before > 0.0 ? before : zero;
        const T root_radius = sqrt(o.reduced_radius()), s1 = sqrt(d1), s0 = sqrt(d0);
        // normal
        const T elastic_force = 4.0 / 3.0 * modulus * root_radius * d1 * s1;
        const T slope = 2.0 * modulus * root_radius * s1;
        // 2 sqrt(5/6)
        const T damper = 2.0 * 0.91287092917527685576 * damping * sqrt(slope * o.reduced_mass());
        T fn = elastic_force + damper * m.approach;
        fn = (clipped && fn < 0.0) ? zero : fn;
        const T damped = fn - elastic_force;
        // share of the step in touch, and mean of sqrt(depth) over the step
        const T sum = s1 + s0, opening = o.depth - before;
        const T touching = 2.0 / 3.0 * (d1 + s1 * s0 + d0) / (sum > 0.0 ? sum : one);
        const T share = before > 0.0 ? one : d1 / (opening > 0.0 ? opening : one);
        const T mean_root = before > 0.0 ? touching : 2.0 / 3.0 * s1 * share;
        const T k_end = 8.0 * shear_modulus * root_radius * s1, k_mean = 8.0 * shear_modulus * root_radius * mean_root;
        // tangential: what was, turned into the new plane without a change of size
        T sx = h.x, sy = h.y, sz = h.z;
        turn_with(o, m, sx, sy, sz);
        const T last_root = sqrt(T(h.depth) > 0.0 ? T(h.depth) : zero);
        const T k_last = 8.0 * shear_modulus * root_radius * last_root;
        // forces at the start of the step, and trial ones at its end
        const T to_force = Variant == tangential::spring ? k_last : one;
        const T fx = to_force * sx, fy = to_force * sy, fz = to_force * sz;
        T px, py, pz;
        if constexpr (Variant == tangential::spring) {
            px = k_end * (sx - share * m.ux), py = k_end * (sy - share * m.uy), pz = k_end * (sz - share * m.uz);
        } else {
            // F / a changes by -8 G* dx alone while a shrinks
            const bool rescales = Variant == tangential::rescaled;
            const T shrinks = (rescales && s1 < last_root) ? s1 / last_root : one;
            const T k_step = (rescales && s1 < last_root) ? k_end : k_mean;
            px = shrinks * fx - k_step * m.ux, py = shrinks * fy - k_step * m.uy, pz = shrinks * fz - k_step * m.uz;
        }
        const T limit = mu * (fn > 0.0 ? fn : zero), trial = sqrt(px * px + py * py + pz * pz);
        const T cut = trial > limit ? limit / trial : one;
        const T gx = cut * px, gy = cut * py, gz = cut * pz;
        const T from_force = Variant == tangential::spring ? (k_end > 0.0 ? one / k_end : zero) : one;
        h.x = from_force * gx, h.y = from_force * gy, h.z = from_force * gz, h.depth = d1;
        // work of the mean force, less what the spring holds more than before
        const T work = -0.5 * ((fx + gx) * m.ux + (fy + gy) * m.uy + (fz + gz) * m.uz) * share;
        const T held = 0.5 * (gx * gx + gy * gy + gz * gz) * (k_end > 0.0 ? one / k_end : zero);
        const T was = 0.5 * (fx * fx + fy * fy + fz * fz) * (k_last > 0.0 ? one / k_last : zero);
        return {gx - fn * o.nx, gy - fn * o.ny, gz - fn * o.nz, work - held + was + damped * m.approach * dt};
    }

    /// Elastic energy of both springs (J).
    double stored(const overlap<double>& o, const history& h) const {
        if (!(o.depth > 0.0)) return 0.0;
        const double s = std::sqrt(o.reduced_radius() * o.depth), k = 8.0 * shear_modulus * s;
        const double shear = h.x * h.x + h.y * h.y + h.z * h.z;
        const double tangential_part = Variant == tangential::spring ? 0.5 * k * shear
                                       : k > 0.0                     ? 0.5 * shear / k
                                                                     : 0.0;
        return 8.0 / 15.0 * modulus * s * o.depth * o.depth + tangential_part;
    }
    double normal_stiffness(const overlap<double>& o) const {
        return 2.0 * modulus * std::sqrt(o.reduced_radius() * (o.depth > 0.0 ? o.depth : 0.0));
    }
    double shear_stiffness(const overlap<double>& o) const {
        return 8.0 * shear_modulus * std::sqrt(o.reduced_radius() * (o.depth > 0.0 ? o.depth : 0.0));
    }
};

/// Restitution of a damped normal impact whose force may pull before separation: e = exp(-pi b / sqrt(1 - b^2)), of
/// Tsuji's damper and of a linear dashpot with b = c / (2 sqrt(k m)). b: 0 to below 1.
inline double restitution_of(double damping) {
    return std::exp(-std::numbers::pi * damping / std::sqrt(1.0 - damping * damping));
}
/// The same where the force is never less than 0: the impact ends earlier (Schwager and Poeschel 2007,
/// doi:10.1007/s10035-007-0065-z).
inline double restitution_of_clipped(double damping) {
    const double w = std::sqrt(1.0 - damping * damping);
    return std::exp(-damping / w * (std::numbers::pi - std::atan2(2.0 * damping * w, w * w - damping * damping)));
}
/// Damping b for a restitution that is asked for, e in (0, 1]; the force may pull. Throws input_error out of the range.
inline double damping_for(double restitution) {
    if (!(restitution > 0.0 && restitution <= 1.0))
        throw input_error("restitution", fmt::format("{}", restitution), "above 0, up to 1", "1 is without damping.");
    const double l = std::log(restitution);
    return -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
}
/// Damping b for a restitution where the force is clipped at 0, to rounding. Throws input_error out of the range.
inline double damping_for_clipped(double restitution) {
    double low = 0.0, high = damping_for(restitution); // clipping makes an impact livelier
    while (restitution_of_clipped(high) > restitution) low = high, high = 0.5 * (1.0 + high);
    for (int k = 0; k < 200; ++k) {
        const double middle = 0.5 * (low + high);
        (restitution_of_clipped(middle) > restitution ? low : high) = middle;
    }
    return high;
}

} // namespace clast::contacts
