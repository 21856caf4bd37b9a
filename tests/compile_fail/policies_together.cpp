// SPDX-License-Identifier: MIT
// Spheres cannot be replaced by bonded clusters.
// first error: policies body and replacement of the bundle: .*take replacements::none or bodies::clumps
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

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
    clast::engine<bundle> e(
        {.grain_contact = stiff, .platen_contact = stiff, .lateral_contact = stiff, .breakage = {}, .replacement = {}},
        std::move(grains), small_box());
    return pressed(e);
}
