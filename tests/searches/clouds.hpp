// SPDX-License-Identifier: MIT
// Spheres to search among, and the comparison with the double loop.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <clast/core/random.hpp>
#include <clast/searches/brute_force.hpp>

#include <catch.hpp>

namespace clouds {

using clast::random_stream;
using clast::uniform;
using clast::vec3;
using clast::searches::sphere;

/// Number of pairs; fails unless the search names those of the double loop, sorted.
template <class Search> std::size_t compare(const std::vector<sphere>& spheres, double margin) {
    const auto found = Search{}.pairs(spheres, margin);
    REQUIRE(found == clast::searches::brute_force{}.pairs(spheres, margin));
    REQUIRE(std::is_sorted(found.begin(), found.end()));
    return found.size();
}

/// n spheres in a box around `centre`; radii log-uniform between smallest and smallest * ratio.
inline std::vector<sphere> cloud(random_stream& random, std::size_t n, const vec3& centre, const vec3& half,
                                 double smallest, double ratio) {
    std::vector<sphere> s(n);
    for (std::size_t i = 0; i < n; ++i) {
        const vec3 at{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
        s[i] = {centre + scale(half, at), smallest * std::pow(ratio, clast::uniform01(random)),
                static_cast<std::int32_t>(i)};
    }
    return s;
}

/// As many spheres of each size that each size has the same volume: n spheres, largest diameter 1, in a cube that they
/// would fill to 60 % if they did not overlap.
inline std::vector<sphere> graded(random_stream& random, std::size_t n, double ratio) {
    std::vector<sphere> s = cloud(random, n, {}, {1, 1, 1}, 1.0, 1.0);
    double volume = 0.0;
    for (sphere& q : s) {
        const double share = clast::uniform01(random) * (1.0 - std::pow(ratio, -3.0));
        q.radius = 0.5 / ratio / std::cbrt(1.0 - share);
        volume += 4.0 / 3.0 * 3.141592653589793 * q.radius * q.radius * q.radius;
    }
    const double half = 0.5 * std::cbrt(volume / 0.6);
    for (sphere& q : s) q.centre *= half;
    return s;
}

/// side^3 spheres on a cubic lattice.
inline std::vector<sphere> lattice(int side, const vec3& low, const vec3& step, double radius) {
    std::vector<sphere> s;
    for (int z = 0; z < side; ++z)
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                s.push_back(
                    {{low.x + x * step.x, low.y + y * step.y, low.z + z * step.z}, radius, static_cast<int>(s.size())});
    return s;
}

/// Spheres pushed apart from random places until they hardly overlap: dense, phi about 0.62, diameter 1 +-5 %.
inline std::vector<sphere> packing(random_stream& random, std::size_t n) {
    const double half = 0.5 * std::cbrt(static_cast<double>(n) * 0.5236 / 0.64);
    std::vector<sphere> s = cloud(random, n, {}, {half, half, half}, 0.475, 1.1);
    const clast::searches::brute_force search;
    for (int round = 0; round < 100; ++round) {
        std::vector<vec3> push(n);
        for (const auto& [i, j] : search.pairs(s, 0.0)) {
            const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
            const vec3 d = s[b].centre - s[a].centre;
            const double overlap = s[a].radius + s[b].radius - norm(d);
            push[a] -= 0.4 * overlap * unit(d), push[b] += 0.4 * overlap * unit(d);
        }
        for (std::size_t i = 0; i < n; ++i)
            for (int a = 0; a < 3; ++a) s[i].centre[a] = std::clamp(s[i].centre[a] + push[i][a], -half, half);
    }
    return s;
}

} // namespace clouds
