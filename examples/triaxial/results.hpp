// SPDX-License-Identifier: MIT
// The folder of results: tables, snapshots, summary and figures of one run. manual/results.md says what is in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <clast/core/errors.hpp>
#include <clast/io/csv.hpp>
#include <clast/io/vtk.hpp>
#include <clast/measure/sample.hpp>
#include <clast/protocol/stage_record.hpp>

#include "options.hpp"
#include "plots.hpp"

namespace triaxial {

/// How far the files had got when a checkpoint was written. Part of the checkpoint.
struct result_position {
    std::int64_t rows = 0;
    std::int64_t events = 0;
    std::int64_t snapshots = 0;

    template <class A> void archive(A& a) { a(rows, events, snapshots); }
};

/// What only the simulator knows and the summary tells.
struct run_facts {
    std::int64_t grains = 0;
    std::int64_t pebbles = 0;
    std::int64_t bonds_in_all_grains = 0; ///< if all of them became clusters
    int threads = 1;
    std::string bundle;                         ///< name of the policies
    std::uint64_t checksum = 0;                 ///< of the final state
    std::vector<clast::stage_record> stages{};  ///< those that have ended
    std::optional<clast::failure> stopped_by{}; ///< what ended the run short of its protocol
    std::vector<std::pair<std::string, double>>
        more; ///< further numbers by name with unit, e.g. {"grain_step_s", 1e-5}
};

/// A value and where it was reached.
struct extreme {
    double value = 0.0;
    double axial_strain = 0.0;
    double p = 0.0; ///< mean stress there (Pa)
};

/// One stage in the summary.
struct stage_time {
    std::string name;
    double model_time = 0.0; ///< (s)
    std::int64_t steps = 0;
    double wall_time = 0.0; ///< (s)
};

/// Numbers of the shear stages (shear_stages), as the paper's figures quote them.
struct summary_numbers {
    std::vector<stage_time> stages;
    bool sheared = false;
    extreme peak_q;               ///< of the laboratory (Pa), largest row; in extension the smallest
    double peak_q_contacts = 0.0; ///< the same from contacts (Pa)
    double contacts_over_q = 0.0; ///< mean of q from contacts over mean of q, in the last fifth of the strain
    double max_q_mismatch = 0.0;  ///< |q - q from contacts| / q, largest where q exceeds a tenth of sigma_3
    extreme phi_max;              ///< mobilised friction angle (degrees) after a 0.2 % strain moving average (Fig. 14)
    extreme e_min;                ///< smallest void ratio (Fig. 15)
    double e_start = 0.0;         ///< void ratio at the start of shear
    double q_end = 0.0;           ///< (Pa)
    extreme peak_pore_pressure;   ///< largest (Pa), 0 where the test is drained
    double pore_pressure_end = 0.0; ///< (Pa)
    double k0 = 0.0;                ///< sigma_3 / sigma_1, mean over the last fifth of sigma_1 in an oedometer; 0: none
    double volumetric_strain_end = 0.0; ///< compression positive
    double axial_strain_end = 0.0;
    double mean_confining_error = 0.0;
    double max_confining_error = 0.0;
    double max_energy_residual = 0.0; ///< largest magnitude where the stage has done 2 % of the most work of one
    double max_inertial_number = 0.0;
    double median_overlap_over_r = 0.0; ///< largest median of a row, of all stages
    double max_overlap_over_r = 0.0;    ///< largest of all rows
    std::int64_t replaced = 0, broken_tension = 0, broken_shear = 0, escaped = 0;
    std::int64_t replaced_in_shear = 0, broken_in_shear = 0;
    std::int64_t steps = 0;
    double wall_time = 0.0; ///< (s)
};
summary_numbers summarise(std::span<const clast::sample> rows);
/// What should be known of a run before its numbers are used: sentences, with their weight in front ("note",
/// "warning").
std::vector<std::string> remarks(const summary_numbers& n);

/// How the specimen was prepared, from the records of the stages before shear.
struct preparation_numbers {
    double largest_p_before_consolidation = 0.0;  ///< (Pa)
    double overconsolidation_ratio = 0.0;         ///< largest p before shear over the confining stress; 1 is wanted
    double friction = 0.0;                        ///< least between pebbles before consolidation
    std::optional<clast::stage_record> at_rest;   ///< the last stage before consolidation: relax, or seat
    std::optional<clast::stage_record> at_stress; ///< consolidation
};
preparation_numbers preparation_of(std::span<const clast::stage_record> stages, double confining);

/// Names of the stages that count as shear (the path of a test, drawn against axial strain), and as compression, in
/// figures and summary.
inline const std::vector<std::string> shear_stages{"shear", "unload", "reload", "extend", "load"};
inline const std::vector<std::string> loading_stages{"consolidate"};

/// Owns the files of a run. A row or event is in its file when the call returns. Throws clast::input_error for a folder
/// that cannot be used (before anything is written) and clast::run_error for a write that failed.
class result_folder {
  public:
    /// Starts a new run in o.out: creates the folder, refuses one with results unless o.overwrite.
    explicit result_folder(const options& o);
    /// Goes on where a checkpoint was: cuts the tables back to its position.
    result_folder(const options& o, const result_position& at);

    void row(const clast::sample& s);
    void events(std::span<const clast::fracture_event> list);
    /// One ParaView snapshot at model time (s).
    void snapshot(double time, std::span<const clast::pebble_view> pebbles, std::span<const clast::facet_view> facets);
    /// The specimen for the figures, kept on disk until finish().
    void start_of_shear(const specimen_view& view);
    void end_of_shear(const specimen_view& view);

    /// To be stored in the checkpoint that is written next.
    [[nodiscard]] result_position position() const;
    /// Where the checkpoint belongs.
    [[nodiscard]] std::filesystem::path checkpoint() const { return folder_ / "checkpoint.clast"; }
    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

    /// Writes summary.json, draws the figures (unless --no-plots) and prints the summary and the paths to stdout. Of a
    /// run that was stopped by an error, too: all of them say "unfinished".
    void finish(const run_facts& facts);

  private:
    void write_summary(const run_facts& facts, const summary_numbers& n) const;

    options options_;
    std::filesystem::path folder_;
    std::vector<clast::sample> rows_;
    std::int64_t event_count_ = 0;
    std::optional<clast::series_writer> series_;
    std::optional<clast::event_writer> events_;
    std::optional<clast::vtk_series> vtk_;
};

} // namespace triaxial
