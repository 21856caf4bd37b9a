// SPDX-License-Identifier: MIT
// A wall that an engine may have, but that cannot be made anew: no vessel for a test.
// first error: policy boundary of the bundle is no vessel of a test, it lacks `resized\(
// most lines: 15
#include <clast/clast.hpp>

struct wall : clast::boundaries::box {
    explicit wall(const box& b) : box(b) {}
    static wall made(const clast::boundaries::vessel_settings& s) { return wall(box::made(s)); }
#ifdef CLAST_BREAK
    int resized = 0; // hides the function
#else
    wall resized(const clast::boundaries::vessel_settings& s) const { return wall(box::resized(s)); }
#endif
};

struct bundle : clast::triaxial_policies_default {
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using boundary = wall;
};

double peak();
double peak() {
    using namespace clast::literals;
    const clast::triaxial_setup<bundle> setup{.grain = clast::shapes::sphere(0.02),
                                              .diameter = 10_cm,
                                              .height = 15_cm,
                                              .confining = 500_kPa,
                                              .breakage = {},
                                              .replacement = {}};
    clast::triaxial_test<bundle> test(setup, clast::protocol::triaxial_compression(10_cm, 15_cm, 500_kPa, 1_percent));
    clast::observer quiet;
    test.run(quiet);
    return test.protocol().measure().q + test.sim().time() + test.setup().porosity;
}
