// SPDX-License-Identifier: MIT
// Tiles as solid rectangles with ledges between rings: what tiles.hpp is compared with.
#pragma once

#include <clast/boundaries/faceted_cylinder.hpp>
#include <clast/boundaries/tile_rings.hpp>

namespace clast::boundaries {

/// Lateral wall of independent flat tiles that meet grains as solid steps (push_out.hpp), with two platens. Pair steps:
/// largest_gap up a column, largest_step around a ring; by default both are 2 smallest radii. Its ledges carry grains as
/// shelves do, which a membrane cannot: up to a quarter of the axial load of a test. Take `tiles` to measure strength.
using stepped_tiles = faceted_cylinder<moving_unit::tile, tile_rings<>>;

} // namespace clast::boundaries
