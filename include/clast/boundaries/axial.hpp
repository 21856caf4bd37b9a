// SPDX-License-Identifier: MIT
// The axial stress of a specimen as a laboratory reads it off a load cell: a piston loads an end beyond what the cell
// pressure does there.
#pragma once

#include <span>

#include <clast/boundaries/touch.hpp>

namespace clast::boundaries {

// B says the area of each end, `end_section(platen)` (m^2; 0 bottom, 1 top), its `volume()` (m^3) and `height()` (m),
// and its `lateral_stress(loads)` (Pa). Loads are one per facet, of which 0 and 1 are the platens.

/// Mean area of the two ends (m^2).
template <class B> double mean_end(const B& b) {
    return 0.5 * (b.end_section(bottom_platen) + b.end_section(top_platen));
}

/// Deviator stress of the laboratory (Pa, positive in compression): q = (F - sigma_3 A_end) / (V / H), with force and
/// area of one end, in the mean of both ends. A membrane under the pressure sigma_3 passes sigma_3 (A(z) - A_end) along
/// the axis between an end and the section z, so this is the mean over the height of what the grains carry beyond
/// sigma_3; F / (V/H) - sigma_3 is not, once the specimen bulges or the ends differ from its middle.
template <class B> double deviator(const B& b, std::span<const facet_load> loads) {
    const double force = 0.5 * (loads[bottom_platen].force + loads[top_platen].force);
    return (force - b.lateral_stress(loads) * mean_end(b)) * b.height() / b.volume();
}

/// sigma_1 = sigma_3 + q (Pa, positive in compression).
template <class B> double axial_stress(const B& b, std::span<const facet_load> loads) {
    return b.lateral_stress(loads) + deviator(b, loads);
}

/// Force (N, mean of both ends) at which axial_stress() is `stress` (Pa), at the present lateral stress: what a servo
/// of the platens aims at. Where the lateral stress is the same, each end carries it on its own area.
template <class B> double axial_force(const B& b, std::span<const facet_load> loads, double stress) {
    const double lateral = b.lateral_stress(loads);
    return lateral * mean_end(b) + (stress - lateral) * b.volume() / b.height();
}

} // namespace clast::boundaries
