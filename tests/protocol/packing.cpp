// SPDX-License-Identifier: MIT
#include <clast/protocol/packing.hpp>

#include <cmath>
#include <string>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/grains/mixture.hpp>
#include <clast/io/archive.hpp>
#include <clast/searches/cell_grid.hpp>

#include <catch.hpp>

using namespace clast;

namespace {
bodies::clumps cloud(std::size_t count, const protocol::cylinder& room, std::uint64_t seed) {
    bodies::clumps s;
    s.shapes = {shapes::tetrahedron_4(circumscribed(0.02))};
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
    protocol::add_cloud(s, shapes::apollonian_14(circumscribed(0.01)), 60, room, 3);
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
        protocol::add_cloud(s, shapes::tetrahedron_4(circumscribed(0.02)), 1, room, 5);
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

TEST_CASE("a cloud of several shapes and sizes: all of them, none in another's sphere, the largest not left over") {
    const mixture of(
        {{shapes::apollonian_14(circumscribed(0.02)), 0.5}, {shapes::tetrahedron_4(circumscribed(0.02)), 0.5}},
        grading({{0.006, 0.0}, {0.02, 0.5}, {0.03, 1.0}}));
    const protocol::cylinder room{0.08, 0.0, 0.2};
    const std::vector<mixture_grain> grains = of.grains_of(0.1 * 3.14159 * 0.08 * 0.08 * 0.2);
    bodies::clumps s;
    protocol::add(s, of, protocol::cloud_of(s, of, grains, room, 7));
    REQUIRE(s.grain_count() == grains.size());
    REQUIRE(grains.size() > 300);
    CHECK(s.shapes.size() == 2);
    double volume = 0.0;
    for (const mixture_grain& g : grains) volume += of.volume(g);
    CHECK(s.solid_volume() == Approx(volume).epsilon(1e-12));
    std::vector<searches::sphere> spheres;
    for (std::size_t g = 0; g < s.grain_count(); ++g) {
        const double r = s.bounding_radius(g);
        spheres.push_back({s.centre(g), r, 0});
        CHECK(std::hypot(s.centre(g).x, s.centre(g).y) <= room.radius - r);
        CHECK((s.centre(g).z >= r && s.centre(g).z <= 0.2 - r));
    }
    CHECK(searches::cell_grid{}.pairs(spheres, 0.0).empty());
}

TEST_CASE("a packing of one's own is looked at: inside, orientations, sizes, overlaps") {
    const mixture of = shapes::tetrahedron_4(circumscribed(0.02));
    const std::vector<placed_grain> good = {{{0, 1.0}, {0.0, 0.0, 0.011}, {}}, {{0, 1.2}, {0.0, 0.0, 0.04}, {}}};
    const auto refusal = [&](auto&& change) -> std::string {
        std::vector<placed_grain> grains = good;
        change(grains);
        try {
            (void)protocol::packing(of, grains);
        } catch (const input_error& e) {
            return e.what();
        }
        return {};
    };
    const auto names = [](const std::string& text, const char* where, const char* what) {
        INFO(text);
        CHECK(text.find(where) == 0);
        CHECK(text.find(what) != std::string::npos);
        CHECK(text.find("Allowed") != std::string::npos);
    };
    CHECK(refusal([](auto&) {}).empty());
    names(refusal([](auto& g) { g.clear(); }), "packing", "no grains");
    names(refusal([](auto& g) { g[1].part = 1; }), "packing, grain 2", "shape number 1");
    names(refusal([](auto& g) { g[1].scale = 0.0; }), "packing, grain 2", "scale 0");
    names(refusal([](auto& g) { g[0].centre.x = std::nan(""); }), "packing, grain 1", "a place, finite");
    names(refusal([](auto& g) { g[1].q = {2, 0, 0, 0}; }), "packing, grain 2", "orientation 2 0 0 0");
    names(refusal([](auto& g) { g[1].centre.z = 0.018; }), "packing, grain 1", "m inside grain 2");
    // and inside: by nine tenths of a radius
    const protocol::cylinder room{0.03, 0.0, 0.06};
    CHECK(protocol::first_outside(room, protocol::packing(of, good).pebbles()) == 8);
    const auto first_out = [&](const vec3& by) {
        std::vector<placed_grain> grains = good;
        grains[1].centre += by;
        return protocol::first_outside(room, protocol::packing(of, grains).pebbles());
    };
    const double r = 1.2 * of.parts()[0].form.pebbles[0].radius, reach = 1.2 * of.parts()[0].form.pebbles[0].offset.z;
    CHECK(first_out({0, 0, 0.02 - reach - 0.91 * r}) == 8);
    CHECK(first_out({0, 0, 0.02 - reach - 0.89 * r}) < 8);
    CHECK(first_out({0.025, 0, 0}) < 8);
}

TEST_CASE("the sizes of a packing are those of its grains") {
    const mixture m({{shapes::apollonian_14(circumscribed(0.02)), 1.0}, {shapes::sphere(0.02), 1.0}});
    // spheres of 1, 2 and 3: the largest has 27 of 36 parts of the mass
    const std::vector<placed_grain> grains = {
        {{1, 1.5}, {0.1, 0, 0}, {}}, {{1, 0.5}, {}, {}}, {{1, 1.0}, {-0.1, 0, 0}, {}}};
    const grain_sizes given = protocol::packing(m, grains).sizes();
    CHECK(given.d50 == Approx(0.03));
    CHECK(given.largest_circumscribed == Approx(0.03));
    CHECK(given.smallest_radius == Approx(0.005));
    CHECK(given.largest_radius == Approx(0.015));
    CHECK(protocol::packing().empty());
}
