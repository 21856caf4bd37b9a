// SPDX-License-Identifier: MIT
#include "bundles.hpp"
#include "run_bundle.hpp"

template class clast::triaxial_test<triaxial::rigid_breakable>;

namespace triaxial {
template int run_bundle<rigid_breakable>(const options&, const char*);
} // namespace triaxial
