// SPDX-License-Identifier: MIT
// Pictures of a finished test, drawn by gnuplot from the result files. The scripts and their data stay in the folder,
// so that a user can change and redraw them: `cd plots && gnuplot stress.gp`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <clast/measure/sample.hpp>

namespace triaxial {

/// The specimen at one instant, as the pictures need it. Lengths in m; the axis of the specimen is x = y = 0.
struct specimen_view {
    double axial_strain = 0.0;
    std::vector<clast::pebble_view> pebbles;
    std::vector<clast::facet_view> facets;
};

/// What is to be drawn.
struct plot_request {
    std::filesystem::path series;                       ///< series.csv
    std::filesystem::path events;                       ///< events.csv
    specimen_view start;                                ///< at the start of shear (empty: not drawn)
    specimen_view end;                                  ///< at the end of shear (empty: not drawn)
    std::vector<std::string> stages{"shear", "unload"}; ///< stages that are drawn against axial strain
    std::vector<std::string> loading{"consolidate"};    ///< stages whose compression curve is drawn
    std::string mark;                                   ///< in the corner of every figure; without quotes
};

/// What was drawn, and what could not be.
struct plot_report {
    std::vector<std::filesystem::path> pictures; ///< .svg and .png
    std::vector<std::string> problems;           ///< sentences for the user; empty when all went well
};

/// Counts of events by azimuth about the specimen axis (paper Figs. 9 and 10, read as positions: physics of the rosette
/// is open in the paper), in equal sectors from 0 anticlockwise.
struct rosette {
    std::vector<std::int64_t> tension;
    std::vector<std::int64_t> shear;

    /// Events in all sectors.
    [[nodiscard]] std::int64_t total() const;
    /// Coefficient of variation of the sector counts beyond that of chance (Poisson): 0 for an even rosette.
    [[nodiscard]] double unevenness() const;
};

/// Sorts events into `sectors` of azimuth.
rosette make_rosette(std::span<const clast::fracture_event> events, int sectors = 36);

/// The lower or upper edge of a ring of facets around a specimen (m).
struct edge_profile {
    double height = 0.0;
    double smallest = 0.0, mean = 0.0,
           largest = 0.0;           ///< distance of the facets' edges, in their middles, from the axis
    double left = 0.0, right = 0.0; ///< smallest and largest x: what a viewer along y sees
};
/// The edges of all rings, from the bottom to the top, each ring's lower and then its upper one.
std::vector<edge_profile> membrane_profile(std::span<const clast::facet_view> facets);

/// Draws all figures into `folder` (created): stress, volume, fractures, compression, membrane, rosette, specimen and
/// section, each as .svg and .png. A figure without data is left out. A missing gnuplot is a problem in the report,
/// not an error; throws run_error where scripts cannot be written and input_error where the tables cannot be read.
plot_report draw_plots(const std::filesystem::path& folder, const plot_request& request);

} // namespace triaxial
