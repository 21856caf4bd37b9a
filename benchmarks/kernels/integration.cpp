// SPDX-License-Identifier: MIT
// Cost of integration alone: rotation of bodies with equal and unequal moments, a step of spheres, a step of clumps
// with and without the placing of their pebbles.
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include <clast/engine/specimen.hpp>
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

/// Forces that leave bodies where they are on average.
std::vector<load_sum> loads() {
    std::mt19937 random(2);
    std::vector<load_sum> out(bodies);
    for (load_sum& one : out) one.force = any(random, 1.0), one.moment = any(random, 1e-3);
    return out;
}
template <class Specimen, class Place> void bodies_step(benchmark::State& state, Specimen& s, Place&& place) {
    std::vector<load_sum> load = loads();
    const double damping = static_cast<double>(state.range(0)) / 100.0;
    for (auto _ : state) {
        for (std::size_t b = 0; b < bodies; ++b) {
            s.advance(b, load[b], dt, damping);
            place(b);
            load[b].force = -load[b].force, load[b].moment = -load[b].moment;
        }
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bodies));
}
void sphere_advance(benchmark::State& state) {
    sphere_specimen s;
    for (std::size_t b = 0; b < bodies; ++b) s.add({0.02 * static_cast<double>(b), 0.0, 0.0}, 0.01);
    bodies_step(state, s, [](std::size_t) {});
}
BENCHMARK(sphere_advance)->ArgName("damping_percent")->Arg(0)->Arg(70);

void clump_step(benchmark::State& state, bool placing) {
    specimen s;
    s.shapes.push_back(state.range(1) == 4 ? shapes::tetrahedron_4(0.02) : shapes::apollonian_14(0.02));
    for (std::size_t b = 0; b < bodies; ++b) s.add(0, {0.02 * static_cast<double>(b), 0.0, 0.0}, {});
    bodies_step(state, s, [&](std::size_t b) { s.place(b, [=](std::size_t) { return placing; }); });
}
void clump_advance(benchmark::State& state) { clump_step(state, false); }
void clump_advance_and_place(benchmark::State& state) { clump_step(state, true); }
BENCHMARK(clump_advance)->ArgNames({"damping_percent", "pebbles"})->ArgsProduct({{0, 70}, {4}});
BENCHMARK(clump_advance_and_place)->ArgNames({"damping_percent", "pebbles"})->ArgsProduct({{0, 70}, {4, 14}});

} // namespace

BENCHMARK_MAIN();
