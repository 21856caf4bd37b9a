// SPDX-License-Identifier: MIT
// Replacement inside an engine: nothing jumps, nothing breaks falsely, everything is accounted for.
#include <clast/engine/surgery.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <clast/bonds/parallel.hpp>
#include <clast/engine/engine.hpp>
#include <clast/io/archive.hpp>
#include <clast/measure/digest.hpp>
#include <clast/measure/pebbles.hpp>
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
template <class P> total total_of(const scene<P>& e) {
    const bodies::clumps& s = e.grains;
    total t;
    t.energy = rooms::kinetic_energy(e);
    for (std::size_t g = 0; g < s.grain_count(); ++g) {
        if (!s.is_clump(g)) continue;
        const double m = s.mass_of(s.grains[g]);
        t.mass += m;
        t.momentum += m * s.motion[g].v;
        t.angular += m * cross(s.motion[g].x, s.motion[g].v) + s.turning[g].l;
    }
    e.broken.each_ball(s, [&](std::int32_t b, const body_motion& ball) {
        const auto p = static_cast<std::size_t>(b);
        t.mass += s.ball_mass(p);
        t.momentum += s.ball_mass(p) * ball.v;
        t.angular += s.ball_mass(p) * cross(s.pebbles[p].x, ball.v) + s.ball_inertia(p) * ball.w;
    });
    return t;
}
template <class P> total total_of(const engine<P>& e) { return total_of(e.state()); }
/// Nothing but owners differs between two engines at the same instant.
template <class P, class Q> void check_same_motion(const engine<P>& e, const engine<Q>& rigid) {
    const total before = total_of(rigid), after = total_of(e);
    CHECK(after.mass == Approx(before.mass).epsilon(1e-14));
    CHECK(norm(after.momentum - before.momentum) < 1e-13 * norm(before.momentum));
    CHECK(norm(after.angular - before.angular) < 1e-12 * norm(before.angular));
    CHECK(after.energy == Approx(before.energy).epsilon(1e-12));
    for (std::size_t p = 0; p < e.grains.pebble_count(); ++p)
        CHECK(norm(e.grains.pebbles[p].x - rigid.grains.pebbles[p].x) < 1e-15);
}
/// Grains lie in the order of their pebbles, share them out, and lists are sorted by them.
template <class P> void check_tables(const engine<P>& e) {
    const bodies::clumps& s = e.grains;
    std::size_t next = 0;
    std::vector<int> seen(s.grain_count(), 0);
    for (std::size_t g = 0; g < s.grain_count(); ++g) {
        const index_range own = s.pebbles_of(g);
        CHECK(own.begin == next);
        next = own.end;
        ++seen.at(static_cast<std::size_t>(s.grains[g].id));
        for (std::size_t p = own.begin; p < own.end; ++p) {
            CHECK(s.mother[p] == static_cast<std::int32_t>(g));
            const auto as_ball = static_cast<std::int32_t>(s.ball(static_cast<std::int32_t>(p)));
            CHECK(s.owner[p] == (s.is_clump(g) ? static_cast<std::int32_t>(g) : as_ball));
        }
    }
    CHECK(next == s.pebble_count());
    std::vector<int> met(s.pebble_count(), 0); // every pebble has a number of its own
    for (std::size_t p = 0; p < met.size(); ++p)
        ++met.at(static_cast<std::size_t>(s.number_of_pebble(static_cast<std::int32_t>(p))));
    CHECK(met == std::vector<int>(met.size(), 1));
    CHECK(seen == std::vector<int>(s.grain_count(), 1)); // numbers for life
    const auto order = e.state().pair_order();
    const auto& pairs = e.heavy_contacts().pairs;
    CHECK(std::is_sorted(pairs.begin() + static_cast<std::ptrdiff_t>(e.heavy_contacts().shared), pairs.end(), order));
    CHECK(std::is_sorted(e.light_contacts().pairs.begin(), e.light_contacts().pairs.end(), order));
}

/// A replacement of one's own: a grain at its limit becomes two rigid halves, as long as it has four pebbles.
struct in_halves {
    static constexpr bool replaces = true, makes_bonds = false;
    int every = 1;

