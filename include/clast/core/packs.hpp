// SPDX-License-Identifier: MIT
// Records of four numbers: arithmetic on a whole one, and from four of them to one array per component and back.
#pragma once

#include <cstddef>
#include <type_traits>

#include <clast/core/lanes.hpp>
#include <clast/core/vector.hpp>

namespace clast {

/// Where a record stands in memory.
template <class T> const std::byte* bytes_of(const T& record) { return reinterpret_cast<const std::byte*>(&record); }

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
    /// Of four records, what stands `where` bytes behind their beginnings.
    [[gnu::always_inline]] static void load(const std::byte* const (&records)[4], std::size_t where, quad (&r)[4]) {
        for (std::size_t l = 0; l < 4; ++l) r[l] = load(records[l] + where);
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
    [[gnu::always_inline]] friend quad operator*(const quad& a, const quad& b) {
        quad product;
        for (std::size_t k = 0; k < parts; ++k) product.part_[k] = a.part_[k] * b.part_[k];
        return product;
    }
    /// This one with the fourth number of another.
    [[gnu::always_inline]] quad with_fourth_of(const quad& b) const {
        quad q = *this;
        if constexpr (N == 4)
            q.part_[0] = __builtin_shufflevector(part_[0], b.part_[0], 0, 1, 2, 7);
        else
            q.part_[1] = __builtin_shufflevector(part_[1], b.part_[1], 0, 3);
        return q;
    }
    /// Absolute values (0 may become -0), and signs (0 for 0).
    [[gnu::always_inline]] friend quad magnitude(const quad& a) {
        quad size;
        for (std::size_t k = 0; k < parts; ++k) size.part_[k] = clast::magnitude(a.part_[k]);
        return size;
    }
    [[gnu::always_inline]] friend quad sign_of(const quad& a) {
        quad sign;
        for (std::size_t k = 0; k < parts; ++k) sign.part_[k] = clast::sign_of(a.part_[k]);
        return sign;
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
    /// The reverse, without the fourth numbers: x[l], y[l], z[l] of the records r[l].
    [[gnu::always_inline]] static void columns(const quad (&r)[4], double* x, double* y, double* z) {
        const interleaved pairs(r);
        pairs.template column<0>(x), pairs.template column<1>(y), pairs.template column<2>(z);
    }
    /// The fourth numbers alone.
    [[gnu::always_inline]] static void fourth_column(const quad (&r)[4], double* w) {
        interleaved(r).template column<3>(w);
    }

  private:
    /// Half way to columns: the even and the odd numbers of two records side by side. To ask for columns of the same
    /// records twice costs nothing: compilers see that the halves are the same.
    struct interleaved {
        pack even[2][parts], odd[2][parts];

        [[gnu::always_inline]] explicit interleaved(const quad (&r)[4]) {
            for (std::size_t two = 0; two < 2; ++two)
                for (std::size_t k = 0; k < parts; ++k) {
                    const pack &a = r[2 * two].part_[k], &b = r[2 * two + 1].part_[k];
                    if constexpr (N == 4)
                        even[two][k] = __builtin_shufflevector(a, b, 0, 4, 2, 6),
                        odd[two][k] = __builtin_shufflevector(a, b, 1, 5, 3, 7);
                    else
                        even[two][k] = __builtin_shufflevector(a, b, 0, 2),
                        odd[two][k] = __builtin_shufflevector(a, b, 1, 3);
                }
        }
        template <int C> [[gnu::always_inline]] void column(double* to) const {
            const auto& half = C % 2 == 0 ? even : odd;
            constexpr int at = C / 2 * 2; // where the two numbers of a column stand in each half
            if constexpr (N == 4)
                clast::store<pack>(to, __builtin_shufflevector(half[0][0], half[1][0], at, at + 1, at + 4, at + 5));
            else
                clast::store<pack>(to, half[0][C / 2]), clast::store<pack>(to + 2, half[1][C / 2]);
        }
    };

    pack part_[parts] = {};
};
/// Bytes of four numbers.
inline constexpr std::size_t quad_size = 4 * sizeof(double);
static_assert(sizeof(quad<2>) == quad_size && sizeof(quad<4>) == quad_size);

} // namespace clast
