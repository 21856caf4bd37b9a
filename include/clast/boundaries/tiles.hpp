// SPDX-License-Identifier: MIT
// The tile-based flexible membrane (paper section 2.2, Fig. 3b): every tile moves on its own, so that the specimen can
// bulge and shear. Tiles are joined at their corners to one closed surface (node_rows.hpp).
#pragma once

#include <clast/boundaries/faceted_cylinder.hpp>
#include <clast/boundaries/node_rows.hpp>

namespace clast::boundaries {

/// Lateral wall of joined tiles with two platens: V_sec rows of H_part nodes, each driven on its own by the pressure on
/// its part of the surface. Nothing can slip out between tiles, and nothing rests on ledges.
using tiles = faceted_cylinder<moving_unit::tile, node_rows<>>;

} // namespace clast::boundaries
