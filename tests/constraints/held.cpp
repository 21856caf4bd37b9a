// SPDX-License-Identifier: MIT
#include <clast/constraints/held.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/constraints/none.hpp>
#include <clast/core/random.hpp>
#include <clast/engine/engine.hpp>
#include <clast/fields/gravity.hpp>
#include <clast/io/archive.hpp>
#include <clast/measure/digest.hpp>
#include <clast/measure/stress.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

static_assert(clast::constraints::holding<clast::constraints::held, clast::bodies::spheres>);

using namespace clast;

namespace {

constexpr double r = 0.01, k_n = 1e6;

template <class Body> struct held_in_space : scenes::unbreakable<boundaries::none> {
    using body = Body;
    using constraint = constraints::held;
};
using balls = held_in_space<bodies::spheres>;
using rocks = held_in_space<bodies::clumps>;
struct bare_balls : balls {
    using constraint = constraints::none;
};
struct heavy_balls : balls {
    using field = fields::gravity;
};
struct brittle : scenes::breakable<> {
    using constraint = constraints::held;
};

template <class P> engine<P> scene_of(typename P::body bodies, double damping, double safety = 0.1, int threads = 1) {
    const contacts::linear law{k_n, 5e5, 0.3};
    engine_settings<P> s{.grain_contact = law,
                         .platen_contact = law,
                         .lateral_contact = law,
                         .breakage = {},
                         .replacement = {},
                         .scheme = {.damping = damping},
                         .safety = safety};
    s.run = execution(threads);
    s.contacts_per_thread = 8;
    return engine<P>(s, std::move(bodies), spaces::open{});
}
/// Spheres in a row along x that touch.
bodies::spheres row(int count) {
    bodies::spheres s;
    for (int k = 0; k < count; ++k) s.add({2.0 * r * k, 0, 0}, r);
    return s;
}
template <class F> std::string message(F&& f) {
    try {
        f();
    } catch (const std::exception& e) {
        return e.what();
    }
    return {};
}

} // namespace

TEST_CASE("a chain driven at both ends shortens by what they go, and both carry its force") {
    engine<balls> e = scene_of<balls>(row(6), 0.3);
    const vec3 v{0.01, 0, 0};
    e.constraint.drive(0, v), e.constraint.drive(5, -v);
    double work = 0.0;
    while (e.time() < 0.005) {
        e.step();
        // each way is force times way
        work += e.dt() * (dot(e.constraint.reaction(0), v) - dot(e.constraint.reaction(5), v));
    }
    e.constraint.drive(0, {}), e.constraint.drive(5, {});
    e.step(60000);
    const double shorter = 2.0 * 0.01 * 0.005, force = k_n * shorter / 5.0;
    CHECK(e.grains.centre(5).x - e.grains.centre(0).x == Approx(10.0 * r - shorter).epsilon(1e-4));
    CHECK(e.constraint.reaction(0).x == Approx(force).epsilon(0.02));
    CHECK(e.constraint.reaction(5).x == Approx(-force).epsilon(0.02));
    CHECK(e.constraint.reaction(0).x == Approx(-e.constraint.reaction(5).x).epsilon(1e-6));
    // set in motion and stopped, which costs nothing in the sum
    CHECK(e.totals().boundary_work == Approx(work).epsilon(1e-9));
    CHECK(work > 0.0);
    CHECK(std::abs(scenes::residual(e)) < 3e-3 * work);
    CHECK(measure::contacts_of(e).unbalanced_ratio < 1e-5);
}

TEST_CASE("a fixed sphere returns another as a wall would") {
    bodies::spheres s = row(1);
    s.add({2.1 * r, 0, 0}, r);
    s.pebbles[1].v = {-0.5, 0, 0};
    engine<balls> e = scene_of<balls>(s, 0.0, 0.05);
    e.constraint.fix(0);
    double push = 0.0; // momentum that the fixed one took up
    while (e.time() < 0.02) {
        e.step();
        push += e.dt() * e.constraint.reaction(0).x;
    }
    CHECK(e.grains.velocity(1).x == Approx(0.5).epsilon(1e-4));
    CHECK(push == Approx(2.0 * 0.5 * e.grains.body_mass(1)).epsilon(1e-4));
    CHECK((e.grains.centre(0) == vec3{} && e.grains.velocity(0) == vec3{}));
    CHECK(e.totals().boundary_work == 0.0);
    CHECK(std::abs(scenes::residual(e)) < 5e-4 * e.kinetic_energy());
}

