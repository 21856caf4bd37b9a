// SPDX-License-Identifier: MIT
#include <clast/contacts/hertz_mindlin.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <clast/boundaries/box.hpp>
#include <clast/contacts/rolling.hpp>
#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;
using contacts::elastic;
using contacts::hertz_mindlin;
using contacts::motion;
using contacts::overlap;
using contacts::tangential;

static_assert(contacts::contact_law<hertz_mindlin<>>);
static_assert(contacts::contact_law<hertz_mindlin<tangential::spring>> &&
              contacts::contact_law<hertz_mindlin<tangential::rescaled>> && contacts::frictional<hertz_mindlin<>>);

namespace {

constexpr elastic rigid{1e30, 0.0, 10.0};

/// A sphere that hits a plane, or its like at twice the speed: in two dimensions by leapfrog, as an engine steps it.
struct impact {
    double radius, density, normal_speed, tangential_speed = 0.0;
    double phase = 0.0; ///< share of a step by which it starts later
    bool pair = false;

    double mass() const { return density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }
    struct result {
        double deepest, largest, contact_time, speed, tangential, spin, lost, before, after;
    };
    template <class Law> result run(const Law& law, double dt) const {
        const double m = mass(), inertia = 0.4 * m * radius * radius, other = pair ? 1.0 / m : 0.0;
        const double reduced = pair ? 0.5 * m : m, curvature = pair ? 1.0 / radius : 0.0;
        typename Law::history h;
        double v = normal_speed, vt = tangential_speed, w = 0.0; // approach, slip speed of the centre, spin
        double depth = -(1.0 - phase) * dt * v, lost = 0.0;
        result out{};
        std::vector<std::pair<double, double>> path; // depth, force
        double began = -1.0, last_depth = depth;
        for (int step = 1;; ++step) {
            last_depth = depth;
            depth += dt * v;
            const overlap<double> o{0, 0, 1, depth, 1.0 / radius, curvature, 1.0 / m, other};
            const auto f = law(o, motion<double>{dt * (vt - w * radius), 0, 0, 0, v}, h, dt);
            if (depth > 0.0 && began < 0.0) began = step - depth / (depth - last_depth);
            if (depth > 0.0) {
                lost += f.dissipated;
                v += dt * f.fz / reduced, vt += dt * f.fx / m, w -= dt * f.fx * radius / inertia;
            }
            path.emplace_back(depth, depth > 0.0 ? -f.fz : 0.0);
            if (depth <= 0.0 && v < 0.0) {
                out.contact_time = dt * (step - depth / (depth - last_depth) - began);
                break;
            }
        }
        // a parabola through the three samples around the maximum
        std::size_t top = 1;
        for (std::size_t k = 1; k + 1 < path.size(); ++k)
            if (path[k].first > path[top].first) top = k;
        const auto peak = [&](auto of) {
            const double a = of(path[top - 1]), b = of(path[top]), c = of(path[top + 1]);
            return b - (c - a) * (c - a) / (8.0 * (a - 2.0 * b + c));
        };
        out.deepest = peak([](const auto& p) { return p.first; });
        out.largest = peak([](const auto& p) { return p.second; });
        out.speed = -v, out.tangential = vt, out.spin = w, out.lost = lost;
        const auto kinetic = [&](double n, double t, double s) {
            return 0.5 * reduced * n * n + 0.5 * m * t * t + 0.5 * inertia * s * s;
        };
        out.before = kinetic(normal_speed, tangential_speed, 0.0), out.after = kinetic(v, vt, w);
        return out;
    }
};

double contact_time(const impact& i, double modulus) {
    const double reduced = i.pair ? 0.5 * i.mass() : i.mass(), r = i.pair ? 0.5 * i.radius : i.radius;
    const double deepest =
        std::pow(15.0 * reduced * i.normal_speed * i.normal_speed / (16.0 * modulus * std::sqrt(r)), 0.4);
    return 2.943275184324706 * deepest / i.normal_speed;
}

} // namespace

