// SPDX-License-Identifier: MIT
#include <clast/integrators/rotation.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch.hpp>

using namespace clast;

namespace {

/// Difference of two orientations (rad), whatever their signs.
double angle_between(const quaternion& a, const quaternion& b) {
    const quaternion d = a * conjugate(b);
    return 2.0 * std::asin(std::min(1.0, std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
}

double length(const quaternion& q) { return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z); }

struct top {
    vec3 inertia;
    vec3 inverse;
    quaternion q;
    vec3 l; // world

    top(const vec3& moments, const vec3& spin_body)
        : inertia(moments), inverse{1 / moments.x, 1 / moments.y, 1 / moments.z}, l(scale(moments, spin_body)) {}
    turned step(double dt) {
        const turned t = advance_rotation(q, l, inverse, dt);
        q = t.q;
        return t;
    }
    void steps(int n, double dt) {
        for (int i = 0; i < n; ++i) step(dt);
    }
    vec3 spin_body() const { return scale(inverse, rotate_back(q, l)); }
    double energy() const { return rotational_energy(q, l, inverse); }
};

top symmetric_top() { return {{0.25, 0.25, 0.125}, {0, 1, 100}}; }
top flipping_top() { return {{0.30, 0.35, 0.40}, {0.1, 15, 0.1}}; }

/// Exact orientation of the symmetric top: precession about L at |L| / I1, and spin about its own axis at the rest.
quaternion exact_symmetric_top(const top& start, double t) {
    const double own = start.l.z * (start.inverse.z - start.inverse.x);
    return rotation((t * start.inverse.x) * start.l) * rotation(vec3{0, 0, own * t});
}

/// Error of the flipping top at t = 1 s (rad/s); state from a Taylor series with 22 digits.
double flip_error(int steps) {
    top t = flipping_top();
    t.steps(steps, 1.0 / steps);
    return norm(t.spin_body() - vec3{-0.05505541377, 15.00039821765, 0.06908924619});
}

} // namespace

TEST_CASE("a torque-free symmetric top precesses exactly: phase error far below published schemes") {
    for (const double dt : {1e-3, 1e-4, 1e-5}) {
        top t = symmetric_top();
        const quaternion exact = exact_symmetric_top(t, 0.5);
        t.steps(static_cast<int>(std::lround(0.5 / dt)), dt);
        const vec3 w = t.spin_body();
        // published schemes are off by 1e-2 rad after these 25 rad at dt = 1e-3 (|w| dt = 0.1)
        CHECK(w.x == Approx(std::sin(25.0)).epsilon(1e-8));
        CHECK(w.y == Approx(std::cos(25.0)).epsilon(1e-8));
        CHECK(w.z == Approx(100.0).epsilon(1e-12));
        CHECK(std::hypot(w.x, w.y) == Approx(1.0).epsilon(1e-11));
        CHECK(angle_between(t.q, exact) < 2e-7);
    }
}

TEST_CASE("the orientation of a free body converges with order 4") {
    const auto error = [](int steps) {
        top t = flipping_top();
        t.steps(steps, 1.0 / steps);
        return angle_between(t.q, unit(quaternion{0.34633167574, 0.00161244555, 0.93809991190, 0.00450840324}));
    };
    CHECK(std::log2(error(16) / error(32)) == Approx(4.0).margin(0.15));
    CHECK(std::log2(error(32) / error(64)) == Approx(4.0).margin(0.15));
    CHECK(std::log2(flip_error(32) / flip_error(64)) == Approx(4.0).margin(0.15));
    CHECK(error(1024) < 2e-8); // digits of the reference
    CHECK(flip_error(1024) < 2e-8);
}

TEST_CASE("a body spun about its middle axis flips with the exact period") {
    top t = flipping_top();
    const double period = 12.3349458093; // 4K
    CHECK(norm(t.l) == Approx(5.25023808984).epsilon(1e-11));
    CHECK(t.energy() == Approx(39.3785).epsilon(1e-12));
    const int steps = 20000; // per period, |w| dt = 0.009
    t.steps(steps / 2, period / steps);
    CHECK(t.spin_body().y == Approx(-15.0).epsilon(1e-8)); // flipped after half a period
    t.steps(steps / 2, period / steps);
    // the body velocity is periodic (the orientation is not)
    CHECK(norm(t.spin_body() - vec3{0.1, 15, 0.1}) < 1e-6);
}

TEST_CASE("energy of a free body does not drift, only oscillates, and the quaternion stays unit") {
    for (const double angle : {1e-5, 5e-3, 0.05, 0.5}) {
        top t({1.0 / 3.0, 1.0 / 1.2, 1.0 / 1.5}, {0.9, 0.24, 0.6});
        const double dt = angle / 1.2;
        const double start = t.energy();
        double first = 0.0;
        double last = 0.0;
        double stretch = 0.0;
        const int steps = angle == 1e-5 ? 1000000 : 40000;
        for (int i = 0; i < steps; ++i) {
            t.step(dt);
            double& worst = i < steps / 2 ? first : last;
            worst = std::max(worst, std::abs(t.energy() / start - 1.0));
            stretch = std::max(stretch, std::abs(length(t.q) - 1.0));
        }
        CHECK(last <= 1.5 * first + 1e-12); // random walk of rounding
        CHECK(first < 1e-4 * std::pow(angle, 4) + 1e-12);
        CHECK(stretch < 1e-15);
    }
}

TEST_CASE("the free motion runs back to where it came from") {
    for (const double angle : {1e-5, 1e-3, 9e-3, 0.05, 0.5}) {
        top t({1.0 / 3.0, 1.0 / 1.2, 1.0 / 1.5}, {0.9, 0.24, 0.6});
        const double dt = angle / 1.2;
        t.steps(20000, dt);
        t.steps(20000, -dt);
        CHECK(angle_between(t.q, {}) < (angle < 0.01 ? 1e-11 : 1e-9));
    }
}

TEST_CASE("a step turns by the returned spin times dt, along every branch") {
    for (const double angle : {1e-7, 9e-5, 2e-4, 9e-3, 2e-2, 0.5}) {
        for (const vec3& moments : {vec3{0.30, 0.35, 0.40}, vec3{0.3, 0.3, 0.3}}) {
            top t(moments, {0.3, 0.8, -0.5});
            t.q = rotation(vec3{0.4, -0.2, 1.1});
            const quaternion before = t.q;
            const vec3 spin = spin_of(t.q, t.l, t.inverse);
            const double dt = angle / norm(spin);
            const turned step = advance_rotation(before, t.l, t.inverse, dt);
            CHECK(angle_between(rotation(dt * step.spin) * before, step.q) < 1e-15 + 1e-15 * angle);
            // spin is that of the middle of the step
            const turned half = advance_rotation(before, t.l, t.inverse, 0.5 * dt);
            CHECK(norm(step.spin - spin_of(half.q, t.l, t.inverse)) < 0.05 * angle * angle * norm(spin) + 1e-15);
        }
    }
}

TEST_CASE("neighbouring branches of the step size give the same motion") {
    // bounds at 1e-4, 1e-2 and 0.1 rad of the largest inverse moment times |L| times dt
    for (const double bound : {1e-4, 1e-2, 0.1}) {
        top t({0.30, 0.35, 0.40}, {0.3, 0.8, -0.5});
        const double dt = bound / (norm(t.l) / 0.30);
        const turned below = advance_rotation(t.q, t.l, t.inverse, dt * (1 - 1e-12));
        const turned above = advance_rotation(t.q, t.l, t.inverse, dt * (1 + 1e-12));
        CHECK(angle_between(below.q, above.q) < 1e-12 * bound * 3 + 2e-15);
        CHECK(norm(below.spin - above.spin) < 1e-11);
    }
}

TEST_CASE("an isotropic body turns at L / I, and one without inverse inertia does not turn") {
    const vec3 l{1, -2, 3};
    const turned t = advance_rotation({}, l, {0.5, 0.5, 0.5}, 0.1);
    CHECK(t.spin == 0.5 * l);
    CHECK(angle_between(t.q, rotation(0.05 * l)) < 1e-15);
    const turned fixed = advance_rotation({}, l, {}, 0.1);
    CHECK(fixed.q == quaternion{});
    CHECK(fixed.spin == vec3{});
    const turned still = advance_rotation({}, l, {0.1, 0.2, 0.3}, 0.0);
    CHECK(still.q == quaternion{});
    CHECK(still.spin == spin_of({}, l, {0.1, 0.2, 0.3}));
}

TEST_CASE("a physical pendulum swings with order 2 and one torque per step") {
    // a body with three different moments, turning about its body z axis (a principal axis) in a field that gives the
    // torque -sin(angle): period of the mathematical pendulum with I = 0.4 is 4 sqrt(I) K(sin(a0/2))
    const double inertia = 0.4;
    const auto error = [&](int steps) {
        const double a0 = 1.0;
        double mean = 1.0; // arithmetic-geometric mean of 1 and cos(a0/2): K = pi / (2 mean)
        double other = std::cos(0.5 * a0);
        for (int i = 0; i < 8; ++i) {
            const double next = 0.5 * (mean + other);
            other = std::sqrt(mean * other);
            mean = next;
        }
        const double period = 2.0 * std::numbers::pi * std::sqrt(inertia) / mean;
        const double dt = period / steps;
        quaternion q = rotation(vec3{0, 0, a0});
        vec3 l{};
        for (int i = 0; i < steps; ++i) {
            const vec3 x = rotate(q, {1, 0, 0});
            l += (i == 0 ? 0.5 * dt : dt) * vec3{0, 0, -x.y}; // half a kick to start
            q = advance_rotation(q, l, {1 / 0.3, 1 / 0.35, 1 / inertia}, dt).q;
        }
        const vec3 x = rotate(q, {1, 0, 0});
        l += 0.5 * dt * vec3{0, 0, -x.y};
        // after one period at rest at a0; the remaining momentum measures the phase error
        return std::hypot(std::atan2(x.y, x.x) - a0, l.z);
    };
    CHECK(error(200) < 1e-3);
    CHECK(std::log2(error(100) / error(200)) == Approx(2.0).margin(0.05));
    CHECK(std::log2(error(200) / error(400)) == Approx(2.0).margin(0.05));
}

TEST_CASE("rotational energy and spin agree with the moments of inertia") {
    top t({2.0, 3.0, 5.0}, {0.1, -0.2, 0.4});
    t.q = rotation(vec3{0.4, -0.2, 1.1});
    t.l = rotate(t.q, t.l);
    CHECK(t.energy() == Approx(0.5 * (2.0 * 0.01 + 3.0 * 0.04 + 5.0 * 0.16)).epsilon(1e-14));
    CHECK(norm(rotate_back(t.q, spin_of(t.q, t.l, t.inverse)) - vec3{0.1, -0.2, 0.4}) < 1e-15);
}
