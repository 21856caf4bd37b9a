// SPDX-License-Identifier: MIT
#include <clast/boundaries/rigid_cylinder.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/concepts.hpp>
#include <clast/core/random.hpp>
#include <clast/io/archive.hpp>
#include <clast/measure/stress.hpp>
#include <clast/protocol/triaxial.hpp>
#include <clast/protocol/vessel.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;
using boundaries::bottom_platen;
using boundaries::drive;
using boundaries::drives;
using boundaries::facet_load;
using boundaries::rigid_cylinder;
using boundaries::rigid_cylinder_settings;
using boundaries::top_platen;
using boundaries::touches;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t at_wall = rigid_cylinder::wall;

using clumps_inside = scenes::unbreakable<rigid_cylinder>;
struct spheres_inside : clumps_inside {
    using body = bodies::spheres;
};
static_assert(boundaries::surface<rigid_cylinder> && protocol::vessel<rigid_cylinder>);
static_assert(triaxial_policies<clumps_inside> && simulator_policies<spheres_inside>);

/// Radius 0.1 m, height 0.3 m, pebbles of 10 mm radius, 1e6 N/m per contact.
rigid_cylinder_settings settings() {
    rigid_cylinder_settings s;
    s.radius = 0.1;
    s.bottom = -0.1;
    s.top = 0.2;
    s.largest_pebble = 0.01;
    s.contact_stiffness_floor = 1e6;
    return s;
}
drives moving(double platens, double lateral) {
    drives d;
    d.platens = {drive::mode::velocity, platens, 0.0, 0.5};
    d.lateral = {drive::mode::velocity, lateral, 0.0, 0.5};
    return d;
}
engine_settings<spheres_inside> sphere_settings() {
    return {.grain_contact = {1e6, 5e5, 0.3},
            .platen_contact = {2e6, 0.0, 0.0},
            .lateral_contact = {1e6, 0.0, 0.0},
            .breakage = {},
            .replacement = {}};
}
/// 40 clumps packed from a cloud by servo control to 100 kPa, at rest. mu: friction of the wall.
engine<clumps_inside> packed(double mu = 0.0) {
    const shape grain = shapes::tetrahedron_4(circumscribed(0.02));
    bodies::clumps sp = scenes::empty(grain);
    const double radius = 0.065;
    protocol::add_cloud(sp, 0, 40, {radius, -radius, radius}, 1);
    rigid_cylinder_settings s;
    s.radius = s.top = radius;
    s.bottom = -radius;
    s.largest_pebble = sp.pebbles[0].radius;
    auto laws = scenes::settings<clumps_inside>();
    laws.lateral_contact.mu = mu;
    s.contact_stiffness_floor = laws.lateral_contact.kn;
    engine<clumps_inside> e(laws, std::move(sp), rigid_cylinder(s));
    e.drives = scenes::isotropic(1e5, 0.5);
    e.step(6000);
    e.drives = scenes::isotropic(1e5, 0.02);
    e.step(6000);
    return e;
}

} // namespace

