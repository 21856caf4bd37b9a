// SPDX-License-Identifier: MIT
// A criterion without its one function.
// first error: policy breakage of the bundle lacks `utilisation\(
// most lines: 15
#include <clast/clast.hpp>

struct criterion : clast::criteria::nominal_force {
#ifdef CLAST_BREAK
    int utilisation = 0; // hides what it is for
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = criterion;
};

double load();
double load() {
    clast::bodies::clumps grains;
    grains.add(grains.kind_of(clast::shapes::tetrahedron_4(0.02)), {}, {});
    clast::engine<bundle> e({.grain_contact = clast::contacts::linear{3e6, 1.5e6, 0.3},
                             .platen_contact = clast::contacts::linear{3e6, 1.5e6, 0.3},
                             .lateral_contact = clast::contacts::linear{3e6, 1.5e6, 0.3},
                             .breakage = {{clast::criteria::crushing_strength(5e6)}},
                             .replacement = {}},
                            std::move(grains),
                            clast::boundaries::box({{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, 3.2e8, 3e6}));
    e.drives.platens.value = 0.1;
    e.step(10);
    return e.loads()[0].force + e.dt() + e.kinetic_energy() + e.grains.solid_volume();
}
