// SPDX-License-Identifier: MIT
// The servo of one wall: from the force that it carries and the force that it should carry to a velocity.
#pragma once

#include <algorithm>
#include <cmath>

namespace clast::control {

/// What a servo knows about its wall at one step. Forces are those the wall exerts on grains, positive inward (N).
struct servo {
    double target_force = 0.0;    ///< wanted force = stress times active area (N), >= 0
    double force = 0.0;           ///< force carried now (N), >= 0
    double stiffness = 0.0;       ///< sum of the stiffness of the wall's contacts (N/m), 0 without contact
    double stiffness_floor = 0.0; ///< stiffness of one contact of a pebble with the wall (N/m), > 0
    double dt = 0.0;              ///< time until the next call (s), > 0
    double gain = 0.5;            ///< share of the force error removed per step: 0.25 monotone, 0.5 default, < 1 stable
    double max_speed = 0.0;       ///< limit of the speed (m/s), > 0
};

/// Velocity of the wall, inward positive (m/s): gain (F_target - F) / (max(K, K_floor) dt), limited to +-max_speed.
/// Without contact (stiffness 0) the wall searches inward at max_speed, unless nothing is asked of it (target 0).
/// With a force that is known one step late the error follows z^2 - z + gain = 0 for a wall on its own contacts
/// (spectral radius 0.71 at 0.5, 0.89 at 0.8, unstable from 1); an assembly softer than its contacts only lowers the
/// effective gain. Form: servo of PFC walls (Itasca, "wall servo"), which paper section 2.2 uses.
inline double inward_velocity(const servo& s) {
    if (s.stiffness <= 0.0) return s.target_force > 0.0 ? s.max_speed : 0.0;
    const double wanted = s.gain * (s.target_force - s.force) / (std::max(s.stiffness, s.stiffness_floor) * s.dt);
    return std::clamp(wanted, -s.max_speed, s.max_speed);
}

/// Keeps a servo from jumping to and fro over a solution that is narrower than its step.
///
/// Two tiles in one plane pass a pebble at their seam to each other over a fraction of a micrometre. While it rests on
/// one of them alone neither servo knows of the other: the loaded tile retreats, the free one advances, and in the next
/// step they have changed places, for ever. So where the velocity turns round at its limit the limit is halved, until a
/// step ends in between; while it keeps its sign the limit grows back, by a fifth per step.
struct calm {
    double velocity = 0.0; ///< of the last step (m/s)
    double limit = 0.0;    ///< present limit of the speed (m/s); 0: none yet

    double follow(double wanted, double max_speed) {
        if (!(limit > 0.0)) limit = max_speed;
        const bool turned = wanted * velocity < 0.0;
        if (turned && std::abs(velocity) >= 0.5 * limit)
            limit = std::max(0.5 * limit, 1e-4 * max_speed);
        else if (!turned)
            limit = 1.2 * limit;
        limit = std::min(limit, max_speed);
        return velocity = std::clamp(wanted, -limit, limit);
    }
};

} // namespace clast::control
