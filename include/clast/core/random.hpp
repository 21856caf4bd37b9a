// SPDX-License-Identifier: MIT
// Deterministic random numbers: a counter-based generator, so that number n of stream s is a pure function of
// (seed, s, n), the same for any number of threads, and a checkpoint needs three integers.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>

#include <clast/core/vector.hpp>

namespace clast {

/// Finaliser of SplitMix64, a bijection of 64-bit integers (Steele, Lea & Flood 2014, OOPSLA, "Fast splittable
/// pseudorandom number generators"; constants of variant 13 of Stafford).
constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

/// Random stream. Give each use its own stream (grain id, purpose) instead of sharing one, so that adding a grain does
/// not change the numbers of the others. `counter` is the number of values drawn so far; set it to replay or to skip.
struct random_stream {
    std::uint64_t seed = 0;
    std::uint64_t stream = 0;
    std::uint64_t counter = 0;

    /// Next 64 random bits: SplitMix64 with a start that is hashed from (seed, stream).
    constexpr std::uint64_t bits() {
        constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
        const std::uint64_t start = mix(mix(seed + golden) ^ (stream * 0xd1342543de82ef95ULL + golden));
        return mix(start + ++counter * golden);
    }

    template <class A> void archive(A& a) { a(seed, stream, counter); }

    bool operator==(const random_stream&) const = default;
};

/// Uniform in [0, 1), multiples of 2^-53.
constexpr double uniform01(random_stream& random) { return static_cast<double>(random.bits() >> 11) * 0x1.0p-53; }

/// Uniform in (0, 1): what a logarithm needs. Odd multiples of 2^-53.
constexpr double uniform01_open(random_stream& random) {
    return (static_cast<double>(random.bits() >> 12) + 0.5) * 0x1.0p-52;
}

/// Uniform in [low, high), up to rounding.
constexpr double uniform(random_stream& random, double low, double high) {
    return low + (high - low) * uniform01(random);
}

/// Unit vector, uniform over the sphere (Archimedes: height and azimuth are uniform).
inline vec3 direction(random_stream& random) {
    const double z = 2.0 * uniform01(random) - 1.0;
    const double azimuth = 2.0 * std::numbers::pi * uniform01(random);
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

/// Rotation, uniform over all rotations (Shoemake 1992, Graphics Gems III, "Uniform random rotations").
inline quaternion orientation(random_stream& random) {
    const double u = uniform01(random);
    const double a = 2.0 * std::numbers::pi * uniform01(random);
    const double b = 2.0 * std::numbers::pi * uniform01(random);
    const double r = std::sqrt(1.0 - u);
    const double s = std::sqrt(u);
    return {s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)};
}

static_assert(std::is_trivially_copyable_v<random_stream> && sizeof(random_stream) == 24);

} // namespace clast
