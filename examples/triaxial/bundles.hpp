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
#include <clast/replacements/none.hpp>
#include <clast/replacements/one_of.hpp>

namespace triaxial {

/// Grains that break by a criterion and are replaced by a policy, both picked by name at run time.
template <class Boundary> struct breakable : clast::triaxial_policies_default {
    using boundary = Boundary;
    using breakage = clast::criteria::weibull<clast::criteria::any>;
    using replacement = clast::replacements::any;
};
/// Grains that never break.
template <class Boundary> struct unbreakable : clast::triaxial_policies_default {
    using boundary = Boundary;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

using tiles_breakable = breakable<clast::boundaries::tiles>;
using tiles_unbreakable = unbreakable<clast::boundaries::tiles>;
using rings_breakable = breakable<clast::boundaries::ring_walls>;
using rings_unbreakable = unbreakable<clast::boundaries::ring_walls>;
using solid_breakable = breakable<clast::boundaries::solid_strips>;
using solid_unbreakable = unbreakable<clast::boundaries::solid_strips>;
using rigid_breakable = breakable<clast::boundaries::rigid_cylinder>;
using rigid_unbreakable = unbreakable<clast::boundaries::rigid_cylinder>;
using box_breakable = breakable<clast::boundaries::box>;
using box_unbreakable = unbreakable<clast::boundaries::box>;

} // namespace triaxial

extern template class clast::triaxial_test<triaxial::tiles_breakable>;
extern template class clast::triaxial_test<triaxial::tiles_unbreakable>;
extern template class clast::triaxial_test<triaxial::solid_breakable>;
extern template class clast::triaxial_test<triaxial::solid_unbreakable>;
extern template class clast::triaxial_test<triaxial::rings_breakable>;
extern template class clast::triaxial_test<triaxial::rings_unbreakable>;
extern template class clast::triaxial_test<triaxial::rigid_breakable>;
extern template class clast::triaxial_test<triaxial::rigid_unbreakable>;
extern template class clast::triaxial_test<triaxial::box_breakable>;
extern template class clast::triaxial_test<triaxial::box_unbreakable>;
