// SPDX-License-Identifier: MIT
// What rings of tiles and rows of nodes have in common: numbers of facets, how far out they are, how fast they move,
// and what follows from the sums of their loads.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <clast/boundaries/cylinder_settings.hpp>
#include <clast/boundaries/platens.hpp>
#include <clast/boundaries/polygon.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::boundaries {

/// Rings of as many facets each around the z axis, between two platens. Facets: 0 bottom platen, 1 top platen, then
/// ring by ring from the bottom. A facet's velocity is positive inward (dR/dt = -V). Where facets are, and what they
/// enclose, is said by what is made of this.
///
/// A template without a choice: what it does is compiled only in programs that have such a wall.
template <class = void> class facet_rings {
  public:
    const cylinder_settings& settings() const { return set_; }

    int facet_count() const { return first_lateral_facet + rings_ * around_; }
    int ring_count() const { return rings_; }
    int tiles_per_ring() const { return around_; }

    /// Normal stiffness of the piece (N/m), before the series rule with the pebble.
    double stiffness(int facet) const {
        return facet < first_lateral_facet ? set_.platen_stiffness : set_.tile_stiffness;
    }
    /// Velocity of a facet inward (m/s).
    double velocity(int facet) const {
        return facet < first_lateral_facet ? platens_.velocity[index(facet)] : velocity_[index(facet - 2)];
    }

    double volume() const { return volume_; }             ///< enclosed (m^3)
    double height() const { return platens_.height(); }   ///< between platens (m)
    double section() const { return volume_ / height(); } ///< mean cross-section (m^2)
    double bottom() const { return platens_.bottom; }     ///< height of the bottom platen (m)
    double top() const { return platens_.top; }           ///< height of the top platen (m)
    /// Largest facet speed (m/s).
    double fastest() const {
        return std::max({std::abs(platens_.velocity[0]), std::abs(platens_.velocity[1]), lateral_speed_});
    }
    /// Mean stress of the lateral wall: sum of forces / sum of areas (Pa).
    double lateral_stress(std::span<const facet_load> loads) const { return lateral_force(loads) / lateral_area_; }
    /// |sum F - sigma sum A| / (sigma sum A) of the lateral wall for the target stress sigma (Pa, > 0).
    double confining_error(std::span<const facet_load> loads, double sigma) const {
        return std::abs(lateral_force(loads) - sigma * lateral_area_) / (sigma * lateral_area_);
    }

    /// Complete state, for checkpoints.
    template <class A> void archive(A& a) {
        a(set_, rings_, around_, dir_, platens_, apothem_, velocity_, volume_, lateral_area_, lateral_speed_);
    }

  protected:
    /// At rest, of so many rings, whatever the settings say of them; each facet `distance` (m) from the axis.
    facet_rings(int rings, const cylinder_settings& of_checked_sizes, double distance)
        : set_(of_checked_sizes), rings_(rings), around_(set_.tiles_per_ring),
          dir_(around_), platens_{set_.bottom, set_.top, {}}, apothem_(index(rings_) * index(around_), distance),
          velocity_(apothem_.size(), 0.0) {}

    static constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }
    std::size_t tile(int ring, int i) const { return index(ring * around_ + i); }
    double spacing() const { return height() / rings_; } ///< height of a ring (m)
    /// Upward velocity (m/s) of what stands at a share of the height and moves with the platens.
    double rise(double share) const { return (1.0 - share) * platens_.velocity[0] - share * platens_.velocity[1]; }
    /// Moves platens and facets by dt (s).
    void move(double dt) {
        platens_.advance(dt);
        for (std::size_t j = 0; j < apothem_.size(); ++j) apothem_[j] -= velocity_[j] * dt;
    }
    /// Whether a sphere has room inside a wall that still is a cylinder of this apothem (m), touching nothing.
    bool holds(const vec3& x, double r, double apothem) const {
        const double free = apothem - r;
        return x.x * x.x + x.y * x.y <= free * free && !platens_.near(x.z, r);
    }
    double lateral_force(std::span<const facet_load> loads) const {
        double sum = 0.0;
        for (int f = first_lateral_facet; f < facet_count(); ++f) sum += loads[index(f)].force;
        return sum;
    }
    /// Least height and apothem halved (m): a single pebble may fill the height or the width, and be squeezed to half
    /// of its diameter. By then a run has failed anyway.
    double least() const { return 0.5 * set_.smallest_radius; }
    /// Throws run_error where the platens have met.
    void check_height() const {
        if (!(height() >= 2.0 * least())) stop("The platens met", "platens");
    }
    [[noreturn]] void stop(const std::string& what, const std::string& where) const {
        throw run_error({what, where, fmt::format("specimen height {:.6g} m", height()),
                         "the load moves the boundary faster than grains can resist, or no grain is left to resist",
                         "load more slowly, lower the speed limit of the servo, or use more rings"});
    }
    /// The platens as squares around the wall. ends: their areas (m^2).
    std::vector<facet_view> view_of_platens(std::span<const facet_load> loads, std::span<const double, 2> ends) const {
        std::vector<facet_view> out;
        double side = 0.0;
        for (const double r : apothem_) side = std::max(side, 1.05 * r);
        for (int f = 0; f < first_lateral_facet; ++f) {
            const double z = f == bottom_platen ? platens_.bottom : platens_.top, area = ends[index(f)];
            out.push_back({{{{-side, -side, z}, {side, -side, z}, {side, side, z}, {-side, side, z}}},
                           loads[index(f)].force / area,
                           area,
                           -1,
                           -1});
        }
        return out;
    }

    cylinder_settings set_;
    int rings_ = 1;
    int around_ = 0;
    directions dir_;
    platens platens_;
    std::vector<double> apothem_;  // distance of each facet from the axis, ring-major
    std::vector<double> velocity_; // per facet, inward
    double volume_ = 0.0;
    double lateral_area_ = 0.0;
    double lateral_speed_ = 0.0; // largest |velocity_|
};

} // namespace clast::boundaries
