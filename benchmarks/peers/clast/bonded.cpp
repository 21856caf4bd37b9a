// SPDX-License-Identifier: MIT
// Clusters of bonded balls that never break, in a box of six rigid frictionless walls that move at constant speed.
#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include <clast/boundaries/box.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/engine/engine.hpp>
#include <clast/replacements/modified.hpp>

#include "scene.hpp"

/// Every grain is critical, whatever its load: the first step turns all clumps into clusters.
struct at_once {
    static constexpr bool evaluated = true;
    static constexpr clast::criteria::needs needs = clast::criteria::needs::nothing;
    double utilisation(const clast::criteria::grain_load&) const { return 1.0; }
};
struct bonded : clast::triaxial_policies_default {
    using contact = clast::contacts::linear;
    using boundary = clast::boundaries::box;
    using breakage = at_once;
};

int main(int argc, char** argv) try {
    peers::scene s = peers::read(argc, argv);
    const auto members = peers::by_owner(s);
    std::vector<clast::shape_pebble> balls;
    for (const peers::sphere& one : members[0]) balls.push_back({one.x, one.r});
    const clast::shape kind = clast::make_shape("cluster", balls);
    clast::replacements::modified cement{
        .bond = {.normal_stiffness = s["kn"], .shear_stiffness = s["kt"], .tensile_strength = 1e30, .cohesion = 1e30},
        .check_interval = 1,
        .how = clast::replacements::birth::zero_force};
    // what the other programs are told in numbers, follows here from the radius
    const auto made = clast::bonds::constants_of(cement.bond, balls[0].radius, balls[0].radius);
    if (std::abs(made.kb - s["bending"]) > 1e-6 * made.kb || std::abs(made.kt - s["torsion"]) > 1e-6 * made.kt)
        throw clast::input_error("--parameters", "bending or torsion", fmt::format("{} and {} N m", made.kb, made.kt),
                                 "A parallel bond has no choice.");
    const clast::contacts::linear law{s["kn"], s["kt"], s["mu"]}, wall{s["kn"], 0.0, 0.0};
    clast::engine<bonded> e(peers::settings<bonded>(s, law, wall, cement), peers::grains_of(s, members, kind),
                            peers::walls(s));
    peers::drive_walls(e, s);
    e.step();
    if (e.totals().replaced != static_cast<std::int64_t>(members.size()))
        throw clast::input_error("--state", "a clump left", "clusters only", "Its shape needs bonds.");
    --s.steps;
    peers::run_in_walls("bonded", e, s, members.size());
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
