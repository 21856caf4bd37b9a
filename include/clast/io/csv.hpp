// SPDX-License-Identifier: MIT
// series.csv and events.csv. One table of {name, unit, member} per kind of row serves the header, the writer and the
// reader, so that they cannot disagree.
#pragma once

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <variant>
#include <vector>

#include <clast/core/errors.hpp>
#include <clast/io/detail/atomic_file.hpp>
#include <clast/measure/sample.hpp>

namespace clast {

/// A member of a row, as a column sees it.
using cell = std::variant<double*, std::int64_t*, std::int32_t*, std::string*, break_mode*>;

/// One column: its name, its unit (empty without dimension; then it is left out of the header) and its member.
template <class Row> struct column {
    const char* name;
    const char* unit;
    cell (*member)(Row&);

    /// The title in the file, e.g. "sigma_1_Pa".
    [[nodiscard]] std::string title() const { return *unit ? fmt::format("{}_{}", name, unit) : std::string(name); }
};

/// Columns of series.csv: one row per sample.
inline constexpr column<sample> series_columns[] = {
    {"time", "s", [](sample& r) -> cell { return &r.time; }},
    {"stage", "", [](sample& r) -> cell { return &r.stage; }},
    {"axial_strain", "", [](sample& r) -> cell { return &r.axial_strain; }},
    {"volumetric_strain", "", [](sample& r) -> cell { return &r.volumetric_strain; }},
    {"height", "m", [](sample& r) -> cell { return &r.height; }},
    {"volume", "m3", [](sample& r) -> cell { return &r.volume; }},
    {"sigma_1", "Pa", [](sample& r) -> cell { return &r.sigma_1; }},
    {"sigma_3", "Pa", [](sample& r) -> cell { return &r.sigma_3; }},
    {"p", "Pa", [](sample& r) -> cell { return &r.p; }},
    {"q", "Pa", [](sample& r) -> cell { return &r.q; }},
    {"q_contacts", "Pa", [](sample& r) -> cell { return &r.q_contacts; }},
    {"sigma_1_love_weber", "Pa", [](sample& r) -> cell { return &r.sigma_1_love_weber; }},
    {"sigma_3_love_weber", "Pa", [](sample& r) -> cell { return &r.sigma_3_love_weber; }},
    {"sigma_2", "Pa", [](sample& r) -> cell { return &r.sigma_2; }},
    {"pore_pressure", "Pa", [](sample& r) -> cell { return &r.pore_pressure; }},
    {"void_ratio", "", [](sample& r) -> cell { return &r.void_ratio; }},
    {"porosity", "", [](sample& r) -> cell { return &r.porosity; }},
    {"phi_mob", "deg", [](sample& r) -> cell { return &r.phi_mob_deg; }},
    {"inertial_number", "", [](sample& r) -> cell { return &r.inertial_number; }},
    {"unbalanced_ratio", "", [](sample& r) -> cell { return &r.unbalanced_ratio; }},
    {"confining_error", "", [](sample& r) -> cell { return &r.confining_error; }},
    {"confining_rms", "", [](sample& r) -> cell { return &r.confining_rms; }},
    {"median_overlap_over_r", "", [](sample& r) -> cell { return &r.median_overlap_over_r; }},
    {"max_overlap_over_r", "", [](sample& r) -> cell { return &r.max_overlap_over_r; }},
    {"kappa", "", [](sample& r) -> cell { return &r.kappa; }},
    {"coordination", "", [](sample& r) -> cell { return &r.coordination; }},
    {"replaced", "", [](sample& r) -> cell { return &r.replaced; }},
    {"broken_tension", "", [](sample& r) -> cell { return &r.broken_tension; }},
    {"broken_shear", "", [](sample& r) -> cell { return &r.broken_shear; }},
    {"hardin_Br", "", [](sample& r) -> cell { return &r.hardin_br; }},
    {"einav_B", "", [](sample& r) -> cell { return &r.einav_b; }},
    {"escaped", "", [](sample& r) -> cell { return &r.escaped; }},
    {"kinetic_energy", "J", [](sample& r) -> cell { return &r.kinetic_energy; }},
    {"elastic_energy", "J", [](sample& r) -> cell { return &r.elastic_energy; }},
    {"boundary_work", "J", [](sample& r) -> cell { return &r.boundary_work; }},
    {"friction_dissipation", "J", [](sample& r) -> cell { return &r.friction_dissipation; }},
    {"damping_dissipation", "J", [](sample& r) -> cell { return &r.damping_dissipation; }},
    {"bond_dissipation", "J", [](sample& r) -> cell { return &r.bond_dissipation; }},
    {"energy_residual", "", [](sample& r) -> cell { return &r.energy_residual; }},
    {"steps", "", [](sample& r) -> cell { return &r.steps; }},
    {"dt", "s", [](sample& r) -> cell { return &r.dt; }},
    {"wall_time", "s", [](sample& r) -> cell { return &r.wall_time; }},
};

/// Columns of events.csv: one row per broken bond.
inline constexpr column<fracture_event> event_columns[] = {
    {"time", "s", [](fracture_event& r) -> cell { return &r.time; }},
    {"stage", "", [](fracture_event& r) -> cell { return &r.stage; }},
    {"axial_strain", "", [](fracture_event& r) -> cell { return &r.axial_strain; }},
    {"mode", "", [](fracture_event& r) -> cell { return &r.mode; }},
    {"x", "m", [](fracture_event& r) -> cell { return &r.position.x; }},
    {"y", "m", [](fracture_event& r) -> cell { return &r.position.y; }},
    {"z", "m", [](fracture_event& r) -> cell { return &r.position.z; }},
    {"normal_x", "", [](fracture_event& r) -> cell { return &r.normal.x; }},
    {"normal_y", "", [](fracture_event& r) -> cell { return &r.normal.y; }},
    {"normal_z", "", [](fracture_event& r) -> cell { return &r.normal.z; }},
    {"mother", "", [](fracture_event& r) -> cell { return &r.mother; }},
    {"bond", "", [](fracture_event& r) -> cell { return &r.bond; }},
    {"normal_force", "N", [](fracture_event& r) -> cell { return &r.normal_force; }},
    {"shear_force", "N", [](fracture_event& r) -> cell { return &r.shear_force; }},
    {"bending_moment", "Nm", [](fracture_event& r) -> cell { return &r.bending_moment; }},
    {"twisting_moment", "Nm", [](fracture_event& r) -> cell { return &r.twisting_moment; }},
    {"energy", "J", [](fracture_event& r) -> cell { return &r.energy; }},
};

namespace detail {

/// The table of a kind of row.
template <class Row> constexpr std::span<const column<Row>> columns_of();
template <> constexpr std::span<const column<sample>> columns_of<sample>() { return series_columns; }
template <> constexpr std::span<const column<fracture_event>> columns_of<fracture_event>() { return event_columns; }

template <class Row> std::string csv_header() {
    std::string line;
    for (const column<Row>& c : columns_of<Row>()) line += (line.empty() ? "" : ",") + c.title();
    return line + '\n';
}

template <class Row> std::string csv_line(const Row& row) {
    std::string line;
    for (const column<Row>& c : columns_of<Row>()) {
        if (!line.empty()) line += ',';
        // the accessors also serve the reader, hence not const; nothing is written here
        std::visit(
            [&line]<class T>(T* value) {
                if constexpr (std::is_same_v<T, std::string>) {
                    if (value->find_first_of(",\"\n") == std::string::npos) {
                        line += *value;
                    } else {
                        line += '"';
                        for (const char ch : *value)
                            line += ch == '"' ? std::string("\"\"") : std::string(1, ch == '\n' ? ' ' : ch);
                        line += '"';
                    }
                } else if constexpr (std::is_same_v<T, break_mode>) {
                    line += *value == break_mode::tension ? "tension" : "shear";
                } else {
                    fmt::format_to(std::back_inserter(line), "{}",
                                   *value); // shortest text that reads back to the same bits
                }
            },
            c.member(const_cast<Row&>(row)));
    }
    return line + '\n';
}

/// Takes one cell off the front of a line.
inline std::string next_cell(std::string_view& line) {
    std::string text;
    bool quoted = false;
    std::size_t i = 0;
    for (; i < line.size() && (quoted || line[i] != ','); ++i) {
        if (line[i] != '"')
            text += line[i];
        else if (quoted && i + 1 < line.size() && line[i + 1] == '"')
            text += line[++i];
        else
            quoted = !quoted;
    }
    line.remove_prefix(std::min(i + 1, line.size()));
    return text;
}

inline bool read_cell(const std::string& text, const cell& target) {
    return std::visit(
        [&text]<class T>(T* value) {
            if constexpr (std::is_same_v<T, std::string>) {
                *value = text;
                return true;
            } else if constexpr (std::is_same_v<T, break_mode>) {
                *value = text == "shear" ? break_mode::shear : break_mode::tension;
                return text == "shear" || text == "tension";
            } else {
                const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *value);
                return error == std::errc{} && end == text.data() + text.size();
            }
        },
        target);
}

/// Calls keep(row) for every complete row in order until it says false; returns the offset after the last kept row.
template <class Row, class Keep>
std::size_t scan_table(const std::filesystem::path& path, const std::string& text, Keep&& keep) {
    const std::string header = csv_header<Row>();
    if (!text.starts_with(header))
        throw input_error(fmt::format("'{}' is not a table of this version of clast: its first line is not '{}'",
                                      path.string(), header.substr(0, header.size() - 1)));
    std::size_t offset = header.size();
    // a line without its end is what a crash left of a row
    for (std::size_t end; (end = text.find('\n', offset)) != std::string::npos; offset = end + 1) {
        std::string_view line = std::string_view(text).substr(offset, end - offset);
        Row row;
        for (const column<Row>& c : columns_of<Row>())
            if (const std::string value = next_cell(line); !read_cell(value, c.member(row)))
                throw input_error(
                    fmt::format("'{}': '{}' in column {} cannot be read", path.string(), value, c.title()));
        if (!keep(row)) break;
    }
    return offset;
}

} // namespace detail