TEST_CASE("a sphere overlaps a rigid cylinder by r - (R - rho), along the radius, wherever it stands") {
    const rigid_cylinder b(settings());
    random_stream random{1, 0};
    for (int k = 0; k < 200; ++k) {
        const double r = 0.002 + 0.008 * uniform01(random), angle = 2 * pi * uniform01(random);
        const double depth = 0.2 * r * (uniform01(random) - 0.5), rho = 0.1 - r + depth;
        const vec3 outward{std::cos(angle), std::sin(angle), 0.0}, x = rho * outward + vec3{0, 0, 0.05};
        const touches t = b.touch(x, r);
        REQUIRE(t.size == (depth > 0.0 ? 1 : 0));
        if (depth <= 0.0) continue;
        CHECK(b.near(x, r));
        CHECK(t.at[0].facet == rigid_cylinder::wall);
        CHECK(t.at[0].along == 1.0);
        CHECK(t.at[0].depth == Approx(depth).margin(1e-16));
        CHECK(norm(t.at[0].normal + outward) < 1e-15);
    }
    // on the axis nothing is touched, at an end the platen is too, and beyond the wall the way is still inward
    CHECK(b.touch({0, 0, 0.05}, 0.01).size == 0);
    CHECK_FALSE(b.near({0, 0, 0.05}, 0.01));
    CHECK_FALSE(b.near({0.089, 0, 0.05}, 0.01));
    const touches edge = b.touch({0, -0.091, 0.195}, 0.01);
    REQUIRE(edge.size == 2);
    CHECK(edge.at[0].facet == top_platen);
    CHECK(edge.at[0].depth == Approx(0.005));
    CHECK(edge.at[1].normal == vec3{0, 1, 0});
    CHECK(edge.at[1].depth == Approx(0.001));
    CHECK(b.touch({0.105, 0, 0.05}, 0.01).at[0].depth == Approx(0.015));
    CHECK_FALSE(b.outside({0.109, 0, 0}, 0.01));
    CHECK(b.outside({0.0, 0.111, 0}, 0.01));
    CHECK(b.outside({0, 0, 0.211}, 0.01));
    CHECK(b.outside({std::nan(""), 0, 0}, 0.01));
    // a sphere that does not fit, which a setting has to lie for: no direction on the axis, and no number that is none
    CHECK(b.touch({0, 0, 0.05}, 0.12).size == 0);
    CHECK(b.near({0, 0, 0.05}, 0.12));
}

TEST_CASE("a rigid cylinder moves inward at its speeds, and area times speed is what it loses in volume") {
    rigid_cylinder b(settings());
    const std::vector<facet_load> loads(3);
    b.control(loads, moving(0.1, -0.05), 1e-3);
    CHECK(b.velocity(0) == 0.1);
    CHECK(b.velocity(1) == 0.1);
    CHECK(b.velocity(2) == -0.05);
    CHECK(b.fastest() == 0.1);
    CHECK(b.volume() == Approx(pi * 0.01 * 0.3).epsilon(1e-14));
    double rate = 0.0;
    for (int f = 0; f < 3; ++f) rate += b.area(f) * b.velocity(f);
    const double before = b.volume();
    const double wall_ahead = b.touch({0.0, 0.1, 0.05}, 0.01, 0.1).at[0].depth;
    const double platen_ahead = b.touch({0.0, 0.0, -0.09}, 0.01, 0.1).at[0].depth;
    b.advance(1e-7);
    CHECK((before - b.volume()) / 1e-7 == Approx(rate).epsilon(1e-5));
    b.advance(0.1 - 1e-7);
    CHECK(b.radius() == Approx(0.105).epsilon(1e-14));
    CHECK(b.height() == Approx(0.28).epsilon(1e-14));
    CHECK(b.bottom() == Approx(-0.09).epsilon(1e-14));
    CHECK(b.top() == Approx(0.19).epsilon(1e-14));
    CHECK(b.section() == Approx(pi * 0.105 * 0.105).epsilon(1e-14));
    CHECK(b.touch({0.0, 0.1, 0.05}, 0.01).at[0].depth == Approx(wall_ahead).epsilon(1e-12));
    CHECK(wall_ahead == Approx(0.005).epsilon(1e-12));
    CHECK(b.touch({0.0, 0.0, -0.09}, 0.01).at[0].depth == Approx(platen_ahead).epsilon(1e-12));
}

