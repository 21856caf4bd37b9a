// SPDX-License-Identifier: MIT
// Stages, sizes and rates of a test, as a runner takes them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/protocol/stage.hpp>

namespace clast {

/// Sizes and rates of a test. SI units.
struct test_plan {
    std::vector<stage> stages;
    double radius = 0.0;          ///< target apothem of the specimen (m)
    double height = 0.0;          ///< target height (m)
    double grain_diameter = 0.02; ///< d50 of Eq. 2 (m)
    double confining = 2e6;       ///< scale of stresses: target of the consolidation (Pa)
    /// Errors of stress are relative to the target, or to this part of `confining` where the target is less, 0
    /// included.
    double least_stress = 5e-4;
    double inertial_number = 1e-4;         ///< largest during loading (paper: 1e-4)
    double packing_inertial_number = 1e-3; ///< largest during preparation once grains touch, at p >= 1 % of confining
    double packing_rate_before_contact = 10.0; ///< times the shear rate, while hardly any grain touches another
    /// Below this inertial number at the stress at which walls give way, a specimen that is being compacted has jammed.
    double jammed_inertial_number = 5e-4;
    double consolidation_inertial_number = 1e-3; ///< largest of walls in consolidation, once a network carries
    double final_inertial_number = 1e-4;         ///< the same over the last part of the stress
    double consolidation_floor = 0.05;           ///< least p' in these numbers, in parts of the confining stress
    double final_share = 0.8;                    ///< part of the confining stress at which the last part begins
    double servo_gain = 0.5;
    double row_strain = 5e-4;      ///< axial strain between rows while strain is the clock
    std::int64_t row_steps = 2000; ///< steps between rows otherwise, and at most in any stage (x 10)
    std::int64_t look_every = 100; ///< steps between looks at conditions, escapes and requests to stop

