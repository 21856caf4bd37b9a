// SPDX-License-Identifier: MIT
#include <clast/protocol/check_specimen.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <clast/measure/stress.hpp>

#include <catch.hpp>

#include "small_test.hpp"

using namespace clast;
using namespace small_test;

TEST_CASE("a NaN, an escaped grain and pebbles pressed into each other stop the run with an explanation") {
    {
        test_type test(setup(), {rest(2000)});
        test.sim().grains.motion[5].v.x = std::numeric_limits<double>::quiet_NaN();
        recorder watch;
        const failure f = failure_of(test, watch);
        check_complete(f);
        CHECK(f.where == "grain 5");
    }
    {
        test_type test(setup(), {rest(2000)});
        test.protocol().plan.look_every = 1; // the wall would throw it back
        test.sim().grains.motion[7].x = {0.3, 0.0, 0.0};
        recorder watch;
        const failure f = failure_of(test, watch);
        check_complete(f);
        CHECK(f.what.find("grain 7 escaped") != std::string::npos);
        CHECK(f.where.find("rest") != std::string::npos);
    }
    {
        test_type test(setup(), {rest(2000)});
        test.protocol().plan.look_every = 1;
        bodies::clumps& s = test.sim().grains;
        s.turning[1].q = s.turning[0].q;
        s.motion[1].x = s.motion[0].x + vec3{0.002, 0.0, 0.0};
        for (body_motion& m : s.motion) m.v = {};
        recorder watch;
        int step = 0;
        watch.pause = [&] { // held in place until the lists have seen it
            if (++step < 3) s.motion[1].x = s.motion[0].x + vec3{0.002, 0.0, 0.0};
        };
        const failure f = failure_of(test, watch);
        check_complete(f);
        CHECK(f.what.find("overlap") != std::string::npos);
    }
}

namespace {

constexpr double r = 0.01;

/// What the check says of grains in a cylinder of these half height and radius (m) after one step; nothing if it
/// passes. over: largest overlap over the smaller radius.
std::string verdict(bodies::clumps grains, double half_height, double radius, double& over) {
    boundaries::cylinder_settings c = scenes::cylinder(radius, 2.0 * half_height, 1e-3);
    engine<rigid> e(scenes::settings<rigid>(), std::move(grains), boundaries::solid_strips(c));
    e.step();
    const measure::contact_state now = measure::contacts_of(e);
    over = now.max_overlap_over_r;
    try {
        protocol::check_specimen(e, now, "here", [] { return std::string("step 1"); });
    } catch (const run_error& stopped) {
        check_complete(stopped.details);
        return stopped.details.what;
    }
    return {};
}
/// A sphere with six small ones that stand on it, along the axes.
shape studded(double ratio) {
    std::vector<shape_pebble> p{{{0, 0, 0}, r}};
    for (int a = 0; a < 3; ++a)
        for (const double side : {-1.0, 1.0}) {
            vec3 x;
            x[a] = side * (1.0 + ratio) * r;
            p.push_back({x, ratio * r});
        }
    return make_shape("studded", p);
}

} // namespace

TEST_CASE("studs that are pressed in where the sphere behind them takes the load are no alarm") {
    for (const double ratio : {0.1, 0.2}) {
        double over = 0.0;
        {
            // between platens that the sphere itself touches: studs are inside them by their whole diameter and more
            bodies::clumps one = scenes::empty(studded(ratio));
            one.add(0, {}, {});
            CHECK(verdict(std::move(one), 0.99 * r, 0.05, over).empty());
            CHECK(over == Approx(2.0 + 0.01 / ratio).epsilon(1e-6));
        }
        {
            // likewise at the lateral wall
            bodies::clumps one = scenes::empty(studded(ratio));
            one.add(0, {0.05 - 0.99 * r, 0, 0}, {});
            CHECK(verdict(std::move(one), 0.1, 0.05, over).empty());
            CHECK(over == Approx(2.0 + 0.01 / ratio).epsilon(1e-6));
        }
        {
            // two grains that touch by their large spheres, each with a stud inside the other
            bodies::clumps two = scenes::empty(studded(ratio));
            const quaternion away = scenes::turning({0, 0, 1}, unit(vec3{1, 0.1, 1}));
            two.add(0, {}, {});
            two.add(0, {0, 0, 1.95 * r}, away);
            CHECK(verdict(std::move(two), 0.1, 0.05, over).empty());
            CHECK(over > 2.0);
        }
    }
}

TEST_CASE("large pebbles that pass each other, a platen or the wall stop a run, and each is named") {
    const auto spheres = [](const std::vector<vec3>& at) {
        bodies::clumps s = scenes::empty(shapes::sphere(2.0 * r));
        for (const vec3& x : at) s.add(0, x, {});
        return s;
    };
    double over = 0.0;
    CHECK(verdict(spheres({{}, {0, 0, 1.02 * r}}), 0.1, 0.05, over).empty());
    CHECK(verdict(spheres({{}, {0, 0, 0.98 * r}}), 0.1, 0.05, over) == "pebbles 0 and 1 overlap by 10.2 mm");
    CHECK(over == Approx(1.02).epsilon(1e-9));
    CHECK(verdict(spheres({{0, 0, 0.1 - 0.02 * r}}), 0.1, 0.05, over).empty());
    CHECK(verdict(spheres({{0, 0, 0.1 + 0.02 * r}}), 0.1, 0.05, over) == "pebble 0 overlaps with a platen by 10.2 mm");
    CHECK(over == Approx(1.02).epsilon(1e-9));
    CHECK(verdict(spheres({{0.05 + 0.02 * r, 0, 0}}), 0.1, 0.05, over) ==
          "pebble 0 overlaps with the lateral wall by 10.2 mm");
    // a small sphere inside a large one is far from its centre; two small ones are not far from each other's
    bodies::clumps mixed;
    mixed.shapes = {shapes::sphere(2.0 * r), shapes::sphere(0.2 * r)};
    mixed.add(0, {}, {});
    mixed.add(1, {0, 0, 0.8 * r}, {});
    CHECK(verdict(std::move(mixed), 0.1, 0.05, over).empty());
    CHECK(over == Approx(3.0).epsilon(1e-9));
    bodies::clumps small;
    small.shapes = {shapes::sphere(0.2 * r)};
    small.add(0, {}, {});
    small.add(0, {0, 0, 0.09 * r}, {});
    CHECK(verdict(std::move(small), 0.1, 0.05, over) == "pebbles 0 and 1 overlap by 1.1 mm");
}
