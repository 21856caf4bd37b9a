// SPDX-License-Identifier: MIT
// Bodies that do not know how fast their surface is.
// first error: policy body of the bundle lacks `surface_speed\(
// most lines: 15
#include <clast/clast.hpp>

#include "loaded_grain.hpp"

struct balls : clast::bodies::spheres {
#ifdef CLAST_BREAK
    int surface_speed = 0; // hides the speed
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using body = balls;
};

double load();
double load() {
    balls grains;
    grains.add({}, 0.01);
    clast::engine<bundle> e(
        {.grain_contact = stiff, .platen_contact = stiff, .lateral_contact = stiff, .breakage = {}, .replacement = {}},
        std::move(grains), small_box());
    return pressed(e);
}
