// SPDX-License-Identifier: MIT
// One step of a specimen inside its boundary: the anatomy that every policy fits into.
//
//   light bodies (balls and bonded clusters) pass through the span around t_n in sub-steps of their own
//       fast contacts and facets (at least one ball), clumps and facets moved along their velocity    rows
//       balls sum their rows in one fixed order, are damped and integrated; clusters sub-cycle their bonds
//   slow facets (clump against facet)                                                                  rows at t_n
//   servo
//   sweep: slow contacts (clump against clump) in blocks of 8, added to the loads of their bodies
//       behind them clumps add walls and the mean of the fast rows, are looked at by the criterion every few steps,
//       damped and integrated, while everything is still at hand
//   boundary moves; replacement
//
// Sweep: pairs are sorted by their first body, then by their second pebble. So when the sweep has passed the pairs of
// body i, every contact of i has been evaluated, as the first body or as the second, and i may move: no later contact
// reads it. With several threads each sweeps a range of bodies of its own; contacts between two ranges are evaluated
// before. In the order of the list the contacts of a body with lower ranges come first and those with higher ranges
// last, so adding the former before the sweep of a range and the latter when a body moves leaves every sum as one
// thread would have it, to the last bit.
//
// Multirate: a contact that involves a ball is integrated with the step that the lightest ball needs, over the span
// from t_n - dt/2 to t_n + dt/2; its mean force over that span acts on the clump at t_n, which is what a leapfrog asks
// for. Bonds take a smaller step still. So a replacement never shrinks the step of the specimen, and every force has
// the opposite force in the same step.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include <clast/bonds/cluster_pool.hpp>
#include <clast/boundaries/concepts.hpp>
#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/contacts/concepts.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/parallel.hpp>
#include <clast/engine/body_ranges.hpp>
#include <clast/bodies/contact_list.hpp>
#include <clast/engine/kernel.hpp>
#include <clast/engine/list_widths.hpp>
#include <clast/engine/pebble_pairs.hpp>
#include <clast/engine/policies.hpp>
#include <clast/bodies/concepts.hpp>
#include <clast/integrators/local_damping.hpp>
#include <clast/integrators/rotation.hpp>
#include <clast/integrators/time_step.hpp>
#include <clast/measure/sample.hpp>

namespace clast {

/// Parameters of an engine that are values, not types. SI units.
template <triaxial_policies P> struct engine_settings {
    typename P::contact grain_contact;   ///< pebble against pebble
    typename P::contact platen_contact;  ///< pebble against platen
    typename P::contact lateral_contact; ///< pebble against the lateral wall
    typename P::breakage breakage;
    typename P::replacement replacement;
    double damping = 0.7;       ///< local damping coefficient in [0, 1)
    double safety = 0.8;        ///< of the time-step estimate, in (0, 1]
    double skin = 0.0;          ///< m: where the skin of the lists starts; 0: from the size of the grains
    double largest_step = 1e-4; ///< s: bound of the time step where nothing touches
    execution run = execution(1);
    std::size_t contacts_per_thread = 256; ///< a sweep with fewer is left to fewer threads; the bits are the same
};

/// State that only breakable specimens have.
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
    std::vector<mean_load> fast_load;   ///< per grain of the halo: mean over the sub-steps of this step
    std::vector<std::size_t> halo_list; ///< the grains of the halo in this step
    std::vector<fracture_event> events; ///< since the last call of take_events
    double lag = 0.0;                   ///< s: how far the motion of balls trails t_n between steps (half a step)
    double time = 0.0;

    template <class A> void archive(A& a) {
        for (auto& p : pools) p.archive(a); // lattices are remade from shapes, only their state is kept
        for (auto& m : members) a(m);
        a(fragment, bonded, balls, halo, lag); // events must have been taken
    }
};

struct nothing {
    template <class A> void archive(A&) {}
};

/// Totals that an audit needs (J), and counters.
struct engine_totals {
    double boundary_work = 0.0;    ///< done on the specimen by platens and lateral wall
    double bond_dissipation = 0.0; ///< released by broken bonds, less what was put into bonds at birth
    double initial_energy = 0.0;   ///< brought in with initial velocities
    std::int64_t steps = 0;
    std::int64_t rebuilds = 0; ///< searches for neighbours
    std::int64_t renewals = 0; ///< of the lists, from what a search has found
    std::int64_t replaced = 0;
    std::int64_t broken_tension = 0;
    std::int64_t broken_shear = 0;
    double time = 0.0;
};