TEST_CASE("the wall of a rigid cylinder follows its mean stress, the platens that of both ends") {
    rigid_cylinder b(settings());
    const double side = 2 * pi * 0.1 * 0.3, end = pi * 0.01;
    std::vector<facet_load> loads(3);
    loads[0] = {0.9e5 * end, 1e7, 3};
    loads[1] = {1.1e5 * end, 2e7, 3};
    loads[at_wall] = {2e5 * side, 4e7, 5};
    CHECK(b.axial_stress(loads) == Approx(1e5).epsilon(1e-14));
    CHECK(b.lateral_stress(loads) == Approx(2e5).epsilon(1e-14));
    drives d;
    d.platens = {drive::mode::servo, 1e5, 0.1, 0.5};
    d.lateral = {drive::mode::servo, 2e5, 0.1, 0.4};
    b.control(loads, d, 1e-3);
    CHECK(b.fastest() < 1e-12);
    loads[at_wall].force += 100.0; // gives way by gain * 100 N / K
    loads[0].force -= 60.0;        // and the ends close by gain * 30 N / (1.5e7 N/m)
    b.control(loads, d, 1e-3);
    CHECK(b.velocity(2) == Approx(-0.4 * 100.0 / 4e7 / 1e-3).epsilon(1e-9));
    CHECK(b.velocity(0) == Approx(0.5 * 30.0 / 1.5e7 / 1e-3).epsilon(1e-9));
    CHECK(b.velocity(1) == b.velocity(0));
    CHECK(b.confining_error(loads, 2e5) == Approx(100.0 / (2e5 * side)).epsilon(1e-9));
    CHECK(b.power(loads) ==
          Approx(loads[at_wall].force * b.velocity(2) + (loads[0].force + loads[1].force) * b.velocity(0))
              .epsilon(1e-14));
    b.control(std::vector<facet_load>(3), d, 1e-3); // nothing touched: all search at their limit
    CHECK(b.velocity(0) == 0.1);
    CHECK(b.velocity(2) == 0.1);
    d.lateral.max_speed = 0.0;
    CHECK_THROWS_AS(b.control(loads, d, 1e-3), input_error);
}

TEST_CASE("a sphere pressed into the wall: the force is k times the overlap, the stress that over 2 pi R H") {
    bodies::spheres one;
    const double depth = 1e-5;
    one.add((0.09 + depth) * vec3{0.6, -0.8, 0.0}, 0.01);
    engine<spheres_inside> e(sphere_settings(), one, rigid_cylinder(settings()));
    e.step();
    CHECK(e.loads()[at_wall].force == Approx(1e6 * depth).epsilon(1e-10));
    CHECK(e.loads()[at_wall].stiffness == Approx(1e6));
    CHECK(e.loads()[at_wall].contacts == 1);
    CHECK(e.boundary.lateral_stress(e.loads()) == Approx(10.0 / (2 * pi * 0.1 * 0.3)).epsilon(1e-10));
    CHECK(e.boundary.axial_stress(e.loads()) == 0.0);
    e.each_wall_row([&](const boundaries::wall_row& w) { CHECK(norm(w.force - vec3{-6, 8, 0}) < 1e-8); });
    CHECK(unit(e.grains.pebbles[0].v).x == Approx(-0.6).epsilon(1e-12));
}

TEST_CASE("a ring of spheres that a rigid cylinder closes upon stays a ring, to 1e-12") {
    constexpr int n = 12;
    bodies::spheres ring;
    for (int i = 0; i < n; ++i) ring.add(0.0895 * vec3{std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0.0}, 0.01);
    engine<spheres_inside> e(sphere_settings(), ring, rigid_cylinder(settings()));
    e.drives = moving(0.0, 0.2);
    double impulse = 0.0, work = 0.0;
    while (e.time() < 0.1) {
        e.step();
        impulse += e.loads()[at_wall].force * e.dt();
        work += e.loads()[at_wall].force * e.boundary.velocity(2) * e.dt();
    }
    CHECK(e.boundary.radius() == Approx(0.08).epsilon(1e-3));
    double nearest = 1.0, farthest = 0.0;
    vec3 momentum, force;
    for (std::size_t i = 0; i < n; ++i) {
        const auto& p = e.grains.pebbles[i];
        nearest = std::min(nearest, std::hypot(p.x.x, p.x.y)), farthest = std::max(farthest, std::hypot(p.x.x, p.x.y));
        momentum += p.v / p.inverse_mass;
        CHECK(p.x.z == 0.0);
    }
    e.each_wall_row([&](const boundaries::wall_row& w) { force += w.force; });
    CHECK(impulse > 0.0);
    CHECK(farthest < 0.0701);
    CHECK(farthest - nearest < 1e-12 * farthest);
    CHECK(norm(momentum) < 1e-12 * impulse);
    CHECK(norm(force) < 1e-12 * n * 1e6 * 1e-4);
    CHECK(e.totals().boundary_work == Approx(work).epsilon(1e-9)); // at one speed: force times speed
}

