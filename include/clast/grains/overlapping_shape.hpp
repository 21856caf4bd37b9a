// SPDX-License-Identifier: MIT
// Shapes of pebbles that overlap, for grains that never break.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/core/vector.hpp>
#include <clast/grains/shape.hpp>
#include <clast/grains/union_of_spheres.hpp>

namespace clast {

namespace detail {
/// Volume, mass centre and inertia tensor of the union of pebbles, whose offsets become those from the mass centre.
inline solid union_of(std::vector<shape_pebble>& pebbles) {
    std::vector<union_sphere> spheres;
    for (const shape_pebble& p : pebbles) spheres.push_back({p.offset, p.radius});
    const solid_moments m = moments_of_union(spheres);
    const vec3 centre = m.first / m.volume;
    const mat3 second = m.second + (-m.volume) * outer(centre, centre);
    for (shape_pebble& p : pebbles) p.offset -= centre;
    return {m.volume, centre, trace(second) * mat3::identity() + (-1.0) * second};
}
} // namespace detail

/// What pebbles that overlap amount to.
enum class overlaps : std::uint8_t {
    refuse,   ///< an input_error
    as_union, ///< a solid: what several pebbles cover counts once in volume, mass and inertia
    as_sum    ///< every pebble counts in full, as if none overlapped
};

/// Shape from pebbles that may overlap, for grains that never break: it has no bonds then, and an engine that replaces
/// grains refuses it. Where none overlap by more than 1e-9 d, the same as make_shape. Throws input_error as that does,
/// for overlaps only if it is asked to refuse them.
inline shape overlapping_shape(std::string name, std::vector<shape_pebble> pebbles, overlaps how = overlaps::as_union) {
    detail::check_pebbles(fmt::format("shape '{}'", name), pebbles);
    shape s;
    std::vector<shape_pebble> turned = pebbles;
    const detail::solid sum = detail::sum_of(turned);
    detail::complete(s, std::move(turned), sum);
    for (std::size_t a = 0; a < pebbles.size(); ++a)
        for (std::size_t b = a + 1; b < pebbles.size(); ++b)
            s.overlapping =
                s.overlapping || norm(pebbles[b].offset - pebbles[a].offset) - pebbles[a].radius - pebbles[b].radius <
                                     -2e-9 * s.circumscribed_radius;
    if (!s.overlapping || how == overlaps::refuse) return make_shape(std::move(name), std::move(pebbles));
    s.name = std::move(name);
    if (how == overlaps::as_union) {
        const detail::solid whole = detail::union_of(pebbles);
        s.circumscribed_radius = 0.0;
        detail::complete(s, std::move(pebbles), whole, false);
    }
    return s;
}

} // namespace clast
