// SPDX-License-Identifier: MIT
// One grain between two platens, with the engine itself: at 90 % of its strength the clump becomes a cluster of balls,
// and the bonds of the cluster break.
#include <cmath>
#include <numbers>

#include <clast/clast.hpp>
#include <fmt/core.h>

struct my_policies : clast::triaxial_policies_default { // nominal_force and modified (MPRM) are the defaults
    using boundary = clast::boundaries::solid_strips;
};

int main() {
    using namespace clast;
    // a grain of 4 balls that stands on two of them
    bodies::clumps rock;
    rock.shapes.push_back(shapes::tetrahedron_4(0.02));
    rock.add(0, {0, 0, 0}, {});
    const double r = rock.pebbles[0].radius, half = rock.pebbles[0].x.z + r;

    const contacts::piece pebble{5.8e6, 2.9e6, 0.3}, platen{3.2e8, 1.6e8, 0.0}, wall{3.2e6, 1.6e6, 0.0};
    const contacts::linear at_wall = contacts::linear::between(pebble, wall);
    const boundaries::solid_strips cell(
        {.radius = 0.05, .bottom = -half, .top = half, .smallest_radius = r, .contact_stiffness_floor = at_wall.kn});

    engine<my_policies> sim({.grain_contact = contacts::linear::between(pebble, pebble),
                             .platen_contact = contacts::linear::between(pebble, platen),
                             .lateral_contact = at_wall,
                             .breakage = {criteria::crushing_strength(23.2e6)}, // weak rock: F/d^2 (Pa)
                             .replacement = {}},
                            rock, cell);
    sim.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.01}; // each platen (m/s)

    const double spacing = 1e-4; // between rows (m)
    for (int row = 0; sim.boundary.height() > 1.7 * half;) {
        sim.step();
        for (const fracture_event& e : sim.take_events())
            fmt::print("  bond {} breaks in {}: N = {:.0f} N, V = {:.0f} N\n", e.bond,
                       e.mode == break_mode::tension ? "tension" : "shear", e.normal_force, e.shear_force);
        const double way = 2 * half - sim.boundary.height();
        if (way < row * spacing) continue;
        fmt::print("{:.2f} mm  {:6.0f} N  replaced {}\n", 1e3 * way, sim.loads()[1].force, sim.totals().replaced);
        ++row;
    }
    return sim.totals().broken_tension + sim.totals().broken_shear > 0 ? 0 : 1;
}
