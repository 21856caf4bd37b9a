// SPDX-License-Identifier: MIT
// Where grains stand at the beginning: in a cloud, at random places where they touch nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/bodies/clumps.hpp>
#include <clast/bodies/concepts.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/random.hpp>
#include <clast/grains/mixture.hpp>
#include <clast/searches/cell_grid.hpp>

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
    /// f(number) for the cells from a to b.
    template <class F> void each(const index& a, const index& b, F&& f) const {
        for (std::int64_t k = a.k; k <= b.k; ++k)
            for (std::int64_t j = a.j; j <= b.j; ++j)
                for (std::int64_t i = a.i; i <= b.i; ++i) f(number({i, j, k}));
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

/// What stands in the way of a new grain: noted in every cell from which it could be met.
class cloud_search {
  public:
    explicit cloud_search(const cloud_cells& cells) : cells_(cells), near_(cells.size()) {}

    /// Something that is there; newcomers have a radius (m) of `reach` at most.
    void keep_off(const vec3& x, double radius, double reach) {
        const double apart = radius + reach;
        const vec3 around{apart, apart, apart};
        cells_.each(cells_.of(x - around), cells_.of(x + around), [&](std::size_t c) {
            near_[c].push_back({x, radius});
        });
    }
    bool is_free(const vec3& x, double radius) const {
        const auto& near = near_[cells_.number(cells_.of(x))];
        return std::all_of(near.begin(), near.end(), [&](const obstacle& o) {
            const double apart = o.radius + radius;
            return norm2(o.x - x) > apart * apart;
        });
    }

  private:
    struct obstacle {
        vec3 x;
        double radius;
    };
    cloud_cells cells_;
    std::vector<std::vector<obstacle>> near_;
};

/// A place for a grain.
struct cloud_place {
    std::size_t grain; ///< which of those that were to be placed
    vec3 centre;
    quaternion q;
};

/// Places for grains with these radii of circumscribed spheres (m), which must fall, in the order of their numbers.
template <class Body, class Room>
std::vector<cloud_place> cloud_of(const Body& s, const std::vector<double>& reach, const Room& room,
                                  std::uint64_t seed) {
    const std::size_t count = reach.size();
    const auto too_dense = [&](std::size_t placed) {
        return input_error("number of grains", fmt::format("{}", count),
                           fmt::format("about {} in a cloud of radius {:.3g} m and height {:.3g} m", placed,
                                       room.radius, room.top - room.bottom),
                           "Make the vessel larger or the specimen of fewer grains.");
    };
    if (count == 0) return {};
    const double most = reach.front(), least = reach.back();
    if (room.radius - most <= 0.0 || room.top - most <= room.bottom + most) throw too_dense(0);
    cloud_search others(
        cloud_cells(room.radius - least, room.bottom + least, room.top - least,
                    2.0 * std::accumulate(reach.begin(), reach.end(), 0.0) / static_cast<double>(count)));
    for (std::size_t b = 0; b < s.body_count(); ++b) {
        if (s.is_swept(b)) {
            others.keep_off(s.centre(b), s.bounding_radius(b), most);
            continue;
        }
        for (std::size_t p = s.pebbles_of(b).begin; p < s.pebbles_of(b).end; ++p)
            others.keep_off(s.pebbles[p].x, s.pebbles[p].radius, most);
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
        const double rc = reach[cloud.size()], half = room.radius - rc, low = room.bottom + rc, high = room.top - rc;
        const vec3 c{half * (2.0 * uniform01(random) - 1.0), half * (2.0 * uniform01(random) - 1.0),
                     low + (high - low) * uniform01(random)};
        if (!room.holds(c, rc) || !others.is_free(c, rc)) continue;
        others.keep_off(c, rc, rc);
        const auto slab = static_cast<std::int64_t>((c.z - (room.bottom + most)) / (4.0 * most));
        cloud.push_back({{cloud.size(), c, orientation(random)}, slab, std::atan2(c.y, c.x)});
    }
    // not std::stable_sort, which takes long to compile
    std::sort(cloud.begin(), cloud.end(), [](const placed& a, const placed& b) {
        return a.slab != b.slab ? a.slab < b.slab : a.angle != b.angle ? a.angle < b.angle : a.centre.z < b.centre.z;
    });
    return {cloud.begin(), cloud.end()};
}

} // namespace detail

