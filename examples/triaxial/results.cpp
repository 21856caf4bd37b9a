// SPDX-License-Identifier: MIT
#include "results.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>
#include <thread>

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include <clast/core/errors.hpp>
#include <clast/io/checkpoint.hpp>
#include <clast/io/detail/atomic_file.hpp>
#include <clast/version.hpp>

#include "grains.hpp"

namespace triaxial {

using clast::input_error;
using clast::sample;
namespace fs = std::filesystem;

namespace {

// What a run writes; nothing else in the folder is ever touched.
constexpr std::array own_files{"series.csv", "events.csv", "summary.json", "checkpoint.clast", arguments_file,
                               "vtk",        "plots",      input_folder,   "packing.csv",      prepared_file};

bool is_shear(const sample& s) {
    return std::find(shear_stages.begin(), shear_stages.end(), s.stage) != shear_stages.end();
}

input_error unusable(const options& o, const std::string& why, const std::string& way_out) {
    return input_error("--out", o.out.string(), "a folder that can be created and written", why + " " + way_out);
}

/// Views on disk: padding and enums one by one, so that the file does not depend on the compiler.
struct stored_view {
    specimen_view view;

    template <class A> void archive(A& a) {
        auto pebbles = static_cast<std::uint64_t>(view.pebbles.size()),
             facets = static_cast<std::uint64_t>(view.facets.size());
        a(view.axial_strain, pebbles, facets);
        if constexpr (A::reading) view.pebbles.resize(pebbles), view.facets.resize(facets);
        for (clast::pebble_view& p : view.pebbles)
            a(p.position, p.radius, p.grain, p.fragment, p.state, p.displacement, p.velocity);
        for (clast::facet_view& f : view.facets) a(f.corner, f.pressure, f.area, f.ring, f.tile);
    }
};
constexpr const char* view_fingerprint = "clast specimen view 1";

std::string cpu_model() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(std::min(line.find(':') + 2, line.size()));
    return "unknown";
}

std::string compiler() {
#if defined(__clang__)
    return "clang++ " __clang_version__;
#elif defined(__GNUC__)
    return "g++ " __VERSION__;
#else
    return "unknown";
#endif
}

double peak_memory_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// "confining stress = 2000000 Pa" as {"confining_stress_Pa", 2000000}: numbers are numbers, their units in the key;
/// what is no number stays text.
template <class Json> std::pair<std::string, Json> input_of(const std::string& line) {
    const auto equals = line.find(" = ");
    std::string key = line.substr(0, equals), value = line.substr(equals + 3), unit;
    std::replace(key.begin(), key.end(), ' ', '_');
    std::replace(key.begin(), key.end(), '-', '_');
    if (const auto space = value.find(' '); space != std::string::npos)
        unit = value.substr(space + 1), value.resize(space);
    const auto read = [&value](auto number) -> std::optional<decltype(number)> {
        const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
        if (error != std::errc{} || end != value.data() + value.size()) return {};
        return number;
    };
    Json number;
    if (const auto whole = read(std::uint64_t{}))
        number = *whole;
    else if (const auto any = read(0.0))
        number = *any;
    else
        return {key, Json(line.substr(equals + 3))};
    if (const auto words = unit.find(' '); words != std::string::npos) unit.resize(words); // "N/m per bond"
    for (std::size_t slash; (slash = unit.find('/')) != std::string::npos;) unit.replace(slash, 1, "_per_");
    return {unit.empty() ? key : key + "_" + unit, number};
}

std::string time_text(double seconds) {
    return seconds < 60 ? fmt::format("{:.1f} s", seconds)
                        : fmt::format("{} min {:02} s", static_cast<int>(seconds) / 60, static_cast<int>(seconds) % 60);
}

} // namespace

