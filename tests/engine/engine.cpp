// SPDX-License-Identifier: MIT
#include <clast/engine/engine.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include <clast/io/archive.hpp>
#include <clast/searches/brute_force.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using rigid = scenes::unbreakable<>;

vec3 momentum(const bodies::clumps& s) {
    vec3 p;
    for (std::size_t g = 0; g < s.grain_count(); ++g) p += s.mass_of(s.grains[g]) * s.motion[g].v;
    return p;
}
vec3 angular_momentum(const bodies::clumps& s) {
    vec3 l;
    for (std::size_t g = 0; g < s.grain_count(); ++g)
        l += s.mass_of(s.grains[g]) * cross(s.motion[g].x, s.motion[g].v) + s.turning[g].l;
    return l;
}
template <class P> double residual(const engine<P>& e) {
    const engine_totals& t = e.totals();
    const body_losses lost = e.losses();
    return t.boundary_work + t.initial_energy - e.kinetic_energy() - e.elastic_energy() - lost.friction - lost.damping -
           t.bond_dissipation;
}

/// Two tumbling clumps that hit each other off centre, far from any wall.
template <class P> engine<P> collision(engine_settings<P> s) {
    bodies::clumps sp = scenes::empty(shapes::tetrahedron_4(0.02));
    sp.add(0, {-0.011, 0.002, 0.001}, unit(quaternion{1.0, 0.3, -0.2, 0.5}));
    sp.add(0, {0.011, -0.003, 0.002}, unit(quaternion{0.4, -0.7, 0.6, 0.1}));
    sp.motion[0].v = {1.0, 0.1, -0.2};
    sp.motion[1].v = {-0.8, 0.3, 0.1};
    sp.turning[0].l = {2e-6, -1e-6, 3e-6};
    sp.turning[1].l = {-1e-6, 4e-6, 1e-6};
    for (std::size_t g = 0; g < 2; ++g)
        sp.motion[g].w = spin_of(sp.turning[g].q, sp.turning[g].l, sp.inverse_inertia(sp.grains[g]));
    return engine<P>(std::move(s), std::move(sp), typename P::boundary(scenes::cylinder(0.2, 0.4)));
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
struct looks_at_all : rigid {
    using search = searches::brute_force;
};

} // namespace

TEST_CASE("two clumps that collide keep momentum and angular momentum to rounding, friction included") {
    auto s = scenes::settings<rigid>();
    s.damping = 0.0;
    engine<rigid> e = collision<rigid>(s);
    const vec3 p = momentum(e.grains), l = angular_momentum(e.grains);
    double deepest = 0.0;
    for (int k = 0; k < 1500; ++k) {
        e.step();
        e.each_contact([&](const force_row& row, const pebble_pair&) { deepest = std::max(deepest, row.depth); });
    }
    CHECK(deepest > 1e-5); // they met
    CHECK(norm(momentum(e.grains) - p) < 1e-13 * (norm(p) + 4e-3));
    CHECK(norm(angular_momentum(e.grains) - l) < 1e-13 * norm(l));
    CHECK(e.losses().friction > 0.0);
    CHECK(e.losses().damping == 0.0);
}

TEST_CASE("the energy ledger of a collision closes, better with the square of the step") {
    const auto error = [](double safety, double damping) {
        auto s = scenes::settings<rigid>();
        s.damping = damping;
        s.safety = safety;
        engine<rigid> e = collision<rigid>(s);
        while (e.time() < 0.02) e.step();
        CHECK(e.elastic_energy() == 0.0); // apart again
        return std::abs(residual(e)) / e.totals().initial_energy;
    };
    const double coarse = error(0.2, 0.0), fine = error(0.025, 0.0);
    CHECK(coarse < 1e-2);
    CHECK(fine < coarse / 32); // 64 in the limit
    CHECK(error(0.05, 0.7) < 1e-3);
}

