// SPDX-License-Identifier: MIT
// Grains that no load breaks.
#pragma once

#include <clast/criteria/concepts.hpp>

namespace clast::criteria {

/// No criterion: the engine looks at no grain. Also for grains that are bonded from the start.
struct none {
    static constexpr bool evaluated = false;
};

} // namespace clast::criteria
