// SPDX-License-Identifier: MIT
#include <clast/core/random.hpp>

#include <array>
#include <cmath>
#include <cstdint>

#include <catch.hpp>

using namespace clast;

TEST_CASE("the mixer is that of SplitMix64") {
    // published first outputs for the seed 1234567 (Vigna's reference code)
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
    CHECK(mix(1234567 + golden) == 6457827717110365317ULL);
    CHECK(mix(1234567 + 2 * golden) == 3203168211198807973ULL);
    CHECK(mix(1234567 + 3 * golden) == 9817491932198370423ULL);
}

TEST_CASE("the numbers of a stream are fixed for ever") {
    // from an independent implementation in arbitrary-precision integers
    random_stream a;
    CHECK(a.bits() == 0x1cd364143cce4aaeULL);
    CHECK(a.bits() == 0x74152ffafb44a602ULL);
    CHECK(a.bits() == 0x12f768f77aafc9edULL);
    CHECK(random_stream{1, 0}.bits() == 0x5c5b2489b31beb7bULL);
    CHECK(random_stream{0, 1}.bits() == 0xbf97a9f9c15643e2ULL);
    random_stream b{42, 7};
    CHECK(uniform01(b) == 0.697065643894325);
    CHECK(uniform01(b) == 0.12815394510304023);
    CHECK(b.counter == 2);
    random_stream c{42, 7, 1}; // jump
    CHECK(uniform01(c) == 0.12815394510304023);
    static_assert(random_stream{0, 0}.bits() == 0x1cd364143cce4aaeULL);
}

TEST_CASE("uniform numbers have the moments and the independence of uniform numbers") {
    for (const std::uint64_t seed : {0ULL, 1ULL, 12345ULL}) {
        random_stream random{seed, 3};
        constexpr int n = 200000;
        std::array<int, 64> bin{};
        double sum = 0.0;
        double square = 0.0;
        double lag = 0.0;
        double last = 0.5;
        for (int i = 0; i < n; ++i) {
            const double u = uniform01(random);
            CHECK_FALSE((u < 0.0 || u >= 1.0));
            ++bin[static_cast<std::size_t>(u * 64.0)];
            sum += u;
            square += u * u;
            lag += (u - 0.5) * (last - 0.5);
            last = u;
        }
        const double root = std::sqrt(n);
        CHECK(std::abs(sum / n - 0.5) < 4.0 * std::sqrt(1.0 / 12.0) / root);
        CHECK(std::abs(square / n - 1.0 / 3.0) < 4.0 * std::sqrt(4.0 / 45.0) / root);
        CHECK(std::abs(lag / n) < 4.0 / 12.0 / root);
        double chi2 = 0.0;
        for (const int k : bin) chi2 += (k - n / 64.0) * (k - n / 64.0) / (n / 64.0);
        CHECK(chi2 > 63.0 - 4.0 * std::sqrt(126.0)); // too even is as wrong as too uneven
        CHECK(chi2 < 63.0 + 4.0 * std::sqrt(126.0));
    }
}

TEST_CASE("neighbouring streams and seeds are not correlated") {
    constexpr int n = 100000;
    for (const bool by_seed : {false, true}) {
        double product = 0.0;
        double sum = 0.0;
        double last = 0.5;
        for (std::uint64_t i = 0; i < n; ++i) {
            random_stream random{by_seed ? i : 9, by_seed ? 9 : i};
            const double u = uniform01(random);
            product += (u - 0.5) * (last - 0.5);
            sum += u;
            last = u;
        }
        CHECK(std::abs(sum / n - 0.5) < 4.0 * std::sqrt(1.0 / 12.0 / n));
        CHECK(std::abs(product / n) < 4.0 / 12.0 / std::sqrt(n));
    }
}

TEST_CASE("open uniform numbers are never 0 or 1, and ranges are respected") {
    random_stream random{5, 5};
    for (int i = 0; i < 10000; ++i) {
        const double u = uniform01_open(random);
        CHECK_FALSE((u <= 0.0 || u >= 1.0));
        const double v = uniform(random, -2.0, 3.0);
        CHECK_FALSE((v < -2.0 || v >= 3.0));
    }
}

TEST_CASE("directions are unit vectors, uniform over the sphere") {
    random_stream random{11, 0};
    constexpr int n = 100000;
    vec3 sum;
    mat3 square;
    double fourth = 0.0;
    for (int i = 0; i < n; ++i) {
        const vec3 d = direction(random);
        CHECK_FALSE(std::abs(norm(d) - 1.0) > 1e-15);
        sum += d;
        square += outer(d, d);
        fourth += d.x * d.x * d.x * d.x;
    }
    const double root = std::sqrt(n);
    for (int i = 0; i < 3; ++i) {
        CHECK(std::abs(sum[i] / n) < 4.0 * std::sqrt(1.0 / 3.0) / root);
        CHECK(std::abs(square(i, i) / n - 1.0 / 3.0) < 4.0 * std::sqrt(4.0 / 45.0) / root);
        CHECK(std::abs(square(i, (i + 1) % 3) / n) < 4.0 * std::sqrt(1.0 / 15.0) / root);
    }
    CHECK(std::abs(fourth / n - 0.2) < 4.0 * std::sqrt(1.0 / 9.0 - 0.04) / root);
}

TEST_CASE("random orientations are uniform over the rotations") {
    random_stream random{12, 0};
    constexpr int n = 100000;
    // uniform on the 3-sphere: <q_i> = 0, <q_i q_j> = delta/4, <q_i^4> = 1/8; angle: <trace R> = 0, <trace^2> = 1
    std::array<double, 4> mean{};
    std::array<double, 4> square{};
    std::array<double, 4> fourth{};
    double cross_wx = 0.0;
    double cross_yz = 0.0;
    double tr = 0.0;
    double tr2 = 0.0;
    vec3 image;
    for (int i = 0; i < n; ++i) {
        const quaternion q = orientation(random);
        const std::array<double, 4> c = {q.w, q.x, q.y, q.z};
        CHECK_FALSE(std::abs(c[0] * c[0] + c[1] * c[1] + c[2] * c[2] + c[3] * c[3] - 1.0) > 1e-15);
        for (std::size_t k = 0; k < 4; ++k) {
            mean[k] += c[k];
            square[k] += c[k] * c[k];
            fourth[k] += std::pow(c[k], 4);
        }
        cross_wx += q.w * q.x;
        cross_yz += q.y * q.z;
        const double t = trace(matrix(q));
        tr += t;
        tr2 += t * t;
        image += rotate(q, unit(vec3{1, 2, -3}));
    }
    const double root = std::sqrt(n);
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(std::abs(mean[k] / n) < 4.0 * 0.5 / root);
        CHECK(std::abs(square[k] / n - 0.25) < 4.0 * std::sqrt(1.0 / 8.0 - 1.0 / 16.0) / root);
        CHECK(std::abs(fourth[k] / n - 0.125) < 4.0 * std::sqrt(7.0 / 128.0 - 1.0 / 64.0) / root); // <q^8> = 7/128
    }
    CHECK(std::abs(cross_wx / n) < 4.0 * std::sqrt(1.0 / 24.0) / root);
    CHECK(std::abs(cross_yz / n) < 4.0 * std::sqrt(1.0 / 24.0) / root);
    CHECK(std::abs(tr / n) < 4.0 / root);
    CHECK(std::abs(tr2 / n - 1.0) < 4.0 * std::sqrt(2.0) / root); // <trace^4> = 3
    CHECK(norm(image / n) < 4.0 / root);
}
