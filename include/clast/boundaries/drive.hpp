// SPDX-License-Identifier: MIT
// How a part of the boundary is driven: held, moved at a speed, or servo-controlled to a stress.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <clast/core/errors.hpp>

namespace clast::boundaries {

/// Drive of one part of a boundary (both platens, or the lateral wall).
struct drive {
    enum class mode { hold, velocity, servo, volume };

    mode how = mode::hold;
    double value = 0.0;     ///< velocity: inward speed of each facet (m/s; a platen moves at half the closing speed).
                            ///< servo: target stress (Pa), compression positive, >= 0
                            ///< volume (lateral walls): what they take from the specimen per second (m^3/s); parts
                            ///< that move on their own share it so that all come to one stress
    double max_speed = 0.0; ///< servo: largest facet speed (m/s), > 0; volume: of what shares the stress
    double gain = 0.5;      ///< servo: share of the force error removed per step, in (0, 1)

    template <class A> void archive(A& a) { a(how, value, max_speed, gain); }
};

/// Drives of the whole boundary.
struct drives {
    drive platens;
    drive lateral;
    /// Of the walls normal to y, where a boundary can drive them apart (box); else and without it they follow lateral.
    std::optional<drive> lateral_y{};

    template <class A> void archive(A& a) { a(platens, lateral, lateral_y); }
};

/// Largest speed (m/s) that a drive may give a facet.
inline double fastest(const drive& d) {
    using mode = drive::mode;
    return d.how == mode::servo || d.how == mode::volume ? d.max_speed
           : d.how == mode::velocity                     ? std::abs(d.value)
                                                         : 0.0;
}
inline double fastest(const drives& d) {
    return std::max({fastest(d.platens), fastest(d.lateral), d.lateral_y ? fastest(*d.lateral_y) : 0.0});
}

/// Throws input_error where a drive makes no sense. `name` says whose drive it is.
inline void check(const drive& d, const char* name) {
    if (!std::isfinite(d.value))
        throw input_error(std::string(name) + ".value", fmt::format("{}", d.value), "finite",
                          "Set the stage's target.");
    if (d.how != drive::mode::servo && d.how != drive::mode::volume) return;
    if (d.how == drive::mode::servo && d.value < 0.0)
        throw input_error(std::string(name) + ".value", fmt::format("{} Pa", d.value), ">= 0 (compression positive)",
                          "A facet cannot pull on grains.");
    if (!(d.max_speed > 0.0))
        throw input_error(std::string(name) + ".max_speed", fmt::format("{} m/s", d.max_speed), "> 0",
                          "Take 6 times the axial strain rate times the specimen radius, or more.");
    if (!(d.gain > 0.0 && d.gain < 1.0))
        throw input_error(std::string(name) + ".gain", fmt::format("{}", d.gain), "between 0 and 1",
                          "0.5 is the default; from 1 on the servo is unstable.");
}

} // namespace clast::boundaries
