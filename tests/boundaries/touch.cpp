// SPDX-License-Identifier: MIT
#include <catch.hpp>

#include <clast/boundaries/touch.hpp>

using namespace clast::boundaries;

TEST_CASE("the energy of a sphere against several facets is that of its way out, not a sum over facets",
          "[boundaries]") {
    touches t;
    t.add({5, {-1, 0, 0}, 3e-4, 1.0});
    t.add({6, {-0.6, 0.8, 0}, 1e-4, 1.0});
    t.add({bottom_platen, {0, 0, 1}, 2e-4, 1.0});
    const clast::vec3 u = lateral_push(t);
    CHECK(u.x == Approx(-3.6e-4).epsilon(1e-12));
    CHECK(u.y == Approx(0.8e-4).epsilon(1e-12));
    CHECK(u.z == 0.0); // the platen has its own stiffness
    CHECK(elastic_energy(t, 1e6, 2e6) == Approx(0.5e6 * 4e-8 + 1e6 * norm2(u)).epsilon(1e-12));
}
