// SPDX-License-Identifier: MIT
// No field.
#pragma once

#include <clast/fields/concepts.hpp>

namespace clast::fields {

/// Bodies feel what touches them and nothing else. Empty: it takes no memory, and no step asks it.
struct none {
    static constexpr bool acts = false;
};

} // namespace clast::fields
