// SPDX-License-Identifier: MIT
// Uniform cells that suit the largest sphere.
#pragma once

#include <numeric>

#include <clast/searches/detail/cell_rows.hpp>

namespace clast::searches {

/// Cell grid over bounding spheres: for spheres of similar size, O(n + pairs).
///
/// Right for any sizes, but cells suit the largest sphere, and small ones that fill the space between large ones crowd
/// in them: there `hierarchical_grid` is faster from a ratio of radii of about 4 on. The number of cells is bounded by
/// a few per sphere, and a few spheres far from all others cost nothing; distant clouds make cells wider and the search
/// slower.
struct cell_grid {
    std::vector<sphere_pair> pairs(std::span<const sphere> spheres, double margin) const {
        std::vector<std::int32_t> all(spheres.size());
        std::iota(all.begin(), all.end(), 0);
        std::vector<sphere_pair> found;
        found.reserve(detail::usual_pairs * spheres.size());
        detail::find_among(detail::cell_rows(spheres, all, margin), margin, found);
        detail::sort(found, spheres.size());
        return found;
    }
};

} // namespace clast::searches
