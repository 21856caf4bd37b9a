// SPDX-License-Identifier: MIT
// A field acts on every grain: a heap settles in a box, and the floor carries its weight. One grain is fixed in
// mid-air.
#include <cmath>
#include <cstdint>

#include <clast/clast.hpp>
#include <fmt/core.h>

struct heap : clast::triaxial_policies_default {
    using field = clast::fields::gravity;
    using constraint = clast::constraints::held;
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

int main() {
    using namespace clast;
    bodies::clumps rocks;
    rocks.shapes = {shapes::tetrahedron_4(0.02), shapes::sphere(0.015)}; // m
    for (int k = 0; k < 100; ++k) {
        random_stream random{1, static_cast<std::uint64_t>(k)};
        rocks.add(k % 2, {0.024 * (k % 5 - 2), 0.024 * (k / 5 % 5 - 2), 0.03 + 0.024 * (k / 25)}, orientation(random));
    }
    const contacts::linear law{1e5, 5e4, 0.4}, wall{1e5, 5e4, 0.0}; // k_n, k_s (N/m), mu
    engine<heap> sim({.grain_contact = law,
                      .platen_contact = wall,
                      .lateral_contact = wall,
                      .breakage = {},
                      .replacement = {},
                      .scheme = {.damping = 0.3}},
                     rocks,
                     boundaries::box({.low = {-0.06, -0.06, 0.0},
                                      .high = {0.06, 0.06, 0.2},
                                      .contact_stiffness_floor = law.kn})); // the default field: 9.81 m/s^2 down
    sim.constraint.fix(62);                                                 // in the middle of the third layer

    double weight = 0.0; // N
    for (std::size_t g = 0; g < sim.grains.body_count(); ++g) weight += 9.81 * sim.grains.body_mass(g);
    fmt::print("weight {:.4f} N\n", weight);
    for (int tenth = 1; tenth <= 15; ++tenth) {
        while (sim.time() < 0.1 * tenth) sim.step(10);
        fmt::print("{:.1f} s  floor {:7.4f} N  held grain {:7.4f} N  kinetic {:.1e} J  in the field {:.4f} J\n",
                   sim.time(), sim.loads()[0].force, sim.constraint.reaction(62).z, sim.kinetic_energy(),
                   sim.potential_energy());
    }
    const double carried = sim.loads()[0].force + sim.constraint.reaction(62).z;
    return std::abs(carried / weight - 1.0) < 1e-3 ? 0 : 1;
}
