// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/push_out.hpp>

using namespace clast;
using namespace clast::boundaries;

namespace {

constexpr double r = 4e-3;
constexpr double h = 19.4e-3;
constexpr double infinity = std::numeric_limits<double>::infinity();

// Tiles in direction (cos angle, sin angle) stacked from z = 0; the end ones reach on for ever.
void add_column(std::vector<half_slab>& wall, double angle, const std::vector<double>& apothem, double height = h) {
    const int n = static_cast<int>(apothem.size());
    for (int k = 0; k < n; ++k)
        wall.push_back({std::cos(angle), std::sin(angle), apothem[static_cast<std::size_t>(k)],
                        k == 0 ? -infinity : k * height, k + 1 == n ? infinity : (k + 1) * height,
                        static_cast<std::int32_t>(wall.size()) + first_lateral_facet});
}

touches contacts(const std::vector<half_slab>& wall, const vec3& x) {
    touches t;
    push_out(wall, x, r, t);
    return t;
}
vec3 push(const std::vector<half_slab>& wall, const vec3& x) { return lateral_push(contacts(wall, x)); }

double least_clearance(const std::vector<half_slab>& wall, const vec3& x) {
    double least = infinity;
    for (const half_slab& s : wall) least = std::min(least, separate(s, x).distance - r);
    return least;
}

// Three columns 18 degrees apart with random steps of up to 2 mm either way.
std::vector<half_slab> random_wall(std::mt19937& random) {
    std::uniform_real_distribution<double> step(-2e-3, 2e-3);
    std::vector<half_slab> wall;
    for (const double angle : {-0.1 * std::numbers::pi, 0.0, 0.1 * std::numbers::pi})
        add_column(wall, angle, {0.15 + step(random), 0.15 + step(random), 0.15 + step(random)}, 6e-3);
    return wall;
}

} // namespace

TEST_CASE("coplanar tiles push like one plane, wherever a sphere touches them and however deep", "[boundaries]") {
    std::vector<half_slab> wall;
    add_column(wall, 0.0, {0.15, 0.15, 0.15});
    std::mt19937 random(1);
    std::uniform_real_distribution<double> z(-0.2 * h, 3.2 * h), x(0.15 - 1.2 * r, 0.15 + 0.4 * r);
    double error = 0.0;
    int most = 0;
    for (int n = 0; n < 20000; ++n) {
        const vec3 c{x(random), 0.01, n % 4 ? z(random) : h + 1e-9 * (n % 3 - 1)};
        const touches t = contacts(wall, c);
        most = std::max(most, t.size);
        const double overlap = std::max(0.0, r - (0.15 - c.x));
        error = std::max(error, norm(lateral_push(t) - vec3{-overlap, 0, 0}));
    }
    CHECK(error < 1e-12 * r);
    CHECK(most == 1);
}

TEST_CASE("in the valley between two tiles a sphere touches both, with the closed-form shares", "[boundaries]") {
    const double a = 0.1 * std::numbers::pi;
    std::vector<half_slab> wall;
    add_column(wall, 0.0, {0.15});
    add_column(wall, a, {0.15});
    const double middle = 0.15 / std::cos(0.5 * a) - (r - 1e-4) / std::cos(0.5 * a);
    const touches t = contacts(wall, {middle * std::cos(0.5 * a), middle * std::sin(0.5 * a), 0.0});
    REQUIRE(t.size == 2);
    // each plane alone would be overlapped by 1e-4; lambda (1 + cos a) = overlap
    for (const touch& one : t) {
        CHECK(one.depth == Approx(1e-4 / (1.0 + std::cos(a))).epsilon(1e-10));
        CHECK(one.along == Approx(1.0).epsilon(1e-14));
    }
    CHECK(norm(lateral_push(t)) == Approx(1e-4 / std::cos(0.5 * a)).epsilon(1e-10));
}

TEST_CASE("the force is continuous along any path across a step of 4.6 mm", "[boundaries]") {
    std::vector<half_slab> wall;
    add_column(wall, 0.0, {0.15, 0.1546, 0.15});
    double largest = 0.0;
    for (const double overlap : {0.05e-3, 0.2e-3, 0.4e-3})
        for (const int direction : {0, 1}) {
            vec3 previous;
            for (int n = 0; n < 30000; ++n) {
                // up along the face of the lower tile and past its edge; or outward over the ledge
                const vec3 x = direction == 0 ? vec3{0.15 - r + overlap, 0, h - 10e-3 + n * 1e-6}
                                              : vec3{0.15 - 2 * r + n * 0.4e-6, 0, h + r - overlap};
                const vec3 u = push(wall, x);
                if (n > 0) largest = std::max(largest, norm(u - previous));
                previous = u;
            }
            CHECK(norm(previous) >= (direction == 0 ? 0.0 : overlap)); // the path did end in contact
        }
    CHECK(largest < 1.5e-6); // moves by 1e-6 m; a jump would be of the size of the overlap, 50 to 400 times more
}