TEST_CASE("in a rigid cylinder a packing of clumps takes the stress that is asked for, and the audit closes") {
    engine<clumps_inside> e = packed();
    const auto& b = e.boundary;
    CHECK(b.axial_stress(e.loads()) == Approx(1e5).epsilon(1e-3));
    CHECK(b.lateral_stress(e.loads()) == Approx(1e5).epsilon(1e-3));
    const mat3 lw = measure::love_weber(e, b.volume());
    CHECK(lw(2, 2) == Approx(b.axial_stress(e.loads())).epsilon(1e-4));
    CHECK(0.5 * (lw(0, 0) + lw(1, 1)) == Approx(b.lateral_stress(e.loads())).epsilon(1e-4));

    const double work = e.totals().boundary_work, open = scenes::residual(e);
    e.drives = scenes::isotropic(8e5, 0.02);
    e.step(6000);
    CHECK(b.axial_stress(e.loads()) == Approx(8e5).epsilon(0.01));
    CHECK(b.lateral_stress(e.loads()) == Approx(8e5).epsilon(0.01));
    CHECK(std::abs(scenes::residual(e) - open) < 2e-4 * (e.totals().boundary_work - work));
}

TEST_CASE("a rough rigid cylinder stands still along the axis, and the audit with its friction closes") {
    engine<clumps_inside> e = packed(0.3);
    const double work = e.totals().boundary_work, open = scenes::residual(e);
    e.drives = scenes::isotropic(8e5, 0.02);
    e.step(6000);
    CHECK(e.boundary.lateral_stress(e.loads()) == Approx(8e5).epsilon(0.01));
    CHECK(std::abs(scenes::residual(e) - open) < 2e-4 * (e.totals().boundary_work - work));
    e.drives = moving(0.1, 0.0); // with the wall at rest all work is that of the platens
    e.step();                    // from the servo's speed to this one
    const double before = e.totals().boundary_work;
    double done = 0.0, rubbed = 0.0;
    for (int k = 0; k < 100; ++k) {
        e.step();
        done += 0.1 * (e.loads()[bottom_platen].force + e.loads()[top_platen].force) * e.dt();
        e.each_wall_row([&](const boundaries::wall_row& w) { rubbed += norm(w.friction); });
    }
    CHECK(rubbed > 0.0);
    CHECK(e.totals().boundary_work - before == Approx(done).epsilon(1e-9));
}

TEST_CASE("a triaxial test runs in a rigid cylinder, from cloud to shear") {
    using namespace literals;
    triaxial_setup<clumps_inside> setup{.grain = shapes::tetrahedron_4(circumscribed(0.02)),
                                        .diameter = 9_cm,
                                        .height = 10_cm,
                                        .confining = 200_kPa,
                                        .breakage = {},
                                        .replacement = {},
                                        .inertial_number = 1e-3};
    triaxial_test<clumps_inside> test(setup, protocol::triaxial_compression(1_percent));
    // grains by the porosity in the round section
    const double volume = 0.25 * std::numbers::pi * 0.09 * 0.09 * 0.1;
    CHECK(test.sim().grains.solid_volume() == Approx((1.0 - setup.porosity) * volume).epsilon(0.02));
    observer silent;
    REQUIRE(test.run(silent));
    const sample s = test.protocol().measure();
    CHECK(s.axial_strain == Approx(0.01).epsilon(0.05));
    CHECK(s.sigma_3 == Approx(2e5).epsilon(0.05));
    CHECK(s.q > 2e4);
    CHECK(test.protocol().facets().size() == 38);
}

