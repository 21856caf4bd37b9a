// SPDX-License-Identifier: MIT
#include <cmath>
#include <complex>

#include <catch.hpp>

#include <clast/control/servo.hpp>

#include <algorithm>
namespace {

constexpr double k = 2.0e6;
constexpr double dt = 1e-5;

clast::control::servo example(double target, double force, double gain = 0.5) {
    return {target, force, k, k, dt, gain, 1e9};
}

// Ratio of successive errors (rms over many steps) of a wall on one spring whose force is known one step late.
double decay_per_step(double gain, int steps) {
    double compression = 0.0;
    double known = 0.0;
    const double target = 1000.0;
    double early = 0.0;
    double late = 0.0;
    for (int n = 0; n < steps; ++n) {
        const double v = clast::control::inward_velocity(example(target, known, gain));
        known = k * compression; // what the next call will see is the force before this move
        compression += v * dt;
        const double e2 = std::pow(k * compression - target, 2);
        if (n >= 20 && n < 40) early += e2;
        if (n >= steps - 20) late += e2;
    }
    return std::pow(late / early, 0.5 / (steps - 40));
}

} // namespace

TEST_CASE("a servo moves a wall by the gain times what would remove its force error at once", "[control]") {
    CHECK(clast::control::inward_velocity(example(3000, 1000)) == Approx(0.5 * 2000 / k / dt).epsilon(1e-15));
    CHECK(clast::control::inward_velocity(example(1000, 3000)) == Approx(-0.5 * 2000 / k / dt).epsilon(1e-15));
    CHECK(clast::control::inward_velocity(example(1000, 1000)) == 0.0);
}

TEST_CASE("a servo never exceeds its speed limit and trusts no stiffness below one contact", "[control]") {
    auto s = example(1e6, 0);
    s.max_speed = 0.02;
    CHECK(clast::control::inward_velocity(s) == 0.02);
    s.target_force = 0;
    s.force = 1e6;
    CHECK(clast::control::inward_velocity(s) == -0.02);
    s = example(3000, 1000);
    s.stiffness = 0.01 * k; // a contact at an edge
    CHECK(clast::control::inward_velocity(s) == Approx(0.5 * 2000 / k / dt).epsilon(1e-15));
}

TEST_CASE("a wall without contact searches inward at the speed limit, unless its target is zero", "[control]") {
    clast::control::servo s{1000, 0, 0, k, dt, 0.5, 0.02};
    CHECK(clast::control::inward_velocity(s) == 0.02);
    s.target_force = 0;
    CHECK(clast::control::inward_velocity(s) == 0.0);
}

TEST_CASE("the error of a servo with one step of delay decays as the roots of z^2 - z + gain = 0", "[control]") {
    // complex roots for gain > 1/4: spectral radius sqrt(gain)
    CHECK(decay_per_step(0.5, 80) == Approx(std::sqrt(0.5)).epsilon(0.01));
    CHECK(decay_per_step(0.8, 200) == Approx(std::sqrt(0.8)).epsilon(0.01));
    CHECK(decay_per_step(1.1, 200) > 1.0);                        // unstable from 1
    CHECK(decay_per_step(0.16, 80) == Approx(0.8).epsilon(0.01)); // real roots 0.8 and 0.2: no ringing
}

TEST_CASE("with the current force the error shrinks by 1 - gain in every step", "[control]") {
    double compression = 0.0;
    double error = 1000.0;
    for (int n = 0; n < 30; ++n) {
        compression += dt * clast::control::inward_velocity(example(1000, k * compression));
        CHECK(1000.0 - k * compression == Approx(0.5 * error).margin(1e-9));
        error *= 0.5;
    }
}

TEST_CASE("two servo walls that squeeze one soft column both reach the target without drift", "[control]") {
    // wall - contact - soft column - contact - wall: the column is softer than the contacts that the servos know
    const double column = 1.0 / (2.0 / k + 1.0 / (0.3 * k));
    double left = 0.0;
    double right = 0.0;
    for (int n = 0; n < 400; ++n) {
        const double force = std::max(0.0, column * (left + right));
        const double v = clast::control::inward_velocity(example(5000, force));
        left += v * dt;
        right += v * dt;
    }
    CHECK(column * (left + right) == Approx(5000).epsilon(1e-10));
    CHECK(left == right);
}

TEST_CASE(
    "a servo that jumps over a narrow solution comes to rest on it, and one that follows a load keeps its speed") {
    // two tiles and one pebble: the load is on whichever is ahead, shared only while they are within 0.1 um
    clast::control::calm a, b;
    double x = 0.3e-6, force_a = 0.0; // a ahead of b by x
    for (int step = 0; step < 400; ++step) {
        force_a = std::clamp(0.5 + x / 0.2e-6, 0.0, 1.0);
        const double wanted = (0.5 - force_a) * 2.0;
        x += (a.follow(wanted, 0.05) - b.follow(-wanted, 0.05)) * 7e-6;
    }
    CHECK(force_a == Approx(0.5).margin(0.01));
    CHECK(a.limit < 0.05);
    // without it: for ever between all and nothing
    x = 0.3e-6;
    for (int step = 0; step < 400; ++step) {
        force_a = std::clamp(0.5 + x / 0.2e-6, 0.0, 1.0);
        x += 2.0 * std::clamp((0.5 - force_a) * 2.0, -0.05, 0.05) * 7e-6;
    }
    CHECK(std::abs(force_a - 0.5) > 0.4);
    // a load that goes away: full speed again within some steps
    double v = 0.0;
    for (int step = 0; step < 60; ++step) v = a.follow(1.0, 0.05);
    CHECK(v == 0.05);
}
