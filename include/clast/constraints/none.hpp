// SPDX-License-Identifier: MIT
// No constraint.
#pragma once

#include <clast/constraints/concepts.hpp>

namespace clast::constraints {

/// All bodies move by what acts on them. Empty: it takes no memory, and no step asks it.
struct none {
    static constexpr bool acts = false;
    template <class A> void archive(A&) {}
};

} // namespace clast::constraints
