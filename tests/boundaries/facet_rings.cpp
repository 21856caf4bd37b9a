// SPDX-License-Identifier: MIT
// What every wall of rings says of itself, by hand; where its facets are is seen in tile_rings.cpp and node_rows.cpp.
#include <cmath>
#include <type_traits>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/stepped_tiles.hpp>
#include <clast/boundaries/tiles.hpp>

using namespace clast;
using namespace clast::boundaries;

TEMPLATE_TEST_CASE("walls of rings count, measure and refuse alike", "[boundaries]", tiles, ring_walls, stepped_tiles,
                   solid_strips) {
    cylinder_settings s;
    s.radius = 0.06, s.bottom = -0.1, s.top = 0.1;
    s.rings = 5, s.tiles_per_ring = 10;
    s.smallest_radius = 0.003;
    s.contact_stiffness_floor = 2e6;
    const TestType wall(s);
    const int rings = std::is_same_v<TestType, solid_strips> ? 1 : 5;
    CHECK(wall.ring_count() == rings);
    CHECK(wall.facet_count() == 2 + 10 * rings);
    CHECK(wall.stiffness(top_platen) == 3.2e8);
    CHECK(wall.stiffness(2) == 3.2e6);
    CHECK(wall.height() == Approx(0.2).epsilon(1e-14));
    const double polygon = 5.0 * regular_width(10, 0.06) * 0.06;
    CHECK(wall.section() == Approx(polygon).epsilon(1e-12));
    CHECK(wall.volume() == Approx(0.2 * polygon).epsilon(1e-12));
    CHECK(wall.end_section(0) == Approx(polygon).epsilon(1e-12));
    CHECK(wall.end_section(1) == Approx(polygon).epsilon(1e-12));

    std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    for (int f = 2; f < wall.facet_count(); ++f)
        loads[static_cast<std::size_t>(f)].force = (f % 2 == 0 ? 2.2e6 : 1.8e6) * wall.area(f);
    loads[0].force = loads[1].force = 5e6 * polygon;
    CHECK(wall.lateral_stress(loads) == Approx(2e6).epsilon(1e-12));
    CHECK(wall.confining_error(loads, 1.6e6) == Approx(0.25).epsilon(1e-12));
    CHECK(wall.axial_stress(loads) == Approx(5e6).epsilon(1e-12));
    const auto seen = wall.view(loads);
    CHECK(seen[0].ring == -1);
    CHECK(seen[1].area == Approx(polygon).epsilon(1e-12));
    CHECK(seen[1].pressure == Approx(5e6).epsilon(1e-12));
    CHECK(seen[1].corner[0].z == Approx(0.1).epsilon(1e-14));

    CHECK(wall.holds({0.056, 0, 0}, 0.003));
    CHECK_FALSE(wall.holds({0.058, 0, 0}, 0.003));
    CHECK_FALSE(wall.holds({0, 0, 0.098}, 0.003));

    TestType closing = wall;
    drives d;
    d.platens = {drive::mode::velocity, 0.05};
    closing.control(loads, d, 1.0);
    CHECK(closing.fastest() == 0.05);
    CHECK(closing.velocity(bottom_platen) == 0.05);
    closing.advance(1.0);
    CHECK(closing.height() == Approx(0.1).epsilon(1e-12));
    CHECK_THROWS_AS(closing.advance(1.0), run_error); // the platens met
}