summary_numbers summarise(std::span<const sample> rows) {
    summary_numbers n;
    for (std::size_t i = 0; i < rows.size();) {
        std::size_t j = i;
        while (j + 1 < rows.size() && rows[j + 1].stage == rows[i].stage) ++j;
        n.stages.push_back({rows[i].stage, rows[j].time - rows[i].time, rows[j].steps - rows[i].steps,
                            rows[j].wall_time - rows[i].wall_time});
        i = j + 1;
    }
    if (rows.empty()) return n;
    const sample& last = rows.back();
    n.replaced = last.replaced, n.broken_tension = last.broken_tension, n.broken_shear = last.broken_shear,
    n.escaped = last.escaped;
    n.steps = last.steps, n.wall_time = last.wall_time;
    for (const sample& s : rows) {
        n.median_overlap_over_r = std::max(n.median_overlap_over_r, s.median_overlap_over_r);
        n.max_overlap_over_r = std::max(n.max_overlap_over_r, s.max_overlap_over_r);
    }

    std::vector<const sample*> shear;
    for (const sample& s : rows)
        if (is_shear(s)) shear.push_back(&s);
    if (shear.size() < 2) return n;
    n.sheared = true;
    const sample &first = *shear.front(), &end = *shear.back();
    n.e_start = first.void_ratio;
    n.q_end = end.q;
    n.pore_pressure_end = end.pore_pressure;
    if (end.stage == "load") {
        double sum = 0.0;
        int count = 0;
        for (const sample* s : shear)
            if (s->sigma_1 >= 0.8 * end.sigma_1) sum += s->sigma_3 / s->sigma_1, ++count;
        n.k0 = sum / count;
    }
    n.axial_strain_end = end.axial_strain;
    n.volumetric_strain_end = end.volumetric_strain;
    n.replaced_in_shear = end.replaced - first.replaced;
    n.broken_in_shear = end.broken_tension + end.broken_shear - first.broken_tension - first.broken_shear;
    n.peak_q = {first.q, first.axial_strain, first.p};
    n.e_min = {first.void_ratio, first.axial_strain, first.p};
    const double sign = first.stage == "extend" ? -1.0 : 1.0; // of a strength
    double error_sum = 0.0, late_q = 0.0, late_contacts = 0.0, largest_strain = 0.0;
    for (const sample* s : shear) largest_strain = std::max(largest_strain, std::abs(s->axial_strain));
    // the residual is a part of the work of its stage: at a turning point there is none yet
    std::vector<double> work_done(shear.size(), 0.0);
    double most_work = 0.0, work_before = 0.0;
    for (std::size_t k = 0; k < shear.size(); ++k) {
        if (k == 0 || shear[k]->stage != shear[k - 1]->stage) work_before = shear[k]->boundary_work;
        work_done[k] = std::abs(shear[k]->boundary_work - work_before);
        most_work = std::max(most_work, work_done[k]);
    }
    for (const sample* const& s : shear) {
        if (sign * s->q > sign * n.peak_q.value) n.peak_q = {s->q, s->axial_strain, s->p};
        if (s->pore_pressure > n.peak_pore_pressure.value)
            n.peak_pore_pressure = {s->pore_pressure, s->axial_strain, s->p};
        if (s->void_ratio < n.e_min.value) n.e_min = {s->void_ratio, s->axial_strain, s->p};
        if (work_done[static_cast<std::size_t>(&s - shear.data())] >= 0.02 * most_work)
            n.max_energy_residual = std::max(n.max_energy_residual, std::abs(s->energy_residual));
        n.max_inertial_number = std::max(n.max_inertial_number, s->inertial_number);
        if (sign * s->q_contacts > sign * n.peak_q_contacts) n.peak_q_contacts = s->q_contacts;
        if (std::abs(s->q) > 0.1 * s->sigma_3)
            n.max_q_mismatch = std::max(n.max_q_mismatch, std::abs(s->q_contacts / s->q - 1.0));
        if (s->stage != "unload" && std::abs(s->axial_strain) >= 0.8 * largest_strain)
            late_q += s->q, late_contacts += s->q_contacts;
        if (s == shear.front()) continue; // its error still belongs to the stage before
        error_sum += s->confining_error;
        n.max_confining_error = std::max(n.max_confining_error, s->confining_error);
    }
    n.contacts_over_q = late_q != 0.0 ? late_contacts / late_q : 0.0;
    n.mean_confining_error = error_sum / static_cast<double>(shear.size() - 1);

    // moving average over 0.2 % of strain, within one stage so that an unloading branch does not mix in
    constexpr double half = 0.5 * 0.002 * (1.0 + 1e-9);
    bool any = false;
    for (std::size_t i = 0; i < shear.size(); ++i) {
        const auto near = [&](std::size_t k) {
            return shear[k]->stage == shear[i]->stage &&
                   std::abs(shear[k]->axial_strain - shear[i]->axial_strain) <= half;
        };
        double phi = shear[i]->phi_mob_deg, p = shear[i]->p, count = 1.0;
        for (std::size_t k = i; k-- > 0 && near(k);) phi += shear[k]->phi_mob_deg, p += shear[k]->p, count += 1.0;
        for (std::size_t k = i + 1; k < shear.size() && near(k); ++k)
            phi += shear[k]->phi_mob_deg, p += shear[k]->p, count += 1.0;
        if (!any || sign * phi / count > sign * n.phi_max.value)
            n.phi_max = {phi / count, shear[i]->axial_strain, p / count};
        any = true;
    }
    return n;
}

