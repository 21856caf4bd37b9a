// SPDX-License-Identifier: MIT
// Bodies that an engine may sweep, but that no shape can be made of.
// first error: policy body of the bundle is no specimen of a test, it lacks `kind_of\(
// most lines: 15
#include <clast/clast.hpp>

struct balls : clast::bodies::spheres {
#ifdef CLAST_BREAK
    int kind_of = 0; // hides the shape
#endif
};

struct bundle : clast::triaxial_policies_default {
    using boundary = clast::boundaries::box;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using body = balls;
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
