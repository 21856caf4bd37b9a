// SPDX-License-Identifier: MIT
#include <clast/integrators/time_step.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include <clast/core/random.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

struct body {
    double mass = 1.0;
    vec3 inertia{1, 1, 1}; ///< principal moments
    quaternion q;
};

struct joint {
    int a = 0;
    int b = -1; ///< -1: a fixed wall
    vec3 normal;
    vec3 arm_a;
    vec3 arm_b;
    double kn = 1.0;
    double ks = 0.0;
};

struct network {
    std::vector<body> bodies;
    std::vector<joint> joints;
};

/// Exact limit 2 / omega_max of undamped leapfrog, from all eigenvalues of the network. Written without the code under
/// test: stiffness from the relative displacement at the contact point, mode by mode.
double exact_limit(const network& net) {
    const auto n = static_cast<Eigen::Index>(6 * net.bodies.size());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
    for (const joint& c : net.joints) {
        // rows: relative displacement of a against b per degree of freedom (3 world translations, 3 body rotations)
        Eigen::MatrixXd d = Eigen::MatrixXd::Zero(3, n);
        const auto fill = [&](int which, const vec3& arm, double sign) {
            if (which < 0) return;
            const body& one = net.bodies[static_cast<std::size_t>(which)];
            for (int i = 0; i < 3; ++i) {
                vec3 axis{};
                axis[i] = 1.0;
                const vec3 turn = cross(rotate(one.q, axis), arm);
                d(i, 6 * which + i) += sign / std::sqrt(one.mass);
                for (int j = 0; j < 3; ++j) d(j, 6 * which + 3 + i) += sign * turn[j] / std::sqrt(one.inertia[i]);
            }
        };
        fill(c.a, c.arm_a, 1.0);
        fill(c.b, c.arm_b, -1.0);
        const Eigen::Vector3d normal(c.normal.x, c.normal.y, c.normal.z);
        const Eigen::Matrix3d stiffness =
            c.ks * Eigen::Matrix3d::Identity() + (c.kn - c.ks) * normal * normal.transpose();
        k += d.transpose() * stiffness * d;
    }
    return 2.0 /
           std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues()[n - 1]);
}

struct estimates {
    double usual = std::numeric_limits<double>::infinity(); ///< safety 1
    double proven = std::numeric_limits<double>::infinity();
};

estimates estimate(const network& net) {
    estimates e;
    for (std::size_t i = 0; i < net.bodies.size(); ++i) {
        const body& one = net.bodies[i];
        stiffness_sum sum(matrix(one.q));
        for (const joint& c : net.joints) {
            if (c.a == static_cast<int>(i)) sum.add(c.normal, c.kn, c.ks, c.arm_a);
            if (c.b == static_cast<int>(i)) sum.add(-c.normal, c.kn, c.ks, c.arm_b);
        }
        e.usual = std::min(e.usual, sum.time_step(one.mass, one.inertia, 1.0));
        e.proven = std::min(e.proven, sum.critical_step(one.mass, one.inertia));
    }
    return e;
}

/// Periodic lattice of solid balls of radius 1/2 with contacts along `half` (and opposite to it).
network lattice(int cells, const std::vector<vec3>& base, const std::vector<vec3>& half, double edge, double ks) {
    network net;
    std::vector<vec3> at;
    const double size = cells * edge;
    for (int x = 0; x < cells; ++x)
        for (int y = 0; y < cells; ++y)
            for (int z = 0; z < cells; ++z)
                for (const vec3& b : base) at.push_back(edge * (vec3{double(x), double(y), double(z)} + b));
    const auto wrap = [size](double d) { return d - size * std::round(d / size); };
    net.bodies.assign(at.size(), {1.0, {0.1, 0.1, 0.1}, {}}); // (2/5) m r^2
    for (std::size_t i = 0; i < at.size(); ++i)
        for (const vec3& d : half)
            for (std::size_t j = 0; j < at.size(); ++j) {
                const vec3 e = at[j] - at[i] - d;
                if (std::abs(wrap(e.x)) + std::abs(wrap(e.y)) + std::abs(wrap(e.z)) < 1e-9)
                    net.joints.push_back({int(i), int(j), d, 0.5 * d, -0.5 * d, 1.0, ks});
            }
    return net;
}
network simple_cubic(double ks) { return lattice(4, {{0, 0, 0}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0, ks); }
network face_centred(double ks) {
    const double h = std::sqrt(0.5);
    return lattice(2, {{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}},
                   {{0, h, h}, {0, h, -h}, {h, 0, h}, {h, 0, -h}, {h, h, 0}, {h, -h, 0}}, std::sqrt(2.0), ks);
}

/// Largest displacement of a periodic chain of unit masses and springs after the steps, by leapfrog from noise of 1e-9.
double chain_after(int masses, double dt, int steps) {
    const auto n = static_cast<std::size_t>(masses);
    std::vector<double> x(n), v(n, 0.0), f(n);
    random_stream random{4, 4};
    for (double& one : x) one = uniform(random, -1e-9, 1e-9);
    double worst = 0.0;
    for (int s = 0; s < steps && worst < 1.0; ++s) {
        for (std::size_t i = 0; i < n; ++i) f[i] = x[(i + 1) % n] - 2.0 * x[i] + x[(i + n - 1) % n];
        for (std::size_t i = 0; i < n; ++i) v[i] += dt * f[i], x[i] += dt * v[i];
        for (const double one : x) worst = std::max(worst, std::abs(one));
    }
    return worst;
}

} // namespace

