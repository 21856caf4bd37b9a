// SPDX-License-Identifier: MIT
// Cost of neighbour searches: by the number of spheres in a dense packing of like ones, and by the ratio of largest to
// smallest radius.
// A search of your own: #include its header and add one line, BENCHMARK_SEARCH(1'000'000, your_search).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>

#include <clast/core/random.hpp>
#include <clast/searches/brute_force.hpp>
#include <clast/searches/cell_grid.hpp>
#include <clast/searches/hierarchical_grid.hpp>

#include "packing.hpp"

namespace {

using namespace clast;
using searches::sphere;
using spheres = std::vector<sphere>;

double volume(const spheres& all) {
    double sum = 0.0;
    for (const sphere& s : all) sum += 4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius;
    return sum;
}

/// n spheres (a multiple of 1000) of a dense packing, in a random order as after long flow.
spheres packing(std::size_t n) {
    const auto& base = kernels::base_of_spheres();
    const auto blocks = n / base.grains.body_count();
    const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(blocks)) - 1e-9));
    spheres all;
    for (std::size_t k = 0; k < blocks; ++k) {
        const vec3 corner{static_cast<double>(k % side), static_cast<double>(k / side % side),
                          static_cast<double>(k / side / side)};
        for (std::size_t b = 0; b < base.grains.body_count(); ++b)
            all.push_back({base.grains.centre(b) + scale(base.space.edges(), corner), base.grains.bounding_radius(b)});
    }
    random_stream random{1, 2};
    for (std::size_t i = all.size() - 1; i > 0; --i) std::swap(all[i], all[random.bits() % (i + 1)]);
    return all;
}

/// n spheres of diameters from 1 / ratio to 1, the same volume of each size, at random in a cube that they fill to 60 %
/// (they overlap).
spheres graded(std::size_t n, double ratio) {
    random_stream random{1, 3};
    spheres all(n);
    for (sphere& s : all) s.radius = 0.5 / ratio / std::cbrt(1.0 - uniform01(random) * (1.0 - std::pow(ratio, -3.0)));
    const double edge = std::cbrt(volume(all) / 0.6);
    for (sphere& s : all) s.centre = edge * vec3{uniform01(random), uniform01(random), uniform01(random)};
    return all;
}

template <class Search> void measure(benchmark::State& state, const spheres& all, double margin) {
    std::size_t found = 0;
    for (auto _ : state) {
        const auto list = Search{}.pairs(all, margin);
        found = list.size();
        benchmark::DoNotOptimize(list.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
    state.counters["pairs"] = static_cast<double>(found);
    state.counters["pairs_per_sphere"] = static_cast<double>(found) / static_cast<double>(all.size());
}

/// Margin in thousandths of the mean diameter.
template <class Search> void by_number(benchmark::State& state) {
    measure<Search>(state, packing(static_cast<std::size_t>(state.range(0))),
                    0.02 * 0.001 * static_cast<double>(state.range(1)));
}
/// Margin: 3 % of the smallest diameter.
template <class Search> void by_ratio(benchmark::State& state) {
    const auto ratio = static_cast<double>(state.range(1));
    measure<Search>(state, graded(static_cast<std::size_t>(state.range(0)), ratio), 0.03 / ratio);
}

void numbers(benchmark::internal::Benchmark* b, std::int64_t most) {
    b->ArgNames({"n", "margin"})->Unit(benchmark::kMicrosecond);
    for (std::int64_t n = 1000; n <= most; n *= 10)
        for (const std::int64_t margin : {30, 100}) b->Args({n, margin});
}
void ratios(benchmark::internal::Benchmark* b, std::int64_t n) {
    b->ArgNames({"n", "ratio"})->Unit(benchmark::kMicrosecond);
    for (const std::int64_t ratio : {1, 3, 10, 100}) b->Args({n, ratio});
}

/// Both of them for a type, up to `most` spheres (of unlike ones 100 000 at most).
#define BENCHMARK_SEARCH(most, ...)                                                                                    \
    BENCHMARK(by_number<__VA_ARGS__>)->Apply([](auto* b) { numbers(b, most); });                                       \
    BENCHMARK(by_ratio<__VA_ARGS__>)->Apply([](auto* b) { ratios(b, std::min<std::int64_t>(most, 100'000)); })

BENCHMARK_SEARCH(10'000, searches::brute_force); // more would take longer than a second
BENCHMARK_SEARCH(1'000'000, searches::cell_grid);
BENCHMARK_SEARCH(1'000'000, searches::hierarchical_grid);

} // namespace

BENCHMARK_MAIN();
