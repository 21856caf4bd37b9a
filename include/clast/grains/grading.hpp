// SPDX-License-Identifier: MIT
// Sieve curves: how the mass of a specimen is shared out among sizes of grains.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/core/errors.hpp>

namespace clast {

/// A point of a sieve curve.
struct sieve {
    double size = 0.0;  ///< (m): nominal diameter of a grain
    double finer = 0.0; ///< share of the mass in smaller grains, 0 to 1
};

/// A grading by mass: share finer against size, straight between its points over the logarithm of size, as it is drawn.
/// Without points: every grain has the size of its shape.
class grading {
  public:
    grading() = default;
    /// From points in the order of growing size. Throws input_error unless there are two or more, sizes are positive
    /// and grow, shares do not fall, and they go from 0 to 1.
    explicit grading(std::vector<sieve> points) : curve_(std::move(points)) {
        const auto wrong = [](const std::string& value, const char* allowed, const char* way_out) {
            return input_error("grading", value, allowed, way_out);
        };
        if (curve_.size() < 2)
            throw wrong(fmt::format("{} points", curve_.size()), "at least two points, size and share finer",
                        "Give the largest and the smallest size of grains.");
        for (std::size_t k = 0; k < curve_.size(); ++k) {
            const sieve& s = curve_[k];
            const std::string point = fmt::format("{:g} mm, {:g} % finer", 1e3 * s.size, 100.0 * s.finer);
            if (!(s.size > 0.0 && std::isfinite(s.size) && s.finer >= 0.0 && s.finer <= 1.0))
                throw wrong(point, "sizes above 0, shares of 0 to 100 %", "Correct this point.");
            if (k > 0 && !(s.size > curve_[k - 1].size && s.finer >= curve_[k - 1].finer))
                throw wrong(fmt::format("{:g} mm, {:g} % finer, then {}", 1e3 * curve_[k - 1].size,
                                        100.0 * curve_[k - 1].finer, point),
                            "sizes that grow and shares that do not fall with them", "Correct one of the two points.");
        }
        if (curve_.front().finer != 0.0 || curve_.back().finer != 1.0)
            throw wrong(
                fmt::format("from {:g} % to {:g} %", 100.0 * curve_.front().finer, 100.0 * curve_.back().finer),
                "from 0 % at the smallest to 100 % at the largest size",
                "Add the size below which there are no grains (0 %), or the one that all are below (100 %); what "
                "is left out is left out of all shares.");
    }

    bool empty() const { return curve_.empty(); }
    const std::vector<sieve>& curve() const { return curve_; }
    double smallest() const { return curve_.front().size; } ///< (m)
    double largest() const { return curve_.back().size; }   ///< (m)

    /// Share of the mass in grains below a size (m).
    double finer(double size) const {
        if (size <= smallest()) return 0.0;
        for (std::size_t k = 1; k < curve_.size(); ++k) {
            const sieve &a = curve_[k - 1], &b = curve_[k];
            if (size < b.size)
                return a.finer + (b.finer - a.finer) * std::log(size / a.size) / std::log(b.size / a.size);
        }
        return 1.0;
    }
    /// Size (m) below which this share of the mass is: d50 for 0.5. share: 0 to 1.
    double size_at(double share) const {
        for (std::size_t k = 1; k < curve_.size(); ++k) {
            const sieve &a = curve_[k - 1], &b = curve_[k];
            if (share <= b.finer && b.finer > a.finer)
                return a.size * std::pow(b.size / a.size, std::max(0.0, (share - a.finer) / (b.finer - a.finer)));
        }
        return largest();
    }
    /// The parallel grading: the same curve with another largest size (m, > 0), moved along the logarithm of size. So
    /// laboratories test rockfill that is too coarse for their cells.
    grading parallel_to(double largest_size) const {
        std::vector<sieve> moved = curve_;
        for (sieve& s : moved) s.size *= largest_size / largest();
        return grading(std::move(moved));
    }

    /// Sizes (m) of grains of one shape that have a volume (m^3) among them, from the largest to the smallest. A grain
    /// of size d has the volume `per_cube` d^3. Nothing is drawn by lot: between two points sizes stand at the even
    /// quantiles of the number of grains, and what whole grains cannot fill goes on to the next finer class that has
    /// mass, so the curve is missed by half a grain of the next coarser class at every point.
    std::vector<double> sizes(double volume, double per_cube) const {
        std::vector<double> all;
        double left = 0.0; // volume that coarser classes have not filled
        for (std::size_t k = curve_.size(); k-- > 1;) {
            const sieve &a = curve_[k - 1], &b = curve_[k];
            if (b.finer == a.finer) continue; // a gap stays one
            left += (b.finer - a.finer) * volume;
            // mass is even over log d, so numbers go with d^-3 and a share u of them is above d
            const double ratio = a.size / b.size, q = ratio * ratio * ratio;
            const double mean = a.size * a.size * a.size * -std::log(q) / (1.0 - q); // of d^3
            const auto count = std::llround(std::max(0.0, left) / (per_cube * mean));
            for (long long i = 0; i < count; ++i) {
                const double above = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
                const double d = b.size * std::pow(1.0 + above * (1.0 / q - 1.0), -1.0 / 3.0);
                left -= per_cube * d * d * d;
                all.push_back(d);
            }
        }
        return all;
    }

  private:
    std::vector<sieve> curve_;
};

} // namespace clast
