// SPDX-License-Identifier: MIT
// Rigid clumps in a box of six rigid frictionless walls that move at constant speed.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <vector>

#include <clast/boundaries/box.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/criteria/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/replacements/none.hpp>

#include "scene.hpp"

struct clumps : clast::triaxial_policies_default {
    using contact = clast::contacts::linear_dashpot;
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

/// Shape of pebbles that overlap, with mass and inertia summed over them: the library's shapes do not overlap (their
/// volume is that of the rock), so it is made of smaller pebbles in the same places, which have the same principal
/// axes.
clast::shape overlapping(const std::vector<peers::sphere>& members) {
    constexpr double smaller = 0.7;
    std::vector<clast::shape_pebble> pebbles;
    for (const peers::sphere& one : members) pebbles.push_back({one.x, smaller * one.r});
    clast::shape s = clast::make_shape("clump", pebbles);
    s.volume = s.circumscribed_radius = 0.0;
    s.inertia_per_density = {};
    for (clast::shape_pebble& p : s.pebbles) {
        p.radius /= smaller;
        const double v = clast::sphere_volume(p.radius);
        s.volume += v;
        for (int a = 0; a < 3; ++a)
            s.inertia_per_density[a] +=
                clast::sphere_inertia_per_density(p.radius) + v * (clast::norm2(p.offset) - p.offset[a] * p.offset[a]);
        s.circumscribed_radius = std::max(s.circumscribed_radius, clast::norm(p.offset) + p.radius);
    }
    return s;
}

int main(int argc, char** argv) try {
    const peers::scene s = peers::read(argc, argv);
    const auto members = peers::by_owner(s);
    clast::bodies::clumps grains = peers::grains_of(s, members, overlapping(members[0]));
    const auto law = peers::grain_law(s);
    clast::engine<clumps> e(peers::settings<clumps>(s, law, peers::wall_law(law)), std::move(grains), peers::walls(s));
    peers::drive_walls(e, s);
    peers::run_in_walls("clumps", e, s, members.size());
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
