// SPDX-License-Identifier: MIT
// Cost of breakage criteria: the utilisation of a grain whose load is known.
// A criterion of your own: #include its header and add one line, BENCHMARK_CRITERION(your_criterion{...}).
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include <clast/criteria/one_of.hpp>
#include <clast/criteria/weibull.hpp>

namespace {

using namespace clast;

template <class Criterion> void utilisation(benchmark::State& state, const Criterion& criterion) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    std::vector<criteria::grain_load> loads(1024);
    for (std::size_t k = 0; k < loads.size(); ++k) {
        criteria::grain_load& one = loads[k];
        one.diameter = 0.02 * (0.5 + u(random));
        one.volume = 0.3 * one.diameter * one.diameter * one.diameter;
        one.largest_force = 5e3 * u(random);
        one.contact_radius = 0.25 * one.diameter, one.contact_modulus = 2.6e10;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j <= i; ++j)
                one.stress(i, j) = one.stress(j, i) = i == j ? 2e6 * u(random) : 1e6 * u(random);
        one.grain = static_cast<std::int64_t>(k);
    }
    for (auto _ : state)
        for (const criteria::grain_load& one : loads) {
            double answer = criterion.utilisation(one);
            benchmark::DoNotOptimize(answer);
        }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(loads.size()));
}

#define BENCHMARK_CRITERION(...) BENCHMARK_CAPTURE(utilisation, #__VA_ARGS__, __VA_ARGS__)

const criteria::crushing_strength rock(23.2e6);

BENCHMARK_CRITERION(criteria::nominal_force{rock});
BENCHMARK_CRITERION(criteria::hertz_contact::literal(rock));
BENCHMARK_CRITERION(criteria::hertz_contact::calibrated(rock));
BENCHMARK_CRITERION(criteria::octahedral{rock});
BENCHMARK_CRITERION(criteria::mean_stress{rock});
BENCHMARK_CRITERION(criteria::major_principal{rock});
BENCHMARK_CRITERION(criteria::any{criteria::octahedral{rock}});
BENCHMARK_CRITERION(criteria::weibull<criteria::nominal_force>{{rock}, 3.0, 1});

} // namespace

BENCHMARK_MAIN();