TEMPLATE_TEST_CASE("held bodies keep their velocity to the last bit, and damping takes nothing from them", "", balls,
                   rocks) {
    typename TestType::body s;
    if constexpr (TestType::body::turns) {
        s = scenes::empty(shapes::tetrahedron_4(circumscribed(2.0 * r)));
        s.add(0, {}, unit(quaternion{1, 0.2, 0.3, 0.4}));
        s.add(0, {0.3 * r, 0, 2.1 * r}, {});
    } else {
        s = row(1);
        s.add({0.3 * r, 0, 2.1 * r}, r);
    }
    engine<TestType> e = scene_of<TestType>(s, 0.7);
    const vec3 v{0.01, -0.02, 1.0 / 3.0};
    e.constraint.drive(0, v), e.constraint.lock(0);
    e.constraint.push(0, {3.0, 4.0, 5.0}, {0.1, 0.1, 0.1});
    const auto axes = e.grains.body_axes(0);
    bool touched = false;
    for (int k = 0; k < 100'000; ++k) {
        e.step();
        touched = touched || norm(e.constraint.reaction(0) + vec3{3.0, 4.0, 5.0}) > 1.0;
        if (e.grains.velocity(0) != v || e.grains.spin(0) != vec3{}) FAIL("step " << k);
    }
    CHECK(touched);
    CHECK(e.grains.losses[0].damping == 0.0);
    CHECK(norm(e.grains.centre(0) - e.time() * v) < 1e-9 * norm(e.time() * v));
    for (int i = 0; i < 3; ++i) CHECK(norm(e.grains.body_axes(0).row[i] - axes.row[i]) < 1e-12);
    // what is pushed is held back
    CHECK(norm(e.constraint.reaction(0) + vec3{3.0, 4.0, 5.0}) < 1e-9);
    CHECK(norm(e.constraint.reaction_moment(0) + vec3{0.1, 0.1, 0.1}) < 1e-9);
    CHECK(std::abs(scenes::residual(e)) < 1e-3 * e.kinetic_energy());
}

TEST_CASE("axes that are not prescribed are free: a sphere slides down a rail under its weight") {
    bodies::spheres s = row(1);
    engine<heavy_balls> e = scene_of<heavy_balls>(s, 0.0);
    e.settings.field.acceleration = {3.0, 0, -9.81};
    e.count_initial_energy();
    e.constraint.drive(0, {0, 2.0, 0}, {.x = false, .y = true, .z = true});
    while (e.time() < 0.1) e.step();
    const double t = e.time(), m = s.body_mass(0);
    CHECK(e.grains.velocity(0).x == Approx(3.0 * t).epsilon(1e-9));
    CHECK((e.grains.velocity(0).y == 2.0 && e.grains.velocity(0).z == 0.0));
    CHECK((e.constraint.reaction(0).x == 0.0 && e.constraint.reaction(0).y == 0.0));
    CHECK(e.constraint.reaction(0).z == Approx(9.81 * m));
    CHECK(e.totals().boundary_work == Approx(0.5 * m * 4.0)); // to set it off
    CHECK(std::abs(scenes::residual(e)) < 1e-12 * e.kinetic_energy());
}

TEST_CASE("a force and a moment from outside move a free body, and their work is booked") {
    engine<balls> e = scene_of<balls>(row(1), 0.0);
    e.constraint.push(0, {0.1, 0, 0}, {0, 0, 1e-4});
    while (e.time() < 0.05) e.step();
    const double t = e.time(), m = e.grains.body_mass(0), i = e.grains.body_inertia(0).x;
    CHECK(e.grains.velocity(0).x == Approx(0.1 * t / m));
    CHECK(e.grains.spin(0).z == Approx(1e-4 * t / i));
    CHECK(e.totals().boundary_work == Approx(e.kinetic_energy()).epsilon(1e-12));
    e.constraint.push(0, {});
    const vec3 v = e.grains.velocity(0);
    e.step(10);
    CHECK(e.grains.velocity(0) == v);
}

TEST_CASE("a prescribed spin drives a sphere's neighbour by friction, and of a clump it is refused") {
    bodies::spheres s = row(1);
    s.add({1.999 * r, 0, 0}, r);
    engine<balls> e = scene_of<balls>(s, 0.2);
    const double open = scenes::residual(e); // it begins loaded
    e.constraint.drive(0, {}), e.constraint.spin(0, {0, 0, 2.0});
    e.constraint.drive(1, {});
    double turned = 0.0;
    while (e.time() < 0.2) e.step(), turned += e.dt() * e.grains.spin(1).z;
    CHECK((e.grains.spin(0) == vec3{0, 0, 2.0}));
    CHECK(turned == Approx(-2.0 * e.time()).epsilon(0.01)); // they roll upon each other
    CHECK(e.totals().boundary_work > e.grains.kinetic_energy(1));
    CHECK(std::abs(scenes::residual(e) - open) < 0.01 * e.totals().boundary_work);

    bodies::clumps rock = scenes::empty(shapes::tetrahedron_4(circumscribed(2.0 * r)));
    rock.add(0, {}, {});
    engine<rocks> c = scene_of<rocks>(rock, 0.2);
    c.constraint.spin(0, {0, 0, 2.0});
    CHECK(message([&] { c.step(); }).find("clump 0") != std::string::npos);
}

