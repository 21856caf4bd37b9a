// SPDX-License-Identifier: MIT
#include <clast/protocol/stage.hpp>

#include <vector>

#include <catch.hpp>

using namespace clast;
using namespace clast::literals;

TEST_CASE("conditions are met at their limits and not before, and say so in words") {
    stage_view v;
    const auto check = [&](const condition& c, double& value, double before, double after) {
        INFO(c.text);
        value = before;
        CHECK_FALSE(c.met(v));
        CHECK(c.progress(v) < 1.0);
        CHECK(c.progress(v) >= 0.0);
        value = after;
        CHECK(c.met(v));
        CHECK(c.progress(v) == 1.0);
    };
    check(until::axial_strain(25_percent), v.axial_strain, 0.2499, 0.25);
    check(until::deviator_below(10_kPa), v.q, 10.1e3, 10e3);
    check(until::unbalanced_below(1e-3), v.unbalanced_ratio, 1.1e-3, 0.9e-3);
    check(until::spheres_below(1_kPa), v.sphere_stress, 1001.0, 999.0);
    check(until::size_reached(), v.travel_left, 0.01, 0.0);
    check(until::coordination_below(1.0), v.coordination, 1.1, 0.9);
    v.confining = 2e6;
    check(until::kinetic_below_of_setup(1e-7), v.kinetic_density, 0.21, 0.19);
    CHECK(until::axial_strain(25_percent).text == "axial strain 25 %");
    CHECK(until::deviator_below(10_kPa).text == "q <= 10 kPa");

    v.steps = 5000;
    check(until::unloaded(0.8_N), v.mean_contact_force, 0.9, 0.7);
    v.steps = 10;
    CHECK_FALSE(until::unloaded(0.8_N).met(v)); // a start that no contact has felt yet is not rest
    CHECK_FALSE(until::unloaded_of_setup(1e-3).met(v));

    v.axial_error = 0.0;
    check(until::stresses_within(1e-3), v.confining_error, 2e-3, 5e-4);
    check(until::stresses_within(1e-3), v.axial_error, 2e-3, 5e-4);

    v.steps = 99;
    CHECK_FALSE(until::steps(100).met(v));
    CHECK(until::steps(100).progress(v) == Approx(0.99));
    v.steps = 100;
    CHECK(until::steps(100).met(v));
}

TEST_CASE("a strain is reached from the side on which the stage began") {
    stage_view v;
    const condition extended = until::axial_strain(-2_percent);
    CHECK_FALSE(extended.met(v));
    CHECK(extended.progress(v) == 0.0);
    v.axial_strain = -0.0199;
    CHECK_FALSE(extended.met(v));
    CHECK(extended.progress(v) == Approx(0.995));
    v.axial_strain = -0.0201;
    CHECK(extended.met(v));
    // back from 3 % to 1 %
    v.strain_at_start = v.axial_strain = 0.03;
    const condition back = until::axial_strain(1_percent);
    CHECK_FALSE(back.met(v));
    v.axial_strain = 0.02;
    CHECK_FALSE(back.met(v));
    CHECK(back.progress(v) == Approx(0.5));
    v.axial_strain = 0.01;
    CHECK(back.met(v));
    // what both need is needed, what one needs is not
    CHECK(*(back && until::steps(5)).needed_strain == 0.01);
    CHECK(*(until::steps(5) && back).needed_strain == 0.01);
    CHECK_FALSE((back || until::steps(5)).needed_strain);
}

TEST_CASE("limits in parts of the setup follow its stress and its grains") {
    stage_view v;
    v.steps = 5000;
    v.confining = 2e6, v.grain_diameter = 0.02; // the paper's: 1 kPa, and a thousandth of 800 N
    CHECK(v.grain_force() == Approx(800.0));
    const condition calm = until::spheres_below_of_setup(5e-4), loose = until::unloaded_of_setup(1e-3);
    CHECK(calm.text == "p' < 0.05 % of the confining stress in three spheres");
    CHECK(loose.text == "mean contact force < 0.1 % of sigma_3 d^2");
    const auto limits = [&](double stress, double force) {
        v.sphere_stress = 1.01 * stress, v.mean_contact_force = 1.01 * force;
        CHECK_FALSE(calm.met(v));
        CHECK_FALSE(loose.met(v));
        CHECK(calm.progress(v) < 1.0);
        CHECK(loose.progress(v) < 1.0);
        v.sphere_stress = 0.99 * stress, v.mean_contact_force = 0.99 * force;
        CHECK(calm.met(v));
        CHECK(loose.met(v));
        CHECK(calm.progress(v) == 1.0);
        CHECK(loose.progress(v) == 1.0);
    };
    limits(1e3, 0.8);
    v.confining = 2e5, v.grain_diameter = 0.2;
    limits(1e2, 8.0);
}

