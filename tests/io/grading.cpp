// SPDX-License-Identifier: MIT
#include <clast/io/grading.hpp>

#include <string>

#include <catch.hpp>

#include "text_file.hpp"

using namespace clast;

namespace {
std::string refusal(const std::string& text) {
    const text_file file(text);
    try {
        (void)read_grading(file.path);
    } catch (const input_error& e) {
        return e.what();
    }
    return {};
}
void names(const std::string& text, const char* what) {
    INFO(text);
    CHECK(text.find("grading file ") == 0);
    CHECK(text.find(what) != std::string::npos);
}
} // namespace

TEST_CASE("a grading file: millimetres and percent, rising or falling, by blanks or commas") {
    const text_file rising("# of the dam\n5 0\n10 20 # comment\n40 100\n");
    const text_file falling("size_mm,finer_percent\n40,100\n10,20\n5,0\n");
    for (const text_file* file : {&rising, &falling}) {
        const grading g = read_grading(file->path);
        REQUIRE(g.curve().size() == 3);
        CHECK(g.smallest() == Approx(0.005));
        CHECK(g.largest() == Approx(0.04));
        CHECK(g.finer(0.01) == Approx(0.2));
    }
}

TEST_CASE("a grading file that cannot be read, or makes no curve, is refused with what and where") {
    names(refusal("5 0\n10\n40 100\n"), ":2: 1 of two numbers");
    names(refusal("5 0\n10 20 3\n"), ":2: more than two numbers");
    names(refusal("5 0%\n10 100\n"), ":1: '0%' is not a finite number");
    names(refusal("5 3\n10 100\n"), "from 3 % to 100 %");
    names(refusal("5 0\n10 60\n20 40\n30 100\n"), "20 mm, 40 % finer");
    names(refusal(""), "0 points");
    CHECK_THROWS_AS(read_grading("/no/such/file"), input_error);
}
