// SPDX-License-Identifier: MIT
#include <catch.hpp>

#include <clast/boundaries/platens.hpp>

using namespace clast::boundaries;

TEST_CASE("platens push along z by the plain overlap, at any distance from the axis", "[boundaries]") {
    const platens p{0.1, 0.3, {0.0, 0.0}};
    touches t;
    p.touch_sphere({5.0, 0, 0.1045}, 5e-3, 0.0, t);
    p.touch_sphere({0, 0, 0.296}, 5e-3, 0.0, t);
    p.touch_sphere({0, 0, 0.2}, 5e-3, 0.0, t);
    REQUIRE(t.size == 2);
    CHECK(t.at[0].facet == bottom_platen);
    CHECK(t.at[0].normal == clast::vec3{0, 0, 1});
    CHECK(t.at[0].depth == Approx(0.5e-3).epsilon(1e-12));
    CHECK(t.at[1].facet == top_platen);
    CHECK(t.at[1].normal == clast::vec3{0, 0, -1});
    CHECK(t.at[1].depth == Approx(1e-3).epsilon(1e-12));
    CHECK(elastic_energy(t, 2e6, 7.0) == Approx(0.5 * 2e6 * 1.25e-6).epsilon(1e-12));
}

TEST_CASE("inward platens approach each other and see where they will be", "[boundaries]") {
    platens p{0.0, 0.2, {0.01, 0.03}};
    touches t;
    p.touch_sphere({0, 0, 0.006}, 5e-3, 0.2, t); // the bottom one will be at 2 mm
    REQUIRE(t.size == 1);
    CHECK(t.at[0].depth == Approx(1e-3).epsilon(1e-12));
    p.touch_sphere({0, 0, 0.188}, 5e-3, 0.3, t); // the top one at 191 mm
    REQUIRE(t.size == 2);
    CHECK(t.at[1].depth == Approx(2e-3).epsilon(1e-12));
    p.advance(0.5);
    CHECK(p.height() == Approx(0.18).epsilon(1e-14));
}
