// SPDX-License-Identifier: MIT
// Rings of flat tiles around the z axis between two platens (paper section 2.2): where they are, what touches them,
// what they enclose. How fast they move is said by faceted_cylinder.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <fmt/core.h>

#include <clast/boundaries/axial.hpp>
#include <clast/boundaries/cylinder_settings.hpp>
#include <clast/boundaries/facet_rings.hpp>
#include <clast/boundaries/polygon.hpp>
#include <clast/boundaries/push_out.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::boundaries {

/// Lateral wall of flat facets and two platens. Facets: 0 bottom platen, 1 top platen, 2 + ring * tiles_per_ring +
/// tile, tile i facing the azimuth 2 pi i / tiles_per_ring. A facet's velocity is positive inward (dR/dt = -V).
///
/// Grains meet the wall as a solid of steps and valleys (push_out.hpp). The rings share the height between the platens
/// equally and are shortened with the specimen, as a membrane that is clamped to its platens. A column that stays in
/// place while the platens pass along it, the more literal reading of the paper, was tried: grains then drag along the
/// ledges between rings, which carried 2 to 5 % of the axial load of a half-scale test, and slivers of rings at the
/// platens, too low to find a grain, put the mean confining stress wrong by up to 1 %.
///
/// A template without a choice: what it does is compiled only in programs that have such a wall.
template <class = void> class tile_rings : public facet_rings<> {
  public:
    // --- contact ---------------------------------------------------------------------------------------------------
    /// Whether a facet could come within `reach` (pebble radius plus margin, m) of x. Conservative: never false if one
    /// is.
    bool near(const vec3& x, double reach) const {
        if (platens_.near(x.z, reach)) return true;
        const surroundings around = rings_around(x, reach, 0.0);
        if (around.out_of_reach) return false;
        std::array<half_slab, max_slabs> slabs;
        std::size_t n = 0;
        return gather(x, reach, 0.0, 0.0, around, dir_.towards(x.x, x.y), slabs, n) > 0.0;
    }
    /// Contacts of a sphere with the facets as they will be `ahead` seconds later at their present velocities.
    touches touch(const vec3& x, double r, double ahead = 0.0) const {
        touches out;
        platens_.touch_sphere(x, r, ahead, out);
        // the way out may be longer than the deepest overlap and then meets more tiles; as a rule the deepest is that
        // of the tile in front
        double margin = 0.25 * r;
        surroundings around = rings_around(x, r + margin, ahead);
        if (around.out_of_reach) return out;
        const int facing = dir_.towards(x.x, x.y);
        const double front = r - separate(slab(ring_at(x.z), facing, ahead), x).distance;
        if (2.0 * front > margin) margin = 2.0 * front, around = rings_around(x, r + margin, ahead);
        std::array<half_slab, max_slabs> slabs;
        std::size_t n = 0;
        const double deepest = gather(x, r, margin, ahead, around, facing, slabs, n);
        if (deepest <= 0.0) return out;
        if (2.0 * deepest > margin) {
            margin = 2.0 * deepest;
            gather(x, r, margin, ahead, rings_around(x, r + margin, ahead), facing, slabs, n);
        }
        push_out(std::span<const half_slab>(slabs).first(n), x, r, out);
        return out;
    }
    /// Whether a pebble is lost: its centre is beyond a platen, or beyond its ring of tiles, by more than its radius.
    bool outside(const vec3& x, double r) const {
        if (!(x.z > platens_.bottom - r && x.z < platens_.top + r)) return true; // also for NaN
        const int k = ring_at(x.z);
        const double limit = ring_smallest_[index(k)] + r;
        const double rho2 = x.x * x.x + x.y * x.y;
        if (rho2 <= limit * limit) return false;
        for (int i = 0; i < around_; ++i)
            if (!(x.x * dir_.cosine[index(i)] + x.y * dir_.sine[index(i)] <= apothem_[tile(k, i)] + r)) return true;
        return false;
    }

    /// Whether a sphere has room inside a wall that still is a cylinder, touching nothing.
    bool holds(const vec3& x, double r) const { return facet_rings<>::holds(x, r, radius()); }

    // --- facets ----------------------------------------------------------------------------------------------------
    /// Inward unit normal of a facet.
    vec3 inward(int facet) const {
        if (facet < first_lateral_facet) return {0.0, 0.0, facet == bottom_platen ? 1.0 : -1.0};
        const std::size_t i = index((facet - first_lateral_facet) % around_);
        return {-dir_.cosine[i], -dir_.sine[i], 0.0};
    }
    /// Distance of a lateral facet's plane from the axis (m).
    double apothem(int facet) const { return apothem_[index(facet - first_lateral_facet)]; }
    /// Of a wall that still is a cylinder: apothem of its tiles (m).
    double radius() const { return apothem_[0]; }
    /// Area of a facet that encloses the specimen (m^2): visible width times height; for a platen the mean section.
    /// d volume / dt = - sum of area times velocity.
    double area(int facet) const {
        if (facet < first_lateral_facet) return section();
        return visible_[index(facet - first_lateral_facet)].width() * spacing();
    }

    // --- motion ----------------------------------------------------------------------------------------------------
    /// Moves all facets by dt (s). Throws run_error if the membrane tears or the platens meet.
    void advance(double dt) {
        move(dt);
        refresh();
        check_state();
    }

    /// Velocity (m/s) of the surface at a point of a touch: platens move along the axis, tiles across it and, with
    /// their rings, along it as their height between the platens asks for.
    vec3 velocity_at(const boundaries::touch& t, const vec3& point) const {
        if (t.facet == bottom_platen) return {0.0, 0.0, platens_.velocity[0]};
        if (t.facet == top_platen) return {0.0, 0.0, -platens_.velocity[1]};
        const std::size_t j = index(t.facet - first_lateral_facet), i = j % index(around_);
        const double v = velocity_[j], share = std::clamp((point.z - bottom()) / height(), 0.0, 1.0);
        return {-v * dir_.cosine[i], -v * dir_.sine[i], rise(share)};
    }

    // --- measures --------------------------------------------------------------------------------------------------
    /// Area of the specimen at a height between the platens (m^2).
    double section_at(double z) const { return ring_area(ring_at(z)); }
    /// Area of the specimen at a platen (m^2; 0 bottom, 1 top): that of the polygon of the ring there.
    double end_section(int platen) const { return ring_area(platen == bottom_platen ? 0 : rings_ - 1); }
    /// Axial stress of the laboratory, sigma_3 + q (Pa): boundaries/axial.hpp.
    double axial_stress(std::span<const facet_load> loads) const { return boundaries::axial_stress(*this, loads); }
    /// Rate of work done on the specimen by all facets (W): force times inward velocity, and that of the ledges between
    /// rings, which move with the platens.
    double power(std::span<const facet_load> loads) const {
        double sum = 0.0;
        for (int f = 0; f < facet_count(); ++f) {
            const facet_load& l = loads[index(f)];
            sum += l.force * velocity(f);
            if (f < first_lateral_facet) continue;
            const int ring = (f - first_lateral_facet) / around_;
            sum += l.edge[0] * edge_velocity(ring) + l.edge[1] * edge_velocity(ring + 1);
        }
        return sum;
    }
    /// The platens (as squares around the wall) and all visible tiles.
    std::vector<facet_view> view(std::span<const facet_load> loads) const;

    /// Complete state, for checkpoints.
    template <class A> void archive(A& a) {
        facet_rings<>::archive(a);
        a(half_width_, visible_, ring_smallest_, edge_);
    }

  protected:
    /// Default of largest_radius, in radii.
    static constexpr bool stretches = false; ///< rectangles do not hang together
    static constexpr double tears_at = 1.6;
    /// Tiles that share a pebble pass its whole load to each other over a fraction of a micrometre.
    static constexpr bool solved_together = true;
    /// Largest steps (m) between neighbours up a column and around a ring.
    double largest_gap() const { return set_.largest_gap; }
    double largest_step() const { return set_.largest_step; }
    /// Speed of what moves for one of the wall's faces (m/s).
    static constexpr double speed_of_faces(double v) { return v; }

    /// A cylinder at rest of so many rings, whatever the settings say of them. Throws run_error where the height or the
    /// radius leaves no room for the smallest pebble.
    tile_rings(int rings, const cylinder_settings& of_checked_sizes);

    /// A tile that shows less than 5 % of its regular width is led by its neighbours: its own area says nothing.
    bool hidden(int ring, int i) const {
        return visible_[tile(ring, i)].width() < 0.05 * regular_width(around_, ring_smallest_[index(ring)]);
    }

    double half_width_ = 0.0;
    std::vector<interval> visible_;
    std::vector<double> ring_smallest_; // per ring: least apothem
    std::vector<double> edge_;          // heights (m): ring k lies between edge_[k] and edge_[k + 1]

  private:
    /// Upward velocity (m/s) of the edge below a ring; the one above the last ring is number rings_.
    double edge_velocity(int ring) const { return rise(static_cast<double>(ring) / rings_); }
    /// Area of a ring's polygon (m^2).
    double ring_area(int ring) const {
        double sum = 0.0;
        for (int i = 0; i < around_; ++i) sum += 0.5 * visible_[tile(ring, i)].width() * apothem_[tile(ring, i)];
        return sum;
    }
    /// Ring at a height; the end ones reach on for ever.
    int ring_at(double z) const {
        const double k = std::floor((z - bottom()) / (edge_[1] - edge_[0]));
        return k <= 0.0 ? 0 : k >= rings_ - 1 ? rings_ - 1 : static_cast<int>(k);
    }
    /// Rings that a sphere may touch, and their least apothem (m).
    struct surroundings {
        int first = 0, last = 0;
        double least = 0.0;
        bool out_of_reach = false; ///< none of their tiles is within reach
    };
    surroundings rings_around(const vec3& x, double reach, double ahead) const {
        surroundings s{ring_at(x.z - reach), ring_at(x.z + reach)};
        s.least = ring_smallest_[index(s.first)];
        for (int k = s.first + 1; k <= s.last; ++k) s.least = std::min(s.least, ring_smallest_[index(k)]);
        s.least -= std::abs(ahead) * lateral_speed_;
        const double inner = s.least - reach;
        s.out_of_reach = inner >= 0.0 && x.x * x.x + x.y * x.y <= inner * inner;
        return s;
    }
    /// A tile as it will be `ahead` seconds later.
    half_slab slab(int ring, int i, double ahead) const {
        constexpr double infinite = std::numeric_limits<double>::infinity();
        const std::size_t j = tile(ring, i);
        half_slab h{dir_.cosine[index(i)],
                    dir_.sine[index(i)],
                    apothem_[j],
                    ring == 0 ? -infinite : edge_[index(ring)],
                    ring + 1 == rings_ ? infinite : edge_[index(ring + 1)],
                    static_cast<std::int32_t>(j) + first_lateral_facet};
        if (ahead != 0.0)
            h.apothem -= velocity_[j] * ahead, h.low += edge_velocity(ring) * ahead,
                h.high += edge_velocity(ring + 1) * ahead;
        return h;
    }
    /// Collects the tiles within r + margin of x, of the rings around it; returns the deepest overlap with a single one
    /// (m), 0 without any. facing: the column in front of x.
    double gather(const vec3& x, double r, double margin, double ahead, const surroundings& around, int facing,
                  std::array<half_slab, max_slabs>& slabs, std::size_t& n) const;
    void refresh();
    void check_state() const;
};

