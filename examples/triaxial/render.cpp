// SPDX-License-Identifier: MIT
#include "render.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <clast/core/vector.hpp>

namespace triaxial {

using clast::pebble_view;
using clast::vec3;

raster render_side(std::span<const pebble_view> pebbles, const window& w, int height) {
    constexpr int fine = 2; // samples per pixel and direction
    constexpr float far = std::numeric_limits<float>::max();
    raster picture;
    picture.height = height;
    picture.width = std::max(1, static_cast<int>(std::lround(height * (w.x1 - w.x0) / (w.z1 - w.z0))));
    const int nx = picture.width * fine;
    const int nz = picture.height * fine;
    const double size = (w.z1 - w.z0) / nz; // of a sample (m)
    const auto at = [nx](int i, int k) {
        return static_cast<std::size_t>(k) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
    };

    std::vector<float> depth(static_cast<std::size_t>(nx) * static_cast<std::size_t>(nz), far);
    std::vector<std::int32_t> seen(depth.size(), -1);
    double mean_radius = 0.0;
    for (std::size_t id = 0; id < pebbles.size(); ++id) {
        const pebble_view& p = pebbles[id];
        if (!is_finite(p.position) || !(p.radius > 0.0)) continue;
        mean_radius += p.radius / static_cast<double>(pebbles.size());
        const auto index = [size](double a) { return static_cast<int>(std::clamp(std::floor(a / size), -1e6, 1e6)); };
        const int i0 = std::max(0, index(p.position.x - p.radius - w.x0)),
                  i1 = std::min(nx - 1, index(p.position.x + p.radius - w.x0));
        const int k0 = std::max(0, index(p.position.z - p.radius - w.z0)),
                  k1 = std::min(nz - 1, index(p.position.z + p.radius - w.z0));
        for (int k = k0; k <= k1; ++k)
            for (int i = i0; i <= i1; ++i) {
                const double dx = w.x0 + (i + 0.5) * size - p.position.x;
                const double dz = w.z0 + (k + 0.5) * size - p.position.z;
                const double h2 = p.radius * p.radius - dx * dx - dz * dz;
                if (h2 <= 0.0) continue;
                const float y = static_cast<float>(p.position.y - std::sqrt(h2));
                if (y < depth[at(i, k)]) {
                    depth[at(i, k)] = y;
                    seen[at(i, k)] = static_cast<std::int32_t>(id);
                }
            }
    }
    if (mean_radius <= 0.0) mean_radius = size;

    // Mean depth of the surroundings from running sums: what lies behind its surroundings is darkened.
    const auto wide = static_cast<std::size_t>(nx) + 1;
    std::vector<double> sum(wide * (static_cast<std::size_t>(nz) + 1), 0.0), count(sum.size(), 0.0);
    for (int k = 0; k < nz; ++k) {
        double row = 0.0, n = 0.0;
        for (int i = 0; i < nx; ++i) {
            if (seen[at(i, k)] >= 0) row += static_cast<double>(depth[at(i, k)]), n += 1.0;
            const std::size_t here = (static_cast<std::size_t>(k) + 1) * wide + static_cast<std::size_t>(i) + 1;
            sum[here] = sum[here - wide] + row;
            count[here] = count[here - wide] + n;
        }
    }
    const int reach = std::max(2, static_cast<int>(2.0 * mean_radius / size));
    const auto box = [&](const std::vector<double>& s, int i, int k) {
        const auto a = static_cast<std::size_t>(std::max(0, i - reach)),
                   b = static_cast<std::size_t>(std::min(nx, i + reach + 1));
        const auto c = static_cast<std::size_t>(std::max(0, k - reach)) * wide,
                   d = static_cast<std::size_t>(std::min(nz, k + reach + 1)) * wide;
        return s[d + b] - s[d + a] - s[c + b] + s[c + a];
    };

    const vec3 light = unit(vec3{-0.5, -0.75, 0.6});
    const auto shade = [&](int i, int k) -> rgb {
        const std::int32_t id = seen[at(i, k)];
        if (id < 0) return {255, 255, 255};
        const pebble_view& p = pebbles[static_cast<std::size_t>(id)];
        const double y = static_cast<double>(depth[at(i, k)]);
        const vec3 n = (1.0 / p.radius) * vec3{w.x0 + (i + 0.5) * size - p.position.x, y - p.position.y,
                                               w.z0 + (k + 0.5) * size - p.position.z};
        double bright = 0.50 + 0.58 * std::max(0.0, dot(n, light));
        const double hidden = (y - box(sum, i, k) / box(count, i, k)) / (4.0 * mean_radius);
        bright *= 1.0 - 0.55 * std::clamp(hidden, -0.12, 1.0);
        // a thin dark line where one grain ends in front of another
        for (const auto& [di, dk] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
            const int a = i + di, b = k + dk;
            if (a < 0 || b < 0 || a >= nx || b >= nz) continue;
            const std::int32_t other = seen[at(a, b)];
            const bool edge = other < 0 || (pebbles[static_cast<std::size_t>(other)].grain != p.grain &&
                                            static_cast<double>(depth[at(a, b)]) > y);
            if (edge) {
                bright *= 0.6;
                break;
            }
        }
        const std::uint32_t hash = (static_cast<std::uint32_t>(p.grain) + 1u) * 2654435761u;
        bright *= 0.93 + 0.14 * ((hash >> 8) & 0xffff) / 65535.0;
        const rgb base = colour_of(p.state);
        return {std::min(255.0, base[0] * bright), std::min(255.0, base[1] * bright),
                std::min(255.0, base[2] * bright)};
    };

    picture.bytes.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 3);
    for (int k = 0; k < picture.height; ++k)
        for (int i = 0; i < picture.width; ++i) {
            rgb mean{};
            for (int b = 0; b < fine; ++b)
                for (int a = 0; a < fine; ++a) {
                    const rgb c = shade(i * fine + a, k * fine + b);
                    for (std::size_t j = 0; j < 3; ++j) mean[j] += c[j] / (fine * fine);
                }
            for (const double c : mean) picture.bytes += static_cast<char>(static_cast<unsigned char>(c + 0.5));
        }
    return picture;
}

} // namespace triaxial
