// SPDX-License-Identifier: MIT
#include <clast/core/vector.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include <clast/core/random.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

vec3 any(random_stream& random) { return {uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2)}; }
double difference(const mat3& a, const mat3& b) {
    double most = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) most = std::max(most, std::abs(a(i, j) - b(i, j)));
    return most;
}
mat3 product(const mat3& a, const mat3& b) {
    mat3 c;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) c(i, j) += a(i, k) * b(k, j);
    return c;
}

} // namespace

TEST_CASE("vectors: exact small numbers") {
    vec3 a{1, 2, 3};
    const vec3 b{4, -5, 6};
    CHECK(a + b == vec3{5, -3, 9});
    CHECK(a - b == vec3{-3, 7, -3});
    CHECK(-a == vec3{-1, -2, -3});
    CHECK(2.0 * a == vec3{2, 4, 6});
    CHECK(a * 2.0 == vec3{2, 4, 6});
    CHECK(a / 2.0 == vec3{0.5, 1, 1.5});
    CHECK(dot(a, b) == 12.0);
    CHECK(cross(a, b) == vec3{27, 6, -13});
    CHECK(cross(vec3{1, 0, 0}, vec3{0, 1, 0}) == vec3{0, 0, 1});
    CHECK(norm2(a) == 14.0);
    CHECK(norm(vec3{2, 3, 6}) == 7.0);
    CHECK(scale(a, b) == vec3{4, -10, 18});
    CHECK(reject(a, vec3{0, 0, 1}) == vec3{1, 2, 0});
    a += b;
    CHECK(a == vec3{5, -3, 9});
    a -= b;
    a *= 3.0;
    CHECK(a == vec3{3, 6, 9});
    a[1] = 7;
    CHECK((a[0] == 3.0 && a[1] == 7.0 && a[2] == 9.0));
}

TEST_CASE("the unit vector has length 1, and the zero vector stays zero") {
    random_stream random{1, 1};
    for (int i = 0; i < 100; ++i) {
        const vec3 a = any(random);
        CHECK(std::abs(norm(unit(a)) - 1.0) < 4e-16);
        CHECK(norm(cross(unit(a), a)) < 1e-15);
        CHECK(dot(unit(a), a) > 0.0);
    }
    CHECK(unit(vec3{}) == vec3{});
}

TEST_CASE("one component that is not finite makes a vector not finite") {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()})
        for (int k = 0; k < 3; ++k) {
            vec3 a{1, 2, 3};
            a[k] = bad;
            CHECK_FALSE(is_finite(a));
        }
    CHECK(is_finite(vec3{1e308, -1e308, 0}));
}

TEST_CASE("cross and dot: Lagrange's identity and the triple product") {
    random_stream random{1, 2};
    for (int i = 0; i < 100; ++i) {
        const vec3 a = any(random), b = any(random), c = any(random), n = unit(any(random));
        CHECK(norm2(cross(a, b)) == Approx(norm2(a) * norm2(b) - dot(a, b) * dot(a, b)).margin(1e-13));
        CHECK(norm(cross(a, cross(b, c)) - (dot(a, c) * b - dot(a, b) * c)) < 1e-13);
        CHECK(std::abs(dot(reject(a, n), n)) < 1e-15);
        CHECK(norm(reject(a, n) + dot(a, n) * n - a) < 1e-15);
    }
}

