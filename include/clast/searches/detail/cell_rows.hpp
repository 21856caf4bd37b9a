// SPDX-License-Identifier: MIT
// What the searches by cells share: spheres sorted by cell, so that cells of a row are one run in memory, a test of
// eight spheres at a time, and pairs put in order without comparing them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <clast/searches/concepts.hpp>

namespace clast::searches::detail {

/// Spheres that are tested at once, and that may be read behind the last one.
inline constexpr std::size_t block = 8;

/// Pairs per sphere to make room for: a dense packing has 3 to 5, and copies of a list that grows cost as much as a
/// third of the search.
inline constexpr std::size_t usual_pairs = 6;

/// Spheres sorted by cell, their coordinates side by side; the cells of a row, along x, follow each other.
///
/// The index of a cell never decreases with the coordinate, rounding included, and the outermost cells reach to
/// infinity. So the spheres between two coordinates are in the cells between the cells of the two: the size of cells
/// changes the time a search takes, never what it finds. Time and memory to build: O(n).
class cell_rows {
  public:
    /// Takes the `members` of `spheres`. `margin` as in the search: cells suit it (m).
    cell_rows(std::span<const sphere> spheres, const std::vector<std::int32_t>& members, double margin);

    std::vector<double> x, y, z, radius; ///< by cell, and a block that stands for nothing (m)
    std::vector<std::int32_t> index;     ///< by cell: which of the spheres it is
    double widest = 0.0;                 ///< largest radius (m)

    std::size_t size() const { return index.size(); }

    /// Cells along an axis that hold whatever lies between two coordinates: first and last.
    struct range {
        std::size_t first, last;
    };
    range cells(int axis, double from, double to) const { return {cell(axis, from), cell(axis, to)}; }
    /// Cell of a coordinate along an axis; 0 for what is not a number.
    std::size_t cell(int axis, double c) const {
        const double at = std::min(std::max(0.0, (c - low_[axis]) * per_metre_[axis]), last_[axis]);
        return static_cast<std::size_t>(static_cast<std::int64_t>(at)); // processors convert to signed numbers
    }
    /// Spheres of some cells of the row (cy, cz): from the first to behind the last.
    range run(range cx, std::size_t cy, std::size_t cz) const {
        const std::size_t row = (cz * count_[1] + cy) * count_[0];
        return {start_[row + cx.first], start_[row + cx.last + 1]};
    }
    /// Estimate of the blocks to read for all spheres within `reach` of a point, along each axis (m).
    double cost(double reach) const;

  private:
    void measure(std::span<const sphere> spheres, const std::vector<std::int32_t>& members);
    void choose_cells(std::span<const sphere> spheres, const std::vector<std::int32_t>& members, double margin);
    void leave_out_far_ones(std::span<const sphere> spheres, const std::vector<std::int32_t>& members);
    void sort(std::span<const sphere> spheres, const std::vector<std::int32_t>& members);

