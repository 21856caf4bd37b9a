// SPDX-License-Identifier: MIT
// Contacts of one pebble with the facets of a boundary, and the load that a facet collects from them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <clast/core/vector.hpp>

namespace clast::boundaries {

inline constexpr std::int32_t bottom_platen = 0;
inline constexpr std::int32_t top_platen = 1;
inline constexpr std::int32_t first_lateral_facet = 2; ///< then ring * tiles_per_ring + tile, rings from the bottom

/// One contact of a pebble with a facet. The force on the pebble is k * depth * normal.
struct touch {
    std::int32_t facet;
    vec3 normal;       ///< unit vector into the specimen: direction of the force on the pebble
    double depth;      ///< overlap, or the facet's share of the way out where several facets are touched (m), >= 0
    double along;      ///< cosine between `normal` and the facet's own inward direction, in [0, 1]; below 1 at an edge
    double part = 1.0; ///< of a face that several facets span, the nodes of a sheet: this facet's part in a move of the
                       ///< point of contact; all parts of a face stand in a row, with its normal, and add up to 1

    constexpr bool at_platen() const { return facet < first_lateral_facet; }
    /// Number of the platen, of a touch at one: 0 bottom, 1 top.
    constexpr std::size_t platen() const { return facet == top_platen ? 1 : 0; }
};

/// Most contacts of one pebble with a boundary: three lateral faces (three planes fix a way out) of four facets each,
/// and two platens.
inline constexpr std::size_t most_touches = 14;

/// All contacts of one pebble with a boundary.
struct touches {
    int size = 0;
    std::array<touch, most_touches> at;

    constexpr touches() = default;
    /// Copies those that are there. Most pebbles near a wall touch one facet or none: a loop from 0 would become a call
    /// that takes longer than the touch was found in.
    constexpr touches(const touches& other) { *this = other; }
    constexpr touches& operator=(const touches& other) {
        size = other.size;
        if (size > 0) at[0] = other.at[0];
        if (size > 1) std::copy(other.begin() + 1, other.end(), at.begin() + 1);
        return *this;
    }

    constexpr void add(const touch& t) { at[static_cast<std::size_t>(size++)] = t; }
    constexpr const touch* begin() const { return at.data(); }
    constexpr const touch* end() const { return at.data() + size; }
};

/// Way out of the lateral wall (m): sum of depth * normal over lateral facets. Lateral force on the pebble = k times
/// this, its elastic energy = k |.|^2 / 2 (not the sum over touches, whose normals are not orthogonal).
constexpr vec3 lateral_push(const touches& t) {
    vec3 u;
    for (const touch& one : t)
        if (!one.at_platen()) u += one.depth * one.normal;
    return u;
}

/// Point of the wall (m) that a pebble (centre x, radius r, m) presses on at one of its touches: where it rests on that
/// facet once it has gone the way out. At a facet alone this is x - (r - depth) normal; where lateral facets share the
/// pebble, a point of each of them, so that their forces together have no moment about x.
inline vec3 point_on_wall(const touches& all, const touch& one, const vec3& x, double r) {
    const vec3 way = one.at_platen() ? one.depth * one.normal : lateral_push(all);
    return x + way - r * one.normal;
}

/// Elastic energy (J) of a pebble's boundary contacts with contact stiffness k_platen and k_lateral (N/m).
constexpr double elastic_energy(const touches& t, double k_platen, double k_lateral) {
    double energy = 0.5 * k_lateral * norm2(lateral_push(t));
    for (const touch& one : t)
        if (one.at_platen()) energy += 0.5 * k_platen * one.depth * one.depth;
    return energy;
}

/// Whether all touches are parts of one face.
constexpr bool is_one_face(const touches& t) {
    if (t.at[0].part == 1.0) return false;
    for (const touch& one : t)
        if (one.at_platen() || !(one.normal == t.at[0].normal)) return false;
    return true;
}

/// How the shares (touch::depth) of the lateral faces that one pebble touches answer to a move of one of them along
/// its normal: the inverse Gram matrix of the normals, 1 for a face alone, large for nearly parallel faces, because a
/// small move of one against the other shifts the whole load between them.
class sharing {
  public:
    explicit sharing(const touches& t) {
        std::array<vec3, 3> n;
        std::size_t faces = 0, lateral = 0;
        for (const touch& one : t) {
            if (one.at_platen()) continue;
            if (faces == 0 || !(n[faces - 1] == one.normal)) {
                if (faces == n.size()) break;
                n[faces++] = one.normal;
            }
            face_[lateral++] = static_cast<std::uint8_t>(faces - 1);
        }
        if (faces == 1) {
            of_[0][0] = 1.0;
        } else if (faces == 2) {
            const double c = dot(n[0], n[1]), d = 1.0 / (1.0 - c * c);
            of_[0][0] = of_[1][1] = d;
            of_[0][1] = of_[1][0] = -c * d;
        } else if (faces == 3) {
            const std::array<vec3, 3> dual{cross(n[1], n[2]), cross(n[2], n[0]), cross(n[0], n[1])};
            const double volume = dot(n[0], dual[0]);
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) of_[i][j] = dot(dual[i], dual[j]) / (volume * volume);
        }
    }
    /// Between the faces of the a-th and b-th lateral touch.
    double operator()(std::size_t a, std::size_t b) const { return of_[face_[a]][face_[b]]; }