TEST_CASE("a rigid cylinder that no pebble fits into is refused by name, or stops the run") {
    const auto refusal = [](const std::function<void(rigid_cylinder_settings&)>& change) {
        rigid_cylinder_settings s = settings();
        change(s);
        try {
            const rigid_cylinder b(s);
        } catch (const input_error& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    CHECK(refusal([](rigid_cylinder_settings&) {}).empty());
    const auto names = [](const std::string& text, const char* member) {
        INFO(text);
        CHECK(text.find(std::string("rigid_cylinder_settings.") + member) == 0);
        CHECK(text.find("Allowed") != std::string::npos);
    };
    names(refusal([](rigid_cylinder_settings& s) { s.radius = 0.01; }), "radius");
    names(refusal([](rigid_cylinder_settings& s) { s.radius = std::numeric_limits<double>::infinity(); }), "radius");
    names(refusal([](rigid_cylinder_settings& s) { s.bottom = std::nan(""); }), "bottom");
    names(refusal([](rigid_cylinder_settings& s) { s.top = -0.095; }), "top");
    names(refusal([](rigid_cylinder_settings& s) { s.largest_pebble = 0.0; }), "largest_pebble");
    names(refusal([](rigid_cylinder_settings& s) { s.platen_stiffness = 0.0; }), "platen_stiffness");
    names(refusal([](rigid_cylinder_settings& s) { s.wall_stiffness = 0.0; }), "wall_stiffness");
    names(refusal([](rigid_cylinder_settings& s) { s.contact_stiffness_floor = 0.0; }), "contact_stiffness_floor");

    const std::vector<facet_load> loads(3);
    rigid_cylinder closing(settings());
    closing.control(loads, moving(0.0, 0.1), 1e-3);
    closing.advance(0.89);
    CHECK_THROWS_AS(closing.advance(0.02), run_error);
    rigid_cylinder flat(settings());
    flat.control(loads, moving(0.1, 0.0), 1e-3);
    flat.advance(1.4);
    CHECK_THROWS_AS(flat.advance(0.1), run_error);
}

TEST_CASE("a rigid cylinder is drawn as strips with its area and load, and comes back from an archive") {
    rigid_cylinder b(settings());
    std::vector<facet_load> loads(3);
    loads[bottom_platen].force = 10.0;
    loads[at_wall].force = 36.0;
    b.control(loads, moving(0.01, 0.02), 1e-3);
    b.advance(0.1);
    const auto view = b.view(loads);
    REQUIRE(view.size() == 38);
    double area = 0.0, force = 0.0;
    for (const facet_view& f : view) {
        if (f.ring < 0) continue;
        area += f.area, force += f.area * f.pressure;
        for (const vec3& c : f.corner) CHECK(std::hypot(c.x, c.y) == Approx(b.radius()).epsilon(1e-14));
        CHECK(f.corner[0].z == b.bottom());
        CHECK(f.corner[3].z == b.top());
    }
    CHECK(area == Approx(b.area(2)).epsilon(1e-14));
    CHECK(force == Approx(36.0).epsilon(1e-12));
    CHECK(view[0].pressure * b.section() == Approx(10.0));
    CHECK(view[0].corner[0].z == b.bottom());
    CHECK(view[1].pressure == 0.0);

    rigid_cylinder_settings other = settings();
    other.radius = 0.2;
    rigid_cylinder copy(other);
    from_bytes(to_bytes(b), copy);
    CHECK(checksum(copy) == checksum(b));
    CHECK(copy.volume() == b.volume());
    CHECK(copy.velocity(2) == 0.02);
    CHECK(copy.settings().radius == 0.1);
}