    int looks_every() const { return every; }
    template <class View> std::optional<replacements::nothing> wants(const View& clump) const {
        if (clump.shape().pebbles.size() < 4 || clump.utilisation() < 1.0) return std::nullopt;
        return replacements::nothing{};
    }
    template <class Surgery> void act(std::int32_t grain, replacements::nothing, Surgery& surgery) const {
        const auto n = static_cast<std::int32_t>(surgery.shape_of(grain).pebbles.size());
        surgery.split(grain, std::vector<replacements::pebble_run>{{0, n / 2}, {n / 2, n - n / 2}});
    }
};
struct halving : scenes::breakable<> {
    using replacement = in_halves;
};

/// One that does all there is: halves remember how often they were split, become balls 20 steps after the second time,
/// and these get bonds if their number is even.
struct in_stages {
    static constexpr bool replaces = true, makes_bonds = true;
    struct grain_state {
        std::int32_t splits = 0;
    };
    using plan = std::int32_t; // where to cut
    bonds::parallel bond;
    std::size_t least_neighbours = 2;
    int most_splits = 2, delay = 20;

    int looks_every() const { return 2; }
    template <class View> std::optional<plan> wants(const View& clump) const {
        if (clump.shape().pebbles.size() < 2 || clump.state().splits >= most_splits ||
            clump.neighbours() < least_neighbours || clump.utilisation() < 1.0)
            return std::nullopt;
        return static_cast<plan>(clump.pebble_loads().size()) / 2;
    }
    template <class Surgery> void act(std::int32_t grain, plan cut, Surgery& surgery) const {
        const auto n = static_cast<std::int32_t>(surgery.shape_of(grain).pebbles.size());
        if (++surgery.state(grain).splits == 2) surgery.again_in(grain, delay);
        surgery.split(grain, std::vector<replacements::pebble_run>{{0, cut}, {cut, n - cut}});
    }
    template <class Surgery> void again(std::int32_t grain, Surgery& surgery) const {
        surgery.release(grain);
        const std::size_t bonds = surgery.shape_of(grain).bonds.size();
        if (bonds > 0 && grain % 2 == 0)
            surgery.bond(grain, std::vector<bonds::state>(bonds), surgery.strength_factor(grain));
    }
};
/// Balls for some steps, bonded, and then rigid again, in so many parts.
template <bool Across> struct thaws {
    static constexpr bool replaces = true, makes_bonds = true;
    struct grain_state {
        std::int32_t frozen = 0;
    };
    bonds::parallel bond;
    int span = 30;
    std::int32_t parts = Across ? 3 : 2;
    bool across = Across; ///< every so manieth pebble is one of a part; else runs of them

    int looks_every() const { return 1; }
    template <class View> std::optional<replacements::nothing> wants(const View& clump) const {
        if (clump.state().frozen > 0 || clump.utilisation() < 1.0) return std::nullopt;
        return replacements::nothing{};
    }
    template <class Surgery> void act(std::int32_t grain, replacements::nothing, Surgery& surgery) const {
        surgery.release(grain);
        surgery.bond(grain, std::vector<bonds::state>(surgery.shape_of(grain).bonds.size()), 1.0);
        surgery.again_in(grain, span);
    }
    template <class Surgery> void again(std::int32_t grain, Surgery& surgery) const {
        const auto n = static_cast<std::int32_t>(surgery.shape_of(grain).pebbles.size());
        ++surgery.state(grain).frozen;
        if (across) {
            std::vector<std::int32_t> part;
            for (std::int32_t k = 0; k < n; ++k) part.push_back((k + 1) % parts);
            return surgery.freeze(grain, part);
        }
        std::vector<replacements::pebble_run> runs;
        for (std::int32_t k = 0; k < parts; ++k) runs.push_back({k * n / parts, (k + 1) * n / parts - k * n / parts});
        surgery.freeze(grain, runs);
    }
};
struct thawing : scenes::breakable<> {
    using replacement = thaws<false>;
};
struct thawing_across : scenes::breakable<> {
    using replacement = thaws<true>;
};
struct staged : scenes::breakable<> {
    using replacement = in_stages;
};

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
    for (const shape& grain :
         {shapes::tetrahedron_4(circumscribed(0.02)), shapes::apollonian_14(circumscribed(0.02))}) {
        auto s = scenes::settings<brittle>(1.0, 1e6); // the first touch replaces, and no bond breaks
        s.replacement.check_interval = 1;
        engine<brittle> e = scenes::collision(s, grain);
        engine<brittle> rigid = e;
        rigid.breakage_on = false;
        const double volume = e.grains.solid_volume();
        while (e.totals().replaced == 0) e.step(), rigid.step();
        REQUIRE(e.totals().replaced == 2);
        rigid.place_all();
        check_same_motion(e, rigid);
        CHECK(e.grains.solid_volume() == volume);
        CHECK(e.dt() == rigid.dt());
    }
}

