// SPDX-License-Identifier: MIT
// Replacement inside an engine: nothing jumps, nothing breaks falsely, everything is accounted for.
#include <clast/engine/surgery.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <clast/bonds/parallel.hpp>
#include <clast/engine/engine.hpp>
#include <clast/measure/stress.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using brittle = scenes::breakable<>;
constexpr double never = 1e15; // crushing strength that no load reaches (Pa)

struct total {
    double mass = 0.0, energy = 0.0;
    vec3 momentum, angular;
};
/// Of all bodies, at the instant of the clumps.
total total_of(const engine<brittle>& e) {
    const bodies::clumps& s = e.grains;
    total t;
    t.energy = e.kinetic_energy();
    for (std::size_t g = 0; g < s.grain_count(); ++g) {
        if (!s.is_clump(g)) continue;
        const double m = s.mass_of(s.grains[g]);
        t.mass += m;
        t.momentum += m * s.motion[g].v;
        t.angular += m * cross(s.motion[g].x, s.motion[g].v) + s.turning[g].l;
    }
    for (const std::int32_t b : e.breakage().balls) {
        const auto p = static_cast<std::size_t>(b);
        const body_motion& ball = s.motion[s.grain_count() + p];
        t.mass += s.ball_mass(p);
        t.momentum += s.ball_mass(p) * ball.v;
        t.angular += s.ball_mass(p) * cross(s.pebbles[p].x, ball.v) + s.ball_inertia(p) * ball.w;
    }
    return t;
}
double largest_bond_utilisation(const engine<brittle>& e) {
    const bonds::cluster_pool& pool = e.breakage().pools[0];
    double u = 0.0;
    for (std::size_t c = 0; c < pool.size(); ++c)
        for (std::size_t b = 0; b < pool.bonds(); ++b)
            u = std::max(u, bonds::utilisation(pool.shape().bond[b], pool.get(c, b)));
    return u;
}

} // namespace

TEST_CASE("at the swap no momentum, angular momentum, kinetic energy, mass or position jumps") {
    for (const shape& grain : {shapes::tetrahedron_4(0.02), shapes::apollonian_14(0.02)}) {
        auto s = scenes::settings<brittle>(1.0, 1e6); // the first touch replaces, and no bond breaks
        s.replacement.check_interval = 1;
        engine<brittle> e = scenes::collision(s, grain);
        engine<brittle> rigid = e;
        rigid.breakage_on = false;
        const double volume = e.grains.solid_volume();
        while (e.totals().replaced == 0) e.step(), rigid.step();
        REQUIRE(e.totals().replaced == 2);
        rigid.place_all();
        const total before = total_of(rigid), after = total_of(e);
        CHECK(after.mass == Approx(before.mass).epsilon(1e-14));
        CHECK(norm(after.momentum - before.momentum) < 1e-13 * norm(before.momentum));
        CHECK(norm(after.angular - before.angular) < 1e-12 * norm(before.angular));
        CHECK(after.energy == Approx(before.energy).epsilon(1e-12));
        CHECK(e.grains.solid_volume() == volume);
        for (std::size_t p = 0; p < e.grains.pebble_count(); ++p)
            CHECK(norm(e.grains.pebbles[p].x - rigid.grains.pebbles[p].x) < 1e-15);
        CHECK(e.dt() == rigid.dt());
    }
}

TEST_CASE("clusters that collide keep momentum and angular momentum, and their contacts the histories") {
    auto s = scenes::settings<brittle>(1.0, 1e6);
    s.replacement.check_interval = 1;
    s.scheme.damping = 0.0;
    engine<brittle> e = scenes::collision(s, shapes::tetrahedron_4(0.02));
    engine<brittle> rigid = e;
    rigid.breakage_on = false;
    while (e.totals().replaced == 0) e.step(), rigid.step();
    // a contact that was alive in the slow list goes on in the fast list
    pebble_pair touching{-1, -1};
    rigid.each_contact([&](const force_row& row, const pebble_pair& p) {
        if (row.depth > 0.0) touching = p;
    });
    REQUIRE(touching.i >= 0);
    const total start = total_of(e);
    e.step(), rigid.step();
    const std::size_t slow = scenes::position(rigid.heavy_contacts(), touching);
    const std::size_t fast = scenes::position(e.light_contacts(), touching);
    REQUIRE(fast < e.light_contacts().size());
    const auto& a = rigid.heavy_contacts().history[slow];
    const auto& b = e.light_contacts().history[fast];
    const vec3 shear{a.x, a.y, a.z};
    CHECK(norm(shear) > 0.0);
    CHECK(norm(vec3{b.x, b.y, b.z} - shear) < 0.5 * norm(shear)); // evaluated up to half a step earlier or later
    for (int k = 0; k < 600; ++k) e.step();
    const total end = total_of(e);
    CHECK(e.elastic_energy() < 1e-2 * start.energy); // apart; bonds ring on
    CHECK(e.totals().broken_shear + e.totals().broken_tension == 0);
    CHECK(norm(end.momentum - start.momentum) < 1e-12 * norm(start.momentum));
    // spin of the balls and shear at a bond point that has moved in its gap leave a rest of second order
    CHECK(norm(end.angular - start.angular) < 1e-3 * norm(start.angular));
}

