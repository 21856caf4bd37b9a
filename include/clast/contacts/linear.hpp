// SPDX-License-Identifier: MIT
// Linear springs with Coulomb friction: the contact of the paper (section 2.3, Table 1).
#pragma once

#include <cmath>

#include <clast/contacts/concepts.hpp>

namespace clast::contacts {

/// Stiffness and friction of one of the two pieces in a contact, as Table 1 of the paper lists them (physics of PFC:
/// each piece has its own values and the contact inherits from both).
struct piece {
    double normal_stiffness; ///< N/m, > 0
    double shear_stiffness;  ///< N/m, >= 0
    double friction;         ///< coefficient, >= 0
};

/// Shear force on i at the end of the last step (N): what contacts with a tangential spring remember.
struct shear_history {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    /// Of the same contact seen from j.
    constexpr shear_history reversed() const { return {-x, -y, -z}; }
};

/// Tangential spring with a slider: turns the shear force of the last step into the new contact plane and by the spin
/// (rad, small against 1), keeping its size, adds -k_s u and cuts it at `limit` (N, >= 0). Answers with the shear force
/// and the work of the mean shear force on the slip (trial - F) / k_s; `fn` (N, compression positive) is added along
/// the normal.
template <class T>
[[gnu::always_inline]] inline response<T> tangential_spring(const overlap<T>& o, const motion<T>& m, shear_history& h,
                                                            T fn, T ks, T limit) {
    using std::sqrt;
    T sx = h.x, sy = h.y, sz = h.z;
    turn_with(o, m, sx, sy, sz);
    // spring, then slider
    const T px = sx - ks * m.ux, py = sy - ks * m.uy, pz = sz - ks * m.uz;
    const T trial = sqrt(px * px + py * py + pz * pz);
    const T cut = trial > limit ? limit / trial : T(1.0);
    h.x = cut * px, h.y = cut * py, h.z = cut * pz;
    const T half_compliance = ks > 0.0 ? 0.5 / ks : T(0.0);
    const T slip = half_compliance * ((sx + h.x) * (px - h.x) + (sy + h.y) * (py - h.y) + (sz + h.z) * (pz - h.z));
    return {h.x - fn * o.nx, h.y - fn * o.ny, h.z - fn * o.nz, slip};
}

/// Linear contact with Coulomb friction and an incremental tangential spring.
///
/// F_n = k_n max(overlap, 0). The shear force turns with the contact plane (its size is kept) and with the mean spin
/// about the normal, takes -k_s u for the tangential displacement u of the step, and is cut at mu F_n.
/// Source: Cundall and Strack 1979; Itasca PFC, "Linear model"; series rule k = k1 k2 / (k1 + k2), mu = min(mu1, mu2).
/// The displacement is measured against the normal at mid-step, so that position and velocity belong to the same
/// instant (Vyas et al. 2025, doi:10.1016/j.cpc.2025.109524, on why that matters for unequal sizes).
struct linear {
    double kn = 0.0; ///< normal stiffness of the contact (N/m)
    double ks = 0.0; ///< shear stiffness of the contact (N/m)
    double mu = 0.0; ///< friction coefficient

    using history = shear_history;
    static constexpr bool constant_stiffness = true, uses_masses = false;

    /// Contact of two pieces in series, with the smaller friction.
    static constexpr linear between(const piece& a, const piece& b) {
        const auto series = [](double p, double q) { return p + q > 0.0 ? p * q / (p + q) : 0.0; };
        return {series(a.normal_stiffness, b.normal_stiffness), series(a.shear_stiffness, b.shear_stiffness),
                a.friction < b.friction ? a.friction : b.friction};
    }

    /// Repulsion (N): all there is where nothing rubs.
    template <class T> [[gnu::always_inline]] T normal_force(const overlap<T>& o, const motion<T>&) const {
        return kn * (o.depth > 0.0 ? o.depth : T(0.0));
    }
    template <class T>
    [[gnu::always_inline]] response<T> operator()(const overlap<T>& o, const motion<T>& m, history& h,
                                                  double /*dt*/) const {
        const T fn = normal_force(o, m);
        return tangential_spring(o, m, h, fn, T(ks), mu * fn);
    }

    /// Elastic energy of both springs (J).
    constexpr double stored(const overlap<double>& o, const history& h) const {
        const double d = o.depth > 0.0 ? o.depth : 0.0;
        return 0.5 * kn * d * d + (ks > 0.0 ? 0.5 * (h.x * h.x + h.y * h.y + h.z * h.z) / ks : 0.0);
    }
    constexpr double normal_stiffness(const overlap<double>&) const { return kn; }
    constexpr double shear_stiffness(const overlap<double>&) const { return ks; }
};

} // namespace clast::contacts
