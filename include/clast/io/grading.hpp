// SPDX-License-Identifier: MIT
// Sieve curves from text files.
#pragma once

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/core/number_lines.hpp>
#include <clast/grains/grading.hpp>

namespace clast {

/// Grading from a text file: one sieve per line, `size finer`, its size (mm) and the percentage of the mass in smaller
/// grains, in the order of growing or of falling size; separators are blanks or commas, text after # is skipped, and a
/// first line `size_mm,finer_percent` is a title. Throws input_error with file and line for what cannot be read, and
/// where the curve makes no sense (grading).
inline grading read_grading(const std::string& path) {
    std::ifstream file(path);
    if (!file)
        throw input_error("grading", path, "the path of a readable text file with lines 'size finer' (mm, %)",
                          "Check the path.");
    std::vector<sieve> curve;
    const auto wrong = [&path](std::size_t line, const std::string& what) {
        return input_error(fmt::format("grading file {}:{}: {}. A line holds two numbers, the size (mm) and the "
                                       "percentage of the mass that is finer; text after # is a comment.",
                                       path, line, what));
    };
    for (const number_line& line : read_number_lines(file, 2, wrong, "size_mm"))
        curve.push_back({1e-3 * line.values[0], 0.01 * line.values[1]});
    if (curve.size() > 1 && curve.front().size > curve.back().size) std::reverse(curve.begin(), curve.end());
    try {
        return grading(std::move(curve));
    } catch (const input_error& e) {
        throw input_error(fmt::format("grading file {}: {}", path, e.what()));
    }
}

} // namespace clast
