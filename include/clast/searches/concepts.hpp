// SPDX-License-Identifier: MIT
// What a neighbour search is: it names every pair of bounding spheres whose gap is below a margin, once.
#pragma once

#include <cmath>
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

namespace detail {
/// Square of the distance of centres below which two spheres are neighbours (m^2); negative, which nothing is below,
/// where even coincident centres are not.
inline double near(double radius_a, double radius_b, double margin) {
    const double reach = radius_a + radius_b + margin;
    return reach * std::abs(reach);
}
/// Squared distances nearer to the limit than this part of it are left to `within_exactly`: far above what rounding
/// makes of them, far below what matters.
inline constexpr double doubt = 1e-12;

/// Decides where the last bits do. Not inline, because compilers fuse multiplications and additions here so and there
/// otherwise: all searches shall agree.
[[gnu::noinline]] inline bool within_exactly(const sphere& a, const sphere& b, double margin) {
    return norm2(b.centre - a.centre) < near(a.radius, b.radius, margin);
}
} // namespace detail

/// True if the gap of two spheres is below the margin: the one predicate that all searches share. A negative margin
/// asks for an overlap. Lengths may be anything whose square is a normal number.
inline bool within(const sphere& a, const sphere& b, double margin) {
    const double far = norm2(b.centre - a.centre), near = detail::near(a.radius, b.radius, margin);
    const bool surely = far < (1.0 - detail::doubt) * near, perhaps = far < (1.0 + detail::doubt) * near;
    return surely == perhaps ? surely : detail::within_exactly(a, b, margin); // no branch that depends on the packing
}

/// S finds all pairs with gap < margin, each once, sorted; the same pairs for every search.
template <class S>
concept search = std::copyable<S> && requires(S s, std::span<const sphere> spheres, double margin) {
    { s.pairs(spheres, margin) } -> std::same_as<std::vector<sphere_pair>>;
};

} // namespace clast::searches
