// SPDX-License-Identifier: MIT
// A side view of many spheres as a raster picture: parallel projection along +y, hidden surfaces by depth buffer.
// Vector circles would need several elements per pebble; the raster stays small and shows spheres that interpenetrate.
#pragma once

#include <array>
#include <span>
#include <string>

#include <clast/measure/sample.hpp>

namespace triaxial {

/// Red, green, blue, 0 to 255.
using rgb = std::array<double, 3>;

/// What a grain's state looks like in every picture; only what broke is warm, which the colour-blind see, too.
constexpr rgb colour_of(clast::pebble_state s) {
    switch (s) {
    case clast::pebble_state::clump:
        return {201, 184, 156}; // sandstone
    case clast::pebble_state::bonded:
        return {46, 139, 139}; // teal
    default:
        return {214, 81, 46}; // vermilion
    }
}

/// A picture: rows from the bottom to the top, three bytes per pixel.
struct raster {
    int width = 0;
    int height = 0;
    std::string bytes;
};

/// The rectangle of the x-z plane that a picture shows (m).
struct window {
    double x0 = 0.0, x1 = 1.0;
    double z0 = 0.0, z1 = 1.0;
};

/// Draws the pebbles seen along +y; `height` in pixels. The colour says the state, its shade varies a little by grain.
raster render_side(std::span<const clast::pebble_view> pebbles, const window& w, int height);

} // namespace triaxial
