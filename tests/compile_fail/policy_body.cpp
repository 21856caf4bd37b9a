// SPDX-License-Identifier: MIT
// Bodies that do not know how fast their surface is.
// first error: policy body of the bundle lacks `surface_speed\(
// most lines: 15
#include <clast/clast.hpp>

struct balls : clast::bodies::spheres {
#ifdef CLAST_BREAK
    int surface_speed = 0; // hides the speed
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using body = balls;
};

double load();
double load() {
    balls grains;
    grains.add({}, 0.01);
    clast::engine<bundle> e({.grain_contact = clast::contacts::linear{3e6, 1.5e6, 0.3},
                             .platen_contact = clast::contacts::linear{3e6, 1.5e6, 0.3},
                             .lateral_contact = clast::contacts::linear{3e6, 1.5e6, 0.3},
                             .breakage = {},
                             .replacement = {}},
                            std::move(grains),
                            clast::boundaries::box({{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, 3.2e8, 3e6}));
    e.drives.platens.value = 0.1;
    e.step(10);
    return e.loads()[0].force + e.dt() + e.kinetic_energy() + e.grains.solid_volume();
}