TEST_CASE("clusters that collide keep momentum and angular momentum, and their contacts the histories") {
    auto s = scenes::settings<brittle>(1.0, 1e6);
    s.replacement.check_interval = 1;
    s.scheme.damping = 0.0;
    engine<brittle> e = scenes::collision(s, shapes::tetrahedron_4(circumscribed(0.02)));
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
    auto e = scenes::packed<brittle>(s, shapes::tetrahedron_4(circumscribed(0.02)), 24, 0.055, 2e5, 7000);
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

TEST_CASE("a clump in halves: no momentum, angular momentum, kinetic energy, mass or position jumps") {
    for (const shape& grain :
         {shapes::tetrahedron_4(circumscribed(0.02)), shapes::apollonian_14(circumscribed(0.02))}) {
        auto s = scenes::settings<halving>(1.0);
        s.scheme.damping = 0.0;
        engine<halving> e = scenes::collision(s, grain);
        engine<halving> rigid = e;
        rigid.breakage_on = false;
        while (e.totals().replaced == 0) e.step(), rigid.step();
        REQUIRE(e.totals().replaced == 2);
        rigid.place_all();
        check_same_motion(e, rigid);
        check_tables(e);
        REQUIRE(e.grains.grain_count() == 4);
        CHECK((e.grains.grains[0].id == 0 && e.grains.grains[1].id == 2));
        CHECK((e.grains.grains[2].id == 1 && e.grains.grains[3].id == 3));
        // equal runs of one shape are of one shape
        CHECK(e.grains.shapes.size() == 3);
        CHECK((e.grains.grains[1].shape == e.grains.grains[3].shape && e.grains.grains[1].shape == 2));
        for (std::size_t g = 0; g < 4; ++g) {
            vec3 centre;
            double mass = 0.0;
            const index_range own = e.grains.pebbles_of(g);
            for (std::size_t p = own.begin; p < own.end; ++p) {
                centre += e.grains.ball_mass(p) * e.grains.pebbles[p].x;
                mass += e.grains.ball_mass(p);
            }
            CHECK(norm(centre / mass - e.grains.centre(g)) < 1e-16);
            CHECK(mass == Approx(e.grains.body_mass(g)).epsilon(1e-14));
        }
        const double elastic = e.elastic_energy(), bonds = e.totals().bond_dissipation;
        CHECK(elastic == Approx(rigid.elastic_energy()).epsilon(1e-9)); // the halves touch without overlap
        CHECK(std::abs(bonds) < 1e-9 * elastic);
        const double dt = e.dt();
        e.step();
        CHECK(e.dt() < dt); // of lighter bodies
        e.place_all();
        for (std::size_t p = 0; p < e.grains.pebble_count(); ++p) // which turn like the whole
            CHECK(norm(e.grains.pebbles[p].x - rigid.grains.pebbles[p].x) < 1.1 * e.dt() * 3.0);
        const total start = total_of(e);
        for (int k = 0; k < 400; ++k) e.step();
        const total end = total_of(e);
        check_tables(e);
        CHECK(norm(end.momentum - start.momentum) < 1e-12 * norm(start.momentum));
        CHECK(norm(end.angular - start.angular) < 1e-11 * norm(start.angular));
    }
}

TEST_CASE("contacts go on with their histories when a grain of a packing is split") {
    auto e = scenes::packed<halving>(scenes::settings<halving>(never), shapes::tetrahedron_4(circumscribed(0.02)), 24,
                                     0.055, 2e5, 6000);
    engine<halving> rigid = e;
    e.settings.breakage.strength.sigma0 = 6e5;
    e.breakage_on = true;
    while (e.totals().replaced == 0) e.step(), rigid.step();
    check_tables(e);
    const auto compare = [&](double tolerance) {
        const auto &mine = e.heavy_contacts(), &theirs = rigid.heavy_contacts();
        std::size_t rubbing = 0;
        for (std::size_t k = 0; k < theirs.size(); ++k) {
            const auto& was = theirs.history[k];
            const double size = norm(vec3{was.x, was.y, was.z});
            if (size < 0.5) continue;
            ++rubbing;
            const std::size_t at = scenes::position(mine, theirs.pairs[k]);
            REQUIRE(at < mine.size());
            const auto& is = mine.history[at];
            CHECK(norm(vec3{is.x - was.x, is.y - was.y, is.z - was.z}) <= tolerance * size);
        }
        CHECK(rubbing > 20);
    };
    compare(0.0);
    e.step(), rigid.step(); // lists have been made anew
    check_tables(e);
    compare(0.05);
}

namespace {
/// A packing that is crushed; `stored`: half way from its bytes.
template <class P> engine<P> crushed(int threads, bool stored) {
    auto s = scenes::settings<P>(never);
    s.run = execution(threads);
    s.contacts_per_thread = 8; // cut even small scenes
    auto e = scenes::packed<P>(s, shapes::apollonian_14(circumscribed(0.02)), 20, 0.045, 2e5, 3000);
    engine<P> fresh = e;
    const auto press = [](engine<P>& one) {
        one.settings.breakage.strength.sigma0 = 2e5;
        one.breakage_on = true;
        one.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.1};
    };
    press(e), press(fresh);
    // right behind a step that has split: lists are still to be made
    std::int64_t splits = 0;
    for (int k = 0; k < 300 || e.totals().replaced == splits; ++k) splits = e.totals().replaced, e.step();
    e.take_events();
    if (stored) {
        from_bytes(to_bytes(e), fresh);
        std::swap(e, fresh);
    }
    const std::int64_t rest = 1200 - e.totals().steps % 1000;
    e.step(rest);
    e.take_events();
    check_tables(e);
    return e;
}
} // namespace

