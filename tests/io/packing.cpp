// SPDX-License-Identifier: MIT
#include <clast/io/packing.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include <clast/bodies/clumps.hpp>
#include <clast/bodies/spheres.hpp>
#include <clast/core/random.hpp>

#include <catch.hpp>

#include "text_file.hpp"

using namespace clast;

namespace {
std::string refusal(const std::string& text, const mixture& of) {
    const text_file file(text);
    try {
        (void)read_packing(file.path, of);
    } catch (const input_error& e) {
        return e.what();
    }
    return {};
}
const char* const title = "x_m,y_m,z_m,d_m,shape,qw,qx,qy,qz\n";
} // namespace

TEST_CASE("a packing that was written is read back to the last bit: places, sizes, shapes and orientations") {
    bodies::clumps s;
    const mixture of(
        {{shapes::tetrahedron_4(circumscribed(0.02)), 1.0}, {shapes::apollonian_14(circumscribed(0.03)), 1.0}});
    for (const mixture_part& p : of.parts()) s.kind_of(p.form);
    random_stream random{4, 1};
    for (int g = 0; g < 20; ++g) s.add(g % 2, direction(random), orientation(random), g < 2 ? 1.0 : 0.5 + 0.01 * g);
    const text_file file("");
    write_packing(file.path, s);
    const std::vector<placed_grain> grains = read_packing(file.path, of).grains();
    REQUIRE(grains.size() == 20);
    for (std::size_t g = 0; g < 20; ++g) {
        CHECK(grains[g].part == g % 2);
        CHECK(grains[g].scale == Approx(s.grains[g].scale).epsilon(1e-15));
        CHECK(grains[g].centre == s.centre(g));
        const quaternion &a = grains[g].q, &b = s.turning[g].q;
        CHECK((a.w == b.w && a.x == b.x && a.y == b.y && a.z == b.z));
    }
    bodies::spheres balls;
    balls.add({0.1, 0.2, 0.3}, 0.01);
    write_packing(file.path, balls);
    const auto one = read_packing(file.path, shapes::sphere(0.04)).grains();
    REQUIRE(one.size() == 1);
    CHECK((one[0].scale == 0.5 && one[0].centre == vec3{0.1, 0.2, 0.3}));
}

TEST_CASE("spheres may come as four numbers each") {
    const text_file file("# x y z d\n0 0 0.01 0.02\n0,0,0.04,0.03\n");
    const auto grains = read_packing(file.path, shapes::sphere(0.02)).grains();
    REQUIRE(grains.size() == 2);
    CHECK((grains[0].scale == 1.0 && grains[1].scale == Approx(1.5)));
    CHECK(grains[1].centre.z == 0.04);
}

TEST_CASE("a packing that cannot be read is refused with what and where") {
    const mixture balls = shapes::sphere(0.02), clumps = shapes::tetrahedron_4(circumscribed(0.02));
    const auto names = [](const std::string& text, const char* what) {
        INFO(text);
        CHECK(text.find(what) != std::string::npos);
    };
    names(refusal("0 0 0.01\n", balls), ":1: 3 of four numbers");
    names(refusal("0 0 0.01\n", balls), "x_m,y_m,z_m,d_m,shape,qw,qx,qy,qz");
    names(refusal("0 0 0 -1\n", balls), ":1: the diameter -1 is not positive");
    names(refusal("0 0 0 0.02\n", clumps), "say nothing of shapes and orientations");
    names(refusal("", balls), "there are no grains");
    names(refusal(std::string(title) + "0,0,0,0.02,14B,1,0,0,0\n", clumps), "shape '14B'");
    names(refusal(std::string(title) + "0,0,0,0.02,14B,1,0,0,0\n", clumps), "grain 1");
    names(refusal(std::string(title) + "0,0,zero,0.02,4B,1,0,0,0\n", clumps), "'zero' in column z_m");
    CHECK_THROWS_AS(read_packing("/no/such/file", balls), input_error);
    CHECK(refusal(std::string(title) + "0,0,0,0.02,4B,1,0,0,0\n", clumps).empty());
}
