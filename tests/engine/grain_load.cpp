// SPDX-License-Identifier: MIT
#include <clast/engine/grain_load.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <clast/boundaries/box.hpp>
#include <clast/criteria/octahedral.hpp>
#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {
struct by_stress : scenes::breakable<> {
    using breakage = criteria::octahedral;
};
constexpr double never = 1e15;
} // namespace

TEST_CASE("a clump that stands on three points is loaded most by the platen above it, which is one neighbour") {
    auto e = scenes::pressed(scenes::settings<by_stress>(never), 300.0);
    e.breakage_on = true;
    e.settings.replacement.check_interval = 1;
    e.step(); // with rows, indexed
    std::vector<vec3> forces;
    const criteria::grain_load load = rooms::load_of(e.state(), 0, forces);
    const double force = scenes::load(e);
    CHECK(force > 290.0);
    CHECK(load.diameter == Approx(0.02));
    // below: three contacts with one platen, added up as the force of one neighbour
    CHECK(load.largest_force == Approx(force).epsilon(1e-6));
    // mean stress of two forces F at the distance h: sigma_zz V = F h (compression positive); forces act where pebbles
    // would end without overlap, one contact above, three below
    const double volume = e.grains.shapes[0].volume, k = e.settings.platen_contact.kn;
    const double h = e.boundary.height() + force / k + force / (3.0 * k);
    CHECK(load.stress(2, 2) * volume == Approx(force * h).epsilon(1e-4));
    CHECK(std::abs(load.stress(0, 1)) < 1e-6 * load.stress(2, 2));
}

TEST_CASE("loads of pebbles are in balance, and their number is that of the pebbles") {
    auto e = scenes::pressed(scenes::settings<scenes::breakable<>>(never), 300.0);
    e.breakage_on = true;
    e.settings.replacement.check_interval = 1;
    e.step();
    const std::vector<bonds::pebble_load> loads = rooms::pebble_loads(e.state(), 0);
    REQUIRE(loads.size() == 4);
    vec3 force, moment;
    double sizes = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        force += loads[k].force;
        moment += loads[k].moment + cross(e.grains.pebbles[k].x - e.grains.centre(0), loads[k].force);
        sizes += norm(loads[k].force);
    }
    CHECK(sizes == Approx(2.0 * scenes::load(e)).epsilon(1e-6));
    CHECK(norm(force) < 1e-6 * sizes);
    CHECK(norm(moment) < 1e-6 * sizes * 0.01);
}

namespace {
/// Asks for all there is.
struct curious {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::everything;
    double utilisation(const criteria::grain_load& load) const { return 1e-9 * load.largest_force; }
};
struct by_all : scenes::breakable<> {
    using breakage = curious;
};
} // namespace

TEST_CASE("coordination, forces of neighbours and the largest contact are there if asked for, else zero") {
    bonds::parallel bond;
    engine_settings<by_all> s{.grain_contact = contacts::linear::between(scenes::pebble, scenes::pebble),
                              .platen_contact = contacts::linear::between(scenes::pebble, scenes::platen),
                              .lateral_contact = contacts::linear::between(scenes::pebble, scenes::membrane),
                              .breakage = {},
                              .replacement = {.bond = bond, .check_interval = 1}};
    auto e = scenes::pressed(s, 300.0);
    e.breakage_on = true;
    e.step();
    std::vector<vec3> forces;
    const criteria::grain_load load = rooms::load_of(e.state(), 0, forces);
    CHECK(load.coordination == 2);
    REQUIRE(load.neighbour_forces.size() == 2);
    CHECK(norm(load.neighbour_forces[0] + load.neighbour_forces[1]) < 1e-6 * load.largest_force);
    CHECK(norm(load.neighbour_forces[1]) == Approx(load.largest_force).epsilon(1e-6));
    CHECK(load.contact_at_wall);
    CHECK(load.contact_radius == e.grains.pebbles[0].radius);
    CHECK(load.grain == 0);
    CHECK(load.stress(2, 2) > 0.0);

    auto few = scenes::pressed(scenes::settings<scenes::breakable<>>(never), 300.0);
    few.breakage_on = true;
    few.settings.replacement.check_interval = 1;
    few.step();
    const criteria::grain_load less = rooms::load_of(few.state(), 0, forces);
    CHECK(less.largest_force == Approx(load.largest_force).epsilon(1e-6));
    CHECK((less.coordination == 0 && less.neighbour_forces.empty() && less.contact_radius == 0.0));
    CHECK((!less.contact_at_wall && less.stress(2, 2) == 0.0));
}

