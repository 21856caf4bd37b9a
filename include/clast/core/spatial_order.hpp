// SPDX-License-Identifier: MIT
// An order of points in which neighbours in space are neighbours in memory.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <clast/core/vector.hpp>

namespace clast {

/// Numbers of the points along a Z-order curve through cells of the given edge (m, > 0; about a grain diameter is a
/// good choice): add grains in this order, and a step reads memory that is at hand. The order is kept for the life of a
/// specimen; in a triaxial test neighbours stay neighbours. Points in one cell keep their order. Morton 1966.
inline std::vector<std::size_t> spatial_order(std::span<const vec3> points, double edge) {
    vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
    for (const vec3& p : points)
        for (int a = 0; a < 3; ++a) low[a] = std::min(low[a], p[a]);
    constexpr int bits = 21;
    const auto cell_of = [&](double x) {
        return static_cast<std::uint64_t>(std::min(x / edge, std::ldexp(1.0, bits) - 1.0));
    };
    // every bit moves to three times its place
    const auto spread = [](std::uint64_t x) {
        x = (x | x << 32) & 0x1f00000000ffffULL;
        x = (x | x << 16) & 0x1f0000ff0000ffULL;
        x = (x | x << 8) & 0x100f00f00f00f00fULL;
        x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
        return (x | x << 2) & 0x1249249249249249ULL;
    };
    std::vector<std::uint64_t> code(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        const vec3 c = points[k] - low;
        code[k] = spread(cell_of(c.x)) | spread(cell_of(c.y)) << 1 | spread(cell_of(c.z)) << 2;
    }
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return code[a] < code[b]; });
    return order;
}

} // namespace clast
