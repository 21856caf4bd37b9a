// SPDX-License-Identifier: MIT
// An integrator of one's own: viscous damping instead of local, beside the library's, on a ball that bounces on
// another.
#include <array>
#include <cmath>

#include <clast/clast.hpp>
#include <fmt/core.h>

// leapfrog in a resting liquid: -gamma m v needs the mass, which a kick divides by; so the kick itself slows
struct in_a_liquid {
    double rate = 0.0; // gamma (1/s)

    struct memory {};                                                               // nothing is kept of a body
    static constexpr std::array<clast::integrators::stage, 1> stages{{{1.0, 1.0}}}; // one evaluation per step
    static constexpr double longest = 1e-6;                                         // of a step here (s)
    clast::vec3 extra(const clast::vec3&, const clast::vec3&) const { return {}; }  // no force beside the load
    clast::vec3 kick(const clast::vec3& v, const clast::vec3& force, double by) const {
        const double half = 0.5 * rate * longest; // v(n+1/2) - v(n-1/2) = ... - gamma dt (v(n+1/2) + v(n-1/2)) / 2
        return ((1.0 - half) * v + by * force) / (1.0 + half);
    }
};
static_assert(clast::integrators::scheme<in_a_liquid>);

struct two_balls : clast::triaxial_policies_default {
    using scheme = in_a_liquid;
    using body = clast::bodies::spheres;
    using boundary = clast::boundaries::none;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

int main() {
    clast::bodies::spheres balls;
    balls.add({-0.02, 0, 0}, 0.01), balls.add({0.02, 0, 0}, 0.01);
    balls.pebbles[0].v = {1.0, 0, 0}, balls.pebbles[1].v = {-1.0, 0, 0}; // m/s
    const double rate = 20.0;
    clast::engine<two_balls> e({.grain_contact = {1e6, 0.0, 0.0},
                                .platen_contact = {},
                                .lateral_contact = {},
                                .breakage = {},
                                .replacement = {},
                                .scheme = {rate},
                                .largest_step = in_a_liquid::longest},
                               balls, clast::spaces::open{});
    while (e.grains.pebbles[0].v.x > 0 || e.elastic_energy() > 0) e.step();
    // by hand: v falls by gamma all the time, but at half that rate while most of the energy is in the spring
    const double contact = std::acos(-1.0) * std::sqrt(0.5 * balls.body_mass(0) / 1e6);
    const double expected = std::exp(-rate * (e.time() - 0.5 * contact));
    fmt::print("after {:.4f} s: {:.5f} m/s, by hand {:.5f}\n", e.time(), -e.grains.pebbles[0].v.x, expected);
    return e.dt() == in_a_liquid::longest && std::abs(-e.grains.pebbles[0].v.x - expected) < 2e-4 ? 0 : 1;
}
