// SPDX-License-Identifier: MIT
// Pebbles as pictures show them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::measure {

/// Pebbles for pictures, brought up to date; displacement counts from their places in `reference` (m, per pebble), and
/// is 0 where that is empty.
template <class Engine> std::vector<pebble_view> pebbles_of(Engine& e, const std::vector<vec3>& reference) {
    e.place_all();
    const auto& s = e.grains;
    std::vector<pebble_view> out(s.pebble_count());
    for (std::size_t p = 0; p < out.size(); ++p) {
        const auto pebble = static_cast<std::int32_t>(p);
        const std::size_t g = s.group_of(pebble);
        pebble_view& v = out[p];
        v.position = s.pebbles[p].x;
        v.radius = s.pebbles[p].radius;
        v.grain = s.number_of(g);
        v.fragment = static_cast<std::int32_t>(s.pebbles_of(g).begin);
        v.velocity = s.velocity_of(pebble);
        if (!reference.empty()) v.displacement = s.pebbles[p].x - reference[p];
        e.breakage().describe(s, p, v);
    }
    return out;
}

} // namespace clast::measure
