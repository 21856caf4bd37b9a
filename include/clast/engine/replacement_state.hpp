// SPDX-License-Identifier: MIT
// What a scene holds for its replacement policy: what it remembers of grains, whom it wants to be asked about again,
// and the shapes of parts. `nothing_replaced` stands in where nothing is replaced: it is empty.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <clast/replacements/concepts.hpp>

namespace clast {

/// A clump that its policy wants, until the end of the step.
template <replacements::replacing R> struct marked_grain {
    std::int32_t grain = 0; ///< its place in the table of grains
    replacements::plan_of<R> plan{};
};

/// State that a scene has for a policy that replaces.
template <replacements::replacing R> struct replacement_state {
    using grain_state = replacements::grain_state_of<R>;
    static constexpr bool remembers = !std::is_empty_v<grain_state>;

    /// A grain about which the policy wants to be asked.
    struct appointment {
        std::int64_t step = 0; ///< at whose end
        std::int64_t grain = 0;
    };
    /// A run of pebbles of a shape, and the shape that was made of it.
    struct known_part {
        std::int32_t whole = 0, first = 0, count = 0, part = 0;
    };

    std::vector<grain_state> of_grain;   ///< empty if nothing is remembered
    std::vector<appointment> again;      ///< sorted by step, then grain
    std::vector<known_part> parts;       ///< in the order in which they were made
    std::vector<marked_grain<R>> marked; ///< empty between steps

    void begin(std::size_t grains) {
        if constexpr (remembers) of_grain.resize(grains);
    }
    void ask_again(std::int64_t step, std::int32_t grain) {
        const appointment one{step, grain};
        again.insert(std::upper_bound(again.begin(), again.end(), one, before), one);
    }
    /// Grains to be asked about at the end of this step, ascending; they are taken off the list.
    std::vector<std::int32_t> take_due(std::int64_t step) {
        std::vector<std::int32_t> due;
        std::size_t n = 0;
        for (; n < again.size() && again[n].step <= step; ++n) due.push_back(static_cast<std::int32_t>(again[n].grain));
        again.erase(again.begin(), again.begin() + static_cast<std::ptrdiff_t>(n));
        std::sort(due.begin(), due.end());
        return due;
    }
    /// Grain g has become `count` grains, which stand in its place: those behind it have moved up.
    void grain_was_split(std::size_t g, std::size_t count) {
        const auto up = static_cast<std::int32_t>(count) - 1, place = static_cast<std::int32_t>(g);
        for (appointment& a : again) a.grain += a.grain > place ? up : 0;
        for (marked_grain<R>& m : marked) m.grain += m.grain > place ? up : 0;
        if constexpr (remembers) {
            const grain_state own = of_grain[g];
            of_grain.insert(of_grain.begin() + static_cast<std::ptrdiff_t>(g) + 1, count - 1, own);
        }
    }

    template <class A> void archive(A& a) {
        if constexpr (remembers) a(of_grain);
        a(again, parts);
    }

  private:
    static bool before(const appointment& a, const appointment& b) {
        return std::pair(a.step, a.grain) < std::pair(b.step, b.grain);
    }
};

/// The same where nothing is replaced.
struct nothing_replaced {
    static constexpr void begin(std::size_t) {}
    template <class A> void archive(A&) {}
};

} // namespace clast
