// SPDX-License-Identifier: MIT
// A contact law that does not know what it stores.
// first error: policy contact of the bundle lacks `stored\(
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

struct law : clast::contacts::linear {
#ifdef CLAST_BREAK
    int stored = 0; // hides the energy
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using contact = law;
};

double load();
double load() {
    clast::engine<bundle> e({.grain_contact = law{{3e6, 1.5e6, 0.3}},
                             .platen_contact = law{{3e6, 1.5e6, 0.3}},
                             .lateral_contact = law{{3e6, 1.5e6, 0.3}},
                             .breakage = {},
                             .replacement = {}},
                            one_grain(), small_box());
    return pressed(e);
}
