// SPDX-License-Identifier: MIT
// Whether anything still changes in a specimen that waits for a condition.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/measure/sample.hpp>
#include <clast/protocol/stage.hpp>

namespace clast::protocol {

/// Sees that a specimen stands still: over `span` steps nothing that a stage waits for has changed. Walls that turn
/// round in every step, or cycles that no look shows, are such a state.
class standstill {
  public:
    /// What is looked at: mean stresses of both axes (Pa), unbalanced ratio, volume (m^3).
    using state = std::array<double, 4>;

    /// Steps over which nothing may have changed.
    static constexpr std::int64_t span = 20'000;
    /// The largest change that is none, in parts of: scale of stress, of stress, 1, the volume. Stress that creeps at
    /// this rate needs 100 000 steps for a tolerance of 0.1 %; forces of the few grains that walls stir flicker.
    static constexpr state nothing{2e-4, 2e-4, 5e-3, 2e-5};

    /// A look at a stage. volume: of the specimen (m^3). Whether it has stood still for `span` steps.
    bool look(const stage_view& v, double volume) {
        return look(v.steps, {v.p + 2.0 / 3.0 * v.q, v.p - v.q / 3.0, v.unbalanced_ratio, volume}, v.confining);
    }
    /// The same of a state at a step of the stage. stress: scale of stresses (Pa).
    bool look(std::int64_t step, const state& now, double stress) {
        const state scale{stress, stress, 1.0, now[3]};
        bool within = step >= since_ && step > 0;
        for (std::size_t k = 0; k < now.size() && within; ++k) {
            const double low = std::min(low_[k], now[k]), high = std::max(high_[k], now[k]);
            within = high - low <= nothing[k] * scale[k]; // false for NaN
        }
        if (!within) {
            low_ = high_ = now;
            since_ = step;
            return false;
        }
        for (std::size_t k = 0; k < now.size(); ++k)
            low_[k] = std::min(low_[k], now[k]), high_[k] = std::max(high_[k], now[k]);
        return step - since_ >= span;
    }
    /// In words.
    static std::string text() {
        return fmt::format(
            "nothing changes any more: over {} steps stresses, unbalanced ratio and volume stayed the same", span);
    }

    template <class A> void archive(A& a) { a(low_, high_, since_); }

  private:
    state low_{}, high_{};
    std::int64_t since_ = 0;
};

/// Whether a specimen that stands still may go on short of its end: stresses and forces within 1 %.
inline bool nearly_there(const stage_view& v) {
    return std::max({v.axial_error, v.confining_error, v.unbalanced_ratio}) < 0.01;
}
/// What is wrong with it, in words.
inline std::string errors_of(const stage_view& v) {
    return fmt::format("unbalanced ratio {:.3g}, stress errors {:.3g} (axial) and {:.3g} (confining)",
                       v.unbalanced_ratio, v.axial_error, v.confining_error);
}
/// The error of a stage that does not end, after so many steps. still: that nothing changes any more, or nothing.
inline run_error no_end(const stage& s, const stage_view& v, const sample& now, std::int64_t steps,
                        const std::string& when, const std::string& still) {
    return run_error(
        {fmt::format("stage '{}' did not reach its end ({})", s.name, s.end.text),
         fmt::format("stage '{}', after {} of at most {} steps", s.name, steps, s.most_steps), when,
         fmt::format("{}{}{}, q = {:.4g} kPa, p' = {:.4g} kPa (spheres {:.4g} kPa)", still, still.empty() ? "" : "; ",
                     errors_of(v), 1e-3 * now.q, 1e-3 * now.p, 1e-3 * v.sphere_stress),
         s.if_stuck});
}

} // namespace clast::protocol