TEST_CASE("a ball on a wall and a free pair: estimate and true limit, in any direction") {
    for (const vec3& n : {vec3{1, 0, 0}, unit(vec3{1, 1, 1}), unit(vec3{-0.2, 3, 1})}) {
        const body ball{2.0, {0.1, 0.1, 0.1}, {}};
        const double unit_step = std::sqrt(2.0 / 8.0); // sqrt(m/k)
        const network wall{{ball}, {{0, -1, n, 0.5 * n, {}, 8.0, 0.0}}};
        CHECK(exact_limit(wall) == Approx(2.0 * unit_step).epsilon(1e-12));
        CHECK(estimate(wall).usual == Approx(unit_step).epsilon(1e-12));
        const network pair{{ball, ball}, {{0, 1, n, 0.5 * n, -0.5 * n, 8.0, 0.0}}};
        CHECK(exact_limit(pair) == Approx(std::sqrt(2.0) * unit_step).epsilon(1e-12));
        CHECK(estimate(pair).usual == Approx(unit_step).epsilon(1e-12));
        CHECK(estimate(pair).proven == Approx(exact_limit(pair)).epsilon(1e-12)); // the bound is sharp here
    }
}

TEST_CASE("a long chain: the estimate is 1/sqrt 2 of the true limit") {
    network chain;
    chain.bodies.resize(64);
    for (int i = 0; i < 64; ++i) chain.joints.push_back({i, (i + 1) % 64, {1, 0, 0}, {}, {}, 1.0, 0.0});
    CHECK(exact_limit(chain) == Approx(1.0).epsilon(1e-12));
    CHECK(estimate(chain).usual == Approx(std::sqrt(0.5)).epsilon(1e-12));
    CHECK(estimate(chain).proven == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("perfect lattices: exact limits, and the estimate at 1/sqrt 2 of them") {
    CHECK(exact_limit(simple_cubic(0.0)) == Approx(1.0).epsilon(1e-10));
    CHECK(exact_limit(simple_cubic(1.0)) == Approx(std::sqrt(0.2)).epsilon(1e-10));
    CHECK(exact_limit(face_centred(0.0)) == Approx(std::sqrt(0.5)).epsilon(1e-10));
    CHECK(exact_limit(face_centred(1.0)) == Approx(std::sqrt(0.1)).epsilon(1e-10));
    for (const network& net : {simple_cubic(0.0), simple_cubic(1.0), face_centred(0.0), face_centred(1.0)}) {
        const double limit = exact_limit(net);
        CHECK(estimate(net).usual == Approx(limit * std::sqrt(0.5)).epsilon(1e-7));
        CHECK(estimate(net).proven <= limit * (1.0 + 1e-12));
    }
    CHECK(estimate(face_centred(0.0)).usual == Approx(0.5).epsilon(1e-7));
    CHECK(estimate(face_centred(1.0)).usual == Approx(std::sqrt(0.05)).epsilon(1e-7));
    CHECK(estimate(face_centred(0.0)).proven == Approx(std::sqrt(0.5)).epsilon(1e-7)); // sharp without rotation
}

TEST_CASE("no network of clumps is unstable at the proven step, nor at the usual one with safety 1") {
    double tightest = 10.0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        random_stream random{seed, 0};
        network net;
        for (int i = 0; i < 6; ++i)
            net.bodies.push_back({uniform(random, 0.5, 2.0),
                                  {uniform(random, 0.1, 1), uniform(random, 0.1, 1), uniform(random, 0.1, 1)},
                                  orientation(random)});
        for (int c = 0; c < 12; ++c) {
            const int a = static_cast<int>(uniform(random, 0, 6));
            const int b = static_cast<int>(uniform(random, -1, 6)); // truncates towards zero
            if (a == b) continue;
            net.joints.push_back({a, c == 0 ? -1 : b, direction(random), uniform(random, 0, 1) * direction(random),
                                  uniform(random, 0, 1) * direction(random), uniform(random, 0.1, 3),
                                  uniform(random, 0, 3)});
        }
        const double limit = exact_limit(net);
        const estimates e = estimate(net);
        CHECK(e.usual <= e.proven * (1.0 + 1e-12));
        CHECK(e.proven <= limit * (1.0 + 1e-7));
        tightest = std::min(tightest, limit / e.proven);
    }
    CHECK(tightest < 1.3); // the bound is not idle
}

TEST_CASE("the step is scaled by the safety factor, and a body without contacts sets none") {
    stiffness_sum sum;
    CHECK(sum.time_step(1.0, {1, 1, 1}) == std::numeric_limits<double>::infinity());
    CHECK(sum.critical_step(1.0, {1, 1, 1}) == std::numeric_limits<double>::infinity());
    sum.add({0, 0, 1}, 4.0, 0.0, {});
    CHECK(sum.time_step(1.0, {1, 1, 1}) == Approx(0.8 * 0.5).epsilon(1e-14));
    CHECK(sum.time_step(1.0, {1, 1, 1}, 0.5) == Approx(0.25).epsilon(1e-14));
}

TEST_CASE("a body that does not set the step is not asked for more than that") {
    random_stream random{8, 5};
    int cheap = 0, exact = 0;
    for (int trial = 0; trial < 500; ++trial) {
        stiffness_sum sum(matrix(orientation(random)));
        for (int c = 0; c < 5; ++c)
            sum.add(direction(random), uniform(random, 0.0, 3.0), uniform(random, 0.0, 3.0), 0.5 * direction(random));
        const vec3 inertia{uniform(random, 0.1, 1.0), uniform(random, 0.1, 1.0), uniform(random, 0.1, 1.0)};
        const double step = sum.time_step(0.7, inertia);
        const double enough = step * uniform(random, 0.5, 1.5);
        CHECK(sum.time_step(0.7, inertia, 0.8, enough) == std::min(step, enough));
        ++(enough < step ? cheap : exact);
    }
    CHECK(cheap > 100);
    CHECK(exact > 100);
}

TEST_CASE("rotational stiffness: lever arms, twist and bending of bonds, in the axes of the body") {
    stiffness_sum sum;
    sum.add({1, 0, 0}, 5.0, 2.0, {0, 3, 0}); // normal force at the arm 3: about z; shear: about x
    CHECK(sum.rotation()(2, 2) == Approx(45.0).epsilon(1e-15));
    CHECK(sum.rotation()(0, 0) == Approx(18.0).epsilon(1e-15));
    CHECK(sum.rotation()(1, 1) == 0.0);
    CHECK(sum.translation()(0, 0) == 5.0);
    CHECK(sum.translation()(1, 1) == 2.0);
    sum.add_rotation({0, 0, 1}, 7.0, 0.5);
    CHECK(sum.rotation()(2, 2) == Approx(52.0).epsilon(1e-15));
    CHECK(sum.rotation()(0, 0) == Approx(18.5).epsilon(1e-15));
    // small moments about the stiff axis only count if the axes of the body are used: body x along world z
    const quaternion q = rotation(vec3{0, -0.5 * 3.14159265358979323846, 0});
    REQUIRE(norm(rotate(q, {1, 0, 0}) - vec3{0, 0, 1}) < 1e-15);
    stiffness_sum turned_body(matrix(q));
    turned_body.add({1, 0, 0}, 5.0, 0.0, {0, 3, 0});
    CHECK(turned_body.time_step(1e9, {0.45, 100, 100}, 1.0) == Approx(0.1).epsilon(1e-12));
}

TEST_CASE("the step does not change when body and contacts are turned together") {
    const vec3 normal = unit(vec3{1, 2, 2});
    const vec3 arm{0.3, -0.1, 0.2};
    const vec3 inertia{0.02, 0.3, 1.0};
    stiffness_sum straight;
    straight.add(normal, 5.0, 2.0, arm);
    random_stream random{8, 0};
    for (int i = 0; i < 10; ++i) {
        const quaternion q = orientation(random);
        stiffness_sum turned_body(matrix(q));
        turned_body.add(rotate(q, normal), 5.0, 2.0, rotate(q, arm));
        CHECK(turned_body.time_step(1.0, inertia) == Approx(straight.time_step(1.0, inertia)).epsilon(1e-12));
        CHECK(turned_body.critical_step(1.0, inertia) == Approx(straight.critical_step(1.0, inertia)).epsilon(1e-12));
    }
}

TEST_CASE("leapfrog of an elastic pair is stable at 0.99 of its limit and diverges at 1.01") {
    const auto after = [](double dt, int steps) {
        double a = 0.0, b = 1e-9, va = 0.0, vb = 0.0;
        for (int s = 0; s < steps && std::abs(b - a) < 1.0; ++s) {
            const double f = b - a;
            va += dt * f, vb -= dt * f;
            a += dt * va, b += dt * vb;
        }
        return std::abs(b - a);
    };
    CHECK(after(0.99 * std::sqrt(2.0), 1000000) < 2e-8);
    CHECK(after(1.01 * std::sqrt(2.0), 1000) > 1.0);
}

TEST_CASE("leapfrog of a long chain is stable at 0.99 of its limit and diverges at 1.01") {
    CHECK(chain_after(64, 0.99, 200000) < 1e-7);
    CHECK(chain_after(64, 1.01, 1000) > 1.0);
}
