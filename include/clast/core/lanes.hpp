// SPDX-License-Identifier: MIT
// Eight doubles side by side, and vectors of them: the same arithmetic text serves one item or eight.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <clast/core/vector.hpp>

// Compilers remark that functions of vectors are called in another way with other instruction sets. Nothing here is
// called across libraries; the remark stays off because templates draw it at the very end of the file that uses them.
#if defined(__GNUC__) // Clang too
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

// A program built for every x86-64 processor has registers of two doubles; nearly every processor has some of four, and
// many of eight. Loops that decide the speed are compiled for all three (clast::fast), and the processor is asked when
// they run.
#if defined(CLAST_OPENMP_SIMD) && defined(__x86_64__) && !defined(__AVX__) && defined(__GNUC__)
#define CLAST_WIDER_AT_RUN_TIME
#endif

namespace clast {

/// How many doubles code handles at once that works by registers (core/packs.hpp): 4, or 2 where they hold no more; and
/// how many the registers of a vectorised loop hold: up to 8.
template <std::size_t N, std::size_t Loop = N> struct register_width : std::integral_constant<std::size_t, N> {
    static constexpr std::size_t of_loops = Loop;
};
/// The width of the registers that the program is built for.
#if defined(__AVX512F__)
using own_width = register_width<4, 8>;
#elif defined(__AVX__)
using own_width = register_width<4>;
#else
using own_width = register_width<2>;
#endif

#if defined(CLAST_WIDER_AT_RUN_TIME)
namespace detail {
template <class F> [[gnu::noinline, gnu::flatten, gnu::target("avx512f,avx512vl,avx512dq")]] auto run_by_eights(F f) {
    return f(register_width<4, 8>{});
}
template <class F> [[gnu::noinline, gnu::flatten, gnu::target("avx2")]] auto run_by_fours(F f) {
    return f(register_width<4>{});
}
} // namespace detail
#endif
/// f(register_width), compiled for the widest registers that the processor has. f is copied: what it holds by value
/// need not be read again behind every store. A lambda should be always_inline: GCC may otherwise compile it on its
/// own, where it no longer knows what does not overlap, and then its loops are not vectorised.
template <class F> [[gnu::always_inline]] inline auto with_widest_registers(F f) {
#if defined(CLAST_WIDER_AT_RUN_TIME)
    if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) return detail::run_by_eights(f);
    if (__builtin_cpu_supports("avx2")) return detail::run_by_fours(f);
#endif
    return f(own_width{});
}

/// Eight doubles, or four or two, with elementwise arithmetic (a vector extension that GCC and Clang share; any
/// instruction set, compiled to what the target has).
using lane8 = double __attribute__((vector_size(64)));
using lane4 = double __attribute__((vector_size(32)));
using lane2 = double __attribute__((vector_size(16)));
inline constexpr std::size_t lanes = 8;
/// A number of items, rounded up to whole lanes.
constexpr std::size_t whole_lanes(std::size_t items) { return (items + lanes - 1) / lanes * lanes; }
template <class L>
concept several = std::same_as<L, lane2> || std::same_as<L, lane4> || std::same_as<L, lane8>;
/// How many doubles they are.
template <several L> inline constexpr std::size_t lanes_in = sizeof(L) / sizeof(double);
/// What long expressions over eight numbers are written in: where registers hold four doubles or two, eight would take
/// two or four registers each, and most of them would be in memory.
template <class Width> using lanes_of = std::conditional_t<Width::of_loops == 8, lane8, lane4>;

namespace detail { // typedefs, because Clang does not let `using` lower an alignment
typedef double lane2_anywhere __attribute__((vector_size(16), aligned(8), may_alias));
typedef double lane4_anywhere __attribute__((vector_size(32), aligned(8), may_alias));
typedef double lane8_anywhere __attribute__((vector_size(64), aligned(8), may_alias));
template <class L> struct anywhere { using type = lane8_anywhere; };
template <> struct anywhere<lane2> { using type = lane2_anywhere; };
template <> struct anywhere<lane4> { using type = lane4_anywhere; };
} // namespace detail
/// From and to memory of any alignment. (GCC copies by memcpy in pieces of the registers that the program is built for,
/// also where it may use wider ones, and then waits for the pieces: three times the time of a step with AVX2.)
template <several L> [[gnu::always_inline]] inline L load(const void* p) {
    return *static_cast<const typename detail::anywhere<L>::type*>(p);
}
template <several L> [[gnu::always_inline]] inline void store(void* p, const L& v) {
    *static_cast<typename detail::anywhere<L>::type*>(p) = v;
}

/// Whether eight numbers in memory are all 0 (and not -0).
inline bool all_zero8(const double* p) {
    std::uint64_t word[lanes], bits = 0;
    std::memcpy(word, p, sizeof word);
    for (std::size_t l = 0; l < lanes; ++l) bits |= word[l];
    return bits == 0;
}

/// Larger of two, absolute value and sign (0 for 0), for one number or for lanes.
inline double larger(double a, double b) { return a > b ? a : b; }
template <several L> L larger(const L& a, const L& b) { return a > b ? a : b; }
inline double magnitude(double a) { return larger(a, -a); }
template <several L> L magnitude(const L& a) { return larger(a, -a); }
inline double sign_of(double a) { return a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : 0.0; }
template <several L> L sign_of(const L& a) {
    const L zero{}, one = zero + 1.0;
    return (a > zero ? one : zero) - (a < zero ? one : zero);
}

/// Square root, and a / b with 1 where b is 0, for one number or for lanes.
inline double root(double a) { return std::sqrt(a); }
template <several L> L root(const L& a) {
    alignas(64) double x[lanes];
    store(x, a);
    for (std::size_t l = 0; l < lanes_in<L>; ++l)
        x[l] = std::sqrt(x[l]); // compilers make one instruction of it, or a few
    return load<L>(x);
}
inline double ratio(double a, double b) { return b > 0.0 ? a / b : 1.0; }
template <several L> L ratio(const L& a, const L& b) {
    const L zero{}, one = zero + 1.0;
    return b > zero ? a / b : one;
}

/// Cartesian vectors of eight items, or fewer.
template <several L> struct vec3_of { L x, y, z; };
template <several L> vec3_of<L> operator+(const vec3_of<L>& a, const vec3_of<L>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <several L> vec3_of<L> operator-(const vec3_of<L>& a, const vec3_of<L>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <several L> vec3_of<L> operator*(const L& s, const vec3_of<L>& a) { return {s * a.x, s * a.y, s * a.z}; }
template <several L> vec3_of<L> operator*(double s, const vec3_of<L>& a) { return {s * a.x, s * a.y, s * a.z}; }
template <several L> vec3_of<L>& operator+=(vec3_of<L>& a, const vec3_of<L>& b) { return a = a + b; }
template <several L> L dot(const vec3_of<L>& a, const vec3_of<L>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <several L> L norm2(const vec3_of<L>& a) { return dot(a, a); }
template <several L> vec3_of<L> cross(const vec3_of<L>& a, const vec3_of<L>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Vectors stored as x, y, z blocks of eight; of fewer those at the beginning of each block.
template <several L> vec3_of<L> load3(const double* p) {
    return {load<L>(p), load<L>(p + lanes), load<L>(p + 2 * lanes)};
}
template <several L> void store3(double* p, const vec3_of<L>& v) {
    store(p, v.x), store(p + lanes, v.y), store(p + 2 * lanes, v.z);
}

} // namespace clast
