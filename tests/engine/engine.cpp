// SPDX-License-Identifier: MIT
#include <clast/engine/engine.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include <clast/io/archive.hpp>
#include <clast/measure/digest.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using rigid = scenes::unbreakable<>;

vec3 angular_momentum(const bodies::clumps& s) {
    vec3 l;
    for (std::size_t g = 0; g < s.grain_count(); ++g)
        l += s.mass_of(s.grains[g]) * cross(s.motion[g].x, s.motion[g].v) + s.turning[g].l;
    return l;
}
/// Plain double and if, no friction, nothing remembered: what a user would write first.
struct soft_ball {
    struct history {};
    double k = 0.0;
    double mu = 0.0; // set_friction writes it
    contacts::response<double> operator()(const contacts::overlap<double>& o, const contacts::motion<double>&, history&,
                                          double) const {
        if (o.depth <= 0.0) return {0, 0, 0, 0};
        const double f = k * std::pow(o.depth, 1.5);
        return {-f * o.nx, -f * o.ny, -f * o.nz, 0.0};
    }
    double stored(const contacts::overlap<double>& o, const history&) const {
        return o.depth > 0.0 ? 0.4 * k * std::pow(o.depth, 2.5) : 0.0;
    }
    double normal_stiffness(const contacts::overlap<double>&) const { return 2e6; }
    double shear_stiffness(const contacts::overlap<double>&) const { return 0.0; }
};
struct soft : rigid {
    using contact = soft_ball;
};
} // namespace

TEST_CASE("two clumps that collide keep momentum and angular momentum to rounding, friction included") {
    auto s = scenes::settings<rigid>();
    s.scheme.damping = 0.0;
    engine<rigid> e = scenes::collision(s);
    const vec3 p = scenes::momentum(e.grains), l = angular_momentum(e.grains);
    double deepest = 0.0;
    for (int k = 0; k < 1500; ++k) {
        e.step();
        e.each_contact([&](const force_row& row, const pebble_pair&) { deepest = std::max(deepest, row.depth); });
    }
    CHECK(deepest > 1e-5); // they met
    CHECK(norm(scenes::momentum(e.grains) - p) < 1e-13 * (norm(p) + 4e-3));
    CHECK(norm(angular_momentum(e.grains) - l) < 1e-13 * norm(l));
    CHECK(e.losses().friction > 0.0);
    CHECK(e.losses().damping == 0.0);
}

TEST_CASE("a contact law of plain doubles, without history, works and costs no memory for one") {
    const soft_ball law{2e7};
    engine_settings<soft> s{.grain_contact = law,
                            .platen_contact = law,
                            .lateral_contact = law,
                            .breakage = {},
                            .replacement = {},
                            .scheme = {.damping = 0.0},
                            .safety = 0.05};
    engine<soft> e = scenes::collision(s);
    const vec3 p = scenes::momentum(e.grains);
    const double before = e.kinetic_energy();
    double stored = 0.0;
    while (e.time() < 0.02) {
        e.step();
        stored = std::max(stored, e.elastic_energy());
    }
    CHECK(stored > 0.05 * before);
    CHECK(e.heavy_contacts().history.empty());
    CHECK(e.kinetic_energy() == Approx(before).epsilon(1e-3));
    CHECK(norm(scenes::momentum(e.grains) - p) < 1e-13 * (norm(p) + 4e-3));
}

TEST_CASE("what is absent takes no memory: an unbreakable scene has no balls, no bonds and no events") {
    static_assert(!engine<rigid>::breakable && !engine<rigid>::has_criterion);
    static_assert(engine<scenes::breakable<>>::breakable);
    static_assert(sizeof(engine<scenes::breakable<>>) >= sizeof(engine<rigid>) + sizeof(breakage_state) - 16);
    static_assert(std::is_empty_v<criteria::none> && std::is_empty_v<replacements::none>);
    static_assert(!contact_list<soft_ball::history>::remembers);
    auto s = scenes::settings<rigid>();
    engine<rigid> e = scenes::collision(s);
    CHECK(e.grains.motion.size() == 2); // not one more per pebble
    CHECK(e.grains.losses.size() == 2);
    CHECK(e.light_contacts().pairs.capacity() == 0);
    CHECK(e.take_events().empty());
    CHECK(e.light_steps() == 1);
}

TEST_CASE("a velocity that is no number stops the run with the name of the body") {
    engine<rigid> e = scenes::collision(scenes::settings<rigid>());
    e.step();
    e.grains.motion[1].v.y = std::numeric_limits<double>::quiet_NaN();
    std::string what, where, when, why, advice;
    try {
        e.step();
    } catch (const run_error& error) {
        what = error.details.what, where = error.details.where, when = error.details.when;
        why = error.details.why, advice = error.details.advice;
    }
    CHECK(what.find("grain 1") != std::string::npos);
    CHECK(where == "grain 1");
    CHECK(when.find("step 2") != std::string::npos);
    CHECK(!why.empty());
    CHECK(!advice.empty());
}

