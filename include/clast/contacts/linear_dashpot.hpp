// SPDX-License-Identifier: MIT
// Linear springs with a dashpot along the normal: what dynamic scenes and other programs use instead of local damping.
#pragma once

#include <clast/contacts/linear.hpp>

namespace clast::contacts {

/// Linear contact with Coulomb friction whose normal spring is damped:
///
///     F_n = k_n depth + gamma m_eff v,   m_eff = m_i m_j / (m_i + m_j),   |F_s| <= mu max(F_n, 0)
///
/// with v the speed of approach and the masses of the two bodies (at a wall m_eff is that of the body). Just before
/// separation F_n may pull, and nothing rubs then. Restitution of a central collision e = exp(-pi gamma / sqrt(4 k_n /
/// m_eff - gamma^2)). Source: Cundall and Strack 1979; Luding 2008, doi:10.1007/s10035-008-0099-x.
struct linear_dashpot {
    double kn = 0.0;    ///< normal stiffness of the contact (N/m)
    double ks = 0.0;    ///< shear stiffness of the contact (N/m)
    double mu = 0.0;    ///< friction coefficient
    double gamma = 0.0; ///< damping rate (1/s), >= 0

    using history = shear_history;
    static constexpr bool constant_stiffness = true;

    /// Force along the normal (N), repulsion positive: all there is where nothing rubs.
    template <class T> [[gnu::always_inline]] T normal_force(const overlap<T>& o, const motion<T>& m) const {
        return o.depth > 0.0 ? kn * o.depth + damper(o, m) : T(0.0);
    }
    template <class T>
    [[gnu::always_inline]] response<T> operator()(const overlap<T>& o, const motion<T>& m, history& h,
                                                  double dt) const {
        const T fn = normal_force(o, m);
        response<T> r = tangential_spring(o, m, h, fn, T(ks), mu * (fn > 0.0 ? fn : T(0.0)));
        r.dissipated += o.depth > 0.0 ? damper(o, m) * m.approach * dt : T(0.0);
        return r;
    }
    /// Elastic energy of both springs (J).
    constexpr double stored(const overlap<double>& o, const history& h) const {
        return linear{kn, ks, mu}.stored(o, h);
    }
    constexpr double normal_stiffness(const overlap<double>&) const { return kn; }
    constexpr double shear_stiffness(const overlap<double>&) const { return ks; }

  private:
    template <class T> [[gnu::always_inline]] T damper(const overlap<T>& o, const motion<T>& m) const {
        return gamma * o.reduced_mass() * m.approach;
    }
};

} // namespace clast::contacts
