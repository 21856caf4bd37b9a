// SPDX-License-Identifier: MIT
#include "bundles.hpp"
#include "run_bundle.hpp"

template class clast::triaxial_test<triaxial::rings_breakable>;

namespace triaxial {
template int run_bundle<rings_breakable>(const options&, const char*);
} // namespace triaxial
