// SPDX-License-Identifier: MIT
#include "plots.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <clast/core/vector.hpp>
#include <clast/io/csv.hpp>
#include <clast/io/detail/atomic_file.hpp>

#include "plot_scripts.hpp"
#include "render.hpp"

namespace triaxial {

using clast::facet_view;
using clast::fracture_event;
using clast::pebble_state;
using clast::pebble_view;
using clast::sample;
using clast::vec3;

std::int64_t rosette::total() const {
    std::int64_t n = 0;
    for (std::size_t i = 0; i < tension.size(); ++i) n += tension[i] + shear[i];
    return n;
}

double rosette::unevenness() const {
    const double sectors = static_cast<double>(tension.size());
    const double mean = static_cast<double>(total()) / sectors;
    if (mean <= 0.0) return 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < tension.size(); ++i)
        square += std::pow(static_cast<double>(tension[i] + shear[i]) - mean, 2) / sectors;
    return std::sqrt(square) / mean - 1.0 / std::sqrt(mean);
}

rosette make_rosette(std::span<const fracture_event> events, int sectors) {
    rosette r{std::vector<std::int64_t>(static_cast<std::size_t>(sectors)),
              std::vector<std::int64_t>(static_cast<std::size_t>(sectors))};
    for (const fracture_event& e : events) {
        double turn = std::atan2(e.position.y, e.position.x) / (2.0 * std::numbers::pi);
        if (turn < 0.0) turn += 1.0;
        const auto i = static_cast<std::size_t>(std::clamp(static_cast<int>(turn * sectors), 0, sectors - 1));
        ++(e.mode == clast::break_mode::tension ? r.tension : r.shear)[i];
    }
    return r;
}

std::vector<edge_profile> membrane_profile(std::span<const facet_view> facets) {
    constexpr double huge = std::numeric_limits<double>::max();
    struct ring {
        std::array<edge_profile, 2> edge{{{0.0, huge, 0.0, -huge, huge, -huge}, {0.0, huge, 0.0, -huge, huge, -huge}}};
        double facets = 0.0;
    };
    std::map<std::int32_t, ring> rings;
    for (const facet_view& f : facets) {
        if (f.ring < 0) continue;
        ring& r = rings[f.ring];
        r.facets += 1.0;
        for (std::size_t k = 0; k < 2; ++k) { // corners go round: the first two are below
            const vec3 &one = f.corner[2 * k], &two = f.corner[2 * k + 1], middle = 0.5 * (one + two);
            edge_profile& e = r.edge[k];
            const double radius = std::hypot(middle.x, middle.y);
            e.height += middle.z, e.mean += radius;
            e.smallest = std::min(e.smallest, radius), e.largest = std::max(e.largest, radius);
            e.left = std::min({e.left, one.x, two.x}), e.right = std::max({e.right, one.x, two.x});
        }
    }
    std::vector<edge_profile> profile;
    for (auto& [number, r] : rings)
        for (edge_profile& e : r.edge) {
            e.height /= r.facets, e.mean /= r.facets;
            profile.push_back(e);
        }
    return profile;
}

namespace {

/// Replaces every @name@ in a script.
std::string fill_in(std::string text, std::initializer_list<std::pair<std::string_view, std::string>> values) {
    for (const auto& [name, value] : values) {
        const std::string mark = "@" + std::string(name) + "@";
        for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += value.size())
            text.replace(at, mark.size(), value);
    }
    return text;
}

/// Runs `gnuplot script` in a folder, messages into gnuplot.log there. Returns its exit code, 127 where it is missing.
int run_gnuplot(const std::filesystem::path& folder, const std::string& script) {
    const pid_t child = ::fork();
    if (child < 0) return 126;
    if (child == 0) {
        if (::chdir(folder.c_str()) != 0) ::_exit(126);
        const int log = ::open("gnuplot.log", O_WRONLY | O_CREAT | O_APPEND, 0644);
        const int nothing = ::open("/dev/null", O_RDONLY);
        if (log >= 0) ::dup2(log, 1), ::dup2(log, 2);
        if (nothing >= 0) ::dup2(nothing, 0);
        ::execlp("gnuplot", "gnuplot", script.c_str(), static_cast<char*>(nullptr));
        ::_exit(127);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return 126;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 126;
}

std::string hex(const rgb& c) {
    return fmt::format("#{:02x}{:02x}{:02x}", static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2]));
}

