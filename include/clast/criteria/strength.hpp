// SPDX-License-Identifier: MIT
// Strength of grains in the crushing test, its size effect, and the strength classes of the paper.
#pragma once

#include <cmath>
#include <string>

#include <fmt/core.h>

#include <clast/core/errors.hpp>

namespace clast::criteria {

/// Crushing strength F/d^2 of grains between two platens (Jaeger 1967) and its Weibull size effect. The paper (Table 1)
/// gives sigma0 only; d0 = 20 mm is its grain size, and m then matters for other sizes alone.
struct crushing_strength {
    double sigma0; ///< F/d^2 at the diameter d0 (Pa), positive
    double d0;     ///< reference diameter (m), positive
    double m;      ///< Weibull modulus, positive; infinity means no size effect

    /// Throws input_error if a value is not positive, or sigma0 or d0 is not finite.
    explicit crushing_strength(double sigma0_, double d0_ = 0.02, double m_ = 10.0) : sigma0(sigma0_), d0(d0_), m(m_) {
        const auto check = [](const char* option, double value, const char* unit, bool fine, const char* advice) {
            if (!fine) throw input_error(option, fmt::format("{}{}", value, unit), "positive (and finite)", advice);
        };
        check("crushing strength sigma0", sigma0, " Pa", sigma0 > 0.0 && std::isfinite(sigma0),
              "Rockfill has 1e7 to 1e9 Pa; the paper uses 23.2, 43.2 and 350.7 MPa.");
        check("reference diameter d0", d0, " m", d0 > 0.0 && std::isfinite(d0), "The paper's grains have 0.02 m.");
        check("Weibull modulus m", m, "", m > 0.0, "Rock has 3 to 15; infinity switches the size effect off.");
    }

    /// Strength (Pa) of a grain of diameter d (m): sigma0 (d/d0)^(-3/m) times its own scatter factor; paper Eq. 1.
    double at(double diameter, double scatter = 1.0) const {
        return sigma0 * std::pow(diameter / d0, -3.0 / m) * scatter;
    }
};

/// Crushing strength (Pa) of a strength class of the paper's Table 1: weak 23.2, medium 43.2, strong 350.7 MPa. Throws
/// input_error for another name.
inline double strength_of_class(const std::string& name) {
    if (name == "weak") return 23.2e6;
    if (name == "medium") return 43.2e6;
    if (name == "strong") return 350.7e6;
    throw input_error("strength class", name, "weak (23.2 MPa), medium (43.2 MPa), strong (350.7 MPa)",
                      "Or give the crushing strength F/d^2 itself.");
}

} // namespace clast::criteria
