// SPDX-License-Identifier: MIT
// A wall that does not say what work it does.
// first error: policy boundary of the bundle lacks `power\(
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

struct wall : clast::boundaries::box {
    using box::box;
#ifdef CLAST_BREAK
    int power = 0; // hides the work
#endif
};

struct bundle : clast::triaxial_policies_default {
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using boundary = wall;
};

double load();
double load() {
    clast::engine<bundle> e(
        {.grain_contact = stiff, .platen_contact = stiff, .lateral_contact = stiff, .breakage = {}, .replacement = {}},
        one_grain(), small_box<wall>());
    return pressed(e);
}
