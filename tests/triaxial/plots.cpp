// SPDX-License-Identifier: MIT
// The figures of examples/triaxial, compiled into this test.
#include "../../examples/triaxial/plots.cpp"
#include "../../examples/triaxial/render.cpp"

#include <cstdlib>

#include <catch.hpp>

using namespace clast;
using namespace triaxial;
namespace fs = std::filesystem;

namespace {

struct folder {
    fs::path path = fs::temp_directory_path() / fmt::format("clast_plots_test_{}", ::getpid());
    folder() { fs::create_directories(path); }
    ~folder() { fs::remove_all(path); }
};

fracture_event event_at(double degrees, break_mode mode) {
    fracture_event e;
    e.mode = mode;
    e.position = {0.05 * std::cos(degrees * std::numbers::pi / 180), 0.05 * std::sin(degrees * std::numbers::pi / 180),
                  0};
    return e;
}

// a ring of four tiles at distances r from the axis
std::vector<facet_view> ring(int index, double z0, double z1, std::array<double, 4> r) {
    std::vector<facet_view> f;
    const vec3 n[4] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    for (int t = 0; t < 4; ++t) {
        const auto k = static_cast<std::size_t>(t);
        const vec3 s{-n[t].y, n[t].x, 0}, up{0, 0, 1};
        const vec3 c = r[k] * n[t];
        f.push_back({{{c - 0.1 * s + z0 * up, c + 0.1 * s + z0 * up, c + 0.1 * s + z1 * up, c - 0.1 * s + z1 * up}},
                     1e6,
                     1,
                     index,
                     t});
    }
    return f;
}

std::array<int, 3> pixel(const raster& p, int i, int k) {
    std::array<int, 3> c{};
    for (std::size_t j = 0; j < 3; ++j)
        c[j] = static_cast<unsigned char>(p.bytes[3 * (static_cast<std::size_t>(k) * static_cast<std::size_t>(p.width) +
                                                       static_cast<std::size_t>(i)) +
                                                  j]);
    return c;
}

plot_request small_test(const fs::path& path) {
    plot_request request;
    request.series = path / "series.csv";
    request.events = path / "events.csv";
    series_writer series(request.series);
    for (int i = 0; i <= 20; ++i) {
        sample s;
        s.stage = "shear";
        s.axial_strain = 0.01 * i;
        s.q = 1e6 * (1 - std::exp(-0.5 * i));
        s.volumetric_strain = 1e-4 * i;
        s.broken_tension = i;
        series.write(s);
    }
    event_writer events(request.events);
    for (int i = 0; i < 20; ++i) events.write(event_at(17.0 * i, i % 3 ? break_mode::tension : break_mode::shear));
    for (int i = 0; i < 4; ++i)
        request.end.pebbles.push_back(
            {{0.1 * (i % 2), 0.0, 0.1 * i}, 0.05, i, i, static_cast<pebble_state>(i % 3), {}, {}});
    for (const facet_view& f : ring(0, 0, 0.4, {0.2, 0.2, 0.2, 0.2})) request.end.facets.push_back(f);
    request.end.axial_strain = 0.2;
    request.start = request.end;
    request.start.axial_strain = 0.0;
    return request;
}

} // namespace

TEST_CASE("the rosette counts fractures by the azimuth of their position") {
    const std::vector<fracture_event> events{event_at(5, break_mode::tension), event_at(9.9, break_mode::shear),
                                             event_at(10.1, break_mode::tension), event_at(-0.1, break_mode::tension),
                                             event_at(180.1, break_mode::shear)};
    const rosette r = make_rosette(events);
    REQUIRE(r.tension.size() == 36);
    REQUIRE(r.tension[0] == 1);
    REQUIRE(r.shear[0] == 1);
    REQUIRE(r.tension[1] == 1);
    REQUIRE(r.tension[35] == 1);
    REQUIRE(r.shear[18] == 1);
    REQUIRE(r.tension[4] == 0);
    REQUIRE(r.total() == 5);
}

TEST_CASE("the unevenness of a rosette is that beyond chance") {
    rosette even{std::vector<std::int64_t>(36, 100), std::vector<std::int64_t>(36, 0)};
    REQUIRE(even.unevenness() == Approx(-0.1).epsilon(1e-12)); // less than chance
    rosette two{std::vector<std::int64_t>{400, 0}, std::vector<std::int64_t>{0, 0}};
    REQUIRE(two.unevenness() == Approx(1.0 - 1.0 / std::sqrt(200.0)).epsilon(1e-12));
    REQUIRE(rosette{{0, 0}, {0, 0}}.unevenness() == 0.0);
}