std::vector<std::string> remarks(const summary_numbers& n) {
    std::vector<std::string> all;
    // a tenth in the middle: half of all contacts are deeper than what "rigid grains with small overlaps" means
    if (n.median_overlap_over_r > 0.1)
        all.push_back(
            fmt::format("note: half of all contacts overlap by more than {:.2f} of the smaller radius; grains "
                        "are soft against this stress, and stiffer ones would pack and shear otherwise",
                        n.median_overlap_over_r));
    if (n.max_overlap_over_r > 0.5)
        all.push_back(fmt::format("warning: the largest overlap was {:.2f} of the smaller radius; where small pebbles "
                                  "carry load their contacts are far outside of what a linear spring stands for",
                                  n.max_overlap_over_r));
    return all;
}

preparation_numbers preparation_of(std::span<const clast::stage_record> stages, double confining) {
    preparation_numbers n;
    double largest = 0.0;
    for (const clast::stage_record& s : stages) {
        if (std::find(shear_stages.begin(), shear_stages.end(), s.name) != shear_stages.end()) break;
        largest = std::max(largest, s.largest_p);
        if (std::find(loading_stages.begin(), loading_stages.end(), s.name) != loading_stages.end()) {
            n.at_stress = s;
            continue;
        }
        n.friction = n.at_rest ? std::min(n.friction, s.friction) : s.friction;
        n.at_rest = s;
        n.largest_p_before_consolidation = std::max(n.largest_p_before_consolidation, s.largest_p);
    }
    n.overconsolidation_ratio = largest / confining;
    return n;
}

result_folder::result_folder(const options& o) : options_(o), folder_(o.out) {
    std::error_code error;
    if (fs::exists(folder_, error) && !fs::is_directory(folder_, error))
        throw unusable(o, "It is a file.", "Choose another name.");
    std::string present;
    for (const char* name : own_files)
        if (fs::exists(folder_ / name, error)) present += (present.empty() ? "" : ", ") + std::string(name);
    if (!present.empty() && !o.overwrite)
        throw input_error(
            "--out", o.out.string(), "a folder without results",
            fmt::format(
                "It has {}. Choose another folder, go on with that run by --resume {}, or replace it by --overwrite.",
                present, o.out.string()));
    fs::create_directories(folder_, error);
    if (error) throw unusable(o, fmt::format("It cannot be created: {}.", error.message()), "Choose another one.");

    // written before anything is removed, so that a folder that cannot be written keeps what it has
    std::string text;
    const std::vector<fs::path> inputs = input_files(o);
    const options stored = with_files_in(o, input_folder);
    for (const std::string& a : to_arguments(stored)) text += a + "\n";
    try {
        clast::detail::replace_file(folder_ / arguments_file, {text});
    } catch (const clast::run_error& e) {
        throw unusable(o, e.details.what + ".", "Choose another one.");
    }
    for (const char* name : own_files) {
        const bool needed =
            std::string_view(name) == arguments_file || (!inputs.empty() && std::string_view(name) == input_folder);
        if (!needed) fs::remove_all(folder_ / name, error);
    }
    for (const char* name : {"vtk", "plots"}) {
        fs::create_directories(folder_ / name / (std::string_view(name) == "plots" ? "data" : ""), error);
        if (error)
            throw unusable(o, fmt::format("A folder in it cannot be created: {}.", error.message()),
                           "Choose another one.");
    }
    if (!inputs.empty()) fs::create_directories(folder_ / input_folder, error);
    for (const fs::path& file : inputs) {
        const fs::path copy = folder_ / input_folder / file.filename();
        fs::copy_file(file, copy, fs::copy_options::overwrite_existing, error);
        if (error && !fs::equivalent(file, copy, error))
            throw unusable(o, fmt::format("'{}' cannot be copied to it: {}.", file.string(), error.message()),
                           "Choose another one.");
    }
    series_.emplace(folder_ / "series.csv");
    events_.emplace(folder_ / "events.csv");
    vtk_.emplace(folder_ / "vtk");
}