    /// Of walls and grains at the confining stress, while hardly any grain touches another: not beyond what may be once
    /// they do, but where shear is faster.
    double inertial_number_in_flight() const {
        return std::min(packing_rate_before_contact * inertial_number,
                        std::max(packing_inertial_number, inertial_number));
    }
};

namespace protocol {

/// Makes a drive that counts in parts of the setup one of its own. size: target of its axis (m).
inline void take_from_setup(axis_drive& a, const test_plan& plan, double size) {
    if (!a.of_setup) return;
    using kind = axis_drive::kind;
    a.value *= a.how == kind::reach      ? size
               : a.how == kind::stress   ? plan.confining
               : a.how == kind::inertial ? plan.inertial_number
                                         : 1.0;
    a.of_setup = false;
}
/// Throws input_error where a stage waits for an axial strain and its platens go the other way. start: strain that it
/// begins with.
inline void check_direction(const stage& s, double start) {
    using kind = axis_drive::kind;
    if (!s.end.needed_strain || (s.axial.how != kind::rate && s.axial.how != kind::inertial)) return;
    const double way = *s.end.needed_strain - start;
    if (way * s.axial.value >= 0.0) return;
    throw input_error(fmt::format("stage '{}'", s.name),
                      fmt::format("{} from {:g} % on, with platens that {} it", s.end.text, 100.0 * start,
                                  s.axial.value > 0.0 ? "shorten" : "lengthen"),
                      "a drive towards that strain (shortening is positive)",
                      "Change the sign of the rate, or of the strain.");
}
/// Throws input_error where an axis of a stage is driven by what it cannot be. three_axes: whether the boundary can
/// drive the walls normal to y apart.
inline void check_drives(const stage& s, bool three_axes) {
    using kind = axis_drive::kind;
    const auto refuse = [&s](const char* axis, const char* how, const char* allowed, const char* way_out) {
        throw input_error(fmt::format("stage '{}', {}", s.name, axis), how, allowed, way_out);
    };
    const auto aims = [&](const char* axis, const axis_drive& a) {
        if (a.how == kind::follow && !a.target)
            refuse(axis, "follows nothing", "a function of the specimen", "Use drive_by::stress_that(function).");
    };
    aims("axial", s.axial), aims("lateral", s.lateral);
    if (s.axial.how == kind::volume)
        refuse("axial", "constant volume", "the lateral wall", "Give `lateral` drive_by::constant_volume().");
    if (!s.lateral_y) return;
    aims("lateral_y", *s.lateral_y);
    if (!three_axes)
        refuse("lateral_y", "a drive of its own", "none, at this boundary",
               "Take boundaries::box for three driven axes.");
    if (s.lateral_y->how != kind::stress && s.lateral_y->how != kind::follow)
        refuse("lateral_y", "another drive", "a stress", "Use drive_by::stress or drive_by::stress_that.");
    if (s.lateral.how != kind::stress && s.lateral.how != kind::follow)
        refuse("lateral", "another drive beside lateral_y", "a stress",
               "Use drive_by::stress or drive_by::stress_that.");
}
/// Whether a function of a view answers otherwise after it has seen other states: then it keeps something that no
/// checkpoint would save, by a reference or a pointer. Asked for states on a way up, and for the same on the way down,
/// with fresh numbers of its own (memory: how many) each time.
template <class Answer> bool remembers(const view_function<Answer>& f, std::size_t memory) {
    if (!f) return false;
    constexpr int states = 12;
    const auto ask = [&](int k) {
        stage_view v;
        v.axial_strain = 0.02 * k, v.volumetric_strain = 0.01 * k;
        v.q = 1e5 * k, v.p = 1e5 * k + 1e5, v.sigma_3 = 1e5, v.sigma_2 = 1.5e5, v.sigma_1 = 1e5 * k + 1e5;
        v.unbalanced_ratio = 0.1 * k, v.sphere_stress = 1e3 * k, v.mean_contact_force = 10.0 * k;
        v.coordination = 0.5 * k, v.kinetic_density = 0.1 * k;
        v.axial_error = v.confining_error = 0.01 * k, v.travel_left = 0.08 * k;
        v.steps = 1000 * k, v.time = 0.01 * k;
        v.confining = 1e5, v.grain_diameter = 0.02;
        std::vector<double> numbers(memory);
        v.memory = numbers;
        return f(v);
    };
    std::vector<Answer> up;
    for (int k = 0; k < states; ++k) up.push_back(ask(k));
    for (int k = states; k-- > 0;) {
        const Answer again = ask(k), before = up[static_cast<std::size_t>(k)];
        if (again != before && (again == again || before == before)) return true; // NaN is like NaN
    }
    return false;
}
/// Throws input_error where a condition or a target of a stage keeps a state of its own.
inline void check_memory(const stage& s) {
    const auto refuse = [&s](const std::string& what) {
        throw input_error(fmt::format("stage '{}'", s.name),
                          fmt::format("{} that remembers what it has seen, by a reference or a pointer", what),
                          "a function of what it is shown, and of its stage_view::memory, which checkpoints save",
                          "Keep numbers in stage_view::memory, and say how many in condition::memory.");
    };
    if (remembers(s.end.met, s.end.memory) || remembers(s.end.progress, s.end.memory))
        refuse(fmt::format("a condition ('{}')", s.end.text));
    if (remembers(s.axial.target, 0) || remembers(s.lateral.target, 0) ||
        (s.lateral_y && remembers(s.lateral_y->target, 0)))
        refuse("a target");
}
/// The plan with drives in SI units alone. Throws input_error where it has no stage, drives that
/// cannot be, or functions that keep a state of their own.
inline test_plan completed(test_plan plan, bool three_axes) {
    if (plan.stages.empty())
        throw input_error("protocol", "no stages", "at least one stage", "Add a stage to the plan.");
    for (stage& s : plan.stages) {
        take_from_setup(s.axial, plan, plan.height);
        take_from_setup(s.lateral, plan, plan.radius);
        if (s.lateral_y) take_from_setup(*s.lateral_y, plan, plan.radius);
        check_drives(s, three_axes);
        check_memory(s);
    }
    return plan;
}

} // namespace protocol

} // namespace clast