/// Writes a figure's script and data and draws it; collects what went wrong.
class plot_folder {
  public:
    plot_folder(std::filesystem::path folder, plot_report& report, const std::string& mark)
        : folder_(std::move(folder)), report_(report) {
        std::filesystem::create_directories(folder_ / "data");
        std::error_code none;
        std::filesystem::remove(folder_ / "gnuplot.log", none);
        std::string style(style_script);
        if (!mark.empty())
            style += fmt::format(
                "set label 9001 \"{}\" at screen 0.985, screen 0.975 right front noenhanced textcolor rgb red\n", mark);
        clast::detail::replace_file(folder_ / "style.gp", {style});
    }

    void data(const std::string& name, const std::string& content) const {
        clast::detail::replace_file(folder_ / "data" / name, {content});
    }

    void draw(const std::string& figure, const std::string& script) {
        clast::detail::replace_file(folder_ / (figure + ".gp"), {script});
        if (missing_) return;
        const int code = run_gnuplot(folder_, figure + ".gp");
        if (code == 127) {
            missing_ = true;
            report_.problems.push_back(
                "gnuplot is not installed, so no pictures were drawn (Debian: apt install gnuplot-nox). "
                "Then redraw with: cd '" +
                folder_.string() + "' && for f in *.gp; do gnuplot $f; done");
            return;
        }
        for (const char* kind : {".svg", ".png"}) {
            std::error_code error;
            const auto picture = folder_ / (figure + kind);
            if (code == 0 && std::filesystem::file_size(picture, error) > 0 && !error)
                report_.pictures.push_back(picture);
            else if (std::string(kind) == ".svg")
                report_.problems.push_back(
                    fmt::format("gnuplot could not draw '{}' (exit code {}); its message is in '{}'", figure, code,
                                (folder_ / "gnuplot.log").string()));
        }
    }

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

  private:
    std::filesystem::path folder_;
    plot_report& report_;
    bool missing_ = false;
};

/// A closed polygon "x,z" per line in cm that follows both sides of each ring, so that a step shows as the step it is.
std::string outline(const std::vector<edge_profile>& edges, double edge_profile::*left, double edge_profile::*right) {
    std::string text;
    const auto point = [&text](double x, double z) {
        fmt::format_to(std::back_inserter(text), "{:.5g},{:.5g}\n", 100 * x, 100 * z);
    };
    for (const edge_profile& e : edges) point(e.*left, e.height);
    for (auto e = edges.rbegin(); e != edges.rend(); ++e) point((*e).*right, e->height);
    if (!edges.empty()) point(edges.front().*left, edges.front().height);
    return text;
}
std::string line_through(const std::vector<edge_profile>& edges, double edge_profile::*x) {
    std::string text;
    for (const edge_profile& e : edges)
        fmt::format_to(std::back_inserter(text), "{:.5g},{:.5g}\n", 100 * e.*x, 100 * e.height);
    return text;
}

