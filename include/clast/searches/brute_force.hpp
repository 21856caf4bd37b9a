// SPDX-License-Identifier: MIT
// The plain double loop: the reference that every other search is compared with.
#pragma once

#include <clast/searches/concepts.hpp>

namespace clast::searches {

/// All pairs by trying all pairs, O(n^2). For tests and for scenes of a few grains.
struct brute_force {
    std::vector<sphere_pair> pairs(std::span<const sphere> spheres, double margin) const {
        std::vector<sphere_pair> found;
        for (std::size_t i = 0; i < spheres.size(); ++i)
            for (std::size_t j = i + 1; j < spheres.size(); ++j)
                if (within(spheres[i], spheres[j], margin))
                    found.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
        return found;
    }
};

} // namespace clast::searches
