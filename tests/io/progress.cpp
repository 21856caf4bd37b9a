// SPDX-License-Identifier: MIT
#include <clast/io/progress.hpp>

#include <memory>

#include <catch.hpp>

using namespace clast;

namespace {

std::string content(std::FILE* file) {
    std::fflush(file);
    std::rewind(file);
    std::string text;
    for (int c; (c = std::fgetc(file)) != EOF;) text += static_cast<char>(c);
    return text;
}
bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }
using file = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

} // namespace

TEST_CASE("the time left follows from the part done since the start") {
    REQUIRE(time_left(0.0, 0.25, 30.0) == Approx(90.0).epsilon(1e-14));
    REQUIRE(time_left(0.5, 0.75, 30.0) == Approx(30.0).epsilon(1e-14)); // resumed at one half
    REQUIRE(time_left(0.0, 1.0, 30.0) == 0.0);
    REQUIRE(time_left(0.0, 0.0, 30.0) < 0.0);
    REQUIRE(time_left(0.3, 0.2, 30.0) < 0.0);
}

TEST_CASE("times and bars are drawn to the second and to the eighth of a character") {
    REQUIRE(detail::clock_text(0) == "0:00");
    REQUIRE(detail::clock_text(65.4) == "1:05");
    REQUIRE(detail::clock_text(59.6) == "1:00");
    REQUIRE(detail::clock_text(7389) == "2:03:09");
    REQUIRE(detail::clock_text(-1) == "--:--");
    REQUIRE(detail::clock_text(std::nan("")) == "--:--");
    REQUIRE(detail::bar_text(0.5, 4, false) == "##..");
    REQUIRE(detail::bar_text(0.0, 4, true) == "    ");
    REQUIRE(detail::bar_text(1.0, 4, true) == "████");
    REQUIRE(detail::bar_text(0.5 + 1.0 / 32, 4, true) == "██▏ ");
    REQUIRE(detail::bar_text(7.0, 4, false) == "####");
    REQUIRE(detail::bar_text(std::nan(""), 4, false) == "....");
}

TEST_CASE("a line names stage, measure, stress, speed and time left") {
    const progress_state s{"shear", 0.492, -1, "eps_a 12.3 %", 3.456e6, 1000};
    REQUIRE(progress_line(s, 61, 12345, 63, 0, false) ==
            "shear         49 %  eps_a 12.3 %  q 3.46 MPa  12.3k steps/s  1:01  ETA 1:03");
    REQUIRE(has(progress_line(s, 61, 950, -1, 10, false), "shear        [####......]  49 %"));
    REQUIRE(has(progress_line(s, 61, 950, -1, 10, false), "950 steps/s  1:01  ETA --:--"));
}

TEST_CASE("a file gets plain lines, one for each stage at once and then one in ten seconds") {
    const file f(std::tmpfile(), &std::fclose);
    {
        progress p(false, f.get());
        for (int i = 0; i < 1000; ++i) p.update({"pack", 0.001 * i, -1, "", 0, i});
        for (int i = 0; i < 1000; ++i) p.update({"shear", 0.001 * i, -1, "eps_a 1 %", 1e6, i});
        p.note("checkpoint written");
    }
    const std::string text = content(f.get());
    REQUIRE(std::count(text.begin(), text.end(), '\n') == 3);
    REQUIRE(text.find('\r') == std::string::npos);
    REQUIRE(text.find('\x1b') == std::string::npos);
    REQUIRE(has(text, "pack "));
    REQUIRE(has(text, "eps_a 1 %"));
    REQUIRE(has(text, "\ncheckpoint written\n"));
}

TEST_CASE("quiet is quiet") {
    const file f(std::tmpfile(), &std::fclose);
    {
        progress p(true, f.get());
        p.update({"pack", 0.5, -1, "", 0, 1});
        p.note("checkpoint written");
    }
    REQUIRE(content(f.get()).empty());
}
