// SPDX-License-Identifier: MIT
// The tile-based flexible membrane (paper section 2.2, Fig. 3b): every tile moves on its own, so that the specimen can
// bulge and shear; gap control keeps the membrane closed, up the columns and around the rings.
#pragma once

#include <clast/boundaries/faceted_cylinder.hpp>

namespace clast::boundaries {

/// Lateral wall of independent tiles with two platens. Pair steps: largest_gap up a column, largest_step around a ring;
/// by default both are 2 smallest radii.
using tiles = faceted_cylinder<moving_unit::tile>;

} // namespace clast::boundaries
