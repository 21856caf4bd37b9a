// SPDX-License-Identifier: MIT
// A bundle of one's own that forgot a family.
// first error: the bundle names no `search`
// most lines: 15
#include <clast/clast.hpp>

struct bundle {
    using contact = clast::contacts::linear;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
    using boundary = clast::boundaries::box;
    using body = clast::bodies::spheres;
    using space = clast::spaces::open;
    using scheme = clast::integrators::leapfrog;
    using field = clast::fields::none;
    using constraint = clast::constraints::none;
#ifndef CLAST_BREAK
    using search = clast::searches::cell_grid;
#endif
};

double q(clast::triaxial_setup<bundle> setup);
double q(clast::triaxial_setup<bundle> setup) {
    using namespace clast::literals;
    clast::triaxial_test<bundle> test(setup, clast::protocol::preparation(10_cm, 20_cm));
    clast::observer quiet;
    test.run(quiet);
    return test.protocol().measure().q;
}
