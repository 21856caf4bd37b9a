// SPDX-License-Identifier: MIT
// Shapes of grains from text files, and by their names on a command line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/core/number_lines.hpp>
#include <clast/grains/overlapping_shape.hpp>
#include <clast/grains/shape.hpp>

namespace clast::shapes {

/// Shape from a text file: one pebble per line, `x y z r` (m, any frame), blank lines and text after # are skipped. The
/// name is the file name without directory and extension. Throws input_error with file and line for what is wrong, and
/// if the pebbles overlap (unless `how` says what to make of that) or do not hold together (their bonds must form one
/// piece).
inline shape from_file(const std::string& path, overlaps how = overlaps::refuse) {
    const auto wrong = [&path](std::size_t line, const std::string& what) {
        return input_error(fmt::format("shape file {}:{}: {}. A line holds four numbers, x y z r (m), with r > 0; text "
                                       "after # is a comment.",
                                       path, line, what));
    };
    std::ifstream file(path);
    if (!file)
        throw input_error("shape", path, "14B, 4B, sphere or the path of a readable text file with lines 'x y z r'",
                          "Check the name or path.");
    std::vector<shape_pebble> pebbles;
    std::vector<std::size_t> line_of;
    for (const number_line& line : read_number_lines(file, 4, wrong)) {
        const std::vector<double>& v = line.values;
        if (!(v[3] > 0.0)) throw wrong(line.line, fmt::format("the radius {} is not positive", v[3]));
        pebbles.push_back({{v[0], v[1], v[2]}, v[3]});
        line_of.push_back(line.line);
    }
    if (pebbles.empty()) throw wrong(1, "there are no pebbles");

    const std::size_t slash = path.find_last_of("/\\");
    std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
    if (const std::size_t dot = name.find_last_of('.'); dot != std::string::npos && dot > 0) name.resize(dot);

    shape s;
    try {
        s = overlapping_shape(std::move(name), std::move(pebbles), how);
    } catch (const input_error& error) {
        std::string lines; // pebble numbers in that message count from 0 in the order of the file
        for (std::size_t i = 0; i < std::min<std::size_t>(line_of.size(), 100); ++i)
            lines += fmt::format("{}{}", i == 0 ? "" : ", ", line_of[i]);
        throw input_error(
            fmt::format("shape file {}: {} (pebbles 0, 1, ... are on the lines {})", path, error.what(), lines));
    }
    if (const int n = pieces(s); n > 1 && !s.overlapping)
        throw input_error(
            fmt::format("shape file {}: the {} pebbles form {} separate pieces. Allowed: one piece, every pebble "
                        "bonded to another through gaps below 1e-3 of the smallest radius. Close the gaps.",
                        path, s.pebbles.size(), n));
    return s;
}

/// Shape by its name on a command line: 14B, 4B, sphere, or the path of a file (see from_file), scaled to a
/// nominal size; how: what to make of pebbles of a file that overlap. Throws input_error for an unknown
/// name or a wrong file.
inline shape by_name(const std::string& text, grain_size size, overlaps how = overlaps::refuse) {
    if (text == "14B" || text == "14b") return apollonian_14(size);
    if (text == "4B" || text == "4b") return tetrahedron_4(size);
    if (text == "sphere") return sphere(size);
    detail::check_diameter(size.diameter);
    return scaled_to(from_file(text, how), size);
}

} // namespace clast::shapes
