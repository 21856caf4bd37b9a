// SPDX-License-Identifier: MIT
#include <clast/core/number_lines.hpp>

#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>

#include <catch.hpp>

using namespace clast;

namespace {
struct wrong_line : std::runtime_error {
    std::size_t line;
    wrong_line(std::size_t number, const std::string& what) : std::runtime_error(what), line(number) {}
};
std::vector<number_line> read(const std::string& text, std::size_t count, std::string_view title = {}) {
    std::istringstream file(text);
    return read_number_lines(
        file, count, [](std::size_t line, const std::string& what) { return wrong_line(line, what); }, title);
}
void refused(const std::string& text, std::size_t count, std::size_t line, const std::string& what) {
    try {
        (void)read(text, count, "title");
        FAIL("taken: " << text);
    } catch (const wrong_line& e) {
        CHECK(e.line == line);
        CHECK(e.what() == what);
    }
}
} // namespace

TEST_CASE("lines of numbers: blanks, tabs and commas part them, and comments, empty lines and the title are skipped") {
    const auto lines = read("title,of it\n# a\n1,2\r\n\n +3\t-4e-1 # b\n", 2, "title");
    REQUIRE(lines.size() == 2);
    CHECK((lines[0].line == 3 && lines[0].values == std::vector<double>{1.0, 2.0}));
    CHECK((lines[1].line == 5 && lines[1].values == std::vector<double>{3.0, -0.4}));
    CHECK(read("", 2).empty());
    CHECK(read("7", 1).size() == 1); // no end of line
}

TEST_CASE("what is not so many finite numbers is refused with its line") {
    refused("1 2\n1\n", 2, 2, "1 of two numbers");
    refused("1 2 3\n", 2, 1, "more than two numbers");
    refused("1 b\n", 2, 1, "'b' is not a finite number");
    refused("1 nan\n", 2, 1, "'nan' is not a finite number");
    refused("1 1e999\n", 2, 1, "'1e999' is not a finite number");
    refused("1 2\ntitle\n", 2, 2, "'title' is not a finite number"); // only the first line is one
}