TEST_CASE("threads and checkpoints make no difference to what is split, remembered and asked about again") {
    const auto digest_of = [](auto e) { return measure::digest_of_state(e); };
    SECTION("halves of halves") {
        const engine<halving> one = crushed<halving>(1, false);
        CHECK(one.totals().replaced > 20);
        CHECK(one.grains.shapes.size() > 4);
        CHECK(digest_of(one) == digest_of(crushed<halving>(3, false)));
        CHECK(digest_of(one) == digest_of(crushed<halving>(2, true)));
        CHECK(to_bytes(one) == to_bytes(crushed<halving>(3, true)));
    }
    SECTION("balls that freeze in parts") {
        const engine<thawing> one = crushed<thawing>(1, false);
        std::size_t frozen = 0;
        for (const grain& g : one.grains.grains) frozen += g.is_whole == g.cluster && g.shape > 0;
        CHECK(frozen > 10);
        CHECK(digest_of(one) == digest_of(crushed<thawing>(3, false)));
        CHECK(digest_of(one) == digest_of(crushed<thawing>(2, true)));
        CHECK(to_bytes(one) == to_bytes(crushed<thawing>(3, true)));
    }
    SECTION("balls that freeze in parts across their order") {
        const engine<thawing_across> one = crushed<thawing_across>(1, false);
        CHECK(one.grains.numbers.size() == one.grains.pebble_count());
        CHECK(digest_of(one) == digest_of(crushed<thawing_across>(3, false)));
        CHECK(digest_of(one) == digest_of(crushed<thawing_across>(2, true)));
        CHECK(to_bytes(one) == to_bytes(crushed<thawing_across>(3, true)));
    }
    SECTION("then balls, loose and bonded") {
        const engine<staged> one = crushed<staged>(1, false);
        CHECK(one.totals().replaced > 20);
        std::size_t loose = 0, bonded = 0;
        for (const grain& g : one.grains.grains) loose += g.cluster == grain::is_loose, bonded += g.cluster >= 0;
        CHECK((loose > 2 && bonded > 2));
        CHECK(digest_of(one) == digest_of(crushed<staged>(3, false)));
        CHECK(digest_of(one) == digest_of(crushed<staged>(2, true)));
        CHECK(to_bytes(one) == to_bytes(crushed<staged>(3, true)));
    }
}

