// SPDX-License-Identifier: MIT
// A cell grid for each size of spheres.
#pragma once

#include <clast/searches/detail/cell_rows.hpp>

namespace clast::searches {

/// Levels of spheres that differ by a factor of two in size, each with cells that suit it: for spheres of unlike size.
///
/// Each level is searched as in `cell_grid`, and each pair of levels from the side that promises fewer tests: the time
/// grows like the spheres and their pairs, whatever the ratio of sizes (measured up to 100). Take it where small
/// spheres fill the space between others more than about 4 times as large; for like spheres it is `cell_grid` and a
/// pass over the radii. Idea: Ogarko & Luding 2012, Computer Physics Communications 183, 931.
struct hierarchical_grid {
    std::vector<sphere_pair> pairs(std::span<const sphere> spheres, double margin) const {
        const std::vector<detail::cell_rows> levels = split(spheres, margin);
        std::vector<sphere_pair> found;
        found.reserve(detail::usual_pairs * spheres.size());
        for (std::size_t k = 0; k < levels.size(); ++k) {
            detail::find_among(levels[k], margin, found);
            for (std::size_t l = 0; l < k; ++l) {
                const bool down = cost(levels[l], levels[k], margin) < cost(levels[k], levels[l], margin);
                detail::find_between(levels[down ? l : k], levels[down ? k : l], margin, found);
            }
        }
        detail::sort(found, spheres.size());
        return found;
    }

  private:
    static constexpr int most_levels = 32; ///< the last one holds all that is smaller still

    /// One grid for each level that has spheres, from the largest on. Sizes count with half the margin, below which
    /// smaller cells would find nothing less.
    static std::vector<detail::cell_rows> split(std::span<const sphere> spheres, double margin) {
        const double half = std::max(0.5 * margin, 0.0);
        double widest = 0.0;
        for (const sphere& s : spheres) widest = std::max(widest, s.radius);
        std::array<std::vector<std::int32_t>, most_levels> members;
        for (std::size_t i = 0; i < spheres.size(); ++i)
            members[level((widest + half) / (spheres[i].radius + half))].push_back(static_cast<std::int32_t>(i));
        std::vector<detail::cell_rows> levels;
        for (const auto& m : members)
            if (!m.empty()) levels.emplace_back(spheres, m, margin);
        return levels;
    }
    /// How often a size goes into the largest one, as a power of two.
    static std::size_t level(double ratio) {
        std::size_t k = 0;
        for (; k + 1 < most_levels && ratio >= 2.0; ++k) ratio *= 0.5;
        return k;
    }
    /// Estimate of the work to search in the cells of `b` for each sphere of `a`.
    static double cost(const detail::cell_rows& a, const detail::cell_rows& b, double margin) {
        return static_cast<double>(a.size()) * b.cost(a.widest + b.widest + margin);
    }
};

} // namespace clast::searches