TEST_CASE("a fixed body does not limit the time step, and one that is let go does at once") {
    bodies::spheres s = row(2);
    s.add({3.05 * r, 0, 0}, 0.1 * r); // a thousandth of the mass, squeezed
    const double usual = scene_of<balls>(row(2), 0.5).dt();
    engine<balls> e = scene_of<balls>(s, 0.5);
    const double small = e.dt();
    CHECK(small < 0.1 * usual);
    e.constraint.fix(1), e.constraint.fix(2); // so they stay squeezed
    e.step(10010);                            // not a multiple of the steps between two estimates
    CHECK(e.dt() > 5.0 * small);
    e.constraint.release(2);
    e.step();
    CHECK(e.dt() < 1.01 * small);
}

namespace {
/// A heap of spheres of which some are held in all ways.
engine<heavy_balls> heap(int threads) {
    bodies::spheres s;
    for (int k = 0; k < 216; ++k) {
        random_stream random{7, static_cast<std::uint64_t>(k)};
        const auto at = [](int i) { return 0.0195 * (i - 2.5); };
        s.add({at(k % 6), at(k / 6 % 6), at(k / 36)}, uniform(random, 0.009, 0.011));
    }
    engine<heavy_balls> e = scene_of<heavy_balls>(s, 0.1, 0.3, threads);
    for (std::size_t k = 0; k < 36; ++k) e.constraint.fix(35 - k);
    e.constraint.drive(100, {0.1, 0, 0}), e.constraint.spin(150, {0, 3, 0}), e.constraint.push(200, {0, 0, -1.0});
    return e;
}
} // namespace

TEST_CASE("threads and a checkpoint change no bit of a scene with constraints") {
    engine<heavy_balls> one = heap(1), three = heap(3);
    const double open = scenes::residual(one), there = one.elastic_energy(); // it begins loaded
    one.step(300), three.step(300);
    engine<heavy_balls> again = scene_of<heavy_balls>({}, 0.1, 0.3, 2);
    from_bytes(to_bytes(one), again);
    CHECK(again.constraint.reaction(3) == one.constraint.reaction(3));
    for (engine<heavy_balls>* e : {&one, &three, &again}) {
        e->constraint.release(3), e->constraint.drive(100, {0, 0.2, 0});
        e->step(300);
    }
    CHECK(measure::digest(three) == measure::digest(one));
    CHECK(measure::digest(again) == measure::digest(one));
    CHECK(three.totals().boundary_work == one.totals().boundary_work);
    CHECK(again.constraint.reaction(7) == one.constraint.reaction(7));
    CHECK(norm(one.constraint.reaction(7)) > 0.0);
    CHECK(one.totals().boundary_work != 0.0);
    CHECK(std::abs(scenes::residual(one) - open) < 1e-3 * there);
}

TEST_CASE("what cannot be held is refused with its name") {
    engine<balls> e = scene_of<balls>(row(2), 0.1);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(e.constraint.drive(0, {nan, 0, 0}), input_error);
    CHECK_THROWS_AS(e.constraint.push(0, {0, 0, 0}, {0, nan, 0}), input_error);
    CHECK_THROWS_AS(e.constraint.reaction(1), input_error);
    CHECK(!e.constraint.holds(0));
    e.constraint.fix(2);
    CHECK(message([&] { e.step(); }).find("body 2") != std::string::npos);
    e.constraint.release(2);
    CHECK_NOTHROW(e.step());
}

TEST_CASE("a held grain that breaks stops the run with its number") {
    engine<brittle> e = scenes::pressed<brittle>(scenes::settings<brittle>(1e15), 400.0);
    scenes::set_utilisation(e, 0.95);
    e.constraint.push(0, {0, 0, -0.1});
    CHECK(message([&] { e.step(200); }).find("grain 0 is held, but it has broken") != std::string::npos);
    CHECK(e.totals().replaced == 1);
}

TEST_CASE("without constraints a scene is not larger") {
    static_assert(std::is_empty_v<constraints::none>);
    static_assert(constraints::holding<constraints::held, bodies::clumps>);
    static_assert(simulator_policies<balls> && simulator_policies<brittle>);
    static_assert(sizeof(scene<balls>) == sizeof(scene<bare_balls>) + sizeof(constraints::held));
    SUCCEED("checked at compile time");
}
