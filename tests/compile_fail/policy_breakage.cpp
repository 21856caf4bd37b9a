// SPDX-License-Identifier: MIT
// A criterion without its one function.
// first error: policy breakage of the bundle lacks `utilisation\(
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

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
    clast::engine<bundle> e({.grain_contact = stiff,
                             .platen_contact = stiff,
                             .lateral_contact = stiff,
                             .breakage = {{clast::criteria::crushing_strength(5e6)}},
                             .replacement = {}},
                            one_grain(), small_box());
    return pressed(e);
}