TEST_CASE("the state of an engine comes back from an archive, and goes on with the same bits") {
    auto e = scenes::packed<rigid>(scenes::settings<rigid>(), shapes::tetrahedron_4(circumscribed(0.02)), 24, 0.055,
                                   2e5, 1500);
    engine<rigid> other(e.settings, scenes::empty(shapes::tetrahedron_4(circumscribed(0.02))),
                        boundaries::solid_strips(scenes::cylinder(0.3, 0.3)));
    from_bytes(to_bytes(e), other);
    for (int k = 0; k < 300; ++k) e.step(), other.step();
    CHECK(checksum(other) == checksum(e));
    CHECK(other.kinetic_energy() == e.kinetic_energy());
    CHECK(other.elastic_energy() == e.elastic_energy());
}

TEST_CASE("looking at a run changes none of its bits") {
    auto quiet = scenes::packed<rigid>(scenes::settings<rigid>(), shapes::tetrahedron_4(circumscribed(0.02)), 24, 0.055,
                                       2e5, 1500);
    auto watched = quiet;
    for (int k = 0; k < 300; ++k) {
        quiet.step();
        watched.step();
        watched.place_all();
        (void)watched.elastic_energy();
        (void)to_bytes(watched);
    }
    CHECK(checksum(watched) == checksum(quiet));
}

TEST_CASE(
    "small copies of a large shape are grains of the small shape, to the last bit, through packing and breakage") {
    using policies = scenes::breakable<boundaries::tiles>;
    const shape big = shapes::tetrahedron_4(circumscribed(0.08)), small = scaled_by(big, 0.25); // roots are exact, too
    bodies::clumps by_shape = scenes::empty(small), by_scale = scenes::empty(big);
    protocol::add_cloud(by_shape, 0, 24, {0.04, -0.04, 0.04}, 3);
    for (std::size_t g = 0; g < by_shape.grain_count(); ++g)
        by_scale.add(0, by_shape.motion[g].x, by_shape.turning[g].q, 0.25);
    const auto run = [&](const bodies::clumps& grains) {
        engine<policies> e(scenes::settings<policies>(1e6, 0.1), grains,
                           boundaries::tiles(scenes::cylinder(0.04, 0.08)));
        e.drives = scenes::isotropic(2e6, 0.5);
        std::size_t fractures = 0;
        for (int k = 0; k < 60; ++k) e.step(100), fractures += e.take_events().size();
        CHECK(e.totals().replaced > 3);
        CHECK(fractures > 10);
        return measure::digest(e);
    };
    CHECK(run(by_scale) == run(by_shape));
}

TEST_CASE("grains of sizes from 2 to 5 break side by side: momentum, energy and their own strengths are kept") {
    using policies = scenes::breakable<>;
    bodies::clumps grains = scenes::empty(shapes::tetrahedron_4(circumscribed(0.02)));
    bodies::clumps places = scenes::empty(shapes::tetrahedron_4(circumscribed(0.02)));
    protocol::add_cloud(places, 0, 24, {0.04, -0.04, 0.04}, 3);
    for (std::size_t g = 0; g < places.grain_count(); ++g)
        grains.add(0, places.motion[g].x, places.turning[g].q, 0.2 * static_cast<double>(2 + g % 4));
    auto s = scenes::settings<policies>(3e5, 0.1);
    s.breakage.strength.d0 = 0.02;
    s.scheme.damping = 0.3;
    engine<policies> e(s, grains, boundaries::solid_strips(scenes::cylinder(0.04, 0.08, 1e-3)));
    e.drives = scenes::isotropic(2e6, 1.5);
    const double mass = e.grains.density * e.grains.solid_volume();
    std::set<double> broken;
    for (int k = 0; k < 100; ++k) {
        e.step(100);
        for (const grain& g : e.grains.grains)
            if (g.cluster != grain::is_whole) broken.insert(g.scale);
    }
    CHECK(broken.size() > 1);
    CHECK(e.take_events().size() > 10);
    CHECK(e.grains.density * e.grains.solid_volume() == mass);
    CHECK(std::abs(scenes::residual(e)) < 0.01 * e.totals().boundary_work);
    for (const grain& g : e.grains.grains)
        CHECK(e.grains.pebbles[static_cast<std::size_t>(g.first)].radius ==
              g.scale * e.grains.shapes[0].pebbles[0].radius);
}
