// SPDX-License-Identifier: MIT
// Text files of numbers: so many in a line, with comments.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/core.h>

namespace clast {

/// A line of a file that holds numbers, and which one it is.
struct number_line {
    std::size_t line = 0; ///< from 1
    std::vector<double> values;
};

/// The lines of a text that hold `count` numbers (at most 9); separators are blanks, tabs and commas; blank lines and
/// text after # are skipped, and so is a first line that is `title`. wrong(line, what) makes the exception that is
/// thrown for anything else.
template <class Wrong>
std::vector<number_line> read_number_lines(std::istream& file, std::size_t count, Wrong&& wrong,
                                           std::string_view title = {}) {
    static constexpr const char* words[] = {"no",   "one", "two",   "three", "four",
                                            "five", "six", "seven", "eight", "nine"};
    std::vector<number_line> all;
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        constexpr std::string_view between = " \t\r\v\f,";
        std::string_view rest(line);
        rest = rest.substr(0, rest.find('#'));
        if (number == 1 && !title.empty() && rest.starts_with(title)) continue;
        number_line found{number, {}};
        while (true) {
            const std::size_t begin = rest.find_first_not_of(between);
            if (begin == std::string_view::npos) break;
            rest.remove_prefix(begin);
            const std::string_view word = rest.substr(0, rest.find_first_of(between));
            rest.remove_prefix(word.size());
            const char* first = word.data();
            const char* last = word.data() + word.size();
            if (word.size() > 1 && word[0] == '+') ++first; // from_chars knows no plus sign
            double x = 0.0;
            const auto [end, error] = std::from_chars(first, last, x);
            if (error != std::errc{} || end != last || !std::isfinite(x))
                throw wrong(number, fmt::format("'{}' is not a finite number", word));
            if (found.values.size() == count) throw wrong(number, fmt::format("more than {} numbers", words[count]));
            found.values.push_back(x);
        }
        if (found.values.empty()) continue;
        if (found.values.size() < count)
            throw wrong(number, fmt::format("{} of {} numbers", found.values.size(), words[count]));
        all.push_back(std::move(found));
    }
    if (file.bad()) throw wrong(1, "the file cannot be read");
    return all;
}

} // namespace clast
