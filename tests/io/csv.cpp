// SPDX-License-Identifier: MIT
#include <clast/io/csv.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <catch.hpp>

using namespace clast;
namespace fs = std::filesystem;

namespace {

struct folder {
    fs::path path = fs::temp_directory_path() / fmt::format("clast_csv_test_{}", ::getpid());
    folder() { fs::create_directories(path); }
    ~folder() { fs::remove_all(path); }
    fs::path file() const { return path / "series.csv"; }
};

template <class Row> Row filled(int n) {
    Row row;
    int k = 0;
    for (const column<Row>& c : detail::columns_of<Row>())
        std::visit(
            [&]<class T>(T* value) {
                ++k;
                if constexpr (std::is_same_v<T, std::string>)
                    *value = fmt::format("stage {}", n);
                else if constexpr (std::is_same_v<T, break_mode>)
                    *value = n % 2 ? break_mode::shear : break_mode::tension;
                else if constexpr (std::is_same_v<T, double>)
                    *value = std::numbers::pi * k * std::pow(10.0, (n + k) % 20 - 10);
                else
                    *value = static_cast<T>(1000 * n + k);
            },
            c.member(row));
    return row;
}

template <class Row> void same(const Row& a, const Row& b) {
    for (const column<Row>& c : detail::columns_of<Row>())
        std::visit(
            [&]<class T>(T* x) {
                INFO(c.title());
                REQUIRE(*x == *std::get<T*>(c.member(const_cast<Row&>(b))));
            },
            c.member(const_cast<Row&>(a)));
}

} // namespace

TEST_CASE("every column has its own member and a title with its unit") {
    sample s;
    std::vector<const void*> members;
    for (const auto& c : series_columns) std::visit([&members](auto* m) { members.push_back(m); }, c.member(s));
    std::sort(members.begin(), members.end());
    REQUIRE(std::adjacent_find(members.begin(), members.end()) == members.end());
    const std::string header = detail::csv_header<sample>();
    REQUIRE(header.starts_with(
        "time_s,stage,axial_strain,volumetric_strain,height_m,volume_m3,sigma_1_Pa,sigma_3_Pa,p_Pa,q_Pa,"
        "q_contacts_Pa,sigma_1_love_weber_Pa,"));
    REQUIRE(header.ends_with(",steps,dt_s,wall_time_s\n"));
    // a new member of sample must get a column: 42 members, 41 of 8 bytes
    REQUIRE(sizeof(sample) == 41 * 8 + sizeof(std::string));
    REQUIRE(std::size(series_columns) == 42);
}

TEST_CASE("rows of both tables come back bit for bit") {
    const folder f;
    {
        series_writer w(f.file());
        for (int i = 0; i < 40; ++i) w.write(filled<sample>(i));
        event_writer e(f.path / "events.csv");
        for (int i = 0; i < 40; ++i) e.write(filled<fracture_event>(i));
    }
    const auto rows = read_table<sample>(f.file());
    const auto events = read_table<fracture_event>(f.path / "events.csv");
    REQUIRE(rows.size() == 40);
    REQUIRE(events.size() == 40);
    for (int i = 0; i < 40; ++i) {
        same(rows[static_cast<std::size_t>(i)], filled<sample>(i));
        same(events[static_cast<std::size_t>(i)], filled<fracture_event>(i));
    }
}

TEST_CASE("awkward numbers and names survive") {
    const folder f;
    sample s;
    s.stage = "shear, \"slow\"";
    s.q = std::numeric_limits<double>::quiet_NaN();
    s.p = -std::numeric_limits<double>::infinity();
    s.dt = 5e-324;
    s.steps = std::numeric_limits<std::int64_t>::max();
    series_writer(f.file()).write(s);
    const auto rows = read_table<sample>(f.file());
    REQUIRE(rows.size() == 1);
    REQUIRE(rows[0].stage == s.stage);
    REQUIRE(std::isnan(rows[0].q));
    REQUIRE(rows[0].p == s.p);
    REQUIRE(rows[0].dt == s.dt);
    REQUIRE(rows[0].steps == s.steps);
}

TEST_CASE("each row is in the file as soon as it was written") {
    const folder f;
    series_writer w(f.file());
    for (int i = 0; i < 3; ++i) {
        w.write(filled<sample>(i));
        REQUIRE(read_table<sample>(f.file()).size() == static_cast<std::size_t>(i + 1));
    }
}

TEST_CASE("a resumed table loses no row and doubles none") {
    const folder f;
    const auto row = [](std::int64_t i) {
        sample s = filled<sample>(static_cast<int>(i));
        s.steps = 100 * i;
        return s;
    };
    std::string uninterrupted;
    {
        series_writer w(f.file());
        for (int i = 0; i < 10; ++i) w.write(row(i));
        uninterrupted = detail::read_whole(f.file());
    }
    { // a crash in the middle of row 10, with the last checkpoint after row 6
        std::FILE* file = std::fopen(f.file().c_str(), "ab");
        std::fputs("1.25,shear,0.1", file);
        std::fclose(file);
    }
    const auto kept = truncate_table<sample>(f.file(), 7);
    REQUIRE(kept.size() == 7);
    REQUIRE(kept.back().steps == 600);
    REQUIRE_THROWS_AS(truncate_table<sample>(f.file(), 8), input_error); // rows were lost
    REQUIRE(read_table<sample>(f.file()).size() == 7);
    {
        series_writer w(f.file(), series_writer::mode::append);
        for (int i = 7; i < 10; ++i) w.write(row(i));
    }
    REQUIRE(detail::read_whole(f.file()) == uninterrupted);
    REQUIRE(truncate_table<sample>(f.file(), 0).empty());
    REQUIRE(detail::read_whole(f.file()) == detail::csv_header<sample>());
}

TEST_CASE("foreign and damaged tables are refused") {
    const folder f;
    REQUIRE_THROWS_AS(read_table<sample>(f.path / "missing.csv"), input_error);
    std::FILE* file = std::fopen(f.file().c_str(), "wb");
    std::fputs("a,b,c\n1,2,3\n", file);
    std::fclose(file);
    REQUIRE_THROWS_AS(read_table<sample>(f.file()), input_error);
    file = std::fopen(f.file().c_str(), "wb");
    std::fputs((detail::csv_header<sample>() + "0.1,shear,zero\n").c_str(), file);
    std::fclose(file);
    REQUIRE_THROWS_AS(read_table<sample>(f.file()), input_error);
}

TEST_CASE("a full disk is reported by the row that did not fit") {
    if (!fs::exists("/dev/full")) return;
    try {
        series_writer w("/dev/full");
        w.write(sample{});
        FAIL("nothing was thrown");
    } catch (const run_error& e) {
        REQUIRE(std::string(e.what()).find("the disk (or the quota) is full") != std::string::npos);
    }
    REQUIRE_THROWS_AS(series_writer("/nonexistent/series.csv"), run_error);
}
