// SPDX-License-Identifier: MIT
#include <clast/contacts/linear.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <clast/core/random.hpp>

#include <catch.hpp>

static_assert(clast::contacts::contact_law<clast::contacts::linear>);

using namespace clast;
using contacts::linear;
using contacts::motion;
using contacts::overlap;
using contacts::piece;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double no_slip = 1e300; // friction that is never reached

/// Linear spring without friction or shear stiffness.
linear spring(double kn) { return {kn, 0.0, 0.0}; }

struct ball {
    vec3 x, v, w;
    double r = 0.0;
    double mass = 0.0;
    double inertia() const { return 0.4 * mass * r * r; }
    double kinetic() const { return 0.5 * (mass * norm2(v) + inertia() * norm2(w)); }
};

vec3 force_of(const contacts::response<double>& a) { return {a.fx, a.fy, a.fz}; }
vec3 shear_of(const linear::history& h) { return {h.x, h.y, h.z}; }
linear::history history_of(const vec3& f) { return {f.x, f.y, f.z}; }
bool is_empty(const linear::history& h) { return h.x == 0.0 && h.y == 0.0 && h.z == 0.0; }
overlap<double> at(const vec3& n, double depth) { return {n.x, n.y, n.z, depth, 1.0, 1.0}; }
motion<double> slide(const vec3& u, double spin = 0.0) { return {u.x, u.y, u.z, spin, 0.0}; }
/// The same while the normal turns from one direction to another.
motion<double> slide(const vec3& u, double spin, const vec3& from, const vec3& to) {
    const vec3 m = from + to;
    return {u.x, u.y, u.z, spin, 0.0, m.x, m.y, m.z, 2.0 / norm2(m)};
}

/// One contact, driven as the library does it: the last step's motion, measured against the normal at mid-step.
struct pair_contact {
    linear law;
    linear::history history;
    double dissipated = 0.0;
    double normal_impulse = 0.0;

    void kick(ball& a, ball& b, double h) {
        const vec3 d = b.x - a.x;
        const double distance = norm(d), depth = a.r + b.r - distance;
        const vec3 n = d / distance;
        const double arm_a = a.r - 0.5 * depth, arm_b = b.r - 0.5 * depth;
        const vec3 relative = a.v + cross(a.w, arm_a * n) - b.v + cross(b.w, arm_b * n);
        const vec3 mid = unit(d - (0.5 * h) * (b.v - a.v));
        const vec3 u = h * reject(relative, mid);
        const auto answer =
            law(overlap<double>{n.x, n.y, n.z, depth, 1.0 / a.r, 1.0 / b.r},
                motion<double>{u.x, u.y, u.z, 0.5 * h * dot(a.w + b.w, n), dot(relative, n), mid.x, mid.y, mid.z, 2.0},
                history, h);
        const vec3 f = force_of(answer);
        dissipated += answer.dissipated;
        normal_impulse -= h * dot(f, n);
        a.v += (h / a.mass) * f;
        b.v -= (h / b.mass) * f;
        a.w += (h / a.inertia()) * cross(arm_a * n, f);
        b.w += (h / b.inertia()) * cross(arm_b * n, f); // (-arm n) x (-f)
    }
    void step(ball& a, ball& b, double h) {
        a.x += h * a.v;
        b.x += h * b.v;
        kick(a, b, h);
    }
};

/// A ball and the fixed plane z = 0; the wall passes the radius of the ball.
struct plane_contact {
    linear law;
    linear::history history;
    double dissipated = 0.0;
    double normal_impulse = 0.0;

    void step(ball& a, double h) {
        a.x += h * a.v;
        const vec3 n{0, 0, -1};
        const double depth = a.r - a.x.z;
        const vec3 relative = a.v + cross(a.w, a.r * n);
        const vec3 u = h * reject(relative, n);
        const auto answer = law(overlap<double>{n.x, n.y, n.z, depth, 1.0 / a.r, 1.0 / a.r},
                                motion<double>{u.x, u.y, u.z, h * dot(a.w, n), dot(relative, n)}, history, h);
        dissipated += answer.dissipated;
        normal_impulse += h * answer.fz;
        a.v += (h / a.mass) * force_of(answer);
        a.w += (h / a.inertia()) * cross(a.r * n, force_of(answer));
    }
};

