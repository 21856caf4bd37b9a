// SPDX-License-Identifier: MIT
// A scheme without a kick.
// first error: policy scheme of the bundle lacks `kick\(
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

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
    clast::engine<bundle> e(
        {.grain_contact = stiff, .platen_contact = stiff, .lateral_contact = stiff, .breakage = {}, .replacement = {}},
        one_grain(), small_box());
    return pressed(e);
}
