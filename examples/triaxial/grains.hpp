// SPDX-License-Identifier: MIT
// What the grains of a run are: shapes and their shares, a grading, a packing, and the files that say so.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <clast/grains/mixture.hpp>
#include <clast/protocol/packing.hpp>

#include "options.hpp"

namespace triaxial {

inline constexpr const char* input_folder = "input"; ///< in the folder of results: copies of the files below

/// Files that --shape, --grading, --packing and --from name.
std::vector<std::filesystem::path> input_files(const options& o);

/// The same options with these files in another folder (relative to nothing, or absolute).
options with_files_in(options o, const std::filesystem::path& folder);

/// The mixture that --shape and --grading ask for; pebbles that overlap are a solid where grains never break. Throws
/// input_error by the names of the options.
clast::mixture grains_of(const options& o);

/// Where --packing says that grains start; empty without it. Throws input_error.
clast::protocol::packing packing_of(const options& o, const clast::mixture& grains);

/// Sizes of the grains of the mixture, or of the packing.
clast::grain_sizes sizes_of(const options& o);

/// Fills in the checksums of the files, and throws input_error where tiles, rings or the specimen do not suit the
/// grains.
void check_grains(options& o);

/// Short text for a title or a folder: "4B", "14B+rock graded".
std::string grains_title(const options& o);

/// Lines "name = value" for physics_text.
std::string grains_text(const options& o);

} // namespace triaxial