void draw_membrane(plot_folder& plots, const plot_request& request) {
    std::string bands, outlines;
    double r0 = std::numeric_limits<double>::max(), r1 = 0.0, z0 = r0, z1 = -r0, half = 0.0;
    const auto add = [&](const specimen_view& view, const std::string& name, const char* colour) {
        const auto rings = membrane_profile(view.facets);
        if (rings.empty()) return;
        for (const edge_profile& r : rings) {
            r0 = std::min(r0, r.smallest), r1 = std::max(r1, r.largest);
            z0 = std::min(z0, r.height), z1 = std::max(z1, r.height);
            half = std::max({half, -r.left, r.right});
        }
        plots.data("membrane_band_" + name + ".csv", outline(rings, &edge_profile::smallest, &edge_profile::largest));
        plots.data("membrane_mean_" + name + ".csv", line_through(rings, &edge_profile::mean));
        plots.data("membrane_outline_" + name + ".csv", outline(rings, &edge_profile::left, &edge_profile::right));
        const std::string title = fmt::format("ε_a = {:.1f} %", 100.0 * view.axial_strain);
        bands += fmt::format(
            "{0}\"data/membrane_band_{1}.csv\" using 1:2 with filledcurves closed linecolor rgb {2} notitle, "
            "\"data/membrane_mean_{1}.csv\" using 1:2 with lines linewidth 1.8 linecolor rgb {2} title \"{3}\"",
            bands.empty() ? "" : ", ", name, colour, title);
        outlines += fmt::format(
            "{0}\"data/membrane_outline_{1}.csv\" using 1:2 with filledcurves closed fillstyle solid 0.10 noborder "
            "linecolor rgb {2} notitle, "
            "\"data/membrane_outline_{1}.csv\" using 1:2 with lines linewidth 1.5 linecolor rgb {2} notitle",
            outlines.empty() ? "" : ", ", name, colour);
    };
    add(request.start, "start", "grey");
    add(request.end, "end", "red");
    if (bands.empty()) return;
    const double margin = std::max(0.25 * (r1 - r0), 0.02 * r1);
    const double space = 0.03 * (z1 - z0);
    const auto cm = [](double x) { return fmt::format("{:.4g}", 100.0 * x); };
    plots.draw("membrane", fill_in(std::string(membrane_script), {{"BANDS", bands},
                                                                  {"OUTLINES", outlines},
                                                                  {"R0", cm(r0 - margin)},
                                                                  {"R1", cm(r1 + margin)},
                                                                  {"Z0", cm(z0 - space)},
                                                                  {"Z1", cm(z1 + space)},
                                                                  {"HALF", cm(1.1 * half)}}));
}

void draw_rosette(plot_folder& plots, const std::vector<fracture_event>& events) {
    const rosette r = make_rosette(events);
    const std::size_t sectors = r.tension.size();
    std::int64_t most = 0;
    for (std::size_t i = 0; i < sectors; ++i) most = std::max(most, r.tension[i] + r.shear[i]);
    if (most == 0) return;
    // round circles: 1, 2 or 5 times a power of ten, about three of them
    double step = std::pow(10.0, std::floor(std::log10(static_cast<double>(most) / 3.0)));
    for (const double factor : {2.0, 2.5, 2.0})
        if (static_cast<double>(most) / step > 4.0) step *= factor;
    step = std::max(step, 1.0);
    const double reach = step * std::ceil(static_cast<double>(most) / step);

    const double width = 2.0 * std::numbers::pi / static_cast<double>(sectors);
    const auto wedge = [&](std::size_t i, double inner, double outer) {
        std::string text;
        for (int k = 0; k <= 8; ++k) {
            const double a = width * (static_cast<double>(i) + k / 8.0);
            fmt::format_to(std::back_inserter(text), "{:.6g},{:.6g}\n", outer * std::cos(a), outer * std::sin(a));
        }
        for (int k = 8; k >= 0; --k) {
            const double a = width * (static_cast<double>(i) + k / 8.0);
            fmt::format_to(std::back_inserter(text), "{:.6g},{:.6g}\n", inner * std::cos(a), inner * std::sin(a));
        }
        return text + "\n";
    };
    std::string tension, shear, rings, labels;
    for (std::size_t i = 0; i < sectors; ++i) {
        const auto t = static_cast<double>(r.tension[i]), s = static_cast<double>(r.shear[i]);
        if (t > 0) tension += wedge(i, 0.0, t);
        if (s > 0) shear += wedge(i, t, t + s);
    }
    for (double c = step; c <= reach * 1.0001; c += step) {
        for (int k = 0; k <= 180; ++k)
            fmt::format_to(std::back_inserter(rings), "{:.6g},{:.6g}\n", c * std::cos(k * std::numbers::pi / 90),
                           c * std::sin(k * std::numbers::pi / 90));
        rings += "\n";
        labels +=
            fmt::format("set label \"{0:g}\" at {1:.6g},{2:.6g} center front textcolor rgb grey font \",10\"\n    ", c,
                        c * std::cos(width * 1.5), c * std::sin(width * 1.5) + 0.025 * reach);
    }
    for (int k = 0; k < 12; ++k) {
        const double a = k * std::numbers::pi / 6;
        fmt::format_to(std::back_inserter(rings), "0,0\n{:.6g},{:.6g}\n\n", reach * std::cos(a), reach * std::sin(a));
        labels += fmt::format("set label \"{}°\" at {:.6g},{:.6g} center textcolor rgb dark font \",11\"\n    ", 30 * k,
                              1.08 * reach * std::cos(a), 1.08 * reach * std::sin(a));
    }
    if (shear.empty()) shear = "NaN,NaN\n";
    if (tension.empty()) tension = "NaN,NaN\n";
    plots.data("rosette_tension.csv", tension);
    plots.data("rosette_shear.csv", shear);
    plots.data("rosette_rings.csv", rings);
    plots.draw("rosette",
               fill_in(std::string(rosette_script), {{"REACH", fmt::format("{:.6g}", 1.15 * reach)},
                                                     {"CIRCLES", labels},
                                                     {"CAPTION", fmt::format("n = {}; unevenness beyond chance {:.2f}",
                                                                             r.total(), r.unevenness())}}));
}

