// SPDX-License-Identifier: MIT
// Four corners of a wall that need not lie in one plane, as four triangles around their mean.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <clast/boundaries/plate.hpp>
#include <clast/boundaries/push_out.hpp>
#include <clast/core/vector.hpp>

namespace clast::boundaries {

/// Corners A, B, C, D of a quadrilateral (m): left, right, right above, left above, seen from the axis.
using corners = std::array<vec3, 4>;

/// Their mean and the plane through it that is parallel to both diagonals: A and C lie as far on one side of it as B
/// and D on the other.
struct quadrilateral {
    vec3 middle, normal; ///< normal: inward unit vector of the middle plane
    double bent = 0.0;   ///< distance of the corners from the plane (m)
    double least = 0.0;  ///< of the corners' radii, as an apothem: no point is nearer to the axis along the face (m)

    /// `least` stays 0.
    static quadrilateral of(const corners& c) {
        quadrilateral q;
        q.middle = 0.25 * ((c[0] + c[1]) + (c[2] + c[3]));
        q.normal = unit(cross(c[3] - c[1], c[2] - c[0]));
        q.bent = std::abs(dot(c[0] - q.middle, q.normal));
        return q;
    }
    /// Distance along the normal from the slab that holds all four triangles (m), negative in it and behind it: none of
    /// them is nearer than this.
    double before(const vec3& x) const { return dot(x - middle, normal) - bent; }
};

namespace detail {

using corner_parts = std::array<std::array<double, 4>, 3>;
/// Corners of a quadrilateral's four triangles: two nodes that follow each other, and the mean of all.
inline constexpr std::array<corner_parts, 4> quarter_parts{{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0.25, 0.25, 0.25, 0.25}}},
                                                            {{{0, 1, 0, 0}, {0, 0, 1, 0}, {0.25, 0.25, 0.25, 0.25}}},
                                                            {{{0, 0, 1, 0}, {0, 0, 0, 1}, {0.25, 0.25, 0.25, 0.25}}},
                                                            {{{0, 0, 0, 1}, {1, 0, 0, 0}, {0.25, 0.25, 0.25, 0.25}}}}};
} // namespace detail

/// Inward unit normals of the four triangles; k lies between the corners k and k + 1 and the mean.
using quarter_normals = std::array<vec3, 4>;
inline quarter_normals normals_of_quarters(const corners& c, const vec3& middle) {
    quarter_normals n;
    for (std::size_t k = 0; k < 4; ++k) n[k] = unit(cross(middle - c[k], c[(k + 1) % 4] - c[k]));
    return n;
}

/// Triangle k, with its normal. node: the quadrilateral's nodes, in the order of corners.
inline plate quarter(const corners& c, const vec3& middle, std::size_t k, const vec3& normal,
                     const std::array<std::int32_t, 4>& node) {
    return {c[k], c[(k + 1) % 4], middle, normal, node, &detail::quarter_parts[k]};
}

/// A place in the frame of a quadrilateral's diagonals: x = middle + alpha (C - A) / 2 + beta (D - B) / 2 + what is
/// along the normal, both times `span`. Their signs tell triangles apart, but for `aside`: the diagonals pass the
/// middle at this much on either side.
struct place_among_quarters {
    vec3 a, b; ///< gradients of alpha and beta
    double span, alpha, beta;

    place_among_quarters(const corners& c, const quadrilateral& q, const vec3& x) {
        const vec3 up = 0.5 * (c[2] - c[0]), across = 0.5 * (c[3] - c[1]), d = x - q.middle;
        a = cross(q.normal, across), b = cross(up, q.normal);
        span = dot(up, a); // = dot(across, b)
        alpha = dot(a, d), beta = dot(b, d);
    }
    double aside(const corners& c) const {
        const vec3 w = 0.25 * ((c[0] + c[2]) - (c[1] + c[3]));
        return std::abs(dot(a, w)) + std::abs(dot(b, w));
    }
    /// The triangle that x is over, or next to it.
    std::size_t quarter() const { return beta < 0.0 ? (alpha < 0.0 ? 0 : 1) : (alpha < 0.0 ? 3 : 2); }
};

/// A sphere that rests on the face of a triangle: radius (m) and centre, a corner and the normal of the triangle.
struct resting_sphere {
    vec3 y;
    double r;
    vec3 corner, normal;

    /// Whether it is free of the triangles of a quadrilateral, to r - tolerance. own: which of them it rests on, 4 for
    /// none. Sees at a glance what lies behind the triangle that it rests on or far enough below itself.
    bool is_free_of(const corners& c, const vec3& middle, const quarter_normals& n, std::size_t own,
                    double tolerance) const {
        const vec3 d = y - middle;
        const double level = 0.1 * tolerance, least2 = (r - level) * (r - level);
        const auto behind = [&](const vec3& x) { return dot(x - corner, normal) <= level; };
        for (std::size_t k = 0; k < 4; ++k) {
            const double height = dot(n[k], d);
            if (k == own || height >= r) continue;
            const vec3 &a = c[k], &b = c[(k + 1) % 4];
            // the middle is the nearest point
            if (dot(a - middle, d) <= 0.0 && dot(b - middle, d) <= 0.0 && norm2(d) >= least2) continue;
            if (height >= 0.0 && behind(a) && behind(b) && behind(middle)) continue;
            if (separate(quarter(c, middle, k, n[k], {}), y).distance < r - tolerance) return false;
        }
        return true;
    }
};

} // namespace clast::boundaries
