// SPDX-License-Identifier: MIT
// Rigid clumps in a box of six rigid frictionless walls that move at constant speed.
#include <cstdio>
#include <exception>
#include <vector>

#include <clast/boundaries/box.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/criteria/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/grains/overlapping_shape.hpp>
#include <clast/replacements/none.hpp>

#include "scene.hpp"

struct clumps : clast::triaxial_policies_default {
    using contact = clast::contacts::linear_dashpot;
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

/// The first clump of the scene; pebbles overlap and count in full, as in the other programs.
clast::shape shape_of(const std::vector<peers::sphere>& members) {
    std::vector<clast::shape_pebble> pebbles;
    for (const peers::sphere& one : members) pebbles.push_back({one.x, one.r});
    return clast::overlapping_shape("clump", pebbles, clast::overlaps::as_sum);
}

int main(int argc, char** argv) try {
    const peers::scene s = peers::read(argc, argv);
    const auto members = peers::by_owner(s);
    clast::bodies::clumps grains = peers::grains_of(s, members, shape_of(members[0]));
    const auto law = peers::grain_law(s);
    clast::engine<clumps> e(peers::settings<clumps>(s, law, peers::wall_law(law)), std::move(grains), peers::walls(s));
    peers::drive_walls(e, s);
    peers::run_in_walls("clumps", e, s, members.size());
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
