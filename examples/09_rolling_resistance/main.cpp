// SPDX-License-Identifier: MIT
// A law of one's own that answers a moment: a ball that rolls on another comes to rest by a constant rolling torque.
#include <cmath>

#include <clast/clast.hpp>
#include <fmt/core.h>

// the linear law, and against rolling a moment of the size eta R F_n (contacts::rolling has springs as well)
struct rolls_hard : clast::contacts::linear {
    double eta = 0.0;

    template <class T>
    clast::contacts::wrench<T> operator()(const clast::contacts::overlap<T>& o, const clast::contacts::motion<T>& m,
                                          history& h, double dt) const {
        const clast::contacts::response<T> force = clast::contacts::linear::operator()(o, m, h, dt);
        const T twist = m.rx * o.nx + m.ry * o.ny + m.rz * o.nz;
        const T rx = m.rx - twist * o.nx, ry = m.ry - twist * o.ny, rz = m.rz - twist * o.nz;
        const T angle = std::sqrt(rx * rx + ry * ry + rz * rz); // rolled in this step (rad)
        const T size = eta * o.reduced_radius() * normal_force(o, m);
        const T share = angle > 1e-12 ? size / angle : T(0.0); // at rest no torque
        clast::contacts::wrench<T> all{force, -share * rx, -share * ry, -share * rz};
        all.dissipated += share * angle * angle;
        return all;
    }
};
static_assert(clast::contacts::contact_law<rolls_hard>);

struct two_balls : clast::triaxial_policies_default {
    using contact = rolls_hard;
    using body = clast::bodies::spheres;
    using boundary = clast::boundaries::none;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

int main() {
    constexpr double r = 0.01, depth = 1e-5, spin = 2.0; // m, m, rad/s
    clast::bodies::spheres balls;                        // pressed together, they roll on each other as gears do
    balls.add({-r + 0.5 * depth, 0, 0}, r), balls.add({r - 0.5 * depth, 0, 0}, r);
    balls.pebbles[0].w = {0, 0, spin}, balls.pebbles[1].w = {0, 0, -spin};
    const rolls_hard law{{1e6, 5e5, 0.5}, 0.05};
    clast::engine<two_balls> e({.grain_contact = law,
                                .platen_contact = {},
                                .lateral_contact = {},
                                .breakage = {},
                                .replacement = {},
                                .scheme = {.damping = 0.0},
                                .safety = 0.02},
                               balls, clast::spaces::open{});
    while (e.elastic_energy() > 0.0) e.step(10); // the springs push them apart
    // by hand: eta R times the impulse of the springs, sqrt(k m / 2) depth, over the moment of inertia of a ball
    const double m = balls.body_mass(0), slower = 0.05 * 0.5 * r * std::sqrt(0.5e6 * m) * depth / (0.4 * m * r * r);
    fmt::print("spins {:.4f} rad/s, by hand {:.4f}; rolling took {:.3g} J\n", e.grains.pebbles[0].w.z, spin - slower,
               e.losses().friction);
    return std::abs(e.grains.pebbles[0].w.z - (spin - slower)) < 1e-3 * slower ? 0 : 1;
}
