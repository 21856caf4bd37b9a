// SPDX-License-Identifier: MIT
// Grains that never break.
#pragma once

namespace clast::replacements {

/// No replacement: grains stay rigid clumps, and the engine holds no ball, no bond and no criterion.
struct none {
    static constexpr bool replaces = false;
};

} // namespace clast::replacements