TEST_CASE("a scene with balls beside clumps that are split keeps its momentum") {
    auto s = scenes::settings<staged>(1.0, 1e6);
    s.scheme.damping = 0.0;
    s.replacement.least_neighbours = 1, s.replacement.most_splits = 3, s.replacement.delay = 1;
    engine<staged> e = scenes::collision(s, shapes::apollonian_14(circumscribed(0.02)));
    const total start = total_of(e);
    int steps_with_balls = 0;
    bool split_beside_balls = false;
    for (int k = 0; k < 300; ++k) {
        const double dt = e.dt();
        const total before = total_of(e);
        const std::size_t grains = e.grains.grain_count();
        const bool balls = e.breakage().has_balls();
        e.step();
        check_tables(e);
        const total after = total_of(e);
        CHECK(after.mass == Approx(start.mass).epsilon(1e-14));
        split_beside_balls = split_beside_balls || (balls && e.grains.grain_count() > grains);
        if (balls && e.dt() != dt) continue; // the spans of balls and clumps differ when the step changes
        steps_with_balls += balls;
        CHECK(norm(after.momentum - before.momentum) < 1e-13 * norm(start.momentum));
    }
    CHECK(steps_with_balls > 100);
    CHECK(split_beside_balls);
}

TEST_CASE("a clump at rest between platens goes on in halves, and the ledger stays closed") {
    engine<halving> e = scenes::pressed(scenes::settings<halving>(never), 300.0);
    const double left = scenes::residual(e), stored = e.elastic_energy();
    scenes::set_utilisation(e, 1.01);
    e.step();
    REQUIRE(e.totals().replaced == 1);
    CHECK(e.elastic_energy() == Approx(stored).epsilon(1e-6));
    for (int k = 0; k < 2000; ++k) e.step();
    CHECK(std::abs(scenes::residual(e) - left) < 2e-3 * stored);
}