TEST_CASE("a clump at rest under a constant load becomes a cluster at rest: no bond breaks and no energy jumps") {
    engine<brittle> e = scenes::pressed(scenes::settings<brittle>(never), 400.0);
    const double stored = e.elastic_energy(), force = scenes::load(e), dt = e.dt();
    const double lost = e.losses().damping + e.losses().friction, left = scenes::residual(e);
    scenes::set_utilisation(e, 0.91);
    const double before = scenes::load(e);
    for (int k = 0; k < 20; ++k) e.step();
    REQUIRE(e.totals().replaced == 1);
    CHECK(e.dt() >= dt);
    CHECK(scenes::load(e) == Approx(before).epsilon(1e-6));
    CHECK(e.kinetic_energy() < 1e-6 * stored);
    for (int k = 0; k < 1500; ++k) e.step();
    CHECK(e.dt() >= dt);
    CHECK(e.totals().broken_tension + e.totals().broken_shear == 0);
    CHECK(scenes::load(e) == Approx(force).epsilon(1e-5));
    CHECK(e.losses().damping + e.losses().friction - lost < 1e-6 * stored);
    CHECK(std::abs(scenes::residual(e) - left) < 1e-6 * stored);
}

TEST_CASE("bonds born without force break falsely at a load that bonds born in equilibrium carry") {
    const auto broken = [](replacements::birth how, double bond_strength) {
        auto s = scenes::settings<brittle>(never, bond_strength);
        s.replacement.how = how;
        engine<brittle> e = scenes::pressed(s, 400.0);
        scenes::set_utilisation(e, 0.91);
        for (int k = 0; k < 1000; ++k) e.step();
        REQUIRE(e.totals().replaced == 1);
        return std::pair(e.totals().broken_tension + e.totals().broken_shear, largest_bond_utilisation(e));
    };
    const auto strong = broken(replacements::birth::warm_start, 1.0);
    REQUIRE(strong.first == 0);
    const double at_95_percent = strong.second / 0.95;
    CHECK(broken(replacements::birth::warm_start, at_95_percent).first == 0);
    CHECK(broken(replacements::birth::zero_force, at_95_percent).first > 0);
}

TEST_CASE("a grain crushed between platens ends as free balls, each bond with its event") {
    auto s = scenes::settings<brittle>(never, 0.05);
    engine<brittle> e = scenes::pressed(s, 100.0);
    scenes::set_utilisation(e, 0.95);
    e.drives.platens.how = boundaries::drive::mode::velocity;
    e.drives.platens.value = 0.05;
    std::vector<fracture_event> events;
    const double volume = e.grains.solid_volume();
    for (int k = 0; k < 20000 && events.size() < 6; ++k) {
        e.step();
        for (const fracture_event& one : e.take_events()) events.push_back(one);
    }
    REQUIRE(events.size() == 6);
    CHECK(e.totals().broken_tension + e.totals().broken_shear == 6);
    CHECK(e.take_events().empty());
    std::vector<int> seen(6, 0);
    double released = 0.0, time = 0.0;
    const bonds::cluster_pool& pool = e.breakage().pools[0];
    for (const fracture_event& one : events) {
        CHECK(one.mother == 0);
        REQUIRE((one.bond >= 0 && one.bond < 6));
        ++seen[static_cast<std::size_t>(one.bond)];
        CHECK(norm(one.normal) == Approx(1.0).epsilon(1e-12));
        CHECK(norm(one.position) < 0.012);
        CHECK(one.time >= time);
        time = one.time;
        CHECK(one.energy > 0.0);
        released += one.energy;
        // the forces are those at failure: beyond the strength, by little
        const bonds::constants& c = pool.shape().bond[static_cast<std::size_t>(one.bond)];
        const double sigma = one.normal_force * c.per_area + one.bending_moment * c.per_bending;
        const double tau = one.shear_force * c.per_area + one.twisting_moment * c.per_twist;
        if (one.mode == break_mode::tension)
            CHECK(sigma >= c.tensile_strength * (1.0 - 1e-12));
        else
            CHECK(tau >= c.cohesion * (1.0 - 1e-12));
    }
    CHECK(seen == std::vector<int>(6, 1));
    for (std::size_t p = 0; p < 4; ++p) {
        CHECK(e.breakage().fragment[p] == static_cast<std::int32_t>(p));
        CHECK(e.breakage().bonded[p] == 0);
        CHECK(e.grains.owner[p] == static_cast<std::int32_t>(1 + p));
    }
    CHECK(e.breakage().balls == std::vector<std::int32_t>{0, 1, 2, 3});
    CHECK(e.grains.solid_volume() == volume);
    // broken pairs are contacts like any other
    for (int k = 0; k < 50; ++k) e.step();
    CHECK(e.bonded_pairs().empty());
    CHECK(e.light_contacts().size() > 0);
    CHECK(e.totals().bond_dissipation != 0.0);
    CHECK(released > 0.0);
}

