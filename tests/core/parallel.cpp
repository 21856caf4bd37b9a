// SPDX-License-Identifier: MIT
#include <clast/core/parallel.hpp>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <thread>
#include <vector>

#include <clast/core/random.hpp>
#include <clast/core/vector.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

// lengths around the chunk of a sum and around the shortest parallel loop
constexpr std::size_t lengths[] = {0, 1, 2, 255, 256, 257, 511, 512, 1023, 1024, 1025, 5000, 100003};
constexpr int counts[] = {1, 2, 3, 8};

/// Numbers of very different size, so that the order of a sum shows in its bits.
std::vector<double> rough(std::size_t n) {
    random_stream random{7, n};
    std::vector<double> x(n);
    for (double& v : x) v = uniform(random, -1, 1) * std::pow(10.0, uniform(random, -8, 8));
    return x;
}
bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

} // namespace

TEST_CASE("a parallel loop visits every index once, for any number of threads and any length") {
    for (const int threads : counts)
        for (const std::size_t n : lengths)
            for (const std::size_t serial_below : {std::size_t{1}, std::size_t{256}}) {
                std::vector<int> visits(n, 0);
                execution{threads}.for_each(
                    n, [&](std::size_t i) { ++visits[i]; }, serial_below);
                const auto once = [](int v) { return v == 1; };
                CHECK(std::all_of(visits.begin(), visits.end(), once));
            }
}

TEST_CASE("a sum has the same bits for any number of threads, and the value of a plain loop") {
    for (const std::size_t n : lengths) {
        const std::vector<double> x = rough(n);
        const auto value = [&](std::size_t i) { return x[i]; };
        const double one = execution{1}.sum(n, 0.0, value);
        for (const int threads : counts) CHECK(same_bits(execution{threads}.sum(n, 0.0, value), one));
        double magnitude = 0.0;
        for (const double v : x) magnitude += std::abs(v);
        CHECK(std::abs(one - std::accumulate(x.begin(), x.end(), 0.0)) <= 1e-13 * magnitude);
    }
}

TEST_CASE("a sum of vectors and a count: any type with +=") {
    const std::size_t n = 3000;
    const auto vectors = [](std::size_t i) { return vec3{1, static_cast<double>(i), -2}; };
    for (const int threads : counts) {
        CHECK(execution{threads}.sum(n, vec3{}, vectors) == vec3{3000, 2999.0 * 1500, -6000});
        CHECK(execution{threads}.sum(n, 0, [](std::size_t i) { return i % 3 == 0 ? 1 : 0; }) == 1000);
    }
}

TEST_CASE("the indices for which something holds, ascending, and each asked once") {
    for (const std::size_t n : lengths) {
        const std::vector<double> x = rough(n);
        std::vector<std::uint32_t> positive;
        for (std::uint32_t i = 0; i < n; ++i)
            if (x[i] > 0.0) positive.push_back(i);
        for (const int threads : counts) {
            const execution run(threads);
            std::vector<int> asked(n, 0);
            CHECK(run.where(n, [&](std::size_t i) { return ++asked[i], x[i] > 0.0; }) == positive);
            CHECK(std::count(asked.begin(), asked.end(), 1) == static_cast<std::ptrdiff_t>(n));
            CHECK(run.where(n, [](std::size_t) { return true; }).size() == n);
            CHECK(run.where(n, [](std::size_t) { return false; }).empty());
        }
    }
}

TEST_CASE("a maximum is that of a plain loop, and not below its floor") {
    for (const std::size_t n : lengths) {
        const std::vector<double> x = rough(n);
        double largest = -1e300;
        for (const double v : x) largest = std::max(largest, v);
        for (const int threads : counts) {
            CHECK(same_bits(execution{threads}.max(n, -1e300, [&](std::size_t i) { return x[i]; }), largest));
            CHECK(execution{threads}.max(n, 1e300, [&](std::size_t i) { return x[i]; }) == 1e300);
        }
    }
}

TEST_CASE("there is at least one thread") { CHECK(available_threads() >= 1); }

TEST_CASE("thousands of short loops in a row, with and without pauses, lose and repeat no iteration") {
    const execution run(3), copy = run; // copies share their threads
    std::vector<std::uint32_t> visits(640, 0);
    for (std::uint32_t k = 1; k <= 20000; ++k) {
        (k % 2 == 0 ? run : copy)
            .for_each(
                visits.size(), [&](std::size_t i) { ++visits[i]; }, 1 + k % 100);
        if (k % 4000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20)); // the helpers fall asleep
        if (std::any_of(visits.begin(), visits.end(), [k](std::uint32_t v) { return v != k; })) FAIL("loop " << k);
    }
    CHECK(run.threads() == 3);
    CHECK(execution(0).threads() == 1);
    CHECK(execution(-5).threads() == 1);
}
