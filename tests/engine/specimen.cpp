// SPDX-License-Identifier: MIT
#include <clast/engine/specimen.hpp>

#include <cmath>

#include <clast/io/archive.hpp>

#include <catch.hpp>

using namespace clast;

TEST_CASE("a clump that is added has its pebbles in a row, turned and moved, and owns them") {
    specimen s;
    s.shapes = {shapes::tetrahedron_4(0.02), shapes::sphere(0.01)};
    const quaternion q = unit(quaternion{1.0, 0.2, -0.5, 0.4});
    CHECK(s.add(1, {1, 2, 3}, {}) == 0);
    CHECK(s.add(0, {0.1, -0.2, 0.3}, q) == 1);
    CHECK(s.grain_count() == 2);
    CHECK(s.pebble_count() == 5);
    CHECK(s.grains[1].first == 1);
    CHECK(s.is_clump(1));
    for (std::size_t k = 0; k < 4; ++k) {
        const shape_pebble& p = s.shapes[0].pebbles[k];
        CHECK(norm(s.pebbles[1 + k].x - vec3{0.1, -0.2, 0.3}) == Approx(norm(p.offset)).epsilon(1e-14));
        CHECK(norm(rotate_back(q, s.pebbles[1 + k].x - vec3{0.1, -0.2, 0.3}) - p.offset) < 1e-16);
        CHECK(s.pebbles[1 + k].radius == p.radius);
        CHECK(s.mother[1 + k] == 1);
        CHECK(s.owner[1 + k] == 1);
    }
    CHECK(s.owner[0] == 0);
    CHECK(norm(s.motion[1].v) == 0.0);
}

TEST_CASE("mass, inertia and solid volume are those of the pebbles") {
    specimen s;
    s.density = 2000.0;
    s.shapes = {shapes::sphere(0.02)};
    s.add(0, {}, {});
    const double m = 2000.0 * 4.0 / 3.0 * 3.14159265358979323846 * 1e-6;
    CHECK(s.mass_of(s.grains[0]) == Approx(m).epsilon(1e-14));
    CHECK(s.ball_mass(0) == Approx(m).epsilon(1e-14));
    CHECK(s.ball_inertia(0) == Approx(0.4 * m * 1e-4).epsilon(1e-14));
    CHECK(s.inverse_inertia(s.grains[0]).x == Approx(1.0 / (0.4 * m * 1e-4)).epsilon(1e-14));
    CHECK(s.solid_volume() == Approx(m / 2000.0).epsilon(1e-14));
    CHECK(s.solid_volume() == Approx(s.shapes[0].volume).epsilon(1e-14));
}

TEST_CASE("a specimen comes back from an archive") {
    specimen s, copy;
    s.shapes = {shapes::apollonian_14(0.02)};
    s.add(0, {1, 2, 3}, unit(quaternion{1.0, 0.2, -0.5, 0.4}));
    s.turning[0].l = {1, 2, 3};
    s.losses[0].friction = 5.0;
    from_bytes(to_bytes(s), copy);
    CHECK(checksum(copy) == checksum(s));
    CHECK(copy.turning[0].l == s.turning[0].l);
    CHECK(copy.pebble_count() == 14);
}
