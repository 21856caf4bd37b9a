// SPDX-License-Identifier: MIT
// A stack of rings, each of one radius: bulges axisymmetrically, cannot shear sideways. Between solid strips and tiles;
// idea: rings of rigid cylinder segments in the literature on DEM triaxial tests.
#pragma once

#include <clast/boundaries/faceted_cylinder.hpp>
#include <clast/boundaries/node_rows.hpp>

namespace clast::boundaries {

/// Lateral wall of rings that move independently, each as one, with two platens: cones between the rings' middles.
using ring_walls = faceted_cylinder<moving_unit::ring, node_rows<>>;

} // namespace clast::boundaries
