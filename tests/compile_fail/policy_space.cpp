// SPDX-License-Identifier: MIT
// A space without the width of a search.
// first error: policy space of the bundle lacks `room\(
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

struct void_space : clast::spaces::open {
#ifdef CLAST_BREAK
    int room = 0; // hides the width
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using space = void_space;
};

double load();
double load() {
    clast::engine<bundle> e(
        {.grain_contact = stiff, .platen_contact = stiff, .lateral_contact = stiff, .breakage = {}, .replacement = {}},
        one_grain(), small_box());
    return pressed(e);
}