    vec3 low_, high_;                    ///< box of the centres (m)
    vec3 per_metre_;                     ///< 1 / edge of a cell
    vec3 last_;                          ///< last cell along each axis
    std::array<std::size_t, 3> count_{}; ///< cells along each axis
    std::vector<std::uint32_t> start_;   ///< by cell: place of its first sphere
};

inline cell_rows::cell_rows(std::span<const sphere> spheres, const std::vector<std::int32_t>& members, double margin)
    : x(members.size() + block), y(members.size() + block), z(members.size() + block), radius(members.size() + block),
      index(members.size()) {
    measure(spheres, members);
    choose_cells(spheres, members, margin);
    sort(spheres, members);
}

inline void cell_rows::measure(std::span<const sphere> spheres, const std::vector<std::int32_t>& members) {
    constexpr double most = std::numeric_limits<double>::max();
    low_ = {most, most, most}, high_ = -low_;
    for (const std::int32_t m : members) {
        const sphere& s = spheres[static_cast<std::size_t>(m)];
        widest = std::max(widest, s.radius);
        if (!is_finite(s.centre)) continue; // near to nothing, and no reason to widen the cells
        for (int a = 0; a < 3; ++a)
            low_[a] = std::min(low_[a], s.centre[a]), high_[a] = std::max(high_[a], s.centre[a]);
    }
}

/// Sets the box to where nearly all spheres are, so that a few that flew away do not make the cells of all others wide.
inline void cell_rows::leave_out_far_ones(std::span<const sphere> spheres, const std::vector<std::int32_t>& members) {
    const std::size_t step = members.size() / 1024 + 1;
    for (int a = 0; a < 3; ++a) {
        std::vector<double> sample;
        for (std::size_t k = 0; k < members.size(); k += step) {
            const double c = spheres[static_cast<std::size_t>(members[k])].centre[a];
            if (std::isfinite(c)) sample.push_back(c);
        }
        if (sample.empty()) continue;
        std::sort(sample.begin(), sample.end());
        const std::size_t few = sample.size() / 64;
        const double from = sample[few], to = sample[sample.size() - 1 - few];
        low_[a] = std::max(low_[a], from - 0.25 * (to - from)), high_[a] = std::min(high_[a], to + 0.25 * (to - from));
    }
}

inline void cell_rows::choose_cells(std::span<const sphere> spheres, const std::vector<std::int32_t>& members,
                                    double margin) {
    // In parts of the largest reach. Measured on dense packings: narrow along x, where cells cost nothing but memory;
    // across wider than the reach, so that a block of a row is filled with few rows to visit.
    const double reach = std::max(std::numeric_limits<double>::min(), 2.0 * widest + margin);
    vec3 edge = {0.4 * reach, 1.2 * reach, 1.2 * reach};
    const double most = 8.0 * static_cast<double>(members.size()) + 64.0;
    const auto along = [&](int a) { return 1.0 + std::floor(std::clamp((high_[a] - low_[a]) / edge[a], 0.0, 1e6)); };
    const auto too_many = [&] { return along(0) * along(1) * along(2) > most; };
    if (too_many()) leave_out_far_ones(spheres, members);
    while (too_many()) edge *= 1.5;
    for (int a = 0; a < 3; ++a) {
        last_[a] = along(a) - 1.0;
        count_[static_cast<std::size_t>(a)] = static_cast<std::size_t>(along(a));
        per_metre_[a] = 1.0 / edge[a];
    }
}

/// Counting sort.
inline void cell_rows::sort(std::span<const sphere> spheres, const std::vector<std::int32_t>& members) {
    start_.assign(count_[0] * count_[1] * count_[2] + 1, 0);
    std::vector<std::uint32_t> cell_of(members.size());
    for (std::size_t k = 0; k < members.size(); ++k) {
        const vec3& c = spheres[static_cast<std::size_t>(members[k])].centre;
        const std::size_t at = (cell(2, c.z) * count_[1] + cell(1, c.y)) * count_[0] + cell(0, c.x);
        cell_of[k] = static_cast<std::uint32_t>(at);
        ++start_[at];
    }
    // now ends of cells; they are filled from behind, which turns ends into beginnings
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    for (std::size_t k = members.size(); k-- > 0;) {
        const std::size_t to = --start_[cell_of[k]];
        const sphere& s = spheres[static_cast<std::size_t>(members[k])];
        x[to] = s.centre.x, y[to] = s.centre.y, z[to] = s.centre.z, radius[to] = s.radius;
        index[to] = members[k];
    }
}

inline double cell_rows::cost(double reach) const {
    vec3 visited;
    double cells = 1.0;
    for (int a = 0; a < 3; ++a) {
        visited[a] = std::min(last_[a], 2.0 * reach * per_metre_[a]) + 1.0;
        cells *= last_[a] + 1.0;
    }
    const double in_run = visited.x * static_cast<double>(size()) / cells;
    return visited.y * visited.z * (1.0 + in_run / static_cast<double>(block));
}

/// Row m: the set bits of the byte m, one after the other.
struct set_bits {
    std::uint8_t of[256][block] = {};
    constexpr set_bits() {
        for (unsigned mask = 0; mask < 256; ++mask)
            for (unsigned bit = 0, n = 0; bit < block; ++bit)
                if ((mask >> bit & 1U) != 0) of[mask][n++] = static_cast<std::uint8_t>(bit);
    }
};
inline constexpr set_bits bits;

/// Tests spheres of `a` against those of `b` (which may be `a`) and collects the pairs that are `within` the margin.
class pair_test {
  public:
    pair_test(const cell_rows& a, const cell_rows& b, double margin, std::vector<sphere_pair>& found)
        : a_(a), b_(b), margin_(margin), found_(found) {}

