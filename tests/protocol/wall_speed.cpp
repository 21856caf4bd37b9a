// SPDX-License-Identifier: MIT
#include <clast/protocol/wall_speed.hpp>

#include <cmath>
#include <vector>

#include <catch.hpp>

using namespace clast;
using namespace clast::literals;
using namespace clast::protocol;

namespace {

constexpr double rho = 2650.0; // kg/m^3

/// The paper's: grains of 20 mm at 2 MPa, I of 1e-4 in shear.
test_plan paper(double inertial_number = 1e-4) {
    test_plan p;
    p.radius = 0.06, p.height = 0.28, p.inertial_number = inertial_number;
    return p;
}
/// Paper Eq. 2.
double inertia(double rate, double p) { return rate * 0.02 / std::sqrt(p / rho); }
wall_view seen(double p, double coordination, double height = 0.3, double radius = 0.07) {
    return {height, radius, p, coordination, 1e-3};
}
stage consolidation() {
    stage s;
    s.axial = s.lateral = drive_by::stress(2_MPa);
    s.walls_at_rest = true;
    return s;
}
stage compaction() {
    stage s;
    s.axial = drive_by::size(28_cm), s.lateral = drive_by::size(6_cm);
    s.moves_grains = true, s.yields_at = 0.0075;
    return s;
}

} // namespace

TEST_CASE("walls that give way follow the rule of a servo: a share of what is missing, within their speed") {
    const double gain = 0.5, dt = 1e-5, rate = 1.0;
    CHECK(yielding_rate({900.0, 1e8}, 1000.0, gain, dt, rate) == Approx(0.5 * 100.0 / (1e8 * 1e-5)));
    CHECK(yielding_rate({1100.0, 1e8}, 1000.0, gain, dt, rate) == Approx(-0.5 * 100.0 / (1e8 * 1e-5)));
    CHECK(yielding_rate({0.0, 1e6}, 1000.0, gain, dt, rate) == 1.0);
    CHECK(yielding_rate({1e9, 1e6}, 1000.0, gain, dt, rate) == -1.0);
    CHECK(yielding_rate({0.0, 0.0}, 1000.0, gain, dt, rate) == 1.0); // nothing touches them
    CHECK(yielding_rate({2000.0, 0.0}, 1000.0, gain, dt, rate) == 0.0);
}

TEST_CASE("the stiffness that walls feel is that of their contacts, over a strain of all axes alike") {
    // platens 10 N/m each, four walls of a box 2 x 2 x 3 m of 5 N/m each
    std::vector<boundaries::facet_load> loads(6);
    for (std::size_t f = 0; f < 6; ++f) loads[f].stiffness = f < 2 ? 10.0 : 5.0;
    const double height = 3.0, half = 1.0, volume = 12.0;
    // of a strain e: a platen moves by e 3/2 and takes 15 e N on 4 m^2; a wall by e and takes 5 e on 6 m^2
    const double axial = 15.0 / 4.0, lateral = 5.0 / 6.0;
    const auto felt = [&](bool a, bool l) { return load_of_walls(loads, 7.0, height, half, volume, {a, l}); };
    CHECK(felt(true, true).p == 7.0);
    CHECK(felt(true, true).stiffness == Approx((axial + 2.0 * lateral) / 3.0));
    CHECK(felt(true, false).stiffness == Approx(axial / 3.0));
    CHECK(felt(false, true).stiffness == Approx(2.0 * lateral / 3.0));
}

TEST_CASE("a vessel closes at I of 1e-3 of the confining stress, faster only where shear is") {
    for (const auto& [shear, flight] :
         {std::pair(1e-5, 1e-4), std::pair(1e-4, 1e-3), std::pair(1e-3, 1e-3), std::pair(5e-3, 5e-3)}) {
        const test_plan p = paper(shear);
        const wall_speed w(p, rho);
        CHECK(inertia(w.packing_rate(), 2e6) == Approx(flight));
    }
}

