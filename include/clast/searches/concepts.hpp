// SPDX-License-Identifier: MIT
// What a neighbour search is: it names every pair of bounding spheres whose gap is below a margin, once.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

#include <clast/core/vector.hpp>

namespace clast::searches {

/// Bounding sphere of a body; `id` is what the search hands back.
struct sphere {
    vec3 centre;
    double radius = 0.0;
    std::int32_t id = -1;
};

/// Indices into the span of spheres, first < second.
struct sphere_pair {
    std::int32_t first;
    std::int32_t second;
    constexpr auto operator<=>(const sphere_pair&) const = default;
};

/// True if the gap of two spheres is below the margin: the one predicate that all searches share. A negative margin
/// asks for an overlap.
inline bool within(const sphere& a, const sphere& b, double margin) {
    const double reach = a.radius + b.radius + margin;
    return reach > 0.0 && norm2(b.centre - a.centre) < reach * reach;
}

/// S finds all pairs with gap < margin, each once, sorted; the same pairs for every search.
template <class S>
concept search = std::copyable<S> && requires(S s, std::span<const sphere> spheres, double margin) {
    { s.pairs(spheres, margin) } -> std::same_as<std::vector<sphere_pair>>;
};

} // namespace clast::searches
