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
    explicit stiffness_sum(const mat3& axes = mat3::identity()) : to_body_(transpose(axes)) {}

    /// Adds a contact with unit normal n (world, either sense), normal and shear stiffness (N/m) and the arm from the
    /// mass centre to the contact point (m, world).
    void add(const vec3& normal, double normal_stiffness, double shear_stiffness, const vec3& arm) {
        const vec3 n = to_body_ * normal;
        const vec3 r = to_body_ * arm;
        const vec3 t = cross(r, n); // turning by the angle a moves the point along n by a . t
        const double extra = normal_stiffness - shear_stiffness;
        translation_ += extra * outer(n, n) + shear_stiffness * mat3::identity();
        rotation_ += extra * outer(t, t) + shear_stiffness * (norm2(r) * mat3::identity() + (-1.0) * outer(r, r));
    }

    /// Adds the rotational stiffness (N m) of a bond about its unit normal n (world): twisting about n, bending across.
    void add_rotation(const vec3& normal, double twist, double bend) {
        const vec3 n = to_body_ * normal;
        rotation_ += (twist - bend) * outer(n, n) + bend * mat3::identity();
    }

    /// Translational stiffness (N/m) and rotational stiffness (N m), both in the body's axes.
    const mat3& translation() const { return translation_; }
    const mat3& rotation() const { return rotation_; }

    /// Usual time step (s) for a mass (kg) and principal moments of inertia (kg m^2); safety in (0, 1]. Infinite
    /// without contacts.
    double time_step(double mass, const vec3& inertia, double safety = 0.8) const {
        const rates k = over(mass, inertia);
        const double largest = std::max(k.translation, k.rotation);
        return largest > 0.0 ? safety / std::sqrt(largest) : std::numeric_limits<double>::infinity();
    }

    /// Largest step (s) that is proven stable, same arguments.
    double critical_step(double mass, const vec3& inertia) const {
        const rates k = over(mass, inertia);
        const double sum = k.translation + k.rotation;
        return sum > 0.0 ? std::sqrt(2.0 / sum) : std::numeric_limits<double>::infinity();
    }

  private:
    struct rates {
        double translation; ///< 1/s^2
        double rotation;    ///< 1/s^2
    };
    rates over(double mass, const vec3& inertia) const {
        const vec3 s{1.0 / std::sqrt(inertia.x), 1.0 / std::sqrt(inertia.y), 1.0 / std::sqrt(inertia.z)};
        mat3 r;
        for (int i = 0; i < 3; ++i) r.row[i] = s[i] * scale(rotation_.row[i], s);
        return {largest_principal(translation_) / mass, largest_principal(r)};
    }

    mat3 to_body_;
    mat3 translation_;
    mat3 rotation_;
};

} // namespace clast
