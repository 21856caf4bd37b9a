// SPDX-License-Identifier: MIT
// The version of clast; the build system reads it from here, so it is written nowhere else.
#pragma once

#include <string>

namespace clast {

/// Semantic version numbers (semver.org); before 1.0 a new minor version may change the interface.
inline constexpr int version_major = 0;
inline constexpr int version_minor = 1; ///< see version_major
inline constexpr int version_patch = 0; ///< see version_major

/// "major.minor.patch", for the head of output files.
inline std::string version() {
    return std::to_string(version_major) + '.' + std::to_string(version_minor) + '.' + std::to_string(version_patch);
}

} // namespace clast
