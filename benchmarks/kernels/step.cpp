// SPDX-License-Identifier: MIT
// Cost of a whole step, lists included, of dense packings in a periodic cell (packing.hpp): spheres by number and
// threads, clumps by number and pebbles; and of the renewal of an engine's lists alone.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>

#include <benchmark/benchmark.h>

#include "packing.hpp"

namespace {

constexpr std::int64_t batch = 20; // steps of one iteration

/// Steps of an engine, which goes on where the last call with these arguments left it.
template <class P>
void measure(benchmark::State& state, const clast::engine<P>& base, std::int64_t n, const kernels::request& wanted) {
    const double of_base = static_cast<double>(base.grains.body_count());
    const int copies = static_cast<int>(std::lround(std::cbrt(static_cast<double>(n) / of_base)));
    static std::optional<clast::engine<P>> kept;
    static std::tuple<const void*, std::int64_t, int> kept_for;
    static double bytes = 0.0;
    if (const auto now = std::tuple(static_cast<const void*>(&base), n, wanted.threads); !kept || kept_for != now) {
        kept.reset();
        const double before = kernels::heap_in_use();
        kept.emplace(kernels::repeated(base, copies, wanted));
        kept_for = now;
        bytes = kernels::heap_in_use() - before;
    }
    const clast::engine<P>& e = *kept;
    // shear without end would make the cell flatter than its grains: begin again before it has become half as high
    const auto height = [](const clast::engine<P>& one) {
        const clast::vec3 edges = one.space.edges();
        return std::min({edges.x, edges.y, edges.z}) / std::cbrt(edges.x * edges.y * edges.z);
    };
    std::int64_t renewals = 0, searches = 0;
    clast::engine_totals before = e.totals();
    const auto count = [&] {
        renewals += e.totals().renewals - before.renewals;
        searches += e.totals().rebuilds - before.rebuilds;
    };
    for (auto _ : state) {
        kept->step(batch);
        if (height(e) > 0.5) continue;
        state.PauseTiming();
        count();
        kept.emplace(kernels::repeated(base, copies, wanted));
        before = e.totals();
        state.ResumeTiming();
    }
    count();
    const double bodies = static_cast<double>(e.grains.body_count());
    state.SetItemsProcessed(batch * state.iterations() * static_cast<std::int64_t>(bodies));
    state.counters["n"] = bodies;
    state.counters["phi"] = e.grains.solid_volume() / e.space.volume();
    state.counters["pairs_per_grain"] = static_cast<double>(e.heavy_contacts().size()) / bodies;
    const auto per_1000_steps = [&](std::int64_t many) {
        return 1000.0 * static_cast<double>(many) / static_cast<double>(batch * state.iterations());
    };
    state.counters["renewals_per_1000_steps"] = per_1000_steps(renewals);
    state.counters["searches_per_1000_steps"] = per_1000_steps(searches);
    // what the engine holds on the heap after its first steps (mallinfo2), less what was there before
    state.counters["bytes_per_sphere"] = bytes / static_cast<double>(e.grains.pebble_count());
}

void sphere_step(benchmark::State& state) {
    kernels::request wanted;
    wanted.threads = static_cast<int>(state.range(1));
    measure(state, kernels::base_of_spheres(), state.range(0), wanted);
}
void clump_step(benchmark::State& state) {
    measure(state, kernels::base_of_clumps(static_cast<int>(state.range(1))), state.range(0), {});
}
/// An engine builds its lists anew for a boundary that it is given.
template <class P> void renew(benchmark::State& state, const clast::engine<P>& base, std::int64_t n) {
    const double of_base = static_cast<double>(base.grains.body_count());
    clast::engine<P> e =
        kernels::repeated(base, static_cast<int>(std::lround(std::cbrt(static_cast<double>(n) / of_base))), {});
    for (auto _ : state) e.set_boundary(e.boundary);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(e.grains.body_count()));
    state.counters["pairs_per_grain"] =
        static_cast<double>(e.heavy_contacts().size()) / static_cast<double>(e.grains.body_count());
}
void sphere_rebuild(benchmark::State& state) { renew(state, kernels::base_of_spheres(), state.range(0)); }
void clump_rebuild(benchmark::State& state) {
    renew(state, kernels::base_of_clumps(static_cast<int>(state.range(1))), state.range(0));
}

BENCHMARK(sphere_step)
    ->ArgNames({"n", "threads"})
    ->ArgsProduct({{1'000, 8'000, 27'000, 125'000, 1'000'000}, {1}})
    ->ArgsProduct({{8'000, 125'000}, {2}})
    ->UseRealTime();
BENCHMARK(clump_step)->ArgNames({"n", "pebbles"})->ArgsProduct({{216, 1'728, 13'824}, {4, 14}});
BENCHMARK(sphere_rebuild)->ArgName("n")->Arg(1'000)->Arg(8'000)->Arg(27'000)->Arg(125'000)->Arg(1'000'000);
BENCHMARK(clump_rebuild)->ArgNames({"n", "pebbles"})->ArgsProduct({{216, 1'728, 13'824}, {4, 14}});

} // namespace

BENCHMARK_MAIN();
