// SPDX-License-Identifier: MIT
// Cost of bonds: steps of a pool of clusters that ring on under no load, by number of clusters, shape, inner steps of
// the smallest, and number of different sizes (from 1 to 3). A bond counts once for each inner step of its own cluster.
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
    const shape kind =
        state.range(1) == 4 ? shapes::tetrahedron_4(circumscribed(0.02)) : shapes::apollonian_14(circumscribed(0.02));
    bonds::parallel cement;
    cement.tensile_strength = cement.cohesion = 1e30;
    bonds::cluster_pool pool(bonds::lattice(kind, cement, 2650.0), 0.0);
    const std::vector<bonds::state> unloaded(pool.bonds());
    const auto sizes = static_cast<std::size_t>(state.range(3));
    const auto like = [&](std::size_t c) {
        const double share = sizes > 1 ? static_cast<double>(c % sizes) / static_cast<double>(sizes - 1) : 0.0;
        return bonds::likeness{1.0 + 2.0 * share};
    };
    for (std::size_t c = 0; c < clusters; ++c) pool.add(unloaded, 1.0, like(c));
    pool.pack();

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
    std::int64_t steps = 0;
    for (std::size_t c = 0; c < clusters; ++c) steps += pool.substeps(dt, like(c));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pool.bonds()) * steps);
}

BENCHMARK(cluster_step)
    ->ArgNames({"clusters", "pebbles", "inner_steps", "sizes"})
    ->ArgsProduct({{8, 64, 512, 4'096}, {4, 14}, {1, 10}, {1}})
    ->ArgsProduct({{512, 4'096}, {4, 14}, {10}, {200}});

} // namespace

BENCHMARK_MAIN();