TEST_CASE("normal impacts of Chung and Ooi, tests 1 to 3: depth, force and time of Hertz") {
    struct one {
        impact what;
        elastic a, b;
        double deepest, largest, time;
    };
    const elastic glass{48e9, 0.20}, alloy{70e9, 0.30}, oxide{380e9, 0.23};
    for (const one& c :
         {one{{0.010, 2800.0, 20.0, 0.0, 0.0, true}, glass, glass, 2.7411270e-4, 10696.88898, 4.03394557e-5},
          one{{0.1, 2699.0, 0.2}, alloy, rigid, 4.9717175e-5, 11369.85831, 7.31656641e-4},
          one{{0.0025, 4000.0, 3.9}, oxide, rigid, 8.0888083e-6, 615.351569, 6.10450991e-6}})
        for (const auto& [steps, tolerance] : {std::pair{100.0, 1e-4}, {1000.0, 1e-6}})
            for (const double phase : {0.0, 0.3, 0.7}) {
                impact i = c.what;
                i.phase = phase;
                const auto r = i.run(hertz_mindlin<>::between(c.a, c.b), c.time / steps);
                CHECK(r.deepest == Approx(c.deepest).epsilon(3.0 * tolerance));
                CHECK(r.largest == Approx(c.largest).epsilon(3.0 * tolerance));
                CHECK(r.speed == Approx(c.what.normal_speed).epsilon(tolerance));
                CHECK(r.contact_time == Approx(c.time).epsilon(10.0 * tolerance));
            }
}

TEST_CASE("restitution is what was asked for, with a pulling tail or without") {
    CHECK(contacts::restitution_of_clipped(contacts::damping_for(0.2)) == Approx(0.3248628480).epsilon(1e-9));
    CHECK(contacts::restitution_of_clipped(contacts::damping_for(0.5)) == Approx(0.5502831696).epsilon(1e-9));
    CHECK(contacts::restitution_of_clipped(contacts::damping_for(0.8)) == Approx(0.8080993353).epsilon(1e-9));
    CHECK(contacts::restitution_of_clipped(contacts::damping_for(0.9)) == Approx(0.9020260687).epsilon(1e-9));
    const impact i{0.0025, 4000.0, 3.9};
    const double t = 6.10450991e-6;
    for (const double e : {0.2, 0.5, 0.8, 0.9, 1.0}) {
        CHECK(contacts::restitution_of(contacts::damping_for(e)) == Approx(e).epsilon(1e-12));
        CHECK(contacts::restitution_of_clipped(contacts::damping_for_clipped(e)) == Approx(e).epsilon(1e-12));
        auto law = hertz_mindlin<>::between({380e9, 0.23}, rigid);
        for (const bool clipped : {false, true}) {
            law.clipped = clipped, law.damping = clipped ? contacts::damping_for_clipped(e) : contacts::damping_for(e);
            const auto r = i.run(law, t / 20000);
            CHECK(r.speed / 3.9 == Approx(e).epsilon(1e-3)); // the damper holds back by half a step
            CHECK(r.lost == Approx(r.before - r.after).epsilon(1e-3).margin(1e-9 * r.before));
        }
    }
    CHECK_THROWS_AS(contacts::damping_for(0.0), input_error);
    CHECK_THROWS_AS(contacts::damping_for(1.1), input_error);
}

TEST_CASE("an oblique impact that slides throughout, Chung and Ooi test 4: exact") {
    const elastic oxide{380e9, 0.23, 0.092};
    auto law = hertz_mindlin<>::between(oxide, rigid);
    law.damping = contacts::damping_for_clipped(0.98), law.clipped = true;
    struct one {
        double angle, tangential, spin;
    };
    for (const one& c :
         {one{40.0, 0.7829101656, 544.21636}, {60.0, 0.8948298750, 355.21200}, {80.0, 0.9678802772, 123.36383}}) {
        const double a = c.angle * std::numbers::pi / 180.0;
        const impact i{0.0025, 4000.0, 3.9 * std::cos(a), 3.9 * std::sin(a)};
        const auto r = i.run(law, contact_time(i, law.modulus) / 4000);
        CHECK(r.tangential / i.tangential_speed == Approx(c.tangential).epsilon(2e-4));
        CHECK(std::abs(r.spin) == Approx(c.spin).epsilon(1e-3));
    }
}

