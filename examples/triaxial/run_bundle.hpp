// SPDX-License-Identifier: MIT
// The run loop of one bundle: sets the test up, watches it, saves and resumes it, and hands its results to the folder.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <clast/core/errors.hpp>
#include <clast/io/checkpoint.hpp>
#include <clast/io/packing.hpp>
#include <clast/io/progress.hpp>
#include <clast/measure/digest.hpp>
#include <clast/protocol/paths.hpp>
#include <clast/protocol/triaxial.hpp>

#include "grains.hpp"
#include "options.hpp"
#include "results.hpp"
#include "signals.hpp"

namespace triaxial {

/// What a checkpoint holds: the test and how far its files had got.
template <class Test> struct saved_run {
    Test* test;
    result_position at;

    template <class A> void archive(A& a) {
        test->archive(a);
        a(at);
    }
};

inline constexpr const char* prepared_fingerprint = "prepared specimen";

/// Passes rows, events, snapshots and checkpoints on to the folder of results.
template <class Test> class watcher : public clast::observer {
  public:
    watcher(const options& o, Test& test, result_folder& folder, std::string fingerprint)
        : options_(o), test_(test), folder_(folder), fingerprint_(std::move(fingerprint)), bar_(o.quiet),
          saved_at_(std::chrono::steady_clock::now()) {
        next_snapshot_ =
            1 + static_cast<int>(std::floor(std::abs(test_.protocol().axial_strain()) / snapshot_strain() + 1e-9));
    }

    void on_row(const clast::sample& s) override {
        folder_.row(s);
        const double strain = std::abs(s.axial_strain);
        if (is_path(s.stage) && s.stage != "unload" && strain >= next_snapshot_ * snapshot_strain() * (1.0 - 1e-9)) {
            snapshot();
            next_snapshot_ = 1 + static_cast<int>(std::floor(strain / snapshot_strain() + 1e-9));
        }
    }
    void on_events(const std::vector<clast::fracture_event>& events) override { folder_.events(events); }
    void on_stage(const std::string& name, bool begins) override {
        const clast::stage& stage = test_.protocol().plan.stages[test_.protocol().stage_number()];
        if (begins && !options_.quiet) bar_.note(fmt::format("{}: until {}", name, stage.end.text));
        // the specimen as prepared: another run may start from it, whatever its membrane
        if (stage.hands_over && begins) write_prepared();
        if (stage.reference_here && begins) {
            folder_.start_of_shear(view());
            next_snapshot_ = 1;
        }
        if (is_path(name) && name != "unload" && !begins) folder_.end_of_shear(view());
        if (begins || name == options_.stop_after_stage) snapshot();
        if (!begins) save_due_ = true;
        if (!begins && name == options_.stop_after_stage) stop_ = true;
    }
    void on_note(const std::string& text) override { bar_.note("note: " + text); }
    void on_progress(const clast::sample& s, double part, double) override {
        const std::string text = is_path(s.stage) ? fmt::format("eps_a {:5.2f} %", 100.0 * s.axial_strain)
                                                  : fmt::format("p' {:.0f} kPa", 1e-3 * s.p);
        bar_.update({s.stage, part, whole(part), text, s.q, s.steps});
    }
    void on_pause() override {
        const auto now = std::chrono::steady_clock::now();
        const bool stop = requested_stop() != 0 || stop_ ||
                          (options_.stop_after_steps > 0 && test_.sim().totals().steps >= options_.stop_after_steps);
        if (!stop && !save_due_ && std::chrono::duration<double>(now - saved_at_).count() < options_.save_every) return;
        save();
        saved_at_ = now;
        save_due_ = false;
        stop_ = stop;
    }
    bool stop_requested() override { return stop_; }

    /// The specimen as prepared, for --from and --packing of other runs.
    void write_prepared() {
        clast::write_packing(folder_.path() / "packing.csv", test_.sim().grains);
        clast::prepared_specimen specimen = test_.protocol().prepared();
        clast::save_checkpoint(folder_.path() / prepared_file, prepared_fingerprint, specimen);
    }
    void save() {
        saved_run<Test> state{&test_, folder_.position()};
        clast::save_checkpoint(folder_.checkpoint(), fingerprint_, state);
        saved_step_ = test_.sim().totals().steps;
    }
    std::int64_t saved_step() const { return saved_step_; }
    /// The specimen for the figures, where a run ends in the middle of its path.
    void end_short() {
        if (!test_.protocol().finished() && is_path(test_.protocol().stage_name())) folder_.end_of_shear(view());
    }
    clast::progress& bar() { return bar_; }

  private:
    double snapshot_strain() const { return options_.strain / std::max(options_.snapshots, 1); }
    specimen_view view() {
        return {test_.protocol().axial_strain(), test_.protocol().pebbles(), test_.protocol().facets()};
    }
    void snapshot() {
        if (options_.snapshots <= 0) return;
        const specimen_view v = view();
        folder_.snapshot(test_.sim().time(), v.pebbles, v.facets);
    }
    static bool is_path(const std::string& stage) {
        return std::find(shear_stages.begin(), shear_stages.end(), stage) != shear_stages.end();
    }
    /// Part of the run, by what stages usually cost.
    double whole(double part) const {
        double before = 0.0, mine = 0.0, total = 0.0;
        const std::vector<clast::stage>& stages = test_.protocol().plan.stages;
        for (std::size_t k = 0; k < stages.size(); ++k) {
            const double weight = is_path(stages[k].name) ? 10.0 : stages[k].name == "seat" ? 0.0 : 1.0;
            total += weight;
            if (k == test_.protocol().stage_number()) mine = weight;
            if (k < test_.protocol().stage_number()) before += weight;
        }
        return (before + mine * part) / total;
    }

    const options& options_;
    Test& test_;
    result_folder& folder_;
    std::string fingerprint_;
    clast::progress bar_;
    std::chrono::steady_clock::time_point saved_at_;
    int next_snapshot_ = 1;
    bool save_due_ = false;
    bool stop_ = false;
    std::int64_t saved_step_ = -1;
};

/// The path of a protocol behind the consolidation; stresses and inertial number are those of the setup.
inline std::vector<clast::stage> path_of(const options& o) {
    using namespace clast;
    const quantities::ratio strain{o.strain};
    const path_options& p = o.path;
    if (o.protocol == "extension") return {protocol::extension(strain)};
    if (o.protocol == "cyclic") {
        protocol::cycle_settings c{
            .count = p.cycles, .high = quantities::stress{p.cycle_high}, .low = quantities::stress{p.cycle_low}};
        if (p.cycle_strain > 0.0) c.every = quantities::ratio{p.cycle_strain};
        return protocol::cyclic(c, strain);
    }
    stage shear = o.protocol == "constant_p"      ? protocol::constant_p(strain)
                  : o.protocol == "undrained"     ? protocol::undrained(strain)
                  : o.protocol == "true_triaxial" ? protocol::true_triaxial(p.b, strain)
                                                  : protocol::shear(strain);
    if (p.peak_drop > 0.0) shear = protocol::until_peak(std::move(shear), quantities::ratio{p.peak_drop});
    std::vector<stage> path{std::move(shear)};
    if (o.protocol == "unload") path.push_back(protocol::unloading(quantities::stress{0.05 * o.confining}));
    return path;
}
/// The stages that --protocol asks for.
inline std::vector<clast::stage> stages_of(const options& o) {
    using namespace clast;
    std::vector<stage> s = protocol::preparation();
    if (o.protocol == "prepare") return s;
    if (o.protocol == "oedometer") {
        s.push_back(protocol::oedometer(quantities::stress{o.path.axial_stress}, quantities::ratio{o.strain}));
        return s;
    }
    s.push_back(protocol::consolidation());
    if (o.protocol == "isotropic") return s;
    for (stage& one : path_of(o)) s.push_back(std::move(one));
    return s;
}

/// What becomes of a grain that breaks.
inline clast::replacements::any replacement_of(const options& o) {
    using namespace clast;
    bonds::parallel bond;
    bond.reading = o.bond_stiffness_reading == bond_reading::force     ? bonds::stiffness_reading::force
                   : o.bond_stiffness_reading == bond_reading::modulus ? bonds::stiffness_reading::modulus
                                                                       : bonds::stiffness_reading::per_area;
    bond.normal_stiffness = o.bond_stiffness, bond.shear_stiffness = 0.5 * o.bond_stiffness;
    bond.tensile_strength = o.rock().bond_tension, bond.cohesion = o.rock().bond_cohesion;
    const auto how = o.birth == "zero" ? replacements::birth::zero_force : replacements::birth::warm_start;
    const auto with = [&](auto policy) -> replacements::any {
        policy.bond = bond;
        if constexpr (requires { policy.how; }) policy.how = how;
        return policy;
    };
    if (o.replacement == "refreezing") return with(replacements::refreezing{});
    if (o.replacement == "rigid_bonded") return with(replacements::rigid_bonded{});
    if (o.replacement == "bonded_from_start") return with(replacements::bonded_from_start{});
    return with(replacements::modified{});
}

template <class P> clast::triaxial_setup<P> setup_of(const options& o) {
    using namespace clast;
    table_1 materials = o.stiffness == "series" ? table_1::of_pieces() : table_1{};
    materials.pebble.friction = o.friction;
    materials.platen.friction = o.platen_friction;
    materials.membrane.friction = o.membrane_friction;
    typename P::breakage breakage = [&]() -> typename P::breakage {
        if constexpr (P::breakage::evaluated) {
            const std::string name = o.criterion == "hertz_calibrated" ? "hertz_contact"
                                     : o.criterion == "mean"           ? "mean_stress"
                                                                       : o.criterion;
            const criteria::crushing_strength strength(o.rock().characteristic, grain_diameter,
                                                       o.weibull > 0.0 ? o.weibull : 10.0);
            const auto which =
                o.contact_force == "single" ? criteria::force_of::contact : criteria::force_of::neighbour;
            return {criteria::by_name(name, strength, which),
                    o.weibull > 0.0 ? o.weibull : std::numeric_limits<double>::infinity(), o.seed};
        } else {
            return {};
        }
    }();
    typename P::replacement replacement = [&]() -> typename P::replacement {
        if constexpr (P::replacement::replaces)
            return replacement_of(o);
        else
            return {};
    }();
    mixture grains = grains_of(o);
    protocol::packing packing = packing_of(o, grains);
    return {.grain = std::move(grains),
            .diameter = quantities::length{o.diameter()},
            .height = quantities::length{o.height()},
            .confining = quantities::stress{o.confining},
            .breakage = std::move(breakage),
            .replacement = std::move(replacement),
            .packing = std::move(packing),
            .porosity = o.porosity,
            .rings = std::max(o.rings, 1),
            .tiles_per_ring = o.tiles_per_ring,
            .membrane_stiffness = o.membrane_stiffness,
            .materials = materials,
            .inertial_number = o.inertial_number,
            .damping = o.damping,
            .seed = o.seed,
            .threads = o.threads > 0 ? o.threads : available_threads(),
            .rows = std::max<std::int64_t>(1, std::llround(o.rows * 0.25 / o.strain))};
}

/// What the summary tells of a test. bundle: name of its policies.
template <class Test> run_facts facts_of(Test& test, const char* bundle) {
    clast::boundaries::boundary_counters counters; // of walls that have any
    if constexpr (requires { test.sim().boundary.counters(); }) counters = test.sim().boundary.counters();
    std::int64_t bonds_in_all_grains = 0;
    for (const clast::grain& g : test.sim().grains.grains)
        bonds_in_all_grains += static_cast<std::int64_t>(test.sim().grains.shape_of(g).bonds.size());
    return {.grains = static_cast<std::int64_t>(test.sim().grains.grain_count()),
            .pebbles = static_cast<std::int64_t>(test.sim().grains.pebble_count()),
            .bonds_in_all_grains = bonds_in_all_grains,
            .threads = test.setup().threads,
            .bundle = bundle,
            // without the forces of the last step, which a finished run that is looked at again does not have
            .checksum = clast::measure::digest_of_state(test.sim()),
            .stages = test.protocol().records(),
            .more = {{"list_searches", static_cast<double>(test.sim().totals().rebuilds)},
                     {"list_renewals", static_cast<double>(test.sim().totals().renewals)},
                     {"sub_steps_of_light_bodies", static_cast<double>(test.sim().light_steps())},
                     {"light_bodies_take_sub_steps", test.sim().takes_sub_steps() ? 1.0 : 0.0},
                     {"tile_steps_at_speed_limit_share",
                      counters.tile_steps > 0
                          ? static_cast<double>(counters.capped) / static_cast<double>(counters.tile_steps)
                          : 0.0},
                     {"latched_pair_steps", static_cast<double>(counters.latched_pair_steps)}}};
}

template <class P> int run_bundle(const options& o, const char* name) {
    using test_type = clast::triaxial_test<P>;
    const std::string fingerprint = fmt::format("bundle = {}\n{}", name, physics_text(o));
    test_type test(setup_of<P>(o), stages_of(o));
    saved_run<test_type> state{&test, {}};
    if (o.resume) clast::load_checkpoint(o.out / "checkpoint.clast", fingerprint, state);
    if (!o.from.empty() && !o.resume) {
        clast::prepared_specimen specimen;
        clast::load_checkpoint(o.from, prepared_fingerprint, specimen);
        test.protocol().take_over(specimen);
    }
    result_folder folder = o.resume ? result_folder(o, state.at) : result_folder(o);
    watcher<test_type> watch(o, test, folder, fingerprint);
    if (!o.quiet)
        watch.bar().note(fmt::format("{} {} grains, {} pebbles, specimen {:.3g} x {:.3g} cm, {} thread{}",
                                     o.resume ? "resuming:" : "", test.sim().grains.grain_count(),
                                     test.sim().grains.pebble_count(), 100.0 * o.diameter(), 100.0 * o.height(),
                                     test.setup().threads, test.setup().threads == 1 ? "" : "s"));
    bool finished = false;
    try {
        finished = test.run(watch);
    } catch (const clast::run_error& e) {
        watch.bar().clear();
        clast::failure f = e.details;
        f.advice += watch.saved_step() >= 0
                        ? fmt::format("\n  last checkpoint: {} (step {}); go on from it with --resume {}",
                                      folder.checkpoint().string(), watch.saved_step(), folder.path().string())
                        : "\n  last checkpoint: none was written yet";
        try { // what there is, for one who looks for the cause
            watch.end_short();
            run_facts facts = facts_of(test, name);
            facts.stopped_by = f;
            folder.finish(facts);
        } catch (const std::exception& also) {
            fmt::print(stderr, "note: summary and figures of what there is could not be written: {}\n", also.what());
        }
        throw clast::run_error(f);
    }
    watch.bar().clear();
    if (!finished) {
        fmt::print("stopped at step {} with a checkpoint; go on with\n  --resume {}\n", test.sim().totals().steps,
                   folder.path().string());
        return requested_stop() != 0 ? 128 + requested_stop() : 0;
    }
    if (o.protocol == "prepare") watch.write_prepared();
    watch.save(); // so that a finished run can be looked at again
    folder.finish(facts_of(test, name));
    return 0;
}

} // namespace triaxial
