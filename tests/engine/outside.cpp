// SPDX-License-Identifier: MIT
#include <clast/engine/outside.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/constraints/held.hpp>
#include <clast/engine/engine.hpp>
#include <clast/fields/gravity.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

struct pulled : scenes::unbreakable<boundaries::none> {
    using body = bodies::spheres;
    using field = fields::gravity;
    using constraint = constraints::held;
};
engine<pulled> two() {
    bodies::spheres s;
    s.add({}, 0.01);
    s.add({0.0, 0.0, 0.05}, 0.01);
    return engine<pulled>(scenes::settings<pulled>(), s, spaces::open{});
}

} // namespace

TEST_CASE("the energy to set a velocity, and the work while it is kept, are work of the boundary") {
    scene<pulled> s = two().state();
    const double m = s.grains.body_mass(0);
    s.constraint.drive(0, {0.0, 0.0, 2.0});
    rooms::begin_constraint(s);
    CHECK((s.grains.velocity(0) == vec3{0.0, 0.0, 2.0}));
    CHECK(s.totals.boundary_work == Approx(2.0 * m));
    CHECK(s.estimate_due);
    s.estimate_due = false;
    s.constraint.drive(0, {0.0, 0.0, 1.0}); // slower, but held in the same way: dt need not be found again
    rooms::begin_constraint(s);
    CHECK(s.totals.boundary_work == Approx(0.5 * m));
    CHECK(!s.estimate_due);
    (void)rooms::sweep(s, {1.0, 1.0}, s.dt, true, [](std::size_t, range_work&) {});
    rooms::end_constraint(s);
    CHECK(s.totals.boundary_work == Approx(0.5 * m + 9.81 * m * s.dt)); // carried up against its weight
}

TEST_CASE("outer forces are weight, pushes and reactions, of every body") {
    engine<pulled> e = two();
    const double weight = 9.81 * e.grains.body_mass(0);
    e.constraint.fix(0);
    e.constraint.push(1, {1.0, 0.0, 0.0});
    e.step();
    std::vector<vec3> sum(2);
    e.each_outer_force([&](std::size_t body, const vec3& f) { sum[body] += f; });
    CHECK(sum[0] == vec3{}); // it hangs
    CHECK(norm(sum[1] - vec3{1.0, 0.0, -weight}) < 1e-12);
}

TEST_CASE("where nothing acts from outside nothing is asked") {
    static_assert(!scene<scenes::unbreakable<>>::has_outer_forces && scene<pulled>::has_outer_forces);
    engine<scenes::unbreakable<>> e = scenes::collision(scenes::settings<scenes::unbreakable<>>());
    int calls = 0;
    e.each_outer_force([&](std::size_t, const vec3&) { ++calls; });
    CHECK(calls == 0);
}
