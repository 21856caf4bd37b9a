// SPDX-License-Identifier: MIT
// Contact of a sphere with a wall of triangles: the distance from one, and the shortest way out of all.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <clast/boundaries/push_out.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>

namespace clast::boundaries {

/// A triangle of a wall whose corners hang on the nodes of a quadrilateral.
struct plate {
    vec3 a, b, c; ///< corners (m), seen from the specimen in clockwise order
    vec3 n;       ///< inward unit normal
    /// The quadrilateral's nodes, by the numbers of their facets.
    std::array<std::int32_t, 4> node;
    /// Part of each node in a move of each corner: parts[corner][node]; those of a corner add up to 1.
    const std::array<std::array<double, 4>, 3>* parts;

    /// Sets the normal from the corners.
    void orient() { n = unit(cross(c - a, b - a)); }
};

/// The point of a triangle nearest to x, by its weights: weights[0] a + weights[1] b + weights[2] c.
struct foot {
    std::array<double, 3> weights;
    bool on_face; ///< not on an edge or corner
};

/// After C. Ericson, Real-Time Collision Detection (2005), section 5.1.5.
inline foot foot_on(const plate& t, const vec3& x) {
    const vec3 ab = t.b - t.a, ac = t.c - t.a, ax = x - t.a;
    const double d1 = dot(ab, ax), d2 = dot(ac, ax);
    if (d1 <= 0.0 && d2 <= 0.0) return {{1.0, 0.0, 0.0}, false};
    const vec3 bx = x - t.b;
    const double d3 = dot(ab, bx), d4 = dot(ac, bx);
    if (d3 >= 0.0 && d4 <= d3) return {{0.0, 1.0, 0.0}, false};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double v = d1 / (d1 - d3);
        return {{1.0 - v, v, 0.0}, false};
    }
    const vec3 cx = x - t.c;
    const double d5 = dot(ab, cx), d6 = dot(ac, cx);
    if (d6 >= 0.0 && d5 <= d6) return {{0.0, 0.0, 1.0}, false};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double w = d2 / (d2 - d6);
        return {{1.0 - w, 0.0, w}, false};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {{0.0, 1.0 - w, w}, false};
    }
    const double whole = 1.0 / (va + vb + vc), v = vb * whole, w = vc * whole;
    return {{1.0 - v - w, v, w}, true};
}

/// foot_on() for an x over the inner part of the face, at least this part of the whole from each edge; else all weights
/// are 0.
inline foot foot_inside(const vec3& a, const vec3& b, const vec3& c, const vec3& x, double from_edge) {
    const vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
    const double d1 = dot(ab, ax), d2 = dot(ac, ax), d3 = dot(ab, bx), d4 = dot(ac, bx), d5 = dot(ab, cx),
                 d6 = dot(ac, cx);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    const double least = from_edge * (va + vb + vc);
    if (!(va > least && vb > least && vc > least)) return {{}, false};
    const double whole = 1.0 / (va + vb + vc), v = vb * whole, w = vc * whole;
    return {{1.0 - v - w, v, w}, true};
}

/// Over the face the distance is signed along the inward normal, so that a centre that passed the plane is still pushed
/// back in; beyond an edge it is that from the edge.
inline separation separate(const plate& t, const vec3& x) {
    const foot f = foot_on(t, x);
    if (f.on_face) return {dot(x - t.a, t.n), t.n};
    const vec3 d = x - (f.weights[0] * t.a + f.weights[1] * t.b + f.weights[2] * t.c);
    const double distance = norm(d);
    return {distance, distance > 0.0 ? d / distance : t.n};
}

/// Plates near a sphere, and how far they are: at most 48, the nearest ones.
class plates_near {
  public:
    static constexpr std::size_t most = 48;

    void clear() { size_ = 0; }
    void add(const plate& p, const separation& s) {
        std::size_t at = size_;
        if (size_ == most) {
            at = 0;
            for (std::size_t j = 1; j < most; ++j)
                if (how(j).distance > how(at).distance) at = j;
            if (how(at).distance <= s.distance) return;
        } else
            ++size_;
        std::construct_at(plate_ + at, p), std::construct_at(how_ + at, s);
    }
    std::size_t size() const { return size_; }
    std::span<const plate> plates() const { return {plate_, size_}; }
    const separation& how(std::size_t j) const { return how_[j]; } ///< separate(plates()[j], x)

  private:
    // not set to zero, which would take longer than most spheres need for the rest
    union {
        plate plate_[most];
    };
    union {
        separation how_[most];
    };
    std::size_t size_ = 0;

  public:
    plates_near() {}
};

/// No finer than this part of a radius: normals of neighbouring plates may be nearly parallel.
inline constexpr double plate_precision = 1e-11;

/// Contacts of a sphere with a closed wall of plates, given those near it: adds to `out` the nodes
/// that push, `part` by `part` of every plate that does. As long as the centre is inside, the force k u is minus the
/// gradient of k |u|^2 / 2 for any motion of sphere and nodes; one that got out, beyond a valley too, is pushed back
/// in. `outward(node)`: direction in which a node moves outward.
template <class Outward>
void push_out(const plates_near& near, const vec3& x, double r, Outward&& outward, touches& out) {
    const std::span<const plate> plates = near.plates();
    std::size_t deepest = plates.size();
    separation first{r, {}};
    for (std::size_t j = 0; j < plates.size(); ++j)
        if (near.how(j).distance < first.distance) first = near.how(j), deepest = j;
    if (deepest == plates.size()) return;
    vec3 u = (r - first.distance) * first.normal;
    if (dot(x - plates[deepest].a, plates[deepest].n) < 0.0 && first.distance >= 0.0) {
        // In front of an edge and behind a plate: inside, if it is in front of another plate at that edge; else in
        // the wedge behind a valley, and to be pushed through the edge.
        vec3 inward;
        bool behind = true;
        for (std::size_t j = 0; j < plates.size(); ++j) {
            if (near.how(j).distance > first.distance * (1.0 + 1e-9)) continue;
            if (dot(x - plates[j].a, plates[j].n) >= 0.0) behind = false;
            inward += plates[j].n;
        }
        if (behind) {
            const vec3 edge = x - first.distance * first.normal;
            u = edge + r * unit(inward) - x;
            first = {-first.distance, unit(inward)};
        }
    }
    const auto report = [&](std::size_t j, const vec3& n, double depth, const vec3& way) {
        const plate& t = plates[j];
        const foot f = foot_on(t, x + way); // where the sphere touches once it is free
        for (std::size_t i = 0; i < 4; ++i) {
            double part = 0.0;
            for (std::size_t corner = 0; corner < 3; ++corner) part += f.weights[corner] * (*t.parts)[corner][i];
            if (part > 0.0) out.add({t.node[i], n, part * depth, -dot(n, outward(t.node[i])), part});
        }
    };
    detail::way_out<plates_near::most>(plates, x, r, deepest, first, u, plate_precision * r, report);
}

} // namespace clast::boundaries
