// SPDX-License-Identifier: MIT
// Drives that depend on the specimen, set anew after every step: a stress that follows others, and a volume that is
// kept.
#pragma once

#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/protocol/stage.hpp>

namespace clast::protocol {

/// Whether a stage has such drives.
inline bool follows(const stage& s) {
    const auto does = [](const axis_drive& a) {
        return a.how == axis_drive::kind::follow || a.how == axis_drive::kind::volume;
    };
    return does(s.axial) || does(s.lateral) || (s.lateral_y && does(*s.lateral_y));
}

/// Sets what the drives d of a stage aim at. now: the specimen after this step; b: its boundary; volume: to be kept
/// (m^3); dt: until the next step (s). What a finite step leaves of the volume, second order in the strain of a step,
/// is made up for in the next one.
template <class B>
void follow(boundaries::drives& d, const stage& s, const stage_view& now, const B& b, double volume, double dt) {
    using mode = boundaries::drive::mode;
    const auto aim = [&now](boundaries::drive& one, const axis_drive& a) {
        if (a.how != axis_drive::kind::follow) return;
        const double target = a.target(now);
        one.value = target < 0.0 ? 0.0 : target; // grains cannot be pulled
    };
    aim(d.platens, s.axial);
    aim(d.lateral, s.lateral);
    if (s.lateral_y) aim(*d.lateral_y, *s.lateral_y);
    if (s.lateral.how != axis_drive::kind::volume) return;
    const double closing = d.platens.how == mode::velocity
                               ? 2.0 * d.platens.value
                               : b.velocity(boundaries::bottom_platen) + b.velocity(boundaries::top_platen);
    d.lateral.value = (b.volume() - volume) / dt - closing * b.volume() / b.height();
}

} // namespace clast::protocol
