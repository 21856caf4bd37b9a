// SPDX-License-Identifier: MIT
// Rolling and twisting resistance, added to any other law.
#pragma once

#include <clast/contacts/concepts.hpp>
#include <clast/contacts/linear.hpp>

namespace clast::contacts {

/// Another law with resistance of the contact to rolling and to twisting: a spring and a slider for each,
///
///     M_r = -k_r theta_r,  |M_r| <= eta_r R F_n        M_t = -k_t theta_t,  |M_t| <= eta_t R F_n
///
/// with the relative rotation theta of the two bodies across and along the normal, F_n the repulsion of the other law
/// and R = R_i R_j / (R_i + R_j). The rolling moment turns with the contact plane. Stands for grains that are no
/// spheres: eta_r is a lever arm over R. Source: Iwashita and Oda 1998, doi:10.1061/(ASCE)0733-9399(1998)124:3(285);
/// Luding 2008, doi:10.1007/s10035-008-0099-x; without the dashpot of model C of Ai et al. 2011,
/// doi:10.1016/j.powtec.2010.09.030.
template <contact_law Base> struct rolling : Base {
    double kr = 0.0;    ///< rolling stiffness (N m), >= 0
    double eta_r = 0.0; ///< limit of the rolling moment over R F_n, >= 0
    double kt = 0.0;    ///< twisting stiffness (N m), >= 0
    double eta_t = 0.0; ///< limit of the twisting moment over R F_n, >= 0

    struct history {
        typename Base::history base;
        shear_history roll; ///< rolling moment on i (N m)
        double twist = 0.0; ///< twisting moment on i along the normal (N m)

        /// Of the same contact seen from j: the normal turns round, too, so the twist stays.
        constexpr history reversed() const { return {contacts::reversed(base), roll.reversed(), twist}; }
    };

    template <class T>
    [[gnu::always_inline]] wrench<T> operator()(const overlap<T>& o, const motion<T>& m, history& h, double dt) const {
        const response<T> other = Base::operator()(o, m, h.base, dt);
        const T repulsion = -(other.fx * o.nx + other.fy * o.ny + other.fz * o.nz);
        const T lever = (o.depth > 0.0 && repulsion > 0.0 ? repulsion : T(0.0)) * o.reduced_radius();
        const T twisted = m.rx * o.nx + m.ry * o.ny + m.rz * o.nz;
        motion<T> rolled = m;
        rolled.ux = m.rx - twisted * o.nx, rolled.uy = m.ry - twisted * o.ny, rolled.uz = m.rz - twisted * o.nz;
        const response<T> roll = tangential_spring(o, rolled, h.roll, T(0.0), T(kr), eta_r * lever);
        const T before = h.twist, trial = before - kt * twisted, limit = eta_t * lever;
        h.twist = trial > limit ? limit : trial < -limit ? -limit : trial;
        const T half_compliance = kt > 0.0 ? 0.5 / kt : T(0.0);
        const T slipped = half_compliance * (before + h.twist) * (trial - h.twist);
        wrench<T> all{other, roll.fx + h.twist * o.nx, roll.fy + h.twist * o.ny, roll.fz + h.twist * o.nz};
        all.dissipated += roll.dissipated + slipped;
        return all;
    }

    /// Elastic energy of all springs (J).
    constexpr double stored(const overlap<double>& o, const history& h) const {
        const double roll2 = h.roll.x * h.roll.x + h.roll.y * h.roll.y + h.roll.z * h.roll.z;
        return Base::stored(o, h.base) + (kr > 0.0 ? 0.5 * roll2 / kr : 0.0) +
               (kt > 0.0 ? 0.5 * h.twist * h.twist / kt : 0.0);
    }
    /// Stiffness against rolling and against twisting (N m), for the time step.
    constexpr double rolling_stiffness(const overlap<double>&) const { return kr; }
    constexpr double twisting_stiffness(const overlap<double>&) const { return kt; }
};

} // namespace clast::contacts