  private:
    std::array<std::array<double, 3>, 3> of_{};
    std::array<std::uint8_t, most_touches> face_{};
};

/// Two facets that share a pebble: moving one changes the force on the other.
struct coupling {
    std::int32_t a;
    std::int32_t b;
    double stiffness; ///< d force on a / d inward displacement of b (N/m): negative where a pebble lies between two
                      ///< faces, positive where a and b span one
};

/// What the grains do to one facet in one step.
struct facet_load {
    double force = 0.0;     ///< component, along the inward normal, of what the facet exerts on grains (N), >= 0
    double stiffness = 0.0; ///< d force / d inward displacement at fixed grains, summed over contacts (N/m)
    std::int32_t contacts = 0;
    /// Vertical force (N, upward positive) of a lateral facet's lower and upper edge on grains.
    std::array<double, 2> edge{};

    /// Adds one contact that carries `force_on_pebble` (N, along t.normal) with contact stiffness k (N/m).
    constexpr void add(const touch& t, double force_on_pebble, double k) {
        force += force_on_pebble * t.along;
        if (!t.at_platen()) edge[t.normal.z < 0.0 ? 0 : 1] += force_on_pebble * t.normal.z;
        stiffness += k * t.along * t.along;
        ++contacts;
    }
};

/// Velocity (m/s) of a surface at a point that one of its facets touches, `ahead` seconds from now: what the surface
/// says of itself (`velocity_at(touch, point)`), or else its speed along the normal of the touch.
template <class B>
vec3 velocity_of(const B& surface, const touch& t, [[maybe_unused]] const vec3& point, double /*ahead*/) {
    if constexpr (requires { surface.velocity_at(t, point); })
        return surface.velocity_at(t, point);
    else
        return (t.along * surface.velocity(t.facet)) * t.normal;
}

/// The part of a surface that a facet belongs to, as one neighbour of a grain: the number of the platen, or that of the
/// first lateral facet for the whole lateral wall, unless the surface has parts of its own (`part_of(facet)`).
template <class B> std::int32_t part_of(const B& surface, std::int32_t facet) {
    if constexpr (requires { surface.part_of(facet); })
        return surface.part_of(facet);
    else
        return facet < first_lateral_facet ? facet : first_lateral_facet;
}

/// What a law remembers of a pebble at a boundary that rubs, and what that does to the pebble in this step.
template <class History> struct grip {
    struct hold {
        History history{};
        vec3 normal; ///< from the pebble to the wall when it was evaluated last; zero: it did not touch
        vec3 force;  ///< across the normal, on the pebble (N)
    };
    std::array<hold, 3> part; ///< bottom platen, top platen, lateral wall
    vec3 force;               ///< of all (N)
    vec3 moment;              ///< about the centre of the pebble (N m)
    double dissipated = 0.0;  ///< J
};

/// A pebble at a boundary: what touches it and the forces that it takes (N).
struct wall_row {
    std::int32_t pebble = -1;
    double lateral = 0.0;           ///< size of the lateral force (N)
    vec3 force;                     ///< on the pebble
    vec3 friction;                  ///< its part across the normals
    std::array<double, 2> platen{}; ///< force of bottom and top platen (N)
    touches touch;

    /// Force (N) along the normal of one of its touches: lateral facets share by their parts of the way out.
    double share(const boundaries::touch& t) const { return share(t, norm(lateral_push(touch))); }
    /// The same where the length of the lateral way out, norm(lateral_push(touch)), is known (m).
    double share(const boundaries::touch& t, double way) const {
        return t.at_platen() ? platen[t.platen()] : lateral * t.depth / way;
    }
    template <class A> void archive(A& a) { a(pebble); } // the rest is written anew by the next step
};

} // namespace clast::boundaries