/// Places for grains of a mixture (in the order of falling diameter, as mixture::grains_of gives them) in a cloud:
/// centres uniform in the room, orientations uniform, no circumscribed sphere overlapping another, nor a body that is
/// there already (random sequential addition, the largest first; paper section 2.3, Fig. 2). They are sorted along z,
/// then by angle, so that neighbours in space are neighbours in memory. The same seed gives the same cloud. Throws
/// input_error if the room cannot take that many (possible up to about 30 % of sphere volume).
template <bodies::specimen Body, room_for_a_cloud Room>
std::vector<placed_grain> cloud_of(const Body& s, const mixture& of, const std::vector<mixture_grain>& grains,
                                   const Room& room, std::uint64_t seed) {
    std::vector<double> reach;
    for (const mixture_grain& g : grains) reach.push_back(of.reach(g));
    std::vector<placed_grain> cloud;
    for (const detail::cloud_place& p : detail::cloud_of(s, reach, room, seed))
        cloud.push_back({grains[p.grain], p.centre, p.q});
    return cloud;
}
/// Adds grains of a mixture to a specimen, in their places. Throws input_error if it cannot hold such shapes.
template <bodies::specimen Body> void add(Body& s, const mixture& of, const std::vector<placed_grain>& grains) {
    std::vector<decltype(s.kind_of(of.parts().front().form))> kinds;
    for (const mixture_part& p : of.parts()) kinds.push_back(s.kind_of(p.form));
    const bool one_rock = std::all_of(of.parts().begin(), of.parts().end(),
                                      [](const mixture_part& p) { return p.material == 0 && p.density_ratio == 1.0; });
    for (const placed_grain& g : grains) {
        const auto b = static_cast<std::size_t>(s.add(kinds[g.part], g.centre, g.q, g.scale));
        const mixture_part& part = of.parts()[g.part];
        if (!one_rock) s.set_material(b, part.material, part.density_ratio);
    }
}

/// Grains of a mixture in their places, that have been looked at, and what a test has to know of them. A type of its
/// own, so that programs that pack clouds do not compile this.
class packing {
  public:
    /// No grains: a test makes a cloud.
    packing() = default;
    /// Throws input_error with the number of the grain (from 1, as its row in a table) where a part is not of the
    /// mixture, a size not above 0, an orientation not of unit length (to 1e-6), or a pebble reaches into one of
    /// another grain by more than a tenth of the smaller radius; and where there are no grains.
    template <std::same_as<mixture> Mixture> // else every program would compile it
    packing(const Mixture& of, std::vector<placed_grain> grains) : grains_(std::move(grains)) {
        if (grains_.empty())
            throw input_error("packing", "no grains", "one grain or more", "Leave it out for a cloud.");
        for (std::size_t g = 0; g < grains_.size(); ++g) add_pebbles(of, g);
        look_for_overlaps();
        measure(of);
    }

    bool empty() const { return grains_.empty(); }
    const std::vector<placed_grain>& grains() const { return grains_; }
    const std::vector<searches::sphere>& pebbles() const { return pebbles_; } ///< with the numbers of their grains
    const grain_sizes& sizes() const { return sizes_; }

