// SPDX-License-Identifier: MIT
// Cost of the lateral wall: what touches a pebble near it, the force, and its share for each facet, by kind of wall and
// number of pebbles. Tiles and rings stand where a servo under uneven loads has moved them, so that there are steps.
// A surface of your own: #include its header and add one line, BENCHMARK_SURFACE(your_surface{...}); it should stand
// around the origin, at most 0.5 m away.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include <clast/boundaries/box.hpp>
#include <clast/boundaries/concepts.hpp>
#include <clast/boundaries/rigid_cylinder.hpp>
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/stepped_tiles.hpp>
#include <clast/boundaries/tiles.hpp>

namespace {

using namespace clast;

constexpr double radius = 0.15, height = 0.7, pebble = 0.0045, stiffness = 2e6;

template <class Wall> Wall uneven(std::mt19937& random) {
    Wall wall({.radius = radius,
               .bottom = -0.5 * height,
               .top = 0.5 * height,
               .smallest_radius = pebble,
               .contact_stiffness_floor = stiffness});
    std::uniform_real_distribution<double> u(0.0, 2.0);
    boundaries::drives drives;
    drives.lateral = {boundaries::drive::mode::servo, 1e6, 0.1, 0.5};
    std::vector<boundaries::facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    std::vector<double> of_target(loads.size());
    for (double& share : of_target) share = u(random);
    for (int k = 0; k < 100; ++k) {
        for (int f = boundaries::first_lateral_facet; f < wall.facet_count(); ++f) {
            boundaries::facet_load& one = loads[static_cast<std::size_t>(f)];
            one.force = of_target[static_cast<std::size_t>(f)] * drives.lateral.value * wall.area(f);
            one.stiffness = stiffness, one.contacts = 1;
        }
        wall.control(loads, drives, 1e-4);
        wall.advance(1e-4);
    }
    return wall;
}

/// What touches each pebble, its force, and the share of every facet.
template <class Surface> void push(benchmark::State& state, const Surface& wall, const std::vector<vec3>& pebbles) {
    std::vector<boundaries::facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    std::size_t touching = 0, touched = 0;
    for (auto _ : state) {
        touching = touched = 0;
        for (const vec3& x : pebbles) {
            const boundaries::touches t = wall.touch(x, pebble);
            touching += t.size > 0;
            for (const boundaries::touch& one : t) {
                loads[static_cast<std::size_t>(one.facet)].add(one, stiffness * one.depth, stiffness);
                ++touched;
            }
        }
        benchmark::DoNotOptimize(loads.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pebbles.size()));
    state.counters["touching"] = static_cast<double>(touching) / static_cast<double>(pebbles.size());
    state.counters["facets_per_touching"] =
        static_cast<double>(touched) / static_cast<double>(std::max<std::size_t>(1, touching));
}

template <class Wall> void touch_and_push(benchmark::State& state) {
    std::mt19937 random(1);
    const Wall wall = uneven<Wall>(random);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    std::vector<vec3> pebbles(static_cast<std::size_t>(state.range(0)));
    for (vec3& x : pebbles) {
        // at the surface in front, with a gap or an overlap of up to 4 % of the radius
        const double angle = std::numbers::pi * u(random), z = 0.49 * height * u(random);
        const double reach = pebble * (1.0 + 0.04 * u(random));
        double inside = 0.5 * radius, beyond = 1.3 * radius;
        for (int k = 0; k < 30; ++k) {
            const double rho = 0.5 * (inside + beyond);
            x = {rho * std::cos(angle), rho * std::sin(angle), z};
            (wall.touch(x, reach).size > 0 ? beyond : inside) = rho;
        }
    }
    push(state, wall, pebbles);
}

/// The same for any surface, with pebbles at random where facets are near, at any gap below r / 25 or overlap up to it.
template <boundaries::surface Surface> void touch_surface(benchmark::State& state, const Surface& surface) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-0.5 - pebble, 0.5 + pebble);
    std::vector<vec3> pebbles;
    for (long tries = 0; pebbles.size() < 1'000 && tries < 20'000'000; ++tries) {
        const vec3 x{u(random), u(random), u(random)};
        if (!surface.near(x, 1.04 * pebble)) continue;
        const boundaries::touches t = surface.touch(x, pebble);
        if (std::all_of(t.begin(), t.end(), [](const auto& one) { return one.depth <= 0.04 * pebble; }) &&
            surface.touch(x, 1.04 * pebble).size > 0)
            pebbles.push_back(x);
    }
    if (pebbles.size() < 1'000) return state.SkipWithError("hardly a pebble touches it within 0.5 m of the origin");
    push(state, surface, pebbles);
}
BENCHMARK(touch_and_push<boundaries::tiles>)->ArgName("pebbles")->Arg(1'000)->Arg(10'000);
BENCHMARK(touch_and_push<boundaries::stepped_tiles>)->ArgName("pebbles")->Arg(1'000)->Arg(10'000);
BENCHMARK(touch_and_push<boundaries::ring_walls>)->ArgName("pebbles")->Arg(1'000)->Arg(10'000);
BENCHMARK(touch_and_push<boundaries::solid_strips>)->ArgName("pebbles")->Arg(1'000)->Arg(10'000);

boundaries::box square_wall() {
    return boundaries::box({{-radius, -radius, -0.5 * height}, {radius, radius, 0.5 * height}, 3.2e8, stiffness});
}
boundaries::rigid_cylinder round_wall() {
    return boundaries::rigid_cylinder({.radius = radius,
                                       .bottom = -0.5 * height,
                                       .top = 0.5 * height,
                                       .largest_pebble = pebble,
                                       .contact_stiffness_floor = stiffness});
}

#define BENCHMARK_SURFACE(...) BENCHMARK_CAPTURE(touch_surface, #__VA_ARGS__, __VA_ARGS__)

BENCHMARK_SURFACE(square_wall());
BENCHMARK_SURFACE(round_wall());

} // namespace

BENCHMARK_MAIN();
