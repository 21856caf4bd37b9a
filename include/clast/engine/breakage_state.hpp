// SPDX-License-Identifier: MIT
// What a breakable scene holds beyond others: light bodies, which are balls that move on their own or in clusters, the
// bonds of these, and what has broken. `unbroken` stands in where nothing breaks: it is empty, and what is asked of it
// vanishes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <clast/bodies/clumps.hpp>
#include <clast/bonds/cluster_pool.hpp>
#include <clast/core/parallel.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast {

/// State that only breakable scenes have.
struct breakage_state {
    std::vector<bonds::cluster_pool> pools;         ///< per shape
    std::vector<std::vector<std::int32_t>> members; ///< per pool: grain of each cluster
    std::vector<std::int32_t> fragment;             ///< per pebble: smallest pebble of its piece
    std::vector<std::uint8_t> bonded;               ///< per pebble: belongs to a cluster with intact bonds
    std::vector<std::int32_t> balls;                ///< pebbles that move on their own, ascending
    std::vector<std::uint8_t> halo;                 ///< per grain: a clump with a ball near by
    struct mean_load {
        vec3 force, moment;
        double dissipated = 0.0;
    };
    std::vector<mean_load> halo_load;   ///< per grain of the halo: mean over the sub-steps of this step
    std::vector<std::size_t> halo_list; ///< the grains of the halo in this step
    std::vector<fracture_event> events; ///< since they were last taken
    double lag = 0.0;                   ///< s: how far the motion of balls trails t_n between steps (half a step)
    double time = 0.0;                  ///< s: of the sub-step that runs

    /// For clumps that are complete; their table of motion gets room for a ball per pebble.
    template <class Settings> void begin(bodies::clumps& g, const Settings& s) {
        make_pools(g, s);
        bonded.assign(g.pebble_count(), 0);
        halo.assign(g.grain_count(), 0);
        fragment.resize(g.pebble_count());
        for (std::size_t p = 0; p < g.pebble_count(); ++p)
            fragment[p] = g.grains[static_cast<std::size_t>(g.mother[p])].first;
        g.motion.resize(g.grain_count() + g.pebble_count());
        g.losses.resize(g.motion.size());
    }

    /// Pools for the shapes that have none yet.
    template <class Settings> void make_pools(const bodies::clumps& g, const Settings& s) {
        for (std::size_t k = pools.size(); k < g.shapes.size(); ++k)
            pools.emplace_back(bonds::lattice(g.shapes[k], s.replacement.bond, g.density), s.scheme.damping);
        members.resize(g.shapes.size());
    }
    /// The balls of a grain are none any more, and its bonds are gone.
    void balls_were_frozen(const bodies::clumps& g, const grain& one) {
        const index_range own = g.pebbles_of(static_cast<std::size_t>(&one - g.grains.data()));
        std::erase_if(balls, [&](std::int32_t p) {
            return own.begin <= static_cast<std::size_t>(p) && static_cast<std::size_t>(p) < own.end;
        });
        for (std::size_t p = own.begin; p < own.end; ++p) bonded[p] = 0;
        if (one.cluster >= 0)
            pools[static_cast<std::size_t>(one.shape)].dissolve(static_cast<std::size_t>(one.cluster));
    }
    /// Grain number g has become `count` clumps, which stand in its place: those behind it have moved up.
    void grain_was_split(const bodies::clumps& g, std::size_t number, std::size_t count) {
        const auto up = static_cast<std::int32_t>(count) - 1, place = static_cast<std::int32_t>(number);
        for (auto& pool : members)
            for (std::int32_t& m : pool) m += m > place ? up : 0;
        halo.insert(halo.begin() + static_cast<std::ptrdiff_t>(number), count - 1, 0);
        for (std::size_t k = number; k < number + count; ++k) {
            const index_range own = g.pebbles_of(k);
            for (std::size_t p = own.begin; p < own.end; ++p) fragment[p] = g.grains[k].first;
        }
    }