TEST_CASE("matrices: product with a vector, transpose, trace, outer product") {
    const mat3 m{{{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}};
    CHECK(m * vec3{1, 0, -1} == vec3{-2, -2, -3});
    CHECK(trace(m) == 16.0);
    CHECK(transpose(m)(0, 2) == 7.0);
    CHECK(transpose(m)(2, 1) == 6.0);
    CHECK((2.0 * m)(1, 2) == 12.0);
    CHECK((m + m)(2, 2) == 20.0);
    CHECK(mat3::identity() * vec3{1, 2, 3} == vec3{1, 2, 3});
    CHECK(trace(mat3::identity()) == 3.0);
    const vec3 a{1, 2, 3}, b{4, 5, 6}, c{-1, 2, 5};
    CHECK(outer(a, b) * c == dot(b, c) * a);
    CHECK(outer(a, b)(0, 1) == 5.0);
}

TEST_CASE("a quarter turn about z takes x to y") {
    const quaternion q = rotation({0, 0, 0.5 * std::numbers::pi});
    CHECK(norm(rotate(q, {1, 0, 0}) - vec3{0, 1, 0}) < 1e-15);
    CHECK(norm(rotate(q, {0, 1, 0}) - vec3{-1, 0, 0}) < 1e-15);
    CHECK(norm(rotate_back(q, {0, 1, 0}) - vec3{1, 0, 0}) < 1e-15);
}

TEST_CASE("a rotation by a vector agrees with Rodrigues' formula for any angle, also a tiny one") {
    random_stream random{1, 3};
    for (const double angle : {1e-300, 1e-12, 1e-7, 1.99e-4, 2.01e-4, 1e-2, 1.0, 3.0, 6.0, 40.0})
        for (int i = 0; i < 20; ++i) {
            const vec3 axis = direction(random), a = any(random);
            const quaternion q = rotation(angle * axis);
            const vec3 expected =
                std::cos(angle) * a + std::sin(angle) * cross(axis, a) + (1 - std::cos(angle)) * dot(axis, a) * axis;
            CHECK(norm(rotate(q, a) - expected) < 4e-15);
            // what matters for a tiny angle is the change
            if (angle < 0.1) CHECK(norm(rotate(q, a) - a - angle * cross(axis, a)) < 3.0 * angle * angle + 1e-15);
        }
    CHECK(rotation({}) == quaternion{});
}

TEST_CASE("quaternions: matrix, product, conjugate and length") {
    random_stream random{1, 4};
    for (int i = 0; i < 100; ++i) {
        const quaternion p = orientation(random), q = orientation(random);
        const vec3 a = any(random), b = any(random);
        CHECK(norm(matrix(q) * a - rotate(q, a)) < 4e-15);
        CHECK(difference(matrix(p * q), product(matrix(p), matrix(q))) < 4e-15);
        CHECK(difference(product(matrix(q), transpose(matrix(q))), mat3::identity()) < 4e-15);
        CHECK(norm(rotate_back(q, rotate(q, a)) - a) < 4e-15);
        CHECK(dot(rotate(q, a), rotate(q, b)) == Approx(dot(a, b)).margin(1e-14));
        CHECK(norm(cross(rotate(q, a), rotate(q, b)) - rotate(q, cross(a, b))) < 2e-14); // right-handed
        const quaternion one = q * conjugate(q);
        CHECK(std::abs(one.w - 1.0) + std::abs(one.x) + std::abs(one.y) + std::abs(one.z) < 1e-15);
        const quaternion longer{3 * q.w, 3 * q.x, 3 * q.y, 3 * q.z}, u = unit(longer);
        CHECK(std::abs(u.w * u.w + u.x * u.x + u.y * u.y + u.z * u.z - 1.0) < 1e-15);
        CHECK(u.w * q.w > -1e-16);
    }
}

TEST_CASE("the quaternion of a rotation matrix turns as the matrix does, for every axis and angle up to a half turn") {
    for (const vec3& axis :
         {vec3{1, 0, 0}, vec3{0, 1, 0}, vec3{0, 0, 1}, unit(vec3{1, -2, 3}), unit(vec3{-1, 1e-9, 1})})
        for (const double angle : {0.0, 1e-9, 0.3, 1.6, 3.0, 3.14159265358979}) {
            const mat3 m = matrix(rotation(angle * axis));
            const quaternion q = turning(m);
            const mat3 back = matrix(q);
            double worst = 0.0;
            for (int i = 0; i < 3; ++i) worst = std::max(worst, norm(back.row[i] - m.row[i]));
            CHECK(worst < 1e-15);
            CHECK(q.w >= 0.0);
        }
}