namespace {
template <tangential V> void oblique(double angle, double e_t, double spin, double rebound) {
    const auto law = hertz_mindlin<V>::between({380e9, 0.23, 0.092}, rigid);
    const double a = angle * std::numbers::pi / 180.0;
    const impact i{0.0025, 4000.0, 3.9 * std::cos(a), 3.9 * std::sin(a)};
    const auto r = i.run(law, contact_time(i, law.modulus) / 1000);
    CHECK(r.tangential / i.tangential_speed == Approx(e_t).epsilon(1e-4));
    CHECK(std::abs(r.spin) == Approx(spin).epsilon(1e-4));
    const double contact_point = r.tangential - r.spin * i.radius;
    CHECK(std::atan2(contact_point, r.speed) * 180.0 / std::numbers::pi == Approx(rebound).margin(1e-3).epsilon(1e-3));
    // what friction took and what the law made or lost on the way is what is missing
    CHECK(r.before - r.after == Approx(r.lost).epsilon(1e-3));
}
} // namespace

TEST_CASE(
    "an oblique impact that sticks and slips: each variant of the tangential spring has its own converged values") {
    oblique<tangential::incremental>(10.0, 0.716123, 192.2494, 0.06497);
    oblique<tangential::incremental>(20.0, 0.609221, 521.2522, -7.62328);
    oblique<tangential::spring>(10.0, 0.700769, 202.6478, -0.47795);
    oblique<tangential::spring>(20.0, 0.619799, 507.1417, -6.86345);
    oblique<tangential::rescaled>(10.0, 0.713062, 194.3226, -0.04328);
    oblique<tangential::rescaled>(20.0, 0.619802, 507.1378, -6.86323);
}

namespace {
/// Order of the error of e_t in the step: rms over phases, between t_c / 100 and t_c / 800.
template <tangential V> double order(double angle) {
    const auto law = hertz_mindlin<V>::between({380e9, 0.23, 0.092}, rigid);
    const double a = angle * std::numbers::pi / 180.0;
    impact i{0.0025, 4000.0, 3.9 * std::cos(a), 3.9 * std::sin(a)};
    const double t = contact_time(i, law.modulus), exact = i.run(law, t / 51200).tangential;
    const auto error = [&](double steps) {
        double sum = 0.0;
        for (int k = 0; k < 32; ++k) {
            i.phase = (k + 0.5) / 32;
            const double d = i.run(law, t / steps).tangential - exact;
            sum += d * d;
        }
        return std::sqrt(sum / 32);
    };
    return std::log2(error(100) / error(800)) / 3.0;
}
} // namespace

TEST_CASE("the error of an oblique impact falls with the square of the step, through stick, slip and release") {
    for (const double angle : {10.0, 20.0}) {
        CHECK(order<tangential::incremental>(angle) == Approx(2.0).margin(0.15));
        CHECK(order<tangential::spring>(angle) == Approx(2.0).margin(0.15));
        CHECK(order<tangential::rescaled>(angle) == Approx(2.0).margin(0.15));
    }
}

