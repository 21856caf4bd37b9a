// SPDX-License-Identifier: MIT
// Pebbles as pictures show them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::measure {

/// Number for life of a pebble: bodies that are never cut have it for its place.
template <class Body> std::int32_t number_of_pebble(const Body& s, std::int32_t pebble) {
    if constexpr (requires { s.number_of_pebble(pebble); }) return s.number_of_pebble(pebble);
    return pebble;
}
/// The grain that a body was before it broke, by its number for life.
template <class Body> std::int32_t mother_of(const Body& s, std::size_t body) {
    if constexpr (requires { s.grains[body].origin; }) return s.grains[body].origin;
    return s.number_of(body);
}

/// Pebbles for pictures, brought up to date, by their numbers for life; displacement counts from their places in
/// `reference` (m, by the same numbers), and is 0 where that is empty.
template <class Engine> std::vector<pebble_view> pebbles_of(Engine& e, const std::vector<vec3>& reference) {
    e.place_all();
    const auto& s = e.grains;
    std::vector<pebble_view> out(s.pebble_count());
    for (std::size_t p = 0; p < out.size(); ++p) {
        const auto pebble = static_cast<std::int32_t>(p);
        const std::size_t g = s.group_of(pebble);
        const auto number = static_cast<std::size_t>(number_of_pebble(s, pebble));
        pebble_view& v = out[number];
        v.position = s.pebbles[p].x;
        v.radius = s.pebbles[p].radius;
        v.grain = mother_of(s, g);
        v.fragment = number_of_pebble(s, static_cast<std::int32_t>(s.pebbles_of(g).begin));
        v.velocity = s.velocity_of(pebble);
        if (!reference.empty()) v.displacement = s.pebbles[p].x - reference[number];
        e.breakage().describe(s, p, v);
    }
    return out;
}

} // namespace clast::measure
