// SPDX-License-Identifier: MIT
// A scheme without a kick.
// first error: policy scheme of the bundle lacks `kick\(
// most lines: 15
#include <clast/clast.hpp>

struct lazy_scheme : clast::integrators::leapfrog {
#ifdef CLAST_BREAK
    int kick = 0; // hides the kick
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using scheme = lazy_scheme;
};

double load();
double load() {
    clast::bodies::clumps grains;
    grains.add(grains.kind_of(clast::shapes::tetrahedron_4(0.02)), {}, {});
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