TEST_CASE("a Hertz-Mindlin contact has the stiffness and energy of its formulas, and none while apart") {
    const hertz_mindlin<> law = hertz_mindlin<>::between({70e9, 0.3, 0.2}, {70e9, 0.3, 0.4});
    CHECK(law.modulus == Approx(70e9 / (2.0 * 0.91)).epsilon(1e-14));
    CHECK(law.shear_modulus == Approx(70e9 / (4.0 * 1.7 * 1.3)).epsilon(1e-14));
    CHECK(law.mu == 0.2);
    const double r = 0.005, d = 1e-5; // two spheres of 1 cm
    const overlap<double> o{0, 0, 1, d, 100.0, 100.0, 1.0, 1.0};
    CHECK(law.normal_stiffness(o) == Approx(2.0 * law.modulus * std::sqrt(r * d)).epsilon(1e-13));
    CHECK(law.shear_stiffness(o) / law.normal_stiffness(o) == Approx(2.0 * 0.7 / 1.7).epsilon(1e-13)); // Mindlin
    hertz_mindlin<>::history h;
    const auto f = law(o, motion<double>{}, h, 1e-6);
    CHECK(-f.fz == Approx(4.0 / 3.0 * law.modulus * std::sqrt(r) * std::pow(d, 1.5)).epsilon(1e-13));
    CHECK(law.stored(o, h) == Approx(0.4 * -f.fz * d).epsilon(1e-13));
    const overlap<double> apart{0, 0, 1, -d, 100.0, 100.0, 1.0, 1.0};
    h = {1.0, 2.0, 0.0, d};
    const auto none = law(apart, motion<double>{1e-6, 0, 0, 0, -20.0}, h, 1e-6);
    CHECK((none.fx == 0.0 && none.fz == 0.0 && h.x == 0.0 && h.depth == 0.0));
    CHECK(law.stored(apart, h) == 0.0);
    const auto back = contacts::reversed(contacts::hertz_history{1.0, -2.0, 3.0, d}); // seen from j
    CHECK((back.x == -1.0 && back.y == 2.0 && back.z == -3.0 && back.depth == d));
    CHECK_THROWS_AS(hertz_mindlin<>::between({0.0, 0.3}, {70e9, 0.3}), input_error);
    CHECK_THROWS_AS(hertz_mindlin<>::between({70e9, 0.6}, {70e9, 0.3}), input_error);
}

namespace {
template <class Law> struct of_law : scenes::unbreakable<boundaries::box> { using contact = Law; };
/// A sphere thrown at the lower platen of a box, in the engine: e_t and spin (rad/s).
template <class Law> std::pair<double, double> thrown(const Law& law, double angle) {
    const double a = angle * std::numbers::pi / 180.0, r = 0.0025, speed = 3.9;
    bodies::clumps one = scenes::empty(shapes::sphere(2.0 * r));
    one.density = 4000.0;
    one.add(0, {0, 0, r + 1e-6}, {});
    one.set_velocity(0, {speed * std::sin(a), 0, -speed * std::cos(a)});
    engine<of_law<Law>> e({.grain_contact = law,
                           .platen_contact = law,
                           .lateral_contact = law,
                           .breakage = {},
                           .replacement = {},
                           .scheme = {.damping = 0.0},
                           .safety = 0.005},
                          std::move(one), boundaries::box({{-1, -1, 0}, {1, 1, 1}, 1e9, 1e9}));
    while (e.grains.velocity(0).z < 0.0 || e.grains.centre(0).z < r) e.step();
    return {e.grains.velocity(0).x / (speed * std::sin(a)), norm(e.grains.spin(0))};
}
} // namespace

TEST_CASE("the same impacts in the engine, on a platen, alone and with resistance to rolling beside") {
    auto law = hertz_mindlin<tangential::rescaled>::between({380e9, 0.23, 0.092}, rigid);
    auto [e_t, spin] = thrown(law, 20.0);
    CHECK(e_t == Approx(0.619802).epsilon(2e-3));
    CHECK(spin == Approx(507.1378).epsilon(5e-3));
    law.damping = contacts::damping_for_clipped(0.98), law.clipped = true;
    std::tie(e_t, spin) = thrown(law, 60.0);
    CHECK(e_t == Approx(0.8948298750).epsilon(1e-3));
    CHECK(spin == Approx(355.21200).epsilon(5e-3));
    using rough = contacts::rolling<hertz_mindlin<>>;
    static_assert(contacts::contact_law<rough>);
}
