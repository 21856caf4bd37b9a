// SPDX-License-Identifier: MIT
// The bundles that the program offers: kind of membrane times breakable or not. Shapes, strengths and criteria are
// data. Each is instantiated in its own file (bundle_*.cpp), so that they compile side by side.
#pragma once

#include <clast/boundaries/box.hpp>
#include <clast/boundaries/rigid_cylinder.hpp>
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/criteria/none.hpp>
#include <clast/criteria/one_of.hpp>
#include <clast/criteria/weibull.hpp>
#include <clast/protocol/triaxial.hpp>
#include <clast/replacements/modified.hpp>
#include <clast/replacements/none.hpp>

namespace triaxial {

/// Grains that a criterion, picked by name at run time, breaks.
template <class Boundary> struct modified : clast::triaxial_policies_default {
    using boundary = Boundary;
    using breakage = clast::criteria::weibull<clast::criteria::any>;
};
/// Grains that never break.
template <class Boundary> struct unbreakable : clast::triaxial_policies_default {
    using boundary = Boundary;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

using tiles_modified = modified<clast::boundaries::tiles>;
using tiles_unbreakable = unbreakable<clast::boundaries::tiles>;
using rings_modified = modified<clast::boundaries::ring_walls>;
using rings_unbreakable = unbreakable<clast::boundaries::ring_walls>;
using solid_modified = modified<clast::boundaries::solid_strips>;
using solid_unbreakable = unbreakable<clast::boundaries::solid_strips>;
using rigid_modified = modified<clast::boundaries::rigid_cylinder>;
using rigid_unbreakable = unbreakable<clast::boundaries::rigid_cylinder>;
using box_modified = modified<clast::boundaries::box>;
using box_unbreakable = unbreakable<clast::boundaries::box>;

} // namespace triaxial

extern template class clast::triaxial_test<triaxial::tiles_modified>;
extern template class clast::triaxial_test<triaxial::tiles_unbreakable>;
extern template class clast::triaxial_test<triaxial::solid_modified>;
extern template class clast::triaxial_test<triaxial::solid_unbreakable>;
extern template class clast::triaxial_test<triaxial::rings_modified>;
extern template class clast::triaxial_test<triaxial::rings_unbreakable>;
extern template class clast::triaxial_test<triaxial::rigid_modified>;
extern template class clast::triaxial_test<triaxial::rigid_unbreakable>;
extern template class clast::triaxial_test<triaxial::box_modified>;
extern template class clast::triaxial_test<triaxial::box_unbreakable>;
