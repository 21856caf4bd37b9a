// SPDX-License-Identifier: MIT
// Cost of integration alone: rotation of bodies with equal and unequal moments, a step of spheres, a step of clumps
// by the number of pebbles that are placed.
// A scheme of your own: #include its header and add one line, BENCHMARK_SCHEME(your_scheme{...}).
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include <clast/bodies/clumps.hpp>
#include <clast/bodies/spheres.hpp>
#include <clast/integrators/rotation.hpp>

namespace {

using namespace clast;

constexpr std::size_t bodies = 1024;
constexpr double dt = 1e-5;

vec3 any(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> u(-size, size);
    return {u(random), u(random), u(random)};
}

/// spin: rad/s; slow ones take a series, fast ones an iteration.
void rotation_step(benchmark::State& state, const vec3& inverse_inertia, double spin) {
    std::mt19937 random(1);
    std::vector<quaternion> q(bodies);
    std::vector<vec3> l(bodies);
    for (vec3& one : l) one = any(random, spin / inverse_inertia.x);
    for (auto _ : state)
        for (std::size_t k = 0; k < bodies; ++k) q[k] = advance_rotation(q[k], l[k], inverse_inertia, dt).q;
    benchmark::DoNotOptimize(q.data());
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bodies));
}
BENCHMARK_CAPTURE(rotation_step, equal_moments, vec3{1e6, 1e6, 1e6}, 1.0);
BENCHMARK_CAPTURE(rotation_step, unequal_moments, vec3{1e6, 7e5, 5e5}, 1.0);
BENCHMARK_CAPTURE(rotation_step, unequal_moments_fast, vec3{1e6, 7e5, 5e5}, 1e3);

/// Bodies under forces that leave them where they are on average; `placed` pebbles of each clump follow.
template <class Specimen, class Scheme>
void bodies_step(benchmark::State& state, Specimen& s, std::size_t placed, const Scheme& scheme) {
    std::mt19937 random(2);
    std::vector<moving_body> moving;
    std::vector<typename Specimen::reference> since;
    body_items wanted;
    wanted.start.push_back(0);
    for (std::size_t b = 0; b < bodies; ++b) {
        moving.push_back({b, {any(random, 1.0), any(random, 1e-3)}});
        since.push_back(s.refer(b));
        for (std::size_t k = 0; k < placed; ++k)
            wanted.items.push_back(static_cast<std::int32_t>(s.pebbles_of(b).begin + k));
        wanted.start.push_back(static_cast<std::uint32_t>(wanted.items.size()));
    }
    const std::vector<double> margins(bodies, 1.0);
    std::vector<integrators::body_memory<Scheme>> memory(bodies);
    for (auto _ : state) {
        margin_use use = s.advance(std::span<const moving_body>(moving),
                                   integrators::rule<Scheme>{scheme, {}, dt, dt, memory.data()}, wanted,
                                   {since, margins, {1.0, 1.0, 1.0}}, [](std::size_t) { return 0.0; });
        benchmark::DoNotOptimize(use);
        for (moving_body& one : moving) one.load.force = -one.load.force, one.load.moment = -one.load.moment;
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bodies));
}
template <class Scheme> void spheres_step(benchmark::State& state, const Scheme& scheme) {
    bodies::spheres s;
    for (std::size_t b = 0; b < bodies; ++b) s.add({0.02 * static_cast<double>(b), 0.0, 0.0}, 0.01);
    bodies_step(state, s, 0, scheme);
}
template <class Scheme>
void clumps_step(benchmark::State& state, const shape& form, std::size_t placed, const Scheme& scheme) {
    bodies::clumps s;
    s.shapes.push_back(form);
    for (std::size_t b = 0; b < bodies; ++b) s.add(0, {0.02 * static_cast<double>(b), 0.0, 0.0}, {});
    bodies_step(state, s, placed, scheme);
}

integrators::leapfrog damped(const benchmark::State& state) { return {static_cast<double>(state.range(0)) / 100.0}; }
void sphere_advance(benchmark::State& state) { spheres_step(state, damped(state)); }
BENCHMARK(sphere_advance)->ArgName("damping_percent")->Arg(0)->Arg(70);

void clump_advance(benchmark::State& state) {
    clumps_step(state,
                state.range(1) == 4 ? shapes::tetrahedron_4(circumscribed(0.02))
                                    : shapes::apollonian_14(circumscribed(0.02)),
                static_cast<std::size_t>(state.range(2)), damped(state));
}
BENCHMARK(clump_advance)
    ->ArgNames({"damping_percent", "pebbles", "placed"})
    ->ArgsProduct({{0, 70}, {4}, {0, 4}})
    ->ArgsProduct({{70}, {14}, {0, 14}});

/// One evaluation of a step, of spheres and of clumps of 4, all of whose pebbles are placed.
template <class Scheme> void scheme_of_spheres(benchmark::State& state, const Scheme& scheme) {
    spheres_step(state, scheme);
}
template <class Scheme> void scheme_of_clumps(benchmark::State& state, const Scheme& scheme) {
    clumps_step(state, shapes::tetrahedron_4(circumscribed(0.02)), 4, scheme);
}
#define BENCHMARK_SCHEME(...)                                                                                          \
    BENCHMARK_CAPTURE(scheme_of_spheres, #__VA_ARGS__, __VA_ARGS__);                                                   \
    BENCHMARK_CAPTURE(scheme_of_clumps, #__VA_ARGS__, __VA_ARGS__)

BENCHMARK_SCHEME(integrators::leapfrog{0.7});

} // namespace

BENCHMARK_MAIN();