TEST_CASE("balls that freeze keep mass, momentum and angular momentum, and the ledger stays closed") {
    for (const std::int32_t parts : {1, 2, -2, 5, -5}) // runs, or across
        for (const double strength : {1e6, 0.02}) {    // of the bonds: many break in the second case
            auto settings = scenes::settings<thawing>(1.0, strength);
            settings.scheme.damping = 0.0;
            settings.replacement.parts = std::abs(parts), settings.replacement.across = parts < 0;
            engine<thawing> e = scenes::collision(settings, shapes::apollonian_14(circumscribed(0.02)));
            while (e.breakage().balls.empty()) e.step();
            e.step(20);
            scene<thawing> s = e.state();
            const total before = total_of(s);
            const auto sum = [&] {
                return rooms::kinetic_energy(s) + rooms::elastic_energy(s) + s.totals.bond_dissipation;
            };
            const double held = sum();
            const std::vector<pebble_pair> carried = s.asleep;
            const std::vector<clump_pebble> was = s.grains.pebbles;
            REQUIRE((s.broken.balls.size() == 28 && s.light.size() > 0));
            rooms::surgery<scene<thawing>> room(s);
            for (std::int32_t g = 1; g >= 0; --g) settings.replacement.again(g, room);
            room.finish();
            REQUIRE(
                (s.broken.balls.empty() && s.grains.grain_count() == 2 * static_cast<std::size_t>(std::abs(parts))));
            CHECK(s.asleep.empty());
            std::vector<std::int32_t> place(was.size()); // of pebbles by their numbers
            for (std::int32_t p = 0; p < 28; ++p) {
                const auto number = static_cast<std::size_t>(s.grains.number_of_pebble(p));
                place[number] = p;
                CHECK((was[number].x == s.position(p) && was[number].radius == s.radius(p)));
                CHECK(s.grains.grains[s.at(s.grains.mother[s.at(p)])].origin == (number < 14 ? 0 : 1));
            }
            CHECK(std::is_sorted(place.begin(), place.end()) == (parts > 0));
            const total after = total_of(s);
            CHECK(after.mass == Approx(before.mass).epsilon(1e-14));
            CHECK(norm(after.momentum - before.momentum) < 1e-13 * norm(before.momentum));
            CHECK(norm(after.angular - before.angular) < 1e-12 * norm(before.angular));
            CHECK(after.energy < before.energy);
            double contacts = 0.0; // between parts, which no list has yet
            for (const pebble_pair& named : carried) {
                const pebble_pair p{place[s.at(named.i)], place[s.at(named.j)]};
                if (s.grains.body_of(p.i) == s.grains.body_of(p.j)) continue;
                const double depth = s.radius(p.i) + s.radius(p.j) - norm(s.position(p.i) - s.position(p.j));
                contacts += s.settings.grain_contact.stored({0, 0, 1, depth, 1, 1}, {});
            }
            CHECK(sum() + contacts == Approx(held).epsilon(1e-12));
            std::vector<vec3> places;
            for (const clump_pebble& p : s.grains.pebbles) places.push_back(p.x);
            for (std::size_t g = 0; g < s.grains.grain_count(); ++g) s.grains.place(g);
            for (std::size_t p = 0; p < places.size(); ++p) CHECK(norm(places[p] - s.grains.pebbles[p].x) < 1e-16);

            // the same inside an engine, which goes on
            while (e.grains.grain_count() == 2 && !e.breakage().balls.empty()) e.step();
            e.take_events();
            check_tables(e);
            const total start = total_of(e);
            for (int k = 0; k < 300; ++k) e.step();
            const total end = total_of(e);
            CHECK(norm(end.momentum - start.momentum) < 1e-12 * norm(start.momentum));
            CHECK(norm(end.angular - start.angular) < 1e-10 * norm(start.angular));
        }
}

TEST_CASE("contacts of balls that freeze go on with their histories") {
    auto settings = scenes::settings<thawing>(1.0, 1e6);
    settings.scheme.damping = 0.0;
    engine<thawing> e = scenes::collision(settings, shapes::apollonian_14(circumscribed(0.02)));
    while (e.breakage().balls.empty()) e.step();
    scene<thawing> s = e.state();
    rooms::renew_lists(s); // contacts have come to the list of balls
    rooms::surgery<scene<thawing>> room(s);
    std::size_t rubbing = 0;
    for (auto& h : s.light.history) h = {1.0 + static_cast<double>(rubbing++), 2.0, 3.0};
    const auto was = s.light;
    for (std::int32_t g = 1; g >= 0; --g) settings.replacement.again(g, room);
    room.finish();
    rooms::renew_lists(s);
    CHECK(s.light.size() == 0);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < s.heavy.size(); ++k) { // others have come near
        const std::size_t at = scenes::position(was, s.heavy.pairs[k]);
        CHECK(s.heavy.history[k].x == (at < was.size() ? was.history[at].x : 0.0));
        kept += at < was.size();
    }
    CHECK(kept > 0);
}

