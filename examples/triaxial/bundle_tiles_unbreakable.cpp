// SPDX-License-Identifier: MIT
#include "bundles.hpp"
#include "run_bundle.hpp"

template class clast::triaxial_test<triaxial::tiles_unbreakable>;

namespace triaxial {
template int run_bundle<tiles_unbreakable>(const options&, const char*);
} // namespace triaxial
