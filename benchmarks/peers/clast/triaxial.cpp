// SPDX-License-Identifier: MIT
// Spheres in a box of six rigid frictionless walls that move at constant speed.
#include <cstdio>
#include <exception>

#include "scene.hpp"

int main(int argc, char** argv) try {
    using triaxial = peers::spheres_in<clast::boundaries::box>;
    const peers::scene s = peers::read(argc, argv);
    const auto law = peers::grain_law(s);
    clast::engine<triaxial> e(peers::settings<triaxial>(s, law, peers::wall_law(law)), peers::spheres_of(s, {}),
                              peers::walls(s));
    peers::drive_walls(e, s);
    peers::run_in_walls("triaxial", e, s, s.spheres.size());
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
