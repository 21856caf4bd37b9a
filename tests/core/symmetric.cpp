// SPDX-License-Identifier: MIT
#include <clast/core/symmetric.hpp>

#include <algorithm>
#include <cmath>

#include <clast/core/random.hpp>

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
