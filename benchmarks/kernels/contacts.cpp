// SPDX-License-Identifier: MIT
// Cost of contact laws with gathering: few contacts in the first cache, and a list with the sums of bodies.
// A law of your own: #include its header and add one line, BENCHMARK_LAW(your_law{...}).
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include <clast/contacts/by_material.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/contacts/rolling.hpp>
#include <clast/engine/kernel.hpp>

namespace {

using namespace clast;

/// Pairs of touching spheres in rows: pebble k against k + 1, and every second against k + 7.
template <class Law> struct chain {
    std::vector<pebble_motion> pebbles;
    std::vector<std::uint8_t> materials; ///< two by turns
    contact_list<typename Law::history> list;

    explicit chain(std::size_t n) {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        const auto any = [&](double size) { return vec3{size * u(random), size * u(random), size * u(random)}; };
        for (std::size_t k = 0; k < n; ++k)
            pebbles.push_back(
                {vec3{0.0199 * static_cast<double>(k), 0.0, 0.0} + any(1e-5), 0.01, any(0.1), 100.0, any(5.0), 1e6});
        for (std::size_t k = 0; k < n; ++k) materials.push_back(k % 3 == 0 ? 1 : 0);
        for (std::int32_t k = 0; k + 7 < static_cast<std::int32_t>(n); ++k) {
            list.pairs.push_back({k, k + 1});
            if (k % 2 == 0) list.pairs.push_back({k, k + 7});
        }
        list.resize();
    }
    sphere_view view() const { return {pebbles.data(), materials.data()}; }
};

/// Looks at results only.
struct look_job {
    template <class Strip> [[gnu::always_inline]] void adjust(Strip&, const contact_block&) const {}
    template <class Width, class Strip>
    [[gnu::always_inline]] void take(Width, const Strip& s, const contact_block& block) const {
        benchmark::DoNotOptimize(s.fx[block.at]);
    }
};
/// Adds to the loads of bodies.
struct sum_job {
    load_sum* loads;

    template <class Strip> [[gnu::always_inline]] void adjust(Strip&, const contact_block&) const {}
    template <class Width, class Strip>
    [[gnu::always_inline]] void take(Width width, const Strip& s, const contact_block& block) const {
        each_load(width, s, block, *this);
    }
    template <class Load>
    [[gnu::always_inline]] void operator()(std::size_t, const pebble_pair& bodies, const Load& load) const {
        load.add_to_i(loads[bodies.i]);
        load.add_to_j(loads[bodies.j]);
    }
};

template <class Law> void in_cache(benchmark::State& state, Law law) {
    chain<Law> c(128);
    for (auto _ : state) evaluate(c.list, {0, c.list.size()}, c.view(), law, 1e-6, look_job{});
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(c.list.size()));
}

template <class Law> void in_list(benchmark::State& state, Law law) {
    chain<Law> c(static_cast<std::size_t>(state.range(0)));
    std::vector<load_sum> load(c.pebbles.size());
    for (auto _ : state) {
        evaluate(c.list, {0, c.list.size()}, c.view(), law, 1e-6, sum_job{load.data()});
        benchmark::DoNotOptimize(load.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(c.list.size()));
}

contacts::by_material<contacts::linear, 2> two_rocks() {
    return contacts::by_material<contacts::linear, 2>::of([](std::size_t a, std::size_t b) {
        return contacts::linear{1e6 * static_cast<double>(1 + a + b), 5e5, 0.3};
    });
}

#define BENCHMARK_LAW(...)                                                                                             \
    BENCHMARK_CAPTURE(in_cache, #__VA_ARGS__, __VA_ARGS__);                                                            \
    BENCHMARK_CAPTURE(in_list, #__VA_ARGS__, __VA_ARGS__)->Arg(1'000)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)

BENCHMARK_LAW(contacts::linear{1e6, 5e5, 0.3});
BENCHMARK_LAW(two_rocks());
BENCHMARK_LAW(contacts::linear_dashpot{1e6, 5e5, 0.3, 1e3});
BENCHMARK_LAW(contacts::rolling<contacts::linear>{{1e6, 5e5, 0.3}, 10.0, 0.1, 10.0, 0.1});

} // namespace

BENCHMARK_MAIN();
