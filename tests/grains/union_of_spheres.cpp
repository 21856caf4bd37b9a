// SPDX-License-Identifier: MIT
#include <clast/grains/union_of_spheres.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <clast/core/random.hpp>

#include <catch.hpp>

using namespace clast;

namespace {
constexpr double pi = std::numbers::pi;

double ball(double r) { return 4.0 / 3.0 * pi * r * r * r; }
/// Part of a sphere beyond a plane at a distance from its centre.
double cap(double r, double distance) {
    const double h = r - distance;
    return pi * h * h * (3.0 * r - h) / 3.0;
}
/// Moments of the same by counting points.
solid_moments counted(const std::vector<union_sphere>& spheres, std::size_t points) {
    random_stream random{3, 1};
    solid_moments m;
    const double size = 2.0;
    const double one = 8.0 * size * size * size / static_cast<double>(points);
    for (std::size_t k = 0; k < points; ++k) {
        const vec3 x{uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
        bool inside = false;
        for (const union_sphere& s : spheres) inside = inside || norm(x - s.centre) < s.radius;
        if (!inside) continue;
        m.volume += one;
        m.first += one * x;
        m.second += one * outer(x, x);
    }
    return m;
}
} // namespace

TEST_CASE("one sphere, apart spheres, a sphere inside another and the same one twice have their closed forms") {
    const union_sphere s{{0.3, -0.2, 0.5}, 0.7};
    for (const std::vector<union_sphere>& same :
         {std::vector{s}, std::vector{s, s}, std::vector{s, union_sphere{{0.4, -0.2, 0.5}, 0.2}}}) {
        const solid_moments m = moments_of_union(same);
        CHECK(m.volume == Approx(ball(0.7)).epsilon(1e-9));
        CHECK(norm(m.first / m.volume - s.centre) < 1e-9);
        const double own = 0.2 * 0.7 * 0.7 * m.volume; // of one axis, about the centre
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                CHECK(m.second(i, j) ==
                      Approx(m.volume * s.centre[i] * s.centre[j] + (i == j ? own : 0.0)).epsilon(1e-8));
    }
    const solid_moments two = moments_of_union({{{-1, 0, 0}, 0.5}, {{1, 0.3, 0.2}, 0.8}});
    CHECK(two.volume == Approx(ball(0.5) + ball(0.8)).epsilon(1e-9));
    CHECK(two.first.x == Approx(ball(0.8) - ball(0.5)).epsilon(1e-8));
}

TEST_CASE("two spheres that overlap lack their lens, in any direction") {
    random_stream random{3, 2};
    for (int k = 0; k < 20; ++k) {
        const double a = uniform(random, 0.3, 1.0), b = uniform(random, 0.3, 1.0);
        const double d = uniform(random, std::abs(a - b), a + b);
        const vec3 n = k == 0 ? vec3{0, 0, 1} : k == 1 ? vec3{1, 0, 0} : direction(random);
        const double at = (d * d + a * a - b * b) / (2.0 * d); // of the plane of their circle, from the first centre
        const double volume = ball(a) + ball(b) - cap(a, at) - cap(b, d - at);
        const solid_moments m = moments_of_union({{{}, a}, {d * n, b}});
        CHECK(m.volume == Approx(volume).epsilon(3e-9));
        // first moment along the line of centres: of a cap, pi h^2 (2 r - h)^2 / 4 about the sphere's centre
        const auto of_cap = [](double r, double distance) {
            const double h = r - distance;
            return 0.25 * pi * h * h * (2.0 * r - h) * (2.0 * r - h);
        };
        const double first = ball(b) * d - of_cap(a, at) - (cap(b, d - at) * d - of_cap(b, d - at));
        CHECK(dot(m.first, n) == Approx(first).margin(1e-8));
        CHECK(norm(reject(m.first, n)) < 1e-8);
    }
}

TEST_CASE("many spheres: as counting points has it, whatever the axes") {
    random_stream random{3, 3};
    std::vector<union_sphere> spheres;
    for (int k = 0; k < 9; ++k)
        spheres.push_back({uniform(random, 0.2, 1.0) * direction(random), uniform(random, 0.3, 0.8)});
    const solid_moments m = moments_of_union(spheres), other = counted(spheres, 400000);
    CHECK(m.volume == Approx(other.volume).epsilon(0.01));
    CHECK(norm(m.first - other.first) < 0.02 * m.volume);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) CHECK(m.second(i, j) == Approx(other.second(i, j)).margin(0.02 * m.volume));
    // slices in another direction know nothing of the first ones
    const quaternion q = orientation(random);
    std::vector<union_sphere> turned = spheres;
    for (union_sphere& s : turned) s.centre = rotate(q, s.centre);
    const solid_moments t = moments_of_union(turned);
    CHECK(t.volume == Approx(m.volume).epsilon(1e-8));
    CHECK(norm(t.first - rotate(q, m.first)) < 1e-8 * m.volume);
    CHECK(trace(t.second) == Approx(trace(m.second)).epsilon(1e-8));
}
