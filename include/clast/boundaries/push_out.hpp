// SPDX-License-Identifier: MIT
// Contact of a sphere with a wall made of steps and corners: the shortest way out.
//
// A force per facet would be doubled at the seam of two coplanar tiles and would jump where a sphere crosses a step.
// Here the wall is one solid: a tile is everything at or behind its plane, between two heights. The force on a sphere
// is k u with u the shortest displacement that frees it from all tiles, i.e. minus the gradient of k |u|^2 / 2: it is
// continuous along any path and conservative, exact for planes, valleys, ledges and edges alike.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <clast/boundaries/touch.hpp>

namespace clast::boundaries {

/// A tile as the specimen feels it: all points with x.n >= apothem (n outward, horizontal) and low <= z <= high. Along
/// its tangent it is unbounded: the tiles of one ring enclose a convex polygon, so that a plane continued beyond its
/// visible part touches no sphere that its neighbours do not stop before.
struct half_slab {
    double nx, ny;    ///< outward unit normal
    double apothem;   ///< (m)
    double low, high; ///< (m), may be infinite
    std::int32_t facet;
};

/// Distance of a point from a half_slab (m) and its gradient, a unit vector away from the slab.
struct separation {
    double distance;
    vec3 normal;
};

/// Over the face the distance is signed along the inward normal, so that a centre that passed the plane is still pushed
/// back in. Above or below the face: distance from the edge, or from the ledge where the point is behind the plane; so
/// nothing is ever pushed outward.
inline separation separate(const half_slab& h, const vec3& x) {
    const double inside = h.apothem - (x.x * h.nx + x.y * h.ny);
    const double dz = x.z < h.low ? x.z - h.low : x.z > h.high ? x.z - h.high : 0.0;
    if (dz == 0.0) return {inside, {-h.nx, -h.ny, 0.0}};
    if (inside <= 0.0) return {std::abs(dz), {0.0, 0.0, dz > 0.0 ? 1.0 : -1.0}};
    const double distance = std::sqrt(inside * inside + dz * dz);
    const double s = inside / distance;
    return {distance, {-s * h.nx, -s * h.ny, dz / distance}};
}

/// Most half_slabs that push_out() looks at.
inline constexpr int max_slabs = 32;

namespace detail {

/// Point of the half-spaces n_j.u >= b_j nearest to the origin, with its multipliers (u = sum lambda_j n_j).
struct nearest_point {
    vec3 u;
    std::array<int, 3> by{};
    std::array<double, 3> lambda{};
    int size = 0;
};

struct half_space {
    vec3 n;
    double b;
};

/// Solves for the point on all planes of the set, and accepts it if it pushes on each of them.
inline bool on_planes(std::span<const half_space> all, std::span<const int> set, nearest_point& out) {
    const auto plane = [&](std::size_t i) -> const half_space& { return all[static_cast<std::size_t>(set[i])]; };
    std::array<double, 3> l{};
    if (set.size() == 1) {
        l[0] = plane(0).b;
    } else if (set.size() == 2) {
        const double g = dot(plane(0).n, plane(1).n);
        const double det = 1.0 - g * g;
        if (det < 1e-14) return false;
        l[0] = (plane(0).b - g * plane(1).b) / det;
        l[1] = (plane(1).b - g * plane(0).b) / det;
    } else {
        const vec3 c12 = cross(plane(1).n, plane(2).n);
        const vec3 c20 = cross(plane(2).n, plane(0).n);
        const vec3 c01 = cross(plane(0).n, plane(1).n);
        const double volume = dot(plane(0).n, c12);
        if (std::abs(volume) < 1e-9) return false;
        const vec3 u = (plane(0).b * c12 + plane(1).b * c20 + plane(2).b * c01) / volume;
        l = {dot(u, c12) / volume, dot(u, c20) / volume, dot(u, c01) / volume};
    }
    nearest_point p;
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (!(l[i] >= 0.0)) return false;
        p.u += l[i] * plane(i).n;
        p.by[i] = set[i];
        p.lambda[i] = l[i];
    }
    p.size = static_cast<int>(set.size());
    out = p;
    return true;
}

/// Projection of the origin on an intersection of half-spaces: adds the most violated one, finds the new active set
/// among it and the old ones (at most three can be active), until none is violated. |u| grows with every addition, so
/// this ends. Stops early, at the best point so far, where the half-spaces exclude each other.
inline nearest_point project(std::span<const half_space> all, double tolerance) {
    nearest_point p;
    for (std::size_t round = 0; round < 4 * all.size(); ++round) {
        int worst = -1;
        double violation = tolerance;
        for (std::size_t j = 0; j < all.size(); ++j) {
            const double v = all[j].b - dot(all[j].n, p.u);
            if (v > violation) violation = v, worst = static_cast<int>(j);
        }
        if (worst < 0) break;
        nearest_point best;
        bool found = false;
        // subsets of the old active ones by bit mask, small ones first; the new one is always in
        constexpr std::array<unsigned, 7> subsets{0, 1, 2, 4, 3, 5, 6};
        for (const unsigned mask : subsets) {
            if (mask >> p.size) continue;
            std::array<int, 3> set{worst};
            std::size_t n = 1;
            for (int i = 0; i < p.size; ++i)
                if (mask >> i & 1U) set[n++] = p.by[static_cast<std::size_t>(i)];
            nearest_point trial;
            if (!on_planes(all, std::span(set).first(n), trial)) continue;
            bool feasible = true;
            for (int i = 0; i < p.size; ++i) {
                const half_space& h = all[static_cast<std::size_t>(p.by[static_cast<std::size_t>(i)])];
                if (dot(h.n, trial.u) < h.b - tolerance) feasible = false;
            }
            if (!feasible) continue;
            best = trial;
            found = true;
            break;
        }
        if (!found) break;
        p = best;
    }
    return p;
}

} // namespace detail

