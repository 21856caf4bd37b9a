// SPDX-License-Identifier: MIT
#include <clast/boundaries/touch.hpp>

#include <cmath>
#include <numbers>

#include <clast/boundaries/solid_strips.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

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

TEST_CASE("the point on a wall is where the pebble rests once it has gone the way out") {
    constexpr double apothem = 0.03, r = 0.01, deep = 8e-4, half = std::numbers::pi / 8.0;
    const solid_strips wall(clast::scenes::cylinder(apothem, 0.04, r));
    const auto points = [&](const clast::vec3& x, int count) {
        const touches all = wall.touch(x, r);
        REQUIRE(all.size == count);
        clast::vec3 moment, force;
        for (const touch& t : all) {
            const clast::vec3 on = point_on_wall(all, t, x, r);
            // on the plane of its facet, at the level or the azimuth that the pebble has
            if (t.at_platen())
                CHECK((std::abs(on.z) == Approx(0.02).epsilon(1e-12) && on.x == x.x && on.y == x.y));
            else
                CHECK((-dot(on, t.normal) == Approx(apothem).epsilon(1e-12) && on.z == x.z));
            if (!t.at_platen()) force += t.depth * t.normal, moment += cross(on - x, t.depth * t.normal);
        }
        CHECK(norm(moment) <= 1e-12 * norm(force) * r);
    };
    points({0.0, 0.0, 0.02 + deep - r}, 1);                   // a platen
    points({apothem + deep - r, 0.001, 0.003}, 1);            // a tile
    points({apothem + deep - r, 0.001, -0.02 - deep + r}, 2); // both
    const double out = (apothem + deep - r) / std::cos(half); // the corner of two tiles, off their middle
    points({out * std::cos(half + 0.01), out * std::sin(half + 0.01), 0.0}, 2);
}