TEST_CASE("contacts between fragments of one grain go on with their histories when pebbles exchange places") {
    auto settings = scenes::settings<thawing>(1.0, 0.02); // many bonds break
    settings.scheme.damping = 0.0;
    settings.replacement.parts = 3, settings.replacement.across = true;
    engine<thawing> e = scenes::collision(settings, shapes::apollonian_14(circumscribed(0.02)));
    while (e.breakage().balls.empty()) e.step();
    e.step(20);
    scene<thawing> s = e.state();
    rooms::renew_lists(s);
    std::size_t number = 0;
    for (std::size_t k = 0; k < s.light.size(); ++k) {
        s.light.history[k] = {1.0 + static_cast<double>(number++), 2.0, 3.0};
        s.light.rows[k].force = {4.0, static_cast<double>(number), 5.0}, s.light.rows[k].normal = {0.6, 0.8, 0.0};
    }
    const auto was = s.light;
    rooms::surgery<scene<thawing>> room(s);
    for (std::int32_t g = 1; g >= 0; --g) settings.replacement.again(g, room);
    room.finish();
    CHECK(std::is_sorted(s.light.pairs.begin(), s.light.pairs.end(), s.pair_order()));
    const auto named = [&](const pebble_pair& p) {
        return pebble_pair{s.grains.number_of_pebble(p.i), s.grains.number_of_pebble(p.j)};
    };
    std::size_t turned = 0, kept = 0;
    for (std::size_t k = 0; k < s.light.size(); ++k) {
        pebble_pair p = named(s.light.pairs[k]);
        const double side = p.i < p.j ? 1.0 : -1.0;
        if (side < 0.0) std::swap(p.i, p.j);
        const std::size_t at = scenes::position(was, p);
        REQUIRE(at < was.size());
        const auto &h = s.light.history[k], &h0 = was.history[at];
        CHECK((h.x == side * h0.x && h.y == side * h0.y && h.z == side * h0.z));
        CHECK(s.light.rows[k].force == side * was.rows[at].force);
        CHECK(s.light.rows[k].normal == side * was.rows[at].normal);
        turned += side<0.0, kept += side> 0.0;
    }
    CHECK((turned > 2 && kept > 2));
    const auto remembered = s.light;
    rooms::renew_lists(s); // and on into the list of clumps
    std::size_t found = 0;
    for (std::size_t k = 0; k < s.heavy.size(); ++k) {
        const std::size_t at = scenes::position(remembered, s.heavy.pairs[k]);
        CHECK(s.heavy.history[k].x == (at < remembered.size() ? remembered.history[at].x : 0.0));
        found += at < remembered.size();
    }
    CHECK(found > 4);
}

TEST_CASE("pictures name pebbles, mothers and fragments by numbers that stay when a grain freezes across its pebbles") {
    auto settings = scenes::settings<thawing>(1.0, 1e6);
    settings.replacement.parts = 2, settings.replacement.across = true;
    engine<thawing> e = scenes::collision(settings);
    while (e.breakage().balls.empty()) e.step();
    const auto before = measure::pebbles_of(e, {});
    std::vector<vec3> reference;
    for (const pebble_view& v : before) reference.push_back(v.position);
    while (!e.breakage().balls.empty()) e.step();
    REQUIRE(e.grains.grain_count() == 4);
    check_tables(e);
    CHECK(e.grains.numbers == std::vector<std::int32_t>{1, 3, 0, 2, 5, 7, 4, 6}); // part 0 comes first
    const auto after = measure::pebbles_of(e, reference);
    const double way = 40 * e.dt() * 3.0;
    for (std::size_t n = 0; n < 8; ++n) {
        CHECK(norm(after[n].position - before[n].position) < way);
        CHECK(norm(after[n].displacement - (after[n].position - before[n].position)) == 0.0);
        CHECK((before[n].grain == static_cast<int>(n / 4) && after[n].grain == static_cast<int>(n / 4)));
        CHECK(before[n].fragment == static_cast<int>(n / 4 * 4));
        CHECK(after[n].fragment == static_cast<int>(n / 4 * 4 + n % 2)); // the least number in it
    }
}