TEST_CASE("walls in consolidation keep to I of 1e-3, of 1e-4 over the last fifth, with p of 5 % at least") {
    const test_plan p = paper();
    wall_speed w(p, rho);
    const stage s = consolidation();
    w.begin(s, seen(0.0, 3.0));
    const auto check = [&](double stress, double coordination, double expected, double counted) {
        (void)w.look(s, seen(stress, coordination), false);
        const boundaries::drives d = w.look(s, seen(stress, coordination), false); // the stress rises no more
        CHECK(inertia(2.0 * d.platens.max_speed / 0.3, counted) == Approx(expected));
        CHECK(inertia(d.lateral.max_speed / 0.07, counted) == Approx(expected));
        CHECK(d.lateral.how == boundaries::drive::mode::servo);
    };
    check(0.0, 3.0, 1e-3, 1e5);
    check(0.9e5, 3.0, 1e-3, 1e5);
    check(4e5, 4.0, 1e-3, 4e5);
    check(1.59e6, 4.0, 1e-3, 1.59e6);
    check(1.61e6, 4.0, 1e-4, 1.61e6);
    check(2e6, 4.0, 1e-4, 2e6);
    check(0.0, 0.9, 6e-4, 2e6); // no network yet: six times the rate of shear
    // about to pass that stress before the next look
    (void)w.look(s, seen(1.3e6, 4.0), false);
    CHECK(inertia(w.look(s, seen(1.5e6, 4.0), false).lateral.max_speed / 0.07, 1.5e6) == Approx(1e-4));
}

TEST_CASE("walls that have stopped set off gently, keep the shape of the specimen, and stop at its size") {
    const test_plan p = paper();
    wall_speed w(p, rho);
    const stage s = compaction();
    const double rate = w.packing_rate(), dt = 1e-5;
    w.begin(s, seen(0.0, 0.0));
    boundaries::drives d = w.look(s, seen(0.0, 0.0), true);
    CHECK(d.platens.value == Approx(0.5 * rate * 0.3));
    CHECK(d.lateral.value == Approx(rate * 0.07));
    CHECK(w.rates()[0] == Approx(rate)); // grains set off with them
    w.yield(d, s, {1e5, 1e9}, dt);       // far above 15 kPa: back, by the rule of the servo
    const double back = -0.5 * (1e5 - 15e3) / (1e9 * dt);
    CHECK(d.platens.value == Approx(std::max(back, -rate) * 0.15));
    CHECK(d.lateral.value == Approx(std::max(back, -rate) * 0.07));
    double last = d.lateral.value;
    for (int k = 0; k < 100; ++k) {
        w.yield(d, s, {0.0, 0.0}, dt);
        CHECK(d.lateral.value - last == Approx(rate * 0.07 / 200.0));
        CHECK(d.platens.value / 0.15 == Approx(d.lateral.value / 0.07));
        last = d.lateral.value;
    }
    // one axis has arrived: it holds, and the other goes on
    d = w.look(s, seen(0.0, 2.0, 0.28, 0.065), false);
    CHECK(d.platens.how == boundaries::drive::mode::hold);
    CHECK(d.lateral.how == boundaries::drive::mode::velocity);
    CHECK(w.way_left(s.axial, 0, 0.28) == 0.0);
    CHECK(w.way_left(s.lateral, 1, 0.065) == Approx(0.5));
    d = w.look(s, seen(0.0, 2.0, 0.28, 0.060001), false); // within this look: not beyond
    w.yield(d, s, {0.0, 0.0}, dt);
    CHECK(d.lateral.value <= 1e-6 / 1e-3);
}

TEST_CASE("walls that advance no more are seen as such, and another friction gives them time again") {
    const test_plan p = paper();
    wall_speed w(p, rho);
    const stage s = compaction();
    w.begin(s, seen(0.0, 0.0));
    CHECK(w.advance() == Approx(inertia(w.packing_rate(), 15e3)));
    for (int k = 0; k < 10; ++k) (void)w.look(s, seen(15e3, 4.0), k == 0);
    CHECK(w.advance() > p.jammed_inertial_number);
    for (int k = 0; k < 40; ++k) (void)w.look(s, seen(15e3, 4.0), false);
    CHECK(w.advance() < p.jammed_inertial_number);
    w.try_again(s);
    CHECK(w.advance() > 10.0 * p.jammed_inertial_number);
}