// --- implementation ------------------------------------------------------------------------------------------------

template <class X>
tile_rings<X>::tile_rings(int rings, const cylinder_settings& of_checked_sizes)
    : facet_rings<>(rings, of_checked_sizes, of_checked_sizes.radius),
      half_width_(half_width_without_slit(around_, set_.largest_radius, set_.largest_step)) {
    visible_.resize(apothem_.size());
    ring_smallest_.resize(index(rings_));
    edge_.resize(index(rings_) + 1);
    refresh();
    check_state();
}

template <class X>
double tile_rings<X>::gather(const vec3& x, double r, double margin, double ahead, const surroundings& around,
                             int facing, std::array<half_slab, max_slabs>& slabs, std::size_t& n) const {
    n = 0;
    double deepest = 0.0;
    std::array<double, max_slabs> overlap;
    const auto look_at =
        [&](int i) { // the tiles of column i; false where even the nearest of all rings is out of reach
            if (x.x * dir_.cosine[index(i)] + x.y * dir_.sine[index(i)] + (r + margin) <= around.least) return false;
            for (int k = around.first; k <= around.last; ++k) {
                const half_slab h = slab(k, i, ahead);
                const double depth = r - separate(h, x).distance;
                if (depth <= -margin) continue;
                deepest = std::max(deepest, depth);
                std::size_t at = n;
                if (n == slabs.size()) { // a sphere that spans very many tiles: the shallowest makes room
                    at = static_cast<std::size_t>(std::min_element(overlap.begin(), overlap.end()) - overlap.begin());
                    if (overlap[at] >= depth) continue;
                } else
                    ++n;
                slabs[at] = h;
                overlap[at] = depth;
            }
            return true;
        };
    bool more = look_at(facing);
    for (int m = 1; 2 * m < around_ && more; ++m) {
        // by turns: a tile out of reach on one side rules out the next one on the other
        const bool right = look_at(dir_.wrap(facing + m));
        more = look_at(dir_.wrap(facing - m)) && right;
    }
    return deepest;
}