TEST_CASE("conditions join by and, by or, and the progress follows") {
    stage_view v;
    v.axial_strain = 0.1;
    v.steps = 50;
    const condition both = until::axial_strain(10_percent) && until::steps(100);
    const condition either = until::axial_strain(10_percent) || until::steps(100);
    CHECK_FALSE(both.met(v));
    CHECK(either.met(v));
    CHECK(both.progress(v) == Approx(0.5));
    CHECK(either.progress(v) == 1.0);
    CHECK(both.text == "axial strain 10 % and 100 steps");
    CHECK(both.reason(v) == "axial strain 10 % and 100 steps");
    CHECK(either.reason(v) == "axial strain 10 %"); // the way that was met
    CHECK((either && until::steps(50)).reason(v) == "axial strain 10 % and 50 steps");
    CHECK(either.text == "axial strain 10 % or 100 steps");
    v.steps = 100;
    CHECK(both.met(v));
    v.axial_strain = 0.0;
    CHECK_FALSE(both.met(v));
}

TEST_CASE("what a step can show is asked after every step, what only a look finds is not") {
    for (const condition& c : {until::axial_strain(1_percent), until::deviator_below(1_kPa), until::steps(5)})
        CHECK(c.every_step);
    for (const condition& c :
         {until::size_reached(), until::unbalanced_below(1e-3), until::spheres_below(1_kPa),
          until::spheres_below_of_setup(1e-3), until::unloaded(1_N), until::unloaded_of_setup(1e-3),
          until::stresses_within(1e-3), until::stresses_within(1e-3) && until::unbalanced_below(1e-3)})
        CHECK_FALSE(c.every_step);
    CHECK((until::steps(5) || until::unbalanced_below(1e-3)).every_step);
    const condition own{"own", [](const stage_view& v) { return v.q > 0.0; }, [](const stage_view&) { return 0.0; }};
    CHECK(own.every_step);
}

TEST_CASE("a peak is past when q has dropped by a share of it, and conditions keep their numbers apart") {
    std::vector<double> memory(1, 0.0);
    stage_view v;
    v.confining = 1e5, v.memory = memory;
    const condition c = until::peak_passed(10_percent);
    CHECK(c.memory == 1);
    CHECK(c.text == "q 10 % below its peak");
    const auto at = [&](const condition& one, double q) {
        v.q = q;
        return one.met(v);
    };
    CHECK_FALSE(at(c, 9e3)); // less than a tenth of the confining stress is no peak
    CHECK_FALSE(at(c, 5e3));
    CHECK_FALSE(at(c, 50e3));
    CHECK_FALSE(at(c, 100e3));
    CHECK_FALSE(at(c, 91e3));
    CHECK(c.progress(v) == Approx(0.9));
    CHECK(at(c, 90e3));
    CHECK(memory[0] == 100e3);
    // two of them in one: each counts by itself, and is asked though the other decides
    const condition two = (until::steps(5) || until::peak_passed(10_percent)) && until::peak_passed(20_percent);
    CHECK(two.memory == 2);
    memory.assign(2, 0.0), v.memory = memory;
    CHECK_FALSE(at(two, 100e3));
    CHECK((memory[0] == 100e3 && memory[1] == 100e3));
    CHECK_FALSE(at(two, 85e3));
    CHECK(at(two, 80e3));
    v.steps = 5;
    memory.assign(2, 0.0);
    CHECK_FALSE(at(two, 100e3));
    CHECK((memory[0] == 100e3 && memory[1] == 100e3));
    CHECK(at(until::deviator_above(80_kPa), 80e3));
    CHECK_FALSE(at(until::deviator_above(80_kPa), 79.9e3));
    CHECK(until::deviator_above(80_kPa).progress(v) == Approx(0.99875));
}

TEST_CASE("progress of a quantity that falls over decades grows with every decade") {
    stage_view v;
    const condition c = until::unbalanced_below(1e-3);
    double last = -1.0;
    for (const double u : {10.0, 1.0, 0.1, 0.01, 0.002}) {
        v.unbalanced_ratio = u;
        CHECK(c.progress(v) >= last);
        CHECK(c.progress(v) < 1.0);
        last = c.progress(v);
    }
    CHECK(last > 0.8);
}

TEST_CASE("drives are made from quantities in SI") {
    CHECK(drive_by::hold().how == axis_drive::kind::hold);
    CHECK(drive_by::strain_rate(0.1_per_s).value == Approx(0.1));
    CHECK(drive_by::stress(2_MPa).value == Approx(2e6));
    CHECK(drive_by::stress(2_MPa).how == axis_drive::kind::stress);
    CHECK(drive_by::inertial_number(-1e-4).value == -1e-4);
    CHECK(drive_by::size(30_cm).value == Approx(0.3));
    CHECK(drive_by::size(30_cm).how == axis_drive::kind::reach);
}