    /// Largest distance of centres (along each axis, too) at which sphere p of `a` may have neighbours in `b`, with
    /// more than rounding added (m); not positive if it can have none.
    double reach(std::size_t p) const { return (1.0 + 1e-9) * (a_.radius[p] + b_.widest + margin_); }
    /// Sphere p of `a` against a run of `b`.
    void test(std::size_t p, cell_rows::range run) {
        for (std::size_t k = run.first; k < run.last; k += block) {
            if (size_ + block > capacity) flush();
            const unsigned hits = neighbours(p, k) & (run.last - k < block ? (1U << (run.last - k)) - 1U : 255U);
            // all eight are written, as many as are hits are kept: no branch that depends on the packing
            for (std::size_t l = 0; l < block; ++l) {
                of_a_[size_ + l] = static_cast<std::int32_t>(p);
                of_b_[size_ + l] = static_cast<std::int32_t>(k) + bits.of[hits][l];
            }
            size_ += static_cast<std::size_t>(std::popcount(hits));
        }
    }
    /// Hands over what is collected; to be called at the end.
    void flush() {
        const std::size_t before = found_.size();
        found_.resize(before + size_);
        for (std::size_t k = 0; k < size_; ++k) {
            const std::int32_t i = a_.index[static_cast<std::size_t>(of_a_[k])];
            const std::int32_t j = b_.index[static_cast<std::size_t>(of_b_[k])];
            found_[before + k] = {std::min(i, j), std::max(i, j)};
        }
        size_ = 0;
    }

  private:
    /// Bit l: sphere p of `a` is a neighbour of k + l of `b`. A sum of powers of two rather than bits set one by one,
    /// for that is what compilers vectorise on any processor.
    unsigned neighbours(std::size_t p, std::size_t k) const {
        static constexpr double power[block] = {1, 2, 4, 8, 16, 32, 64, 128};
        const double x = a_.x[p], y = a_.y[p], z = a_.z[p], radius = a_.radius[p], margin = margin_;
        const double *bx = &b_.x[k], *by = &b_.y[k], *bz = &b_.z[k], *br = &b_.radius[k];
        double sum = 0.0;
#if defined(_OPENMP) || defined(CLAST_OPENMP_SIMD) // as in the engine's kernel
#pragma omp simd reduction(+ : sum)
#endif
        for (std::size_t l = 0; l < block; ++l) {
            const double dx = bx[l] - x, dy = by[l] - y, dz = bz[l] - z;
            const double far = dx * dx + dy * dy + dz * dz, limit = near(radius, br[l], margin);
            sum +=
                (far < (1.0 - doubt) * limit ? power[l] : 0.0) + (far < (1.0 + doubt) * limit ? 256.0 * power[l] : 0.0);
        }
        const unsigned both = static_cast<unsigned>(static_cast<int>(sum)), sure = both & 255U, maybe = both >> 8;
        return sure == maybe ? sure : sure | decide(p, k, sure ^ maybe);
    }
    /// Those of the bits for which `within` says yes.
    [[gnu::noinline]] unsigned decide(std::size_t p, std::size_t k, unsigned doubtful) const {
        unsigned yes = 0;
        for (unsigned l = 0; l < block; ++l)
            if ((doubtful >> l & 1U) != 0 && within(sphere_of(a_, p), sphere_of(b_, k + l), margin_)) yes |= 1U << l;
        return yes;
    }
    static sphere sphere_of(const cell_rows& g, std::size_t k) { return {{g.x[k], g.y[k], g.z[k]}, g.radius[k]}; }