/// A specimen, its boundary and the policies that move them. Construct complete; then call step().
template <triaxial_policies P> class engine {
  public:
    using contact = typename P::contact;
    using history = typename contact::history;
    using boundary_type = typename P::boundary;
    using body_type = typename P::body;
    using settings_type = engine_settings<P>;
    static constexpr bool breakable = P::replacement::makes_bonds;
    static constexpr bool periodic = boundaries::periodic<boundary_type>;
    static_assert(!(periodic && breakable), "clusters in a periodic cell are not made yet");
    static constexpr bool has_criterion = P::breakage::evaluated;

    settings_type settings;
    body_type grains;
    boundary_type boundary;
    boundaries::drives drives;
    bool breakage_on = true; ///< off: criteria are not looked at (bonds of existing clusters still break)

    engine(settings_type s, body_type sp, boundary_type b)
        : settings(std::move(s)), grains(std::move(sp)), boundary(std::move(b)) {
        if constexpr (has_criterion) {
            using criteria::needs;
            if (!criteria::contains(needs::largest_force | needs::stress | needs::grain_id,
                                    criteria::needs_of(settings.breakage)))
                throw input_error("breakage criterion", "needs radius and modulus of the largest contact",
                                  "criteria on the largest force or the mean stress of a grain",
                                  "Take hertz_contact with the nominal radius (its default).");
        }
        if constexpr (breakable) {
            for (const shape& one : grains.shapes)
                broken_.pools.emplace_back(bonds::lattice(one, settings.replacement.bond, grains.density),
                                           settings.damping);
            broken_.members.resize(grains.shapes.size());
            broken_.bonded.assign(grains.pebble_count(), 0);
            broken_.halo.assign(grains.grain_count(), 0);
            broken_.fragment.resize(grains.pebble_count());
            for (std::size_t p = 0; p < grains.pebble_count(); ++p)
                broken_.fragment[p] = grains.grains[at(grains.mother[p])].first;
            grains.motion.resize(grains.grain_count() + grains.pebble_count());
            grains.losses.resize(grains.motion.size());
        }
        smallest_mass_ = grains.smallest_mass();
        widths_ = list_widths(settings.skin > 0.0 ? settings.skin : 0.002 * mean_bounding_radius());
        loads_.assign(static_cast<std::size_t>(boundary.facet_count()), {});
        if constexpr (body_type::turns) sort_pebbles();
        totals_.initial_energy = kinetic_energy();
        search();
        pick();
        estimate_step(true);
    }

    // ---- stepping -------------------------------------------------------------------------------------------------

    /// Advances by `count` steps of dt(), which costs less than as many calls: rows (each_contact) are those of the
    /// last step only. Throws run_error if a number stops being finite or a grain leaves the boundary.
    void step(std::int64_t count = 1) {
        const bool many = count > 1;
        for (; count > 1; --count) one_step(false, false);
        if (count == 1) one_step(true, many);
    }

    double dt() const { return dt_; }
    double time() const { return totals_.time; }
    const engine_totals& totals() const { return totals_; }
    double skin() const { return widths_.skin(); } ///< of the present lists (m)
    int fast_steps() const { return fast_steps_; }
    std::span<const boundaries::facet_load> loads() const { return loads_; }
    const contact_list<history>& slow_contacts() const { return slow_; }
    const contact_list<history>& fast_contacts() const { return fast_; }
    /// Pairs of balls that an intact bond carries: no contacts until it breaks.
    std::span<const pebble_pair> bonded_pairs() const requires breakable { return asleep_; }
    const breakage_state& breakage() const requires breakable { return broken_; }
    /// Broken bonds since the last call, in the order in which they broke.
    std::vector<fracture_event> take_events() {
        if constexpr (breakable) return std::exchange(broken_.events, {});
        return {};
    }

    /// Replaces the boundary by another in the same place (a membrane for the vessel), and the lists with it.
    void set_boundary(boundary_type b) {
        boundary = std::move(b);
        loads_.assign(static_cast<std::size_t>(boundary.facet_count()), {});
        search();
        pick();
    }
    /// Friction between pebbles, of laws that have one (a member `mu`); 0 for others.
    double friction() const {
        if constexpr (requires { settings.grain_contact.mu; }) return settings.grain_contact.mu;
        return 0.0;
    }
    /// Sets it; histories stay and are cut at the new limit in the next step.
    void set_friction(double mu) {
        if constexpr (requires { settings.grain_contact.mu; }) settings.grain_contact.mu = mu;
    }
    /// Sets the velocity of a clump's centre (m/s).
    void set_velocity(std::size_t grain_id, const vec3& v) requires(body_type::turns) {
        grains.motion[grain_id].v = v;
    }
    /// To be called after velocities were set by hand, so that the audit knows of their energy.
    void count_initial_energy() { totals_.initial_energy = kinetic_energy(); }

    /// Complete state, list order and reference positions included: a run that goes on from it has the same bits.
    /// Rows are not part of it, because a step writes all of them before it reads any; events must have been taken. The
    /// number of threads is not either: lists are saved as one thread would have them.
    template <class A> void archive(A& a) {
        place_all();
        join_shared(wide_.slow, pair_order());
        join_shared(slow_, pair_order());
        a(grains, boundary, settings.grain_contact, breakage_on, totals_, dt_, fast_steps_, must_search_, must_renew_,
          estimate_due_);
        a(drives.platens.how, drives.platens.value, drives.platens.max_speed, drives.platens.gain);
        a(drives.lateral.how, drives.lateral.value, drives.lateral.max_speed, drives.lateral.gain);
        a(wide_, slow_, slow_wall_, since_, margins_, wall_margin_, listed_, unlisted_, stretch_, widest_, widths_);
        if constexpr (breakable) a(fast_, asleep_, fast_wall_, fast_of_, broken_);
        slow_of_.reset();
        cut_ranges(); // as the threads of this run ask for
        bring_shared_forward(slow_, between_ranges());
        index_ranges();
        fast_.rows.resize(fast_.size());                                 // written anew by the next step
        loads_.resize(static_cast<std::size_t>(boundary.facet_count())); // like rows, written anew by the next step
        work_loads_.resize(loads_.size());
    }

    // ---- what measurements read ----------------------------------------------------------------------------------

    /// Calls f(row, pair) for all contacts listed in the last step, in an order that does not depend on threads; body
    /// ids of a pair through grains.owner. Before the first step there are none.
    template <class F> void each_contact(F&& f) const {
        if (!slow_.rows.empty()) each_slow([&](std::size_t k) { f(slow_.rows[k], slow_.pairs[k]); });
        for (std::size_t k = 0; k < fast_.size(); ++k) f(fast_.rows[k], fast_.pairs[k]);
    }
    /// From the centre of the first body of a contact to that of the second, through the contact (m): right across the
    /// faces of a periodic cell, too.
    vec3 branch_of(const force_row& row, const pebble_pair& pair) const {
        const auto& i = grains.pebbles[at(pair.i)];
        const auto& j = grains.pebbles[at(pair.j)];
        const vec3 between = (i.radius + j.radius - row.depth) * row.normal;
        if constexpr (body_type::turns) return i.x - centre_of(pair.i) + between + centre_of(pair.j) - j.x;
        return between;
    }
    /// Centre of the body of a pebble (m).
    vec3 centre_of(std::int32_t pebble) const {
        const std::size_t body = grains.body_of(pebble);
        return body < grains.body_count() ? grains.centre(body) : grains.pebbles[at(pebble)].x;
    }
    /// A pebble at the boundary: what touches it and the forces that it takes (N).
    struct wall_row {
        std::int32_t pebble = -1;
        double lateral = 0.0;           ///< size of the lateral force (N)
        vec3 force;                     ///< on the pebble
        std::array<double, 2> platen{}; ///< force of bottom and top platen (N)
        boundaries::touches touch;

        /// Force (N) along the normal of one of its touches: lateral facets share by their parts of the way out.
        double share(const boundaries::touch& t) const {
            return t.facet < boundaries::first_lateral_facet
                       ? platen[static_cast<std::size_t>(t.facet)]
                       : lateral * t.depth / norm(boundaries::lateral_push(touch));
        }
        template <class A> void archive(A& a) { a(pebble); }
    };
    template <class F> void each_wall_row(F&& f) const {
        for (const wall_row& w : slow_wall_) f(w);
        for (const wall_row& w : fast_wall_) f(w);
    }
    double kinetic_energy() const {
        double e = settings.run.sum(grains.body_count(), 0.0,
                                    [&](std::size_t b) { return grains.is_swept(b) ? grains.kinetic_energy(b) : 0.0; });
        if constexpr (breakable)
            for (std::int32_t p : broken_.balls) {
                const body_motion& m = grains.motion[ball(p)];
                e += 0.5 * (grains.ball_mass(at(p)) * norm2(m.v) + grains.ball_inertia(at(p)) * norm2(m.w));
            }
        return e;
    }
    /// Energy in contacts, facets and bonds (J).
    double elastic_energy() const {
        double e = 0.0;
        const auto add = [&](const contact_list<history>& list, std::size_t k) {
            const auto& pr = list.pairs[k];
            const double d = norm(apart(list, k));
            const double ri = grains.pebbles[at(pr.i)].radius, rj = grains.pebbles[at(pr.j)].radius;
            const history none{};
            const history* h = &none;
            if constexpr (contact_list<history>::remembers) h = &list.history[k];
            e += settings.grain_contact.stored({0, 0, 1, ri + rj - d, ri, rj}, *h);
        };
        each_slow([&](std::size_t k) { add(slow_, k); });
        for (std::size_t k = 0; k < fast_.size(); ++k) add(fast_, k);
        each_wall_row([&](const wall_row& w) {
            const double r = grains.pebbles[at(w.pebble)].radius;
            const double lateral = norm(boundaries::lateral_push(w.touch));
            if (lateral > 0.0) e += settings.lateral_contact.stored({0, 0, 1, lateral, r, r}, {});
            for (const boundaries::touch& t : w.touch)
                if (t.facet < boundaries::first_lateral_facet)
                    e += settings.platen_contact.stored({0, 0, 1, t.depth, r, r}, {});
        });
        if constexpr (breakable)
            for (const auto& pool : broken_.pools)
                for (std::size_t c = 0; c < pool.size(); ++c) e += pool.energy(c);
        return e;
    }
    body_losses losses() const {
        body_losses total;
        for (const body_losses& l : grains.losses) total.friction += l.friction, total.damping += l.damping;
        return total;
    }
    /// Places the pebbles that no contact needed, too (for output; changes nothing that a step reads).
    void place_all() {
        if constexpr (body_type::turns)
            settings.run.for_each(grains.body_count(), [&](std::size_t b) {
                if (grains.is_swept(b)) grains.place(b, unlisted_.of(b));
            });
    }

  private:
    static constexpr std::size_t rows_at_once = 256; ///< contacts that are evaluated in one go
    using strip_type = strip<contact, decltype(std::declval<const body_type&>().view())>;

    /// f(k) for the slow contacts in the order that one thread gives them.
    template <class F> void each_slow(F&& f) const { slow_.each_in_order(pair_order(), f); }
    /// Order of the lists: by first body, second pebble, first pebble.
    auto pair_order() const {
        return [this](const pebble_pair& a, const pebble_pair& b) {
            const std::size_t ga = grains.group_of(a.i), gb = grains.group_of(b.i);
            return ga != gb ? ga < gb : a.j != b.j ? a.j < b.j : a.i < b.i;
        };
    }

    static constexpr std::int64_t step_interval = 50; ///< steps between estimates of the time step
    static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
    std::size_t ball(std::int32_t pebble) const { return grains.grain_count() + at(pebble); }
    bool has_light_bodies() const {
        if constexpr (breakable) return !broken_.balls.empty();
        return false;
    }

    // ---- one step -------------------------------------------------------------------------------------------------

    /// keep_rows: for those who look after the step; last_of_many: what is looked at now and then only was left out.
    void one_step(bool keep_rows, bool last_of_many) {
        if (must_search_ || must_renew_) renew_lists();
        if (estimate_due_ || totals_.steps % step_interval == 0) estimate_step(false);
        if constexpr (breakable)
            if (has_light_bodies()) advance_light();
        settings.run.for_each(slow_wall_.size(), [&](std::size_t k) { evaluate_wall(slow_wall_[k], dt_, 0.0); });
        control();
        bool observe = false;
        if constexpr (periodic)
            observe = totals_.steps % boundary_type::look == 0 ? keep_rows || boundary.has_servo()
                                                               : last_of_many && !boundary.has_servo();
        if constexpr (breakable && has_criterion)
            if (look_ = breakage_on && totals_.steps % settings.replacement.check_interval == 0; look_) index_slow();
        const margin_use use = sweep(keep_rows || observe || look_);
        if constexpr (periodic) {
            add_work_of_images();
            if (observe) observe_stress();
        }
        finish_boundary();
        if constexpr (breakable) {
            broken_.lag = 0.5 * dt_;
            place_balls();
            replace_marked();
        }
        totals_.time += dt_;
        ++totals_.steps;
        check_margins(use);
    }

    // ---- forces ---------------------------------------------------------------------------------------------------

    /// Fast contacts: clumps are where their velocity takes them, `ahead` seconds from t_n, balls have been placed by
    /// their sub-step. All rows are kept.
    struct fast_job {
        engine& owner;
        double ahead;

        [[gnu::always_inline]] void adjust(strip_type& s, const contact_block& block) const {
            const body_type& g = owner.grains;
            const auto is_clump = [&g](std::int32_t p) { return at(g.owner[at(p)]) < g.grain_count(); };
            for (std::size_t k = block.at; k < block.at + block.size; ++k) {
                const pebble_pair& p = owner.fast_.pairs[block.row + k - block.at];
                vec3 by;
                if (is_clump(p.i))
                    by -= ahead * g.velocity_of(p.i);
                else // a ball is placed elsewhere than its motion, which trails it
                    s.aix[k] = s.aiy[k] = s.aiz[k] = 0.0;
                if (is_clump(p.j))
                    by += ahead * g.velocity_of(p.j);
                else
                    s.ajx[k] = s.ajy[k] = s.ajz[k] = 0.0;
                s.dx[k] += by.x, s.dy[k] += by.y, s.dz[k] += by.z;
            }
        }
        template <class Width>
        [[gnu::always_inline]] void take(Width, const strip_type& s, const contact_block& block) const {
            keep_rows(s, block, owner.fast_.rows.data());
        }
    };
    /// Rows of the fast list and its wall, `ahead` seconds from t_n. h: span since the last evaluation.
    void evaluate_fast(double h, double ahead) {
        each_chunk(fast_.size(), [&](index_range some) {
            evaluate(fast_, some, grains.view(), settings.grain_contact, h, fast_job{*this, ahead});
        });
        settings.run.for_each(fast_wall_.size(), [&](std::size_t k) { evaluate_wall(fast_wall_[k], h, ahead); });
    }
    /// f(rows) for the first n contacts of a list by chunks, side by side on all threads.
    template <class F> void each_chunk(std::size_t n, F&& f) {
        settings.run.for_each((n + rows_at_once - 1) / rows_at_once,
                              [&](std::size_t k) {
                                  f(index_range{k * rows_at_once, std::min(n, (k + 1) * rows_at_once)});
                              },
                              1);
    }
    /// Number of the first contact from row `row` on that goes across a face of a periodic cell.
    std::size_t across_from(std::size_t row) const {
        return static_cast<std::size_t>(std::lower_bound(across_.begin(), across_.end(), row) - across_.begin());
    }
    /// Slow contacts: what they exert is added to their bodies, or kept if they are between two ranges.
    struct slow_job {
        engine& owner;
        std::size_t gathered, taken; ///< where in across_ to go on
        bool shared;                 ///< between two ranges
        force_row* rows;             ///< of the list, or nullptr if nobody looks at them
        load_sum* const acting = owner.acting_.data();
        contact_load<>* const shared_load = owner.shared_load_.data();

        [[gnu::always_inline]] void adjust(strip_type& s, const contact_block& block) {
            if (!shared && is_long_list(owner.slow_)) // what take() will add to
                for (std::size_t k = 0; k < block.size; ++k)
                    __builtin_prefetch(&acting[at(s.bodies[block.at + k].j)], 1);
            if constexpr (periodic)
                each_across(gathered, block, [&](std::size_t a, std::size_t k) {
                    const std::uint8_t image = owner.slow_.image[owner.across_[a]];
                    const vec3 &by = owner.shift_[image], &faster = owner.shift_speed_[image];
                    s.dx[k] += by.x, s.dy[k] += by.y, s.dz[k] += by.z;
                    s.vx[k] += faster.x, s.vy[k] += faster.y, s.vz[k] += faster.z;
                });
        }
        template <class Width>
        [[gnu::always_inline]] void take(Width width, const strip_type& s, const contact_block& block) {
            each_load(width, s, block, *this);
            if constexpr (periodic)
                each_across(taken, block, [&](std::size_t a, std::size_t k) {
                    owner.across_force_[a] = {s.fx[k], s.fy[k], s.fz[k]};
                });
            if (rows != nullptr) keep_rows(s, block, rows);
        }
        template <class Load>
        [[gnu::always_inline]] void operator()(std::size_t row, const pebble_pair& bodies, const Load& load) const {
            if (shared) {
                load.store(shared_load[row]);
            } else {
                load.add_to_i(acting[at(bodies.i)]);
                load.add_to_j(acting[at(bodies.j)]);
            }
        }
        /// f(a, lane) for every contact of a block that goes across a face of a periodic cell.
        template <class F> void each_across(std::size_t& a, const contact_block& block, F&& f) const {
            for (; a < owner.across_.size() && owner.across_[a] < block.row + block.size; ++a)
                f(a, block.at + owner.across_[a] - block.row);
        }
    };
    /// Evaluates some slow contacts. across: across_from(rows.begin); returns that of rows.end.
    std::size_t evaluate_slow(index_range rows, std::size_t across, bool keep) {
        return evaluate(slow_, rows, grains.view(), settings.grain_contact, dt_,
                        slow_job{*this, across, across, rows.begin < slow_.shared, keep ? slow_.rows.data() : nullptr})
            .taken;
    }
    void set_shifts() {
        if constexpr (periodic)
            for (std::size_t image = 0; image < shift_.size(); ++image) {
                shift_[image] = image_shift(image, boundary.edges());
                shift_speed_[image] = image_shift(image, boundary.edge_speeds());
            }
    }
    /// From pebble i to the image of pebble j that pair k of a list means (m).
    vec3 apart(const pair_list& list, std::size_t k) const {
        const pebble_pair& p = list.pairs[k];
        const vec3 d = grains.pebbles[at(p.j)].x - grains.pebbles[at(p.i)].x;
        if constexpr (periodic)
            if (list.image[k] != no_shift) return d + image_shift(list.image[k], boundary.edges());
        return d;
    }

    void evaluate_wall(wall_row& w, double h, double ahead) const {
        const vec3& x = grains.pebbles[at(w.pebble)].x;
        const double r = grains.pebbles[at(w.pebble)].radius;
        const boundaries::touches touching = boundary.touch(x, r, ahead);
        w.force = {}, w.lateral = 0.0, w.platen = {}, w.touch.size = 0;
        if (touching.size == 0) return;
        // facets are frictionless: the law sees no tangential motion and keeps no history
        const auto push = [&](const contact& law, double depth, double approach) {
            const contacts::overlap<double> o{0, 0, 1, depth, r, r};
            const contacts::motion<double> m{0, 0, 0, 0, approach};
            if constexpr (requires { law.normal_force(o, m); })
                return law.normal_force(o, m);
            else {
                history none{};
                return -law(o, m, none, h).fz;
            }
        };
        const vec3 v = grains.velocity_of(w.pebble);
        const auto closing = [&](const boundaries::touch& t) {
            return t.along * boundary.velocity(t.facet) - dot(v, t.normal);
        };
        const vec3 u = boundaries::lateral_push(touching);
        const double way = norm(u);
        if (way > 0.0) {
            double approach = 0.0; // rate of the way out: that of each facet by its share
            for (const boundaries::touch& t : touching)
                if (t.facet >= boundaries::first_lateral_facet) approach += t.depth / way * closing(t);
            w.lateral = push(settings.lateral_contact, way, approach);
            w.force += (w.lateral / way) * u;
        }
        for (const boundaries::touch& t : touching)
            if (t.facet < boundaries::first_lateral_facet) {
                const double f = push(settings.platen_contact, t.depth, closing(t));
                w.platen[at(t.facet)] = f;
                w.force += f * t.normal;
            }
        w.touch = touching; // last: to copy at once what has just been written in pieces takes a fifth of all this
    }

    /// Adds what wall rows exert on facets, in order; names the facets that share a pebble if asked to.
    void add_loads(const std::vector<wall_row>& wall, double share, std::vector<boundaries::facet_load>& loads,
                   std::vector<boundaries::coupling>* couplings = nullptr) const {
        for (const wall_row& w : wall) {
            if (w.touch.size == 0) continue;
            const double way = norm(boundaries::lateral_push(w.touch));
            const double r = grains.pebbles[at(w.pebble)].radius;
            boundaries::sharing_matrix sharing{};
            int lateral = 0;
            if (couplings != nullptr && w.touch.size > 1) sharing = boundaries::sharing(w.touch);
            std::array<const boundaries::touch*, 3> seen{};
            for (const boundaries::touch& t : w.touch) {
                const bool platen = t.facet < boundaries::first_lateral_facet;
                const double f = w.share(t);
                const double k = (platen ? settings.platen_contact : settings.lateral_contact)
                                     .normal_stiffness({0, 0, 1, platen ? t.depth : way, r, r});
                if (platen || couplings == nullptr || w.touch.size == 1) {
                    loads[at(t.facet)].add(t, share * f, share * k);
                    continue;
                }
                const auto i = static_cast<std::size_t>(lateral);
                loads[at(t.facet)].add(t, share * f, share * k * sharing[i][i]);
                for (std::size_t j = 0; j < i; ++j)
                    couplings->push_back({seen[j]->facet, t.facet, k * sharing[i][j] * seen[j]->along * t.along});
                seen[at(lateral++)] = &t;
            }
        }
    }

    /// Sum of the fast rows of one body about its centre, in the order of the list; `ahead` seconds from t_n, like the
    /// centre. Friction losses are booked on side i.
    load_sum sum_fast(std::size_t body, const vec3& centre, double ahead) const {
        load_sum s;
        for (const incidence::entry& one : fast_of_.of(body)) {
            const auto& p = grains.pebbles[at(one.pebble)];
            vec3 arm = p.x - centre;
            if (ahead != 0.0) arm += ahead * grains.velocity_of(one.pebble);
            if (one.row() < fast_.size()) {
                const force_row& row = fast_.rows[one.row()];
                const double side = one.side();
                const vec3 f = side * row.force;
                s.force += f;
                s.moment += cross(arm + (side * (p.radius - 0.5 * row.depth)) * row.normal, f);
                s.dissipated += (0.5 + 0.5 * side) * row.dissipated; // on side i
            } else {
                const wall_row& w = fast_wall_[one.row() - fast_.size()];
                s.force += w.force;
                s.moment += cross(arm, w.force);
            }
        }
        return s;
    }

    // ---- integration ----------------------------------------------------------------------------------------------

    /// Evaluates all slow contacts and moves all swept bodies.
    margin_use sweep(bool keep) {
        set_shifts();
        if (keep) slow_.rows.resize(slow_.size());
        each_chunk(slow_.shared, [&](index_range some) { evaluate_slow(some, across_from(some.begin), keep); });
        settings.run.for_each(
            ranges_.size(), [&](std::size_t r) { sweep_range(ranges_[r], sweeping_[r], keep); }, 1);
        margin_use use = margin_use::within;
        for (const range_work& r : sweeping_) use = std::max(use, r.use);
        if constexpr (breakable && has_criterion)
            for (range_work& r : sweeping_) {
                std::move(r.marked.begin(), r.marked.end(), std::back_inserter(marked_));
                r.marked.clear();
            }
        return use;
    }

    struct birth_certificate {
        std::int32_t grain;
        std::vector<bonds::state> born;
    };
    /// What one thread works with while it sweeps its range.
    struct range_work {
        std::vector<moving_body> ready;      ///< bodies whose loads are complete, until a strip of them is moved
        margin_use use = margin_use::within; ///< of its bodies
        std::vector<birth_certificate> marked;
    };

    void sweep_range(const body_range& r, range_work& work, bool keep) {
        for (std::uint32_t k : r.incoming) shared_load_[k].add_to_j(acting_[grains.body_of(slow_.pairs[k].j)]);
        std::size_t row = r.rows.begin, body = r.bodies.begin, shared = r.first_shared, wall = r.first_wall;
        std::size_t across = across_from(row);
        work.use = margin_use::within;
        for (;;) {
            for (; body < r.bodies.end && ranges_.end_of(body) <= row; ++body)
                if (grains.is_swept(body)) {
                    work.ready.push_back({body, complete_load(work, body, shared, wall)});
                    if (work.ready.size() == clump_strip::length) move_ready(work);
                }
            if (row == r.rows.end) break;
            const std::size_t end = std::min(row + rows_at_once, r.rows.end);
            across = evaluate_slow({row, end}, across, keep);
            row = end;
        }
        move_ready(work);
    }
    /// What acts on a body whose contacts in the range have been evaluated. `shared`, `wall`: the shared contacts and
    /// wall rows that come next.
    load_sum complete_load([[maybe_unused]] range_work& work, std::size_t g, std::size_t& shared, std::size_t& wall) {
        load_sum& sum = acting_[g];
        for (; shared < slow_.shared && grains.body_of(slow_.pairs[shared].i) == g; ++shared)
            shared_load_[shared].add_to_i(sum);
        load_sum load = sum;
        sum = {};
        for (; wall < slow_wall_.size() && grains.body_of(slow_wall_[wall].pebble) == g; ++wall) {
            const wall_row& w = slow_wall_[wall];
            load.force += w.force;
            if constexpr (body_type::turns)
                load.moment += cross(grains.pebbles[at(w.pebble)].x - grains.centre(g), w.force);
        }
        if constexpr (breakable) {
            if (broken_.halo[g] != 0) {
                load.force += broken_.fast_load[g].force;
                load.moment += broken_.fast_load[g].moment;
                load.dissipated += broken_.fast_load[g].dissipated;
            }
            if (look_ && is_critical(g)) work.marked.push_back(certificate(g));
        }
        return load;
    }
    void move_ready(range_work& work) {
        // fast contacts see a clump along its velocity, half a step ahead
        const auto ahead = [&]([[maybe_unused]] std::size_t g) {
            if constexpr (breakable)
                if (broken_.halo[g] != 0)
                    return dt_ * (norm(grains.motion[g].v) + grains.bounding_radius(g) * norm(grains.motion[g].w));
            return 0.0;
        };
        work.use = std::max(work.use, grains.advance(std::span<const moving_body>(work.ready), dt_, settings.damping,
                                                     listed_, {since_.bodies, margins_, stretch_}, ahead));
        work.ready.clear();
    }

    /// Balls and clusters from t_n - lag to t_n + dt/2 in sub-steps; the mean of what they do to clumps and facets.
    void advance_light() {
        if constexpr (breakable) {
            const double span = broken_.lag + 0.5 * dt_;
            const double h = span / fast_steps_, share = 1.0 / fast_steps_;
            broken_.fast_load.resize(grains.grain_count());
            broken_.halo_list.clear();
            for (std::size_t g = 0; g < grains.grain_count(); ++g)
                if (broken_.halo[g] != 0) broken_.halo_list.push_back(g), broken_.fast_load[g] = {};
            std::fill(work_loads_.begin(), work_loads_.end(), boundaries::facet_load{});
            for (int k = 0; k < fast_steps_; ++k) {
                const double ahead = (k + 0.5) * h - broken_.lag;
                place_balls(0.5 * h);
                evaluate_fast(h, ahead);
                couplings_.clear(); // those of the last sub-step are kept
                add_loads(fast_wall_, share, work_loads_, &couplings_);
                settings.run.for_each(broken_.halo_list.size(), [&](std::size_t i) {
                    const std::size_t g = broken_.halo_list[i];
                    const body_motion& m = grains.motion[g];
                    const load_sum s = sum_fast(g, m.x + ahead * m.v, ahead);
                    breakage_state::mean_load& mean = broken_.fast_load[g];
                    mean.force += share * s.force;
                    mean.moment += share * s.moment;
                    mean.dissipated += s.dissipated;
                });
                settings.run.for_each(broken_.balls.size(), [&](std::size_t b) {
                    const std::int32_t p = broken_.balls[b];
                    if (broken_.bonded[at(p)] == 0) advance_ball(at(p), h);
                });
                broken_.time = totals_.time + ahead;
                for (std::size_t s = 0; s < broken_.pools.size(); ++s) advance_clusters(s, h);
            }
        }
    }

    /// Places balls where they will be in `later` seconds at their velocity (by default at t_n).
    void place_balls(double later) {
        if constexpr (breakable)
            settings.run.for_each(broken_.balls.size(), [&](std::size_t k) {
                const body_motion& m = grains.motion[ball(broken_.balls[k])];
                grains.pebbles[at(broken_.balls[k])].x = m.x + later * m.v;
            });
    }
    void place_balls() { place_balls(broken_.lag); }

    void advance_ball(std::size_t p, double h) {
        const std::size_t b = ball(static_cast<std::int32_t>(p));
        body_motion& m = grains.motion[b];
        const load_sum s = sum_fast(b, grains.pebbles[p].x, 0.0);
        const vec3 df = damping_force(s.force, m.v, settings.damping);
        const vec3 dm = damping_force(s.moment, m.w, settings.damping);
        const vec3 v = m.v, w = m.w;
        m.v += (h / grains.ball_mass(p)) * (s.force + df);
        m.w += (h / grains.ball_inertia(p)) * (s.moment + dm);
        m.x += 0.5 * h * (v + m.v);
        grains.losses[b].damping -= 0.5 * h * (dot(df, v + m.v) + dot(dm, w + m.w));
        grains.losses[b].friction += s.dissipated;
    }

    /// Clusters feel the contact forces of the middle of the sub-step, constant over it, while their bonds take small
    /// steps. Forces held on from the instant at which they were evaluated would feed energy into every contact.
    void advance_clusters(std::size_t which, double h) {
        if constexpr (breakable) {
            bonds::cluster_pool& pool = broken_.pools[which];
            const std::size_t n = pool.shape().size();
            pool.pack();
            std::vector<std::vector<bonds::break_report>> reports(pool.batches());
            settings.run.for_each(
                pool.batches(),
                [&](std::size_t batch) {
                    std::vector<bonds::ball_motion> balls(lanes * n);
                    std::vector<bonds::pebble_load> load(lanes * n);
                    std::vector<vec3> moved(lanes * n);
                    std::array<std::size_t, lanes> first{};
                    std::array<bool, lanes> live{};
                    for (std::size_t l = 0; l < lanes; ++l) {
                        const std::int32_t cluster = pool.living(batch, l);
                        live[l] = cluster >= 0;
                        if (!live[l]) continue;
                        first[l] = at(grains.grains[at(broken_.members[which][at(cluster)])].first);
                        for (std::size_t k = 0; k < n; ++k) {
                            const std::size_t b = ball(static_cast<std::int32_t>(first[l] + k));
                            const body_motion& m = grains.motion[b];
                            const load_sum s = sum_fast(b, grains.pebbles[first[l] + k].x, 0.0);
                            balls[l * n + k] = {m.v, m.w, grains.pebbles[first[l] + k].x};
                            load[l * n + k] = {s.force, s.moment};
                            grains.losses[b].friction += s.dissipated;
                        }
                    }
                    const auto lost = pool.advance(batch, h, balls, load, moved, reports[batch]);
                    for (std::size_t l = 0; l < lanes; ++l) {
                        if (!live[l]) continue;
                        for (std::size_t k = 0; k < n; ++k) {
                            const std::size_t b = ball(static_cast<std::int32_t>(first[l] + k));
                            body_motion& m = grains.motion[b];
                            m.x += moved[l * n + k];
                            m.v = balls[l * n + k].velocity;
                            m.w = balls[l * n + k].spin;
                        }
                        grains.losses[ball(static_cast<std::int32_t>(first[l]))].damping += lost[l];
                    }
                },
                1);
            std::vector<bonds::break_report> broken;
            for (const auto& batch : reports) broken.insert(broken.end(), batch.begin(), batch.end());
            std::sort(broken.begin(), broken.end(), bonds::told_before);
            const std::size_t listed = fast_.size();
            for (const bonds::break_report& r : broken) record_break(which, r);
            if (fast_.size() != listed) index_fast();
        }
    }

    // ---- breakage -------------------------------------------------------------------------------------------------

    void record_break(std::size_t which, const bonds::break_report& r) {
        if constexpr (breakable) {
            const bonds::cluster_pool& pool = broken_.pools[which];
            const std::int32_t g = broken_.members[which][at(r.cluster)];
            const std::int32_t first = grains.grains[at(g)].first;
            const shape_bond& ends = pool.shape().ends[at(r.bond)];
            const pebble_pair pair{first + ends.a, first + ends.b};
            const vec3 d = grains.pebbles[at(pair.j)].x - grains.pebbles[at(pair.i)].x;
            fracture_event e;
            e.time = broken_.time;
            e.mode = r.mode;
            e.normal = unit(d);
            e.position = grains.pebbles[at(pair.i)].x + grains.pebbles[at(pair.i)].radius * e.normal;
            e.mother = g;
            e.bond = r.bond;
            e.normal_force = r.before.n;
            e.shear_force = norm(r.before.v);
            e.bending_moment = norm(r.before.mb);
            e.twisting_moment = std::abs(r.before.mt);
            e.energy = bonds::energy(pool.shape().bond[at(r.bond)], r.before);
            broken_.events.push_back(e);
            totals_.bond_dissipation += e.energy;
            ++(r.mode == break_mode::tension ? totals_.broken_tension : totals_.broken_shear);
            // the pair goes on as a frictional contact
            const auto order = pair_order();
            const std::size_t k = find_pair(asleep_, pair, order);
            if (k < asleep_.size()) {
                asleep_.erase(asleep_.begin() + static_cast<std::ptrdiff_t>(k));
                fast_.insert(pair, order);
                wide_.fast.insert(pair, order);
            }
            update_fragments(which, r.cluster);
            estimate_due_ = true; // a lighter piece may need a smaller sub-step
        }
    }

    /// Connected pieces of a cluster, named by their smallest pebble.
    void update_fragments(std::size_t which, std::int32_t cluster) {
        if constexpr (breakable) {
            const bonds::cluster_pool& pool = broken_.pools[which];
            const std::int32_t first = grains.grains[at(broken_.members[which][at(cluster)])].first;
            const std::size_t n = pool.shape().size();
            for (std::size_t k = 0; k < n; ++k) broken_.fragment[at(first) + k] = first + static_cast<std::int32_t>(k);
            bool changed = true;
            while (changed) {
                changed = false;
                for (std::size_t e = 0; e < pool.bonds(); ++e) {
                    if (!pool.is_intact(at(cluster), e)) continue;
                    std::int32_t& a = broken_.fragment[at(first + pool.shape().ends[e].a)];
                    std::int32_t& b = broken_.fragment[at(first + pool.shape().ends[e].b)];
                    if (a != b) a = b = std::min(a, b), changed = true;
                }
            }
            if (pool.intact_bonds(at(cluster)) == 0)
                for (std::size_t k = 0; k < n; ++k) broken_.bonded[at(first) + k] = 0;
        }
    }

    /// The criterion of a clump under the forces just evaluated.
    bool is_critical(std::size_t g) const {
        if constexpr (breakable && has_criterion)
            return !grains.shape_of(grains.grains[g]).bonds.empty() &&
                   settings.breakage.utilisation(load_of(g)) >= settings.replacement.trigger;
        return false;
    }
    /// The bonds with which a critical clump will be born as a cluster: solved for its present load.
    birth_certificate certificate(std::size_t g) const {
        if constexpr (breakable) {
            const grain& one = grains.grains[g];
            std::vector<bonds::pebble_load> load(grains.shape_of(one).pebbles.size());
            each_row_of(g, [&](std::int32_t pebble, std::int32_t, const vec3& f, const vec3& point) {
                bonds::pebble_load& l = load[at(pebble - one.first)];
                l.force += f;
                l.moment += cross(point - grains.pebbles[at(pebble)].x, f);
            });
            return {static_cast<std::int32_t>(g), settings.replacement.born(broken_.pools[at(one.shape)].shape(), load,
                                                                            grains.turning[g].q, grains.motion[g].w)};
        }
        return {};
    }

    /// f(pebble, neighbour, force, point) for every row of clump g; neighbour: body id, or -1 - facet.
    template <class F> void each_row_of(std::size_t g, F&& f) const {
        const auto visit = [&](const incidence& of, const contact_list<history>& list,
                               const std::vector<wall_row>& wall) {
            for (const incidence::entry& one : of.of(g)) {
                if (one.row() < list.size()) {
                    const force_row& row = list.rows[one.row()];
                    if (row.depth == 0.0) continue;
                    const auto& p = grains.pebbles[at(one.pebble)];
                    const double side = one.side();
                    const pebble_pair& pair = list.pairs[one.row()];
                    f(one.pebble, grains.owner[at(one.is_second() ? pair.i : pair.j)], side * row.force,
                      p.x + (side * (p.radius - 0.5 * row.depth)) * row.normal);
                } else {
                    const wall_row& w = wall[one.row() - list.size()];
                    for (const boundaries::touch& t : w.touch) {
                        f(w.pebble, -1 - t.facet, w.share(t) * t.normal,
                          grains.pebbles[at(w.pebble)].x - grains.pebbles[at(w.pebble)].radius * t.normal);
                    }
                }
            }
        };
        visit(*slow_of_, slow_, slow_wall_);
        if constexpr (breakable)
            if (has_light_bodies()) visit(fast_of_, fast_, fast_wall_);
    }

    /// What a criterion may ask of a clump: the largest resultant over its neighbours and its mean stress.
    criteria::grain_load load_of(std::size_t g) const {
        const shape& s = grains.shape_of(grains.grains[g]);
        criteria::grain_load load;
        load.diameter = s.diameter;
        load.volume = s.volume;
        load.grain = static_cast<std::int64_t>(g);
        const bool wants_stress = criteria::contains(criteria::needs_of(settings.breakage), criteria::needs::stress);
        struct neighbour {
            std::int32_t id;
            vec3 force;
        };
        std::vector<neighbour> around; // few, but a clump among fragments may have many
        around.reserve(32);
        each_row_of(g, [&](std::int32_t, std::int32_t id, const vec3& f, const vec3& point) {
            std::size_t k = 0;
            while (k < around.size() && around[k].id != id) ++k;
            if (k == around.size()) around.push_back({id, {}});
            around[k].force += f;
            // force into the grain at the arm x - X: f (x) arm is negative in compression
            if (wants_stress) load.stress += (-1.0 / s.volume) * outer(f, point - grains.motion[g].x);
        });
        for (const neighbour& n : around) load.largest_force = std::max(load.largest_force, norm(n.force));
        return load;
    }

    /// Gives the pebbles of critical clumps new owners. At the end of a step, so that the next evaluation of forces
    /// already sees balls and bonds: no ball is integrated without its bonds.
    void replace_marked() {
        if constexpr (breakable) {
            for (birth_certificate& m : marked_) {
                const auto g = at(m.grain);
                grain& one = grains.grains[g];
                grains.place(g, unlisted_.of(g));
                const vec3 spin = spin_of(grains.turning[g].q, grains.turning[g].l, grains.inverse_inertia(one));
                bonds::cluster_pool& pool = broken_.pools[at(one.shape)];
                for (std::size_t k = 0; k < pool.shape().size(); ++k) {
                    const std::size_t p = at(one.first) + k;
                    const std::size_t b = ball(static_cast<std::int32_t>(p));
                    const vec3 x = grains.pebbles[p].x;
                    const vec3 v = grains.motion[g].v + cross(spin, x - grains.motion[g].x);
                    grains.motion[b] = {x - broken_.lag * v, v, spin}; // the motion of a ball trails t_n by the lag
                    grains.owner[p] = static_cast<std::int32_t>(b);
                    broken_.bonded[p] = 1;
                    broken_.balls.push_back(static_cast<std::int32_t>(p));
                }
                double strength = 1.0;
                if constexpr (requires { settings.breakage.strength_factor(std::int64_t{}); })
                    strength = settings.breakage.strength_factor(m.grain);
                one.cluster = static_cast<std::int32_t>(pool.add(m.born, strength));
                broken_.members[at(one.shape)].push_back(m.grain);
                totals_.bond_dissipation -= pool.energy(at(one.cluster)); // born with energy that no one paid for
                ++totals_.replaced;
                must_search_ = estimate_due_ = true;
            }
            if (!marked_.empty()) std::sort(broken_.balls.begin(), broken_.balls.end());
            marked_.clear();
        }
    }

    // ---- boundary -------------------------------------------------------------------------------------------------

    /// Loads of this step, the mean of sub-steps included, and the velocities that the boundary takes on from them.
    void control() {
        if (has_light_bodies())
            loads_ = work_loads_;
        else
            loads_.assign(loads_.size(), {}), couplings_.clear();
        add_loads(slow_wall_, 1.0, loads_, &couplings_);
        // work of the mean velocity around t_n, in step with the kinetic energy of a leapfrog
        const double power = periodic ? 0.0 : boundary.power(loads_);
        boundary.control(loads_, drives, dt_, couplings_);
        if constexpr (!periodic) totals_.boundary_work += 0.5 * (power + boundary.power(loads_)) * dt_;
    }
    /// Work of a periodic cell: contacts across its faces move with their images.
    void add_work_of_images() {
        if constexpr (periodic) {
            const double power = settings.run.sum(across_.size(), 0.0, [&](std::size_t k) {
                const std::uint32_t a = across_order_[k];
                return dot(across_force_[a], shift_speed_[slow_.image[across_[a]]]);
            });
            totals_.boundary_work += power * dt_;
        }
    }
    /// Stress of the contacts just evaluated, and the stiffness of the packing for uniform strain along each axis.
    void observe_stress() {
        if constexpr (periodic) {
            vec3 stress, modulus;
            each_slow([&](std::size_t k) {
                const force_row& row = slow_.rows[k];
                if (row.depth == 0.0) return;
                const pebble_pair& p = slow_.pairs[k];
                const double ri = grains.pebbles[at(p.i)].radius, rj = grains.pebbles[at(p.j)].radius;
                const vec3 branch = branch_of(row, p);
                const double kn = settings.grain_contact.normal_stiffness({0, 0, 1, row.depth, ri, rj});
                for (int a = 0; a < 3; ++a) {
                    stress[a] -= row.force[a] * branch[a];
                    modulus[a] += kn * branch[a] * branch[a] * row.normal[a] * row.normal[a];
                }
            });
            const double volume = boundary.volume();
            boundary.observe(stress / volume, modulus / volume, dt_);
        }
    }
    void finish_boundary() {
        boundary.advance(dt_);
        const double way = boundary.fastest() * dt_;
        since_.wall_travel += way;
        wide_.since.wall_travel += way;
        if constexpr (periodic) {
            stretch_ = stretch_since(since_);
            since_.wall_travel = strain_travel(stretch_ - vec3{1.0, 1.0, 1.0});
        }
    }

    // ---- lists ----------------------------------------------------------------------------------------------------
    //
    // A search names all pairs within a wide margin; the lists hold those of them that may touch while every body goes
    // a small margin of its own, and are renewed from what the search has found until the wide margin is used up. To
    // pick from sorted pairs costs a fifth of a search or less, so margins may be small, and hardly an open pair is
    // evaluated.

    /// Where displacements count from.
    struct origin {
        std::vector<typename body_type::reference> bodies; ///< per swept body
        std::vector<vec3> balls;                               ///< per pebble of a breakable specimen
        vec3 edges;                                            ///< of a periodic cell
        double wall_travel = 0.0; ///< how far walls have moved since, or how much strain brings two grains together (m)

        template <class A> void archive(A& a) { a(bodies, balls, edges, wall_travel); }
    };
    /// What the last search has found, in the order of the lists.
    struct wide_lists {
        pair_list slow, fast;
        std::vector<std::int32_t> wall; ///< pebbles that a facet may touch
        origin since;

        template <class A> void archive(A& a) { a(slow, fast, wall, since); }
    };

    /// Lists are renewed before a pair that they leave out can touch: when a body has used up its margin, or walls and
    /// strain theirs.
    void check_margins(margin_use use) {
        if constexpr (breakable) {
            const double worst = settings.run.max(broken_.balls.size(), -1.0, [&](std::size_t k) {
                const std::size_t p = at(broken_.balls[k]), b = ball(broken_.balls[k]);
                const double way = norm(grains.pebbles[p].x - since_.balls[p]) + 2.0 * dt_ * norm(grains.motion[b].v);
                return std::isfinite(way) ? way - margins_[b] : std::numeric_limits<double>::infinity();
            });
            use = std::max(use, worst < 0.0            ? margin_use::within
                                : std::isfinite(worst) ? margin_use::used_up
                                                       : margin_use::not_finite);
        }
        if (use == margin_use::not_finite) explain_nan();
        if (use == margin_use::used_up || since_.wall_travel >= wall_margin_) {
            must_renew_ = true;
            widths_.skin_is_used_up();
        }
    }
    vec3 stretch_since([[maybe_unused]] const origin& since) const {
        vec3 s{1.0, 1.0, 1.0};
        if constexpr (periodic)
            for (int a = 0; a < 3; ++a) s[a] = boundary.edges()[a] / since.edges[a];
        return s;
    }
    /// How much a strain, or a rate of strain, of a periodic cell brings two grains together that a search names (m,
    /// m/s). Those farther apart come nearer by more, but not by all that they are farther apart.
    double strain_travel(const vec3& strain) const {
        return std::max({std::abs(strain.x), std::abs(strain.y), std::abs(strain.z)}) * (widest_ + widths_.margin());
    }
    /// How far (m) every body may go before lists are renewed: half the skin, and more the faster it is. So a few fast
    /// bodies neither make renewals due for all nor the lists of all long.
    void choose_margins() {
        vec3 flow;
        if constexpr (periodic)
            for (int a = 0; a < 3; ++a) flow[a] = boundary.edge_speeds()[a] / boundary.edges()[a];
        margins_.resize(grains.body_count());
        if constexpr (breakable) margins_.resize(grains.motion.size());
        settings.run.for_each(grains.body_count(), [&](std::size_t b) {
            margins_[b] = grains.is_swept(b) ? grains.surface_speed(b, flow) : 0.0;
        });
        const double sum = settings.run.sum(grains.body_count(), 0.0, [&](std::size_t b) { return margins_[b]; });
        if (!std::isfinite(sum)) explain_nan();
        const double usual = std::max(sum / static_cast<double>(std::max<std::size_t>(1, grains.body_count())),
                                      std::numeric_limits<double>::min());
        const double most = 0.125 * widths_.margin(); // or the search would not do, and the next be due at once
        const auto margin = [&](double speed) { return std::min(0.5 * skin() * (1.0 + 2.0 * speed / usual), most); };
        settings.run.for_each(grains.body_count(), [&](std::size_t b) { margins_[b] = margin(margins_[b]); });
        if constexpr (breakable)
            for (std::int32_t p : broken_.balls) margins_[ball(p)] = margin(norm(grains.motion[ball(p)].v));
        double speed = boundary.fastest();
        if constexpr (periodic) speed = strain_travel(flow);
        wall_margin_ = margin(speed);
    }
    /// Whether the last search has found all pairs that the lists need now.
    bool wide_lists_hold() {
        const vec3 stretch = stretch_since(wide_.since);
        double largest = settings.run.max(grains.body_count(), 0.0, [&](std::size_t b) {
            return grains.is_swept(b) ? grains.moved(b, wide_.since.bodies[b], stretch) + margins_[b] : 0.0;
        });
        if constexpr (breakable)
            largest = settings.run.max(broken_.balls.size(), largest, [&](std::size_t k) {
                const std::size_t p = at(broken_.balls[k]);
                return norm(grains.pebbles[p].x - wide_.since.balls[p]) + margins_[ball(broken_.balls[k])];
            });
        if constexpr (periodic) wide_.since.wall_travel = strain_travel(stretch - vec3{1.0, 1.0, 1.0});
        const double travel = wide_.since.wall_travel;
        const double nearer = periodic ? 2.0 * largest + travel : std::max(2.0 * largest, largest + travel);
        return nearer + wall_margin_ < widths_.margin();
    }
    void set_origin(origin& now) const {
        now.bodies.resize(grains.body_count());
        settings.run.for_each(grains.body_count(), [&](std::size_t b) { now.bodies[b] = grains.refer(b); });
        if constexpr (breakable) {
            now.balls.resize(grains.pebble_count());
            for (std::int32_t p : broken_.balls) now.balls[at(p)] = grains.pebbles[at(p)].x;
        }
        if constexpr (periodic) now.edges = boundary.edges();
        now.wall_travel = 0.0;
    }

    void renew_lists() {
        place_all();
        widths_.choose_skin(counts(), totals_.steps);
        choose_margins();
        if (!must_search_ && !wide_lists_hold()) {
            must_search_ = true;
            widths_.margin_is_used_up();
        }
        if (must_search_) search();
        pick();
    }
    double mean_bounding_radius() const {
        double sum = 0.0;
        for (std::size_t b = 0; b < grains.body_count(); ++b) sum += grains.bounding_radius(b);
        return sum / static_cast<double>(std::max<std::size_t>(1, grains.body_count()));
    }
    list_widths::counts counts() const { return {grains.body_count(), grains.pebble_count()}; }

    [[noreturn]] void explain_nan() const {
        const auto blame = [&](std::string what, std::size_t number) {
            throw run_error({fmt::format("the motion of {} {} is not a finite number", what, number),
                             fmt::format("{} {}", what, number),
                             fmt::format("step {}, t = {:.6g} s", totals_.steps, totals_.time),
                             "forces grew without bound: the time step is too large for a contact or a bond, or two "
                             "centres passed each other",
                             "lower `safety` of the time step, the loading rate or the stress"});
        };
        for (std::size_t b = 0; b < grains.body_count(); ++b)
            if (!is_finite(grains.centre(b))) blame("grain", b);
        if constexpr (breakable)
            for (std::int32_t p : broken_.balls)
                if (!is_finite(grains.motion[ball(p)].x)) blame("ball", at(p));
        throw run_error({"a displacement is not a finite number", "unknown body",
                         fmt::format("step {}, t = {:.6g} s", totals_.steps, totals_.time), "unstable time step",
                         "lower `safety` of the time step"});
    }

    /// Finds all pairs within the wide margin: first bodies by their bounding spheres, then pebbles; and the pebbles
    /// near walls.
    void search() {
        double room = std::numeric_limits<double>::infinity();
        vec3 edges;
        if constexpr (periodic) {
            widest_ = 0.0;
            for (std::size_t b = 0; b < grains.body_count(); ++b)
                widest_ = std::max(widest_, 2.0 * grains.bounding_radius(b));
            edges = boundary.edges();
            room = 0.49 * std::min({edges.x, edges.y, edges.z}) - widest_;
        }
        widths_.choose_margin(counts(), room);
        const std::size_t ng = grains.body_count();
        search_spheres spheres;
        spheres.all.reserve(2 * ng); // with those at the faces of a periodic cell
        for (std::size_t g = 0; g < ng; ++g)
            if (grains.is_swept(g))
                spheres.all.push_back({grains.centre(g), grains.bounding_radius(g), static_cast<std::int32_t>(g)});
        if constexpr (breakable)
            for (std::int32_t p : broken_.balls)
                spheres.all.push_back(
                    {grains.pebbles[at(p)].x, grains.pebbles[at(p)].radius, static_cast<std::int32_t>(ball(p))});
        if constexpr (periodic) {
            bring_back(spheres);
            const double reach = widest_ + widths_.margin();
            if (!(std::min({edges.x, edges.y, edges.z}) > 2.0 * reach))
                throw run_error({"the periodic cell is too small for its grains",
                                 fmt::format("edges {:.4g} x {:.4g} x {:.4g} m", edges.x, edges.y, edges.z),
                                 fmt::format("step {}", totals_.steps), "a grain would touch two images of another",
                                 "take a cell of at least four grain diameters"});
            spheres.add_images(edges, reach);
        }
        auto found = pebble_pairs<body_type, periodic>(grains, widths_.margin(), edges, settings.run)
                         .of(spheres, typename P::search{}.pairs(spheres.all, widths_.margin()));
        wide_.slow = std::move(found.slow);
        wide_.fast = std::move(found.fast);
        if constexpr (breakable) { // what a bond carries sleeps as a contact
            asleep_.clear();
            std::erase_if(wide_.fast.pairs, [&](const pebble_pair& p) {
                if (!is_bonded(p)) return false;
                asleep_.push_back(p);
                return true;
            });
        }
        wide_.wall.clear();
        for (std::size_t g = 0; g < ng; ++g) {
            if (grains.is_swept(g) && !boundary.near(grains.centre(g), grains.bounding_radius(g) + widths_.margin()))
                continue;
            const index_range own = grains.pebbles_of(g);
            for (std::size_t p = own.begin; p < own.end; ++p)
                if (boundary.near(grains.pebbles[p].x, grains.pebbles[p].radius + widths_.margin()))
                    wide_.wall.push_back(static_cast<std::int32_t>(p));
        }
        cut_ranges();
        set_origin(wide_.since);
        choose_margins(); // within the new wide margin
        must_search_ = false;
        ++totals_.rebuilds;
    }

    /// The lists of contacts: what margins ask for of that which the last search has found. Histories carry over.
    void pick() {
        std::size_t open = 0;
        contact_list<history> slow = picked(wide_.slow, open), fast = picked(wide_.fast, open);
        const bool anew = widths_.is_fresh(); // else pairs stand in the same part of the same list as before
        widths_.picked(totals_.steps, open, wide_.slow.size() + wide_.fast.size() - slow.size() - fast.size());
        const auto take = [&](contact_list<history>& list, index_range own, const contact_list<history>& old,
                              index_range there) {
            constexpr std::size_t chunk = 512;
            settings.run.for_each(
                (own.end - own.begin + chunk - 1) / chunk,
                [&](std::size_t c) {
                    const std::size_t begin = own.begin + c * chunk;
                    list.take_histories({begin, std::min(begin + chunk, own.end)}, old, there, pair_order());
                },
                1);
        };
        take(slow, slow.in_front(), slow_, slow_.in_front());
        take(slow, slow.behind(), slow_, slow_.behind());
        take(fast, fast.behind(), fast_, fast_.behind());
        if (anew) {
            take(slow, slow.in_front(), slow_, slow_.behind());
            take(slow, slow.behind(), slow_, slow_.in_front());
            take(fast, fast.behind(), slow_, slow_.in_front());
            take(fast, fast.behind(), slow_, slow_.behind());
        }
        slow_ = std::move(slow);
        fast_ = std::move(fast);
        fast_.rows.assign(fast_.size(), {});

        pick_walls();
        sort_pebbles();
        find_halo();
        slow_of_.reset();
        index_ranges();
        set_origin(since_);
        stretch_ = {1.0, 1.0, 1.0};
        work_loads_.assign(loads_.size(), {});
        must_renew_ = false;
        ++totals_.renewals;
    }
    double margin_of(std::int32_t pebble) const { return margins_[grains.body_of(pebble)]; }
    /// The pairs of one list whose gap is not larger than the margins of both bodies, with empty histories. Counts
    /// those that do not touch.
    contact_list<history> picked(const pair_list& wide, std::size_t& open) const {
        const auto is_open = std::make_unique_for_overwrite<std::uint8_t[]>(wide.size());
        const std::vector<std::uint32_t> kept = settings.run.where(wide.size(), [&](std::size_t k) {
            const pebble_pair& p = wide.pairs[k];
            const double touch = grains.pebbles[at(p.i)].radius + grains.pebbles[at(p.j)].radius;
            const double reach = touch + margin_of(p.i) + margin_of(p.j) + (periodic ? wall_margin_ : 0.0),
                         distance2 = norm2(apart(wide, k));
            is_open[k] = distance2 < touch * touch ? 0 : 1;
            return distance2 < reach * reach;
        });
        open +=
            settings.run.sum(kept.size(), std::size_t{0}, [&](std::size_t k) { return std::size_t{is_open[kept[k]]}; });
        contact_list<history> list;
        list.shared = static_cast<std::size_t>(std::lower_bound(kept.begin(), kept.end(), wide.shared) - kept.begin());
        list.pairs.resize(kept.size());
        if constexpr (periodic) list.image.resize(kept.size());
        settings.run.for_each(
            kept.size(),
            [&](std::size_t k) {
                list.pairs[k] = wide.pairs[kept[k]];
                if constexpr (periodic) list.image[k] = wide.image[kept[k]];
            },
            1024);
        list.resize();
        return list;
    }
    void pick_walls() {
        slow_wall_.clear(), fast_wall_.clear();
        for (std::int32_t p : wide_.wall) {
            const double reach = grains.pebbles[at(p)].radius + margin_of(p) + wall_margin_;
            if (!boundary.near(grains.pebbles[at(p)].x, reach)) continue;
            const std::size_t body = grains.body_of(p);
            wall_row w;
            w.pebble = p;
            (body < grains.body_count() ? slow_wall_ : fast_wall_).push_back(w);
        }
    }

    /// Puts every body that has left the periodic cell back into it.
    void bring_back(search_spheres& spheres) {
        if constexpr (periodic) {
            const vec3 edges = boundary.edges();
            for (searches::sphere& s : spheres.all) {
                vec3 steps;
                for (int a = 0; a < 3; ++a) steps[a] = -std::floor(s.centre[a] / edges[a] + 0.5);
                if (steps == vec3{}) continue;
                // to be moved by a moving face changes a grain's energy
                const double before = grains.kinetic_energy(at(s.id));
                grains.shift(at(s.id), scale(steps, edges), scale(steps, boundary.edge_speeds()));
                totals_.boundary_work += grains.kinetic_energy(at(s.id)) - before;
                grains.place(at(s.id));
                s.centre = grains.centre(at(s.id));
            }
        }
    }

    bool is_bonded(const pebble_pair& p) const {
        if constexpr (breakable) {
            if (grains.mother[at(p.i)] != grains.mother[at(p.j)]) return false;
            const grain& g = grains.grains[at(grains.mother[at(p.i)])];
            if (g.cluster < 0) return false;
            const bonds::cluster_pool& pool = broken_.pools[at(g.shape)];
            for (std::size_t e = 0; e < pool.bonds(); ++e)
                if (g.first + pool.shape().ends[e].a == p.i && g.first + pool.shape().ends[e].b == p.j)
                    return pool.is_intact(at(g.cluster), e);
        }
        return false;
    }

    void index_fast() {
        fast_of_ = incidence(
            grains.motion.size(), fast_, [&](auto&& f) { fast_.each_in_order(pair_order(), f); }, fast_wall_,
            body_of());
    }
    /// Which rows act on a swept body: made when it is asked for the first time after a renewal.
    void index_slow() {
        if (!slow_of_)
            slow_of_ = incidence(
                grains.body_count(), slow_, [&](auto&& f) { each_slow(f); }, slow_wall_, body_of());
    }
    /// Which pebbles of clumps the lists name, and which not.
    void sort_pebbles() {
        if constexpr (!body_type::turns) return; // bodies are their pebbles
        std::vector<std::uint8_t> named(grains.pebble_count(), 0);
        const auto name = [&](const contact_list<history>& list, const std::vector<wall_row>& wall) {
            for (const pebble_pair& p : list.pairs) named[at(p.i)] = named[at(p.j)] = 1;
            for (const wall_row& w : wall) named[at(w.pebble)] = 1;
        };
        name(slow_, slow_wall_);
        name(fast_, fast_wall_);
        const auto count = static_cast<std::size_t>(std::count(named.begin(), named.end(), 1));
        listed_.resize(grains.body_count(), count);
        unlisted_.resize(grains.body_count(), named.size() - count);
        std::size_t in = 0, out = 0;
        for (std::size_t b = 0; b < grains.body_count(); ++b) {
            const index_range own = grains.pebbles_of(b);
            for (std::size_t p = own.begin; p < own.end; ++p) { // no branch that depends on the packing
                listed_.items[in] = unlisted_.items[out] = static_cast<std::int32_t>(p);
                in += named[p], out += 1U - named[p];
            }
            listed_.start[b + 1] = static_cast<std::uint32_t>(in);
            unlisted_.start[b + 1] = static_cast<std::uint32_t>(out);
        }
    }
    void find_halo() {
        if constexpr (breakable) {
            index_fast();
            for (std::size_t g = 0; g < grains.grain_count(); ++g)
                broken_.halo[g] = grains.is_clump(g) && !fast_of_.of(g).empty() ? 1 : 0;
        }
    }

    /// Cuts the bodies into one range for each thread, by the pairs that the search has found, and brings the pairs
    /// between two ranges to the front, of its list and so of those that are picked from it.
    void cut_ranges() {
        const std::size_t pairs = wide_.slow.size();
        // of the pairs that a search finds about half are listed
        const std::size_t enough = 2 * std::max<std::size_t>(1, settings.contacts_per_thread);
        ranges_.cut(grains.body_count(), wide_.slow.pairs,
                    std::clamp<std::size_t>(pairs / enough, 1, static_cast<std::size_t>(settings.run.threads())),
                    body_of());
        sweeping_.resize(ranges_.size());
        acting_.assign(grains.body_count(), {});
        if (ranges_.size() > 1) bring_shared_forward(wide_.slow, between_ranges());
    }
    auto body_of() const {
        return [this](std::int32_t pebble) { return grains.body_of(pebble); };
    }
    auto between_ranges() const {
        return [this](const pebble_pair& p) { return ranges_.are_apart(grains.body_of(p.i), grains.body_of(p.j)); };
    }
    void index_ranges() {
        ranges_.index(slow_, slow_wall_, settings.run, body_of());
        shared_load_.resize(slow_.shared);
        if constexpr (periodic) {
            across_ = settings.run.where(slow_.size(), [&](std::size_t k) { return slow_.image[k] != no_shift; });
            across_force_.assign(across_.size(), {});
            across_order_.resize(across_.size());
            std::iota(across_order_.begin(), across_order_.end(), 0U);
            const auto behind = std::lower_bound(across_.begin(), across_.end(), slow_.shared) - across_.begin();
            std::inplace_merge(across_order_.begin(), across_order_.begin() + behind, across_order_.end(),
                               [&](std::uint32_t a, std::uint32_t b) {
                                   return pair_order()(slow_.pairs[across_[a]], slow_.pairs[across_[b]]);
                               });
        }
    }

    // ---- time step ------------------------------------------------------------------------------------------------

    /// dt = safety * sqrt(m/k) over clumps and their present contacts, at most as large as three contacts would allow.
    /// Light bodies do not shrink it: they set the number of sub-steps.
    void estimate_step(bool first) {
        // from the present positions, not from what an earlier step left behind: a restart must see the same
        for (std::vector<wall_row>* wall : {&slow_wall_, &fast_wall_})
            settings.run.for_each(wall->size(), [&](std::size_t k) {
                wall_row& w = (*wall)[k];
                w.touch = boundary.touch(grains.pebbles[at(w.pebble)].x, grains.pebbles[at(w.pebble)].radius);
            });
        double limit = typical_limit(smallest_mass_);
        index_slow();
        const auto faster = [&](std::size_t g, double so_far) {
            if (!grains.is_swept(g) || surely_allows(g, -so_far)) return so_far;
            stiffness_sum k(grains.body_axes(g));
            add_stiffness(k, *slow_of_, g, slow_, slow_wall_, grains.centre(g));
            if constexpr (breakable) add_stiffness(k, fast_of_, g, fast_, fast_wall_, grains.centre(g));
            return -k.time_step(grains.body_mass(g), grains.body_inertia(g), settings.safety, -so_far);
        };
        limit = -settings.run.max(grains.body_count(), -std::min(limit, settings.largest_step), faster);
        // grow slowly: contacts that are about to form are not in the sum yet
        dt_ = first ? limit : std::min(limit, 1.02 * dt_);
        if constexpr (breakable) estimate_substeps();
        if constexpr (!has_criterion) slow_of_.reset(); // a tenth of the memory, and no one else asks for it
        estimate_due_ = false;
    }

    /// Step (s) that three typical contacts would allow a body of this mass (kg): an upper bound, because contacts come
    /// and go between two estimates.
    double typical_limit(double mass) const {
        const contacts::overlap<double> typical{0, 0, 1, 0, 1, 1};
        const double k =
            (settings.grain_contact.normal_stiffness(typical) + 2.0 * settings.grain_contact.shear_stiffness(typical)) /
            3.0;
        return settings.safety * std::sqrt(mass / (3.0 * k));
    }

    /// Whether the number of listed contacts is enough to see that a body allows a step (s): each adds at most its
    /// stiffness, at the farthest point of the body.
    bool surely_allows(std::size_t g, double step) const {
        if constexpr (requires { requires contact::constant_stiffness; }) {
            const auto around = slow_of_->of(g);
            if (!around.empty() && around.back().row() >= slow_.size()) return false; // walls have laws of their own
            if constexpr (breakable)
                if (!fast_of_.of(g).empty()) return false;
            const contacts::overlap<double> any{0, 0, 1, 0, 1, 1};
            const double shear = settings.grain_contact.shear_stiffness(any),
                         normal = std::max(settings.grain_contact.normal_stiffness(any), shear);
            const double turning = body_type::turns ? normal : shear; // of a sphere forces along n have no arm
            const double reach = grains.bounding_radius(g);
            const vec3 inertia = grains.body_inertia(g);
            const double largest = std::max(normal / grains.body_mass(g),
                                            turning * reach * reach / std::min({inertia.x, inertia.y, inertia.z}));
            return step * step * static_cast<double>(around.size()) * largest <= settings.safety * settings.safety;
        }
        return false;
    }

    void add_stiffness(stiffness_sum& k, const incidence& of, std::size_t body, const contact_list<history>& list,
                       const std::vector<wall_row>& wall, const vec3& centre) const {
        for (const incidence::entry& one : of.of(body)) {
            const std::size_t r = one.row();
            if (r < list.size()) {
                const auto& pr = list.pairs[r];
                const vec3 d = apart(list, r);
                const double ri = grains.pebbles[at(pr.i)].radius, rj = grains.pebbles[at(pr.j)].radius,
                             distance = norm(d);
                if (distance >= ri + rj) continue;
                const contacts::overlap<double> o{0, 0, 1, ri + rj - distance, ri, rj};
                const vec3 n = d / distance;
                const auto& p = grains.pebbles[at(one.pebble)];
                k.add(n, settings.grain_contact.normal_stiffness(o), settings.grain_contact.shear_stiffness(o),
                      p.x - centre + (one.side() * (p.radius - 0.5 * o.depth)) * n);
            } else {
                const wall_row& w = wall[r - list.size()];
                const double rp = grains.pebbles[at(w.pebble)].radius;
                for (const boundaries::touch& t : w.touch) {
                    const contacts::overlap<double> o{0, 0, 1, t.depth, rp, rp};
                    const contact& law =
                        t.facet < boundaries::first_lateral_facet ? settings.platen_contact : settings.lateral_contact;
                    k.add(t.normal, law.normal_stiffness(o), 0.0,
                          grains.pebbles[at(w.pebble)].x - rp * t.normal - centre);
                }
            }
        }
    }

    /// Sub-steps of light bodies: the smallest limit over fragments, each with its own mass and external contacts.
    void estimate_substeps() {
        if constexpr (breakable) {
            double limit = dt_;
            std::size_t k = 0;
            while (k < broken_.balls.size()) {
                // the balls of one cluster are consecutive; pieces of it are looked at one by one
                const std::int32_t g = grains.mother[at(broken_.balls[k])];
                std::size_t end = k;
                while (end < broken_.balls.size() && grains.mother[at(broken_.balls[end])] == g) ++end;
                for (std::size_t a = k; a < end; ++a) {
                    const std::int32_t piece = broken_.fragment[at(broken_.balls[a])];
                    if (piece != broken_.balls[a]) continue;
                    limit = std::min(limit, fragment_limit(piece, k, end));
                }
                k = end;
            }
            // the span is (old dt + dt) / 2, and dt grows by 2 % at most
            fast_steps_ =
                std::max(1, static_cast<int>(std::ceil(std::max(dt_, 0.5 * dt_ + broken_.lag) / limit - 1e-9)));
        }
    }
    double fragment_limit(std::int32_t piece, std::size_t begin, std::size_t end) const {
        if constexpr (breakable) {
            double mass = 0.0;
            vec3 centre;
            for (std::size_t a = begin; a < end; ++a) {
                const auto p = at(broken_.balls[a]);
                if (broken_.fragment[p] != piece) continue;
                mass += grains.ball_mass(p);
                centre += grains.ball_mass(p) * grains.pebbles[p].x;
            }
            centre = centre / mass;
            stiffness_sum k(mat3::identity());
            mat3 tensor;
            for (std::size_t a = begin; a < end; ++a) {
                const auto p = at(broken_.balls[a]);
                if (broken_.fragment[p] != piece) continue;
                const vec3 arm = grains.pebbles[p].x - centre;
                const double m = grains.ball_mass(p);
                tensor += (grains.ball_inertia(p) + m * norm2(arm)) * mat3::identity() + (-m) * outer(arm, arm);
                add_stiffness(k, fast_of_, ball(broken_.balls[a]), fast_, fast_wall_, centre);
            }
            return std::min(typical_limit(mass),
                            k.time_step(mass, {tensor(0, 0), tensor(1, 1), tensor(2, 2)}, settings.safety));
        }
        return dt_;
    }

    // ---- state ----------------------------------------------------------------------------------------------------

    contact_list<history> slow_;      ///< clump against clump
    contact_list<history> fast_;      ///< at least one ball
    std::vector<pebble_pair> asleep_; ///< pairs of balls that an intact bond carries, in the order of the lists
    std::vector<wall_row> slow_wall_, fast_wall_;
    wide_lists wide_;                  ///< what the last search has found
    std::vector<double> margins_;      ///< per body: how far it may go before lists are renewed (m)
    double wall_margin_ = 0.0;         ///< the same for walls and for the strain of a cell (m)
    origin since_;                     ///< where bodies were at the last renewal of the lists
    std::optional<incidence> slow_of_; ///< made when it is needed
    incidence fast_of_;
    body_items listed_;   ///< pebbles of clumps that are in a list, so placed in every step
    body_items unlisted_; ///< the others
    std::vector<boundaries::facet_load> loads_, work_loads_;
    std::vector<boundaries::coupling> couplings_;
    body_ranges ranges_;
    std::vector<range_work> sweeping_;        ///< per range
    std::vector<contact_load<>> shared_load_; ///< of the contacts between two ranges
    std::vector<load_sum> acting_;            ///< per body; zero between steps
    bool look_ = false;                       ///< the criterion looks at this step
    std::vector<birth_certificate> marked_;   ///< empty between steps
    std::conditional_t<breakable, breakage_state, nothing> broken_;
    engine_totals totals_;
    double dt_ = 0.0;
    double smallest_mass_ = std::numeric_limits<double>::infinity();
    list_widths widths_;
    std::vector<std::uint32_t> across_;       ///< contacts across a face of a periodic cell, ascending
    std::vector<vec3> across_force_;          ///< and the forces on their first body (N)
    std::vector<std::uint32_t> across_order_; ///< their numbers, in the order of one thread
    vec3 stretch_{1.0, 1.0, 1.0}; ///< edges of a periodic cell over those at the last renewal: a homogeneous
                                  ///< deformation brings no pair together but by its strain
    double widest_ = 0.0;         ///< largest bounding diameter, of a periodic specimen (m)
    std::conditional_t<periodic, std::array<vec3, 27>, nothing> shift_{}, shift_speed_{}; ///< of the images
    int fast_steps_ = 1;
    bool must_search_ = false;
    bool must_renew_ = false;
    bool estimate_due_ = false;
};

} // namespace clast
