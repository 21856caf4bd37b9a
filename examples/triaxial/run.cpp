// SPDX-License-Identifier: MIT
#include "run.hpp"

#include "bundles.hpp"
#include "run_bundle.hpp"

namespace triaxial {

extern template int run_bundle<tiles_modified>(const options&, const char*);
extern template int run_bundle<tiles_unbreakable>(const options&, const char*);
extern template int run_bundle<solid_modified>(const options&, const char*);
extern template int run_bundle<solid_unbreakable>(const options&, const char*);

int run_test(const options& o) {
    if (o.membrane == "solid")
        return o.breakable() ? run_bundle<solid_modified>(o, "solid_modified")
                             : run_bundle<solid_unbreakable>(o, "solid_unbreakable");
    return o.breakable() ? run_bundle<tiles_modified>(o, "tiles_modified")
                         : run_bundle<tiles_unbreakable>(o, "tiles_unbreakable");
}

} // namespace triaxial