/// All complete rows of a file that table_writer wrote. Throws input_error for a foreign or damaged file.
template <class Row> std::vector<Row> read_table(const std::filesystem::path& path) {
    std::vector<Row> rows;
    detail::scan_table<Row>(path, detail::read_whole(path), [&rows](Row& row) {
        rows.push_back(std::move(row));
        return true;
    });
    return rows;
}

/// Cuts a file back to its first `count` rows, so that a resumed run writes the later ones again: none is lost, none is
/// there twice. Returns the kept rows. Throws input_error where the file has fewer.
template <class Row> std::vector<Row> truncate_table(const std::filesystem::path& path, std::size_t count) {
    std::vector<Row> rows;
    const std::size_t size = detail::scan_table<Row>(path, detail::read_whole(path), [&](Row& row) {
        if (rows.size() == count) return false;
        rows.push_back(std::move(row));
        return true;
    });
    if (rows.size() < count)
        throw input_error(
            fmt::format("'{}' has lost rows: it has {}, the checkpoint says {}", path.string(), rows.size(), count));
    std::error_code error;
    std::filesystem::resize_file(path, size, error);
    if (error) throw detail::write_failed(path, error.value(), "while the file was cut back to the checkpoint");
    return rows;
}

/// Appends rows to a file and flushes each of them, so that a run can be watched and a crash loses at most one row.
/// Numbers are written with the shortest text that reads back to the same bits.
template <class Row> class table_writer {
  public:
    enum class mode { create, append };

    /// Creates the file with its header, or goes on at the end of an existing one. Throws run_error.
    explicit table_writer(const std::filesystem::path& path, mode how = mode::create)
        : path_(path), file_(std::fopen(path.c_str(), how == mode::create ? "wb" : "ab"), &std::fclose) {
        if (!file_) throw detail::write_failed(path_, errno, "while the file was opened");
        if (how == mode::create) put(detail::csv_header<Row>());
    }

    /// Writes one row. Throws run_error when it did not reach the file (full disk).
    void write(const Row& row) { put(detail::csv_line(row)); }

  private:
    void put(const std::string& line) {
        errno = 0;
        if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
            throw detail::write_failed(path_, errno, "rows that were written before are safe");
    }

    std::filesystem::path path_;
    detail::file_handle file_;
};

using series_writer = table_writer<sample>;
using event_writer = table_writer<fracture_event>;

} // namespace clast
