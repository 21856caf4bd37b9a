// SPDX-License-Identifier: MIT
// How much a grading has become finer: relative breakage after Hardin and after Einav, from pieces as they are.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <clast/bodies/clumps.hpp>
#include <clast/core/vector.hpp>
#include <clast/grains/shape.hpp>

namespace clast::measure {

/// What the size of a piece is.
enum class size_of : std::uint8_t {
    equivalent, ///< diameter of the ball of the volume of its pebbles
    sieve       ///< second largest extent along its principal axes, which decides what mesh it passes
};
/// A grain, or a fragment of one: pebbles that are a clump or that bonds join.
struct piece {
    double size = 0.0; ///< (m)
    double mass = 0.0; ///< (kg)
};

namespace detail {
/// Second largest extent (m) of some balls along the principal axes of inertia of their solid.
inline double second_extent(const std::vector<shape_pebble>& balls) {
    if (balls.size() == 1) return 2.0 * balls.front().radius;
    std::vector<shape_pebble> centred = balls;
    const clast::detail::solid whole = clast::detail::sum_of(centred);
    const clast::detail::principal_frame frame = clast::detail::principal_axes(whole.tensor);
    double low[3] = {}, high[3] = {};
    for (const shape_pebble& p : centred) {
        const vec3 x = frame.equal < 3 ? rotate_back(frame.to_input, p.offset) : p.offset;
        for (int a = 0; a < 3; ++a)
            low[a] = std::min(low[a], x[a] - p.radius), high[a] = std::max(high[a], x[a] + p.radius);
    }
    double extent[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    std::sort(extent, extent + 3);
    return extent[1];
}
} // namespace detail

/// Pieces of an engine's specimen as they are, grains and fragments in the order of their first pebbles. Pebbles must
/// be in place (place_all) for sieve sizes of fragments.
template <class Engine> std::vector<piece> pieces_of(const Engine& e, size_of what = size_of::equivalent) {
    const auto& s = e.grains;
    std::vector<std::int32_t> place(e.breakage().piece_count(s), -1); // of a piece in the list
    std::vector<piece> out;
    std::vector<double> first;                    // radius of the first pebble of each: similar pieces, similar bits
    std::vector<std::vector<shape_pebble>> balls; // of each, where extents are asked for
    for (std::size_t p = 0; p < s.pebble_count(); ++p) {
        std::int32_t& at = place[e.breakage().piece_of(s, static_cast<std::int32_t>(p))];
        const double r = s.pebbles[p].radius;
        if (at < 0) at = static_cast<std::int32_t>(out.size()), out.push_back({}), first.push_back(r);
        piece& one = out[static_cast<std::size_t>(at)];
        const double ratio = r / first[static_cast<std::size_t>(at)];
        one.size += ratio * ratio * ratio; // for now, of its volume over that of its first pebble
        one.mass += s.ball_mass(p);
        if (what == size_of::equivalent) continue;
        balls.resize(out.size());
        balls[static_cast<std::size_t>(at)].push_back({s.pebbles[p].x, r});
    }
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k].size =
            what == size_of::sieve ? detail::second_extent(balls[k]) : 2.0 * first[k] * std::cbrt(out[k].size);
    return out;
}

/// Mean over the mass of log10(size / unit), where sizes below `smallest` count as that (m). The area between two
/// gradings over log10 d is the difference of these means.
inline double mean_log10_size(const std::vector<piece>& pieces, double unit, double smallest = 0.0) {
    double sum = 0.0, mass = 0.0;
    for (const piece& p : pieces) sum += p.mass * std::log10(std::max(p.size, smallest) / unit), mass += p.mass;
    return mass > 0.0 ? sum / mass : 0.0;
}

/// Relative breakage against one initial grading; 0: nothing broke. Built from the specimen as packed, asked later.
class relative_breakage {
  public:
    relative_breakage() = default;
    /// alpha: fractal dimension of the ultimate grading, below 3; Einav (2007) has 2.6.
    explicit relative_breakage(const std::vector<piece>& initial, double alpha = 2.6)
        : above_silt_(mean_log10_size(initial, silt, silt)) {
        for (const piece& p : initial) largest_ = std::max(largest_, p.size);
        start_ = mean_log10_size(initial, largest_);
        ultimate_ =
            -1.0 / ((3.0 - alpha) * std::numbers::ln10); // mean of log10(d / d_M) over F_u = (d / d_M)^(3 - alpha)
    }

    /// B_r of Hardin (1985, J. Geotech. Eng. 111(10)): the area between both gradings over that between the initial one
    /// and 0.074 mm. 1 where all is silt.
    double hardin(const std::vector<piece>& now) const {
        return above_silt_ > 0.0 ? (above_silt_ - mean_log10_size(now, silt, silt)) / above_silt_ : 0.0;
    }
    /// B of Einav (2007, J. Mech. Phys. Solids 55): the same over the area to an ultimate grading F_u = (d/d_M)^(3 -
    /// alpha), d_M the largest initial size. 1 where the grading is that.
    double einav(const std::vector<piece>& now) const {
        const double potential = start_ - ultimate_;
        return potential > 0.0 ? (start_ - mean_log10_size(now, largest_)) / potential : 0.0;
    }

    static constexpr double silt = 7.4e-5; ///< (m)

  private:
    double largest_ = 0.0;                                   // size (m)
    double above_silt_ = 0.0, start_ = 0.0, ultimate_ = 0.0; // means of log10 d, over silt and over the largest
};

} // namespace clast::measure