    std::vector<fracture_event> take_events() { return std::exchange(events, {}); }
    bool has_balls() const { return !balls.empty(); }
    /// f(pebble, motion) for every ball, ascending.
    template <class F> void each_ball(const bodies::clumps& g, F&& f) const {
        for (std::int32_t p : balls) f(p, g.motion[g.ball(p)]);
    }
    /// Largest f(pebble, motion) over all balls, at least `floor`.
    template <class F> double largest(const bodies::clumps& g, const execution& run, double floor, F&& f) const {
        return run.max(balls.size(), floor, [&](std::size_t k) { return f(balls[k], g.motion[g.ball(balls[k])]); });
    }
    /// Notes where balls are, per pebble.
    void note_places(const bodies::clumps& g, std::vector<vec3>& where) const {
        where.resize(g.pebble_count());
        for (std::int32_t p : balls) where[static_cast<std::size_t>(p)] = g.pebbles[static_cast<std::size_t>(p)].x;
    }
    /// Whether an intact bond joins two pebbles.
    bool is_bonded(const bodies::clumps& g, const pebble_pair& p) const {
        const std::int32_t mother = g.mother[static_cast<std::size_t>(p.i)];
        if (mother != g.mother[static_cast<std::size_t>(p.j)]) return false;
        const grain& one = g.grains[static_cast<std::size_t>(mother)];
        if (one.cluster < 0) return false;
        const bonds::cluster_pool& pool = pools[static_cast<std::size_t>(one.shape)];
        for (std::size_t e = 0; e < pool.bonds(); ++e)
            if (one.first + pool.shape().ends[e].a == p.i && one.first + pool.shape().ends[e].b == p.j)
                return pool.is_intact(static_cast<std::size_t>(one.cluster), e);
        return false;
    }
    /// Moves the pairs that bonds carry from a list of pairs to those that sleep.
    void put_asleep(const bodies::clumps& g, std::vector<pebble_pair>& pairs, std::vector<pebble_pair>& asleep) const {
        asleep.clear();
        std::erase_if(pairs, [&](const pebble_pair& p) {
            if (!is_bonded(g, p)) return false;
            asleep.push_back(p);
            return true;
        });
    }
    /// Finds the clumps with a ball near by, from the light contacts of a scene.
    template <class Scene> void find_halo(Scene& s) {
        s.index_light();
        for (std::size_t g = 0; g < s.grains.grain_count(); ++g)
            halo[g] = s.grains.is_clump(g) && !s.light_of.of(g).empty() ? 1 : 0;
    }
    /// Adds what light bodies exert on a clump in the mean.
    void add_halo_load(std::size_t g, load_sum& load) const {
        if (halo[g] == 0) return;
        load.force += halo_load[g].force;
        load.moment += halo_load[g].moment;
        load.dissipated += halo_load[g].dissipated;
    }
    /// How far (m) a clump will have gone in dt where light contacts see it along its velocity, half a step ahead.
    double way_ahead(const bodies::clumps& g, std::size_t k, double dt) const {
        return halo[k] == 0 ? 0.0 : dt * (norm(g.motion[k].v) + g.bounding_radius(k) * norm(g.motion[k].w));
    }
    /// Number of the piece that a pebble belongs to: its clump, or behind all grains its fragment.
    std::size_t piece_of(const bodies::clumps& g, std::int32_t pebble) const {
        const std::size_t body = g.body_of(pebble);
        return body < g.body_count()
                   ? body
                   : g.body_count() + static_cast<std::size_t>(fragment[static_cast<std::size_t>(pebble)]);
    }
    /// Highest number of a piece, plus one.
    std::size_t piece_count(const bodies::clumps& g) const { return g.body_count() + g.pebble_count(); }
    /// f(piece) for every fragment.
    template <class F> void each_fragment(const bodies::clumps& g, F&& f) const {
        for (std::int32_t p : balls)
            if (fragment[static_cast<std::size_t>(p)] == p) f(g.body_count() + static_cast<std::size_t>(p));
    }
    /// f(pebble, pebble, bonds::state) for every intact bond.
    template <class F> void each_bond(const bodies::clumps& g, F&& f) const {
        for (std::size_t k = 0; k < pools.size(); ++k)
            for (std::size_t c = 0; c < pools[k].size(); ++c)
                for (std::size_t b = 0; b < pools[k].bonds(); ++b) {
                    if (!pools[k].is_intact(c, b)) continue;
                    const std::int32_t first = g.grains[static_cast<std::size_t>(members[k][c])].first;
                    const shape_bond& ends = pools[k].shape().ends[b];
                    f(first + ends.a, first + ends.b, pools[k].get(c, b));
                }
    }
    /// Fragment and state of a pebble, for a picture.
    void describe(const bodies::clumps& g, std::size_t pebble, pebble_view& view) const {
        const grain& one = g.grains[static_cast<std::size_t>(g.mother[pebble])];
        if (one.lost > 0) view.state = pebble_state::fragment;
        if (one.cluster == grain::is_whole) return;
        view.fragment = g.number_of_pebble(fragment[pebble]);
        view.state = pebble_state::fragment;
        if (one.cluster == grain::is_loose) return;
        const auto& pool = pools[static_cast<std::size_t>(one.shape)];
        const bool whole =
            pool.intact_bonds(static_cast<std::size_t>(one.cluster)) == static_cast<std::int32_t>(pool.bonds());
        view.state = whole && one.lost == 0 ? pebble_state::bonded : pebble_state::fragment;
    }
    /// Adds the kinetic energy of balls (J), one by one.
    double add_kinetic_energy(const bodies::clumps& g, double e) const {
        each_ball(g, [&](std::int32_t p, const body_motion& m) {
            const auto k = static_cast<std::size_t>(p);
            e += 0.5 * (g.ball_mass(k) * norm2(m.v) + g.ball_inertia(k) * norm2(m.w));
        });
        return e;
    }

