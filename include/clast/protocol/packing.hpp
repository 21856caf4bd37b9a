// SPDX-License-Identifier: MIT
// A cloud of grains that touch nothing: random places, random orientations.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fmt/core.h>

#include <clast/bodies/clumps.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/random.hpp>

namespace clast::protocol {

/// Vertical cylinder around the z axis (m).
struct cylinder {
    double radius;
    double bottom;
    double top;
};

/// Adds `count` clumps of a shape to the specimen: centres uniform in the cylinder, orientations uniform, no two
/// circumscribed spheres overlapping (random sequential addition; paper section 2.3, Fig. 2). Grains are numbered along
/// z, then by angle, so that neighbours in space are neighbours in memory. The same seed gives the same cloud.
/// Throws input_error if the cylinder cannot take that many (possible up to about 30 % of sphere volume).
inline void add_cloud(bodies::clumps& s, std::int32_t shape_index, std::size_t count, const cylinder& room,
                      std::uint64_t seed) {
    const shape& grain_shape = s.shapes[static_cast<std::size_t>(shape_index)];
    const double rc = grain_shape.circumscribed_radius, apart = 2.0 * rc;
    const double free_radius = room.radius - rc, low = room.bottom + rc, high = room.top - rc;
    const auto too_dense = [&](std::size_t placed) {
        return input_error("number of grains", fmt::format("{}", count),
                           fmt::format("about {} in a cloud of radius {:.3g} m and height {:.3g} m", placed,
                                       room.radius, room.top - room.bottom),
                           "Make the vessel larger or the specimen of fewer grains.");
    };
    if (free_radius <= 0.0 || high <= low) throw too_dense(0);
    // cells of one diameter: a candidate looks at the 27 around it
    const auto cells = [&](double length) {
        return std::max<std::int64_t>(1, static_cast<std::int64_t>(length / apart));
    };
    const std::int64_t nx = cells(2.0 * free_radius), nz = cells(high - low);
    const auto cell = [](double x, double from, double length, std::int64_t n) {
        return std::clamp<std::int64_t>(static_cast<std::int64_t>((x - from) / length * static_cast<double>(n)), 0,
                                        n - 1);
    };
    std::vector<std::vector<vec3>> grid(static_cast<std::size_t>(nx * nx * nz));
    const auto bucket = [&](std::int64_t i, std::int64_t j, std::int64_t k) -> std::vector<vec3>& {
        return grid[static_cast<std::size_t>((k * nx + j) * nx + i)];
    };
    struct placed {
        vec3 centre;
        quaternion q;
        std::int64_t slab; // along z
        double angle;
    };
    std::vector<placed> cloud;
    random_stream random{seed, 0};
    const std::size_t most_tries = 2000 * count + 100000;
    for (std::size_t tries = 0; cloud.size() < count; ++tries) {
        if (tries == most_tries) throw too_dense(cloud.size());
        const vec3 c{free_radius * (2.0 * uniform01(random) - 1.0), free_radius * (2.0 * uniform01(random) - 1.0),
                     low + (high - low) * uniform01(random)};
        if (c.x * c.x + c.y * c.y > free_radius * free_radius) continue;
        const std::int64_t i = cell(c.x, -free_radius, 2.0 * free_radius, nx);
        const std::int64_t j = cell(c.y, -free_radius, 2.0 * free_radius, nx);
        const std::int64_t k = cell(c.z, low, high - low, nz);
        bool free = true;
        for (std::int64_t z = std::max<std::int64_t>(k - 1, 0); free && z <= std::min(k + 1, nz - 1); ++z)
            for (std::int64_t y = std::max<std::int64_t>(j - 1, 0); free && y <= std::min(j + 1, nx - 1); ++y)
                for (std::int64_t x = std::max<std::int64_t>(i - 1, 0); free && x <= std::min(i + 1, nx - 1); ++x)
                    for (const vec3& other : bucket(x, y, z)) free = free && norm2(other - c) > apart * apart;
        if (!free) continue;
        bucket(i, j, k).push_back(c);
        cloud.push_back(
            {c, orientation(random), static_cast<std::int64_t>((c.z - low) / (2.0 * apart)), std::atan2(c.y, c.x)});
    }
    // not std::stable_sort, which takes long to compile
    std::sort(cloud.begin(), cloud.end(), [](const placed& a, const placed& b) {
        return a.slab != b.slab ? a.slab < b.slab : a.angle != b.angle ? a.angle < b.angle : a.centre.z < b.centre.z;
    });
    for (const placed& p : cloud) s.add(shape_index, p.centre, p.q);
}

} // namespace clast::protocol
