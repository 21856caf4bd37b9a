// SPDX-License-Identifier: MIT
// Images of grains across the faces of a periodic cell: their numbers, and the spheres that a search looks at.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/bodies/contact_list.hpp>
#include <clast/core/vector.hpp>
#include <clast/searches/concepts.hpp>

namespace clast {

/// The 27 images of a periodic cell: number (x+1) + 3 (y+1) + 9 (z+1) for a shift by x, y, z edges of -1, 0 or 1.
constexpr vec3 image_shift(std::size_t image, const vec3& edges) {
    const auto steps = [](std::size_t digit) { return static_cast<double>(digit) - 1.0; };
    return scale(edges, {steps(image % 3), steps(image / 3 % 3), steps(image / 9)});
}

/// Spheres that a search looks at: those of bodies, and behind them images of those near the faces of a periodic cell.
struct search_spheres {
    std::vector<searches::sphere> all; ///< id: body, or for a ball the number of bodies + its pebble
    std::vector<std::uint8_t> image;   ///< of each image (image_shift)

    std::size_t real() const { return all.size() - image.size(); }
    /// Which image of its body a sphere is.
    std::uint8_t image_of(std::size_t sphere) const { return sphere < real() ? no_shift : image[sphere - real()]; }

    /// Adds images of the spheres that are nearer to a face of the cell than `reach` (m): for half of the 26 shifts, so
    /// that each pair is named once.
    void add_images(const vec3& edges, double reach) {
        const auto is_within = [&](const vec3& c, double beyond) {
            return std::abs(c.x) <= 0.5 * edges.x + beyond && std::abs(c.y) <= 0.5 * edges.y + beyond &&
                   std::abs(c.z) <= 0.5 * edges.z + beyond;
        };
        for (std::size_t k = 0, bodies = all.size(); k < bodies; ++k) {
            const searches::sphere own = all[k];
            if (is_within(own.centre, -reach)) continue; // far from every face
            for (std::size_t i = no_shift + 1; i < 27; ++i) {
                const vec3 c = own.centre + image_shift(i, edges);
                if (!is_within(c, reach)) continue;
                all.push_back({c, own.radius, own.id});
                image.push_back(static_cast<std::uint8_t>(i));
            }
        }
    }
};

} // namespace clast
