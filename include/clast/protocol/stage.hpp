// SPDX-License-Identifier: MIT
// A test protocol as data: a list of stages, each with what drives the two axes and when it ends.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/core/quantity.hpp>

namespace clast {

/// What a condition may look at. Strains, stresses, steps and time are those of now; what costs more to find is that of
/// the last look (test_plan::look_every), never by the clock.
struct stage_view {
    double axial_strain = 0.0;      ///< since the reference state
    double strain_at_start = 0.0;   ///< the same at the start of the stage
    double volumetric_strain = 0.0; ///< compression positive
    double q = 0.0;                 ///< of the laboratory, boundaries/axial.hpp (Pa); see protocol/path_stress.hpp
    double p = 0.0;                 ///< sigma_3 + q / 3 (Pa)
    double sigma_1 = 0.0;           ///< axial (Pa)
    double sigma_2 = 0.0;           ///< lateral: of the y walls of a box that is driven along three axes, else sigma_3
    double sigma_3 = 0.0;           ///< lateral (Pa)
    double unbalanced_ratio = 1.0;
    double sphere_stress = 0.0;      ///< largest |p'| in the three measurement spheres (Pa)
    double mean_contact_force = 0.0; ///< N
    double coordination = 0.0;       ///< touching neighbours per body; below 1 there is no network that carries
    double kinetic_density = 0.0;    ///< kinetic energy over the volume of the specimen (Pa)
    double axial_error = 0.0; ///< |sigma_1 - target| / target (test_plan::least_stress at least) under stress control
    double confining_error = 0.0; ///< the same of sigma_3 under lateral stress control
    double travel_left = 0.0;     ///< share of the way that `reach` axes still have to go, 1 to 0
    std::int64_t steps = 0;       ///< in this stage
    double time = 0.0;            ///< in this stage (s)
    double confining = 0.0;       ///< what the setup says (Pa)
    double grain_diameter = 0.0;  ///< likewise (m)
    /// What the condition keeps through the stage, as many numbers as its `memory` says: 0 at the start of the stage,
    /// its own to change, saved with checkpoints.
    std::span<double> memory{};

    /// Force of the setup: its confining stress on the square of a grain's diameter (N).
    double grain_force() const { return confining * grain_diameter * grain_diameter; }

    template <class A> void archive(A& a) {
        a(axial_strain, strain_at_start, volumetric_strain, q, p, sigma_1, sigma_2, sigma_3, unbalanced_ratio,
          sphere_stress, mean_contact_force, coordination, kinetic_density, axial_error, confining_error, travel_left,
          steps, time, confining, grain_diameter);
    }
};

/// A function of a stage_view that keeps no state of its own: no checkpoint would save it, and a test that was stopped
/// would go on as another one. State belongs into stage_view::memory.
template <class Answer> class view_function {
  public:
    view_function() = default;
    template <class F>
    requires(!std::same_as<F, view_function> && std::is_invocable_r_v<Answer, F&, const stage_view&>)
        view_function(F f) // NOLINT: a lambda is a condition
        : of_(std::move(f)) {
        static_assert(
            std::is_invocable_r_v<Answer, const F&, const stage_view&>,
            "a condition keeps no state of its own (a mutable lambda), which no checkpoint would save: let it "
            "keep numbers in stage_view::memory, and say how many in condition::memory");
    }
    Answer operator()(const stage_view& v) const { return of_(v); }
    explicit operator bool() const { return static_cast<bool>(of_); }

  private:
    std::function<Answer(const stage_view&)> of_;
};

/// What one axis of the specimen (axial: both platens; lateral: the wall) does during a stage.
struct axis_drive {
    enum class kind {
        hold,     ///< stay
        rate,     ///< strain rate `value` (1/s), compression positive
        inertial, ///< strain rate at which the inertial number (paper Eq. 2) is |value|; negative: extension
        stress,   ///< servo to the stress `value` (Pa)
        reach,    ///< move to the size `value` (m: height, or apothem) at the stage's packing rate, then hold
        follow,   ///< servo to the stress that `target` says of the specimen (Pa), asked after every step
        volume    ///< lateral: give way so that the specimen keeps the volume with which the stage began
    };
    kind how = kind::hold;
    double value = 0.0;
    bool of_setup = false; ///< value counts in what the setup of the test says: its size, confining stress or I
    /// Of `follow`: a stress from strains and stresses of now, the rest of the view as of the last look; below 0 it
    /// counts as 0.
    view_function<double> target{};
};

namespace drive_by {
inline axis_drive hold() { return {}; }
inline axis_drive strain_rate(quantities::rate rate) { return {axis_drive::kind::rate, rate.si()}; }
inline axis_drive inertial_number(double i) { return {axis_drive::kind::inertial, i}; }
inline axis_drive stress(quantities::stress s) { return {axis_drive::kind::stress, s.si()}; }
inline axis_drive size(quantities::length l) { return {axis_drive::kind::reach, l.si()}; }
/// In parts of what the setup says (negative: extension): its inertial number, confining stress, height or radius.
inline axis_drive inertial_number_of_setup(double part = 1.0) { return {axis_drive::kind::inertial, part, true}; }
inline axis_drive stress_of_setup(double part = 1.0) { return {axis_drive::kind::stress, part, true}; }
inline axis_drive size_of_setup(double part = 1.0) { return {axis_drive::kind::reach, part, true}; }
/// A stress (Pa) that is a function of the specimen: of its other stresses, for a path in the plane of p and q.
inline axis_drive stress_that(view_function<double> target) {
    return {axis_drive::kind::follow, 0.0, false, std::move(target)};
}
/// Of the lateral wall: the volume stays what it was when the stage began, whatever the platens do.
inline axis_drive constant_volume() { return {axis_drive::kind::volume}; }
} // namespace drive_by

/// When a stage ends, in words and as a function; `progress` in [0, 1] feeds the progress bar.
struct condition {
    std::string text;
    view_function<bool> met;
    view_function<double> progress;
    /// How many numbers it keeps in stage_view::memory. Met is asked once for a state, in the order of the steps.
    std::size_t memory = 0;
    /// Axial strain without which it is not met, if there is one: a stage that goes the other way is refused.
    std::optional<double> needed_strain{};
    /// Whether it is asked after every step: then a stage ends in the first step in which it is met. Off where it reads
    /// only what a look finds.
    bool every_step = true;
    /// Of conditions that are met in several ways: in which, in words.
    std::function<std::string(const stage_view&)> way{};