/// Rebound speed over impact speed of a ball on a wall, and the contact time, for n steps per contact time.
struct bounce {
    double ratio;
    double time;
};
bounce bounce_of(double steps_per_contact, double phase) {
    const double mass = 0.7, k = 3e5, v = 1.3;
    const double dt = pi * std::sqrt(mass / k) / steps_per_contact;
    ball a{{0, 0, 0.01 + phase * v * dt}, {0, 0, -v}, {}, 0.01, mass};
    plane_contact wall{spring(k), {}};
    double before = a.x.z - a.r, started = 0.0, ended = 0.0;
    for (int i = 1; i < 3 * steps_per_contact + 10; ++i) {
        const double speed = a.v.z;
        wall.step(a, dt);
        const double gap = a.x.z - a.r;
        if (before > 0.0 && gap <= 0.0) started = (i - gap / (speed * dt)) * dt;
        if (before < 0.0 && gap >= 0.0) {
            ended = (i - gap / (speed * dt)) * dt;
            break;
        }
        before = gap;
    }
    return {a.v.z / v, ended - started};
}

} // namespace

TEST_CASE("a contact of two pieces is a series of springs with the smaller friction") {
    const linear grains = linear::between({5.8e6, 2.9e6, 0.3}, {5.8e6, 2.9e6, 0.3});
    CHECK(grains.kn == 2.9e6);
    CHECK(grains.ks == 1.45e6);
    CHECK(grains.mu == 0.3);
    const linear platen = linear::between({5.8e6, 2.9e6, 0.3}, {3.2e8, 1.6e8, 0.0}); // Table 1 of the paper
    CHECK(platen.kn == Approx(5.8e6 * 3.2e8 / 3.258e8).epsilon(1e-15));
    CHECK(platen.mu == 0.0);
    const linear swapped = linear::between({3.2e8, 1.6e8, 0.0}, {5.8e6, 2.9e6, 0.3});
    CHECK((swapped.kn == platen.kn && swapped.ks == platen.ks && swapped.mu == platen.mu));
    CHECK(linear::between({1e6, 0.0, 0.5}, {1e6, 0.0, 0.4}).ks == 0.0);
}

TEST_CASE("a normal spring pushes with k times overlap, and not at all when open") {
    const linear law{2e6, 1e6, 0.5};
    const vec3 n = unit(vec3{1, 2, -2});
    linear::history h;
    CHECK(norm(force_of(law(at(n, 1e-3), {}, h, 1e-5)) - (-2e3) * n) < 1e-12);
    CHECK(force_of(law(at(n, 0.0), {}, h, 1e-5)) == vec3{});
    CHECK(norm(force_of(law(at(n, -1e-3), {}, h, 1e-5))) == 0.0);
    CHECK(law.stored(at(n, 1e-3), h) == Approx(1.0).epsilon(1e-15));
    CHECK(law.stored(at(n, -1e-3), h) == 0.0);
    CHECK(law.normal_stiffness(at(n, 0.0)) == 2e6);
    CHECK(law.shear_stiffness(at(n, 0.0)) == 1e6);
}

TEST_CASE("an opening contact forgets its shear force, and then rests") {
    const linear law{1e6, 1e6, 0.5};
    linear::history h = history_of({100, 0, 0});
    const auto answer = law(at({0, 0, 1}, -1e-9), {}, h, 1e-5);
    CHECK(norm(force_of(answer)) == 0.0);
    CHECK(answer.dissipated == Approx(0.5 * 100.0 * 100.0 / 1e6).epsilon(1e-14)); // its energy is not lost silently
    CHECK(is_empty(h));
    CHECK(law(at({0, 0, 1}, -1e-9), {}, h, 1e-5).dissipated == 0.0);
}

TEST_CASE("normal impact: the rebound error of velocity Verlet is the published one, of third order") {
    // largest and root-mean-square error over all start phases
    struct row {
        double steps, largest, rms;
    };
    for (const row& r : {row{5, 1.64e-2, 9.4e-3},
                         {10, 1.99e-3, 1.15e-3},
                         {20, 2.50e-4, 1.45e-4},
                         {30, 7.43e-5, 4.30e-5},
                         {50, 1.61e-5, 9.3e-6},
                         {100, 2.02e-6, 1.17e-6},
                         {200, 2.53e-7, 1.46e-7}}) {
        double largest = 0.0, squares = 0.0;
        for (int k = 0; k < 400; ++k) {
            const double e = std::abs(bounce_of(r.steps, (k + 0.5) / 400.0).ratio - 1.0);
            largest = std::max(largest, e);
            squares += e * e;
        }
        CHECK(largest == Approx(r.largest).epsilon(0.01));
        CHECK(std::sqrt(squares / 400.0) == Approx(r.rms).epsilon(0.015));
    }
}

