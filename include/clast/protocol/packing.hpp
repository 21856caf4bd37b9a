// SPDX-License-Identifier: MIT
// A cloud of grains that touch nothing: random places, random orientations.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fmt/core.h>

#include <clast/bodies/clumps.hpp>
#include <clast/bodies/concepts.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/random.hpp>

namespace clast::protocol {

/// Vertical cylinder around the z axis (m).
struct cylinder {
    double radius;
    double bottom;
    double top;

    /// Whether a sphere between the ends has room.
    bool holds(const vec3& x, double r) const {
        const double free = radius - r;
        return x.x * x.x + x.y * x.y <= free * free;
    }
};

/// The inside of a vessel around the z axis (protocol/vessel.hpp), as a room for a cloud.
template <class Vessel> struct inside {
    const Vessel* vessel;
    double radius;
    double bottom;
    double top;

    explicit inside(const Vessel& v)
        : vessel(&v), radius(v.radius()), bottom(v.bottom()), top(v.bottom() + v.height()) {}
    bool holds(const vec3& x, double r) const { return vessel->holds(x, r); }
};

/// Room for a cloud: a half width around the z axis (m), two heights (m), and whether a sphere in between has room.
template <class R>
concept room_for_a_cloud = requires(const R& r, vec3 x, double length) {
    { r.radius } -> std::convertible_to<double>;
    { r.bottom } -> std::convertible_to<double>;
    { r.top } -> std::convertible_to<double>;
    { r.holds(x, length) } -> std::same_as<bool>;
};

namespace detail {

/// Cells over the places that centres of a cloud may have.
struct cloud_cells {
    double half_width, low, high; ///< m
    std::int64_t nx, nz;

    struct index {
        std::int64_t i, j, k;
    };
    /// Of about one edge each, or wider.
    cloud_cells(double half, double from, double to, double edge)
        : half_width(half), low(from), high(to), nx(count(2.0 * half, edge)), nz(count(to - from, edge)) {}
    /// The nearest one, for places outside.
    index of(const vec3& x) const {
        return {cell(x.x, -half_width, 2.0 * half_width, nx), cell(x.y, -half_width, 2.0 * half_width, nx),
                cell(x.z, low, high - low, nz)};
    }
    std::size_t size() const { return static_cast<std::size_t>(nx * nx * nz); }
    std::size_t number(const index& c) const { return static_cast<std::size_t>((c.k * nx + c.j) * nx + c.i); }
    /// f(number) for the cells from a to b, as long as it answers true; whether it always did.
    template <class F> bool all_of(const index& a, const index& b, F&& f) const {
        for (std::int64_t k = std::max<std::int64_t>(a.k, 0); k <= std::min(b.k, nz - 1); ++k)
            for (std::int64_t j = std::max<std::int64_t>(a.j, 0); j <= std::min(b.j, nx - 1); ++j)
                for (std::int64_t i = std::max<std::int64_t>(a.i, 0); i <= std::min(b.i, nx - 1); ++i)
                    if (!f(number({i, j, k}))) return false;
        return true;
    }

  private:
    static std::int64_t count(double length, double edge) {
        return std::max<std::int64_t>(1, static_cast<std::int64_t>(length / edge));
    }
    static std::int64_t cell(double x, double from, double length, std::int64_t n) {
        // held within bounds as a number, since what is there already may be anywhere
        const double share = std::clamp((x - from) / length, 0.0, 1.0);
        return std::clamp<std::int64_t>(static_cast<std::int64_t>(share * static_cast<double>(n)), 0, n - 1);
    }
};

/// Centres of a cloud so far, and what was there before: who is in the way of a new one?
class cloud_search {
  public:
    cloud_search(const cloud_cells& cells, double reach)
        : cells_(cells), reach_(reach), cloud_(cells.size()), before_(cells.size()) {}

    /// Something that is there already: noted in every cell from which it could be met.
    void keep_off(const vec3& x, double radius) {
        const double apart = radius + reach_;
        const vec3 around{apart, apart, apart};
        cells_.all_of(cells_.of(x - around), cells_.of(x + around), [&](std::size_t c) {
            before_[c].push_back({x, apart * apart});
            return true;
        });
    }
    bool is_free(const vec3& x) const {
        const cloud_cells::index c = cells_.of(x);
        for (const obstacle& o : before_[cells_.number(c)])
            if (!(norm2(o.x - x) > o.apart2)) return false;
        const double apart = 2.0 * reach_; // cells are as wide: the 27 around will do
        return cells_.all_of({c.i - 1, c.j - 1, c.k - 1}, {c.i + 1, c.j + 1, c.k + 1}, [&](std::size_t n) {
            return std::all_of(cloud_[n].begin(), cloud_[n].end(),
                               [&](const vec3& other) { return norm2(other - x) > apart * apart; });
        });
    }
    void add(const vec3& x) { cloud_[cells_.number(cells_.of(x))].push_back(x); }

