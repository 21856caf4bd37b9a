// SPDX-License-Identifier: MIT
#include <clast/grains/overlapping_shape.hpp>

#include <numbers>
#include <vector>

#include <catch.hpp>

using namespace clast;

TEST_CASE("pebbles that overlap are one solid, or count in full, by choice, and such a shape has no bonds and a mark") {
    const std::vector<shape_pebble> pebbles = {{{-0.5, 0, 0}, 1.0}, {{0.5, 0, 0}, 1.0}, {{3.5, 0, 0}, 2.0}};
    const shape sum = overlapping_shape("sum", pebbles, overlaps::as_sum),
                solid = overlapping_shape("solid", pebbles, overlaps::as_union);
    const double ball = sphere_volume(1.0), lens = std::numbers::pi * 5.0 / 12.0; // two caps of height 1/2
    CHECK(sum.volume == Approx(10.0 * ball).epsilon(1e-14));
    CHECK(solid.volume == Approx(10.0 * ball - lens).epsilon(1e-8));
    CHECK(sum.mass_centre.x == Approx(2.8).epsilon(1e-14));
    CHECK(solid.mass_centre.x == Approx(28.0 * ball / solid.volume).epsilon(1e-8)); // the lens is at 0
    for (const shape* s : {&sum, &solid}) {
        CHECK(s->overlapping);
        CHECK(s->bonds.empty());
        CHECK(s->circumscribed_radius == Approx(s->mass_centre.x + 1.5).epsilon(1e-14));
        CHECK(s->inertia_per_density.y == s->inertia_per_density.z);
        CHECK(s->inertia_per_density.x < s->inertia_per_density.y);
        CHECK(norm(s->mass_centre + rotate(s->to_input_frame, s->pebbles[2].offset) - vec3{3.5, 0, 0}) < 1e-12);
    }
    // about the axis: 2/5 r^2 of each, less that of the lens, both caps of which have pi h^3 (20 r^2 - 15 r h + 3 h^2)
    // / 30
    const double of_lens = 2.0 * std::numbers::pi * 0.125 * (20.0 - 7.5 + 0.75) / 30.0;
    CHECK(sum.inertia_per_density.x == Approx(0.4 * (2.0 * ball + 8.0 * ball * 4.0)).epsilon(1e-14));
    CHECK(solid.inertia_per_density.x == Approx(0.4 * (2.0 * ball + 8.0 * ball * 4.0) - of_lens).epsilon(1e-8));
    // where none overlap, nothing changes
    const shape apart = overlapping_shape("4B", shapes::tetrahedron_4(circumscribed(0.02)).pebbles, overlaps::as_union);
    CHECK(!apart.overlapping);
    CHECK(apart.bonds.size() == 6);
    CHECK(apart.volume == make_shape("4B", shapes::tetrahedron_4(circumscribed(0.02)).pebbles).volume);
}