/// The rectangle that holds all views, with a margin (m).
std::optional<window> common_window(std::initializer_list<const specimen_view*> views) {
    constexpr double huge = std::numeric_limits<double>::max();
    window w{huge, -huge, huge, -huge};
    const auto include = [&w](const vec3& p, double r) {
        w.x0 = std::min({w.x0, p.x - r, p.y - r}), w.x1 = std::max({w.x1, p.x + r, p.y + r});
        w.z0 = std::min(w.z0, p.z - r), w.z1 = std::max(w.z1, p.z + r);
    };
    for (const specimen_view* view : views) {
        for (const pebble_view& p : view->pebbles)
            if (is_finite(p.position)) include(p.position, p.radius);
        for (const facet_view& f : view->facets)
            if (f.ring >= 0) // platens reach far beyond the specimen
                for (const vec3& c : f.corner) include(c, 0.0);
    }
    if (w.x1 <= w.x0 || w.z1 <= w.z0) return std::nullopt;
    const double half = std::max(-w.x0, w.x1) * 1.04;
    const double space = 0.02 * (w.z1 - w.z0);
    return window{-half, half, w.z0 - space, w.z1 + space};
}

/// The row at the bottom of a page (in points) that names the colours.
std::string legend(double page_w, double page_h) {
    // a key of gnuplot breaks its row where it guesses that text is too wide, so the entries are placed by hand
    constexpr double mark = 16.0, letter = 6.4, gap = 22.0;
    constexpr std::pair<pebble_state, std::string_view> entries[] = {
        {pebble_state::clump, "unbroken"},
        {pebble_state::bonded, "replaced, all bonds intact"},
        {pebble_state::fragment, "broken"}};
    double width = -gap;
    for (const auto& [state, text] : entries) width += mark + letter * static_cast<double>(text.size()) + gap;
    double x = 0.5 * (page_w - width) + 0.5 * mark;
    std::string script =
        "    unset label; unset arrow\n    set lmargin at screen 0; set rmargin at screen 1; set bmargin "
        "at screen 0; set tmargin at screen 0.04\n    set xrange [0:1]; set yrange [0:1]\n";
    for (const auto& [state, text] : entries) {
        fmt::format_to(
            std::back_inserter(script),
            "    set label \"{}\" at screen {:.5f}, screen {:.5f} left offset character 0.4, 0 point pointtype 7 "
            "pointsize 1.2 linecolor rgb \"{}\" textcolor rgb dark font \",12\"\n",
            text, x / page_w, 20.0 / page_h, hex(colour_of(state)));
        x += mark + letter * static_cast<double>(text.size()) + gap;
    }
    return script + "    plot NaN notitle";
}

/// Puts the next plot into a part of the page (0 to 1): its ranges in cm, a title above and a scale bar below.
std::string place(double left, double bottom, double width, double height, const window& w, const std::string& title) {
    double bar = 1.0; // a round length (cm), about a quarter of the width
    for (const double candidate : {2.0, 5.0, 10.0, 20.0, 50.0})
        if (candidate <= 100.0 * (w.x1 - w.x0) / 3.0) bar = candidate;
    return fmt::format("    unset label; unset arrow\n"
                       "    set lmargin at screen {:.5f}; set rmargin at screen {:.5f}\n"
                       "    set bmargin at screen {:.5f}; set tmargin at screen {:.5f}\n"
                       "    set xrange [{:.6g}:{:.6g}]; set yrange [{:.6g}:{:.6g}]\n",
                       left, left + width, bottom, bottom + height, 100 * w.x0, 100 * w.x1, 100 * w.z0, 100 * w.z1) +
           fmt::format(
               "    set label 1 \"{0}\" at 0, graph 1 center offset 0, 0.9 textcolor rgb dark font \",14\"\n"
               "    set arrow 1 from {1:.5g}, graph -0.015 to {2:.5g}, graph -0.015 nohead linewidth 2 linecolor "
               "rgb dark front\n"
               "    set label 2 \"{3:g} cm\" at 0, graph -0.015 center offset 0, -0.8 textcolor rgb dark font "
               "\",11\" front\n",
               title, -bar / 2, bar / 2, bar);
}

