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
/// pass each other. deepest: of its contacts now; stage: name of the one that runs; when(): text, asked for if it
/// throws.
template <class Engine, class When>
void check_specimen(const Engine& sim, const measure::contact_state& deepest, const std::string& stage, When&& when) {
    const auto& s = sim.grains;
    for (std::size_t p = 0; p < s.pebble_count(); ++p) {
        const auto pebble = static_cast<std::int32_t>(p);
        // whole grains are looked at by their centre, balls by their own
        const std::size_t owner = s.body_of(pebble);
        const bool whole = owner < s.body_count();
        if (whole && p != s.pebbles_of(owner).begin) continue;
        const vec3 x = sim.centre_of(pebble);
        if (!sim.boundary.outside(x, s.pebbles[p].radius)) continue;
        throw run_error(
            {fmt::format("grain {} escaped ({} of it)", s.number_of(s.group_of(pebble)), whole ? "all" : "a fragment"),
             fmt::format("stage '{}', at x = {:.4f}, y = {:.4f}, z = {:.4f} m", stage, x.x, x.y, x.z), when(),
             "the boundary left a gap as wide as a pebble, or it was overrun at a high stress",
             "use more rings or tiles, a lower stress or a smaller inertial number"});
    }
    if (deepest.max_overlap_over_r >= 1.0)
        throw run_error({fmt::format("pebbles {} and {} overlap by {:.2f} of the smaller radius", deepest.deepest_i,
                                     deepest.deepest_j, deepest.max_overlap_over_r),
                         fmt::format("stage '{}'", stage), when(),
                         "contacts are soft against the stress: two centres are about to pass each other",
                         "lower the stress or raise the contact stiffness"});
}

} // namespace clast::protocol