result_folder::result_folder(const options& o, const result_position& at)
    : options_(o), folder_(o.out), event_count_(at.events) {
    const auto count = [](std::int64_t n) { return static_cast<std::size_t>(std::max<std::int64_t>(n, 0)); };
    rows_ = clast::truncate_table<sample>(folder_ / "series.csv", count(at.rows));
    clast::truncate_table<clast::fracture_event>(folder_ / "events.csv", count(at.events));
    vtk_.emplace(folder_ / "vtk", count(at.snapshots));
    series_.emplace(folder_ / "series.csv", clast::series_writer::mode::append);
    events_.emplace(folder_ / "events.csv", clast::event_writer::mode::append);
}

void result_folder::row(const sample& s) {
    series_->write(s);
    rows_.push_back(s);
}

void result_folder::events(std::span<const clast::fracture_event> list) {
    for (const clast::fracture_event& e : list) {
        events_->write(e);
        ++event_count_;
    }
}

void result_folder::snapshot(double time, std::span<const clast::pebble_view> pebbles,
                             std::span<const clast::facet_view> facets) {
    vtk_->write(time, pebbles, facets);
}

void result_folder::start_of_shear(const specimen_view& view) {
    clast::save_checkpoint(folder_ / "plots" / "data" / "view_start.bin", view_fingerprint, stored_view{view});
}
void result_folder::end_of_shear(const specimen_view& view) {
    clast::save_checkpoint(folder_ / "plots" / "data" / "view_end.bin", view_fingerprint, stored_view{view});
}

result_position result_folder::position() const {
    return {static_cast<std::int64_t>(rows_.size()), event_count_, static_cast<std::int64_t>(vtk_->size())};
}

