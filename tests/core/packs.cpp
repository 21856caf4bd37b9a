// SPDX-License-Identifier: MIT
#include <clast/core/packs.hpp>

#include <array>
#include <type_traits>

#include <catch.hpp>

using namespace clast;

namespace {
double value(std::size_t record, std::size_t item) {
    return 100.0 * static_cast<double>(record) + static_cast<double>(item);
}
} // namespace

TEST_CASE("two neighbouring numbers of a block of records become two columns") {
    double records[4][6];
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t i = 0; i < 6; ++i) records[r][i] = value(r, i);
    const auto check = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
        typename pack_columns<N>::records at;
        for (std::size_t r = 0; r < N; ++r) at[r] = reinterpret_cast<const std::byte*>(records[(3 * r + 1) % 4]);
        double first[N], second[N];
        const pack_columns<N> c(at, 3 * sizeof(double));
        c.first(first), c.second(second);
        const pack_columns<N> zero = c - c, rest = pack_columns<N>(at, 4 * sizeof(double)) - c;
        double nothing[N], ones[N];
        zero.second(nothing), rest.first(ones);
        for (std::size_t r = 0; r < N; ++r) {
            CHECK(first[r] == value((3 * r + 1) % 4, 3));
            CHECK(second[r] == value((3 * r + 1) % 4, 4));
            CHECK(nothing[r] == 0.0);
            CHECK(ones[r] == 1.0);
        }
    };
    check(std::integral_constant<std::size_t, 2>{});
    check(std::integral_constant<std::size_t, 4>{});
}

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

TEST_CASE("the vectors of a block of records become columns, with and without the fourth number") {
    double records[4][8];
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t i = 0; i < 8; ++i) records[r][i] = value(r, i);
    const auto check = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
        std::array<const std::byte*, N> at;
        for (std::size_t r = 0; r < N; ++r) at[r] = reinterpret_cast<const std::byte*>(records[3 - r]);
        double three[3][N], four[4][N];
        transpose(at, 4 * sizeof(double), three[0], three[1], three[2]);
        transpose(at, 1 * sizeof(double), four[0], four[1], four[2], four[3]);
        for (std::size_t r = 0; r < N; ++r) {
            for (std::size_t c = 0; c < 3; ++c) CHECK(three[c][r] == value(3 - r, 4 + c));
            for (std::size_t c = 0; c < 4; ++c) CHECK(four[c][r] == value(3 - r, 1 + c));
        }
    };
    check(std::integral_constant<std::size_t, 2>{});
    check(std::integral_constant<std::size_t, 4>{});
}

TEST_CASE("a quad holds four numbers in order, counts with them, and takes the fourth of another") {
    const four numbers{5.0, 6.0, 7.0, 8.0};
    CHECK(numbers.xyz() == vec3{5.0, 6.0, 7.0});
    const auto check = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
        using quad = clast::quad<N>;
        const quad a(1.0, 2.0, 3.0, 4.0), other = quad::load(&numbers), b = a.with_fourth_of(other);
        const quad sum = a + other, rest = a - other, twice = 2.0 * a;
        double stored[4];
        b.store(stored);
        for (std::size_t k = 0; k < 4; ++k) {
            CHECK(a[k] == static_cast<double>(k + 1));
            CHECK(b[k] == (k < 3 ? a[k] : 8.0));
            CHECK(stored[k] == b[k]);
            CHECK(sum[k] == static_cast<double>(2 * k + 6));
            CHECK(rest[k] == -4.0);
            CHECK(twice[k] == static_cast<double>(2 * k + 2));
        }
    };
    check(std::integral_constant<std::size_t, 2>{});
    check(std::integral_constant<std::size_t, 4>{});
}
