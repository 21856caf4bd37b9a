// SPDX-License-Identifier: MIT
// How fast the walls of a test move: the drives of a stage's two axes as speeds, and walls that give way to a stress.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <clast/boundaries/axial.hpp>
#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/protocol/stage.hpp>
#include <clast/protocol/test_plan.hpp>

namespace clast::protocol {

/// What the walls of a specimen feel, as seen at a look. SI units; stress positive in compression.
struct wall_view {
    double height = 0.0;       ///< m
    double radius = 0.0;       ///< apothem, half side of a box (m)
    double p = 0.0;            ///< mean stress of the walls (Pa)
    double coordination = 0.0; ///< touching neighbours per body
    double look_time = 0.0;    ///< model time until the next look (s)
};

/// What walls would feel if a specimen became smaller at fixed grains: mean stress (Pa), and how much it rises with the
/// strain of all axes alike (Pa).
struct wall_load {
    double p = 0.0;
    double stiffness = 0.0;
};
/// Of platens (facets 0 and 1; over the mean section) and lateral wall (all others; over the area that a prism around a
/// circle has), where they move (0 or 1). height, radius (m) and volume (m^3): of what they enclose.
inline wall_load load_of_walls(std::span<const boundaries::facet_load> loads, double p, double height, double radius,
                               double volume, const std::array<bool, 2>& moves) {
    double lateral = 0.0;
    for (std::size_t f = 2; f < loads.size(); ++f) lateral += loads[f].stiffness;
    const double section = volume / height, around = 2.0 * volume / radius;
    const double axial = 0.5 * (loads[0].stiffness + loads[1].stiffness) / section * 0.5 * height;
    return {p, ((moves[0] ? axial : 0.0) + (moves[1] ? 2.0 * lateral / around * radius : 0.0)) / 3.0};
}

/// Strain rate (1/s) of walls that close at `rate` until they carry the mean stress `limit` (Pa), and give way above
/// it: the rule of the servo, gain (limit - p) / (stiffness dt), between -rate and rate.
inline double yielding_rate(const wall_load& on, double limit, double gain, double dt, double rate) {
    const double missing = limit - on.p;
    if (on.stiffness <= 0.0) return missing >= 0.0 ? rate : 0.0;
    return std::clamp(gain * missing / (on.stiffness * dt), -rate, rate);
}

/// The speeds of both axes of a running stage.
class wall_speed {
  public:
    /// density: of the grains (kg/m^3). The plan must stay where it is.
    wall_speed(const test_plan& plan, double density) : plan_(&plan), density_(density) {}
    wall_speed(const wall_speed&) = delete;
    wall_speed& operator=(const wall_speed&) = delete;

    /// Strain rate (1/s) at which the inertial number (paper Eq. 2) is i under the mean stress p (Pa, > 0).
    double rate_at(double i, double p) const { return i * std::sqrt(p / density_) / plan_->grain_diameter; }
    /// The inertial number of a strain rate (1/s).
    double inertial_number(double rate, double p) const {
        return std::abs(rate) * plan_->grain_diameter / std::sqrt(p / density_);
    }
    /// Strain rate (1/s) of a vessel that closes on a cloud.
    double packing_rate() const { return rate_at(plan_->inertial_number_in_flight(), plan_->confining); }

    /// A stage begins.
    void begin(const stage& s, const wall_view& now) {
        start_ = {now.height, now.radius};
        last_ = start_;
        last_p_ = now.p;
        smoothed_p_ = std::max(now.p, 0.01 * plan_->confining);
        const double first = s.moves_grains ? packing_rate() : 0.0;
        rate_ = {goes(s.axial, start_[0]) ? first : 0.0, goes(s.lateral, start_[1]) ? first : 0.0};
        try_again(s);
        pace_ = first;
    }
    /// What stood still may move on: another friction.
    void try_again(const stage& s) { advance_ = inertial_number(packing_rate(), stress_limit(s)); }

    /// Drives until the next look.
    boundaries::drives look(const stage& s, const wall_view& now, bool first) {
        smoothed_p_ += 0.1 * (std::max(now.p, 0.01 * plan_->confining) - smoothed_p_);
        if (!first) note_rates(s, now);
        const double servo = servo_rate(s, now);
        moves_ = {};
        last_ = {now.height, now.radius}, last_p_ = now.p;
        boundaries::drives d;
        d.platens = one(s.axial, s, now, 0, 0.5, servo);
        d.lateral = one(s.lateral, s, now, 1, 1.0, servo);
        if (s.lateral_y) d.lateral_y = one(*s.lateral_y, s, now, 1, 1.0, servo);
        return d;
    }
    /// The same after a step, for walls that give way: all axes that still have a way to go at one rate, so that a
    /// specimen keeps its shape. on: load of these; dt: until the next step (s).
    void yield(boundaries::drives& d, const stage& s, const wall_load& on, double dt) {
        // a wall that has stopped sets off gently: grains that rest against it would be hit all at once
        const double faster = pace_ + closing_ / steps_to_full_pace;
        pace_ = std::min(faster, yielding_rate(on, stress_limit(s), plan_->servo_gain, dt, closing_));
        if (moves_[0]) d.platens.value = std::min(0.5 * pace_ * size_[0], forward_[0]);
        if (moves_[1]) d.lateral.value = std::min(pace_ * size_[1], forward_[1]);
    }
    /// Axes that walls that give way move along.
    const std::array<bool, 2>& moving() const { return moves_; }
    static bool yields(const stage& s) { return s.yields_at > 0.0; }
    /// Stress (Pa) at which walls of a stage give way; of one in which they do not, the confining stress.
    double stress_limit(const stage& s) const { return (yields(s) ? s.yields_at : 1.0) * plan_->confining; }

