// SPDX-License-Identifier: MIT
#include <clast/core/packs.hpp>

#include <cmath>
#include <cstddef>
#include <type_traits>

#include <catch.hpp>

using namespace clast;

namespace {
double value(std::size_t record, std::size_t item) {
    return 100.0 * static_cast<double>(record) + static_cast<double>(item);
}
} // namespace

TEST_CASE("four columns become four records") {
    double columns[4][4];
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t r = 0; r < 4; ++r) columns[c][r] = value(r, c);
    const auto check = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
        quad<N> record[4];
        quad<N>::records(columns[0], columns[1], columns[2], columns[3], record);
        for (std::size_t r = 0; r < 4; ++r)
            for (std::size_t c = 0; c < 4; ++c) CHECK(record[r][c] == value(r, c));
    };
    check(std::integral_constant<std::size_t, 2>{});
    check(std::integral_constant<std::size_t, 4>{});
}

TEST_CASE("four records become columns, with or without their fourth numbers") {
    double records[4][6];
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t i = 0; i < 6; ++i) records[r][i] = value(r, i);
    const auto check = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
        quad<N> record[4];
        for (std::size_t r = 0; r < 4; ++r)
            record[r] = quad<N>::load(bytes_of(records[3 - r]) + 2 * sizeof(double)); // at any place of memory
        double three[3][4], fourth[5] = {0.0, 0.0, 0.0, 0.0, -1.0};
        quad<N>::columns(record, three[0], three[1], three[2]);
        quad<N>::fourth_column(record, fourth);
        for (std::size_t r = 0; r < 4; ++r) {
            for (std::size_t c = 0; c < 3; ++c) CHECK(three[c][r] == value(3 - r, 2 + c));
            CHECK(fourth[r] == value(3 - r, 5));
        }
        CHECK(fourth[4] == -1.0);
    };
    check(std::integral_constant<std::size_t, 2>{});
    check(std::integral_constant<std::size_t, 4>{});
}

TEST_CASE("a quad holds four numbers in order, counts with them, and takes the fourth of another") {
    const double numbers[4] = {5.0, 6.0, 7.0, 8.0};
    const auto check = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
        using quad = clast::quad<N>;
        const quad a(1.0, 2.0, 3.0, 4.0), other = quad::load(numbers), b = a.with_fourth_of(other);
        const quad sum = a + other, rest = a - other, twice = 2.0 * a, product = a * other;
        double stored[4];
        b.store(stored);
        for (std::size_t k = 0; k < 4; ++k) {
            CHECK(a[k] == static_cast<double>(k + 1));
            CHECK(b[k] == (k < 3 ? a[k] : 8.0));
            CHECK(stored[k] == b[k]);
            CHECK(sum[k] == static_cast<double>(2 * k + 6));
            CHECK(rest[k] == -4.0);
            CHECK(twice[k] == static_cast<double>(2 * k + 2));
            CHECK(product[k] == static_cast<double>((k + 1) * (k + 5)));
        }
        const quad mixed(-3.0, 0.0, 4.0, -0.5), size = magnitude(mixed), sign = sign_of(mixed);
        for (std::size_t k = 0; k < 4; ++k) {
            CHECK(size[k] == std::abs(mixed[k]));
            CHECK(sign[k] == (mixed[k] < 0.0 ? -1.0 : mixed[k] > 0.0 ? 1.0 : 0.0));
        }
    };
    check(std::integral_constant<std::size_t, 2>{});
    check(std::integral_constant<std::size_t, 4>{});
}
