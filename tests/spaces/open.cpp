// SPDX-License-Identifier: MIT
#include <clast/spaces/open.hpp>

#include <limits>
#include <type_traits>

#include <catch.hpp>

static_assert(clast::spaces::space<clast::spaces::open>);

using namespace clast;

TEST_CASE("open space is empty, and all that is asked of it is known at compile time") {
    using spaces::open;
    static_assert(std::is_empty_v<open> && std::is_empty_v<open::frame> && std::is_empty_v<open::crossings>);
    static_assert(!open::has_images);
    static_assert(open::across({1.0, 2.0, 3.0}, 7) == vec3{1.0, 2.0, 3.0});
    static_assert(open::stretch_since(open::here()) == vec3{1.0, 1.0, 1.0} && open::rates() == vec3{});
    static_assert(open::travel({1.0, 1.0, 1.0}, 5.0) == 0.0 && !open::looks(0, true, true));
    static_assert(open::room(1.0) == std::numeric_limits<double>::infinity());
    SUCCEED("checked at compile time");
}
