// SPDX-License-Identifier: MIT
// Stable time step of one body from the stiffness of its contacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <clast/core/symmetric.hpp>
#include <clast/core/vector.hpp>

namespace clast {

/// Stiffness that a body feels when all others stand still: adds up contacts, and answers with a time step. The
/// smallest step over all bodies is the step of the specimen.
///
/// With k_t the largest principal value of the translational stiffness over the mass, and k_r that of the rotational
/// stiffness over the moments of inertia (1/s^2):
/// - `time_step`     = safety * min(1 / sqrt(k_t), 1 / sqrt(k_r)), the usual estimate (PFC; paper silent), safety 0.8;
/// - `critical_step` = sqrt(2 / (k_t + k_r)), a proven lower bound of the true limit of leapfrog for any network of
/// linear
///   contacts at the present geometry: the energy of a contact, k (a - b)^2 / 2, is at most k (a^2 + b^2), so that
///   omega_max^2 <= 2 (k_t + k_r). Since k_t + k_r <= 2 max(k_t, k_r), time_step with safety <= 1 is below it.
///
/// Principal values, not diagonal terms: one contact along (1, 1, 1) would show a third of its stiffness on the
/// diagonal. True limits in sqrt(m/k), and 1 / sqrt(k_t) or 1 / sqrt(k_r) beside them: a ball on a wall 2 (1); two free
/// balls sqrt 2 (1); an infinite chain 1 (1/sqrt 2); infinite simple cubic without shear stiffness 1 (1/sqrt 2), FCC
/// sqrt(1/2) (1/2); with k_s = k_n and rotation, solid balls: simple cubic sqrt(1/5) (sqrt(1/10)), FCC sqrt(1/10)
/// (sqrt(1/20)). Not covered: contacts that close before the next estimate, dashpots, and accuracy.
class stiffness_sum {
  public:
    /// `axes`: columns are the body's principal axes in the world frame, matrix(q).
    explicit stiffness_sum(const mat3& axes = mat3::identity()) : axes_(axes) {}

    /// Adds a contact with unit normal n (world, either sense), normal and shear stiffness (N/m) and the arm from the
    /// mass centre to the contact point (m, world).
    void add(const vec3& normal, double normal_stiffness, double shear_stiffness, const vec3& arm) {
        const vec3 t = cross(arm, normal); // turning by the angle a moves the point along n by a . t
        const double extra = normal_stiffness - shear_stiffness;
        translation_.add(extra, normal, shear_stiffness);
        rotation_.add(extra, t, shear_stiffness * norm2(arm));
        rotation_.add(-shear_stiffness, arm, 0.0);
    }

    /// Adds the rotational stiffness (N m) of a bond about its unit normal n (world): twisting about n, bending across.
    void add_rotation(const vec3& normal, double twist, double bend) { rotation_.add(twist - bend, normal, bend); }

    /// Translational stiffness (N/m) and rotational stiffness (N m), both in the body's axes.
    mat3 translation() const { return in_body(translation_); }
    mat3 rotation() const { return in_body(rotation_); }

    /// Usual time step (s) for a mass (kg) and principal moments of inertia (kg m^2); safety in (0, 1]. Infinite
    /// without contacts. For those who look for the smallest step of many bodies: answers `enough`, at less cost, where
    /// a bound shows that the step is not smaller.
    double time_step(double mass, const vec3& inertia, double safety = 0.8,
                     double enough = std::numeric_limits<double>::infinity()) const {
        const symmetric_invariants t = invariants(translation_.full()), r = invariants(per_inertia(inertia));
        const double bound = std::max(largest_principal_bound(t) / mass, largest_principal_bound(r));
        if (safety >= enough * std::sqrt(std::max(bound, 0.0))) return enough;
        const double largest = std::max(largest_principal(t) / mass, largest_principal(r));
        return largest > 0.0 ? std::min(enough, safety / std::sqrt(largest)) : enough;
    }

    /// Largest step (s) that is proven stable, same arguments.
    double critical_step(double mass, const vec3& inertia) const {
        const double sum = largest_principal(translation_.full()) / mass + largest_principal(per_inertia(inertia));
        return sum > 0.0 ? std::sqrt(2.0 / sum) : std::numeric_limits<double>::infinity();
    }

  private:
    struct tensor {
        double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;

        /// Adds a (v x v) + b I.
        void add(double a, const vec3& v, double b) {
            xx += a * v.x * v.x + b, yy += a * v.y * v.y + b, zz += a * v.z * v.z + b;
            xy += a * v.x * v.y, xz += a * v.x * v.z, yz += a * v.y * v.z;
        }
        mat3 full() const { return {{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}}; }
    };
    mat3 in_body(const tensor& world) const {
        const mat3 full = world.full(), axes = transpose(axes_); // its rows are the axes
        const vec3 along[] = {full * axes.row[0], full * axes.row[1], full * axes.row[2]};
        mat3 m;
        for (int i = 0; i < 3; ++i)
            m.row[i] = {dot(axes.row[i], along[0]), dot(axes.row[i], along[1]), dot(axes.row[i], along[2])};
        return m;
    }
    mat3 per_inertia(const vec3& inertia) const {
        const mat3 k = in_body(rotation_);
        const vec3 s{1.0 / std::sqrt(inertia.x), 1.0 / std::sqrt(inertia.y), 1.0 / std::sqrt(inertia.z)};
        mat3 r;
        for (int i = 0; i < 3; ++i) r.row[i] = s[i] * scale(k.row[i], s);
        return r;
    }

    mat3 axes_;
    tensor translation_; ///< in the world frame
    tensor rotation_;
};

} // namespace clast
