// SPDX-License-Identifier: MIT
// How a specimen is prepared: from a cloud to grains at rest at the size of the test, under hardly any stress.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <clast/core/quantity.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/stress.hpp>
#include <clast/protocol/stage.hpp>

namespace clast::protocol {

/// Which bodies touched something in the last step, by their numbers.
template <class Engine> std::vector<std::uint8_t> touching(const Engine& sim) {
    std::vector<std::uint8_t> touch(sim.grains.movable_count(), 0);
    sim.each_contact([&](const auto& row, const auto& pair) {
        if (row.depth > 0.0) touch[sim.grains.body_of(pair.i)] = touch[sim.grains.body_of(pair.j)] = 1;
    });
    sim.each_wall_row([&](const auto& w) {
        if (w.touch.size > 0) touch[sim.grains.body_of(w.pebble)] = 1;
    });
    return touch;
}
/// Gives a grain another velocity (m/s) and no spin.
template <class Engine> void set_motion(Engine& sim, std::size_t body, const vec3& v) {
    sim.grains.shift(body, {}, v - sim.grains.velocity(body));
    if constexpr (requires { sim.grains.set_spin(body, vec3{}); }) sim.grains.set_spin(body, {});
}
/// Gives the grains that touch nothing the motion of a uniform strain about the middle of a vessel: the paper moves
/// "walls and particles" towards the centre (section 2.3). axial, lateral: strain rates (1/s), compression positive.
/// What that changes of their energy is booked as brought in with initial velocities; of grains under force, whose
/// velocities are those of half a step ago, it would not be known to better than force x way in a step.
template <class Engine> void move_free_grains(Engine& sim, double axial, double lateral) {
    const double before = sim.kinetic_energy() + sim.potential_energy();
    const double middle = sim.boundary.bottom() + 0.5 * sim.boundary.height();
    const std::vector<std::uint8_t> touch = touching(sim);
    for (std::size_t b = 0; b < sim.grains.body_count(); ++b) {
        if (!sim.grains.is_swept(b) || touch[b] != 0) continue;
        const vec3 x = sim.grains.centre(b);
        set_motion(sim, b, {-lateral * x.x, -lateral * x.y, -axial * (x.z - middle)});
    }
    sim.count_energy_since(before);
}
/// All grains stop; booked in the same way.
template <class Engine> void stop_grains(Engine& sim) {
    const double before = sim.kinetic_energy() + sim.potential_energy();
    for (std::size_t b = 0; b < sim.grains.body_count(); ++b)
        if (sim.grains.is_swept(b)) set_motion(sim, b, {});
    sim.count_energy_since(before);
}

/// Largest |p'| (Pa) in the three measurement spheres of a specimen: at a sixth, half and five sixths of its height, as
/// large as fits there and within 0.7 of its radius.
template <class Engine> double largest_stress_in_spheres(const Engine& sim) {
    const auto& b = sim.boundary;
    const double r = std::min(0.7 * b.radius(), b.height() / 6.0);
    double largest = 0.0;
    for (const double z : {1.0 / 6.0, 0.5, 5.0 / 6.0})
        largest =
            std::max(largest, std::abs(measure::mean_stress_in_sphere(sim, {0, 0, b.bottom() + z * b.height()}, r)));
    return largest;
}

/// Notes in a view how far a specimen is from rest. c: of its contacts now.
template <class Engine> void note_rest(stage_view& v, const Engine& sim, const measure::contact_state& c) {
    v.unbalanced_ratio = c.contacts > 0 ? c.unbalanced_ratio : 1.0;
    v.mean_contact_force = c.mean_contact_force;
    v.coordination = c.coordination;
    v.kinetic_density = sim.kinetic_energy() / sim.boundary.volume();
    v.sphere_stress = largest_stress_in_spheres(sim);
}

/// Says of a stage that goes on short of its end how it stands. jammed: its walls advance no more.
inline std::string short_of(const stage& s, const stage_view& v, double friction, double porosity, bool jammed) {
    return fmt::format("{} short of '{}': porosity {:.4f}, p' = {:.3g} % of the confining stress, friction {:g}",
                       jammed ? "jammed" : "at rest", s.end.text, porosity, 100.0 * v.p / v.confining, friction);
}

/// At rest as the paper asks (section 2.3): unbalanced ratio below 0.1 % and p' below `part` of the confining stress of
/// the setup in three spheres (1 kPa of 2 MPa: 5e-4); or, where there is no network and both are 0/0, hardly any force
/// and hardly any motion.
inline condition at_rest(double part) {
    return (until::unbalanced_below(1e-3) && until::spheres_below_of_setup(part)) ||
           (until::coordination_below(1.0) && until::unloaded_of_setup(1e-3) && until::kinetic_below_of_setup(1e-7));
}

/// Cloud to specimen, sizes and stress of the setup of the test:
/// - compact: walls and grains move to the size of the specimen, the grains with the walls until they carry something.
///   Walls give way at 0.75 % of the confining stress. Where the specimen jams short of its size, the friction between
///   pebbles is lowered, the same steps for all shapes; where it jams without friction, its size is out of reach.
/// - relax: grains stop, walls stand still, until the specimen is at rest under 0.05 % of the confining stress. Where
/// it
///   rests under more, the friction is lowered further.
/// - seat: only where that failed; walls give way at half of this stress, with the friction of the material.
inline std::vector<stage> preparation() {
    constexpr double rest = 5e-4; // of the confining stress
    const std::vector<double> frictions{0.15, 0.05, 0.0};
    std::vector<stage> s;
    s.push_back({.name = "compact",
                 .axial = drive_by::size_of_setup(),
                 .lateral = drive_by::size_of_setup(),
                 .end = until::size_reached(),
                 .breakage = false,
                 .moves_grains = true,
                 .yields_at = 15.0 * rest,
                 .then_friction = frictions,
                 .give_up_gently = true});
    s.push_back({.name = "relax",
                 .end = at_rest(rest),
                 .most_steps = 200'000,
                 .breakage = false,
                 .from_rest = true,
                 .keeps_friction = true,
                 .then_friction = frictions,
                 .give_up_gently = true});
    s.push_back({.name = "seat",
                 .axial = drive_by::size_of_setup(),
                 .lateral = drive_by::size_of_setup(),
                 .end = at_rest(rest),
                 .most_steps = 400'000,
                 .breakage = false,
                 .yields_at = 0.5 * rest,
                 .yields_back = true,
                 .ends_at_standstill = true,
                 .skip_if_relaxed = true,
                 .if_stuck = "The specimen does not come to rest under a small stress: raise the porosity."});
    return s;
}

inline std::vector<stage> preparation(quantities::length diameter, quantities::length height) {
    std::vector<stage> s = preparation();
    for (stage& one : s) {
        if (one.axial.how != axis_drive::kind::reach) continue;
        one.axial = drive_by::size(height);
        one.lateral = drive_by::size(0.5 * diameter);
    }
    return s;
}

} // namespace clast::protocol
