// SPDX-License-Identifier: MIT
#include <clast/spaces/images.hpp>

#include <cmath>
#include <cstddef>

#include <catch.hpp>

using namespace clast;

TEST_CASE("images are numbered, and the one in the middle is the body itself") {
    static_assert(image_shift(no_shift, {1.0, 2.0, 3.0}) == vec3{});
    static_assert(image_shift(0, {1.0, 2.0, 3.0}) == vec3{-1.0, -2.0, -3.0});
    static_assert(image_shift(no_shift + 1, {1.0, 2.0, 3.0}) == vec3{1.0, 0.0, 0.0});
    // the opposite shift has the number that adds up to twice that of none
    for (std::size_t i = 0; i < 27; ++i)
        CHECK(image_shift(i, {1.0, 2.0, 3.0}) == -image_shift(2 * no_shift - i, {1.0, 2.0, 3.0}));
}

TEST_CASE("two spheres near opposite faces are near each other through one image, whichever is the first") {
    const vec3 edges{1.0, 1.2, 1.4};
    for (const vec3& corner : {vec3{0.5, 0.0, 0.0}, vec3{0.5, 0.6, 0.0}, vec3{-0.5, 0.6, 0.7}}) {
        search_spheres s;
        s.all = {{0.98 * corner, 0.05, 0}, {-0.97 * corner, 0.05, 1}, {{0.1, 0.1, 0.1}, 0.05, 2}};
        s.add_images(edges, 0.2);
        CHECK(s.real() == 3);
        int near = 0;
        for (std::size_t i = 0; i < s.real(); ++i)
            for (std::size_t k = s.real(); k < s.all.size(); ++k) {
                CHECK(s.all[k].id != 2);
                CHECK(norm(s.all[k].centre - s.all[static_cast<std::size_t>(s.all[k].id)].centre -
                           image_shift(s.image_of(k), edges)) < 1e-15);
                near += s.all[k].id != s.all[i].id && norm(s.all[k].centre - s.all[i].centre) < 0.1;
            }
        CHECK(near == 1);
        CHECK(s.image_of(0) == no_shift);
    }
}