    /// Adds the elastic energy of bonds (J), cluster by cluster.
    double add_bond_energy(double e) const {
        for (const auto& pool : pools)
            for (std::size_t c = 0; c < pool.size(); ++c) e += pool.energy(c);
        return e;
    }

    template <class A> void archive(A& a) {
        for (auto& p : pools) p.archive(a); // lattices are remade from shapes, only their state is kept
        for (auto& m : members) a(m);
        a(fragment, bonded, balls, halo, lag); // events must have been taken
    }
};

/// The same where nothing breaks.
struct unbroken {
    template <class G, class Settings> static void begin(G&, const Settings&) {}
    template <class G, class Settings> static constexpr void make_pools(const G&, const Settings&) {}
    template <class G> static constexpr void grain_was_split(const G&, std::size_t, std::size_t) {}
    static std::vector<fracture_event> take_events() { return {}; }
    static constexpr bool has_balls() { return false; }
    template <class G, class F> static constexpr void each_ball(const G&, F&&) {}
    template <class G, class F> static constexpr double largest(const G&, const execution&, double floor, F&&) {
        return floor;
    }
    template <class G> static constexpr void note_places(const G&, std::vector<vec3>&) {}
    template <class G>
    static constexpr void put_asleep(const G&, std::vector<pebble_pair>&, std::vector<pebble_pair>&) {}
    template <class Scene> static constexpr void find_halo(Scene&) {}
    static constexpr void add_halo_load(std::size_t, load_sum&) {}
    template <class G> static constexpr double way_ahead(const G&, std::size_t, double) { return 0.0; }
    template <class G> static constexpr std::size_t piece_of(const G& g, std::int32_t pebble) {
        return g.body_of(pebble);
    }
    template <class G> static constexpr std::size_t piece_count(const G& g) { return g.body_count(); }
    template <class G, class F> static constexpr void each_fragment(const G&, F&&) {}
    template <class G, class F> static constexpr void each_bond(const G&, F&&) {}
    template <class G> static constexpr void describe(const G&, std::size_t, pebble_view&) {}
    template <class G> static constexpr double add_kinetic_energy(const G&, double e) { return e; }

    static constexpr double add_bond_energy(double e) { return e; }

    template <class A> void archive(A&) {}
};

} // namespace clast
