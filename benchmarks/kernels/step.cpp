// SPDX-License-Identifier: MIT
// Cost of a whole step of spheres in a periodic cell, rebuilds included, by number of spheres, skin and threads.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include <benchmark/benchmark.h>

#include <clast/boundaries/periodic_cell.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/criteria/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/replacements/none.hpp>

namespace {

using namespace clast;

struct spheres : triaxial_policies_default {
    using specimen = sphere_specimen;
    using boundary = boundaries::periodic_cell;
    using breakage = criteria::none;
    using replacement = replacements::none;
};

/// About n spheres as closely packed planes allow, slightly out of place and slightly overlapping, in pure shear.
void whole_step(benchmark::State& state) {
    const auto side = static_cast<int>(std::lround(std::cbrt(static_cast<double>(state.range(0)))));
    const double skin = static_cast<double>(state.range(1)) / 1000.0 * 0.02, gap = 0.0199;
    sphere_specimen s;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-1e-4, 1e-4);
    for (int k = 0; k < side * side * side; ++k) {
        const auto at = [&](int i) { return gap * (i - 0.5 * (side - 1)) + u(random); };
        s.add({at(k % side), at(k / side % side), at(k / side / side)}, 0.01);
    }
    const contacts::linear law{1e7, 5e6, 0.3};
    boundaries::periodic_cell cell({gap * side, gap * side, gap * side});
    for (std::size_t a = 0; a < 3; ++a) cell.axes[a].rate = a == 2 ? -1.0 : 0.5;
    engine<spheres> e({.grain_contact = law,
                       .platen_contact = law,
                       .lateral_contact = law,
                       .breakage = {},
                       .replacement = {},
                       .damping = 0.3,
                       .skin = skin,
                       .run = execution(static_cast<int>(state.range(2)))},
                      s, cell);
    for (int k = 0; k < 200; ++k) e.step();
    const std::int64_t before = e.totals().rebuilds;
    for (auto _ : state) e.step();
    const double n = static_cast<double>(side) * side * side;
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
    state.counters["pairs_per_sphere"] = static_cast<double>(e.slow_contacts().size()) / n;
    state.counters["steps_per_rebuild"] = static_cast<double>(state.iterations()) /
                                          static_cast<double>(std::max<std::int64_t>(1, e.totals().rebuilds - before));
}

BENCHMARK(whole_step)
    ->ArgNames({"n", "skin_permille_of_d", "threads"})
    ->ArgsProduct({{1'000, 10'000, 100'000, 1'000'000}, {25}, {1}})
    ->ArgsProduct({{10'000}, {12, 50, 100}, {1}})
    ->ArgsProduct({{10'000, 100'000}, {25}, {2}})
    ->UseRealTime();

} // namespace

BENCHMARK_MAIN();