TEST_CASE("breaking grains in a packing: fragments, contacts, step and ledger stay in order") {
    auto s = scenes::settings<brittle>(never, 0.03);
    auto e = scenes::packed<brittle>(s, shapes::tetrahedron_4(0.02), 24, 0.055, 2e5, 7000);
    e.drives = scenes::isotropic(2e5, 0.02);
    for (int k = 0; k < 1000; ++k) e.step();
    const double volume = e.grains.solid_volume();
    const double open = scenes::residual(e), work = e.totals().boundary_work,
                 lost = e.losses().friction + e.losses().damping;
    e.settings.breakage.strength.sigma0 = 2e5;
    e.breakage_on = true;
    e.drives.platens.how = boundaries::drive::mode::velocity;
    e.drives.platens.value = 0.05;
    std::size_t events = 0;
    for (int k = 0; k < 4000; ++k) {
        e.step();
        events += e.take_events().size();
    }
    const engine_totals& t = e.totals();
    INFO("replaced " << t.replaced << ", broken " << t.broken_tension << " + " << t.broken_shear);
    CHECK(t.replaced > 10);
    CHECK(t.broken_tension + t.broken_shear > 20);
    CHECK(events == static_cast<std::size_t>(t.broken_tension + t.broken_shear));
    CHECK(e.grains.solid_volume() == volume);

    // fragments are the connected components of intact bonds, by another way: union of pairs until nothing changes
    const breakage_state& b = e.breakage();
    std::vector<std::int32_t> root(e.grains.pebble_count());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](std::int32_t p) {
        while (root[static_cast<std::size_t>(p)] != p) p = root[static_cast<std::size_t>(p)];
        return p;
    };
    std::size_t intact = 0;
    for (const grain& g : e.grains.grains) {
        const shape& form = e.grains.shape_of(g);
        for (std::size_t k = 0; k < form.bonds.size(); ++k) {
            if (g.cluster >= 0 && !b.pools[0].is_intact(static_cast<std::size_t>(g.cluster), k)) continue;
            const std::int32_t i = find(g.first + form.bonds[k].a), j = find(g.first + form.bonds[k].b);
            root[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
            ++intact;
        }
    }
    for (std::size_t p = 0; p < root.size(); ++p) CHECK(b.fragment[p] == find(static_cast<std::int32_t>(p)));
    CHECK(intact + events == 24 * 6);

    // a bonded pair sleeps as a contact, every other pair of balls does not
    const auto is_bonded = [&](const pebble_pair& p) {
        bool bond = false;
        const auto g = static_cast<std::size_t>(e.grains.mother[static_cast<std::size_t>(p.i)]);
        if (e.grains.mother[static_cast<std::size_t>(p.j)] == static_cast<std::int32_t>(g))
            for (std::size_t n = 0; n < 6; ++n) {
                const shape_bond& ends = e.grains.shapes[0].bonds[n];
                if (e.grains.grains[g].first + ends.a == p.i && e.grains.grains[g].first + ends.b == p.j)
                    bond = b.pools[0].is_intact(static_cast<std::size_t>(e.grains.grains[g].cluster), n);
            }
        return bond;
    };
    for (const pebble_pair& p : e.light_contacts().pairs) CHECK(!is_bonded(p));
    for (const pebble_pair& p : e.bonded_pairs()) CHECK(is_bonded(p));
    CHECK(static_cast<std::size_t>(intact) == e.bonded_pairs().size());
    const double through = std::max(t.boundary_work - work, e.losses().friction + e.losses().damping - lost);
    INFO("residual " << scenes::residual(e) - open << " of " << through);
    CHECK(std::abs(scenes::residual(e) - open) < 1e-3 * through);
}
