// SPDX-License-Identifier: MIT
// Four triangles around the mean of four corners: where a place is among them, and whether a sphere that rests on one
// is free of the others, against their distances one by one.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/quadrilateral.hpp>
#include <clast/core/random.hpp>

using namespace clast;
using namespace clast::boundaries;

namespace {

double between(random_stream& random, double low, double high) { return low + (high - low) * uniform01(random); }

/// A rectangle, 2 x 1.2, whose inside is up, with corners off their places by up to `by`.
corners crooked(random_stream& random, double by) {
    corners c{vec3{-1, -0.6, 0}, {1, -0.6, 0}, {1, 0.6, 0}, {-1, 0.6, 0}};
    std::swap(c[1], c[3]); // clockwise, seen from above
    for (vec3& x : c) x += by * vec3{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
    return c;
}

struct whole {
    corners c;
    quadrilateral q;
    quarter_normals n;
    std::vector<plate> parts;

    explicit whole(const corners& of) : c(of), q(quadrilateral::of(of)), n(normals_of_quarters(of, q.middle)) {
        for (std::size_t k = 0; k < 4; ++k) parts.push_back(quarter(c, q.middle, k, n[k], {2, 3, 4, 5}));
    }
    double distance(const vec3& x, std::size_t but = 4) const {
        double least = 1e9;
        for (std::size_t k = 0; k < 4; ++k)
            if (k != but) least = std::min(least, separate(parts[k], x).distance);
        return least;
    }
};

} // namespace

TEST_CASE("corners of a quadrilateral lie alternately on both sides of its middle plane", "[boundaries]") {
    // by hand: two corners up by 0.1, two down
    const whole w({vec3{-1, -1, 0.1}, {-1, 1, -0.1}, {1, 1, 0.1}, {1, -1, -0.1}});
    CHECK(norm(w.q.middle) < 1e-15);
    CHECK(norm(w.q.normal - vec3{0, 0, 1}) < 1e-15);
    CHECK(w.q.bent == Approx(0.1).epsilon(1e-14));
    CHECK(w.q.before({0.3, 0.2, 0.75}) == Approx(0.65).epsilon(1e-14));
    CHECK(norm(w.n[0] - unit(vec3{-0.1, 0, 1})) > 0.1); // its triangles are tilted
    for (std::size_t k = 0; k < 4; ++k) CHECK(w.n[k].z > 0.9);
    random_stream random{5, 0};
    for (int run = 0; run < 200; ++run) {
        const whole one(crooked(random, 0.4));
        for (std::size_t k = 0; k < 4; ++k) {
            const double off = dot(one.c[k] - one.q.middle, one.q.normal);
            CHECK(std::abs(off) == Approx(one.q.bent).margin(1e-14));
            CHECK(off * dot(one.c[(k + 1) % 4] - one.q.middle, one.q.normal) <= 1e-28);
        }
        const vec3 x{between(random, -2, 2), between(random, -2, 2), between(random, -0.5, 2)};
        if (one.q.before(x) > 0.0) CHECK(one.q.before(x) <= one.distance(x) * (1.0 + 1e-12));
    }
}

TEST_CASE("a triangle of a quadrilateral hangs on two of its nodes, and by a quarter on all", "[boundaries]") {
    random_stream random{6, 0};
    const whole one(crooked(random, 0.3));
    for (std::size_t k = 0; k < 4; ++k) {
        const plate& p = one.parts[k];
        const std::array<vec3, 3> at{p.a, p.b, p.c};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            vec3 sum;
            for (std::size_t i = 0; i < 4; ++i) sum += (*p.parts)[corner][i] * one.c[i];
            CHECK(norm(sum - at[corner]) < 1e-15);
        }
        plate again = p;
        again.orient();
        CHECK(again.n == p.n);
        // over its middle no other one is named; outside of the frame of diagonals by no more than `aside`
        const vec3 x = (1.0 / 3.0) * (p.a + p.b + p.c) + 0.1 * p.n;
        CHECK(place_among_quarters(one.c, one.q, x).quarter() == k);
    }
    for (int run = 0; run < 300; ++run) {
        const whole w(crooked(random, 0.3));
        const std::size_t k = static_cast<std::size_t>(run) % 4;
        const double b = uniform01(random), c = (1.0 - b) * uniform01(random);
        const plate& p = w.parts[k];
        const vec3 x = (1.0 - b - c) * p.a + b * p.b + c * p.c; // on the triangle
        const place_among_quarters at(w.c, w.q, x);
        const double off = at.aside(w.c) * (1.0 + 1e-12);
        const double right = k == 1 || k == 2 ? at.alpha : -at.alpha, high = k >= 2 ? at.beta : -at.beta;
        CHECK(right >= -off);
        CHECK(high >= -off);
        CHECK(right + high <= at.span + off);
    }
}

TEST_CASE("a sphere that rests on a triangle is free of others as their distances say", "[boundaries]") {
    random_stream random{7, 0};
    int free_ones = 0, held = 0;
    for (const double by : {0.0, 0.02, 0.1, 0.35}) {
        for (int run = 0; run < 3000; ++run) {
            const whole own(crooked(random, by));
            const std::size_t k = static_cast<std::size_t>(run) % 4;
            const double b = uniform01(random), c = (1.0 - b) * uniform01(random), r = between(random, 0.05, 0.6);
            const plate& p = own.parts[k];
            const resting_sphere s{(1.0 - b - c) * p.a + b * p.b + c * p.c + r * p.n, r, p.a, p.n};
            const double tolerance = 1e-11 * r;
            const double inside = own.distance(s.y, k);
            CHECK(s.is_free_of(own.c, own.q.middle, own.n, k, tolerance) == (inside >= r - tolerance));
            // and of another one at its side, on the same corners there
            corners next = crooked(random, by);
            for (vec3& x : next) x.x += 2.0;
            next[0] = own.c[3], next[1] = own.c[2];
            const whole other(next);
            const double beside = other.distance(s.y);
            INFO("out by " << by << ", run " << run << ", distances " << inside / r << " " << beside / r);
            CHECK(s.is_free_of(other.c, other.q.middle, other.n, 4, tolerance) == (beside >= r - tolerance));
            (std::min(inside, beside) >= r - tolerance ? free_ones : held) += 1;
        }
    }
    CHECK(free_ones > 3000);
    CHECK(held > 200);
}
