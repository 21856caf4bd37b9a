// SPDX-License-Identifier: MIT
// Packings in files: where the grains of a specimen stand.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/core/number_lines.hpp>
#include <clast/grains/mixture.hpp>
#include <clast/io/csv.hpp>
#include <clast/protocol/packing.hpp>

namespace clast {

/// A grain as a row of packing.csv.
struct packing_row {
    vec3 x;            ///< mass centre (m)
    double d = 0.0;    ///< diameter of the circumscribed sphere (m)
    std::string shape; ///< its name
    quaternion q;      ///< turns the axes of the shape into those of the world
};

/// Columns of packing.csv: one row per grain.
inline constexpr column<packing_row> packing_columns[] = {
    {"x", "m", [](packing_row& r) -> cell { return &r.x.x; }},
    {"y", "m", [](packing_row& r) -> cell { return &r.x.y; }},
    {"z", "m", [](packing_row& r) -> cell { return &r.x.z; }},
    {"d", "m", [](packing_row& r) -> cell { return &r.d; }},
    {"shape", "", [](packing_row& r) -> cell { return &r.shape; }},
    {"qw", "", [](packing_row& r) -> cell { return &r.q.w; }},
    {"qx", "", [](packing_row& r) -> cell { return &r.q.x; }},
    {"qy", "", [](packing_row& r) -> cell { return &r.q.y; }},
    {"qz", "", [](packing_row& r) -> cell { return &r.q.z; }},
};
namespace detail {
template <> constexpr std::span<const column<packing_row>> columns_of<packing_row>() { return packing_columns; }

/// Grains from lines `x y z d`.
inline std::vector<placed_grain> read_bare_packing(const std::string& path, const std::string& text,
                                                   const mixture& of) {
    const auto wrong = [&path](std::size_t line, const std::string& what) {
        return input_error(
            fmt::format("packing file {}:{}: {}. A line holds four numbers, x y z d (m); or the first line "
                        "is '{}' and a row follows for each grain.",
                        path, line, what, csv_header<packing_row>().substr(0, csv_header<packing_row>().size() - 1)));
    };
    std::istringstream lines(text);
    std::vector<placed_grain> grains;
    const shape& form = of.parts().front().form;
    for (const number_line& line : read_number_lines(lines, 4, wrong)) {
        if (of.parts().size() > 1 || form.pebbles.size() > 1)
            throw wrong(line.line, "four numbers say nothing of shapes and orientations, which matter here");
        const std::vector<double>& v = line.values;
        if (!(v[3] > 0.0)) throw wrong(line.line, fmt::format("the diameter {} is not positive", v[3]));
        grains.push_back({{0, 0.5 * v[3] / form.circumscribed_radius}, {v[0], v[1], v[2]}, {}});
    }
    return grains;
}
} // namespace detail

/// Packing from a file for grains of a mixture: a table as write_packing makes it, in which shapes go by their names;
/// or, where all grains are single spheres, four numbers per line, `x y z d` (m). The middle of the specimen is at 0 0
/// 0, z is its axis. Throws input_error for what cannot be read, and where grains cannot stand (protocol::packing).
inline protocol::packing read_packing(const std::string& path, const mixture& of) {
    if (!std::ifstream(path))
        throw input_error("packing", path, "the path of a readable file: a table packing.csv, or lines 'x y z d' (m)",
                          "Check the path.");
    const std::string text = detail::read_whole(path);
    std::vector<placed_grain> grains;
    if (text.starts_with(detail::csv_header<packing_row>())) {
        std::string names;
        for (const mixture_part& p : of.parts()) names += (names.empty() ? "" : ", ") + p.form.name;
        detail::scan_table<packing_row>(path, text, [&](const packing_row& r) {
            std::size_t part = 0;
            while (part < of.parts().size() && of.parts()[part].form.name != r.shape) ++part;
            if (part == of.parts().size())
                throw input_error(fmt::format("packing file {}, grain {}", path, grains.size() + 1),
                                  fmt::format("shape '{}'", r.shape), names, "Add it to the shapes of the test.");
            grains.push_back({{part, 0.5 * r.d / of.parts()[part].form.circumscribed_radius}, r.x, r.q});
            return true;
        });
    } else {
        grains = detail::read_bare_packing(path, text, of);
    }
    if (grains.empty())
        throw input_error(fmt::format("packing file {}: there are no grains. Give one per line.", path));
    return {of, std::move(grains)};
}

/// Writes the grains of clumps as they stand to a table that read_packing takes; grains that have become balls stand
/// there as they were last whole. Throws run_error where the file cannot be written.
template <class Body> void write_packing(const std::filesystem::path& path, const Body& grains) {
    table_writer<packing_row> table(path);
    for (std::size_t g = 0; g < grains.grain_count(); ++g) {
        packing_row r{grains.centre(g), 2.0 * grains.bounding_radius(g), "sphere", {}};
        if constexpr (Body::turns) {
            r.shape = grains.shape_of(grains.grains[g]).name;
            r.q = grains.turning[g].q;
        }
        table.write(r);
    }
}

} // namespace clast