  private:
    static input_error wrong(std::size_t g, const std::string& what, const char* right, const char* way_out) {
        return input_error(fmt::format("packing, grain {}", g + 1), what, right, way_out);
    }
    template <class Mixture> void add_pebbles(const Mixture& of, std::size_t g) {
        const placed_grain& one = grains_[g];
        if (one.part >= of.parts().size())
            throw wrong(g, fmt::format("shape number {}", one.part), "a shape of the mixture",
                        "Give the mixture all shapes that are in the packing.");
        if (!(one.scale > 0.0 && std::isfinite(one.scale) && is_finite(one.centre)))
            throw wrong(g, fmt::format("scale {}", one.scale), "a size above 0 and a place, finite", "Correct it.");
        const quaternion& q = one.q;
        if (!(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < 2e-6))
            throw wrong(g, fmt::format("orientation {} {} {} {}", q.w, q.x, q.y, q.z), "a quaternion of length 1",
                        "Divide it by its length; 1 0 0 0 leaves the axes of the shape.");
        for (const shape_pebble& p : of.form(one).pebbles)
            pebbles_.push_back(
                {one.centre + rotate(q, one.scale * p.offset), one.scale * p.radius, static_cast<std::int32_t>(g)});
    }
    template <class = void> void look_for_overlaps() const {
        for (const searches::sphere_pair& pair : searches::cell_grid{}.pairs(pebbles_, 0.0)) {
            const searches::sphere &a = pebbles_[static_cast<std::size_t>(pair.first)],
                                   &b = pebbles_[static_cast<std::size_t>(pair.second)];
            const double depth = a.radius + b.radius - norm(b.centre - a.centre);
            if (a.id != b.id && depth > 0.1 * std::min(a.radius, b.radius))
                throw wrong(static_cast<std::size_t>(a.id), fmt::format("{:.3g} m inside grain {}", depth, b.id + 1),
                            "overlaps of a tenth of the smaller pebble's radius at most",
                            "Shrink the grains a little, or let the program that packed them settle them.");
        }
    }
    template <class Mixture> void measure(const Mixture& of) {
        sizes_.smallest_radius = pebbles_.front().radius;
        for (const searches::sphere& p : pebbles_) {
            sizes_.smallest_radius = std::min(sizes_.smallest_radius, p.radius);
            sizes_.largest_radius = std::max(sizes_.largest_radius, p.radius);
        }
        std::vector<std::pair<double, double>> by_size; // diameter, mass
        double half = 0.0;
        for (const placed_grain& g : grains_) {
            by_size.emplace_back(of.diameter(g), of.parts()[g.part].density_ratio * of.volume(g));
            half += 0.5 * by_size.back().second;
            sizes_.largest_circumscribed = std::max(sizes_.largest_circumscribed, 2.0 * of.reach(g));
        }
        std::sort(by_size.begin(), by_size.end());
        for (const auto& [d, mass] : by_size) {
            sizes_.d50 = d;
            if ((half -= mass) <= 0.0) break;
        }
    }

    std::vector<placed_grain> grains_;
    std::vector<searches::sphere> pebbles_;
    grain_sizes sizes_;
};

/// The first of some pebbles that reaches out of a room by more than a tenth of its radius; their number if none does.
template <room_for_a_cloud Room>
std::size_t first_outside(const Room& room, const std::vector<searches::sphere>& pebbles) {
    const auto inside = [&](const searches::sphere& p) {
        const double r = 0.9 * p.radius;
        return room.holds(p.centre, r) && p.centre.z - r >= room.bottom && p.centre.z + r <= room.top;
    };
    return static_cast<std::size_t>(std::find_if_not(pebbles.begin(), pebbles.end(), inside) - pebbles.begin());
}

/// Adds a cloud of `count` grains of one shape to a specimen.
template <bodies::specimen Body, room_for_a_cloud Room>
void add_cloud(Body& s, const shape& grain, std::size_t count, const Room& room, std::uint64_t seed) {
    const auto kind = s.kind_of(grain);
    for (const auto& p : detail::cloud_of(s, std::vector<double>(count, grain.circumscribed_radius), room, seed))
        s.add(kind, p.centre, p.q);
}
/// The same of a shape that the specimen has already, by its number, in a cylinder.
template <std::same_as<bodies::clumps> Body> // else every program would make it
void add_cloud(Body& s, std::int32_t shape_index, std::size_t count, const cylinder& room, std::uint64_t seed) {
    const double reach = s.shapes[static_cast<std::size_t>(shape_index)].circumscribed_radius;
    for (const auto& p : detail::cloud_of(s, std::vector<double>(count, reach), room, seed))
        s.add(shape_index, p.centre, p.q);
}

} // namespace clast::protocol
