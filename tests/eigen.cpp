// SPDX-License-Identifier: MIT
#include <clast/eigen.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <clast/clast.hpp>
#include <clast/core/random.hpp>
#include <clast/core/symmetric.hpp>

#include <Eigen/Eigenvalues>
#include <catch.hpp>

using namespace clast;

namespace {

vec3 any(random_stream& random) { return {uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2)}; }
mat3 any_matrix(random_stream& random) { return {{any(random), any(random), any(random)}}; }

// largest difference of two results of either library
double difference(const vec3& a, const Eigen::Vector3d& b) { return (to_eigen(a) - b).lpNorm<Eigen::Infinity>(); }
double difference(const mat3& a, const Eigen::Matrix3d& b) { return (to_eigen(a) - b).lpNorm<Eigen::Infinity>(); }

// clumps with their pebbles, anywhere and moving
bodies::clumps some_clumps(int n) {
    random_stream random{5, 6};
    bodies::clumps s;
    s.shapes = {shapes::tetrahedron_4(circumscribed(0.02))};
    for (int i = 0; i < n; ++i) s.add(0, any(random), orientation(random));
    for (body_motion& m : s.motion) m.v = any(random), m.w = any(random);
    return s;
}

template <class Table>
concept has_rows = requires(Table&& table) {
    rows_of(std::forward<Table>(table), &body_motion::x);
};
template <class T>
concept can_be_mapped = requires(T&& value) {
    map(std::forward<T>(value));
};

} // namespace

TEST_CASE("Eigen computes with vectors and matrices as clast does") {
    random_stream random{1, 2};
    for (int i = 0; i < 100; ++i) {
        const vec3 a = any(random), b = any(random);
        const mat3 m = any_matrix(random);
        const Eigen::Vector3d u = to_eigen(a), v = to_eigen(b);
        CHECK(u.dot(v) == Approx(dot(a, b)).margin(1e-14));
        CHECK(u.norm() == Approx(norm(a)).epsilon(1e-15));
        CHECK(difference(cross(a, b), u.cross(v)) < 1e-14);
        CHECK(difference(m * a, to_eigen(m) * u) < 1e-14);
        CHECK(difference(outer(a, b), u * v.transpose()) < 1e-14);
        CHECK(difference(transpose(m), to_eigen(m).transpose()) == 0.0);
        CHECK(difference(solve(m, a), to_eigen(m).inverse() * u) < 1e-10 * norm(solve(m, a)));
    }
}

TEST_CASE("numbers come back from Eigen: columns, rows, expressions, either order of storage") {
    const vec3 a{1, 2, 3};
    const mat3 m{{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}};
    CHECK(from_eigen(to_eigen(a)) == a);
    CHECK(from_eigen(to_eigen(a).transpose()) == a);
    CHECK(from_eigen(2.0 * to_eigen(a)) == 2.0 * a);
    CHECK(from_eigen(to_eigen(m) * to_eigen(a)) == m * a);
    CHECK(from_eigen(to_eigen(m).row(1)) == m.row[1]);
    CHECK(from_eigen(to_eigen(m).col(1)) == vec3{2, 5, 8});
    const mat3 by_columns = from_eigen(to_eigen(m)), by_rows = from_eigen(map(m)),
               product = from_eigen(to_eigen(a) * to_eigen(a).transpose());
    for (int i = 0; i < 3; ++i) {
        CHECK(by_columns.row[i] == m.row[i]);
        CHECK(by_rows.row[i] == m.row[i]);
        CHECK(product.row[i] == outer(a, a).row[i]);
    }
}

TEST_CASE("quaternions turn vectors in Eigen as in clast, whose w comes first") {
    CHECK(to_eigen(quaternion{1, 2, 3, 4}).coeffs() == Eigen::Vector4d(2, 3, 4, 1));
    CHECK(from_eigen(Eigen::Quaterniond(1, 2, 3, 4)) == quaternion{1, 2, 3, 4});
    random_stream random{3, 4};
    for (int i = 0; i < 100; ++i) {
        const quaternion q = orientation(random), p = orientation(random);
        const vec3 a = any(random), angle = any(random);
        CHECK(difference(rotate(q, a), to_eigen(q) * to_eigen(a)) < 1e-14);
        CHECK(difference(matrix(q), to_eigen(q).toRotationMatrix()) < 1e-14);
        CHECK((to_eigen(q * p).coeffs() - (to_eigen(q) * to_eigen(p)).coeffs()).norm() < 1e-14);
        const Eigen::AngleAxisd turn(norm(angle), to_eigen(unit(angle)));
        CHECK(difference(matrix(rotation(angle)), turn.toRotationMatrix()) < 1e-14);
        CHECK(to_eigen(turning(matrix(q))).angularDistance(to_eigen(q)) < 1e-7);
    }
}