TEST_CASE("normal impact: the contact lasts pi sqrt(m/k)") {
    const double exact = pi * std::sqrt(0.7 / 3e5);
    for (const double phase : {0.1, 0.37, 0.8}) {
        CHECK(bounce_of(100, phase).time == Approx(exact).epsilon(5e-4));
        CHECK(bounce_of(1000, phase).time == Approx(exact).epsilon(5e-6));
    }
}

TEST_CASE("normal impact of two unlike balls: reduced mass, momentum and largest overlap") {
    const double m1 = 0.3, m2 = 1.1, k = 4e5, v = 2.0;
    const double reduced = m1 * m2 / (m1 + m2), dt = pi * std::sqrt(reduced / k) / 1000.0;
    ball a{{0, 0, 0}, {v, 0, 0}, {}, 0.010, m1}, b{{0.0250001, 0, 0}, {0, 0, 0}, {}, 0.015, m2};
    pair_contact contact{spring(k), {}};
    double deepest = 0.0;
    for (int i = 0; i < 1100; ++i) {
        contact.step(a, b, dt);
        deepest = std::max(deepest, 0.025 - norm(b.x - a.x));
    }
    CHECK(deepest == Approx(v * std::sqrt(reduced / k)).epsilon(3e-6));
    CHECK(a.v.x == Approx(v * (m1 - m2) / (m1 + m2)).epsilon(1e-6));
    CHECK(b.v.x == Approx(2.0 * v * m1 / (m1 + m2)).epsilon(1e-6));
    CHECK(m1 * a.v.x + m2 * b.v.x == Approx(m1 * v).epsilon(1e-13));
    CHECK(contact.dissipated == 0.0);
}

TEST_CASE("oblique impact on a plane, sliding throughout: exact tangential speed, spin and rebound") {
    // e = 1; slides throughout for v_t / v_n >= 7 mu
    const double mass = 0.5, r = 0.02, mu = 0.092, k = 1e6, v_n = 1.4;
    const double dt = pi * std::sqrt(mass / k) / 1000.0;
    for (const double ratio : {7.0 * mu, 0.84, 1.7, 5.7}) {
        const double v_t = ratio * v_n;
        ball a{{0, 0, r + 1e-9}, {v_t, 0, -v_n}, {}, r, mass};
        const double before = a.kinetic();
        plane_contact plane{{k, k, mu}, {}};
        for (int i = 0; i < 1005; ++i) plane.step(a, dt);
        CHECK(a.v.z == Approx(v_n).epsilon(2e-7));
        // friction is mu times the normal force in every step (but the last ones at the limit angle, where it sticks)
        const double loss = mu * (v_n + a.v.z);
        const double tolerance = ratio > 7.0 * mu ? 1e-12 : 1e-5;
        CHECK(a.v.x == Approx(v_t - loss).epsilon(tolerance));
        CHECK(a.w.y * r == Approx(2.5 * loss).epsilon(tolerance));
        CHECK(a.v.x - r * a.w.y == Approx(v_t - 3.5 * loss).margin(1e-4 * v_t)); // contact point
        CHECK(plane.normal_impulse == Approx(mass * (v_n + a.v.z)).epsilon(1e-12));
        CHECK(before - a.kinetic() == Approx(plane.dissipated).epsilon(3e-6));
    }
}

