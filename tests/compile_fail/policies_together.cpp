// SPDX-License-Identifier: MIT
// Spheres cannot be replaced by bonded clusters.
// first error: policies body and replacement of the bundle: .*take replacements::none or bodies::clumps
// most lines: 15
#include <clast/clast.hpp>

#ifdef CLAST_BREAK
using replaced_by = clast::replacements::modified;
#else
using replaced_by = clast::replacements::none;
#endif

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = replaced_by;
    using body = clast::bodies::spheres;
};

double load();
double load() {
    clast::bodies::spheres grains;
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
