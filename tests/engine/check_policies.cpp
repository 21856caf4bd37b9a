// SPDX-License-Identifier: MIT
// What a compiler says of bundles that do not fit is in tests/compile_fail/policy_*.cpp.
#include <clast/engine/check_policies.hpp>

#include <type_traits>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/protocol/vessel.hpp>
#include <clast/spaces/periodic.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

struct wrong_contact : triaxial_policies_default {
    using contact = int;
    using boundary = boundaries::box;
};
struct two_wrong : wrong_contact {
    using search = double;
    using space = spaces::periodic;
};
struct spheres_with_bonds : triaxial_policies_default {
    using body = bodies::spheres;
};
struct without_wall : triaxial_policies_default {
    using boundary = boundaries::none;
};

static_assert(std::is_same_v<check_policies<triaxial_policies_default>, policy_checks::nothing_wrong>);
static_assert(std::is_same_v<check_policies<wrong_contact>, policy_checks::contact<int>>);
static_assert(std::is_same_v<check_policies<two_wrong>, policy_checks::contact<int>>); // one is enough
static_assert(std::is_same_v<check_policies<spheres_with_bonds>, policy_checks::together<spheres_with_bonds>>);
static_assert(std::is_same_v<check_policies<int>, policy_checks::named<int>>);
static_assert(std::is_same_v<check_test_policies<triaxial_policies_default>, policy_checks::nothing_wrong>);
static_assert(std::is_same_v<check_test_policies<without_wall>, policy_checks::vessel<boundaries::none>>);
static_assert(std::is_same_v<check_test_policies<wrong_contact>, policy_checks::contact<int>>);

static_assert(simulator_policies<repaired_policies<int>> && simulator_policies<repaired_policies<spheres_with_bonds>>);
static_assert(std::is_same_v<repaired_policies<two_wrong>::contact, contacts::linear>);
static_assert(std::is_same_v<repaired_policies<two_wrong>::boundary, boundaries::box>); // what fits stays
static_assert(simulator_policies<repaired_policies<two_wrong>>);
static_assert(triaxial_policies<repaired_test_policies<without_wall>>);
static_assert(triaxial_policies<repaired_test_policies<two_wrong>>);

} // namespace

TEST_CASE("a check names the first thing that is missing, and nothing where the concept holds") {
    using policy_checks::first_missing;
    CHECK(first_missing(true, false, false) == 0); // the concept knows better than the list
    CHECK(first_missing(false, true, false, false) == 2);
    CHECK(first_missing(false, false, true) == 1);
    CHECK(first_missing(false, true, true) == 3); // something that the list does not know
}
