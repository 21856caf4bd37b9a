// SPDX-License-Identifier: MIT
// A constraint that books no work.
// first error: policy constraint of the bundle lacks `end_step\(
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

struct unpaid : clast::constraints::held {
#ifdef CLAST_BREAK
    int end_step = 0; // hides the work
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using constraint = unpaid;
};

double load();
double load() {
    clast::engine<bundle> e(
        {.grain_contact = stiff, .platen_contact = stiff, .lateral_contact = stiff, .breakage = {}, .replacement = {}},
        one_grain(), small_box());
    return pressed(e);
}
