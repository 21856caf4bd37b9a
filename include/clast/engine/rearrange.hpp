// SPDX-License-Identifier: MIT
// Pebbles of one grain exchange places in the tables, so that those of a part of it stand together. Rare, so nothing
// here is meant to be fast; what is common, lists and bodies that rely on runs of pebbles, pays nothing for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <clast/bodies/contact_list.hpp>
#include <clast/contacts/concepts.hpp>
#include <clast/engine/scene.hpp>

namespace clast::rooms {

/// The opposite row: as pebble j would have it if it were called i.
inline force_row reversed(force_row row) {
    row.force = -row.force, row.normal = -row.normal;
    return row;
}

/// The pebble of grain g that stands at order[k], counted from its first, stands at k from now on, as long as they are
/// balls: what tables say of pebbles and balls goes with them, and pairs and rows name their new places. A pair whose
/// second pebble now stands before its first is turned round, with what it remembers (contacts::reversed). Lists are to
/// be sorted again. `order` names each pebble of the grain once; of its bonds nothing is known here, so it has none.
template <class S> void rearrange(S& s, std::size_t g, std::span<const std::int32_t> order) {
    auto& grains = s.grains;
    const std::int32_t first = grains.grains[g].first, count = static_cast<std::int32_t>(order.size());
    std::vector<std::int32_t> place(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) place[s.at(order[k])] = static_cast<std::int32_t>(k);
    const auto permute = [&](auto& table, std::size_t from) {
        const std::vector was(table.begin() + static_cast<std::ptrdiff_t>(from),
                              table.begin() + static_cast<std::ptrdiff_t>(from + order.size()));
        for (std::size_t k = 0; k < order.size(); ++k) table[from + k] = was[s.at(order[k])];
    };
    if (grains.numbers.empty()) {
        grains.numbers.resize(grains.pebble_count());
        std::iota(grains.numbers.begin(), grains.numbers.end(), 0);
    }
    permute(grains.pebbles, s.at(first)), permute(grains.numbers, s.at(first));
    permute(grains.motion, grains.ball(first)), permute(grains.losses, grains.ball(first));
    if (grains.materials.size() == grains.pebble_count()) permute(grains.materials, s.at(first));

    const auto now = [&](std::int32_t& p) {
        if (first <= p && p < first + count) p = first + place[s.at(p - first)];
    };
    const auto rename = [&](contact_list<typename S::history>& list) {
        for (std::size_t k = 0; k < list.size(); ++k) {
            pebble_pair& p = list.pairs[k];
            now(p.i), now(p.j);
            if (p.i < p.j) continue; // also of two grains, which stand in their order
            std::swap(p.i, p.j);
            if constexpr (contact_list<typename S::history>::remembers)
                list.history[k] = contacts::reversed(list.history[k]);
            if (!list.rows.empty()) list.rows[k] = reversed(list.rows[k]);
        }
    };
    rename(s.heavy), rename(s.light);
    for (auto* wall : {&s.heavy_wall, &s.light_wall})
        for (auto& row : *wall) now(row.pebble);
}

} // namespace clast::rooms
