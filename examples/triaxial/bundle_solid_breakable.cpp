// SPDX-License-Identifier: MIT
#include "bundles.hpp"
#include "run_bundle.hpp"

template class clast::triaxial_test<triaxial::solid_breakable>;

namespace triaxial {
template int run_bundle<solid_breakable>(const options&, const char*);
} // namespace triaxial