    /// What was met, in words.
    std::string reason(const stage_view& v) const { return way ? way(v) : text; }
};

namespace detail {
/// One text and one pair of functions for both operators: what they would capture apart costs time to compile.
inline condition join(condition a, condition b, bool both) {
    const auto own = [first = a.memory](const auto& f, bool second, const stage_view& v) {
        if (v.memory.empty()) return f(v);
        stage_view part = v; // each keeps its own numbers
        part.memory = second ? v.memory.subspan(first) : v.memory.first(first);
        return f(part);
    };
    condition c;
    c.memory = a.memory + b.memory;
    c.text = a.text + (both ? " and " : " or ") + b.text;
    if (both) c.needed_strain = a.needed_strain ? a.needed_strain : b.needed_strain;
    c.every_step = a.every_step || b.every_step;
    if (!both || a.way || b.way)
        c.way = [a, b, both, own](const stage_view& v) {
            const auto reason = [](const condition& of) {
                return [&of](const stage_view& part) { return of.reason(part); };
            };
            if (both) return own(reason(a), false, v) + " and " + own(reason(b), true, v);
            return own(a.met, false, v) ? own(reason(a), false, v) : own(reason(b), true, v);
        };
    c.met = [a = std::move(a.met), b = std::move(b.met), both, own](const stage_view& v) {
        const bool one = own(a, false, v), other = own(b, true, v); // both are asked: they may keep numbers
        return both ? one && other : one || other;
    };
    c.progress = [a = std::move(a.progress), b = std::move(b.progress), both, own](const stage_view& v) {
        const double one = own(a, false, v), other = own(b, true, v);
        return both ? std::min(one, other) : std::max(one, other);
    };
    return c;
}
} // namespace detail

/// Both; progress of the slower.
inline condition operator&&(condition a, condition b) { return detail::join(std::move(a), std::move(b), true); }
/// Either; progress of the faster.
inline condition operator||(condition a, condition b) { return detail::join(std::move(a), std::move(b), false); }

/// Conditions in words of the field: `until::axial_strain(25 * percent)`.
namespace until {
namespace detail {
/// One that only looks can decide.
inline condition at_looks(condition c) {
    c.every_step = false;
    return c;
}
/// Progress of a quantity that falls over decades towards a limit.
inline double falling(double now, double limit) {
    return now <= limit ? 1.0 : std::clamp(1.0 + std::log10(limit / now) / 4.0, 0.0, 0.99);
}
} // namespace detail
/// The axial strain has reached a value, from the side on which the stage began: shortening positive, so a specimen
/// that is extended comes to a negative one, or back to a smaller one, from above.
inline condition axial_strain(quantities::ratio ratio) {
    const double strain = ratio.si();
    condition c{fmt::format("axial strain {:g} %", 100.0 * strain),
                [strain](const stage_view& v) {
                    return strain >= v.strain_at_start ? v.axial_strain >= strain : v.axial_strain <= strain;
                },
                [strain](const stage_view& v) {
                    const double way = strain - v.strain_at_start;
                    return way != 0.0 ? std::clamp((v.axial_strain - v.strain_at_start) / way, 0.0, 1.0) : 1.0;
                }};
    c.needed_strain = strain;
    return c;
}
/// q falls to the given value or below, as in unloading.
inline condition deviator_below(quantities::stress q) {
    const double limit = q.si();
    return {fmt::format("q <= {:g} kPa", 1e-3 * limit), [limit](const stage_view& v) { return v.q <= limit; },
            [limit](const stage_view& v) { return detail::falling(v.q, limit); }};
}
/// q is above the given value or at it, as in loading.
inline condition deviator_above(quantities::stress q) {
    const double limit = q.si();
    return {fmt::format("q >= {:g} kPa", 1e-3 * limit), [limit](const stage_view& v) { return v.q >= limit; },
            [limit](const stage_view& v) { return limit > 0.0 ? std::clamp(v.q / limit, 0.0, 1.0) : 0.0; }};
}
/// The axial stress is the given value or above it.
inline condition axial_stress_above(quantities::stress sigma_1) {
    const double limit = sigma_1.si();
    return {fmt::format("sigma_1 >= {:g} kPa", 1e-3 * limit),
            [limit](const stage_view& v) { return v.sigma_1 >= limit; },
            [limit](const stage_view& v) { return limit > 0.0 ? std::clamp(v.sigma_1 / limit, 0.0, 1.0) : 0.0; }};
}
/// q has fallen from its largest value in this stage by a share of that, `drop` in (0, 1): the peak is past. A peak of
/// less than a tenth of the confining stress of the setup is none. Steps scatter: a drop of a few per cent at least.
inline condition peak_passed(quantities::ratio drop) {
    const double share = drop.si();
    const auto fallen = [](const stage_view& v) { // part of the peak
        const double peak = v.memory[0];
        return peak > 0.1 * v.confining ? (peak - v.q) / peak : 0.0;
    };
    return {.text = fmt::format("q {:g} % below its peak", 100.0 * share),
            .met =
                [share, fallen](const stage_view& v) {
                    v.memory[0] = std::max(v.memory[0], v.q);
                    return fallen(v) >= share;
                },
            .progress = [share, fallen](const stage_view& v) { return std::clamp(fallen(v) / share, 0.0, 1.0); },
            .memory = 1};
}
/// Both `reach` axes have arrived.
inline condition size_reached() {
    return detail::at_looks({"target size", [](const stage_view& v) { return v.travel_left <= 0.0; },
                             [](const stage_view& v) { return 1.0 - v.travel_left; }});
}
/// Largest unbalanced force over the mean sum of contact forces below the limit.
inline condition unbalanced_below(double ratio) {
    return detail::at_looks({fmt::format("unbalanced ratio < {:g} %", 100.0 * ratio),
                             [ratio](const stage_view& v) { return v.unbalanced_ratio < ratio; },
                             [ratio](const stage_view& v) { return detail::falling(v.unbalanced_ratio, ratio); }});
}
/// Mean stress below the limit in all three measurement spheres (paper section 2.3: 1 kPa).
inline condition spheres_below(quantities::stress p) {
    const double limit = p.si();
    return detail::at_looks({fmt::format("p' < {:g} kPa in three spheres", 1e-3 * limit),
                             [limit](const stage_view& v) { return v.sphere_stress < limit; },
                             [limit](const stage_view& v) { return detail::falling(v.sphere_stress, limit); }});
}
/// The same in parts of the confining stress of the setup: the paper's 1 kPa is 5e-4 of its 2 MPa.
inline condition spheres_below_of_setup(double part) {
    return detail::at_looks(
        {fmt::format("p' < {:g} % of the confining stress in three spheres", 100.0 * part),
         [part](const stage_view& v) { return v.sphere_stress < part * v.confining; },
         [part](const stage_view& v) { return detail::falling(v.sphere_stress, part * v.confining); }});
}
/// No load worth the name: mean contact force below `force`, after a thousand steps. The way out where the unbalanced
/// ratio becomes 0/0 in an unjammed specimen.
inline condition unloaded(quantities::force force) {
    const double limit = force.si();
    return detail::at_looks({fmt::format("mean contact force < {:g} N", limit),
                             [limit](const stage_view& v) { return v.mean_contact_force < limit && v.steps > 1000; },
                             [limit](const stage_view& v) { return detail::falling(v.mean_contact_force, limit); }});
}
/// The same in parts of the force of the setup, its confining stress on the square of a grain's diameter: 800 N with
/// 2 MPa and 20 mm.
inline condition unloaded_of_setup(double part) {
    return detail::at_looks(
        {fmt::format("mean contact force < {:g} % of sigma_3 d^2", 100.0 * part),
         [part](const stage_view& v) { return v.mean_contact_force < part * v.grain_force() && v.steps > 1000; },
         [part](const stage_view& v) { return detail::falling(v.mean_contact_force, part * v.grain_force()); }});
}
/// Fewer touching neighbours per body than a network has that carries something.
inline condition coordination_below(double z) {
    return detail::at_looks({fmt::format("coordination < {:g}", z),
                             [z](const stage_view& v) { return v.coordination < z; },
                             [z](const stage_view& v) { return detail::falling(v.coordination, z); }});
}
/// Kinetic energy per volume, in parts of the confining stress of the setup, below the limit.
inline condition kinetic_below_of_setup(double part) {
    return detail::at_looks(
        {fmt::format("kinetic energy per volume < {:g} of the confining stress", part),
         [part](const stage_view& v) { return v.kinetic_density < part * v.confining; },
         [part](const stage_view& v) { return detail::falling(v.kinetic_density, part * v.confining); }});
}
/// Servo-controlled stresses within the tolerance of their targets.
inline condition stresses_within(double tolerance) {
    return detail::at_looks(
        {fmt::format("stress error < {:g} %", 100.0 * tolerance),
         [tolerance](const stage_view& v) { return v.axial_error < tolerance && v.confining_error < tolerance; },
         [tolerance](const stage_view& v) {
             return detail::falling(std::max(v.axial_error, v.confining_error), tolerance);
         }});
}
inline condition steps(std::int64_t n) {
    return {fmt::format("{} steps", n), [n](const stage_view& v) { return v.steps >= n; },
            [n](const stage_view& v) { return std::min(1.0, static_cast<double>(v.steps) / static_cast<double>(n)); }};
}
} // namespace until

/// One stage of a test.
struct stage {
    std::string name;
    axis_drive axial{};
    axis_drive lateral{};
    condition end;
    /// Of the walls normal to y, where the boundary can drive them apart (box): `stress` or `follow`. Without it they
    /// do what `lateral` says.
    std::optional<axis_drive> lateral_y{};
    std::int64_t most_steps = 2'000'000; ///< a stage that has not ended by then stops the run
    bool breakage = true;                ///< whether clumps may be replaced in this stage
    bool reference_here = false;         ///< strains, displacements and e0 count from the start of this stage
    bool membrane_here = false;          ///< the preparation vessel becomes the membrane at the start of this stage
    bool moves_grains = false; ///< while they carry nothing, grains move with the walls, as a uniform strain would have
    bool from_rest = false;    ///< grains stop where the stage begins
    /// Stress at which axes that go to a size give way, in parts of the confining stress of the setup; 0: they do not.
    double yields_at = 0.0;
    bool yields_back = false;   ///< also beyond the size that they have reached
    bool walls_at_rest = false; ///< walls under servo control keep to the inertial numbers of consolidation
    bool hands_over = false; ///< it begins with grains at rest, whose contacts remember nothing (protocol/prepared.hpp)
    double friction = -1.0;  ///< pebble friction in this stage; negative: that of the material
    bool keeps_friction = false; ///< it begins with the friction that the stage before has ended with
    /// Frictions to try where the specimen has come to rest, or jammed, short of `end`: from the first that is below
    /// the present one on, one after the other.
    std::vector<double> then_friction{};
    /// Ends, short of `end` and saying so, where nothing changes any more while stresses and forces are within 1 %;
    /// where they are not, the run stops with an error.
    bool ends_at_standstill = false;
    double row_density = 1.0;     ///< rows of a stage whose clock is strain over those that the plan asks for
    bool give_up_gently = false;  ///< having tried all, go on with the next stage instead of stopping
    bool skip_if_relaxed = false; ///< leave out where the stage before reached its end by itself
    std::string if_stuck = "Raise `most_steps`, or loosen the condition."; ///< advice where it does not end
};

} // namespace clast