TEST_CASE("a map of a vector or a matrix is the thing itself") {
    vec3 a{1, 2, 3};
    map(a)(1) = 5.0;
    CHECK(a == vec3{1, 5, 3});
    map(a) += Eigen::Vector3d::Ones();
    CHECK(a == vec3{2, 6, 4});
    mat3 m = mat3::identity();
    map(m)(0, 2) = 7.0;
    CHECK(m.row[0] == vec3{1, 0, 7});
    map(m).row(2) = map(a).transpose();
    CHECK(m.row[2] == a);
    CHECK(from_eigen(map(std::as_const(m)) * map(std::as_const(a))) == m * a);
    STATIC_REQUIRE(std::is_same_v<decltype(map(std::as_const(a))), Eigen::Map<const Eigen::Vector3d>>);
    STATIC_REQUIRE(can_be_mapped<mat3&>);
    STATIC_REQUIRE(!can_be_mapped<vec3>);
    STATIC_REQUIRE(!can_be_mapped<mat3>);
}

TEST_CASE("the rows of a table are the vectors of its records") {
    const bodies::clumps clumps = some_clumps(20);
    const auto centres = rows_of(clumps.pebbles, &clump_pebble::x);
    REQUIRE(centres.rows() == 80);
    REQUIRE(centres.cols() == 3);
    CHECK(centres.data() == &clumps.pebbles[0].x.x); // no copy
    for (std::size_t i = 0; i < clumps.pebbles.size(); ++i)
        CHECK(from_eigen(centres.row(static_cast<Eigen::Index>(i))) == clumps.pebbles[i].x);
    const auto velocities = rows_of(clumps.motion, &body_motion::v), spins = rows_of(clumps.motion, &body_motion::w);
    REQUIRE(velocities.rows() == 20);
    for (std::size_t i = 0; i < clumps.motion.size(); ++i) {
        CHECK(from_eigen(velocities.row(static_cast<Eigen::Index>(i))) == clumps.motion[i].v);
        CHECK(from_eigen(spins.row(static_cast<Eigen::Index>(i))) == clumps.motion[i].w);
    }
    vec3 sum;
    mat3 products;
    for (const body_motion& m : clumps.motion) sum += m.v, products += outer(m.v, m.v);
    CHECK(difference(sum, velocities.colwise().sum().transpose()) < 1e-13);
    CHECK(difference(products, velocities.transpose() * velocities) < 1e-13);
}

TEST_CASE("what is written through the rows of a table is in the table, and nothing else is") {
    bodies::spheres spheres;
    random_stream random{7, 8};
    for (int i = 0; i < 10; ++i) spheres.add(any(random), 0.1 + 0.01 * i);
    const std::vector<pebble_motion> before = spheres.pebbles;
    const quaternion q = orientation(random);
    auto x = rows_of(spheres.pebbles, &pebble_motion::x);
    x = (x * to_eigen(q).toRotationMatrix().transpose()).eval();
    rows_of(spheres.pebbles, &pebble_motion::v).rowwise() = Eigen::RowVector3d(1, 2, 3);
    rows_of(std::span(spheres.pebbles).first(4), &pebble_motion::w).col(2).setConstant(9.0);
    for (std::size_t i = 0; i < before.size(); ++i) {
        const pebble_motion& now = spheres.pebbles[i];
        CHECK(norm(now.x - rotate(q, before[i].x)) < 1e-14);
        CHECK(now.v == vec3{1, 2, 3});
        CHECK(now.w == vec3{0, 0, i < 4 ? 9.0 : 0.0});
        CHECK(now.radius == before[i].radius);
        CHECK(now.inverse_mass == before[i].inverse_mass);
        CHECK(now.inverse_inertia == before[i].inverse_inertia);
    }
}

TEST_CASE("an empty table has no rows, one of constants cannot be written, and a temporary one is refused") {
    std::vector<body_motion> none;
    CHECK(rows_of(none, &body_motion::x).rows() == 0);
    CHECK(rows_of(none, &body_motion::x).sum() == 0.0);
    using rows = decltype(rows_of(none, &body_motion::x));
    using constants = decltype(rows_of(std::as_const(none), &body_motion::x));
    STATIC_REQUIRE(std::is_same_v<rows::PointerType, double*>);
    STATIC_REQUIRE(std::is_same_v<constants::PointerType, const double*>);
    STATIC_REQUIRE(has_rows<std::span<const body_motion>>); // the map outlives the span, not the table
    STATIC_REQUIRE(!has_rows<std::vector<body_motion>>);
}

TEST_CASE("principal values of a tensor are those that Eigen finds") {
    random_stream random{9, 10};
    for (int i = 0; i < 100; ++i) {
        const mat3 any = any_matrix(random), m = 0.5 * (any + transpose(any));
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> found(to_eigen(m));
        CHECK(largest_principal(m) == Approx(found.eigenvalues()(2)).margin(1e-7));
        square_matrix s(3);
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c) s(r, c) = m(static_cast<int>(r), static_cast<int>(c));
        const principal_system ours = principal_values(s);
        for (int k = 0; k < 3; ++k) {
            CHECK(ours.values[static_cast<std::size_t>(k)] == Approx(found.eigenvalues()(k)).margin(1e-14));
            const vec3 axis = from_eigen(found.eigenvectors().col(k));
            CHECK(norm(m * axis - found.eigenvalues()(k) * axis) < 1e-14);
        }
    }
}