    static constexpr std::size_t capacity = 2048; // two arrays that stay in the first cache
    const cell_rows& a_;
    const cell_rows& b_;
    double margin_;
    std::vector<sphere_pair>& found_;
    std::size_t size_ = 0;
    std::int32_t of_a_[capacity], of_b_[capacity];
};

/// rows(pairs, p, reach, cx, cy) for every sphere p of `a` that may have neighbours in `b`; cx, cy: cells of `b` within
/// its reach. `rows` tests the sphere against runs of `b`.
template <class F>
void each_reach(const cell_rows& a, const cell_rows& b, double margin, std::vector<sphere_pair>& found, F&& rows) {
    pair_test pairs(a, b, margin, found);
    for (std::size_t p = 0; p < a.size(); ++p) {
        const double reach = pairs.reach(p);
        if (reach > 0.0)
            rows(pairs, p, reach, b.cells(0, a.x[p] - reach, a.x[p] + reach),
                 b.cells(1, a.y[p] - reach, a.y[p] + reach));
    }
    pairs.flush();
}

/// Adds the pairs among the spheres of `g`, each once: a sphere is tested against those after it in its own row, and
/// against the rows after its own.
inline void find_among(const cell_rows& g, double margin, std::vector<sphere_pair>& found) {
    each_reach(g, g, margin, found,
               [&](pair_test& pairs, std::size_t p, double reach, cell_rows::range cx, cell_rows::range cy) {
                   const std::size_t own_y = g.cell(1, g.y[p]), own_z = g.cell(2, g.z[p]);
                   const std::size_t last_z = g.cell(2, g.z[p] + reach);
                   pairs.test(p, {p + 1, g.run(cx, own_y, own_z).last});
                   for (std::size_t y = own_y + 1; y <= cy.last; ++y) pairs.test(p, g.run(cx, y, own_z));
                   for (std::size_t z = own_z + 1; z <= last_z; ++z)
                       for (std::size_t y = cy.first; y <= cy.last; ++y) pairs.test(p, g.run(cx, y, z));
               });
}

/// Adds the pairs of a sphere of `a` and one of `b`, which have none in common.
inline void find_between(const cell_rows& a, const cell_rows& b, double margin, std::vector<sphere_pair>& found) {
    each_reach(a, b, margin, found,
               [&](pair_test& pairs, std::size_t p, double reach, cell_rows::range cx, cell_rows::range cy) {
                   const cell_rows::range cz = b.cells(2, a.z[p] - reach, a.z[p] + reach);
                   for (std::size_t z = cz.first; z <= cz.last; ++z)
                       for (std::size_t y = cy.first; y <= cy.last; ++y) pairs.test(p, b.run(cx, y, z));
               });
}

/// Copies pairs sorted by one of their members, below n; those that share it keep their order.
inline void sort_by(std::int32_t sphere_pair::*member, std::size_t n, const std::vector<sphere_pair>& from,
                    std::vector<sphere_pair>& to) {
    std::vector<std::uint32_t> next(n + 1, 0);
    for (const sphere_pair& p : from) ++next[static_cast<std::size_t>(p.*member) + 1];
    for (std::size_t k = 1; k <= n; ++k) next[k] += next[k - 1];
    for (const sphere_pair& p : from) to[next[static_cast<std::size_t>(p.*member)]++] = p;
}

/// Sorts pairs of n spheres by first and second: two counting sorts, O(n + pairs) whatever the order before.
inline void sort(std::vector<sphere_pair>& pairs, std::size_t n) {
    std::vector<sphere_pair> by_second(pairs.size());
    sort_by(&sphere_pair::second, n, pairs, by_second);
    sort_by(&sphere_pair::first, n, by_second, pairs);
}

} // namespace clast::searches::detail
