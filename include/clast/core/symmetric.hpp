// SPDX-License-Identifier: MIT
// Invariants and largest principal value of a symmetric 3 x 3 tensor in closed form, and all principal values and axes
// of symmetric matrices of any size.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <clast/core/vector.hpp>

namespace clast {

/// Invariants of the symmetric part of a tensor: its mean, and the second and third invariant of its deviator.
struct symmetric_invariants {
    double mean = 0.0; ///< trace / 3
    double j2 = 0.0;   ///< s_ij s_ij / 2, never negative
    double j3 = 0.0;   ///< det s
};

constexpr symmetric_invariants invariants(const mat3& m) {
    const double mean = trace(m) / 3.0;
    const double xx = m(0, 0) - mean, yy = m(1, 1) - mean, zz = m(2, 2) - mean;
    const double xy = 0.5 * (m(0, 1) + m(1, 0)), xz = 0.5 * (m(0, 2) + m(2, 0)), yz = 0.5 * (m(1, 2) + m(2, 1));
    return {mean, 0.5 * (xx * xx + yy * yy + zz * zz) + xy * xy + xz * xz + yz * yz,
            xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)};
}

/// Largest principal value by the trigonometric solution of the cubic (Smith 1961, Communications of the ACM 4).
/// Relative error 1e-15 to 1e-8, the latter near two equal values.
inline double largest_principal(const symmetric_invariants& i) {
    if (!(i.j2 > 0.0)) return i.mean;
    const double root = std::sqrt(i.j2 / 3.0);
    const double cosine = std::clamp(0.5 * i.j3 / (root * root * root), -1.0, 1.0);
    return i.mean + 2.0 * root * std::cos(std::acos(cosine) / 3.0);
}

/// What it cannot exceed (equal where the two smaller values are equal): cheap, for those who look for a largest one.
inline double largest_principal_bound(const symmetric_invariants& i) {
    return (i.mean + 2.0 * std::sqrt(i.j2 / 3.0)) * (1.0 + 1e-7);
}

/// Largest principal value of the symmetric part of m.
inline double largest_principal(const mat3& m) { return largest_principal(invariants(m)); }

/// Square matrix of any size, by rows.
class square_matrix {
  public:
    square_matrix() = default;
    explicit square_matrix(std::size_t n) : n_(n), entries_(n * n, 0.0) {}

    std::size_t size() const { return n_; }
    double operator()(std::size_t i, std::size_t j) const { return entries_[i * n_ + j]; }
    double& operator()(std::size_t i, std::size_t j) { return entries_[i * n_ + j]; }
    const double* data() const { return entries_.data(); }

  private:
    std::size_t n_ = 0;
    std::vector<double> entries_;
};

/// matrix * vector
inline std::vector<double> operator*(const square_matrix& m, const std::vector<double>& v) {
    std::vector<double> out(m.size(), 0.0);
    for (std::size_t i = 0; i < m.size(); ++i)
        for (std::size_t j = 0; j < m.size(); ++j) out[i] += m(i, j) * v[j];
    return out;
}

/// Principal values, ascending, and unit vectors along their axes: column k of `axes` belongs to value k.
struct principal_system {
    std::vector<double> values;
    square_matrix axes;
};

/// All principal values and axes of a symmetric matrix (the upper triangle is read) by Jacobi's rotations, to rounding:
/// errors of some 1e-16 of the largest value. O(n^3) times a few sweeps: milliseconds for n = 100. Golub and Van Loan,
/// Matrix Computations, section 8.5. Written out rather than taken from Eigen, whose solvers cost every program that
/// includes this 8 s of compile time; the tests compare with Eigen.
inline principal_system principal_values(square_matrix m) {
    const std::size_t n = m.size();
    square_matrix axes(n);
    for (std::size_t i = 0; i < n; ++i) axes(i, i) = 1.0;
    double size = 0.0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            if (j < i) m(i, j) = m(j, i);
            size = std::max(size, std::abs(m(i, j)));
        }
    for (int sweep = 0; sweep < 64; ++sweep) {
        bool done = true;
        for (std::size_t p = 0; p + 1 < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q) {
                const double off = m(p, q);
                if (std::abs(off) <= 1e-18 * size) continue; // nothing left to rounding
                done = false;
                // the smaller angle of rotation that makes m(p, q) zero
                const double tau = (m(q, q) - m(p, p)) / (2.0 * off);
                const double t = (tau >= 0.0 ? 1.0 : -1.0) / (std::abs(tau) + std::sqrt(1.0 + tau * tau));
                const double c = 1.0 / std::sqrt(1.0 + t * t), s = t * c;
                for (std::size_t k = 0; k < n; ++k) {
                    const double a = m(k, p), b = m(k, q);
                    m(k, p) = c * a - s * b, m(k, q) = s * a + c * b;
                }
                for (std::size_t k = 0; k < n; ++k) {
                    const double a = m(p, k), b = m(q, k);
                    m(p, k) = c * a - s * b, m(q, k) = s * a + c * b;
                }
                m(p, q) = m(q, p) = 0.0;
                for (std::size_t k = 0; k < n; ++k) {
                    const double a = axes(k, p), b = axes(k, q);
                    axes(k, p) = c * a - s * b, axes(k, q) = s * a + c * b;
                }
            }
        if (done) break;
    }
    std::vector<std::size_t> order; // by insertion: few values, and std::stable_sort takes long to compile
    for (std::size_t k = 0; k < n; ++k)
        order.insert(std::upper_bound(order.begin(), order.end(), k,
                                      [&](std::size_t a, std::size_t b) { return m(a, a) < m(b, b); }),
                     k);
    principal_system out{std::vector<double>(n), square_matrix(n)};
    for (std::size_t k = 0; k < n; ++k) {
        out.values[k] = m(order[k], order[k]);
        for (std::size_t i = 0; i < n; ++i) out.axes(i, k) = axes(i, order[k]);
    }
    return out;
}

/// Solution of a u = b for a regular 3 x 3 matrix, by Cramer's rule.
inline vec3 solve(const mat3& a, const vec3& b) {
    const vec3 c0 = cross(a.row[1], a.row[2]), c1 = cross(a.row[2], a.row[0]), c2 = cross(a.row[0], a.row[1]);
    return (b.x * c0 + b.y * c1 + b.z * c2) / dot(a.row[0], c0);
}

} // namespace clast
