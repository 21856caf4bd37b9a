// SPDX-License-Identifier: MIT
// The parameters of an engine that are values, and what they may be.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include <fmt/core.h>

#include <clast/contacts/concepts.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/parallel.hpp>

namespace clast {

/// How balls and clusters of a breakable scene are stepped beside clumps. Where nothing is replaced all are the same.
///
/// Sub-steps are cheap, because a replacement does not shrink the step of the specimen, but they make energy: noise
/// grows wherever a ball takes two of them, or a cluster two steps of its bonds, and only local damping holds it. One
/// step for all, the smallest that any body or bond allows, is a leapfrog of the whole and makes none.
enum class stepping : std::uint8_t {
    automatic, ///< sub-steps where they have been found stable (sub_steps_are_stable), else one step (default)
    sub_steps, ///< refused where they have not
    one_step
};

/// Parameters of an engine that are values, not types. SI units.
template <class P> struct engine_settings {
    typename P::contact grain_contact;   ///< pebble against pebble
    typename P::contact platen_contact;  ///< pebble against platen
    typename P::contact lateral_contact; ///< pebble against the lateral wall
    typename P::breakage breakage;
    typename P::replacement replacement;
    typename P::scheme scheme{};                 ///< how bodies go on, and local damping
    double safety = 0.8;                         ///< of the time-step estimate, in (0, 1]
    stepping light_bodies = stepping::automatic; ///< balls and clusters beside clumps
    double skin = 0.0; ///< m: where the skin of the lists starts; 0: from the size of the grains
    /// s: bound of the time step beside that of contacts, for what these do not tell: a stiff field, a scheme with a
    /// limit of its own. Above 0; infinite, which is none, where bodies and the law of the grains give a finite step.
    double largest_step = std::numeric_limits<double>::infinity();
    /// Of the smallest radius: least overlap at which a law is asked for its stiffness where nothing touches.
    double expected_overlap = 1e-4;
    execution run = execution(1);
    std::size_t contacts_per_thread = 256; ///< a sweep with fewer is left to fewer threads; the bits are the same
    [[no_unique_address]] typename P::field field{}; ///< on every body; like damping not part of a checkpoint
};

/// Least local damping at which, and highest safety up to which, sub-steps of light bodies have been found to let noise
/// die out, with a margin (examples/manual/engine.md has the map).
inline constexpr double least_damping_of_sub_steps = 0.3, highest_safety_of_sub_steps = 0.8;

/// Whether damping is strong enough, and steps are short enough, for sub-steps of light bodies.
template <class P> bool sub_steps_are_stable(const engine_settings<P>& s) {
    if constexpr (requires { s.scheme.damping; })
        return s.scheme.damping >= least_damping_of_sub_steps && s.safety <= highest_safety_of_sub_steps;
    return false;
}
/// Throws input_error where sub-steps are asked for that are not stable.
template <class P> void check_stepping(const engine_settings<P>& s) {
    if (s.light_bodies != stepping::sub_steps || sub_steps_are_stable(s)) return;
    throw input_error("engine_settings.light_bodies", "stepping::sub_steps",
                      fmt::format("with damping >= {:g} and safety <= {:g}: with less damping they make energy",
                                  least_damping_of_sub_steps, highest_safety_of_sub_steps),
                      "Leave it automatic: all bodies go by one step then.");
}
/// Whether light bodies take sub-steps, by the present settings.
template <class P> bool takes_sub_steps(const engine_settings<P>& s) {
    check_stepping(s);
    return s.light_bodies != stepping::one_step && sub_steps_are_stable(s);
}

/// Throws input_error, naming the member, where a setting makes no sense. density: of the bodies (kg/m^3).
template <class P> void check(const engine_settings<P>& s, double density) {
    const auto demand = [](bool good, const char* name, double value, const char* allowed, const char* way_out) {
        if (!good) throw input_error(name, fmt::format("{:g}", value), allowed, way_out);
    };
    demand(s.safety > 0.0 && s.safety <= 1.0, "engine_settings.safety", s.safety, "above 0, at most 1",
           "0.8 is the default; above 1 a step may be unstable.");
    if constexpr (requires { s.scheme.damping; })
        demand(s.scheme.damping >= 0.0 && s.scheme.damping < 1.0, "engine_settings.scheme.damping", s.scheme.damping,
               "0 to below 1", "0.7 is the default; 0 takes nothing.");
    check_stepping(s);
    demand(s.skin >= 0.0 && std::isfinite(s.skin), "engine_settings.skin", s.skin, ">= 0 m",
           "0 takes it from the size of the grains.");
    demand(s.largest_step > 0.0, "engine_settings.largest_step", s.largest_step, "> 0 s",
           "Leave it out: contacts set the step.");
    demand(s.expected_overlap > 0.0 && s.expected_overlap < 1.0, "engine_settings.expected_overlap", s.expected_overlap,
           "above 0, below 1", "1e-4 of the smallest radius is the default.");
    const auto law = [&](const typename P::contact& one, const char* name) {
        if constexpr (contacts::frictional<typename P::contact>)
            demand(one.mu >= 0.0 && std::isfinite(one.mu), name, one.mu, ">= 0, finite", "The paper uses 0.3.");
    };
    law(s.grain_contact, "engine_settings.grain_contact.mu");
    law(s.platen_contact, "engine_settings.platen_contact.mu");
    law(s.lateral_contact, "engine_settings.lateral_contact.mu");
    demand(density > 0.0 && std::isfinite(density), "density of the bodies", density, "> 0 kg/m^3",
           "2650 kg/m^3 is that of quartz.");
}

} // namespace clast