std::string strain_title(const specimen_view& view) { return fmt::format("ε_a = {:.1f} %", 100.0 * view.axial_strain); }

void draw_specimen(plot_folder& plots, const plot_request& request) {
    const auto frame = common_window({&request.start, &request.end});
    if (!frame) return;
    const window w = *frame;
    struct panel {
        const specimen_view* view;
        std::string name, title;
    };
    std::vector<panel> views;
    if (!request.start.pebbles.empty()) views.push_back({&request.start, "start", "start of shear"});
    if (!request.end.pebbles.empty()) views.push_back({&request.end, "end", strain_title(request.end)});
    if (views.empty()) return;

    // layout in points: titles above, scale bars and legend below
    const double n = static_cast<double>(views.size());
    const double panel_h = 560.0, panel_w = panel_h * (w.x1 - w.x0) / (w.z1 - w.z0);
    const double gap = 24.0, above = 34.0, below = 74.0;
    const double page_w = std::max(n * panel_w + (n + 1.0) * gap, 420.0), page_h = panel_h + above + below;
    double left = (page_w - n * panel_w - (n - 1.0) * gap) / 2.0;
    std::string panels;
    for (const auto& [view, name, title] : views) {
        const raster picture = render_side(view->pebbles, w, 1120);
        plots.data("specimen_" + name + ".rgb", picture.bytes);
        const auto rings = membrane_profile(view->facets);
        plots.data("outline_" + name + ".csv",
                   rings.empty() ? "NaN,NaN\n" : outline(rings, &edge_profile::left, &edge_profile::right));
        const double pixel = 100.0 * (w.z1 - w.z0) / picture.height;
        panels += place(left / page_w, below / page_h, panel_w / page_w, panel_h / page_h, w, title);
        panels +=
            fmt::format("    plot \"data/specimen_{0}.rgb\" binary array=({1},{2}) format=\"%uchar\" dx={3:.8g} "
                        "dy={3:.8g} origin=({4:.8g},{5:.8g}) using 1:2:3 with rgbimage notitle, \\\n"
                        "         \"data/outline_{0}.csv\" using 1:2 with lines linewidth 1.2 linecolor rgb dark "
                        "notitle\n",
                        name, picture.width, picture.height, pixel, 100.0 * w.x0 + pixel / 2, 100.0 * w.z0 + pixel / 2);
        left += panel_w + gap;
    }
    plots.draw("specimen", fill_in(std::string(specimen_script), {{"W", fmt::format("{:.0f}", page_w)},
                                                                  {"H", fmt::format("{:.0f}", page_h)},
                                                                  {"PANELS", panels},
                                                                  {"LEGEND", legend(page_w, page_h)}}));
}