TEST_CASE(
    "oblique impact at 40, 60 and 80 degrees: the exact sliding branch in closed form, any direction in the plane") {
    const double mass = 0.2, r = 0.0025, mu = 0.092, k = 1e8, speed = 3.9;
    const double dt = pi * std::sqrt(mass / k) / 2000.0;
    for (const double degrees : {40.0, 60.0, 80.0})
        for (const double azimuth : {0.3, 2.0, 4.4}) {
            const double v_n = speed * std::cos(degrees * pi / 180), v_t = speed * std::sin(degrees * pi / 180);
            const vec3 along{std::cos(azimuth), std::sin(azimuth), 0};
            ball a{{0, 0, r + 1e-12}, v_t * along - vec3{0, 0, v_n}, {}, r, mass};
            plane_contact plane{{k, 0.5 * k, mu}, {}};
            for (int i = 0; i < 2005; ++i) plane.step(a, dt);
            CHECK(dot(a.v, along) / v_t == Approx(1.0 - 2.0 * mu * v_n / v_t).epsilon(1e-7));
            CHECK(norm(a.w - (5.0 * mu * v_n / r) * cross(vec3{0, 0, 1}, along)) < 1e-6 * norm(a.w));
            const double tangent = dot(a.v + cross(a.w, vec3{0, 0, -r}), along) / a.v.z;
            CHECK(tangent == Approx((v_t - 7.0 * mu * v_n) / v_n).epsilon(1e-6));
        }
}

TEST_CASE("oblique impact of two unlike balls: the same sliding branch, opposite impulses, angular momentum kept") {
    const double mu = 0.3, v_n = 0.9, v_t = 4.1, k = 1e13;
    const ball a0{{0, 0, 0}, {0, 0, 0}, {}, 0.011, 0.4};
    const vec3 n = unit(vec3{1, -2, 0.5}), along = unit(cross(n, vec3{0.3, 1, 2}));
    ball a = a0, b{(a0.r + 0.02 + 1e-11) * n, (-v_n) * n + (-v_t) * along, {}, 0.02, 1.7};
    const double reduced = a.mass * b.mass / (a.mass + b.mass), dt = pi * std::sqrt(reduced / k) / 1000.0;
    const auto momentum = [&] { return a.mass * a.v + b.mass * b.v; };
    const auto angular = [&] {
        return a.mass * cross(a.x, a.v) + a.inertia() * a.w + b.mass * cross(b.x, b.v) + b.inertia() * b.w;
    };
    const vec3 momentum_before = momentum(), angular_before = angular();
    pair_contact contact{{k, k, mu}, {}};
    for (int i = 0; i < 1010; ++i) contact.step(a, b, dt);
    // the contact lasts 5e-7 s, so that the normal turns by 1e-4 and the overlap takes 1e-5 of the arms
    const double loss = 2.0 * mu * v_n * reduced;
    const vec3 sliding = a.v + cross(a.w, a.r * n) - b.v + cross(b.w, b.r * n);
    CHECK(dot(a.v, along) == Approx(-loss / a.mass).epsilon(1e-3));
    CHECK(norm(a.w) * a.r == Approx(2.5 * loss / a.mass).epsilon(1e-3));
    CHECK(norm(b.w) * b.r == Approx(2.5 * loss / b.mass).epsilon(1e-3));
    CHECK(dot(sliding, along) == Approx(v_t - 7.0 * mu * v_n).epsilon(1e-3));
    CHECK(norm(momentum() - momentum_before) < 1e-14 * norm(momentum_before));
    CHECK(norm(angular() - angular_before) < 1e-9 * norm(angular_before));
}

TEST_CASE("a sphere that slides on a rough plane rolls after 2 u0 / (7 mu g), at 5/7 of its speed") {
    const double mass = 1.0, r = 0.1, mu = 0.3, g = 9.81, u0 = 1.5, ks = 1e9, kn = 1e6;
    const double exact = 2.0 * u0 / (7.0 * mu * g), dt = 5e-6;
    ball a{{0, 0, r - mass * g / kn}, {u0, 0, 0}, {}, r, mass};
    plane_contact plane{{kn, ks, mu}, {}};
    double last_slip = 0.0, mean = 0.0, mean_spin = 0.0;
    int averaged = 0;
    const int steps = static_cast<int>(2.0 * exact / dt);
    for (int i = 1; i <= steps; ++i) {
        plane.step(a, dt);
        a.v.z -= dt * g;
        if (plane.dissipated < (1.0 - 1e-6) * mass * u0 * u0 / 7.0)
            last_slip = i * dt; // what is left grows with time squared
        if (i == steps / 4) CHECK(a.v.x == Approx(u0 - mu * g * (i * dt)).epsilon(1e-6));
        if (i > 3 * (steps / 4)) mean += a.v.x, mean_spin += a.w.y, ++averaged;
    }
    CHECK(last_slip == Approx((1.0 - 1e-3) * exact).epsilon(1e-4));
    CHECK(mean / averaged == Approx(5.0 / 7.0 * u0).epsilon(1e-5));
    CHECK(mean_spin / averaged * r == Approx(5.0 / 7.0 * u0).epsilon(1e-5));
    CHECK(a.v.x + 0.4 * r * a.w.y == Approx(u0).epsilon(1e-12)); // angular momentum about the contact
    CHECK(plane.dissipated == Approx(mass * u0 * u0 / 7.0).epsilon(1e-5));
}

