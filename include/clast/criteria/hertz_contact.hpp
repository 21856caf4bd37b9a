// SPDX-License-Identifier: MIT
// Breakage by the mean contact pressure of Hertz: the paper's Eq. 1, as printed and calibrated.
#pragma once

#include <cmath>
#include <numbers>

#include <clast/criteria/concepts.hpp>
#include <clast/criteria/strength.hpp>

namespace clast::criteria {

/// Which radius and modulus enter Eq. 1.
enum class hertz_rule {
    average, ///< r = d/2 and E of the grain: r_avg and E_avg of two equal grains as the paper writes them
    pair,    ///< r' = d/4 and E' = E / (2 (1 - nu^2)): two equal grains; a rigid wall gives the same r'/E'
    contact  ///< r' of the contact behind the largest force, from the engine; E' = E / (2 (1 - nu^2)), twice that at a
             ///< wall, which is taken as rigid
};

/// u = F_max / F_lim with F_lim = [sigma_lim (d/d0)^(-3/m) pi (3 r / (4 E))^(2/3)]^3, paper Eq. 1: the force at which
/// the mean pressure of a Hertz contact reaches a limit (Russell & Muir Wood 2009; Ciantia et al. 2015). At one r/E the
/// limit force grows as d^(-9/m), and scatter of the strength enters to the third power.
///
/// Mind the scale: this limit is a contact pressure of several GPa, while the characteristic strength of the paper's
/// Table 1 is a crushing strength F/d^2 of some 10 MPa. `literal` puts the one for the other as printed, and breaks
/// every grain at its first touch; `calibrated` finds the limit that gives the same force in the crushing test.
struct hertz_contact {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::needs::largest_force | criteria::needs::largest_contact;

    crushing_strength limit_pressure; ///< contact pressure limit sigma_lim at d0 (Pa), with its size effect
    double youngs_modulus;            ///< E of the grain (Pa), positive
    double poisson_ratio;             ///< nu, in (-1, 0.5]
    hertz_rule rule;
    force_of which = force_of::neighbour;

    /// Eq. 1 as printed: the limit pressure is the characteristic strength itself. Throws input_error if E or nu is out
    /// of range.
    static hertz_contact literal(const crushing_strength& strength, double youngs_modulus = 46.8e9,
                                 double poisson_ratio = 0.3, hertz_rule rule = hertz_rule::average) {
        hertz_contact c{strength, youngs_modulus, poisson_ratio, rule, force_of::neighbour};
        c.check();
        return c;
    }

    /// Eq. 1 with the limit pressure that makes the reference contact break at sigma0 d0^2, so that it agrees with the
    /// crushing test. Reference contact: two equal grains of diameter d0; for the rule `contact` give its
    /// r' = r1 r2 / (r1 + r2) (m) if it is one of pebbles (0: r' = d0/4). Throws input_error if E or nu is out of
    /// range.
    static hertz_contact calibrated(const crushing_strength& strength, double youngs_modulus = 46.8e9,
                                    double poisson_ratio = 0.3, hertz_rule rule = hertz_rule::pair,
                                    double reference_radius = 0.0) {
        hertz_contact c{strength, youngs_modulus, poisson_ratio, rule, force_of::neighbour};
        c.check();
        grain_load reference;
        reference.diameter = strength.d0;
        reference.contact_radius = reference_radius > 0.0 ? reference_radius : 0.25 * strength.d0;
        reference.contact_modulus = c.equal_pair_modulus();
        const double crushing_force = strength.sigma0 * strength.d0 * strength.d0;
        c.limit_pressure.sigma0 = std::cbrt(crushing_force) / c.force_root_per_pressure(reference);
        return c;
    }

    /// Force at which the grain breaks (N).
    double limit(const grain_load& load) const {
        const double root = limit_pressure.at(load.diameter, load.strength_factor) * force_root_per_pressure(load);
        return root * root * root;
    }
    double utilisation(const grain_load& load) const { return force(load, which) / limit(load); }

    /// Only the rule `contact` asks for the contact.
    constexpr criteria::needs active_needs() const {
        return rule == hertz_rule::contact ? needs : criteria::needs::largest_force;
    }

  private:
    double equal_pair_modulus() const { return youngs_modulus / (2.0 * (1.0 - poisson_ratio * poisson_ratio)); }

    double modulus_of_contact(const grain_load& load) const {
        if (load.contact_modulus > 0.0) return load.contact_modulus; // who fills the load knows better
        return load.contact_at_wall ? 2.0 * equal_pair_modulus() : equal_pair_modulus();
    }
    /// pi (3 r / (4 E))^(2/3)
    double force_root_per_pressure(const grain_load& load) const {
        const double radius = rule == hertz_rule::average ? 0.5 * load.diameter
                              : rule == hertz_rule::pair  ? 0.25 * load.diameter
                                                          : load.contact_radius;
        const double modulus = rule == hertz_rule::average ? youngs_modulus
                               : rule == hertz_rule::pair  ? equal_pair_modulus()
                                                           : modulus_of_contact(load);
        const double root = std::cbrt(0.75 * radius / modulus);
        return std::numbers::pi * root * root;
    }

    void check() const {
        if (!(youngs_modulus > 0.0) || !std::isfinite(youngs_modulus))
            throw input_error("Young's modulus", fmt::format("{} Pa", youngs_modulus), "positive and finite",
                              "The paper's Table 1 has 46.8 GPa.");
        if (!(poisson_ratio > -1.0 && poisson_ratio <= 0.5))
            throw input_error("Poisson's ratio", fmt::format("{}", poisson_ratio), "above -1 and up to 0.5",
                              "The paper's Table 1 has 0.3.");
    }
};

} // namespace clast::criteria