void result_folder::write_summary(const run_facts& facts, const summary_numbers& n) const {
    using json = nlohmann::ordered_json;
    json inputs = json::object();
    const std::string text = physics_text(options_);
    for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
        const std::string line = text.substr(at, end - at);
        const auto [key, value] = input_of<json>(line);
        inputs[key] = value;
    }
    json j;
    j["program"] = {{"name", "clast triaxial"}, {"version", clast::version()}, {"policies", facts.bundle}};
    j["finished"] = !facts.stopped_by;
    if (const auto& f = facts.stopped_by)
        j["unfinished"] = {
            {"what", f->what}, {"where", f->where}, {"when", f->when}, {"why", f->why}, {"advice", f->advice}};
    j["inputs"] = inputs;
    j["arguments"] = to_arguments(options_);
    j["machine"] = {{"cpu", cpu_model()},
                    {"cores", std::thread::hardware_concurrency()},
                    {"threads", facts.threads},
                    {"compiler", compiler()},
                    {"peak_memory_MB", peak_memory_mb()}};
    j["specimen"] = {{"diameter_m", options_.diameter()},
                     {"height_m", options_.height()},
                     {"grains", facts.grains},
                     {"pebbles", facts.pebbles},
                     {"bonds_in_all_grains", facts.bonds_in_all_grains}};
    if (n.sheared)
        j["shear"] = {{"peak_q_Pa", n.peak_q.value},
                      {"peak_q_axial_strain", n.peak_q.axial_strain},
                      {"peak_q_contacts_Pa", n.peak_q_contacts},
                      {"q_contacts_over_q_last_fifth_of_strain", n.contacts_over_q},
                      {"max_q_mismatch", n.max_q_mismatch},
                      {"phi_max_deg", n.phi_max.value},
                      {"phi_max_axial_strain", n.phi_max.axial_strain},
                      {"phi_max_p_Pa", n.phi_max.p},
                      {"phi_max_moving_average_strain", 0.002},
                      {"void_ratio_start", n.e_start},
                      {"void_ratio_min", n.e_min.value},
                      {"void_ratio_min_normalised", n.e_start > 0.0 ? n.e_min.value / n.e_start : 0.0},
                      {"void_ratio_min_p_Pa", n.e_min.p},
                      {"q_end_Pa", n.q_end},
                      {"axial_strain_end", n.axial_strain_end},
                      {"volumetric_strain_end_compression_positive", n.volumetric_strain_end},
                      {"mean_confining_error", n.mean_confining_error},
                      {"max_confining_error", n.max_confining_error},
                      {"max_energy_residual", n.max_energy_residual},
                      {"max_inertial_number", n.max_inertial_number},
                      {"replaced", n.replaced_in_shear},
                      {"broken_bonds", n.broken_in_shear}};
    if (options_.protocol == "undrained")
        j["shear"].update({{"peak_pore_pressure_Pa", n.peak_pore_pressure.value},
                           {"peak_pore_pressure_axial_strain", n.peak_pore_pressure.axial_strain},
                           {"pore_pressure_end_Pa", n.pore_pressure_end}});
    if (n.k0 > 0.0) j["shear"]["K0_last_fifth_of_stress"] = n.k0;
    j["breakage"] = {{"replaced", n.replaced},
                     {"broken_tension", n.broken_tension},
                     {"broken_shear", n.broken_shear},
                     {"escaped", n.escaped}};
    j["overlap"] = {{"median_over_r", n.median_overlap_over_r}, {"max_over_r", n.max_overlap_over_r}};
    j["remarks"] = remarks(n);
    if (const preparation_numbers p = preparation_of(facts.stages, options_.confining); p.at_rest || p.at_stress) {
        j["preparation"] = {{"largest_p_before_consolidation_Pa", p.largest_p_before_consolidation},
                            {"least_friction", p.friction},
                            {"overconsolidation_ratio", p.overconsolidation_ratio}};
        for (const auto& [name, s] : {std::pair{"at_rest", &p.at_rest}, std::pair{"at_confining_stress", &p.at_stress}})
            if (*s)
                j["preparation"][name] = {{"p_Pa", (*s)->p},
                                          {"porosity", (*s)->porosity},
                                          {"coordination", (*s)->coordination},
                                          {"unbalanced_ratio", (*s)->unbalanced_ratio}};
    }
    j["stages"] = json::array();
    auto record = facts.stages.begin();
    for (const stage_time& s : n.stages) {
        j["stages"].push_back(
            {{"name", s.name}, {"model_time_s", s.model_time}, {"steps", s.steps}, {"wall_time_s", s.wall_time}});
        if (record == facts.stages.end() || record->name != s.name) continue;
        json& one = j["stages"].back();
        one["ended_by"] = record->end;
        one["reached_its_condition"] = record->reached;
        one["largest_p_Pa"] = record->largest_p;
        one["least_friction"] = record->friction;
        one["coordination_at_end"] = record->coordination;
        one["porosity_at_end"] = record->porosity;
        ++record;
    }
    j["steps"] = n.steps;
    j["wall_time_s"] = n.wall_time;
    for (const auto& [name, value] : facts.more) j["more"][name] = value;
    j["final_state_checksum"] = fmt::format("{:016x}", facts.checksum);
    clast::detail::replace_file(folder_ / "summary.json", {j.dump(2) + "\n"});
}

