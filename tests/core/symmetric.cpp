// SPDX-License-Identifier: MIT
#include <clast/core/symmetric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <clast/core/random.hpp>

#include <Eigen/Eigenvalues>
#include <catch.hpp>

using namespace clast;

namespace {
mat3 turned_diagonal(const vec3& value, const vec3& angle) {
    const mat3 axes = transpose(matrix(rotation(angle)));
    mat3 m;
    for (int k = 0; k < 3; ++k) m += value[k] * outer(axes.row[k], axes.row[k]);
    return m;
}
} // namespace

TEST_CASE("the largest principal value of a tensor with known principal values") {
    random_stream random{1, 2};
    for (int i = 0; i < 1000; ++i) {
        const vec3 value{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
        const mat3 m = turned_diagonal(value, 3.0 * direction(random));
        CHECK(largest_principal(m) == Approx(std::max({value.x, value.y, value.z})).margin(3e-8));
    }
    CHECK(largest_principal(turned_diagonal({2, 2, 1}, {0.1, 0.2, 0.3})) == Approx(2.0).epsilon(3e-8));
    CHECK(largest_principal(turned_diagonal({2, 1, 1}, {0.1, 0.2, 0.3})) == Approx(2.0).epsilon(1e-14));
    CHECK(largest_principal(3.0 * mat3::identity()) == 3.0);
    CHECK(largest_principal(mat3{}) == 0.0);
}

TEST_CASE("invariants: mean, and half the square and the determinant of the deviator, of the symmetric part") {
    const mat3 m{{{5, 1, 0}, {3, -1, 4}, {2, 0, 2}}}; // symmetric part: xy 2, xz 1, yz 2
    const symmetric_invariants i = invariants(m);
    CHECK(i.mean == 2.0);
    // deviator diag (3, -3, 0): j2 = (9 + 9 + 0) / 2 + 4 + 1 + 4
    CHECK(i.j2 == Approx(18.0).epsilon(1e-15));
    // det [[3,2,1],[2,-3,2],[1,2,0]] = 3(0 - 4) - 2(0 - 2) + 1(4 + 3)
    CHECK(i.j3 == Approx(-1.0).epsilon(1e-15));
}

TEST_CASE("principal values and axes of symmetric matrices are those that Eigen finds") {
    random_stream random{3, 4};
    for (const std::size_t n : {1U, 2U, 3U, 24U, 84U}) {
        square_matrix m(n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i; j < n; ++j) m(i, j) = m(j, i) = uniform(random, -1, 1) * (i == j ? 1e3 : 1.0);
        if (n == 24) // two equal values and a zero one
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j) m(i, j) = i == j && i > 0 ? 1.0 + static_cast<double>(i / 2) : 0.0;
        const principal_system found = principal_values(m);
        const auto size = static_cast<Eigen::Index>(n);
        const Eigen::MatrixXd as_eigen = Eigen::Map<const Eigen::MatrixXd>(m.data(), size, size);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(as_eigen);
        double worst = 0.0, off = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            worst = std::max(worst, std::abs(found.values[k] - solver.eigenvalues()(static_cast<Eigen::Index>(k))));
            std::vector<double> axis(n);
            for (std::size_t i = 0; i < n; ++i) axis[i] = found.axes(i, k);
            const std::vector<double> image = m * axis;
            for (std::size_t i = 0; i < n; ++i) off = std::max(off, std::abs(image[i] - found.values[k] * axis[i]));
            double length = 0.0;
            for (double x : axis) length += x * x;
            worst = std::max(worst, std::abs(length - 1.0));
        }
        CHECK(worst < 1e-10); // of values up to 1e3
        CHECK(off < 1e-10);
    }
}

TEST_CASE("three equations with three unknowns") {
    const mat3 a{{{4, 1, -2}, {1, 3, 0.5}, {-2, 0.5, 5}}};
    const vec3 u{1.5, -2.0, 0.25};
    CHECK(norm(solve(a, a * u) - u) < 1e-15);
}
