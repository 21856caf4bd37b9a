// SPDX-License-Identifier: MIT
// Runs a protocol: drives the engine through its stages, measures, and says why where it cannot go on.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/boundaries/axial.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/engine.hpp>
#include <clast/measure/breakage.hpp>
#include <clast/measure/pebbles.hpp>
#include <clast/measure/sample.hpp>
#include <clast/measure/stress.hpp>
#include <clast/measure/totals.hpp>
#include <clast/protocol/check_specimen.hpp>
#include <clast/protocol/follow.hpp>
#include <clast/protocol/observer.hpp>
#include <clast/protocol/path_stress.hpp>
#include <clast/protocol/preparation.hpp>
#include <clast/protocol/prepared.hpp>
#include <clast/protocol/stage.hpp>
#include <clast/protocol/stage_record.hpp>
#include <clast/protocol/standstill.hpp>
#include <clast/protocol/test_plan.hpp>
#include <clast/protocol/vessel.hpp>
#include <clast/protocol/wall_speed.hpp>

namespace clast {

/// Runs the stages of a plan on an engine. State is complete and archived: saving, or not, changes no bit.
template <class P> class runner {
  public:
    using engine_type = engine<P>;
    using boundary_type = typename P::boundary;
    enum class outcome { finished, stopped };

    engine_type& sim;
    test_plan plan;

    /// `membrane`: of the boundary that takes the vessel's place in a stage with `membrane_here`, at the size that the
    /// vessel has then.
    runner(engine_type& e, test_plan p, const boundaries::vessel_settings& membrane)
        : sim(e), plan(protocol::completed(std::move(p), protocol::has_three_axes<boundary_type>)), membrane_(membrane),
          speed_(plan, e.grains.density) {
        friction_ = sim.friction();
        solid_volume_ = sim.grains.solid_volume();
        finer_ = measure::relative_breakage(measure::pieces_of(sim));
        reference_height_ = sim.boundary.height();
        reference_volume_ = sim.boundary.volume();
    }

    /// Runs until the last stage ends (finished) or the observer asks to stop (stopped; run() again to go on).
    outcome run(observer& watch) {
        const auto began = std::chrono::steady_clock::now();
        const double before = wall_time_;
        const auto clock = [&] {
            wall_time_ = before + std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        };
        scene_watch_ = dynamic_cast<scene_observer<P>*>(&watch);
        const std::int64_t every = scene_watch_ != nullptr ? scene_watch_->every_steps() : 0;
        begin_due(watch);
        while (stage_ < plan.stages.size()) {
            sim.step();
            ++stage_steps_;
            stage_time_ += sim.dt();
            confining_now();
            if (speed_.yields(current())) protocol::give_way(sim, speed_, current());
            follow();
            if (every > 0 && sim.totals().steps % every == 0) {
                sim.place_all();
                scene_watch_->on_step(sim.state());
            }
            if (row_due()) {
                clock();
                report(watch);
            }
            const bool looks = stage_steps_ % plan.look_every == 0, met = !looks && met_between_looks();
            if (!looks && !met) continue;
            clock();
            look();
            protocol::check_specimen(sim, contacts_, current().name, [this] { return when(); });
            const bool ended = met || current().end.met(view_);
            const double part = current().end.progress(view_);
            watch.on_progress(measure(), part,
                              (static_cast<double>(stage_) + part) / static_cast<double>(plan.stages.size()));
            if (ended)
                end_stage(watch, true, current().end.reason(view_));
            else
                try_next_friction(watch);
            flush_events(watch);
            begin_due(watch); // before the pause: what a stage begins with is measured from forces that no file keeps
            watch.on_pause();
            if (watch.stop_requested() && stage_ < plan.stages.size()) return outcome::stopped;
        }
        return outcome::finished;
    }

    const std::string& stage_name() const { return plan.stages[std::min(stage_, plan.stages.size() - 1)].name; }
    /// Number of the running stage in the plan; that of stages where all have ended.
    std::size_t stage_number() const { return stage_; }
    bool finished() const { return stage_ >= plan.stages.size(); }
    double axial_strain() const { return 1.0 - sim.boundary.height() / reference_height_; }
    double wall_time() const { return wall_time_; }
    /// Of the stages that have ended, in their order.
    const std::vector<stage_record>& records() const { return records_; }

    /// What the preparation hands over: as it was where a stage with `hands_over` began, or is now if none has.
    prepared_specimen prepared() const { return handed_ ? *handed_ : handed_now(); }
    /// Begins with a specimen that was prepared by another run, in the stage with `hands_over`: goes on as if this run
    /// had prepared it. Throws input_error where the protocol has no such stage, or other grains.
    void take_over(const prepared_specimen& p) {
        const std::size_t first = protocol::taking_over(plan.stages);
        protocol::put_in_place(sim, p, membrane_);
        reference_height_ = p.reference_height, reference_volume_ = p.reference_volume;
        records_ = p.records;
        stage_ = first, handed_ = p;
    }

    /// The state of the specimen now.
    sample measure() const {
        sample s;
        const auto& b = sim.boundary;
        s.stage = stage_name();
        s.height = b.height();
        s.volume = b.volume();
        s.axial_strain = axial_strain();
        s.volumetric_strain = 1.0 - s.volume / reference_volume_;
        const protocol::path_stress stress = stresses();
        s.sigma_1 = stress.sigma_1, s.sigma_2 = stress.sigma_2, s.sigma_3 = stress.sigma_3;
        s.q = stress.q, s.p = stress.p;
        if (running().lateral.how == axis_drive::kind::volume) s.pore_pressure = start_sigma_3_ - s.sigma_3;
        const mat3 lw = measure::love_weber(sim, s.volume);
        s.sigma_1_love_weber = lw(2, 2);
        s.sigma_3_love_weber = 0.5 * (lw(0, 0) + lw(1, 1));
        s.q_contacts = running().lateral_y ? protocol::deviator_of(lw(0, 0), lw(1, 1), lw(2, 2))
                                           : s.sigma_1_love_weber - s.sigma_3_love_weber;
        s.void_ratio = (s.volume - solid_volume_) / solid_volume_;
        s.porosity = 1.0 - solid_volume_ / s.volume;
        const double sum = s.sigma_1 + s.sigma_3;
        const double difference = running().lateral_y ? s.sigma_1 - s.sigma_3 : s.q;
        s.phi_mob_deg = sum > 0.0 ? std::asin(std::clamp(difference / sum, -1.0, 1.0)) * 180.0 / std::numbers::pi : 0.0;
        s.inertial_number =
            s.p > 0.0 ? std::abs(closing_speed()) / s.height * plan.grain_diameter / std::sqrt(s.p / sim.grains.density)
                      : 0.0;
        const measure::contact_state c = measure::contacts_of(sim);
        s.unbalanced_ratio = c.unbalanced_ratio;
        s.median_overlap_over_r = c.median_overlap_over_r;
        s.max_overlap_over_r = c.max_overlap_over_r;
        s.coordination = c.coordination;
        s.confining_error = error_count_ > 0 ? error_sum_ / static_cast<double>(error_count_) : 0.0;
        if constexpr (requires { b.confining_rms(sim.loads(), 1.0); })
            if (const double target = lateral_target(running()); target > 0.0 && !running().lateral_y)
                s.confining_rms = b.confining_rms(sim.loads(), target);
        const double curvature = 2.0 / plan.grain_diameter;
        const double kn = sim.settings.grain_contact.normal_stiffness({0, 0, 1, c.mean_overlap, curvature, curvature});
        s.kappa = s.p > 0.0 ? kn / (s.p * plan.grain_diameter) : 0.0;
        measure::add_totals(sim, s);
        if (s.replaced > 0) {
            const std::vector<measure::piece> pieces = measure::pieces_of(sim);
            s.hardin_br = finer_.hardin(pieces), s.einav_b = finer_.einav(pieces);
        }
        // of the energy that went through the specimen in this stage: work, or what was lost where no wall works
        const double lost_here = s.friction_dissipation + s.damping_dissipation - stage_losses_;
        const double work = std::max(std::abs(s.boundary_work - stage_work_), lost_here);
        s.energy_residual = work > 0.0 ? (unexplained(s) - stage_residual_) / work : 0.0;
        s.wall_time = wall_time_;
        return s;
    }

    /// Pebbles for pictures; displacement counts from the reference state (0 before it).
    std::vector<pebble_view> pebbles() { return measure::pebbles_of(sim, reference_); }
    std::vector<facet_view> facets() const { return sim.boundary.view(sim.loads()); }

    template <class A> void archive(A& a) {
        sim.archive(a);
        a(stage_, begun_, ended_by_itself_, stage_steps_, stage_time_, stage_work_, stage_losses_, stage_residual_,
          reference_height_, reference_volume_, start_height_, start_volume_, start_sigma_3_, counts_strain_, row_p_,
          reference_, speed_, error_sum_, error_count_, next_row_, row_start_, wall_time_, record_, records_, tries_,
          still_, handed_, view_, memory_);
        if constexpr (A::reading)
            if (begun_ && (finished() || memory_.size() != current().end.memory))
                throw input_error("checkpoint", fmt::format("stage {} with {} numbers kept", stage_, memory_.size()),
                                  "the stages of this test", "Resume with the stages that the test was made of.");
    }

  private:
    /// Rows while a stress is built up, 60 at most: each at a p' larger by this ratio, from this part of the confining
    /// stress on.
    static constexpr double rows_ratio = 1.1, rows_from = 5e-3;

    const stage& current() const { return plan.stages[stage_]; }
    /// The same, or the last one where all have ended.
    const stage& running() const { return plan.stages[std::min(stage_, plan.stages.size() - 1)]; }
    protocol::path_stress stresses() const {
        return protocol::stress_of(sim.boundary, sim.loads(), running().lateral_y.has_value());
    }
    /// What the audit cannot explain in a state just measured (J).
    double unexplained(const sample& s) const {
        return s.boundary_work + sim.totals().initial_energy - s.kinetic_energy - s.elastic_energy -
               s.friction_dissipation - s.damping_dissipation - s.bond_dissipation - sim.potential_energy();
    }
    double closing_speed() const { return sim.boundary.velocity(0) + sim.boundary.velocity(1); }

    /// Begins the stage that is due, if none is running, and leaves out those that are not needed.
    void begin_due(observer& watch) {
        while (!begun_ && stage_ < plan.stages.size()) {
            if (current().skip_if_relaxed && ended_by_itself_) {
                ++stage_;
                continue;
            }
            begin_stage();
            watch.on_stage(current().name, true);
            report(watch);
        }
    }

    void begin_stage() {
        const stage& s = current();
        begun_ = true;
        ended_by_itself_ = false;
        stage_steps_ = 0, stage_time_ = 0.0, tries_ = 0;
        error_sum_ = 0.0, error_count_ = 0;
        hand_over();
        start_height_ = sim.boundary.height();
        counts_strain_ = counts_strain_ || s.reference_here;
        if (s.reference_here) {
            reference_height_ = sim.boundary.height();
            reference_volume_ = sim.boundary.volume();
            sim.place_all();
            reference_.resize(sim.grains.pebble_count());
            for (std::size_t p = 0; p < reference_.size(); ++p) {
                const auto pebble = static_cast<std::int32_t>(p);
                reference_[static_cast<std::size_t>(measure::number_of_pebble(sim.grains, pebble))] =
                    sim.grains.pebbles[p].x;
            }
        }
        start_volume_ = sim.boundary.volume();
        start_sigma_3_ = stresses().sigma_3;
        sim.breakage_on = s.breakage;
        if (!s.keeps_friction) sim.set_friction(s.friction >= 0.0 ? s.friction : friction_);
        if (s.from_rest) protocol::stop_grains(sim);
        record_ = {};
        record_.name = s.name, record_.friction = sim.friction();
        const sample now = measure();
        stage_work_ = now.boundary_work;
        stage_losses_ = now.friction_dissipation + now.damping_dissipation;
        stage_residual_ = unexplained(now);
        speed_.begin(s, felt(now.p, now.coordination));
        row_start_ = axial_strain();
        protocol::check_direction(s, row_start_);
        next_row_ = 1, row_p_ = 0.0;
        still_ = {};
        view_ = {};
        memory_.assign(s.end.memory, 0.0);
        look(true);
        sim.expect_speed(boundaries::fastest(sim.drives));
    }

    prepared_specimen handed_now() const {
        return protocol::handed_over(sim, reference_height_, reference_volume_, records_);
    }
    /// The membrane in the place of the vessel, where a stage asks for it.
    void hand_over() {
        const stage& s = current();
        if (!s.hands_over || sim.totals().replaced > 0) {
            if (s.membrane_here) sim.set_boundary(sim.boundary.resized(membrane_));
            return;
        }
        if (!handed_) handed_ = handed_now();
        protocol::begin_at_rest(sim, *handed_, membrane_, s.membrane_here);
    }
    /// end: what ended it, in words.
    void end_stage(observer& watch, bool by_itself, std::string end) {
        // the row of this very step may have just been there
        const sample now = last_row_ != sim.totals().steps ? report(watch) : measure();
        record_.end = std::move(end);
        record_.reached = by_itself;
        record_.p = now.p, record_.porosity = now.porosity, record_.coordination = now.coordination;
        record_.unbalanced_ratio = now.unbalanced_ratio, record_.steps = stage_steps_;
        records_.push_back(record_);
        watch.on_stage(current().name, false);
        if (!by_itself) watch.on_note(fmt::format("{}: {}", record_.name, record_.end));
        ended_by_itself_ = by_itself;
        begun_ = false;
        ++stage_;
    }

    /// Whether walls that go to a size advance no more.
    bool jammed() const {
        return speed_.yields(current()) && view_.travel_left > 0.0 && view_.coordination >= 1.0 &&
               speed_.advance() < plan.jammed_inertial_number;
    }
    /// The next friction of the list once the specimen rests short of its goal; then the end of the patience.
    void try_next_friction(observer& watch) {
        const stage& s = current();
        if (!s.then_friction.empty() || s.give_up_gently) {
            const bool stuck = jammed(), at_rest = stage_steps_ > 2000 && view_.unbalanced_ratio < 1e-3;
            const std::int64_t share = s.most_steps / static_cast<std::int64_t>(s.then_friction.size() + 1);
            if (!stuck && !at_rest && stage_steps_ < (tries_ + 1) * share) return;
            const auto next = std::find_if(s.then_friction.begin(), s.then_friction.end(),
                                           [&](double mu) { return mu < sim.friction(); });
            if (next != s.then_friction.end()) {
                ++tries_;
                sim.set_friction(record_.friction = *next);
                speed_.try_again(s);
                return;
            }
            if (s.give_up_gently) {
                end_stage(watch, false, protocol::short_of(s, view_, sim.friction(), porosity(), stuck));
                return;
            }
        }
        if (s.ends_at_standstill && still_.look(view_, sim.boundary.volume())) {
            if (!protocol::nearly_there(view_)) fail(still_.text());
            end_stage(watch, false,
                      fmt::format("{}, short of '{}' ({})", still_.text(), s.end.text, protocol::errors_of(view_)));
        } else if (stage_steps_ >= s.most_steps) {
            fail({});
        }
    }
    /// still: that nothing changes any more, or nothing.
    [[noreturn]] void fail(const std::string& still) const {
        throw protocol::no_end(current(), view_, measure(), stage_steps_, when(), still);
    }

    std::string when() const {
        return fmt::format("step {}, t = {:.6g} s, axial strain {:.4g} %", sim.totals().steps, sim.time(),
                           100.0 * axial_strain());
    }

    double radius() const { return sim.boundary.radius(); }
    double porosity() const { return 1.0 - solid_volume_ / sim.boundary.volume(); }
    protocol::wall_view felt(double p, double coordination) const {
        return {sim.boundary.height(), radius(), p, coordination, static_cast<double>(plan.look_every) * sim.dt()};
    }
    bool met_between_looks() {
        if (!current().end.every_step) return false;
        glance();
        return current().end.met(view_);
    }
    /// Refreshes what of the view costs next to nothing, beside a step.
    void glance() {
        const auto& b = sim.boundary;
        const protocol::path_stress stress = stresses();
        view_.sigma_1 = stress.sigma_1, view_.sigma_2 = stress.sigma_2, view_.sigma_3 = stress.sigma_3;
        view_.q = stress.q, view_.p = stress.p;
        view_.axial_strain = axial_strain();
        view_.volumetric_strain = 1.0 - b.volume() / reference_volume_;
        view_.memory = memory_;
        view_.steps = stage_steps_;
        view_.time = stage_time_;
    }
    /// Sets what drives that follow the specimen aim at.
    void follow() {
        if (!protocol::follows(current())) return;
        glance();
        protocol::follow(sim.drives, current(), view_, sim.boundary, start_volume_, sim.dt());
    }
    /// Refreshes all of the view that conditions see, and the drives that depend on it. first: before the first step.
    void look(bool first = false) {
        const auto& b = sim.boundary;
        const stage& s = current();
        glance();
        view_.strain_at_start = row_start_;
        view_.confining = plan.confining;
        view_.grain_diameter = plan.grain_diameter;
        const measure::contact_state c = measure::contacts_of(sim);
        protocol::note_rest(view_, sim, c);
        contacts_ = c;
        if (!first) record_.largest_p = std::max(record_.largest_p, view_.p);
        view_.axial_error = s.axial.how == axis_drive::kind::stress
                                ? std::abs(view_.sigma_1 - s.axial.value) / std::max(s.axial.value, least_stress())
                                : 0.0;
        view_.confining_error = confining_error(s);
        view_.travel_left = std::max(speed_.way_left(s.axial, 0, b.height()), speed_.way_left(s.lateral, 1, radius()));
        sim.drives = speed_.look(s, felt(view_.p, c.coordination), first);
        follow();
        if (speed_.yields(s)) protocol::give_way(sim, speed_, s);
        if (s.moves_grains && c.coordination < 1.0)
            protocol::move_free_grains(sim, speed_.rates()[0], speed_.rates()[1]);
    }

    double least_stress() const { return plan.least_stress * plan.confining; }
    /// Lateral stress (Pa) that a stage aims at now; negative where it is not controlled.
    double lateral_target(const stage& s) const {
        return s.lateral.how == axis_drive::kind::stress   ? s.lateral.value
               : s.lateral.how == axis_drive::kind::follow ? sim.drives.lateral.value
                                                           : -1.0;
    }
    /// Of the lateral stress in this stage, relative; 0 where it is not controlled.
    double confining_error(const stage& s) const {
        const double target = lateral_target(s), least = least_stress();
        if (target < 0.0) return 0.0;
        if (s.lateral_y) return std::abs(stresses().sigma_3 - target) / std::max(target, least);
        return target < least ? std::abs(sim.boundary.lateral_stress(sim.loads()) - target) / least
                              : sim.boundary.confining_error(sim.loads(), target);
    }
    void confining_now() {
        const stage& s = current();
        if (lateral_target(s) < 0.0) return;
        error_sum_ += confining_error(s);
        ++error_count_;
    }

    bool row_due() const {
        const axis_drive::kind k = current().axial.how;
        if (k == axis_drive::kind::inertial || k == axis_drive::kind::rate) {
            const double done = std::abs(axial_strain() - row_start_);
            return done >= static_cast<double>(next_row_) * row_strain();
        }
        // while a stress is built up: at equal steps of its logarithm, as e is drawn against it
        if (k == axis_drive::kind::stress) {
            const double p = stresses().p;
            if (p > rows_from * plan.confining && p > rows_ratio * row_p_) return true;
        }
        return stage_steps_ % plan.row_steps == 0;
    }

    sample report(observer& watch) {
        flush_events(watch);
        last_row_ = sim.totals().steps;
        const sample row = measure();
        row_p_ = std::max(row_p_, row.p);
        watch.on_row(row);
        if (scene_watch_ != nullptr) {
            sim.place_all();
            scene_watch_->on_scene(sim.state(), row);
        }
        error_sum_ = 0.0, error_count_ = 0;
        const double done = std::abs(axial_strain() - row_start_);
        next_row_ = 1 + static_cast<std::int64_t>(done / row_strain());
        return row;
    }
    double row_strain() const { return plan.row_strain / running().row_density; }
    void flush_events(observer& watch) {
        std::vector<fracture_event> events = sim.take_events();
        if (events.empty()) return;
        // before the strains of the test begin to count, those that go back to the vessel of the cloud say nothing
        const double strain = counts_strain_ ? axial_strain() : 1.0 - sim.boundary.height() / start_height_;
        for (fracture_event& e : events) e.stage = stage_name(), e.axial_strain = strain;
        watch.on_events(events);
    }

    boundaries::vessel_settings membrane_;
    std::optional<prepared_specimen> handed_;
    scene_observer<P>* scene_watch_ = nullptr; ///< the observer of run(), if it looks at scenes
    std::size_t stage_ = 0;
    bool begun_ = false;
    bool ended_by_itself_ = false;
    std::int64_t stage_steps_ = 0;
    double stage_time_ = 0.0, stage_work_ = 0.0, stage_losses_ = 0.0, stage_residual_ = 0.0;
    std::int64_t tries_ = 0; ///< frictions tried in this stage
    double reference_height_ = 0.0, reference_volume_ = 0.0;
    double start_height_ = 0.0, start_volume_ = 0.0, start_sigma_3_ = 0.0; ///< at the start of the stage (m, m^3, Pa)
    bool counts_strain_ = false; ///< whether a stage with `reference_here` has begun
    double row_p_ = 0.0;         ///< largest p of the rows of this stage (Pa)
    std::vector<vec3> reference_;
    protocol::wall_speed speed_;
    protocol::standstill still_;
    stage_record record_;               ///< of the running stage
    std::vector<stage_record> records_; ///< of those that have ended
    double error_sum_ = 0.0;
    std::int64_t error_count_ = 0;
    std::int64_t next_row_ = 1, last_row_ = -1; ///< number of the next one in shear; step of the last one
    double row_start_ = 0.0;                    ///< axial strain at the start of the stage
    double wall_time_ = 0.0;
    double friction_ = 0.0, solid_volume_ = 0.0;
    measure::relative_breakage finer_; ///< than at the start
    stage_view view_;
    std::vector<double> memory_; ///< of the condition of this stage
    measure::contact_state contacts_;
};

/// For a bundle that does not fit (triaxial_policies): an error that says what is missing, and nothing after it.
template <class P>
requires(!triaxial_policies<P>) class runner<P> : public runner<repaired_test_policies<P>> {
    static_assert(sizeof(check_test_policies<P>) > 0);

  public:
    template <class Engine> runner(Engine&, test_plan, const boundaries::vessel_settings&);
};

} // namespace clast