TEST_CASE("the force is minus the gradient of its elastic energy, on faces, edges, ledges and corners",
          "[boundaries]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> overlap(0.0, 0.15 * r), z(-3e-3, 20e-3), angle(-0.3, 0.3),
        valley(-3e-3, 3e-3);
    double worst = 0.0;
    int several = 0;
    int edges = 0;
    for (int n = 0; n < 4000; ++n) {
        const auto wall = random_wall(random);
        const double azimuth = angle(random);
        vec3 c{0.15 * std::cos(azimuth), 0.15 * std::sin(azimuth), z(random)};
        if (n % 2) { // every second sphere in a valley: it starts where it just touches two tiles of the middle ring
            const double a = 0.1 * std::numbers::pi;
            const double along = wall[4].apothem - r;
            c = {along, (wall[7].apothem - r - along * std::cos(a)) / std::sin(a), c.z};
        } else { // the others where they are just free
            while (least_clearance(wall, c) < 0.0) c -= 5e-5 * vec3{std::cos(azimuth), std::sin(azimuth), 0.0};
        }
        c += overlap(random) * vec3{std::cos(azimuth), std::sin(azimuth), 0.0};
        const touches t = contacts(wall, c);
        if (t.size == 0) continue;
        several += t.size > 1;
        for (const touch& one : t) edges += one.along < 0.999;
        const double d = 1e-8;
        vec3 gradient;
        for (int i = 0; i < 3; ++i) {
            vec3 step;
            step[i] = d;
            gradient[i] = (norm2(push(wall, c + step)) - norm2(push(wall, c - step))) / (4.0 * d);
        }
        worst = std::max(worst, norm(gradient + lateral_push(t)));
    }
    CHECK(several > 200);
    CHECK(edges > 300);
    CHECK(worst < 3e-8); // the kinks of the force lie at most one difference step away
}

TEST_CASE("the push frees a sphere by the shortest way, and every facet only pushes", "[boundaries]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> depth(0.0, 0.4 * r), z(-3e-3, 20e-3), angle(-0.3, 0.3);
    std::normal_distribution<double> normal;
    double overlap_left = 0.0;
    int shorter = 0;
    double unbalanced = 0.0;
    for (int n = 0; n < 1000; ++n) {
        const auto wall = random_wall(random);
        const double azimuth = angle(random);
        const double rho = 0.15 - r + depth(random);
        const vec3 c{rho * std::cos(azimuth), rho * std::sin(azimuth), z(random)};
        const touches t = contacts(wall, c);
        const vec3 u = lateral_push(t);
        overlap_left = std::max(overlap_left, -least_clearance(wall, c + u));
        for (const touch& one : t) {
            CHECK(one.depth > 0.0);
            CHECK((one.along >= 0.0 && one.along <= 1.0 + 1e-15));
            CHECK(norm(one.normal) == Approx(1.0).epsilon(1e-14));
            for (const half_slab& s : wall) // the facet is really touched where the sphere comes free
                if (s.facet == one.facet) unbalanced = std::max(unbalanced, std::abs(separate(s, c + u).distance - r));
        }
        if (norm(u) == 0.0) continue;
        for (int m = 0; m < 60; ++m) {
            const vec3 elsewhere = 0.995 * norm(u) * unit(vec3{normal(random), normal(random), normal(random)});
            shorter += least_clearance(wall, c + elsewhere) >= 0.0;
        }
    }
    CHECK(overlap_left < 1e-12 * r);
    CHECK(unbalanced < 1e-12 * r);
    CHECK(shorter == 0);
}

TEST_CASE("a sphere can rest on a ledge and in a valley at once: three facets, each with its own share",
          "[boundaries]") {
    const double a = 0.1 * std::numbers::pi;
    std::vector<half_slab> wall;
    add_column(wall, 0.0, {0.144, 0.15});
    add_column(wall, a, {0.144, 0.15});
    const double middle = (0.15 - (r - 1e-4)) / std::cos(0.5 * a);
    const vec3 c{middle * std::cos(0.5 * a), middle * std::sin(0.5 * a), h + r - 2e-4};
    const touches t = contacts(wall, c);
    REQUIRE(t.size == 3);
    for (const touch& one : t)
        CHECK(one.depth == Approx(one.normal.z > 0.5 ? 2e-4 : 1e-4 / (1.0 + std::cos(a))).epsilon(1e-9));
    CHECK(lateral_push(t).z == Approx(2e-4).epsilon(1e-9));
}

TEST_CASE("a tile seen from behind lifts or lowers a sphere but never pulls it outward", "[boundaries]") {
    std::vector<half_slab> wall;
    add_column(wall, 0.0, {0.15, 0.1546, 0.15});
    // a small sphere whose centre sits behind the plane of the lower tile, on its ledge
    touches t;
    push_out(wall, {0.1502, 0.0, h + 1.9e-3}, 2e-3, t);
    REQUIRE(t.size == 1);
    CHECK(t.at[0].normal == vec3{0, 0, 1});
    CHECK(t.at[0].depth == Approx(0.1e-3).epsilon(1e-10));
    CHECK(t.at[0].along == 0.0);
    // under the protruding upper tile the same, downward
    touches up;
    push_out(wall, {0.1502, 0.0, 2 * h - 1.9e-3}, 2e-3, up);
    REQUIRE(up.size == 1);
    CHECK(up.at[0].normal == vec3{0, 0, -1});
}

TEST_CASE("a centre that has passed the plane is still pushed back in", "[boundaries]") {
    std::vector<half_slab> wall;
    add_column(wall, 0.0, {0.15, 0.15});
    for (const double past : {-1e-6, 0.0, 1e-6, 0.5 * r}) {
        const touches t = contacts(wall, {0.15 + past, 0, 0.3 * h});
        REQUIRE(t.size == 1);
        CHECK(t.at[0].normal == vec3{-1, 0, 0});
        CHECK(t.at[0].depth == Approx(r + past).epsilon(1e-12));
    }
}

TEST_CASE("an edge hands the facet only the part of the force along its own normal", "[boundaries]") {
    facet_load load;
    load.add({2, {-0.6, 0, 0.8}, 1e-4, 0.6}, 100.0, 2e6);
    CHECK(load.force == Approx(60.0).epsilon(1e-15));
    CHECK(load.stiffness == Approx(0.36 * 2e6).epsilon(1e-15));
    CHECK(load.contacts == 1);
}
