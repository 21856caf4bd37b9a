// SPDX-License-Identifier: MIT
// The order of one step. What each part of it does is in a room of its own beside this header; scene.hpp is what all of
// them share.
//
//   constraints set what they prescribe                                                      outside.hpp
//   light bodies (balls and bonded clusters) pass through the span around t_n in sub-steps    light_bodies.hpp
//   walls touch heavy bodies, servo                                                          walls.hpp
//   sweep: heavy contacts, sums, motion; criteria look at clumps before these move           sweep.hpp, grain_load.hpp
//   walls and space move; the replacement acts on clumps that it has marked                  replace.hpp, surgery.hpp
//   margins: whether lists still hold                                                        neighbourhood.hpp
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/boundaries/none.hpp>
#include <clast/core/errors.hpp>
#include <clast/engine/audit.hpp>
#include <clast/engine/check_policies.hpp>
#include <clast/engine/light_bodies.hpp>
#include <clast/engine/neighbourhood.hpp>
#include <clast/engine/outside.hpp>
#include <clast/engine/replace.hpp>
#include <clast/engine/scene.hpp>
#include <clast/engine/step_limit.hpp>
#include <clast/engine/sweep.hpp>
#include <clast/engine/walls.hpp>

namespace clast {

/// Bodies, a boundary and the policies that move them (simulator_policies). Construct complete; then call step().
template <class P> class engine : private scene<P> {
  public:
    using scene_type = scene<P>;
    using typename scene_type::body_type;
    using typename scene_type::boundary_type;
    using typename scene_type::contact;
    using typename scene_type::history;
    using typename scene_type::scheme_type;
    using typename scene_type::space_type;
    using typename scene_type::wall_row;
    using settings_type = engine_settings<P>;
    using scene_type::breakable;
    using scene_type::has_criterion;
    static_assert(rooms::fills_all_needs<typename P::breakage>,
                  "the breakage criterion `needs` something of a grain_load that an engine does not fill");

    // ---- what there is, and what may be changed between steps -------------------------------------------------------
    using scene_type::boundary; ///< to exchange it, set_boundary()
    using scene_type::breakage_on;
    using scene_type::constraint;
    using scene_type::drives;
    using scene_type::grains;
    using scene_type::settings;
    using scene_type::space;

    engine(settings_type s, body_type bodies, boundary_type around, space_type in = space_type())
        : scene_type(std::move(s), std::move(bodies), std::move(around), std::move(in)) {
        begin();
    }
    /// Without a wall.
    engine(settings_type s, body_type bodies, space_type in) requires std::same_as<boundary_type, boundaries::none>
        : engine(std::move(s), std::move(bodies), boundaries::none{}, std::move(in)) {}

    // ---- stepping ---------------------------------------------------------------------------------------------------

    /// Advances by `count` steps of dt(), which costs less than as many calls: rows (each_contact) are those of the
    /// last step only. Throws run_error if a number stops being finite.
    void step(std::int64_t count = 1) {
        const bool many = count > 1;
        for (; count > 1; --count) one_step(false, false);
        if (count == 1) one_step(true, many);
    }

    double dt() const { return scene_type::dt; }
    double time() const { return scene_type::totals.time; }
    const engine_totals& totals() const { return scene_type::totals; }
    double skin() const { return this->near.widths.skin(); }    ///< of the present lists (m)
    int light_steps() const { return scene_type::light_steps; } ///< of balls and clusters in a step
    /// Whether balls and clusters take sub-steps where there are any; else all bodies go by one step (stepping).
    bool takes_sub_steps() const { return breakable && clast::takes_sub_steps(settings); }

    /// Replaces the boundary by another in the same place (a membrane for the vessel), and the lists with it.
    void set_boundary(boundary_type b) {
        boundary = std::move(b);
        rooms::make_lists(own());
    }
    /// Goes on with the bodies where they are, at rest, within another boundary, as a scene that is made of them anew:
    /// nothing is remembered of contacts, lists and margins. Nothing may have been replaced. Books what bodies and
    /// contacts hold then as brought in, after totals were set to what is known so far. step: from which the time step
    /// goes on (s); one that is found at rest is too long for laws that begin without stiffness.
    void begin_at_rest(boundary_type b, const engine_totals& so_far, double step) {
        scene_type& s = own();
        boundary = std::move(b);
        for (std::size_t g = 0; g < grains.body_count(); ++g) {
            grains.shift(g, {}, -grains.velocity(g));
            if constexpr (requires { grains.set_spin(g, vec3{}); }) grains.set_spin(g, {});
            grains.place(g);
        }
        s.totals = so_far;
        s.near = {};
        s.near.widths = first_widths();
        s.heavy = {}, s.light = {};
        s.heavy_wall.clear(), s.light_wall.clear(), s.heavy_grip.clear(), s.light_grip.clear(), s.asleep.clear();
        s.memory = {};
        s.memory.resize(grains.body_count());
        rooms::make_lists(s);
        s.dt = step;
        estimate(false);
        s.totals.initial_energy += potential_energy() + elastic_energy();
    }
    /// Shortens the time step for walls that are about to take up a speed (m/s): for the overlap that they may press
    /// into contacts before the next estimate. A law that begins without stiffness has a long step at rest.
    void expect_speed(double v) {
        if constexpr (!contacts::is_of_constant_stiffness<contact>()) {
            scene_type& s = own();
            const double depth = std::min(v * dt() * static_cast<double>(step_interval), s.smallest_radius);
            const contacts::overlap<double> typical = s.typical_overlap(depth);
            const auto& law = settings.grain_contact;
            const double stiffness = (law.normal_stiffness(typical) + 2.0 * law.shear_stiffness(typical)) / 3.0;
            if (stiffness > 0.0)
                s.dt = std::min(s.dt, rooms::typical_limit(s, rooms::smallest_free_mass(s), stiffness));
        }
    }
    /// Friction between pebbles, of laws that have one (a member `mu`); 0 for others.
    double friction() const {
        if constexpr (requires { settings.grain_contact.mu; }) return settings.grain_contact.mu;
        return 0.0;
    }
    /// Sets it; histories stay and are cut at the new limit in the next step. Throws input_error if it is negative or
    /// not finite.
    void set_friction(double mu) {
        if (!(mu >= 0.0 && std::isfinite(mu)))
            throw input_error("set_friction", fmt::format("{:g}", mu), ">= 0, finite", "The paper uses 0.3.");
        if constexpr (requires { settings.grain_contact.mu; }) settings.grain_contact.mu = mu;
    }
    /// To be called after velocities or the field were set by hand, so that the audit knows of their energy. Before the
    /// first step this holds what contacts and walls store as well, of a scene that begins loaded.
    void count_initial_energy() {
        auto& t = scene_type::totals;
        t.initial_energy = kinetic_energy() + potential_energy() + (t.steps == 0 ? elastic_energy() : 0.0);
    }
    /// The same while a scene runs. before: kinetic and potential energy before velocities were set (J).
    void count_energy_since(double before) {
        scene_type::totals.initial_energy += kinetic_energy() + potential_energy() - before;
    }
    /// Broken bonds since the last call, in the order in which they broke.
    std::vector<fracture_event> take_events() { return this->broken.take_events(); }
    /// Places the pebbles that no contact needed, too (for output; changes nothing that a step reads).
    void place_all() { rooms::place_all(own()); }

    // ---- what measurements read -------------------------------------------------------------------------------------

    const scene_type& state() const { return *this; }
    std::span<const boundaries::facet_load> loads() const { return scene_type::loads; }
    const contact_list<history>& heavy_contacts() const { return this->heavy; }
    const contact_list<history>& light_contacts() const { return this->light; }
    /// Pairs of balls that an intact bond carries: no contacts until it breaks.
    std::span<const pebble_pair> bonded_pairs() const requires breakable { return this->asleep; }
    /// Balls, clusters and bonds; empty where nothing breaks.
    const auto& breakage() const { return this->broken; }
    using scene_type::branch_of;
    using scene_type::centre_of;
    using scene_type::each_contact;
    using scene_type::each_outer_force;
    using scene_type::each_wall_row;
    using scene_type::has_outer_forces;
    double kinetic_energy() const { return rooms::kinetic_energy(state()); }
    double potential_energy() const { return rooms::potential_energy(state()); } ///< in the field (J)
    double elastic_energy() const { return rooms::elastic_energy(state()); }
    body_losses losses() const { return rooms::losses(state()); }

    /// Complete state, list order and reference positions included: a run that goes on from it has the same bits.
    /// Events must have been taken. The number of threads is not part of it: lists are saved as one thread would have
    /// them.
    template <class A> void archive(A& a) {
        place_all();
        rooms::join_lists(own());
        scene_type::archive(a);
        rooms::part_lists(own());
    }

  private:
    static constexpr std::int64_t step_interval = 50; ///< steps between estimates of the time step

    scene_type& own() { return *this; }

    void begin() {
        scene_type& s = own();
        check(settings, grains.density);
        if constexpr (scene_type::replaces) rooms::refuse_overlapping(grains);
        if constexpr (contacts::reads_materials<contact>()) {
            grains.materials.resize(grains.pebble_count(), 0);
            if constexpr (requires { contact::materials; }) check_materials(contact::materials);
        }
        s.broken.begin(grains, settings);
        s.memory.resize(grains.body_count());
        s.replacing.begin(grains.grain_count());
        s.smallest_mass = grains.smallest_mass();
        s.smallest_radius = smallest_radius();
        if constexpr (scene_type::replaces) rooms::check_replacement(s);
        s.near.widths = first_widths();
        rooms::sort_pebbles(s);
        count_initial_energy();
        rooms::make_lists(s);
        const double then = potential_energy();
        estimate(true);
        s.totals.initial_energy += potential_energy() - then; // it is that of half a step ago, and there is a step now
        s.totals.initial_energy += elastic_energy();
    }
    list_widths first_widths() const {
        return list_widths(settings.skin > 0.0 ? settings.skin : 0.002 * mean_bounding_radius());
    }
    void check_materials(std::size_t count) const {
        for (const std::size_t m : grains.materials)
            if (m >= count)
                throw input_error("material of a grain", fmt::format("{}", m), fmt::format("0 to {}", count - 1),
                                  "Number materials from 0, or give the contact law more of them.");
    }
    double smallest_radius() const {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& p : grains.pebbles) least = std::min(least, p.radius);
        return least;
    }
    double mean_bounding_radius() const {
        double sum = 0.0;
        for (std::size_t b = 0; b < grains.body_count(); ++b) sum += grains.bounding_radius(b);
        return sum / static_cast<double>(std::max<std::size_t>(1, grains.body_count()));
    }
    void estimate(bool first) {
        rooms::estimate_step(own(), first);
        if (dt() > 0.0) rooms::estimate_light_steps(own());
    }