TEST_CASE("Coulomb: the shear force never exceeds mu times the normal force, and follows a spring below it") {
    const linear law{1e6, 4e5, 0.4};
    linear::history h;
    const vec3 n{0, 0, 1}, u{1e-5, 0, 0};
    for (int i = 1; i <= 9; ++i) {
        const auto answer = law(at(n, 1e-4), slide(u), h, 1e-5); // limit 40 N, 4 N per step
        CHECK(answer.fx == Approx(-4.0 * i).epsilon(1e-14));
        CHECK(answer.dissipated == Approx(0.0).margin(1e-18));
    }
    for (int i = 0; i < 5; ++i) {
        const auto answer = law(at(n, 1e-4), slide(2.0 * u), h, 1e-5); // 8 N per step
        CHECK(answer.fx == Approx(-40.0).epsilon(1e-14));
        // slip times force; in the first of these steps the spring takes 4 N and its mean force is 38 N
        CHECK(answer.dissipated == Approx(i == 0 ? 38.0 * 1e-5 : 40.0 * 2e-5).epsilon(1e-12));
    }
    CHECK(law(at(n, 0.5e-4), {}, h, 1e-5).fx == Approx(-20.0).epsilon(1e-14)); // unloading lowers the limit
    CHECK(law(at(n, 2.0e-4), {}, h, 1e-5).fx == Approx(-20.0).epsilon(1e-14)); // loading does not bring it back
    random_stream random{5, 1};
    for (int i = 0; i < 2000; ++i) {
        const double depth = uniform(random, -1e-5, 2e-4);
        const auto answer = law(at(n, depth), slide(3e-5 * reject(direction(random), n)), h, 1e-5);
        REQUIRE(std::hypot(answer.fx, answer.fy) <= 0.4 * 1e6 * std::max(depth, 0.0) * (1 + 1e-15));
    }
    linear frictionless{1e6, 4e5, 0.0};
    linear::history none;
    CHECK(force_of(frictionless(at(n, 1e-4), slide(u), none, 1e-5)) == vec3{0, 0, -100});
    CHECK(is_empty(none));
}

TEST_CASE("work in equals energy stored plus energy dissipated on any path with slip, unloading and turning") {
    random_stream random{5, 2};
    const linear law{1e6, 4e5, 0.4};
    linear sticking = law;
    sticking.mu = no_slip;
    linear::history h;
    vec3 n{0, 0, 1};
    double work = 0.0, dissipated = 0.0, depth = 1e-4, shear_energy = 0.0, turnover = 0.0;
    int slips = 0;
    for (int i = 0; i < 5000; ++i) {
        const vec3 was = n;
        n = unit(n + 0.02 * direction(random));
        depth = std::clamp(depth + 1e-5 * uniform(random, -1, 1), -1e-5, 2e-4);
        const double spin = 0.02 * uniform(random, -1, 1);
        const vec3 u = 2e-5 * reject(direction(random), n);
        // the old force in the new plane: what the law makes of it when nothing slides
        linear::history turned = h;
        sticking(at(n, 1.0), slide({}, spin, was, n), turned, 1e-5);
        const auto answer = law(at(n, depth), slide(u, spin, was, n), h, 1e-5);
        work -= 0.5 * dot(shear_of(turned) + shear_of(h), u);
        turnover += std::abs(dot(shear_of(h), u));
        dissipated += answer.dissipated;
        slips += answer.dissipated > 1e-12;
        shear_energy = law.stored(at(n, 0.0), h);
    }
    CHECK(slips > 1000);
    CHECK(dissipated > 0.0);
    CHECK(shear_energy > 0.0);
    CHECK(std::abs(work - shear_energy - dissipated) < 1e-13 * turnover);
}

