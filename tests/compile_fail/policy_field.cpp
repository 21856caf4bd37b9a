// SPDX-License-Identifier: MIT
// A field without a potential for the audit.
// first error: policy field of the bundle lacks `potential\(
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

struct wind : clast::fields::gravity {
#ifdef CLAST_BREAK
    int potential = 0; // hides the potential
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using field = wind;
};

double load();
double load() {
    clast::engine<bundle> e(
        {.grain_contact = stiff, .platen_contact = stiff, .lateral_contact = stiff, .breakage = {}, .replacement = {}},
        one_grain(), small_box());
    return pressed(e);
}
