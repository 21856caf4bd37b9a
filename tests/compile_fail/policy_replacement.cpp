// SPDX-License-Identifier: MIT
// A replacement that wants clumps and does nothing with them.
// first error: policy replacement of the bundle lacks `act\(
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

struct replacement_by_nothing : clast::replacements::modified {
#ifdef CLAST_BREAK
    int act = 0; // hides the act
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using replacement = replacement_by_nothing;
};

double load();
double load() {
    clast::engine<bundle> e({.grain_contact = stiff,
                             .platen_contact = stiff,
                             .lateral_contact = stiff,
                             .breakage = {clast::criteria::crushing_strength(5e6)},
                             .replacement = {}},
                            one_grain(), small_box());
    return pressed(e);
}
