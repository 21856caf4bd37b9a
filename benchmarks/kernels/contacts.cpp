// SPDX-License-Identifier: MIT
// Cost of contact laws: a strip in the first cache, and strips of a list with gathering and the sums of bodies.
// A law of your own: #include its header and add one line, BENCHMARK_LAW(your_law{...}).
#include <algorithm>
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
        list.resize();
    }
};

template <class Law> void in_cache(benchmark::State& state, Law law) {
    chain<Law> c(128);
    strip<Law, sphere_view> s;
    gather(s, std::span<const pebble_pair>(c.list.pairs).first(s.length), sphere_view{c.pebbles.data()});
    for (auto& past : s.past) past = {};
    for (auto _ : state) {
        evaluate(s, s.past, law, 1e-6);
        benchmark::DoNotOptimize(s.fx[0]);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(s.length));
}

template <class Law> void in_list(benchmark::State& state, Law law) {
    chain<Law> c(static_cast<std::size_t>(state.range(0)));
    strip<Law, sphere_view> s;
    std::vector<body_load> load(c.pebbles.size());
    for (auto _ : state) {
        for (std::size_t at = 0; at < c.list.size(); at += s.length) {
            evaluate(s, c.list, at, std::min(at + s.length, c.list.size()), sphere_view{c.pebbles.data()}, law, 1e-6,
                     [](auto&, std::size_t) {});
            each_load(s, [&](std::size_t k, const contact_load& one) {
                one.add_to_i(load[static_cast<std::size_t>(c.list.pairs[at + k].i)]);
                one.add_to_j(load[static_cast<std::size_t>(c.list.pairs[at + k].j)]);
            });
        }
        benchmark::DoNotOptimize(load.data());
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