    /// One evaluation of forces, and the motion that follows from it. since: span since the last one (s).
    margin_use one_stage(const integrators::stage& stage, double since, bool keep_rows, bool last_of_many) {
        scene_type& s = own();
        const double span = stage.drift * s.dt;
        rooms::advance_light_bodies(s);
        if constexpr (scene_type::has_walls) {
            rooms::evaluate_walls(s, s.heavy_wall, s.heavy_grip, since, 0.0);
            rooms::control_walls(s, span);
        }
        const bool space_looks = space.looks(s.totals.steps, keep_rows, last_of_many);
        const bool criterion_looks = rooms::looks_at_clumps(s);
        if (criterion_looks) s.index_heavy();
        const margin_use use = rooms::sweep(s, stage, since, keep_rows || space_looks || criterion_looks,
                                            rooms::marks_critical(s, criterion_looks));
        rooms::end_constraint(s);
        space.end_sweep(s, space_looks);
        rooms::advance_walls(s, span);
        rooms::bring_balls_to_step(s);
        return use;
    }

    /// keep_rows: for those who look after the step; last_of_many: what is looked at now and then only was left out.
    void one_step(bool keep_rows, bool last_of_many) {
        scene_type& s = own();
        if (s.near.must_search || s.near.must_renew) rooms::renew_lists(s);
        rooms::begin_constraint(s);
        if (s.estimate_due || s.totals.steps % step_interval == 0) estimate(false);
        margin_use use = margin_use::within;
        double since = scheme_type::stages.back().drift * s.dt;
        for (std::size_t k = 0; k < scheme_type::stages.size(); ++k) {
            const bool last = k + 1 == scheme_type::stages.size();
            use = std::max(use, one_stage(scheme_type::stages[k], since, last && keep_rows, last && last_of_many));
            since = scheme_type::stages[k].drift * s.dt;
        }
        rooms::replace_marked(s);
        s.totals.time += s.dt;
        ++s.totals.steps;
        rooms::check_margins(s, use);
    }
};

/// For a bundle that does not fit (simulator_policies): an error that says what is missing, and nothing after it.
template <class P>
requires(!simulator_policies<P>) class engine<P> : public engine<repaired_policies<P>> {
    static_assert(sizeof(check_policies<P>) > 0);

  public:
    template <class Body, class... Others> engine(engine_settings<P>, Body, Others...);
};

} // namespace clast
