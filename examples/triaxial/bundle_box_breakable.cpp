// SPDX-License-Identifier: MIT
#include "bundles.hpp"
#include "run_bundle.hpp"

template class clast::triaxial_test<triaxial::box_breakable>;

namespace triaxial {
template int run_bundle<box_breakable>(const options&, const char*);
} // namespace triaxial