template <class X> void tile_rings<X>::refresh() {
    double around = 0.0, area = 0.0; // summed over rings
    for (int k = 0; k < rings_; ++k) {
        const auto ring = std::span<const double>(apothem_).subspan(tile(k, 0), index(around_));
        const double smallest = *std::min_element(ring.begin(), ring.end());
        for (int i = 0; i < around_; ++i) {
            const interval seen = visible(dir_, ring, i, half_width_, smallest);
            visible_[tile(k, i)] = seen;
            around += seen.width();
            area += 0.5 * seen.width() * ring[index(i)];
        }
        ring_smallest_[index(k)] = smallest;
    }
    for (int k = 0; k <= rings_; ++k) edge_[index(k)] = bottom() + k * spacing();
    volume_ = area * spacing();
    lateral_area_ = around * spacing();
}

template <class X> void tile_rings<X>::check_state() const {
    check_height();
    for (std::size_t j = 0; j < apothem_.size(); ++j)
        if (!(apothem_[j] >= least() && apothem_[j] <= set_.largest_radius))
            stop("The membrane is torn",
                 fmt::format("tile {} of ring {}, at {:.6g} m from the axis (allowed {:.6g} to {:.6g} m)",
                             static_cast<int>(j) % around_, static_cast<int>(j) / around_, apothem_[j], least(),
                             set_.largest_radius));
}

template <class X> std::vector<facet_view> tile_rings<X>::view(std::span<const facet_load> loads) const {
    std::vector<facet_view> out = view_of_platens(loads, std::array{end_section(0), end_section(1)});
    for (int k = 0; k < rings_; ++k) {
        const double low = edge_[index(k)], high = edge_[index(k + 1)];
        for (int i = 0; i < around_; ++i) {
            const std::size_t j = tile(k, i);
            const interval s = visible_[j];
            if (s.width() <= 0.0) continue;
            const vec3 n{dir_.cosine[index(i)], dir_.sine[index(i)], 0.0};
            const vec3 t{-n.y, n.x, 0.0};
            const vec3 up{0.0, 0.0, 1.0};
            const vec3 left = apothem_[j] * n + s.low * t;
            const vec3 right = apothem_[j] * n + s.high * t;
            const int facet = static_cast<int>(j) + first_lateral_facet;
            const double a = area(facet);
            out.push_back({{left + low * up, right + low * up, right + high * up, left + high * up},
                           loads[index(facet)].force / a,
                           a,
                           k,
                           i});
        }
    }
    return out;
}

} // namespace clast::boundaries
