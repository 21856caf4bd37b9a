// SPDX-License-Identifier: MIT
// Small fixed-size linear algebra of the kernels: vec3, mat3 and unit quaternions as plain structs.
//
// Plain structs rather than Eigen types, because they sit in public state that is copied, stored and written to
// checkpoints byte by byte: no hidden alignment, trivially copyable, and GCC and Clang vectorise loops over them.
// clast/eigen.hpp shows them to Eigen.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace clast {

/// Cartesian vector; unit depends on what it holds (m, m/s, N, ...).
struct vec3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    constexpr double& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
    constexpr double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
    constexpr vec3& operator+=(const vec3& b) { return x += b.x, y += b.y, z += b.z, *this; }
    constexpr vec3& operator-=(const vec3& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
    constexpr vec3& operator*=(double s) { return x *= s, y *= s, z *= s, *this; }
    constexpr bool operator==(const vec3&) const = default;
};

constexpr vec3 operator+(const vec3& a, const vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr vec3 operator-(const vec3& a, const vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr vec3 operator-(const vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr vec3 operator*(double s, const vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr vec3 operator*(const vec3& a, double s) { return s * a; }
constexpr vec3 operator/(const vec3& a, double s) { return (1.0 / s) * a; }
constexpr double dot(const vec3& a, const vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr vec3 cross(const vec3& a, const vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double norm2(const vec3& a) { return dot(a, a); }
inline double norm(const vec3& a) { return std::sqrt(norm2(a)); }
/// Componentwise product, for diagonal tensors in a principal frame.
constexpr vec3 scale(const vec3& a, const vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
/// The part of a that is normal to the unit vector n.
constexpr vec3 reject(const vec3& a, const vec3& n) { return a - dot(a, n) * n; }
/// Unit vector along a; a itself where it is zero.
inline vec3 unit(const vec3& a) {
    const double length = norm(a);
    return length > 0.0 ? a / length : a;
}
inline bool is_finite(const vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// 3 x 3 matrix by rows.
struct mat3 {
    vec3 row[3] = {};

    static constexpr mat3 identity() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }
    constexpr double operator()(int i, int j) const { return row[i][j]; }
    constexpr double& operator()(int i, int j) { return row[i][j]; }
    constexpr mat3& operator+=(const mat3& b) {
        for (int i = 0; i < 3; ++i) row[i] += b.row[i];
        return *this;
    }
};

constexpr vec3 operator*(const mat3& m, const vec3& a) {
    return {dot(m.row[0], a), dot(m.row[1], a), dot(m.row[2], a)};
}
constexpr mat3 operator*(double s, const mat3& m) { return {{s * m.row[0], s * m.row[1], s * m.row[2]}}; }
constexpr mat3 operator+(mat3 a, const mat3& b) { return a += b; }
constexpr mat3 outer(const vec3& a, const vec3& b) { return {{a.x * b, a.y * b, a.z * b}}; }
constexpr mat3 transpose(const mat3& m) {
    return {{{m(0, 0), m(1, 0), m(2, 0)}, {m(0, 1), m(1, 1), m(2, 1)}, {m(0, 2), m(1, 2), m(2, 2)}}};
}
constexpr double trace(const mat3& m) { return m(0, 0) + m(1, 1) + m(2, 2); }

/// Unit quaternion (w, x, y, z) that turns body axes into world axes.
struct quaternion {
    double w = 1.0;
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    constexpr bool operator==(const quaternion&) const = default;
};

constexpr quaternion operator*(const quaternion& a, const quaternion& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
constexpr quaternion conjugate(const quaternion& q) { return {q.w, -q.x, -q.y, -q.z}; }
inline quaternion unit(const quaternion& q) {
    const double s = 1.0 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {s * q.w, s * q.x, s * q.y, s * q.z};
}
/// Rotation matrix of q: world = matrix(q) * body.
constexpr mat3 matrix(const quaternion& q) {
    return {{{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.w * q.z), 2 * (q.x * q.z + q.w * q.y)},
             {2 * (q.x * q.y + q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z - q.w * q.x)},
             {2 * (q.x * q.z - q.w * q.y), 2 * (q.y * q.z + q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)}}};
}
/// Unit quaternion of a rotation matrix (orthonormal, right-handed), w >= 0. Shepperd 1978: from the largest component.
inline quaternion turning(const mat3& m) {
    const double t = trace(m);
    quaternion q;
    if (t >= m(0, 0) && t >= m(1, 1) && t >= m(2, 2))
        q = {1.0 + t, m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
    else if (m(0, 0) >= m(1, 1) && m(0, 0) >= m(2, 2))
        q = {m(2, 1) - m(1, 2), 1.0 + 2.0 * m(0, 0) - t, m(0, 1) + m(1, 0), m(0, 2) + m(2, 0)};
    else if (m(1, 1) >= m(2, 2))
        q = {m(0, 2) - m(2, 0), m(0, 1) + m(1, 0), 1.0 + 2.0 * m(1, 1) - t, m(1, 2) + m(2, 1)};
    else
        q = {m(1, 0) - m(0, 1), m(0, 2) + m(2, 0), m(1, 2) + m(2, 1), 1.0 + 2.0 * m(2, 2) - t};
    q = unit(q);
    return q.w < 0.0 ? quaternion{-q.w, -q.x, -q.y, -q.z} : q;
}
/// World components of a vector given in the body frame.
constexpr vec3 rotate(const quaternion& q, const vec3& a) {
    const vec3 u{q.x, q.y, q.z};
    const vec3 t = 2.0 * cross(u, a);
    return a + q.w * t + cross(u, t);
}
/// Body components of a vector given in the world frame.
constexpr vec3 rotate_back(const quaternion& q, const vec3& a) { return rotate(conjugate(q), a); }
/// Rotation by the vector `angle` (rad, axis times angle): exact for any size.
inline quaternion rotation(const vec3& angle) {
    const double half = 0.5 * norm(angle);
    // sin(h)/h by its series near zero, where the quotient would lose digits
    const double s = half < 1e-4 ? 0.5 * (1.0 - half * half / 6.0) : 0.5 * std::sin(half) / half;
    return {std::cos(half), s * angle.x, s * angle.y, s * angle.z};
}

static_assert(std::is_trivially_copyable_v<vec3> && sizeof(vec3) == 24);
static_assert(std::is_trivially_copyable_v<quaternion> && sizeof(quaternion) == 32);

} // namespace clast
