// SPDX-License-Identifier: MIT
// The bundles that the program offers: kind of membrane times breakable or not. Shapes, strengths and criteria are
// data. Each is instantiated in its own file (bundle_*.cpp), so that they compile side by side.
#pragma once

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

struct tiles_modified : clast::triaxial_policies_default {
    using breakage = clast::criteria::weibull<clast::criteria::any>; // picked by name at run time
};
struct tiles_unbreakable : clast::triaxial_policies_default {
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};
struct solid_modified : tiles_modified {
    using boundary = clast::boundaries::solid_strips;
};
struct solid_unbreakable : tiles_unbreakable {
    using boundary = clast::boundaries::solid_strips;
};
struct rings_modified : tiles_modified {
    using boundary = clast::boundaries::ring_walls;
};
struct rings_unbreakable : tiles_unbreakable {
    using boundary = clast::boundaries::ring_walls;
};
struct rigid_modified : tiles_modified {
    using boundary = clast::boundaries::rigid_cylinder;
};
struct rigid_unbreakable : tiles_unbreakable {
    using boundary = clast::boundaries::rigid_cylinder;
};

} // namespace triaxial

extern template class clast::triaxial_test<triaxial::tiles_modified>;
extern template class clast::triaxial_test<triaxial::tiles_unbreakable>;
extern template class clast::triaxial_test<triaxial::solid_modified>;
extern template class clast::triaxial_test<triaxial::solid_unbreakable>;
extern template class clast::triaxial_test<triaxial::rings_modified>;
extern template class clast::triaxial_test<triaxial::rings_unbreakable>;
extern template class clast::triaxial_test<triaxial::rigid_modified>;
extern template class clast::triaxial_test<triaxial::rigid_unbreakable>;
