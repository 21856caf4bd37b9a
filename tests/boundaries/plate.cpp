// SPDX-License-Identifier: MIT
// A triangle as part of a wall: nearest points, and ways out of one, a ridge and a valley, by hand. What plates of a
// whole wall do is seen in node_rows.cpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/plate.hpp>
#include <clast/core/random.hpp>

using namespace clast;
using namespace clast::boundaries;

namespace {

constexpr std::array<std::array<double, 4>, 3> own{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

plate of(const vec3& a, const vec3& b, const vec3& c, const vec3& inside) {
    plate p{a, b, c, {}, {2, 3, 4, 5}, &own};
    p.orient();
    if (dot(inside - a, p.n) < 0.0) p.n = -p.n;
    return p;
}
touches pushed(const std::vector<plate>& plates, const vec3& x, double r) {
    plates_near near;
    for (const plate& p : plates) near.add(p, separate(p, x));
    touches out;
    push_out(
        near, x, r,
        [](int) {
            return vec3{0, 0, -1};
        },
        out);
    return out;
}

} // namespace

TEST_CASE("the foot on a triangle is its nearest point", "[boundaries]") {
    random_stream random{3, 0};
    const auto u = [&] { return 2.0 * uniform01(random) - 1.0; };
    int faces = 0;
    for (int run = 0; run < 300; ++run) {
        const plate p = of({u(), u(), u()}, {u(), u(), u()}, {u(), u(), u()}, {u(), u(), u()});
        const vec3 x{2 * u(), 2 * u(), 2 * u()};
        const foot f = foot_on(p, x);
        const auto at = [&](double b, double c) { return norm(x - ((1.0 - b - c) * p.a + b * p.b + c * p.c)); };
        const double mine = at(f.weights[1], f.weights[2]);
        double least = 1e9;
        for (int i = 0; i <= 60; ++i)
            for (int j = 0; i + j <= 60; ++j) least = std::min(least, at(i / 60.0, j / 60.0));
        CHECK(mine <= least * (1.0 + 1e-12));
        CHECK(mine >= least - 0.06); // the grid is that coarse
        CHECK(f.weights[0] + f.weights[1] + f.weights[2] == Approx(1.0).epsilon(1e-12));
        CHECK(*std::min_element(f.weights.begin(), f.weights.end()) >= -1e-12);
        faces += f.on_face;
        const separation s = separate(p, x);
        CHECK(std::abs(s.distance) == Approx(mine).epsilon(1e-9));
        CHECK(norm(s.normal) == Approx(1.0).epsilon(1e-12));
    }
    CHECK(faces > 8);
}

TEST_CASE("the foot inside a face is the foot on the triangle, bit by bit", "[boundaries]") {
    random_stream random{13, 0};
    const auto u = [&] { return 2.0 * uniform01(random) - 1.0; };
    int inside = 0, by_an_edge = 0;
    for (int run = 0; run < 3000; ++run) {
        const plate p = of({u(), u(), u()}, {u(), u(), u()}, {u(), u(), u()}, {u(), u(), u()});
        const vec3 x{2 * u(), 2 * u(), 2 * u()};
        const foot one = foot_inside(p.a, p.b, p.c, x, 0.1), other = foot_on(p, x);
        const double least = *std::min_element(other.weights.begin(), other.weights.end());
        CHECK(one.on_face == (least > 0.1));
        if (one.on_face) CHECK(one.weights == other.weights);
        inside += one.on_face, by_an_edge += other.on_face && !one.on_face;
    }
    CHECK(inside > 20);
    CHECK(by_an_edge > 20);
}

TEST_CASE("a sphere on a plate is pushed along its normal, by the parts of the corners", "[boundaries]") {
    const plate floor = of({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    CHECK(floor.n == vec3{0, 0, 1});
    const touches t = pushed({floor}, {0.2, 0.3, 0.08}, 0.1);
    REQUIRE(t.size == 3);
    const double parts[] = {0.5, 0.2, 0.3};
    for (int i = 0; i < 3; ++i) {
        const touch& one = t.at[static_cast<std::size_t>(i)];
        CHECK(one.facet == 2 + i);
        CHECK(one.part == Approx(parts[i]).epsilon(1e-12));
        CHECK(one.depth == Approx(0.02 * parts[i]).epsilon(1e-12));
        CHECK(one.along == Approx(1.0).epsilon(1e-12)); // nodes move up and down
    }
    CHECK(norm(lateral_push(t) - vec3{0, 0, 0.02}) < 1e-14);
    CHECK(pushed({floor}, {0.2, 0.3, 0.1001}, 0.1).size == 0);
    // a centre below the plate comes back up
    CHECK(norm(lateral_push(pushed({floor}, {0.2, 0.3, -0.05}, 0.1)) - vec3{0, 0, 0.15}) < 1e-14);
}

TEST_CASE("on a ridge a sphere is pushed away from the edge, in a valley by both plates", "[boundaries]") {
    const vec3 up{0, 0, 10};
    // a roof: 45 degrees to either side of the y axis
    const std::vector<plate> roof{of({0, -1, 0}, {0, 1, 0}, {1, 0, -1}, up),
                                  of({0, -1, 0}, {0, 1, 0}, {-1, 0, -1}, up)};
    const vec3 x{0.03, 0, 0.06};
    const vec3 away = unit(x);
    CHECK(norm(lateral_push(pushed(roof, x, 0.1)) - (0.1 - norm(x)) * away) < 1e-11);
    // a gutter
    const std::vector<plate> gutter{of({0, -1, 0}, {0, 1, 0}, {1, 0, 1}, up),
                                    of({0, -1, 0}, {0, 1, 0}, {-1, 0, 1}, up)};
    const touches t = pushed(gutter, {0.01, 0, 0.12}, 0.1);
    const vec3 u = lateral_push(t); // to the line at r / cos 45 above the edge
    CHECK(norm(u - vec3{-0.01, 0, 0.1 * std::sqrt(2.0) - 0.12}) < 1e-11);
    int planes = 1;
    for (int i = 1; i < t.size; ++i)
        planes += !(t.at[static_cast<std::size_t>(i)].normal == t.at[static_cast<std::size_t>(i - 1)].normal);
    CHECK(planes == 2);
    // behind the edge of the gutter, out of both plates: back in through the edge
    const vec3 out = lateral_push(pushed(gutter, {0, 0, -0.02}, 0.1));
    CHECK(out.z == Approx(0.02 + 0.1 * std::sqrt(2.0)).epsilon(1e-9));
    CHECK(std::abs(out.x) < 1e-9);
}

TEST_CASE("of very many plates the nearest are kept", "[boundaries]") {
    plates_near near;
    for (std::size_t k = 0; k < plates_near::most + 20; ++k) {
        const double z = -0.01 * static_cast<double>((7 * k) % (plates_near::most + 20));
        const plate p = of({0, 0, z}, {1, 0, z}, {0, 1, z}, {0, 0, 9});
        near.add(p, separate(p, {0.2, 0.2, 0.05}));
    }
    REQUIRE(near.size() == plates_near::most);
    for (std::size_t j = 0; j < near.size(); ++j) CHECK(near.how(j).distance < 0.05 + 0.01 * plates_near::most - 1e-9);
}