    /// Share of its way that an axis still has to go, 1 to 0.
    double way_left(const axis_drive& a, std::size_t axis, double size) const {
        if (a.how != axis_drive::kind::reach) return 0.0;
        const double rest = start_[axis] == a.value ? 0.0 : (size - a.value) / (start_[axis] - a.value);
        return rest > 1e-7 ? rest : 0.0;
    }
    /// Strain rates (1/s) of the walls since the look before: axial, lateral.
    const std::array<double, 2>& rates() const { return rate_; }
    /// The inertial number at which walls advance against the stress at which they give way, smoothed over some looks:
    /// small where a specimen has jammed short of its size.
    double advance() const { return advance_; }
    double smoothed_p() const { return smoothed_p_; } ///< mean stress, at least 1 % of the confining stress (Pa)

    template <class A> void archive(A& a) {
        a(start_, last_, last_p_, smoothed_p_, rate_, advance_, closing_, pace_, size_, forward_, moves_);
    }

  private:
    static constexpr double steps_to_full_pace = 200.0;

    static bool goes(const axis_drive& a, double size) {
        return a.how == axis_drive::kind::reach && size - a.value > 1e-9 * size;
    }
    void note_rates(const stage& s, const wall_view& now) {
        rate_ = {(1.0 - now.height / last_[0]) / now.look_time, (1.0 - now.radius / last_[1]) / now.look_time};
        if (!yields(s)) return;
        const double fastest = std::max(std::abs(rate_[0]), std::abs(rate_[1]));
        advance_ += 0.1 * (inertial_number(fastest, stress_limit(s)) - advance_);
    }
    /// Strain rate (1/s) that a wall under servo control may reach.
    double servo_rate(const stage& s, const wall_view& now) const {
        // a tile of a bulge moves at half the strain rate times the radius; where grains slip it has to run after them
        const double usual = 6.0 * rate_at(plan_->inertial_number, plan_->confining);
        if (!s.walls_at_rest || now.coordination < 1.0) return usual;
        // at the next look the stress may have risen as much again
        const double p = std::max(now.p, plan_->consolidation_floor * plan_->confining);
        const bool last = now.p + std::max(0.0, now.p - last_p_) > plan_->final_share * plan_->confining;
        const double i = last ? plan_->final_inertial_number : plan_->consolidation_inertial_number;
        return rate_at(i, p);
    }
    boundaries::drive one(const axis_drive& a, const stage& s, const wall_view& now, std::size_t axis, double share,
                          double servo) {
        using mode = boundaries::drive::mode;
        const double size = axis == 0 ? now.height : now.radius;
        boundaries::drive d;
        d.gain = plan_->servo_gain;
        d.max_speed = s.walls_at_rest ? share * servo * size : servo * plan_->radius;
        switch (a.how) {
        case axis_drive::kind::hold:
            break;
        case axis_drive::kind::rate:
            d.how = mode::velocity, d.value = share * a.value * size;
            break;
        case axis_drive::kind::inertial:
            d.how = mode::velocity;
            d.value = std::copysign(share * size * rate_at(std::abs(a.value), smoothed_p_), a.value);
            break;
        case axis_drive::kind::stress:
            d.how = mode::servo, d.value = a.value;
            break;
        case axis_drive::kind::follow: // what it aims at is set after every step: follow.hpp
            d.how = mode::servo;
            break;
        case axis_drive::kind::volume:
            d.how = mode::volume;
            break;
        case axis_drive::kind::reach:
            reach(d, s, now, axis, share, size, a.value);
            break;
        }
        return d;
    }
    /// Towards a size (m).
    void reach(boundaries::drive& d, const stage& s, const wall_view& now, std::size_t axis, double share, double size,
               double target) {
        const bool free = now.coordination < 1.0;
        const double rate = free || yields(s)
                                ? packing_rate()
                                : std::min(packing_rate(), rate_at(plan_->packing_inertial_number, smoothed_p_));
        // in the free cloud walls keep the speed at which the grains were sent off; at the target they stop
        closing_ = rate, size_[axis] = free ? start_[axis] : size;
        const double way = size - target;
        const bool arrived = way <= 1e-9 * start_[axis];
        forward_[axis] = arrived ? 0.0 : share * std::min(rate * size_[axis], way / now.look_time);
        moves_[axis] = !arrived || s.yields_back;
        if (!moves_[axis]) return; // it holds
        d.how = boundaries::drive::mode::velocity;
        d.value = forward_[axis];
    }

    const test_plan* plan_ = nullptr;
    double density_ = 0.0;
    std::array<double, 2> start_{}, last_{}; ///< height and radius at the beginning, and at the last look (m)
    double last_p_ = 0.0, smoothed_p_ = 0.0; ///< Pa
    std::array<double, 2> rate_{};           ///< 1/s
    double advance_ = 0.0;
    double closing_ = 0.0;            ///< largest rate of axes that go to a size (1/s)
    double pace_ = 0.0;               ///< the present one, of walls that give way (1/s)
    std::array<double, 2> size_{};    ///< by which it counts (m)
    std::array<double, 2> forward_{}; ///< largest speed of each wall (m/s)
    std::array<bool, 2> moves_{};
};

/// Drives of walls that give way, after a step of a stage that has such.
template <class Engine> void give_way(Engine& sim, wall_speed& speed, const stage& s) {
    const auto& b = sim.boundary;
    const double p = (boundaries::axial_stress(b, sim.loads()) + 2.0 * b.lateral_stress(sim.loads())) / 3.0;
    speed.yield(sim.drives, s, load_of_walls(sim.loads(), p, b.height(), b.radius(), b.volume(), speed.moving()),
                sim.dt());
}

} // namespace clast::protocol