/// Circles in which the plane coordinate[axis] = value cuts the pebbles, grain by grain: first a dark rim of the whole
/// grain, then its fill, so that a clump shows one outline. Columns: cm, cm, cm, colour.
std::string section_circles(std::span<const pebble_view> pebbles, int axis, double value, double rim) {
    std::vector<std::size_t> cut;
    for (std::size_t i = 0; i < pebbles.size(); ++i)
        if (is_finite(pebbles[i].position) && std::abs(pebbles[i].position[axis] - value) < pebbles[i].radius)
            cut.push_back(i);
    const auto piece = [&](std::size_t i) { return std::pair(pebbles[cut[i]].grain, pebbles[cut[i]].fragment); };
    std::stable_sort(cut.begin(), cut.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(pebbles[a].grain, pebbles[a].fragment) < std::pair(pebbles[b].grain, pebbles[b].fragment);
    });
    const int v = axis == 1 ? 2 : 1;
    std::string text;
    for (std::size_t first = 0, last = 0; first < cut.size(); first = last) {
        while (last < cut.size() && piece(last) == piece(first)) ++last;
        for (const bool fill : {false, true})
            for (std::size_t i = first; i < last; ++i) {
                const pebble_view& p = pebbles[cut[i]];
                const double d = p.position[axis] - value;
                const double r = std::sqrt(p.radius * p.radius - d * d) - (fill ? rim : 0.0);
                const rgb c = fill ? colour_of(p.state) : rgb{45, 30, 30};
                const int code =
                    (static_cast<int>(c[0]) << 16) | (static_cast<int>(c[1]) << 8) | static_cast<int>(c[2]);
                if (r > 0.0)
                    fmt::format_to(std::back_inserter(text), "{:.5g},{:.5g},{:.4g},{}\n", 100 * p.position.x,
                                   100 * p.position[v], 100 * r, code);
            }
    }
    return text.empty() ? "NaN,NaN,NaN,0\n" : text;
}

/// Segments in which the plane coordinate[axis] = value cuts the facets of the membrane, in cm.
std::string section_wall(std::span<const facet_view> facets, int axis, double value) {
    const int v = axis == 1 ? 2 : 1;
    std::string text;
    for (const facet_view& f : facets) {
        if (f.ring < 0) continue;
        int found = 0;
        for (std::size_t i = 0; i < 4 && found < 2; ++i) {
            const vec3 a = f.corner[i], b = f.corner[(i + 1) % 4];
            const double da = a[axis] - value, db = b[axis] - value;
            if ((da < 0.0) == (db < 0.0)) continue;
            const vec3 c = a + (da / (da - db)) * (b - a);
            fmt::format_to(std::back_inserter(text), "{:.5g},{:.5g}\n", 100 * c.x, 100 * c[v]);
            ++found;
        }
        if (found > 0) text += "\n";
    }
    return text.empty() ? "NaN,NaN\n" : text;
}

void draw_section(plot_folder& plots, const specimen_view& view) {
    const auto frame = common_window({&view});
    if (!frame || view.pebbles.empty()) return;
    const window w = *frame;
    const double tall = w.z1 - w.z0, wide = w.x1 - w.x0, middle = 0.5 * (w.z0 + w.z1);
    const double rim = 0.0012 * tall;
    plots.data("section_vertical.csv", section_circles(view.pebbles, 1, 0.0, rim));
    plots.data("section_vertical_wall.csv", section_wall(view.facets, 1, 0.0));
    plots.data("section_horizontal.csv", section_circles(view.pebbles, 2, middle, rim));
    plots.data("section_horizontal_wall.csv", section_wall(view.facets, 2, middle));

    const double panel_h = 560.0, panel_w = panel_h * wide / tall, gap = 30.0, above = 34.0, below = 74.0;
    const double page_w = 2 * panel_w + 3 * gap, page_h = panel_h + above + below;
    const auto panel = [&](const char* name, const std::string& title, double left, double bottom, double height,
                           const window& shown) {
        return place(left / page_w, bottom / page_h, panel_w / page_w, height / page_h, shown, title) +
               fmt::format(
                   "    plot \"data/section_{0}.csv\" using 1:2:3:4 with circles linecolor rgb variable notitle, "
                   "\\\n         \"data/section_{0}_wall.csv\" using 1:2 with lines linewidth 1.6 linecolor rgb "
                   "dark notitle\n",
                   name);
    };
    const std::string panels = panel("vertical", "plane y = 0, " + strain_title(view), gap, below, panel_h, w) +
                               panel("horizontal", "plane at mid-height", 2 * gap + panel_w,
                                     below + 0.5 * (panel_h - panel_w), panel_w, {w.x0, w.x1, w.x0, w.x1});
    plots.draw("section", fill_in(std::string(section_script), {{"W", fmt::format("{:.0f}", page_w)},
                                                                {"H", fmt::format("{:.0f}", page_h)},
                                                                {"PANELS", panels},
                                                                {"LEGEND", legend(page_w, page_h)}}));
}

