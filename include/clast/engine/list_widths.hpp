// SPDX-License-Identifier: MIT
// How wide contact lists are made, learnt from what they have cost.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace clast {

/// Chooses two lengths (m): the skin of the contact lists, and the margin of the searches that they are picked from. Of
/// either, one cost falls with it and another grows, so that their sum is least where both are equal. Costs are counted
/// in evaluations of a pair, never timed: the same run has the same lists on any machine.
class list_widths {
  public:
    list_widths() = default;
    /// start: skin of the first lists (m), > 0.
    explicit list_widths(double start) : start_(start), skin_(start), margin_(50.0 * start) {}

    double skin() const { return skin_; }     ///< of the present lists (m)
    double margin() const { return margin_; } ///< largest gap of what the last search has found (m)

    /// What the work for lists grows with.
    struct counts {
        std::size_t bodies, pebbles;
    };
    /// The lists are to be renewed because a body has gone as far as it may.
    void skin_is_used_up() { skin_used_up_ = true; }
    /// The skin for the lists about to be made in a step: open pairs cost in every step and grow with the skin,
    /// renewals become rarer with it. Lists that are renewed for another reason have taught nothing.
    void choose_skin(const counts& of, std::int64_t step) {
        if (!std::exchange(skin_used_up_, false)) return;
        const double work = 4.0 * static_cast<double>(of.bodies) + 0.8 * static_cast<double>(of.pebbles); // measured
        const double steps = static_cast<double>(std::max<std::int64_t>(1, step - picked_at_));
        skin_ = better(skin_, work, steps * static_cast<double>(open_));
        skin_ = std::clamp(skin_, start_ / 64.0, 64.0 * start_);
    }
    /// A search is due because the last one does not name all pairs that are needed now.
    void margin_is_used_up() { margin_used_up_ = true; }
    /// The margin for the search about to be made: every renewal looks at the pairs within it, searches become rarer
    /// with it. most: what there is room for (m).
    void choose_margin(const counts& of, double most = std::numeric_limits<double>::infinity()) {
        if (std::exchange(margin_used_up_, false)) {
            // measured: a search takes as long as 20 evaluations per body and 5 per pebble, to look at a pair a seventh
            const double work = 20.0 * static_cast<double>(of.bodies) + 5.0 * static_cast<double>(of.pebbles);
            margin_ = better(margin_, work, 0.15 * static_cast<double>(left_out_) * static_cast<double>(picks_));
        }
        margin_ = std::max(skin_, std::min(std::clamp(margin_, 10.0 * skin_, 1000.0 * skin_), most));
        picks_ = 0;
    }
    /// Whether no lists have been picked since the last search.
    bool is_fresh() const { return picks_ == 0; }
    /// Lists have been picked in a step: so many pairs of them were open, so many found ones left out.
    void picked(std::int64_t step, std::size_t open, std::size_t left_out) {
        if (picks_++ == 0) left_out_ = left_out;
        picked_at_ = step;
        open_ = open;
    }

    template <class A> void archive(A& a) {
        a(start_, skin_, skin_used_up_, margin_, margin_used_up_, picked_at_, open_, picks_, left_out_);
    }

  private:
    /// A length nearer to the one at which both costs are equal, of which the first falls with it and the second grows.
    static double better(double length, double falls, double grows) {
        return length * std::clamp(std::sqrt(falls / std::max(1.0, grows)), 0.6, 1.6);
    }

    double start_ = 0.0, skin_ = 0.0, margin_ = 0.0;
    bool skin_used_up_ = false, margin_used_up_ = false;
    std::int64_t picked_at_ = 0; ///< step
    std::size_t open_ = 0;       ///< listed pairs that did not touch then
    std::int64_t picks_ = 0;     ///< since the last search
    std::size_t left_out_ = 0;   ///< pairs of the search that were not listed at first
};

} // namespace clast
