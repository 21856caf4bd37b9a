// SPDX-License-Identifier: MIT
// From records in memory to one array per component and back: transposes of blocks of 2 or 4, as registers have it.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include <clast/core/lanes.hpp>
#include <clast/core/vector.hpp>

namespace clast {

/// The two doubles that stand `at` bytes behind the beginning of N records (2 or 4), ready to become two columns.
template <std::size_t N> class pack_columns {
    using lane = std::conditional_t<N == 4, lane4, lane2>;

  public:
    using records = std::array<const std::byte*, N>;

    [[gnu::always_inline]] pack_columns(const records& record, std::size_t at) {
        if constexpr (N == 4)
            even_ = join(load<lane2>(record[0] + at), load<lane2>(record[2] + at)),
            odd_ = join(load<lane2>(record[1] + at), load<lane2>(record[3] + at));
        else
            even_ = load<lane2>(record[0] + at), odd_ = load<lane2>(record[1] + at);
    }
    [[gnu::always_inline]] friend pack_columns operator-(const pack_columns& a, const pack_columns& b) {
        return {a.even_ - b.even_, a.odd_ - b.odd_};
    }
    /// The first and the second double of every record, in order.
    [[gnu::always_inline]] void first(double* to) const { column<0>(to); }
    [[gnu::always_inline]] void second(double* to) const { column<1>(to); }

  private:
    template <int C> [[gnu::always_inline]] void column(double* to) const {
        lane v;
        if constexpr (N == 4)
            v = __builtin_shufflevector(even_, odd_, C, C + 4, C + 2, C + 6);
        else
            v = __builtin_shufflevector(even_, odd_, C, C + 2);
        store(to, v);
    }
    [[gnu::always_inline]] pack_columns(const lane& even, const lane& odd) : even_(even), odd_(odd) {}
    [[gnu::always_inline]] static lane4 join(const lane2& a, const lane2& b) {
        return __builtin_shufflevector(a, b, 0, 1, 2, 3);
    }

    lane even_, odd_; ///< of records 0, 2 and 1, 3 (or 0 and 1)
};

/// The vectors that stand `at` bytes behind the beginning of N records, as columns; a fourth number must follow them.
template <std::size_t N>
[[gnu::always_inline]] inline void transpose(const std::array<const std::byte*, N>& record, std::size_t at, double* x,
                                             double* y, double* z) {
    const pack_columns<N> xy(record, at), zw(record, at + 2 * sizeof(double));
    xy.first(x), xy.second(y), zw.first(z);
}
/// The same with the fourth number.
template <std::size_t N>
[[gnu::always_inline]] inline void transpose(const std::array<const std::byte*, N>& record, std::size_t at, double* x,
                                             double* y, double* z, double* w) {
    const pack_columns<N> xy(record, at), zw(record, at + 2 * sizeof(double));
    xy.first(x), xy.second(y), zw.first(z), zw.second(w);
}

/// A vector and one more number, side by side in memory.
struct alignas(32) four {
    double x = 0.0, y = 0.0, z = 0.0, w = 0.0;
    constexpr vec3 xyz() const { return {x, y, z}; }
};

/// Four doubles with elementwise arithmetic, in registers of N (2 or 4).
template <std::size_t N> class quad {
    using pack = std::conditional_t<N == 4, lane4, lane2>;
    static constexpr std::size_t parts = 4 / N;

  public:
    quad() = default;
    [[gnu::always_inline]] quad(double x, double y, double z, double w) {
        // in registers: what goes through memory in pieces is waited for when it is loaded as a whole
        if constexpr (N == 4)
            part_[0] = pack{x, y, z, w};
        else
            part_[0] = pack{x, y}, part_[1] = pack{z, w};
    }
    /// From and to 32 bytes of any alignment.
    [[gnu::always_inline]] static quad load(const void* from) {
        quad q;
        for (std::size_t k = 0; k < parts; ++k)
            q.part_[k] = clast::load<pack>(static_cast<const std::byte*>(from) + k * sizeof(pack));
        return q;
    }
    [[gnu::always_inline]] void store(void* to) const {
        for (std::size_t k = 0; k < parts; ++k) clast::store(static_cast<std::byte*>(to) + k * sizeof(pack), part_[k]);
    }
    [[gnu::always_inline]] double operator[](std::size_t k) const { return part_[k / N][k % N]; }

    [[gnu::always_inline]] quad& operator+=(const quad& b) {
        for (std::size_t k = 0; k < parts; ++k) part_[k] += b.part_[k];
        return *this;
    }
    [[gnu::always_inline]] quad& operator-=(const quad& b) {
        for (std::size_t k = 0; k < parts; ++k) part_[k] -= b.part_[k];
        return *this;
    }
    [[gnu::always_inline]] friend quad operator+(const quad& a, const quad& b) {
        quad sum = a;
        sum += b;
        return sum;
    }
    [[gnu::always_inline]] friend quad operator-(const quad& a, const quad& b) {
        quad rest = a;
        rest -= b;
        return rest;
    }
    [[gnu::always_inline]] friend quad operator*(double s, const quad& a) {
        quad scaled;
        for (std::size_t k = 0; k < parts; ++k) scaled.part_[k] = s * a.part_[k];
        return scaled;
    }
    /// The same with the fourth number of another.
    [[gnu::always_inline]] quad with_fourth_of(const quad& b) const {
        quad q = *this;
        if constexpr (N == 4)
            q.part_[0] = __builtin_shufflevector(part_[0], b.part_[0], 0, 1, 2, 7);
        else
            q.part_[1] = __builtin_shufflevector(part_[1], b.part_[1], 0, 3);
        return q;
    }
    /// The four records {x[l], y[l], z[l], w[l]}.
    [[gnu::always_inline]] static void records(const double* x, const double* y, const double* z, const double* w,
                                               quad (&r)[4]) {
        if constexpr (N == 4) {
            const quad a = load(x), b = load(y), c = load(z), d = load(w);
            const pack xy_even = __builtin_shufflevector(a.part_[0], b.part_[0], 0, 4, 2, 6);
            const pack xy_odd = __builtin_shufflevector(a.part_[0], b.part_[0], 1, 5, 3, 7);
            const pack zw_even = __builtin_shufflevector(c.part_[0], d.part_[0], 0, 4, 2, 6);
            const pack zw_odd = __builtin_shufflevector(c.part_[0], d.part_[0], 1, 5, 3, 7);
            r[0].part_[0] = __builtin_shufflevector(xy_even, zw_even, 0, 1, 4, 5);
            r[1].part_[0] = __builtin_shufflevector(xy_odd, zw_odd, 0, 1, 4, 5);
            r[2].part_[0] = __builtin_shufflevector(xy_even, zw_even, 2, 3, 6, 7);
            r[3].part_[0] = __builtin_shufflevector(xy_odd, zw_odd, 2, 3, 6, 7);
        } else {
            for (std::size_t l = 0; l < 4; ++l) r[l] = quad(x[l], y[l], z[l], w[l]);
        }
    }

  private:
    pack part_[parts] = {};
};
static_assert(sizeof(quad<2>) == sizeof(four) && sizeof(quad<4>) == sizeof(four));

} // namespace clast
