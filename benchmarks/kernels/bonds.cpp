// SPDX-License-Identifier: MIT
// Cost of bonds: steps of a pool of clusters that ring on under no load, by number of clusters, shape and inner steps.
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include <clast/bonds/cluster_pool.hpp>
#include <clast/grains/shape.hpp>

namespace {

using namespace clast;

void cluster_step(benchmark::State& state) {
    const auto clusters = static_cast<std::size_t>(state.range(0));
    const shape kind = state.range(1) == 4 ? shapes::tetrahedron_4(0.02) : shapes::apollonian_14(0.02);
    bonds::parallel cement;
    cement.tensile_strength = cement.cohesion = 1e30;
    bonds::cluster_pool pool(bonds::lattice(kind, cement, 2650.0), 0.0);
    const std::vector<bonds::state> unloaded(pool.bonds());
    for (std::size_t c = 0; c < clusters; ++c) pool.add(unloaded);

    const std::size_t balls_per_batch = pool.lanes * pool.shape().size();
    std::vector<bonds::ball_motion> balls(pool.batches() * balls_per_batch);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-1e-3, 1e-3);
    for (std::size_t k = 0; k < balls.size(); ++k)
        balls[k] = {{u(random), u(random), u(random)}, {}, pool.shape().offset[k % pool.shape().size()]};
    const std::vector<bonds::pebble_load> load(balls_per_batch);
    std::vector<vec3> moved(balls_per_batch);
    std::vector<bonds::break_report> broken;
    const double dt = 0.99 * static_cast<double>(state.range(2)) / pool.shape().highest_frequency;

    for (auto _ : state)
        for (std::size_t b = 0; b < pool.batches(); ++b)
            pool.advance(b, dt, std::span(balls).subspan(b * balls_per_batch, balls_per_batch), load, moved, broken);
    benchmark::DoNotOptimize(moved.data());
    if (!broken.empty()) state.SkipWithError("a bond broke");
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(clusters * pool.bonds()) *
                            pool.substeps(dt));
}

BENCHMARK(cluster_step)
    ->ArgNames({"clusters", "pebbles", "inner_steps"})
    ->ArgsProduct({{8, 64, 512, 4'096}, {4, 14}, {1, 10}});

} // namespace

BENCHMARK_MAIN();
