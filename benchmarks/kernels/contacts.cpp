// SPDX-License-Identifier: MIT
// Cost of contact laws: a strip in the first cache, and strips of a list with gathering and rows.
// A law of your own: #include its header and add one line, BENCHMARK_LAW(your_law{...}).
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include <clast/contacts/linear.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/engine/kernel.hpp>

namespace {

using namespace clast;

/// Pairs of touching spheres in rows: pebble k against k + 1, and every second against k + 7.
template <class Law> struct chain {
    std::vector<pebble_motion> pebbles;
    contact_list<typename Law::history> list;

    explicit chain(std::size_t n) {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        const auto any = [&](double size) { return vec3{size * u(random), size * u(random), size * u(random)}; };
        for (std::size_t k = 0; k < n; ++k)
            pebbles.push_back(
                {vec3{0.0199 * static_cast<double>(k), 0.0, 0.0} + any(1e-5), 0.01, any(0.1), 100.0, any(5.0), 1e6});
        for (std::int32_t k = 0; k + 7 < static_cast<std::int32_t>(n); ++k) {
            list.pairs.push_back({k, k + 1});
            if (k % 2 == 0) list.pairs.push_back({k, k + 7});
        }
        list.resize_rows();
    }
};

template <class Law> void in_cache(benchmark::State& state, Law law) {
    chain<Law> c(128);
    strip<Law> s;
    gather(s, std::span(c.list.pairs).first(strip<Law>::length), c.pebbles.data(),
           [](std::size_t, const pebble_pair&, vec3&, vec3&) {});
    for (auto _ : state) {
        evaluate(s, law, 1e-6);
        benchmark::DoNotOptimize(s.fx[0]);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(strip<Law>::length));
}

template <class Law> void in_list(benchmark::State& state, Law law) {
    chain<Law> c(static_cast<std::size_t>(state.range(0)));
    strip<Law> s;
    for (auto _ : state) {
        evaluate(c.list, 0, c.list.size(), c.pebbles.data(), law, 1e-6, s,
                 [](std::size_t, const pebble_pair&, vec3&, vec3&) {});
        benchmark::DoNotOptimize(c.list.rows.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(c.list.size()));
}

#define BENCHMARK_LAW(...)                                                                                             \
    BENCHMARK_CAPTURE(in_cache, #__VA_ARGS__, __VA_ARGS__);                                                            \
    BENCHMARK_CAPTURE(in_list, #__VA_ARGS__, __VA_ARGS__)->Arg(1'000)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)

BENCHMARK_LAW(contacts::linear{1e6, 5e5, 0.3});
BENCHMARK_LAW(contacts::linear_dashpot{1e6, 5e5, 0.3, 1e3, 2650.0});

} // namespace

BENCHMARK_MAIN();
