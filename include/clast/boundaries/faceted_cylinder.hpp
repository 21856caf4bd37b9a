// SPDX-License-Identifier: MIT
// A cylindrical membrane of flat facets between two platens (paper section 2.2): how its facets are driven. Whether
// each of them, each ring or the whole wall moves on its own, and what surface they make, are template parameters; see
// tiles.hpp, ring_walls.hpp, solid_strips.hpp and stepped_tiles.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <clast/boundaries/axial.hpp>
#include <clast/boundaries/cylinder_settings.hpp>
#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/boundaries/vessel_settings.hpp>
#include <clast/control/gap_control.hpp>
#include <clast/control/servo.hpp>
#include <clast/control/servo_group.hpp>
#include <clast/core/errors.hpp>

namespace clast::boundaries {

/// What the membrane did so far. A tile-step is one tile (ring, wall) under servo control in one step.
struct boundary_counters {
    control::gap_events gaps;            ///< events of gap control
    std::int64_t tile_steps = 0;         ///< all
    std::int64_t capped = 0;             ///< loaded tiles at the speed limit: above 1 % of tile_steps, load more slowly
    std::int64_t searching = 0;          ///< tiles without contact, moving in at the speed limit
    std::int64_t hidden = 0;             ///< tiles behind their neighbours, following them
    std::int64_t latched_pair_steps = 0; ///< pairs under gap control, summed over steps
    std::int64_t latched_pairs = 0;      ///< pairs under gap control now
};

/// Smallest part of the lateral wall that moves on its own.
enum class moving_unit { wall, ring, tile };

/// Rings of facets (Surface, tile_rings or node_rows: numbers of facets, contact, measures) whose velocities follow
/// from their loads: a servo for each part that moves on its own, and gap control, which keeps the membrane closed.
template <moving_unit Unit, class Surface> class faceted_cylinder : public Surface {
  public:
    /// Throws input_error where a setting makes no sense.
    explicit faceted_cylinder(const cylinder_settings& settings);
    /// The vessel of a test, of all that its settings say. Throws input_error for what check_tiles() refuses.
    static faceted_cylinder made(const vessel_settings& s) {
        check_tiles(s, Unit != moving_unit::wall);
        return faceted_cylinder(cylinder_of(s));
    }
    /// A wall of these settings, at rest and a cylinder again, where this one is now: its radius, bottom and top count,
    /// those of the settings do not.
    faceted_cylinder resized(const vessel_settings& s) const {
        cylinder_settings c = cylinder_of(s);
        c.radius = this->radius(), c.bottom = this->bottom(), c.top = this->top();
        return faceted_cylinder(c);
    }

    static constexpr moving_unit moves = Unit;
    const boundary_counters& counters() const { return counters_; }

    /// Sets all facet velocities from the loads of the last step (one per facet): drive, then gap
    /// control. dt: time until the next call (s). Throws input_error for a drive that makes no sense, lateral_y
    /// included. `couplings` name facets that share pebbles, so that their servos act together
    /// (control/servo_group.hpp).
    void control(std::span<const facet_load> loads, const drives& d, double dt,
                 std::span<const coupling> couplings = {});
    /// Root mean square over the moving units (tiles, rings, wall) of (F - sigma A) / (sigma A); hidden tiles left out.
    double confining_rms(std::span<const facet_load> loads, double sigma) const;

    /// Complete state, for checkpoints.
    template <class A> void archive(A& a) {
        Surface::archive(a);
        a(calm_, latch_, chains_, backward_, counters_);
    }

  private:
    using Surface::apothem_, Surface::around_, Surface::dir_, Surface::platens_, Surface::rings_, Surface::set_,
        Surface::velocity_;
    using Surface::hidden, Surface::index, Surface::tile;

    /// Units around the axis: each ring is one unit, or each tile.
    int units_around() const { return Unit == moving_unit::tile ? around_ : 1; }

    struct unit_load {
        facet_load load;
        double area = 0.0;
    };
    /// Sums load, less the pull of a stretched sheet, and area of what moves together into one entry per unit of every
    /// ring.
    void collect(std::span<const facet_load> loads, std::vector<unit_load>& units) const;
    std::size_t unit_of(std::int32_t facet) const {
        const int j = facet - first_lateral_facet, per_ring = units_around();
        return index(j / around_ * per_ring + (per_ring == 1 ? 0 : j % around_));
    }
    /// Displacements (m, inward) that would bring all units to their loads at once, into moves_of_.
    void solve_together(const drive& d, std::span<const coupling> couplings);
    /// Each against the sum of its row of the stiffness matrix: exact for a move that all of them share, and never too
    /// far for any other (Gershgorin). Their loads are those of the pressure and of the sheet's stiffness.
    void solve_apart(const drive& d, std::span<const coupling> couplings);
    void servo_wall(const drive& d, double dt, std::span<const coupling> couplings);
    void control_gaps();
    /// Adds one velocity to those of all facets, with which they take so much volume per second (m^3/s).
    void take_volume(double rate);

    std::vector<control::calm> calm_; // per unit
    std::vector<std::uint8_t> latch_; // columns first, then rings
    std::vector<control::chain> chains_;
    bool backward_ = false;
    boundary_counters counters_;
    std::vector<unit_load> units_;                               // work space of control(), kept to save the allocation
    std::vector<double> moves_of_, kinks_, stiffness_, holding_; // likewise
    control::servo_group group_;                                 // likewise
};

// --- implementation ------------------------------------------------------------------------------------------------

template <moving_unit Unit, class Surface>
faceted_cylinder<Unit, Surface>::faceted_cylinder(const cylinder_settings& settings)
    : Surface(Unit == moving_unit::wall ? 1 : settings.rings, checked(settings, Surface::tears_at)) {
    calm_.resize(index(rings_) * index(units_around()));
    if constexpr (Unit != moving_unit::wall) {
        const int columns = units_around();
        for (int i = 0; i < columns; ++i)
            chains_.push_back({i, around_, rings_, false, i * rings_, this->largest_gap()});
        if constexpr (Unit == moving_unit::tile)
            for (int k = 0; k < rings_; ++k)
                chains_.push_back(
                    {k * around_, 1, around_, true, columns * rings_ + k * around_, this->largest_step()});
        latch_.assign(Unit == moving_unit::tile ? 2 * apothem_.size() : index(rings_), 0);
    }
}

template <moving_unit Unit, class Surface>
void faceted_cylinder<Unit, Surface>::collect(std::span<const facet_load> loads, std::vector<unit_load>& units) const {
    const int per_ring = units_around();
    units.assign(index(rings_) * index(per_ring), {});
    for (int k = 0; k < rings_; ++k) {
        for (int i = 0; i < around_; ++i) {
            const int facet = first_lateral_facet + k * around_ + i;
            unit_load& u = units[index(k * per_ring + (per_ring == 1 ? 0 : i))];
            const facet_load& l = loads[index(facet)];
            u.load.force += l.force;
            if constexpr (Surface::stretches) u.load.force -= this->stretching_force(facet);
            u.load.stiffness += l.stiffness;
            u.load.contacts += l.contacts;
            u.area += this->area(facet);
        }
    }
}

template <moving_unit Unit, class Surface>
void faceted_cylinder<Unit, Surface>::control(std::span<const facet_load> loads, const drives& d, double dt,
                                              std::span<const coupling> couplings) {
    check(d.platens, "drives.platens");
    check(d.lateral, "drives.lateral");
    if (d.lateral_y)
        throw input_error("drives.lateral_y", "a drive of its own", "none, at a wall around the axis",
                          "Take boundaries::box for three driven axes.");
    using mode = drive::mode;
    // Both platens move alike, on the mean of their forces. Ledges of the wall may take up a
    // difference between them; servos of their own would then chase each other along the axis, with all rings, for
    // ever.
    const facet_load& low = loads[bottom_platen];
    const facet_load& high = loads[top_platen];
    const double closing =
        d.platens.how == mode::servo
            ? control::inward_velocity({axial_force(*this, loads, d.platens.value), 0.5 * (low.force + high.force),
                                        0.5 * (low.stiffness + high.stiffness), set_.contact_stiffness_floor, dt,
                                        d.platens.gain, d.platens.max_speed})
            : (d.platens.how == mode::velocity ? d.platens.value : 0.0);
    platens_.velocity = {closing, closing};
    if (d.lateral.how == mode::servo || d.lateral.how == mode::volume) {
        drive to_one_stress = d.lateral;
        if (d.lateral.how == mode::volume) to_one_stress.value = std::max(0.0, this->lateral_stress(loads));
        collect(loads, units_);
        servo_wall(to_one_stress, dt, couplings);
        control_gaps();
        if (d.lateral.how == mode::volume) take_volume(d.lateral.value);
    } else {
        std::fill(velocity_.begin(), velocity_.end(),
                  d.lateral.how == mode::velocity ? this->speed_of_faces(d.lateral.value) : 0.0);
    }
    this->lateral_speed_ = 0.0;
    for (const double v : velocity_) this->lateral_speed_ = std::max(this->lateral_speed_, std::abs(v));
}

template <moving_unit Unit, class Surface>
void faceted_cylinder<Unit, Surface>::solve_together(const drive& d, std::span<const coupling> couplings) {
    group_.reset(units_.size());
    for (std::size_t at = 0; at < units_.size(); ++at)
        if (const unit_load& u = units_[at]; u.load.stiffness > 0.0)
            group_.set(at, d.value * u.area - u.load.force, std::max(u.load.stiffness, set_.contact_stiffness_floor));
    for (const coupling& c : couplings) group_.couple(unit_of(c.a), unit_of(c.b), c.stiffness);
    group_.solve();
    for (std::size_t at = 0; at < units_.size(); ++at) moves_of_[at] = group_.displacement(at);
}

template <moving_unit Unit, class Surface>
void faceted_cylinder<Unit, Surface>::solve_apart(const drive& d, std::span<const coupling> couplings) {
    for (const coupling& c : couplings) {
        const std::size_t a = unit_of(c.a), b = unit_of(c.b);
        if (a == b) {
            units_[a].load.stiffness += 2.0 * c.stiffness;
        } else {
            units_[a].load.stiffness += std::abs(c.stiffness);
            units_[b].load.stiffness += std::abs(c.stiffness);
        }
    }
    const double stiff = this->resist_kinks(set_.bending * d.value * this->height() / rings_, kinks_);
    const int nodes = around_ / units_around(); // of a unit
    double missing = 0.0, answered = 0.0, contacts = 0.0;
    for (std::size_t at = 0; at < units_.size(); ++at) {
        unit_load& u = units_[at];
        const double by_contacts = u.load.stiffness;
        u.load.stiffness = std::max(by_contacts + nodes * stiff, set_.contact_stiffness_floor);
        double wanted = d.value * u.area;
        for (int i = 0; i < nodes; ++i) wanted += kinks_[at * index(nodes) + index(i)];
        moves_of_[at] = (wanted - u.load.force) / u.load.stiffness;
        missing += wanted - u.load.force, answered += by_contacts * moves_of_[at], contacts += by_contacts;
    }
    // bending does not resist what all do together
    if (contacts > 0.0)
        for (double& move : moves_of_) move += (missing - answered) / contacts;
}

template <moving_unit Unit, class Surface>
void faceted_cylinder<Unit, Surface>::servo_wall(const drive& d, double dt, std::span<const coupling> couplings) {
    const int per_ring = units_around();
    moves_of_.resize(units_.size());
    if constexpr (Surface::solved_together)
        solve_together(d, couplings);
    else
        solve_apart(d, couplings);
    for (int k = 0; k < rings_; ++k) {
        for (int i = 0; i < per_ring; ++i) {
            const unit_load& u = units_[index(k * per_ring + i)];
            const double wanted =
                !Surface::solved_together || u.load.contacts > 0
                    ? std::clamp(d.gain * moves_of_[index(k * per_ring + i)] / dt, -d.max_speed, d.max_speed)
                    : control::inward_velocity(
                          {d.value * u.area, u.load.force, 0.0, set_.contact_stiffness_floor, dt, d.gain, d.max_speed});
            const double v = calm_[index(k * per_ring + i)].follow(wanted, d.max_speed);
            const int tiles = per_ring == 1 ? around_ : 1;
            for (int t = i; t < i + tiles; ++t) velocity_[tile(k, t)] = v;
            ++counters_.tile_steps;
            if (u.load.contacts == 0)
                ++counters_.searching;
            else if (std::abs(v) >= d.max_speed)
                ++counters_.capped;
        }
        if constexpr (Unit == moving_unit::tile)
            for (int i = 0; i < around_; ++i) {
                if (!hidden(k, i)) continue;
                int left = 1;
                int right = 1;
                while (left < around_ && hidden(k, dir_.wrap(i - left))) ++left;
                while (right < around_ && hidden(k, dir_.wrap(i + right))) ++right;
                velocity_[tile(k, i)] =
                    0.5 * (velocity_[tile(k, dir_.wrap(i - left))] + velocity_[tile(k, dir_.wrap(i + right))]);
                ++counters_.hidden;
            }
    }
}

template <moving_unit Unit, class Surface> void faceted_cylinder<Unit, Surface>::control_gaps() {
    counters_.latched_pairs = 0;
    for (const control::chain& c : chains_)
        counters_.latched_pairs += control::latch_gaps(c, set_.gaps, apothem_, latch_);
    counters_.latched_pair_steps += counters_.latched_pairs;
    backward_ = !backward_;
    if (counters_.latched_pairs == 0) return;
    if constexpr (Surface::solved_together) {
        control::control_gaps(chains_, set_.gaps, apothem_, velocity_, latch_, backward_, counters_.gaps);
    } else {
        stiffness_.resize(apothem_.size());
        for (int f = first_lateral_facet; f < this->facet_count(); ++f)
            stiffness_[index(f - first_lateral_facet)] = units_[unit_of(f)].load.stiffness;
        control::hold_gaps(chains_, apothem_, velocity_, stiffness_, latch_, holding_);
    }
    if constexpr (Unit == moving_unit::ring) // the chain runs along the first tiles of the rings
        for (int k = 0; k < rings_; ++k)
            for (int i = 1; i < around_; ++i) velocity_[tile(k, i)] = velocity_[tile(k, 0)];
}

template <moving_unit Unit, class Surface> void faceted_cylinder<Unit, Surface>::take_volume(double rate) {
    double now = 0.0, area = 0.0;
    for (int f = first_lateral_facet; f < this->facet_count(); ++f) {
        now += this->area(f) * this->velocity(f);
        area += this->area(f);
    }
    for (double& v : velocity_) v += (rate - now) / area;
}

template <moving_unit Unit, class Surface>
double faceted_cylinder<Unit, Surface>::confining_rms(std::span<const facet_load> loads, double sigma) const {
    std::vector<unit_load> units;
    collect(loads, units);
    const int per_ring = units_around();
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k < rings_; ++k)
        for (int i = 0; i < per_ring; ++i) {
            if (Unit == moving_unit::tile && hidden(k, i)) continue;
            const unit_load& u = units[index(k * per_ring + i)];
            const double error = u.load.force / (sigma * u.area) - 1.0;
            sum += error * error;
            ++count;
        }
    return count > 0 ? std::sqrt(sum / count) : 0.0;
}

} // namespace clast::boundaries
