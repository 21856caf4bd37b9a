// SPDX-License-Identifier: MIT
// A specimen as the preparation leaves it, handed over to a test: where its grains and walls are, and nothing else that
// forces follow from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/boundaries/vessel_settings.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/scene.hpp>
#include <clast/protocol/stage.hpp>
#include <clast/protocol/stage_record.hpp>

namespace clast {

/// A grain in its place, at rest.
struct prepared_grain {
    vec3 x;       ///< centre (m)
    quaternion q; ///< turns the axes of the shape into those of the world; of spheres 1 0 0 0
    body_losses lost;

    template <class A> void archive(A& a) { a(x, q, lost.friction, lost.damping); }
};

/// What a preparation hands over. The same whatever the membrane, and whether grains may break: one specimen for
/// several tests. Shapes and sizes of the grains are those of the setup that it was made with.
struct prepared_specimen {
    std::vector<prepared_grain> grains;
    double radius = 0.0;           ///< of the vessel: apothem, half side of a box (m)
    double bottom = 0.0;           ///< level of its bottom (m)
    double height = 0.0;           ///< m
    double reference_height = 0.0; ///< what strains before shear count from (m)
    double reference_volume = 0.0; ///< m^3
    double dt = 0.0;               ///< time step then (s)
    engine_totals totals;          ///< so far; what grains and contacts held is booked as taken out
    std::vector<stage_record> records;

    /// The vessel that it is in, with what else a wall is made of.
    boundaries::vessel_settings in(boundaries::vessel_settings wall) const {
        wall.radius = radius, wall.bottom = bottom, wall.top = bottom + height;
        return wall;
    }
    template <class A> void archive(A& a) {
        a(grains, radius, bottom, height, reference_height, reference_volume, dt, totals, records);
    }
};

namespace protocol {

/// Takes grains out of a scene in which nothing is broken, in the order of their bodies.
template <class Engine> std::vector<prepared_grain> grains_in_place(const Engine& sim) {
    std::vector<prepared_grain> all(sim.grains.body_count());
    for (std::size_t b = 0; b < all.size(); ++b) {
        all[b].x = sim.grains.centre(b);
        if constexpr (requires { sim.grains.turning; }) all[b].q = sim.grains.turning[b].q;
        all[b].lost = sim.grains.losses[b];
    }
    return all;
}
/// What a scene in which nothing is broken hands over now. What bodies and contacts hold is booked as taken out.
template <class Engine>
prepared_specimen handed_over(const Engine& sim, double reference_height, double reference_volume,
                              const std::vector<stage_record>& records) {
    const auto& b = sim.boundary;
    prepared_specimen p{grains_in_place(sim), b.radius(), b.bottom(),   b.height(), reference_height,
                        reference_volume,     sim.dt(),   sim.totals(), records};
    p.totals.initial_energy -= sim.kinetic_energy() + sim.potential_energy() + sim.elastic_energy();
    return p;
}
/// Begins with what was handed over: grains in their places, at rest, in the vessel or in the membrane that takes its
/// place.
template <class Engine>
void begin_at_rest(Engine& sim, const prepared_specimen& p, const boundaries::vessel_settings& wall, bool membrane) {
    auto vessel = std::remove_cvref_t<decltype(sim.boundary)>::made(p.in(wall));
    sim.begin_at_rest(membrane ? vessel.resized(wall) : std::move(vessel), p.totals, p.dt);
}
/// The stage that takes a specimen over. Throws input_error where there is none.
inline std::size_t taking_over(const std::vector<stage>& stages) {
    for (std::size_t k = 0; k < stages.size(); ++k)
        if (stages[k].hands_over) return k;
    throw input_error("protocol", "no stage that takes over a specimen", "a stage with `hands_over`",
                      "Add protocol::consolidation().");
}
/// Puts grains and vessel of a specimen into another scene of the same grains. Throws input_error where their number is
/// another one.
template <class Engine>
void put_in_place(Engine& sim, const prepared_specimen& p, const boundaries::vessel_settings& wall) {
    const std::vector<prepared_grain>& all = p.grains;
    if (all.size() != sim.grains.body_count())
        throw input_error("prepared specimen", fmt::format("{} grains", all.size()),
                          fmt::format("{}, as the setup has", sim.grains.body_count()),
                          "Give the setup the shapes, size, grading, porosity and seed of the preparation.");
    for (std::size_t b = 0; b < all.size(); ++b) {
        sim.grains.set_place(b, all[b].x, all[b].q);
        sim.grains.losses[b] = all[b].lost;
    }
    sim.boundary = std::remove_cvref_t<decltype(sim.boundary)>::made(p.in(wall));
}

} // namespace protocol

} // namespace clast
