// SPDX-License-Identifier: MIT
// A stack of rings, each of one radius: bulges axisymmetrically, cannot shear sideways. Between solid strips and tiles;
// idea: rings of rigid cylinder segments in the literature on DEM triaxial tests.
#pragma once

#include <clast/boundaries/faceted_cylinder.hpp>

namespace clast::boundaries {

/// Lateral wall of rings that move independently, each as one, with two platens. Step limit: 2 smallest radii.
using ring_walls = faceted_cylinder<moving_unit::ring>;

} // namespace clast::boundaries
