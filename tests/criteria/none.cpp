// SPDX-License-Identifier: MIT
#include <clast/criteria/none.hpp>

#include <type_traits>

#include <catch.hpp>

static_assert(clast::criteria::criterion<clast::criteria::none> &&
              !clast::criteria::evaluated_criterion<clast::criteria::none>);

TEST_CASE("the absent criterion takes no memory and is never asked") {
    STATIC_REQUIRE(std::is_empty_v<clast::criteria::none>);
    STATIC_REQUIRE_FALSE(clast::criteria::none::evaluated);
    STATIC_REQUIRE_FALSE(clast::criteria::evaluated_criterion<clast::criteria::none>);
}
