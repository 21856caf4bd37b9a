// SPDX-License-Identifier: MIT
// Uniform cells as wide as the largest pair of neighbours may be apart.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <clast/searches/concepts.hpp>

namespace clast::searches {

/// Cell grid over bounding spheres: O(n) for spheres of similar size, right for any size.
///
/// The cell edge is the largest diameter plus the margin, so neighbours sit in adjacent cells. The number of cells is
/// bounded by a few per sphere: a wide cloud makes the cells larger, never the memory unbounded.
struct cell_grid {
    std::vector<sphere_pair> pairs(std::span<const sphere> spheres, double margin) const {
        std::vector<sphere_pair> found;
        const std::size_t n = spheres.size();
        if (n < 2) return found;
        vec3 low = spheres[0].centre, high = low;
        double widest = 0.0;
        for (const sphere& s : spheres) {
            for (int a = 0; a < 3; ++a)
                low[a] = std::min(low[a], s.centre[a]), high[a] = std::max(high[a], s.centre[a]);
            widest = std::max(widest, 2.0 * s.radius);
        }
        // wider than the reach by more than rounding can move a coordinate or an index of up to 1e6, or a pair that
        // just overlaps could be parted by a whole cell
        double edge = std::max((widest + margin) * (1.0 + 1e-9), std::numeric_limits<double>::min());
        for (int a = 0; a < 3; ++a)
            edge += 4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(low[a]), std::abs(high[a]));
        std::array<std::int64_t, 3> cells{};
        const auto count_cells = [&] {
            for (int a = 0; a < 3; ++a)
                cells[static_cast<std::size_t>(a)] =
                    1 + static_cast<std::int64_t>(std::min((high[a] - low[a]) / edge, 1e6));
            return static_cast<double>(cells[0]) * static_cast<double>(cells[1]) * static_cast<double>(cells[2]);
        };
        while (count_cells() > 8.0 * static_cast<double>(n) + 64.0) edge *= 1.5;
        const auto cell_of = [&](const vec3& c) {
            std::array<std::int64_t, 3> i{};
            for (int a = 0; a < 3; ++a) {
                const auto k = static_cast<std::size_t>(a);
                i[k] = std::clamp<std::int64_t>(static_cast<std::int64_t>((c[a] - low[a]) / edge), 0, cells[k] - 1);
            }
            return i;
        };
        const auto index = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
            return static_cast<std::size_t>((z * cells[1] + y) * cells[0] + x);
        };
        // counting sort of the spheres by cell
        std::vector<std::uint32_t> start(index(cells[0] - 1, cells[1] - 1, cells[2] - 1) + 2, 0), order(n);
        std::vector<std::size_t> cell(n);
        for (std::size_t i = 0; i < n; ++i) {
            const auto c = cell_of(spheres[i].centre);
            cell[i] = index(c[0], c[1], c[2]);
            ++start[cell[i] + 1];
        }
        for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
        std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
        for (std::size_t i = 0; i < n; ++i) order[next[cell[i]]++] = static_cast<std::uint32_t>(i);
        // each sphere against the 27 cells around it; j > i names a pair once and in order
        std::vector<std::int32_t> near;
        for (std::size_t i = 0; i < n; ++i) {
            const auto c = cell_of(spheres[i].centre);
            near.clear();
            for (std::int64_t z = std::max<std::int64_t>(c[2] - 1, 0); z <= std::min(c[2] + 1, cells[2] - 1); ++z)
                for (std::int64_t y = std::max<std::int64_t>(c[1] - 1, 0); y <= std::min(c[1] + 1, cells[1] - 1); ++y) {
                    const std::size_t first = index(std::max<std::int64_t>(c[0] - 1, 0), y, z);
                    const std::size_t last = index(std::min(c[0] + 1, cells[0] - 1), y, z);
                    for (std::uint32_t k = start[first]; k < start[last + 1]; ++k)
                        if (order[k] > i && within(spheres[i], spheres[order[k]], margin))
                            near.push_back(static_cast<std::int32_t>(order[k]));
                }
            std::sort(near.begin(), near.end());
            for (std::int32_t j : near) found.push_back({static_cast<std::int32_t>(i), j});
        }
        return found;
    }
};

static_assert(search<cell_grid>);

} // namespace clast::searches
