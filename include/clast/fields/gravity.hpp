// SPDX-License-Identifier: MIT
// Weight.
#pragma once

#include <clast/core/vector.hpp>
#include <clast/fields/concepts.hpp>

namespace clast::fields {

/// Uniform gravity: a force m g on every body, and the potential -m g . x, which is 0 at the origin.
struct gravity {
    static constexpr bool acts = true;
    vec3 acceleration{0.0, 0.0, -9.81}; ///< g (m/s^2); any direction, 0 is none

    constexpr vec3 force(const body_at& b) const { return b.mass * acceleration; }
    constexpr double potential(const body_at& b) const { return -b.mass * dot(acceleration, b.centre); }
};

} // namespace clast::fields
