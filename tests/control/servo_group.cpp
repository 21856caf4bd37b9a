// SPDX-License-Identifier: MIT
#include <clast/control/servo_group.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Dense>

#include <clast/core/random.hpp>

#include <catch.hpp>

using namespace clast;

TEST_CASE("a group of servos agrees with a dense solution of its stiffness matrix") {
    random_stream random{7, 0};
    for (std::size_t n : {2u, 5u, 12u, 30u}) {
        // every coupling comes from a shared pebble: k (d d^T) with d along two or three walls, as push-out makes them
        Eigen::MatrixXd k = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
        Eigen::VectorXd e(static_cast<Eigen::Index>(n));
        control::servo_group group;
        group.reset(n);
        for (std::size_t i = 0; i < n; ++i) {
            const auto r = static_cast<Eigen::Index>(i);
            k(r, r) += 2e6 * (0.1 + uniform01(random));
            e(r) = 100.0 * (uniform01(random) - 0.5);
        }
        struct link {
            std::size_t a, b;
            double k;
        };
        std::vector<link> links;
        for (std::size_t i = 0; i + 1 < n; ++i) {
            const double shared = 2e6 * std::pow(10.0, 2.0 * uniform01(random)), c = 0.5 + 0.45 * uniform01(random);
            const auto a = static_cast<Eigen::Index>(i), b = a + 1;
            k(a, a) += shared, k(b, b) += shared;
            k(a, b) -= c * shared, k(b, a) -= c * shared;
            links.push_back({i, i + 1, -c * shared});
        }
        for (std::size_t i = 0; i < n; ++i)
            group.set(i, e(static_cast<Eigen::Index>(i)),
                      k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)));
        for (const link& l : links) group.couple(l.a, l.b, l.k);
        group.solve();
        const Eigen::VectorXd x = k.ldlt().solve(e);
        for (std::size_t i = 0; i < n; ++i)
            CHECK(group.displacement(i) ==
                  Approx(x(static_cast<Eigen::Index>(i))).margin(1e-5 * x.lpNorm<Eigen::Infinity>()));
    }
}

TEST_CASE("two walls that share a stiff pebble move together under a common load, slowly under opposite ones") {
    // own stiffness 1, shared pebble 1000: K = [[1001, -1000], [-1000, 1001]]
    control::servo_group group;
    group.reset(2);
    group.set(0, 1.0, 1001.0), group.set(1, 1.0, 1001.0);
    group.couple(0, 1, -1000.0);
    group.solve();
    CHECK(group.displacement(0) == Approx(1.0).epsilon(1e-6));
    CHECK(group.displacement(1) == Approx(1.0).epsilon(1e-6));
    group.reset(2);
    group.set(0, 1.0, 1001.0), group.set(1, -1.0, 1001.0);
    group.couple(1, 0, -1000.0);
    group.solve();
    CHECK(group.displacement(0) == Approx(1.0 / 2001.0).epsilon(1e-6));
    CHECK(group.displacement(1) == Approx(-1.0 / 2001.0).epsilon(1e-6));
}

TEST_CASE("walls alone take their own step, walls that were not set none, and a wall's own facets add up twice") {
    control::servo_group group;
    group.reset(4);
    group.set(0, 6.0, 3.0);
    group.set(2, -4.0, 8.0);
    group.couple(0, 1, -1.0); // wall 1 has no contact of its own: nothing to couple
    group.solve();
    CHECK(group.displacement(0) == 2.0);
    CHECK(group.displacement(1) == 0.0);
    CHECK(group.displacement(2) == -0.5);
    CHECK(group.displacement(3) == 0.0);
    group.reset(1); // one wall, two facets of it share a pebble: the rigid wall feels k, not the parts
    group.set(0, 1.0, 10.0);
    group.couple(0, 0, -3.0);
    group.solve();
    CHECK(group.displacement(0) == Approx(0.25).epsilon(1e-12));
}

TEST_CASE("walls that do not hang together do not see each other") {
    struct link {
        std::size_t a, b;
        double stiffness;
    };
    const std::vector<link> links{{9, 0, -4e6}, {2, 7, -3e5}, {0, 5, -7e6}, {5, 9, -1e6}, {3, 4, -2e6}};
    const std::vector<std::vector<std::size_t>> blocks{{0, 5, 9}, {2, 7}, {1}, {6}, {8}}; // 3 is not set, so 4 is alone
    const auto missing = [](std::size_t wall) { return 10.0 - 3.0 * static_cast<double>(wall); };
    const auto stiffness = [](std::size_t wall) { return 1.3e7 + 1e5 * static_cast<double>(wall); };
    control::servo_group all;
    all.reset(10);
    for (std::size_t i = 0; i < 10; ++i)
        if (i != 3) all.set(i, missing(i), stiffness(i));
    for (const link& l : links) all.couple(l.a, l.b, l.stiffness);
    all.solve();
    CHECK(all.displacement(3) == 0.0);
    CHECK(all.displacement(4) == missing(4) / stiffness(4));
    for (const std::vector<std::size_t>& block : blocks) {
        control::servo_group one;
        one.reset(10);
        for (const std::size_t i : block) one.set(i, missing(i), stiffness(i));
        for (const link& l : links) one.couple(l.a, l.b, l.stiffness);
        one.solve();
        for (const std::size_t i : block) CHECK(all.displacement(i) == one.displacement(i)); // to the last bit
    }
    // and rows of the first block hold: K x = e
    const auto force = [&](std::size_t wall) {
        double sum = stiffness(wall) * all.displacement(wall);
        for (const link& l : links)
            if (l.a == wall || l.b == wall) sum += l.stiffness * all.displacement(l.a == wall ? l.b : l.a);
        return sum;
    };
    for (const std::size_t wall : {0u, 5u, 9u, 2u, 7u}) CHECK(force(wall) == Approx(missing(wall)).margin(1e-5));
}