TEST_CASE("a pair that turns as one keeps the size of its shear force, and its direction with the square of the step") {
    const linear law{1e6, 4e5, no_slip};
    random_stream random{5, 3};
    for (int trial = 0; trial < 10; ++trial) {
        const vec3 n0 = direction(random), axis = 2.0 * direction(random); // 2 rad about any axis
        const vec3 f0 = 100.0 * unit(cross(n0, direction(random)));
        double error[2];
        for (int fine = 0; fine < 2; ++fine) {
            const int steps = fine == 0 ? 200 : 400;
            linear::history h = history_of(f0);
            vec3 was = n0;
            for (int k = 1; k <= steps; ++k) {
                const vec3 n = rotate(rotation((static_cast<double>(k) / steps) * axis), n0);
                law(at(n, 1e-4), slide({}, dot(axis, n) / steps, was, n), h, 1e-5);
                was = n;
                REQUIRE(std::abs(dot(shear_of(h), n)) < 1e-12 * 100.0);
            }
            CHECK(norm(shear_of(h)) == Approx(100.0).epsilon(1e-13));
            error[fine] = norm(shear_of(h) - rotate(rotation(axis), f0)) / 100.0;
        }
        CHECK(error[0] < 8e-5);
        CHECK(error[1] < 0.27 * error[0]);
    }
}

TEST_CASE("spin about the normal alone turns the shear force by the mean spin, and its size stays") {
    const linear law{1e6, 4e5, no_slip};
    for (const int steps : {100, 1000}) {
        linear::history h = history_of({30, 0, 0});
        for (int k = 0; k < steps; ++k) law(at({0, 0, 1}, 1e-4), slide({}, 0.5 * pi / steps), h, 1e-5);
        CHECK(norm(shear_of(h)) == Approx(30.0).epsilon(1e-13));
        CHECK(norm(shear_of(h) - vec3{0, 30, 0}) < 1e-11);
    }
}

TEST_CASE("a normal that swings by a right angle onto the shear force leaves no force and no NaN") {
    const linear law{1e6, 4e5, 0.5};
    linear::history h = history_of({30, 0, 0});
    const auto answer = law(at({1, 0, 0}, 1e-4), {}, h, 1e-5);
    CHECK(force_of(answer) == vec3{-100, 0, 0});
    CHECK(is_empty(h));
}

TEST_CASE("seen from the other ball the force is opposite, to the last bit") {
    const linear law{1e6, 4e5, 0.4};
    random_stream random{5, 4};
    linear::history hi, hj;
    vec3 n = direction(random);
    for (int i = 0; i < 1000; ++i) {
        const vec3 was = n;
        n = unit(n + 0.05 * direction(random));
        const double depth = uniform(random, -1e-5, 2e-4), spin = 0.01 * uniform(random, -1, 1);
        const vec3 u = 2e-5 * reject(direction(random), n);
        const auto on_i = law(at(n, depth), slide(u, spin, was, n), hi, 1e-5);
        const auto on_j = law(at(-n, depth), slide(-u, -spin, -was, -n), hj, 1e-5); // the spin about -n is opposite
        REQUIRE(force_of(on_i) == -force_of(on_j));
        REQUIRE(on_i.dissipated == on_j.dissipated);
    }
}

TEST_CASE("a pair of balls that turns as one feels no friction") {
    const double kn = 1e6, depth = 1e-4, r = 0.01, dt = 1e-4;
    ball a{{0, 0, 0}, {}, {}, r, 1.0}, b{{0, 0, 2 * r - depth}, {}, {}, r, 1.0};
    pair_contact contact{{kn, kn, 1.0}, {}};
    double largest = 0.0;
    const double spin = 5.0;
    for (int k = 1; k <= 2000; ++k) {
        const double angle = spin * k * dt; // the pair turns as one about y
        const vec3 n{std::sin(angle), 0, std::cos(angle)},
            before{std::sin(angle - spin * dt), 0, std::cos(angle - spin * dt)};
        const vec3 chord = ((b.r + a.r - depth) / dt) * (n - before);
        ball i = a, j = b;
        j.x = (2 * r - depth) * n;
        j.v = chord;
        i.w = j.w = vec3{0, spin, 0};
        contact.kick(i, j, dt);
        largest = std::max(largest, norm(shear_of(contact.history)));
    }
    // against k_s r times the angle of 1 rad: 1e4 N
    CHECK(largest < 1e-3);
}