void result_folder::finish(const run_facts& facts) {
    const summary_numbers n = summarise(rows_);
    write_summary(facts, n);

    plot_report report;
    if (options_.plots) {
        plot_request request;
        request.series = folder_ / "series.csv";
        request.events = folder_ / "events.csv";
        request.stages = shear_stages;
        request.loading = loading_stages;
        if (facts.stopped_by) request.mark = "unfinished";
        request.loading.emplace_back("load"); // of an oedometer
        const auto view = [this](const char* name) {
            const fs::path path = folder_ / "plots" / "data" / name;
            stored_view v;
            if (std::error_code none; fs::exists(path, none)) clast::load_checkpoint(path, view_fingerprint, v);
            return std::move(v.view);
        };
        request.start = view("view_start.bin");
        request.end = view("view_end.bin");
        report = draw_plots(folder_ / "plots", request);
    }

    fmt::print("\n{} {}, {} membrane, {}: {} grains, {} pebbles, {} steps in {}\n", grains_title(options_),
               strength_text(options_), options_.membrane, stress_text(options_.confining), facts.grains, facts.pebbles,
               n.steps, time_text(n.wall_time));
    if (n.sheared) {
        fmt::print("  peak q              {:8.3f} MPa at axial strain {:.1f} %\n", n.peak_q.value / 1e6,
                   100 * n.peak_q.axial_strain);
        fmt::print("  q at the end        {:8.3f} MPa at axial strain {:.1f} %\n", n.q_end / 1e6,
                   100 * n.axial_strain_end);
        fmt::print("  q from contacts     {:8.3f} of that at the ends, in the last fifth of the strain\n",
                   n.contacts_over_q);
        fmt::print("  phi_max             {:8.1f} deg at p' {:.2f} MPa\n", n.phi_max.value, n.phi_max.p / 1e6);
        fmt::print("  volumetric strain   {:+8.2f} % at the end (dilation positive)\n",
                   0.0 - 100 * n.volumetric_strain_end);
        fmt::print("  smallest void ratio {:8.3f} ({:.3f} of that at the start of shear)\n", n.e_min.value,
                   n.e_start > 0 ? n.e_min.value / n.e_start : 0.0);
        if (options_.protocol == "undrained")
            fmt::print("  pore pressure       {:8.3f} MPa largest, {:.3f} MPa at the end\n",
                       n.peak_pore_pressure.value / 1e6, n.pore_pressure_end / 1e6);
        if (n.k0 > 0.0)
            fmt::print("  K0                  {:8.3f} = sigma_3/sigma_1, in the last fifth of the stress\n", n.k0);
    } else if (!rows_.empty()) {
        fmt::print("  mean stress p'      {:8.3f} MPa, void ratio {:.3f}\n", rows_.back().p / 1e6,
                   rows_.back().void_ratio);
    }
    if (const preparation_numbers p = preparation_of(facts.stages, options_.confining); p.at_rest && p.at_stress)
        fmt::print(
            "  preparation         {:8.3f} porosity at rest, {:.3f} at the confining stress; largest p before it "
            "{:.2f} %, overconsolidation ratio {:.3f}\n",
            p.at_rest->porosity, p.at_stress->porosity, 100 * p.largest_p_before_consolidation / options_.confining,
            p.overconsolidation_ratio);
    fmt::print("  breakage            {:8} grains replaced, {} bonds broken ({} in tension, {} in shear)\n", n.replaced,
               n.broken_tension + n.broken_shear, n.broken_tension, n.broken_shear);
    if (n.sheared)
        fmt::print("  quality             confining error {:.3f} % mean, {:.2f} % largest; energy residual {:.2f} %; I "
                   "<= {:.1e}\n",
                   100 * n.mean_confining_error, 100 * n.max_confining_error, 100 * n.max_energy_residual,
                   n.max_inertial_number);
    fmt::print("  overlap             {:8.2f} of the radius in the median, {:.2f} largest\n", n.median_overlap_over_r,
               n.max_overlap_over_r);
    for (const stage_time& s : n.stages)
        fmt::print("  {:<20}{:8} steps, {:.3f} s of model time, {}\n", s.name, s.steps, s.model_time,
                   time_text(s.wall_time));
    fmt::print("\nresults\n");
    for (const auto& [name, text] :
         {std::pair{"summary.json", "the numbers above and all inputs"},
          {"series.csv", "stress, strain, volume, energies: a row per sample"},
          {"events.csv", "a row per broken bond"},
          {prepared_file, "the specimen as prepared, for --from of other runs: other membrane, strength, stress"},
          {"packing.csv", "the grains as prepared, for --packing of other runs"},
          {"vtk/pebbles.pvd", "grains for ParaView"},
          {"vtk/boundary.pvd", "membrane and platens for ParaView"}})
        if (std::error_code none; fs::exists(folder_ / name, none))
            fmt::print("  {:<40} {}\n", (folder_ / name).string(), text);
    if (!report.pictures.empty())
        fmt::print("  {:<40} {} figures (.svg and .png) and their gnuplot scripts\n", (folder_ / "plots").string(),
                   report.pictures.size() / 2);
    if (facts.stopped_by) fmt::print("unfinished: {}\n", facts.stopped_by->what);
    for (const std::string& remark : remarks(n)) fmt::print("{}\n", remark);
    for (const clast::stage_record& s : facts.stages)
        if (!s.reached) fmt::print("note: {}: {}\n", s.name, s.end);
    for (const std::string& problem : report.problems) fmt::print("note: {}\n", problem);
}

} // namespace triaxial