/// A condition of gnuplot that holds for these stages.
std::string stage_condition(const std::vector<std::string>& stages) {
    std::string text;
    for (const std::string& s : stages) text += fmt::format("{}s eq \"{}\"", text.empty() ? "" : " || ", s);
    return text.empty() ? "0" : text;
}
bool is_one_of(const std::string& stage, const std::vector<std::string>& stages) {
    return std::find(stages.begin(), stages.end(), stage) != stages.end();
}

/// The script of a curve; marks that its body alone has stay in it.
std::string script_of(const curve_figure& f, const std::string& series, const std::vector<std::string>& stages) {
    return fill_in(std::string(curve_script), {{"BODY", std::string(f.body)}, // first: it has marks of its own
                                               {"FIGURE", std::string(f.name)},
                                               {"TITLE", std::string(f.title)},
                                               {"SERIES", series},
                                               {"WANTED", stage_condition(stages)}});
}

void draw_curves(plot_folder& plots, const plot_request& request, const std::vector<sample>& rows) {
    const std::string series =
        std::filesystem::proximate(std::filesystem::absolute(request.series), std::filesystem::absolute(plots.path()))
            .string();
    const sample* peak = nullptr;
    double q_min = 0.0, v_min = 0.0, v_max = 0.0, strain = 0.0;
    std::int64_t most = 0;
    std::size_t sheared = 0, loaded = 0;
    for (const sample& r : rows) {
        if (is_one_of(r.stage, request.loading) && r.p >= 1e3) ++loaded;
        if (!is_one_of(r.stage, request.stages)) continue;
        ++sheared;
        const double sign = r.stage == "extend" ? -1.0 : 1.0;
        if (!peak || sign * r.q > sign * peak->q) peak = &r;
        const double dilation = -100.0 * r.volumetric_strain;
        q_min = std::min(q_min, r.q), v_min = std::min(v_min, dilation), v_max = std::max(v_max, dilation);
        if (std::abs(r.axial_strain) > std::abs(strain)) strain = r.axial_strain;
        most = std::max({most, r.broken_tension + r.broken_shear, r.replaced});
    }
    if (loaded >= 2) plots.draw("compression", script_of(compression_figure, series, request.loading));
    if (sheared < 2 || strain == 0.0) return;
    const double pad = std::max(0.12 * (v_max - v_min), 0.1);
    const bool extended = strain < 0.0, right_half = extended != (peak->axial_strain / strain > 0.6);
    for (const curve_figure& f : {stress_figure, volume_figure, fractures_figure})
        plots.draw(std::string(f.name),
                   fill_in(script_of(f, series, request.stages),
                           {{"QPEAK", fmt::format("{:.8g}", 1e-6 * peak->q)},
                            {"EPEAK", fmt::format("{:.8g}", 100.0 * peak->axial_strain)},
                            {"EMIN", extended ? "*" : "0"},
                            {"EMAX", extended ? "0" : "*"},
                            {"QMIN", q_min < -1e3 ? "*" : "0"},
                            {"QTOP", peak->q > 0.0 ? fmt::format("{:.6g}", 1.15e-6 * peak->q) : "*"},
                            {"VMIN", fmt::format("{:.6g}", v_min - pad)},
                            {"VMAX", fmt::format("{:.6g}", v_max + pad)},
                            {"LABEL_SIDE", right_half ? "right" : "left"},
                            {"LABEL_X", right_half ? "-0.5" : "0.5"},
                            {"TOP", fmt::format("{}", std::max(std::ceil(1.08 * static_cast<double>(most)), 1.0))}}));
}

} // namespace

plot_report draw_plots(const std::filesystem::path& folder, const plot_request& request) {
    plot_report report;
    plot_folder plots(folder, report, request.mark);
    const std::vector<sample> rows = clast::read_table<sample>(request.series);
    draw_curves(plots, request, rows);
    std::vector<fracture_event> events = clast::read_table<fracture_event>(request.events);
    const auto start =
        std::find_if(rows.begin(), rows.end(), [&](const sample& r) { return is_one_of(r.stage, request.stages); });
    if (start != rows.end()) // in shear only
        std::erase_if(events, [&](const fracture_event& e) { return e.time < start->time; });
    draw_rosette(plots, events);
    draw_membrane(plots, request);
    draw_specimen(plots, request);
    draw_section(plots, request.end.pebbles.empty() ? request.start : request.end);
    return report;
}

} // namespace triaxial