namespace detail {

/// The shortest way out of a solid made of at most Most elements, each with a `separate(element, x)`: calls
/// report(j, normal, depth, u) for every element that pushes, u being the whole way. `u`: a way out of the deepest of
/// them alone, which is left if it will do. Newton's method on the touching conditions.
template <std::size_t Most, class E, class Report>
void way_out(std::span<const E> elements, const vec3& x, double r, std::size_t deepest, const separation& first, vec3 u,
             double tolerance, Report&& report) {
    // No way out is shorter than the deepest overlap, so if it frees the sphere from all it is the shortest.
    bool alone = true;
    for (std::size_t j = 0; j < elements.size() && alone; ++j)
        alone = j == deepest || separate(elements[j], x + u).distance >= r - tolerance;
    if (alone) return report(deepest, first.normal, r - first.distance, u);

    std::array<half_space, Most> planes;
    const auto tangent = std::span(planes).first(elements.size());
    nearest_point p;
    for (int iteration = 0; iteration < 40; ++iteration) {
        for (std::size_t j = 0; j < elements.size(); ++j) {
            const separation s = separate(elements[j], x + u);
            tangent[j] = {s.normal, r - s.distance + dot(s.normal, u)};
        }
        p = project(tangent, 0.1 * tolerance);
        const double change = norm2(p.u - u);
        u = p.u;
        if (change <= tolerance * tolerance) break;
    }
    for (int i = 0; i < p.size; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const auto j = static_cast<std::size_t>(p.by[k]);
        if (p.lambda[k] > 0.0) report(j, planes[j].n, p.lambda[k], u);
    }
}

} // namespace detail

/// Contacts of a sphere with a solid made of half_slabs (at most max_slabs): adds to `out` those facets that push,
/// their normals where the sphere comes free, and their shares of the shortest way out (depth). Exact for the deepest
/// slab alone; otherwise Newton's method on the touching conditions, which converges by a factor of about depth / r or
/// faster. Precision 1e-13 r while depth < r / 2; deeper than that the caller should stop.
inline void push_out(std::span<const half_slab> slabs, const vec3& x, double r, touches& out) {
    std::size_t deepest = slabs.size();
    separation first{r, {}};
    for (std::size_t j = 0; j < slabs.size(); ++j) {
        const separation s = separate(slabs[j], x);
        if (s.distance < first.distance) first = s, deepest = j;
    }
    if (deepest == slabs.size()) return;
    detail::way_out<max_slabs>(slabs, x, r, deepest, first, (r - first.distance) * first.normal, 1e-13 * r,
                               [&](std::size_t j, const vec3& n, double depth, const vec3&) {
                                   const half_slab& h = slabs[j];
                                   out.add({h.facet, n, depth, -(n.x * h.nx + n.y * h.ny)});
                               });
}

} // namespace clast::boundaries
