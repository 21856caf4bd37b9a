// SPDX-License-Identifier: MIT
// Plane geometry of a ring of tiles: each tile is visible where it lies inside the half-planes of the others.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace clast::boundaries {

/// The outward directions of a ring's tiles: tile i looks along the azimuth 2 pi i / count, its plane is x.n_i = R_i.
struct directions {
    int count = 0;
    std::vector<double> cosine; ///< cos(2 pi i / count)
    std::vector<double> sine;

    directions() = default;
    /// @param tiles number of tiles per ring, >= 3
    explicit directions(int tiles)
        : count(tiles), cosine(static_cast<std::size_t>(tiles)), sine(static_cast<std::size_t>(tiles)) {
        for (int i = 0; i < tiles; ++i) {
            cosine[static_cast<std::size_t>(i)] = std::cos(angle() * i);
            sine[static_cast<std::size_t>(i)] = std::sin(angle() * i);
        }
    }
    double angle() const { return 2.0 * std::numbers::pi / count; } ///< between neighbours (rad)
    int wrap(int i) const { return i >= count ? i - count : i < 0 ? i + count : i; }
    /// The tile that looks most nearly towards (x, y).
    int towards(double x, double y) const {
        // a cheap arc tangent (error below 0.004 rad, far less than a sector), then the best of three; std::atan2 took
        // a third of the time of a contact search
        const double ax = std::abs(x);
        const double ay = std::abs(y);
        const double large = std::max(ax, ay);
        if (!(large > 0.0)) return 0;
        const double t = std::min(ax, ay) / large;
        constexpr double quarter = 0.25 * std::numbers::pi;
        double azimuth = t * (quarter + 0.273 * (1.0 - t));
        if (ay > ax) azimuth = 2.0 * quarter - azimuth;
        if (x < 0.0) azimuth = 4.0 * quarter - azimuth;
        if (y < 0.0) azimuth = 8.0 * quarter - azimuth;
        const int i = wrap(static_cast<int>(azimuth * count / (8.0 * quarter) + 0.5));
        const auto along = [&](int j) {
            return x * cosine[static_cast<std::size_t>(j)] + y * sine[static_cast<std::size_t>(j)];
        };
        const int next = wrap(i + 1);
        const int last = wrap(i - 1);
        const double here = along(i);
        if (along(next) > here) return next;
        return along(last) > here ? last : i;
    }

    template <class A> void archive(A& a) { a(count, cosine, sine); }
};

/// Visible part of a tile along its tangent (azimuth growing), measured from the foot of the axis (m).
struct interval {
    double low = 0.0;
    double high = 0.0;
    double width() const { return high - low; } ///< >= 0
};

/// Width of a tile of a regular ring with the given apothem (m).
inline double regular_width(int tiles, double apothem) { return 2.0 * apothem * std::tan(std::numbers::pi / tiles); }

/// Half-width that a tile needs so that no slit opens up to apothem `largest` (m) and steps `step` (m) to its
/// neighbours.
inline double half_width_without_slit(int tiles, double largest, double step) {
    const double a = 2.0 * std::numbers::pi / tiles;
    return largest * std::tan(0.5 * a) + step / std::sin(a);
}

/// The segment [-half_width, half_width] of tile i clipped by the half-planes of the other tiles. `smallest` is the
/// least apothem of the ring (> 0): beyond some neighbour nothing can cut any more, and the search ends exactly there,
/// because (smallest - R_i cos p) / sin p grows with the angle p.
inline interval visible(const directions& d, std::span<const double> apothem, int i, double half_width,
                        double smallest) {
    const double own = apothem[static_cast<std::size_t>(i)];
    double low = -half_width;
    double high = half_width;
    for (int m = 1; 2 * m < d.count; ++m) {
        const double c = d.cosine[static_cast<std::size_t>(m)];
        const double s = d.sine[static_cast<std::size_t>(m)];
        const double bound = (smallest - own * c) / s;
        if (bound >= high && -bound <= low) break;
        high = std::min(high, (apothem[static_cast<std::size_t>(d.wrap(i + m))] - own * c) / s);
        low = std::max(low, -(apothem[static_cast<std::size_t>(d.wrap(i - m))] - own * c) / s);
    }
    return high > low ? interval{low, high} : interval{}; // a hidden tile has no width
}

} // namespace clast::boundaries
