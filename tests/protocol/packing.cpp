// SPDX-License-Identifier: MIT
#include <clast/protocol/packing.hpp>

#include <cmath>
#include <string>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/io/archive.hpp>

#include <catch.hpp>

using namespace clast;

namespace {
bodies::clumps cloud(std::size_t count, const protocol::cylinder& room, std::uint64_t seed) {
    bodies::clumps s;
    s.shapes = {shapes::tetrahedron_4(0.02)};
    protocol::add_cloud(s, 0, count, room, seed);
    return s;
}
} // namespace

TEST_CASE("a cloud has as many grains as asked for, inside, at rest and apart from each other") {
    const protocol::cylinder room{0.06, -0.02, 0.15};
    const bodies::clumps s = cloud(60, room, 3);
    REQUIRE(s.grain_count() == 60);
    for (std::size_t g = 0; g < 60; ++g) {
        const vec3& c = s.motion[g].x;
        CHECK(std::hypot(c.x, c.y) <= room.radius - 0.01);
        CHECK(c.z >= room.bottom + 0.01);
        CHECK(c.z <= room.top - 0.01);
        CHECK(norm(s.motion[g].v) == 0.0);
        for (std::size_t h = 0; h < g; ++h) CHECK(norm(c - s.motion[h].x) > 0.02);
    }
    for (std::size_t p = 0; p < s.pebble_count(); ++p)
        CHECK(std::hypot(s.pebbles[p].x.x, s.pebbles[p].x.y) + s.pebbles[p].radius <= room.radius);
}

TEST_CASE("the seed makes the cloud: the same one the same, another one another") {
    const protocol::cylinder room{0.06, 0.0, 0.15};
    CHECK(checksum(cloud(40, room, 5)) == checksum(cloud(40, room, 5)));
    CHECK(checksum(cloud(40, room, 5)) != checksum(cloud(40, room, 6)));
}

TEST_CASE("a cloud is spread evenly: half of it in each half of the room, orientations without a preference") {
    const bodies::clumps s = cloud(1000, {0.2, 0.0, 0.8}, 1);
    vec3 mean, axis;
    double inside = 0.0;
    for (std::size_t g = 0; g < 1000; ++g) {
        mean += s.motion[g].x * 1e-3;
        axis += 1e-3 * rotate(s.turning[g].q, {0, 0, 1});
        if (std::hypot(s.motion[g].x.x, s.motion[g].x.y) < 0.19 / std::sqrt(2.0)) inside += 1e-3;
    }
    CHECK(std::abs(mean.z - 0.4) < 0.03);
    CHECK(std::hypot(mean.x, mean.y) < 0.015);
    CHECK(norm(axis) < 0.08);
    CHECK(inside == Approx(0.5).margin(0.05)); // half of the section
}

TEST_CASE("a cloud too dense for its room is refused with the number that fits, and so is a room below one grain") {
    std::string text;
    try {
        (void)cloud(200, {0.03, 0.0, 0.06}, 1);
    } catch (const input_error& e) {
        text = e.what();
    }
    CHECK(text.find("number of grains") != std::string::npos);
    CHECK(text.find("200") != std::string::npos);
    CHECK(text.find("about") != std::string::npos);
    CHECK_THROWS_AS(cloud(1, {0.009, 0.0, 1.0}, 1), input_error);
    CHECK_THROWS_AS(cloud(1, {1.0, 0.0, 0.019}, 1), input_error);
}

TEST_CASE("a cloud keeps off what is there already, whatever its size, and is the same as ever where nothing is") {
    const protocol::cylinder room{0.06, 0.0, 0.15};
    bodies::clumps s = cloud(30, room, 3);
    protocol::add_cloud(s, 0, 30, room, 3);
    REQUIRE(s.grain_count() == 60);
    protocol::add_cloud(s, shapes::apollonian_14(0.01), 60, room, 3);
    REQUIRE(s.grain_count() == 120);
    REQUIRE(s.shapes.size() == 2);
    for (std::size_t g = 0; g < 120; ++g)
        for (std::size_t h = 0; h < g; ++h)
            CHECK(norm(s.centre(g) - s.centre(h)) > s.bounding_radius(g) + s.bounding_radius(h));
    const bodies::clumps once = cloud(30, room, 3);
    for (std::size_t g = 0; g < 30; ++g) CHECK(norm(once.centre(g) - s.centre(g)) == 0.0);
    // one that fills the room, and one far outside of it
    bodies::spheres big;
    big.add({0, 0, 0.075}, 0.07);
    big.add({1e30, -1e30, 5.0}, 0.07);
    CHECK_THROWS_AS(protocol::add_cloud(big, shapes::sphere(0.02), 30, room, 3), input_error);
}

TEST_CASE("a cloud of spheres stands where that of clumps of their size stands, and takes single spheres only") {
    const protocol::cylinder room{0.06, 0.0, 0.15};
    bodies::spheres s;
    protocol::add_cloud(s, shapes::sphere(0.02), 40, room, 5);
    const bodies::clumps other = cloud(40, room, 5);
    REQUIRE(s.body_count() == 40);
    for (std::size_t b = 0; b < 40; ++b) CHECK(norm(s.centre(b) - other.centre(b)) < 1e-15); // 4B: 0.02 by rounding
    CHECK(s.pebbles[7].radius == 0.01);
    std::string text;
    try {
        protocol::add_cloud(s, shapes::tetrahedron_4(0.02), 1, room, 5);
    } catch (const input_error& e) {
        text = e.what();
    }
    CHECK(text.find("grain") == 0);
    CHECK(text.find("'4B'") != std::string::npos);
    CHECK(text.find("shapes::sphere") != std::string::npos);
    CHECK(text.find("bodies::clumps") != std::string::npos);
    CHECK(s.body_count() == 40);
}

TEST_CASE("a cloud in a box fills its corners") {
    boundaries::vessel_settings sizes;
    sizes.radius = 0.1, sizes.top = 0.2, sizes.contact_stiffness_floor = 1e6;
    const auto vessel = boundaries::box::made(sizes);
    bodies::spheres s;
    protocol::add_cloud(s, shapes::sphere(0.02), 200, protocol::inside(vessel), 1);
    std::size_t corner = 0;
    for (std::size_t b = 0; b < 200; ++b) {
        CHECK(vessel.holds(s.centre(b), 0.01 * (1.0 - 1e-12)));
        if (std::hypot(s.centre(b).x, s.centre(b).y) > 0.09) ++corner;
    }
    CHECK(corner > 20); // 0.21 of the section of centres
}