TEST_CASE("a clump thrown at a platen comes back with its energy, and the platen took the momentum") {
    auto s = scenes::settings<rigid>();
    s.damping = 0.0;
    s.safety = 0.05;
    bodies::clumps sp = scenes::empty(shapes::tetrahedron_4(0.02));
    sp.add(0, {0, 0, -0.18}, unit(quaternion{1.0, 0.3, -0.2, 0.5}));
    sp.motion[0].v = {0.0, 0.0, -1.0};
    engine<rigid> e(s, sp, boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
    const double before = e.kinetic_energy(), p = momentum(e.grains).z;
    double impulse = 0.0;
    while (e.time() < 0.03) {
        e.step();
        impulse += e.loads()[boundaries::bottom_platen].force * e.dt();
    }
    CHECK(impulse > 0.0);
    CHECK(momentum(e.grains).z - p == Approx(impulse).epsilon(1e-12));
    CHECK(momentum(e.grains).x == 0.0); // platens are frictionless
    CHECK(e.elastic_energy() == 0.0);
    CHECK(e.kinetic_energy() == Approx(before).epsilon(1e-3));
    CHECK(e.totals().boundary_work == 0.0);
}

TEST_CASE("a platen that pushes a clump does the work that the clump receives") {
    auto s = scenes::settings<rigid>();
    s.damping = 0.0;
    s.safety = 0.05;
    bodies::clumps sp = scenes::empty(shapes::tetrahedron_4(0.02));
    s.safety = 0.05;
    sp.add(0, {0, 0, -0.185}, unit(quaternion{1.0, 0.3, -0.2, 0.5}));
    engine<rigid> e(s, sp, boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
    e.drives.platens.how = boundaries::drive::mode::velocity;
    e.drives.platens.value = 0.5;
    while (e.time() < 0.04) e.step();
    CHECK(e.elastic_energy() == 0.0);
    CHECK(e.kinetic_energy() > 1e-4);
    CHECK(e.totals().boundary_work == Approx(e.kinetic_energy()).epsilon(1e-3));
    CHECK(momentum(e.grains).z > 0.0);
}

TEST_CASE("the energy ledger of a packing under servo control closes to 2e-4 of the work") {
    auto e = scenes::packed<rigid>(scenes::settings<rigid>(), shapes::tetrahedron_4(0.02), 40, 0.065, 1e5, 6000);
    const double work = e.totals().boundary_work, open = residual(e);
    e.drives = scenes::isotropic(8e5, 0.02);
    for (int k = 0; k < 6000; ++k) e.step();
    CHECK(e.boundary.axial_stress(e.loads()) == Approx(8e5).epsilon(0.01));
    CHECK(std::abs(residual(e) - open) < 2e-4 * (e.totals().boundary_work - work));
}

TEST_CASE("lists never miss a contact: any skin and any search give the same bits") {
    const auto run = [](auto bundle, double skin) {
        using P = decltype(bundle);
        auto s = scenes::settings<P>();
        s.skin = skin;
        auto e = scenes::packed<P>(s, shapes::tetrahedron_4(0.02), 24, 0.055, 2e5, 3000);
        e.place_all(); // pebbles that no list names are placed on demand
        return std::pair(checksum(e.grains), e.totals().renewals);
    };
    const auto reference = run(looks_at_all{}, 1e-7);
    const auto wide = run(rigid{}, 4e-3);
    const auto usual = run(rigid{}, 5e-4);
    CHECK(reference.second > 1000); // renewed in nearly every step
    CHECK(wide.second < reference.second / 4);
    CHECK(wide.first == reference.first);
    CHECK(usual.first == reference.first);
}

TEST_CASE("every overlap at the time of a step, of pebbles or with a facet, has its force in that step") {
    auto s = scenes::settings<rigid>();
    auto e = scenes::packed<rigid>(s, shapes::tetrahedron_4(0.02), 24, 0.055, 2e5, 4000);
    std::size_t met = 0, missed = 0, walls = 0;
    for (int k = 0; k < 400; ++k) {
        e.place_all();
        std::vector<vec3> x;
        for (const auto& p : e.grains.pebbles) x.push_back(p.x);
        const auto boundary = e.boundary;
        e.step();
        for (std::size_t i = 0; i < x.size(); ++i) {
            for (std::size_t j = i + 1; j < x.size(); ++j) {
                if (e.grains.owner[i] == e.grains.owner[j]) continue;
                if (norm(x[j] - x[i]) >= e.grains.pebbles[i].radius + e.grains.pebbles[j].radius) continue;
                ++met;
                const auto& list = e.slow_contacts();
                const pebble_pair pair{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)};
                const auto at = scenes::position(list, pair);
                if (at == list.size() || !(list.rows[at].depth > 0.0)) ++missed;
            }
            if (boundary.touch(x[i], e.grains.pebbles[i].radius).size == 0) continue;
            ++walls;
            bool found = false;
            e.each_wall_row([&](const auto& w) {
                found = found || (w.pebble == static_cast<std::int32_t>(i) && w.touch.size > 0);
            });
            if (!found) ++missed;
        }
    }
    CHECK(met > 1000);
    CHECK(walls > 1000);
    CHECK(missed == 0);
}

TEST_CASE("a contact law of plain doubles, without history, works and costs no memory for one") {
    const soft_ball law{2e7};
    engine_settings<soft> s{.grain_contact = law,
                            .platen_contact = law,
                            .lateral_contact = law,
                            .breakage = {},
                            .replacement = {},
                            .damping = 0.0,
                            .safety = 0.05};
    engine<soft> e = collision<soft>(s);
    const vec3 p = momentum(e.grains);
    const double before = e.kinetic_energy();
    double stored = 0.0;
    while (e.time() < 0.02) {
        e.step();
        stored = std::max(stored, e.elastic_energy());
    }
    CHECK(stored > 0.05 * before);
    CHECK(e.slow_contacts().history.empty());
    CHECK(e.kinetic_energy() == Approx(before).epsilon(1e-3));
    CHECK(norm(momentum(e.grains) - p) < 1e-13 * (norm(p) + 4e-3));
}

TEST_CASE("what is absent takes no memory: an unbreakable scene has no balls, no bonds and no events") {
    static_assert(!engine<rigid>::breakable && !engine<rigid>::has_criterion);
    static_assert(engine<scenes::breakable<>>::breakable);
    static_assert(sizeof(engine<scenes::breakable<>>) >= sizeof(engine<rigid>) + sizeof(breakage_state) - 16);
    static_assert(std::is_empty_v<criteria::none> && std::is_empty_v<replacements::none>);
    static_assert(!contact_list<soft_ball::history>::remembers);
    auto s = scenes::settings<rigid>();
    engine<rigid> e = collision<rigid>(s);
    CHECK(e.grains.motion.size() == 2); // not one more per pebble
    CHECK(e.grains.losses.size() == 2);
    CHECK(e.fast_contacts().pairs.capacity() == 0);
    CHECK(e.take_events().empty());
    CHECK(e.fast_steps() == 1);
}

TEST_CASE("a velocity that is no number stops the run with the name of the body") {
    engine<rigid> e = collision<rigid>(scenes::settings<rigid>());
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
    auto e = scenes::packed<rigid>(scenes::settings<rigid>(), shapes::tetrahedron_4(0.02), 24, 0.055, 2e5, 1500);
    engine<rigid> other(e.settings, scenes::empty(shapes::tetrahedron_4(0.02)),
                        boundaries::solid_strips(scenes::cylinder(0.3, 0.3)));
    from_bytes(to_bytes(e), other);
    for (int k = 0; k < 300; ++k) e.step(), other.step();
    CHECK(checksum(other) == checksum(e));
    CHECK(other.kinetic_energy() == e.kinetic_energy());
    CHECK(other.elastic_energy() == e.elastic_energy());
}

TEST_CASE("looking at a run changes none of its bits") {
    auto quiet = scenes::packed<rigid>(scenes::settings<rigid>(), shapes::tetrahedron_4(0.02), 24, 0.055, 2e5, 1500);
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
