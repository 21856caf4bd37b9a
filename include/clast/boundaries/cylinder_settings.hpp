// SPDX-License-Identifier: MIT
// How large a cylindrical membrane is, of how many tiles, and what sizes make sense.
#pragma once

#include <cmath>
#include <string>

#include <fmt/core.h>

#include <clast/boundaries/polygon.hpp>
#include <clast/boundaries/vessel_settings.hpp>
#include <clast/control/gap_control.hpp>
#include <clast/core/errors.hpp>

namespace clast::boundaries {

/// Size, resolution and stiffness of a cylindrical boundary around the z axis. All members in SI units.
struct cylinder_settings {
    double radius = 0.0;     ///< apothem of every tile at the start: the polygon circumscribes this circle (m), > 0
    double bottom = 0.0;     ///< height of the bottom platen (m)
    double top = 0.0;        ///< height of the top platen (m), > bottom
    int rings = 36;          ///< V_sec of the paper (not used by solid strips), >= 1
    int tiles_per_ring = 20; ///< H_part of the paper, >= 6; below 18 the polygon exceeds the circle by over 1 %
    double platen_stiffness = 3.2e8;      ///< of the piece (N/m), paper Table 1
    double tile_stiffness = 3.2e6;        ///< of the piece (N/m), paper Table 1
    double smallest_radius = 0.0;         ///< of all pebbles (m), > 0
    double largest_gap = 0.0;             ///< largest step between tiles of a column (m); 0: 2 smallest_radius
    double largest_step = 0.0;            ///< largest step between neighbours of a ring (m); 0: largest_gap
    double contact_stiffness_floor = 0.0; ///< stiffness of one pebble-tile contact, least K of the servo (N/m), > 0
    double largest_radius = 0.0;          ///< a tile beyond this apothem has torn the membrane (m); 0: 1.6 radius, of a
                                          ///< joined wall 2.5
    control::gap_rule gaps{};
    double bending = 3.0; ///< of a sheet: its stiffness against kinks (node_rows.hpp), in sigma_3 times the spacing of
                          ///< its rows, >= 0
    double stretching = 0.0; ///< of a sheet: E t of the membrane, its modulus times its thickness (N/m), >= 0
};

/// The same with its defaults filled in. tears_at: default of largest_radius, in radii. Throws input_error, by the name
/// of the member, where one makes no sense.
inline cylinder_settings checked(cylinder_settings s, double tears_at = 1.6) {
    const auto demand = [](bool good, const char* name, double value, const char* allowed, const char* way_out) {
        if (!good)
            throw input_error(std::string("cylinder_settings.") + name, fmt::format("{}", value), allowed, way_out);
    };
    const char* const in_si = "Give the specimen in metres and newtons.";
    demand(s.radius > 0.0 && std::isfinite(s.radius), "radius", s.radius, "> 0 m", in_si);
    demand(s.top > s.bottom, "top", s.top, "above bottom", in_si);
    demand(s.rings >= 1, "rings", s.rings, ">= 1", "The paper uses 12, 24 and 36.");
    demand(s.tiles_per_ring >= 6, "tiles_per_ring", s.tiles_per_ring, ">= 6", "The paper uses 20.");
    demand(s.smallest_radius > 0.0, "smallest_radius", s.smallest_radius, "> 0 m", in_si);
    demand(s.platen_stiffness > 0.0, "platen_stiffness", s.platen_stiffness, "> 0 N/m", in_si);
    demand(s.tile_stiffness > 0.0, "tile_stiffness", s.tile_stiffness, "> 0 N/m", in_si);
    demand(s.contact_stiffness_floor > 0.0, "contact_stiffness_floor", s.contact_stiffness_floor, "> 0 N/m",
           "Take the stiffness of one pebble-tile contact.");
    demand(s.gaps.closing > 0.0 && s.gaps.closing < 1.0, "gaps.closing", s.gaps.closing, "in (0, 1)", "");
    demand(s.gaps.release > 0.0 && s.gaps.release <= 1.0, "gaps.release", s.gaps.release, "in (0, 1]", "");
    demand(s.bending >= 0.0 && std::isfinite(s.bending), "bending", s.bending, ">= 0",
           "0: each node has its own load.");
    demand(s.stretching >= 0.0 && std::isfinite(s.stretching), "stretching", s.stretching, ">= 0 N/m",
           "A rubber membrane of 2 mm has about 3000 N/m; 0: it holds nothing.");
    if (s.largest_gap == 0.0) s.largest_gap = 2.0 * s.smallest_radius;
    demand(s.largest_gap > 0.0, "largest_gap", s.largest_gap, "> 0 m", "0 takes 2 smallest_radius.");
    if (s.largest_step == 0.0) s.largest_step = s.largest_gap;
    demand(s.largest_step > 0.0, "largest_step", s.largest_step, "> 0 m", "0 takes largest_gap.");
    if (s.largest_radius == 0.0) s.largest_radius = tears_at * s.radius;
    demand(s.largest_radius > s.radius, "largest_radius", s.largest_radius, "above radius",
           fmt::format("0 takes {:g} radius.", tears_at).c_str());
    return s;
}

/// A cylinder of the sizes of a test's vessel (SI units).
inline cylinder_settings cylinder_of(const vessel_settings& s) {
    cylinder_settings c;
    c.radius = s.radius;
    c.bottom = s.bottom;
    c.top = s.top;
    c.rings = s.rings;
    c.tiles_per_ring = s.tiles_per_ring;
    c.platen_stiffness = s.platen_stiffness;
    c.tile_stiffness = s.wall_stiffness;
    c.smallest_radius = s.smallest_radius;
    c.largest_gap = s.largest_gap;
    c.contact_stiffness_floor = s.contact_stiffness_floor;
    c.stretching = s.membrane_stiffness;
    return c;
}

namespace detail {

/// Advice on the number of rings.
inline std::string most_rings(const vessel_settings& s) {
    const double height = s.top - s.bottom, pebble = 2.0 * s.smallest_radius;
    int most = static_cast<int>(height / pebble);
    if (most > 0 && height / most < pebble) --most; // by rounding
    return most > 0 ? fmt::format("Take {} rings at most.", most) : "Make the specimen higher.";
}
/// Advice on the number of tiles around the axis.
inline std::string most_around(const vessel_settings& s) {
    int most = s.tiles_per_ring;
    while (most >= 6 && regular_width(most, s.radius) < 2.0 * s.smallest_radius) --most;
    return most >= 6 ? fmt::format("Take {} tiles per ring at most.", most) : "Make the specimen wider.";
}

} // namespace detail

/// Throws input_error, by the names of triaxial_setup, for less than 6 tiles per ring, and for tiles narrower or (where
/// rings move on their own) lower than the smallest pebble.
inline void check_tiles(const vessel_settings& s, bool rings_move) {
    const auto demand = [](bool good, const char* name, int value, const char* allowed, const std::string& way_out) {
        if (!good) throw input_error(name, fmt::format("{}", value), allowed, way_out);
    };
    const double pebble = 2.0 * s.smallest_radius;
    demand(s.tiles_per_ring >= 6, "tiles_per_ring", s.tiles_per_ring, ">= 6", "The paper uses 20.");
    demand(regular_width(s.tiles_per_ring, s.radius) >= pebble, "tiles_per_ring", s.tiles_per_ring,
           "tiles at least as wide as the smallest pebble", detail::most_around(s));
    if (rings_move) {
        demand(s.rings >= 1, "rings", s.rings, ">= 1", "The paper uses 12, 24 and 36.");
        demand((s.top - s.bottom) / s.rings >= pebble, "rings", s.rings,
               "tiles at least as high as the smallest pebble", detail::most_rings(s));
    }
}

} // namespace clast::boundaries
