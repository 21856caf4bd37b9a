// SPDX-License-Identifier: MIT
#include <clast/integrators/local_damping.hpp>

#include <cmath>
#include <numbers>

#include <catch.hpp>

using namespace clast;

namespace {

/// Peak displacement over the static one of a mass on a spring, loaded at once, by leapfrog with damping a.
double overshoot(double a, double dt) {
    double x = 0.0;
    double v = 0.0; // at n - 1/2
    while (true) {
        const double force = 1.0 - x; // m = k = F = 1
        v += dt * (force + damping_force(force, v, a));
        if (v <= 0.0) return x;
        x += dt * v;
    }
}

} // namespace

TEST_CASE("local damping opposes each velocity component by a fixed share of the force") {
    CHECK(damping_force(vec3{2, -3, 5}, vec3{1, 1, -1}, 0.7) == vec3{-0.7 * 2, -0.7 * 3, 0.7 * 5});
    CHECK(damping_force(vec3{2, -3, 5}, vec3{1e-300, -1e-300, 0}, 0.5) == vec3{-1.0, 1.5, 0.0});
}

TEST_CASE("a body at rest is not damped, and a free body keeps its velocity") {
    CHECK(damping_force(vec3{2, -3, 5}, vec3{}, 0.7) == vec3{});
    CHECK(damping_force(vec3{}, vec3{4, -5, 6}, 0.7) == vec3{});
    CHECK(damping_force(vec3{2, -3, 5}, vec3{0.0, -0.0, 0.0}, 0.7) == vec3{});
    CHECK(damping_force(vec3{2, -3, 5}, vec3{4, -5, 6}, 0.0) == vec3{});
}

TEST_CASE("moments are damped along the body's axes") {
    const quaternion q = rotation(vec3{0, 0, std::numbers::pi / 4});
    // about the body's x axis, which points along (1, 1, 0)
    const vec3 axis = unit(vec3{1, 1, 0});
    const vec3 m = damping_moment(q, 3.0 * axis, 2.0 * axis, 0.7);
    CHECK(norm(m + 2.1 * axis) < 1e-15);
    // a spin that is negative about body x, though its world x component is positive
    CHECK(norm(damping_moment(q, 3.0 * axis, vec3{1, -2, 0}, 0.7) - 2.1 * axis) < 1e-15);
    // across: the spin about body x meets no moment about body x
    CHECK(norm(damping_moment(q, vec3{0, 0, 4}, 2.0 * axis, 0.7)) < 1e-15);
}

TEST_CASE("damping power is the rate of work of the damping force and never negative") {
    for (const double s : {1.0, -1.0})
        for (const double t : {1.0, -1.0}) {
            const vec3 f{2 * s, -3 * t, 5};
            const vec3 v{0.1, 0.2 * t, -0.3 * s};
            CHECK(damping_power(f, v, 0.7) == Approx(0.7 * (0.2 + 0.6 + 1.5)).epsilon(1e-15));
        }
    CHECK(damping_power({2, -3, 5}, {}, 0.7) == 0.0);
}

TEST_CASE("a suddenly loaded spring overshoots by sqrt((1 - a) / (1 + a))") {
    // energy over the two half swings: (1 - a) x0^2 = (1 + a) x1^2
    for (const double a : {0.0, 0.5, 0.7, 0.8}) {
        const double exact = 1.0 + std::sqrt((1.0 - a) / (1.0 + a));
        // sign(0) = 0 leaves the first kick undamped: error of order dt^2, and nothing of order dt
        CHECK(overshoot(a, 1e-3) == Approx(exact).epsilon(2e-6));
        CHECK(overshoot(a, 1e-4) == Approx(exact).epsilon(2e-8));
    }
    CHECK(overshoot(0.7, 1e-4) == Approx(1.42).epsilon(1e-3));
}
