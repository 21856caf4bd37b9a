// SPDX-License-Identifier: MIT
#include "run.hpp"

#include "bundles.hpp"
#include "run_bundle.hpp"

namespace triaxial {

extern template int run_bundle<tiles_breakable>(const options&, const char*);
extern template int run_bundle<tiles_unbreakable>(const options&, const char*);
extern template int run_bundle<rings_breakable>(const options&, const char*);
extern template int run_bundle<rings_unbreakable>(const options&, const char*);
extern template int run_bundle<solid_breakable>(const options&, const char*);
extern template int run_bundle<solid_unbreakable>(const options&, const char*);
extern template int run_bundle<rigid_breakable>(const options&, const char*);
extern template int run_bundle<rigid_unbreakable>(const options&, const char*);
extern template int run_bundle<box_breakable>(const options&, const char*);
extern template int run_bundle<box_unbreakable>(const options&, const char*);

namespace {

/// One of the two bundles of a membrane.
template <class Breakable, class Unbreakable> int run_either(const options& o) {
    return o.breakable() ? run_bundle<Breakable>(o, (o.membrane + "_breakable").c_str())
                         : run_bundle<Unbreakable>(o, (o.membrane + "_unbreakable").c_str());
}

} // namespace

int run_test(const options& o) {
    if (o.membrane == "rings") return run_either<rings_breakable, rings_unbreakable>(o);
    if (o.membrane == "solid") return run_either<solid_breakable, solid_unbreakable>(o);
    if (o.membrane == "rigid") return run_either<rigid_breakable, rigid_unbreakable>(o);
    if (o.membrane == "box") return run_either<box_breakable, box_unbreakable>(o);
    return run_either<tiles_breakable, tiles_unbreakable>(o);
}

} // namespace triaxial
