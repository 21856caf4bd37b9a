// SPDX-License-Identifier: MIT
// The semi-rigid membrane of the paper (section 2.2, Fig. 3a): vertical strips over the whole height that move in and
// out together, with one velocity from the sum of their forces.
#pragma once

#include <clast/boundaries/faceted_cylinder.hpp>
#include <clast/boundaries/tile_rings.hpp>

namespace clast::boundaries {

/// Lateral wall of strips that move as one, with two platens. `rings` is not used; no gap can open.
using solid_strips = faceted_cylinder<moving_unit::wall, tile_rings<>>;

} // namespace clast::boundaries
