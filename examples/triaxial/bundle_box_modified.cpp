// SPDX-License-Identifier: MIT
#include "bundles.hpp"
#include "run_bundle.hpp"

template class clast::triaxial_test<triaxial::box_modified>;

namespace triaxial {
template int run_bundle<box_modified>(const options&, const char*);
} // namespace triaxial
