// SPDX-License-Identifier: MIT
#include <clast/protocol/vessel.hpp>

#include <clast/boundaries/none.hpp>
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>

#include <catch.hpp>

using namespace clast;

namespace {
struct without_wall : triaxial_policies_default {
    using boundary = boundaries::none;
};
} // namespace

TEST_CASE("a triaxial test needs a vessel, an engine needs none") {
    static_assert(protocol::vessel<boundaries::tiles> && protocol::vessel<boundaries::ring_walls> &&
                  protocol::vessel<boundaries::solid_strips>);
    static_assert(!protocol::vessel<boundaries::none> && !protocol::vessel<int>);
    static_assert(simulator_policies<without_wall> && !triaxial_policies<without_wall>);
    static_assert(triaxial_policies<triaxial_policies_default>);
    SUCCEED("checked at compile time");
}
