// SPDX-License-Identifier: MIT
// Cost of neighbour searches: a random dense-looking cloud of n spheres, by n and by the ratio of largest to smallest
// radius.
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include <clast/searches/brute_force.hpp>
#include <clast/searches/cell_grid.hpp>

namespace {

using namespace clast;

/// Jittered grid at one sphere per (2 r)^3 of the mean radius; radii spread evenly in their logarithm over `ratio`.
std::vector<searches::sphere> cloud(std::size_t n, double ratio) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-0.5, 0.5);
    const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(n))));
    std::vector<searches::sphere> out(n);
    for (std::size_t k = 0; k < n; ++k) {
        const auto at = [&](std::size_t i) { return 0.02 * (static_cast<double>(i) + u(random)); };
        out[k] = {{at(k % side), at(k / side % side), at(k / side / side)},
                  0.01 * std::pow(ratio, u(random) - 0.5),
                  static_cast<std::int32_t>(k)};
    }
    return out;
}

template <class Search> void pairs(benchmark::State& state) {
    const auto spheres = cloud(static_cast<std::size_t>(state.range(0)), static_cast<double>(state.range(1)));
    std::size_t found = 0;
    for (auto _ : state) {
        const auto list = Search{}.pairs(spheres, 5e-4);
        found = list.size();
        benchmark::DoNotOptimize(list.data());
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.counters["pairs_per_sphere"] = static_cast<double>(found) / static_cast<double>(state.range(0));
}

BENCHMARK(pairs<searches::brute_force>)->ArgNames({"n", "ratio"})->Args({1'000, 1})->Args({10'000, 1});
BENCHMARK(pairs<searches::cell_grid>)
    ->ArgNames({"n", "ratio"})
    ->ArgsProduct({{1'000, 10'000, 100'000, 1'000'000}, {1}})
    ->ArgsProduct({{100'000}, {2, 10, 100}});

} // namespace

BENCHMARK_MAIN();