  private:
    struct obstacle {
        vec3 x;
        double apart2;
    };
    cloud_cells cells_;
    double reach_;
    std::vector<std::vector<vec3>> cloud_;
    std::vector<std::vector<obstacle>> before_;
};

/// A place for a grain.
struct cloud_place {
    vec3 centre;
    quaternion q;
};

/// Places for `count` grains of a circumscribed radius (m), in the order of their numbers.
template <class Body, class Room>
std::vector<cloud_place> cloud_of(const Body& s, double rc, std::size_t count, const Room& room, std::uint64_t seed) {
    const double free_radius = room.radius - rc, low = room.bottom + rc, high = room.top - rc;
    const auto too_dense = [&](std::size_t placed) {
        return input_error("number of grains", fmt::format("{}", count),
                           fmt::format("about {} in a cloud of radius {:.3g} m and height {:.3g} m", placed,
                                       room.radius, room.top - room.bottom),
                           "Make the vessel larger or the specimen of fewer grains.");
    };
    if (free_radius <= 0.0 || high <= low) throw too_dense(0);
    cloud_search others(cloud_cells(free_radius, low, high, 2.0 * rc), rc);
    for (std::size_t b = 0; b < s.body_count(); ++b) {
        if (s.is_swept(b)) {
            others.keep_off(s.centre(b), s.bounding_radius(b));
            continue;
        }
        for (std::size_t p = s.pebbles_of(b).begin; p < s.pebbles_of(b).end; ++p)
            others.keep_off(s.pebbles[p].x, s.pebbles[p].radius);
    }
    struct placed : cloud_place {
        std::int64_t slab; // along z
        double angle;
    };
    std::vector<placed> cloud;
    random_stream random{seed, 0};
    const std::size_t most_tries = 2000 * count + 100000;
    for (std::size_t tries = 0; cloud.size() < count; ++tries) {
        if (tries == most_tries) throw too_dense(cloud.size());
        const vec3 c{free_radius * (2.0 * uniform01(random) - 1.0), free_radius * (2.0 * uniform01(random) - 1.0),
                     low + (high - low) * uniform01(random)};
        if (!room.holds(c, rc) || !others.is_free(c)) continue;
        others.add(c);
        const auto slab = static_cast<std::int64_t>((c.z - low) / (4.0 * rc));
        cloud.push_back({{c, orientation(random)}, slab, std::atan2(c.y, c.x)});
    }
    // not std::stable_sort, which takes long to compile
    std::sort(cloud.begin(), cloud.end(), [](const placed& a, const placed& b) {
        return a.slab != b.slab ? a.slab < b.slab : a.angle != b.angle ? a.angle < b.angle : a.centre.z < b.centre.z;
    });
    return {cloud.begin(), cloud.end()};
}

} // namespace detail

/// Adds `count` grains of a shape to a specimen (bodies::specimen): centres uniform in the room, orientations uniform,
/// no circumscribed sphere overlapping another, nor a body that is there already (random sequential addition; paper
/// section 2.3, Fig. 2). Grains are numbered along z, then by angle, so that neighbours in space are neighbours in
/// memory. The same seed gives the same cloud. Throws input_error if the room cannot take that many (possible up to
/// about 30 % of sphere volume), or if the specimen cannot hold such a shape.
template <bodies::specimen Body, room_for_a_cloud Room>
void add_cloud(Body& s, const shape& grain, std::size_t count, const Room& room, std::uint64_t seed) {
    const auto kind = s.kind_of(grain);
    for (const auto& p : detail::cloud_of(s, grain.circumscribed_radius, count, room, seed)) s.add(kind, p.centre, p.q);
}
/// The same of a shape that the specimen has already, by its number, in a cylinder.
inline void add_cloud(bodies::clumps& s, std::int32_t shape_index, std::size_t count, const cylinder& room,
                      std::uint64_t seed) {
    const double reach = s.shapes[static_cast<std::size_t>(shape_index)].circumscribed_radius;
    for (const auto& p : detail::cloud_of(s, reach, count, room, seed)) s.add(shape_index, p.centre, p.q);
}

} // namespace clast::protocol
