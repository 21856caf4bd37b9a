// SPDX-License-Identifier: MIT
// Spheres in a box of six rigid frictionless walls that move at constant speed.
#include <cstdio>
#include <exception>

#include <clast/boundaries/box.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/criteria/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/replacements/none.hpp>

#include "scene.hpp"

struct triaxial : clast::triaxial_policies_default {
    using specimen = clast::sphere_specimen;
    using contact = clast::contacts::linear_dashpot;
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

int main(int argc, char** argv) try {
    const peers::scene s = peers::read(argc, argv);
    const clast::contacts::linear_dashpot law{s["kn"], s["kt"], s["mu"], s["gamma_n"], s["density"]};
    clast::contacts::linear_dashpot wall = law;
    wall.ks = wall.mu = 0.0;
    wall.gamma *= 2.0; // m_eff = m
    clast::sphere_specimen spheres;
    spheres.density = s["density"];
    for (const peers::sphere& one : s.spheres) {
        const auto p = static_cast<std::size_t>(spheres.add(one.x, one.r));
        spheres.pebbles[p].v = s.flow(one.x);
    }
    clast::engine<triaxial> e(peers::settings<triaxial>(s, law, wall), spheres, peers::walls(s));
    peers::drive_walls(e, s);
    peers::run_in_walls("triaxial", e, s, s.spheres.size());
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
