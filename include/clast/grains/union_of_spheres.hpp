// SPDX-License-Identifier: MIT
// Volume, mass centre and inertia of what spheres cover together, where they overlap.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <clast/core/vector.hpp>

namespace clast {

/// Moments of a solid of density 1.
struct solid_moments {
    double volume = 0.0; ///< (m^3)
    vec3 first;          ///< integral of x (m^4)
    mat3 second;         ///< integral of x (x) x (m^5)
};

/// A sphere of a union.
struct union_sphere {
    vec3 centre;         ///< (m)
    double radius = 0.0; ///< (m), > 0
};

namespace detail {

/// Integrals over a plane figure: 1, x, y, x^2, y^2, x y.
using plane_moments = std::array<double, 6>;

struct plane_circle {
    double x, y, r;
};

/// Adds the part of an arc of a circle, from one angle to another counter-clockwise, of the boundary integrals that
/// give the moments of the figure inside (Green).
inline void add_arc(const plane_circle& c, double from, double to, plane_moments& m) {
    // by Gauss-Legendre over an eighth of a turn at most: trigonometric polynomials of degree 4, exact to rounding
    static constexpr double node[] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
    static constexpr double weight[] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
    const int parts = static_cast<int>(std::ceil((to - from) / (0.25 * std::numbers::pi)));
    const double half = 0.5 * (to - from) / std::max(parts, 1);
    for (int p = 0; p < parts; ++p)
        for (int k = 0; k < 6; ++k) {
            const double angle = from + (2 * p + 1 + (k % 2 == 0 ? node[k / 2] : -node[k / 2])) * half;
            const double cosine = std::cos(angle), sine = std::sin(angle), w = weight[k / 2] * half * c.r;
            const double x = c.x + c.r * cosine, y = c.y + c.r * sine, dy = w * cosine, dx = -w * sine;
            m[0] += 0.5 * (x * dy - y * dx);
            m[1] += 0.5 * x * x * dy, m[2] -= 0.5 * y * y * dx;
            m[3] += x * x * x * dy / 3.0, m[4] -= y * y * y * dx / 3.0;
            m[5] += 0.5 * x * x * y * dy;
        }
}

/// Moments of what circles cover together: the arcs of each that lie in no other.
inline plane_moments moments_of_circles(const std::vector<plane_circle>& circles) {
    constexpr double turn = 2.0 * std::numbers::pi;
    plane_moments m{};
    std::vector<std::pair<double, double>> covered; // angles, from and to
    for (std::size_t i = 0; i < circles.size(); ++i) {
        const plane_circle& c = circles[i];
        covered.clear();
        bool inside = false;
        for (std::size_t j = 0; j < circles.size() && !inside; ++j) {
            if (i == j) continue;
            const plane_circle& o = circles[j];
            const double dx = o.x - c.x, dy = o.y - c.y, d = std::sqrt(dx * dx + dy * dy);
            if (d >= c.r + o.r || d <= c.r - o.r) {
                inside = d == 0.0 && c.r == o.r && j < i; // the same circle twice counts once
            } else if (d <= o.r - c.r) {
                inside = true;
            } else {
                const double half = std::acos(std::clamp((d * d + c.r * c.r - o.r * o.r) / (2.0 * d * c.r), -1.0, 1.0));
                double from = std::atan2(dy, dx) - half;
                if (from < 0.0) from += turn;
                covered.emplace_back(from, from + 2.0 * half);
                if (from + 2.0 * half > turn) covered.emplace_back(from - turn, from + 2.0 * half - turn);
            }
        }
        if (inside) continue;
        std::sort(covered.begin(), covered.end());
        double at = 0.0;
        for (const auto& [from, to] : covered) {
            if (from > at) add_arc(c, at, std::min(from, turn), m);
            at = std::max(at, to);
        }
        if (at < turn) add_arc(c, at, turn, m);
    }
    return m;
}

/// Integrals over a slab: plane moments, those of z and z^2, of z x and z y.
using slab_moments = std::array<double, 10>;

inline slab_moments at_height(const std::vector<union_sphere>& spheres, double z) {
    std::vector<plane_circle> circles;
    for (const union_sphere& s : spheres) {
        const double h = z - s.centre.z, r2 = s.radius * s.radius - h * h;
        if (r2 > 0.0) circles.push_back({s.centre.x, s.centre.y, std::sqrt(r2)});
    }
    const plane_moments m = moments_of_circles(circles);
    return {m[0], m[1], m[2], m[3], m[4], m[5], z * m[0], z * z * m[0], z * m[1], z * m[2]};
}

/// Adds the integral over heights from a to b by Boole's rule, which is exact for one sphere. Halves until that changes
/// no more than is allowed: figures change smoothly with height but for a few heights at which circles begin to meet.
inline void add_slab(const std::vector<union_sphere>& spheres, double a, double b, const std::array<slab_moments, 3>& f,
                     const slab_moments& allowed, int depth, slab_moments& sum) {
    const double h = b - a, middle = 0.5 * (a + b);
    const slab_moments left = at_height(spheres, 0.5 * (a + middle)), right = at_height(spheres, 0.5 * (middle + b));
    slab_moments best, half = allowed;
    bool good = true;
    for (std::size_t k = 0; k < best.size(); ++k) {
        const double coarse = h / 6.0 * (f[0][k] + 4.0 * f[1][k] + f[2][k]);
        const double fine = h / 12.0 * (f[0][k] + 4.0 * left[k] + 2.0 * f[1][k] + 4.0 * right[k] + f[2][k]);
        best[k] = fine + (fine - coarse) / 15.0;
        good = good && std::abs(fine - coarse) <= allowed[k];
        half[k] *= 0.5;
    }
    if (good || depth == 0) {
        for (std::size_t k = 0; k < best.size(); ++k) sum[k] += best[k];
        return;
    }
    add_slab(spheres, a, middle, {f[0], left, f[1]}, half, depth - 1, sum);
    add_slab(spheres, middle, b, {f[1], right, f[2]}, half, depth - 1, sum);
}

} // namespace detail

/// Moments of the union of spheres, by slices: exact in the plane, adaptive along z, to about 1e-9 of the volume and of
/// the moments of as much volume at the farthest point.
inline solid_moments moments_of_union(const std::vector<union_sphere>& spheres) {
    std::vector<double> heights;
    double volume = 0.0, farthest = 0.0;
    for (const union_sphere& s : spheres) {
        heights.push_back(s.centre.z - s.radius), heights.push_back(s.centre.z + s.radius);
        volume += 4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius;
        farthest = std::max(farthest, norm(s.centre) + s.radius);
    }
    std::sort(heights.begin(), heights.end());
    const double one = 1e-9 * volume, two = farthest * one, three = farthest * two;
    const detail::slab_moments allowed{one, two, two, three, three, three, two, three, three, three};
    detail::slab_moments sum{};
    for (std::size_t k = 1; k < heights.size(); ++k) {
        const double a = heights[k - 1], b = heights[k];
        if (!(b > a)) continue;
        detail::add_slab(
            spheres, a, b,
            {detail::at_height(spheres, a), detail::at_height(spheres, 0.5 * (a + b)), detail::at_height(spheres, b)},
            allowed, 20, sum);
    }
    solid_moments m;
    m.volume = sum[0];
    m.first = {sum[1], sum[2], sum[6]};
    m.second = {{{sum[3], sum[5], sum[8]}, {sum[5], sum[4], sum[9]}, {sum[8], sum[9], sum[7]}}};
    return m;
}

} // namespace clast