TEST_CASE("surgery refuses what it cannot do, with an error") {
    engine<staged> e = scenes::collision(scenes::settings<staged>(never));
    scene<staged> s(e.settings, e.grains, e.boundary, {});
    s.broken.begin(s.grains, s.settings);
    s.replacing.begin(s.grains.grain_count());
    rooms::sort_pebbles(s);
    s.near.margins.resize(s.grains.movable_count());
    rooms::surgery<scene<staged>> room(s);
    using runs = std::vector<replacements::pebble_run>;
    CHECK_THROWS_AS(room.split(0, runs{}), input_error);
    CHECK_THROWS_AS(room.split(0, runs{{0, 2}}), input_error);
    CHECK_THROWS_AS(room.split(0, runs{{0, 2}, {3, 1}}), input_error);
    CHECK_THROWS_AS(room.split(0, runs{{0, 4}, {4, 0}}), input_error);
    CHECK_THROWS_AS(room.split(0, runs{{2, 2}, {0, 2}}), input_error);
    CHECK_THROWS_AS(room.bond(0, std::vector<bonds::state>(6), 1.0), input_error); // still a clump
    CHECK_THROWS_AS(room.again_in(0, 0), input_error);
    room.split(0, runs{{0, 4}}); // changes nothing
    CHECK((s.grains.grain_count() == 2 && s.totals.replaced == 0));
    room.release(1);
    CHECK_THROWS_AS(room.split(1, runs{{0, 2}, {2, 2}}), input_error); // no clump any more
    CHECK_THROWS_AS(room.release(1), input_error);
    CHECK_THROWS_AS(room.freeze(1, runs{{0, 2}}), input_error);
    CHECK_THROWS_AS(room.freeze(0, runs{{0, 4}}), input_error); // a clump
    using numbers = std::vector<std::int32_t>;
    CHECK_THROWS_AS(room.freeze(1, numbers{0, 1, 0}), input_error);
    CHECK_THROWS_AS(room.freeze(1, numbers{0, 2, 0, 0}), input_error);
    CHECK_THROWS_AS(room.freeze(1, numbers{1, 1, 1, 1}), input_error);
    CHECK_THROWS_AS(room.freeze(1, numbers{0, 1, -1, 0}), input_error);
    CHECK_THROWS_AS(room.freeze(1, numbers{0, 1, 4, 0}), input_error);
    CHECK_THROWS_AS(room.freeze(0, numbers{0, 1, 0, 0}), input_error); // a clump
    CHECK_THROWS_AS(room.bond(1, std::vector<bonds::state>(5), 1.0), input_error);
    room.bond(1, std::vector<bonds::state>(6), 1.0);
    room.split(0, runs{{0, 1}, {1, 3}});
    CHECK(s.broken.members[0] == std::vector<std::int32_t>{2}); // the cluster has moved up
    CHECK(s.grains.owner == std::vector<std::int32_t>{0, 1, 1, 1, 7, 8, 9, 10});
}

TEST_CASE("what overlaps between two parts becomes a contact, whose energy no one has paid for") {
    auto settings = scenes::settings<halving>(never);
    bodies::clumps two = scenes::empty(make_shape("two", {{{0, 0, 0}, 0.005}, {{0.01 - 1.5e-11, 0, 0}, 0.005}}));
    two.add(0, {}, {});
    scene<halving> s(settings, two, boundaries::solid_strips(scenes::cylinder(0.1, 0.1)), {});
    s.replacing.begin(1);
    rooms::sort_pebbles(s);
    s.near.margins.resize(1);
    rooms::surgery<scene<halving>> room(s);
    room.split(0, std::vector<replacements::pebble_run>{{0, 1}, {1, 1}});
    CHECK(s.totals.bond_dissipation == Approx(-0.5 * settings.grain_contact.kn * 1.5e-11 * 1.5e-11).epsilon(1e-5));
    CHECK((s.grains.grain_count() == 2 && s.totals.replaced == 1));
}

TEST_CASE("pairs are sorted again by the parts of a grain that is split, with what they remember") {
    engine<halving> e = scenes::collision(scenes::settings<halving>(never));
    scene<halving> s = e.state();
    s.heavy.pairs = {{3, 4}, {0, 5}, {2, 5}}; // by second pebble: all are of the first grain
    s.heavy.resize();
    for (std::size_t k = 0; k < 3; ++k) s.heavy.history[k].x = static_cast<double>(k);
    rooms::surgery<scene<halving>> room(s);
    room.split(0, std::vector<replacements::pebble_run>{{0, 2}, {2, 2}});
    room.finish();
    CHECK(s.heavy.pairs == std::vector<pebble_pair>{{0, 5}, {3, 4}, {2, 5}});
    CHECK((s.heavy.history[0].x == 1.0 && s.heavy.history[1].x == 0.0 && s.heavy.history[2].x == 2.0));
    CHECK((s.near.must_search && s.estimate_due));
}
