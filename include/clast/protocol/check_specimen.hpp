// SPDX-License-Identifier: MIT
// Whether the specimen of a test still is one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/stress.hpp>

namespace clast::protocol {

/// Throws run_error where a specimen is no longer one: a grain or a fragment is outside, or two pebbles are about to
/// pass each other (measure::passing_overlap). now: its contacts; stage: name of the one that runs; when(): text, asked
/// for if it throws.
template <class Engine, class When>
void check_specimen(const Engine& sim, const measure::contact_state& now, const std::string& stage, When&& when) {
    const auto& s = sim.grains;
    for (std::size_t p = 0; p < s.pebble_count(); ++p) {
        const auto pebble = static_cast<std::int32_t>(p);
        // whole grains are looked at by their centre, balls by their own
        const std::size_t owner = s.body_of(pebble);
        const bool whole = owner < s.body_count();
        if (whole && p != s.pebbles_of(owner).begin) continue;
        const vec3 x = sim.centre_of(pebble);
        // a small ball may be pressed through a wall by the large pebble behind it, and comes back
        if (!sim.boundary.outside(x, s.pebbles[p].radius) ||
            !sim.boundary.outside(x, measure::passing_overlap(sim, pebble)))
            continue;
        throw run_error(
            {fmt::format("grain {} escaped ({} of it)", s.number_of(s.group_of(pebble)), whole ? "all" : "a fragment"),
             fmt::format("stage '{}', at x = {:.4f}, y = {:.4f}, z = {:.4f} m", stage, x.x, x.y, x.z), when(),
             "the boundary left a gap as wide as a pebble, or it was overrun at a high stress",
             "use more rings or tiles, a lower stress or a smaller inertial number"});
    }
    if (now.passing < 1.0) return;
    using state = measure::contact_state;
    const double radius = measure::passing_overlap(sim, now.passing_i);
    if (now.passing_j >= 0) {
        const double overlap = now.passing * measure::passing_overlap(sim, now.passing_i, now.passing_j);
        throw run_error(
            {fmt::format("pebbles {} and {} overlap by {:.4g} mm", now.passing_i, now.passing_j, 1e3 * overlap),
             fmt::format("stage '{}', radii {:.4g} and {:.4g} mm", stage,
                         1e3 * s.pebbles[static_cast<std::size_t>(now.passing_i)].radius,
                         1e3 * s.pebbles[static_cast<std::size_t>(now.passing_j)].radius),
             when(), "contacts are soft against the stress: two centres are about to pass each other",
             "lower the stress or raise the contact stiffness"});
    }
    throw run_error(
        {fmt::format("pebble {} overlaps with {} by {:.4g} mm", now.passing_i,
                     now.passing_j == state::at_platen ? "a platen" : "the lateral wall", 1e3 * now.passing * radius),
         fmt::format("stage '{}', radius {:.4g} mm", stage,
                     1e3 * s.pebbles[static_cast<std::size_t>(now.passing_i)].radius),
         when(), "contacts are soft against the stress: a centre is behind the wall",
         "lower the stress or raise the contact stiffness"});
}

} // namespace clast::protocol
