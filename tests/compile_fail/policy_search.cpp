// SPDX-License-Identifier: MIT
// A search that finds no pairs.
// first error: policy search of the bundle lacks `pairs\(
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

struct grid : clast::searches::cell_grid {
#ifdef CLAST_BREAK
    int pairs = 0; // hides the search
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using search = grid;
};

double load();
double load() {
    clast::engine<bundle> e(
        {.grain_contact = stiff, .platen_contact = stiff, .lateral_contact = stiff, .breakage = {}, .replacement = {}},
        one_grain(), small_box());
    return pressed(e);
}