TEST_CASE("the membrane profile has the radii of each ring and leaves platens out") {
    std::vector<facet_view> facets = ring(1, 0.2, 0.4, {0.3, 0.32, 0.34, 0.36});
    for (const auto& f : ring(0, 0.0, 0.2, {0.3, 0.3, 0.3, 0.3})) facets.push_back(f);
    facets.push_back({{{{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}}, 1e6, 1, -1, -1});
    const auto profile = membrane_profile(facets);
    REQUIRE(profile.size() == 4);
    REQUIRE(profile[0].mean == Approx(0.3).epsilon(1e-14));
    REQUIRE(profile[2].height == 0.2);
    REQUIRE(profile[3].height == 0.4);
    for (const std::size_t k : {2U, 3U}) { // of one ring: upright facets
        REQUIRE(profile[k].smallest == Approx(0.3).epsilon(1e-14));
        REQUIRE(profile[k].largest == Approx(0.36).epsilon(1e-14));
        REQUIRE(profile[k].mean == Approx(0.33).epsilon(1e-14));
        REQUIRE(profile[k].right == Approx(0.3).epsilon(1e-14));
        REQUIRE(profile[k].left == Approx(-0.34).epsilon(1e-14));
    }
    REQUIRE(membrane_profile({}).empty());
}

TEST_CASE("the picture shows the nearer sphere in the colour of its state") {
    const std::vector<pebble_view> two{{{0, 0.3, 0}, 0.3, 0, 0, pebble_state::clump, {}, {}},
                                       {{0, -0.3, 0}, 0.15, 1, 1, pebble_state::bonded, {}, {}}};
    const auto picture = render_side(two, {-0.5, 0.5, -0.5, 0.5}, 100);
    REQUIRE(picture.width == 100);
    REQUIRE(picture.bytes.size() == 30000);
    REQUIRE(pixel(picture, 2, 2) == std::array<int, 3>{255, 255, 255});
    const auto near = pixel(picture, 50, 50), behind = pixel(picture, 50, 72);
    REQUIRE(near[2] > near[0]);                                           // teal
    REQUIRE(behind[0] > behind[2]);                                       // sandstone
    REQUIRE(pixel(picture, 50, 82) == std::array<int, 3>{255, 255, 255}); // beyond the radius 0.3
    int covered = 0;
    for (int i = 0; i < 100; ++i) covered += pixel(picture, i, 50) != std::array<int, 3>{255, 255, 255};
    REQUIRE(covered == 60);
}

TEST_CASE("a pebble that is not finite does not stop the picture") {
    const std::vector<pebble_view> odd{{{std::nan(""), 0, 0}, 0.3, 0, 0, pebble_state::clump, {}, {}},
                                       {{1e30, 0, 0}, 0.3, 1, 1, pebble_state::clump, {}, {}}};
    REQUIRE(pixel(render_side(odd, {-0.5, 0.5, -0.5, 0.5}, 20), 10, 10) == std::array<int, 3>{255, 255, 255});
}

TEST_CASE("a cut through a sphere is a circle of the right radius") {
    const std::vector<pebble_view> one{{{0.1, 0.03, 0.2}, 0.05, 0, 0, pebble_state::clump, {}, {}}};
    REQUIRE(section_circles(one, 1, 0.0, 0.01) == "10,20,4,2956830\n10,20,3,13219996\n"); // rim, then fill; 5-4-3
    REQUIRE(section_circles(one, 1, 0.09, 0.01) == "NaN,NaN,NaN,0\n");
    REQUIRE(section_circles(one, 2, 0.2, 0.0).starts_with("10,3,5,"));
}

TEST_CASE("a cut through a ring of tiles is a segment per tile") {
    const auto text = section_wall(ring(0, 0.0, 0.4, {0.3, 0.3, 0.3, 0.3}), 2, 0.1);
    REQUIRE(std::count(text.begin(), text.end(), '\n') == 12);
    REQUIRE(text.find("30,10") != std::string::npos);
    REQUIRE(section_wall(ring(0, 0.0, 0.4, {0.3, 0.3, 0.3, 0.3}), 2, 0.5) == "NaN,NaN\n");
}

TEST_CASE("all figures are drawn and their scripts stay") {
    const folder f;
    const plot_report report = draw_plots(f.path / "plots", small_test(f.path));
    for (const char* figure : {"stress", "volume", "fractures", "rosette", "membrane", "specimen", "section"})
        REQUIRE(fs::exists(f.path / "plots" / (std::string(figure) + ".gp")));
    if (run_gnuplot(f.path, "/dev/null") == 127) {
        WARN("gnuplot is missing: pictures were not tested");
        return;
    }
    REQUIRE(report.problems == std::vector<std::string>{});
    REQUIRE(report.pictures.size() == 14);
    for (const auto& p : report.pictures) REQUIRE(fs::file_size(p) > 2000);
}

TEST_CASE("figures of an unfinished run are marked") {
    const folder f;
    plot_request request = small_test(f.path);
    draw_plots(f.path / "plots", request);
    REQUIRE(clast::detail::read_whole(f.path / "plots" / "style.gp").find("unfinished") == std::string::npos);
    request.mark = "unfinished";
    REQUIRE(draw_plots(f.path / "plots", request).problems.empty());
    REQUIRE(clast::detail::read_whole(f.path / "plots" / "style.gp").find("\"unfinished\"") != std::string::npos);
}

TEST_CASE("a missing gnuplot is said and does not stop the run") {
    const folder f;
    const char* old = std::getenv("PATH");
    const std::string path = old ? old : "";
    ::setenv("PATH", f.path.c_str(), 1);
    const plot_report report = draw_plots(f.path / "plots", small_test(f.path));
    ::setenv("PATH", path.c_str(), 1);
    REQUIRE(report.pictures.empty());
    REQUIRE(report.problems.size() == 1);
    REQUIRE(report.problems[0].find("gnuplot is not installed") != std::string::npos);
    REQUIRE(report.problems[0].find("apt install gnuplot-nox") != std::string::npos);
    REQUIRE(fs::exists(f.path / "plots" / "section.gp")); // can be drawn later
}

TEST_CASE("a test without shear, fractures or views draws what there is") {
    const folder f;
    plot_request request;
    request.series = f.path / "series.csv";
    request.events = f.path / "events.csv";
    {
        series_writer{request.series};
        event_writer{request.events};
    }
    REQUIRE(draw_plots(f.path / "plots", request).problems.empty());
    REQUIRE(!fs::exists(f.path / "plots" / "stress.gp"));
}