TEST_CASE("the largest contact of two grains is that of their pebbles, r1 r2 / (r1 + r2)") {
    bodies::clumps rock;
    rock.shapes = {shapes::sphere(0.02), shapes::sphere(0.01)};
    rock.add(0, {}, {});
    rock.add(1, {0.0149, 0, 0}, {});
    engine<by_all> e({.grain_contact = contacts::linear::between(scenes::pebble, scenes::pebble),
                      .platen_contact = {},
                      .lateral_contact = {},
                      .breakage = {},
                      .replacement = {.bond = {}, .check_interval = 1}},
                     std::move(rock), boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
    e.step();
    std::vector<vec3> forces;
    for (std::size_t g = 0; g < 2; ++g) {
        const criteria::grain_load load = rooms::load_of(e.state(), g, forces);
        CHECK(load.contact_radius == Approx(0.01 * 0.005 / 0.015).epsilon(1e-14));
        CHECK(!load.contact_at_wall);
        CHECK(load.coordination == 1);
    }
}

namespace {
/// Breaks the grain with the number 0, and asks for all there is.
struct first_alone : curious {
    double utilisation(const criteria::grain_load& load) const { return load.grain == 0 ? 2.0 : 0.0; }
};
template <class Boundary> struct by_all_in : by_all { using boundary = Boundary; };
struct first_breaks : scenes::breakable<> {
    using breakage = first_alone;
};
template <class P> engine_settings<P> settings_of() {
    return {.grain_contact = contacts::linear::between(scenes::pebble, scenes::pebble),
            .platen_contact = contacts::linear::between(scenes::pebble, scenes::platen),
            .lateral_contact = contacts::linear::between(scenes::pebble, scenes::membrane),
            .breakage = {},
            .replacement = {.bond = {}, .check_interval = 1}};
}
} // namespace

TEST_CASE("the lateral wall is one neighbour, whose force is the resultant of its facets") {
    // a sphere of 10 mm in the corner of two tiles of an octagon around 5 cm, 0.2 mm behind either plane
    const double r = 0.01, deep = 2e-4, half = std::numbers::pi / 8.0;
    bodies::clumps rock = scenes::empty(shapes::sphere(2.0 * r));
    const double out = (0.05 + deep - r) / std::cos(half);
    rock.add(0, {out * std::cos(half), out * std::sin(half), 0}, {});
    engine<by_all> e(settings_of<by_all>(), std::move(rock), boundaries::solid_strips(scenes::cylinder(0.05, 0.1)));
    e.step();
    std::vector<vec3> forces;
    const criteria::grain_load load = rooms::load_of(e.state(), 0, forces);
    // the way out is along the bisector, deep / cos(half) long; single tiles would push by 0.54 of the force
    const double force = contacts::linear::between(scenes::pebble, scenes::membrane).kn * deep / std::cos(half);
    CHECK(load.coordination == 1);
    CHECK(load.largest_force == Approx(force).epsilon(1e-9));
    REQUIRE(load.neighbour_forces.size() == 1);
    CHECK(load.neighbour_forces[0].x == Approx(-force * std::cos(half)).epsilon(1e-9));
    CHECK(load.neighbour_forces[0].y == Approx(-force * std::sin(half)).epsilon(1e-9));
}

TEST_CASE("walls of a box are neighbours of their own: opposite ones crush a grain") {
    using policies = by_all_in<boundaries::box>;
    const double r = 0.01, deep = 2e-4;
    bodies::clumps rock = scenes::empty(make_shape("two", {{{-r, 0, 0}, r}, {{r, 0, 0}, r}}));
    rock.add(0, {}, {});
    const double kn = settings_of<policies>().lateral_contact.kn, l = 2.0 * r - deep;
    engine<policies> e(settings_of<policies>(), std::move(rock),
                       boundaries::box({{-l, -0.1, -0.1}, {l, 0.1, 0.1}, 3.2e8, kn}));
    e.step();
    std::vector<vec3> forces;
    const criteria::grain_load load = rooms::load_of(e.state(), 0, forces);
    CHECK(load.coordination == 2);
    CHECK(load.largest_force == Approx(kn * deep).epsilon(1e-9));
}

TEST_CASE("a platen on two pebbles of a grain is one force, and its contacts have half of it each") {
    using policies = by_all_in<boundaries::box>;
    const double r = 0.01, deep = 2e-4, low = r - deep;
    bodies::clumps rock = scenes::empty(make_shape("two", {{{-r, 0, 0}, r}, {{r, 0, 0}, r}}));
    rock.add(0, {}, {});
    const double kn = settings_of<policies>().platen_contact.kn;
    engine<policies> e(settings_of<policies>(), std::move(rock),
                       boundaries::box({{-0.1, -0.1, -low}, {0.1, 0.1, low}, 3.2e8, kn}));
    e.step();
    std::vector<vec3> forces;
    const criteria::grain_load load = rooms::load_of(e.state(), 0, forces);
    CHECK(load.coordination == 2);
    CHECK(load.largest_force == Approx(2.0 * kn * deep).epsilon(1e-9));
    CHECK(load.largest_single == Approx(kn * deep).epsilon(1e-9));
}

TEST_CASE("a neighbour that has been replaced is one as long as its bonds hold") {
    // a tetrahedron on one tip, a sphere in the hollow of its three upper pebbles, squeezed by platens; then the
    // tetrahedron becomes a bonded cluster
    const shape four = shapes::tetrahedron_4(circumscribed(0.02));
    bodies::clumps rock = scenes::empty(four);
    rock.shapes.push_back(shapes::sphere(0.02));
    rock.add(0, {}, scenes::turning(unit(vec3{1, 1, 1}), {0, 0, -1}));
    double top = 0.0, off = 0.0;
    const double pebble = four.pebbles[0].radius;
    for (const auto& p : rock.pebbles)
        if (p.x.z > top) top = p.x.z, off = std::hypot(p.x.x, p.x.y);
    const double reach = 0.01 + pebble;
    rock.add(1, {0, 0, top + std::sqrt(reach * reach - off * off)}, {});
    boundaries::cylinder_settings c = scenes::cylinder_around(rock);
    engine<first_breaks> e(settings_of<first_breaks>(), std::move(rock), boundaries::solid_strips(c));
    e.breakage_on = false;
    e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 2e-3};
    while (scenes::load(e) < 300.0) e.step();
    e.drives.platens.how = boundaries::drive::mode::hold;
    e.step(300); // soon: on its tip it would topple
    e.breakage_on = true;
    while (e.totals().replaced == 0) e.step();
    e.step(300); // soon: on its tip it would topple
    REQUIRE(e.totals().replaced == 1);
    REQUIRE(e.totals().broken_tension + e.totals().broken_shear == 0);
    int balls = 0; // three of them touch the sphere
    e.each_contact([&](const auto& row, const auto& pair) {
        balls += row.depth > 0.0 && (e.grains.body_of(pair.i) == 1 || e.grains.body_of(pair.j) == 1);
    });
    CHECK(balls == 3);
    std::vector<vec3> forces;
    const criteria::grain_load load = rooms::load_of(e.state(), 1, forces);
    const double force = scenes::load(e); // of the platen above, and by statics of the cluster below
    CHECK(force > 250.0);
    CHECK(load.coordination == 2);
    REQUIRE(load.neighbour_forces.size() == 2);
    for (const vec3& f : load.neighbour_forces) CHECK(std::abs(f.z) == Approx(force).epsilon(1e-3));
    CHECK(load.largest_force == Approx(force).epsilon(1e-3));
}

TEST_CASE("friction of a wall turns a pebble by the arm that moves its clump: to the middle of the overlap") {
    auto s = scenes::settings<scenes::breakable<>>(never);
    s.platen_contact.mu = 0.3;
    auto e = scenes::pressed(s, 300.0);
    e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.02};
    e.step(3000); // deep
    e.grains.motion[0].v.x = 1.0;
    e.step(3); // and rubbing
    e.breakage_on = true;
    e.settings.replacement.check_interval = 1;
    e.step();
    const auto& state = e.state();
    REQUIRE(scenes::load(e) > 5000.0);
    const std::vector<bonds::pebble_load> loads = rooms::pebble_loads(state, 0);
    double most = 0.0;
    for (std::size_t k = 0; k < state.heavy_wall.size(); ++k) {
        const vec3& moment = state.heavy_grip[k].moment;
        CHECK(norm(loads[static_cast<std::size_t>(state.heavy_wall[k].pebble)].moment - moment) <= 1e-6 * norm(moment));
        most = std::max(most, norm(moment));
    }
    CHECK(most > 0.1);
}
