// SPDX-License-Identifier: MIT
// Pairs of pebbles that touch or may touch soon, with the history of their contact, and the rows that they write.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <clast/core/vector.hpp>

namespace clast {

/// What one contact or wall contact exerts in this step; bodies sum their rows in a fixed order.
struct force_row {
    vec3 force;              ///< on pebble i (N); pebble j takes the opposite
    vec3 point;              ///< where it acts (m)
    double dissipated = 0.0; ///< in this step (J)
    double depth = 0.0;      ///< overlap (m); 0: open, and the force is zero
};

struct pebble_pair {
    std::int32_t i; ///< i < j
    std::int32_t j;
    constexpr auto operator<=>(const pebble_pair&) const = default;
};

/// Half list sorted by (i, j). An empty history (frictionless law) takes no memory.
template <class History> struct contact_list {
    static constexpr bool remembers = !std::is_empty_v<History>;

    std::vector<pebble_pair> pairs;
    std::vector<History> history;     ///< empty if the law has none
    std::vector<std::uint8_t> bonded; ///< 1: an intact bond carries this pair and the contact is asleep
    std::vector<force_row> rows;

    std::size_t size() const { return pairs.size(); }
    void resize_rows() {
        rows.assign(pairs.size(), {});
        if constexpr (remembers) history.resize(pairs.size());
        bonded.assign(pairs.size(), 0);
    }
    /// Position of a pair, or size() if it is not listed.
    std::size_t find(const pebble_pair& p) const {
        const auto it = std::lower_bound(pairs.begin(), pairs.end(), p);
        return it != pairs.end() && *it == p ? static_cast<std::size_t>(it - pairs.begin()) : pairs.size();
    }

    template <class A> void archive(A& a) {
        a(pairs, bonded);
        if constexpr (remembers) a(history);
        rows.resize(pairs.size()); // written anew by the next step
    }
};

/// For every body the rows that act on it, in the order of the list: what makes sums independent of threads.
struct incidence {
    std::vector<std::uint32_t> start; ///< per body, plus the end
    std::vector<std::uint32_t> row;   ///< row << 1 | side; side 0: the body is i, 1: the body is j

    std::span<const std::uint32_t> of(std::size_t body) const {
        return {row.data() + start[body], row.data() + start[body + 1]};
    }

    /// n bodies; each_row(f) calls f(row, side, body) for all rows in order, twice in all.
    template <class Rows> void build(std::size_t n, Rows&& each_row) {
        start.assign(n + 1, 0);
        each_row([&](std::size_t, std::uint32_t, std::int32_t body) { ++start[static_cast<std::size_t>(body) + 1]; });
        for (std::size_t b = 0; b < n; ++b) start[b + 1] += start[b];
        row.resize(start[n]);
        std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
        each_row([&](std::size_t r, std::uint32_t side, std::int32_t body) {
            row[next[static_cast<std::size_t>(body)]++] = static_cast<std::uint32_t>(r) << 1 | side;
        });
    }

    template <class A> void archive(A& a) { a(start, row); }
};

} // namespace clast
