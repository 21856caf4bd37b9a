// SPDX-License-Identifier: MIT
#include <clast/io/shapes.hpp>

#include <string>

#include <catch.hpp>

#include "text_file.hpp"

using namespace clast;

namespace {

std::string message_of(const std::string& text) {
    const text_file file(text);
    try {
        shapes::from_file(file.path);
    } catch (const input_error& error) {
        return error.what();
    }
    return "no error";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_CASE("a shape file gives the same shape as its pebbles") {
    const text_file file("# x y z r, in any unit when read by name\r\n\r\n-1 0\t0 1   # left\n  +1.0 0 0 1e0\n");
    const shape s = shapes::from_file(file.path);
    CHECK(s.pebbles.size() == 2);
    CHECK(s.bonds.size() == 1);
    CHECK(contains(file.path, s.name));
    CHECK(s.diameter == Approx(2.0 * std::cbrt(2.0)).epsilon(1e-15)); // of two balls of 1 m
    CHECK(s.circumscribed_radius == Approx(2.0).epsilon(1e-15));
    const shape scaled = shapes::by_name(file.path, circumscribed(0.02));
    CHECK(scaled.diameter == 0.02);
    CHECK(scaled.pebbles[0].radius == Approx(0.005).epsilon(1e-15));
}

TEST_CASE("a wrong shape file is refused with its line and what is wrong") {
    CHECK(contains(message_of("0 0 0 1\n0 0 1\n"), ":2: 3 of four numbers"));
    CHECK(contains(message_of("0 0 0 1 7\n"), ":1: more than four numbers"));
    CHECK(contains(message_of("# a\n0 0 zero 1\n"), ":2: 'zero' is not a finite number"));
    CHECK(contains(message_of("0 0 0 1mm\n"), "'1mm' is not a finite number"));
    CHECK(contains(message_of("0 0 inf 1\n"), "'inf' is not a finite number"));
    CHECK(contains(message_of("0 0 0 -1\n"), ":1: the radius -1 is not positive"));
    CHECK(contains(message_of("# nothing\n\n"), "there are no pebbles"));
    CHECK(contains(message_of("0 0 0 1\n\n1 0 0 1\n"), "pebbles 0 and 1 overlap by 1 m"));
    CHECK(contains(message_of("0 0 0 1\n\n1 0 0 1\n"), "on the lines 1, 3"));
    CHECK(contains(message_of("0 0 0 1\n2 0 0 1\n9 0 0 1\n"), "3 pebbles form 2 separate pieces"));
}

TEST_CASE("a shape is chosen by name, and an unknown name is refused with the choices") {
    CHECK(shapes::by_name("14B", circumscribed(0.02)).pebbles.size() == 14);
    CHECK(shapes::by_name("4B", circumscribed(0.02)).pebbles.size() == 4);
    CHECK(shapes::by_name("sphere", circumscribed(0.02)).pebbles.size() == 1);
    CHECK_THROWS_AS(shapes::by_name("15B", circumscribed(0.02)), input_error);
    try {
        shapes::by_name("15B", circumscribed(0.02));
    } catch (const input_error& error) {
        CHECK(contains(error.what(), "14B, 4B, sphere"));
    }
}

TEST_CASE("what to make of pebbles of a file that overlap is said when it is read") {
    const text_file file("0 0 0 1\n1 0 0 1\n");
    CHECK(shapes::by_name(file.path, circumscribed(0.02), overlaps::as_union).overlapping);
    CHECK_THROWS_AS(shapes::by_name(file.path, circumscribed(0.02)), input_error);
}
