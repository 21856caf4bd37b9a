// SPDX-License-Identifier: MIT
// What a test tells a boundary that it wants to be its vessel: plain sizes, whatever the boundary makes of them.
#pragma once

namespace clast::boundaries {

/// Sizes, resolution and stiffness of the vessel of a test around the z axis (SI units). A boundary takes what it has a
/// use for; its `made` says what that is, and refuses what makes no sense for it.
struct vessel_settings {
    double radius = 0.0;                  ///< half width: radius of a cylinder, half side of a square prism (m), > 0
    double bottom = 0.0;                  ///< height of the bottom platen (m)
    double top = 0.0;                     ///< height of the top platen (m), > bottom
    int rings = 36;                       ///< facets over the height, >= 1
    int tiles_per_ring = 20;              ///< facets around the axis
    double smallest_radius = 0.0;         ///< of all pebbles (m), > 0
    double largest_radius = 0.0;          ///< of all pebbles (m), > 0
    double largest_gap = 0.0;             ///< largest step between neighbouring facets that move apart (m), > 0
    double contact_stiffness_floor = 0.0; ///< stiffness of one pebble-wall contact, least K of a servo (N/m), > 0
    double platen_stiffness = 3.2e8;      ///< of the piece (N/m), paper Table 1
    double wall_stiffness = 3.2e6;        ///< of the piece of a membrane (N/m), paper Table 1
    double membrane_stiffness = 0.0;      ///< E t of a sheet that stretches (N/m), >= 0
};

} // namespace clast::boundaries
