// SPDX-License-Identifier: MIT
// Crushes single grains between platens in many orientations: their strength, its scatter, and the strength of bonds
// that gives a grain the strength that is asked for.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <clast/core/errors.hpp>
#include <clast/core/quantity.hpp>
#include <clast/criteria/strength.hpp>
#include <clast/io/shapes.hpp>

#include "grain_test.hpp"
#include "weibull.hpp"

namespace {

namespace fs = std::filesystem;
using clast::input_error;

struct call {
    std::string shape = "4B", grain_size = "equivalent", strength = "23.2MPa", stiffness = "contact";
    std::string out = "results/crush";
    double bonds = 3e7; ///< tensile strength, with twice that for cohesion (Pa)
    double friction = 0.3, fall = 0.5, speed = 0.1;
    int orientations = 60;
    std::uint64_t seed = 1;
    unsigned threads = 0;
    bool calibrate = false;
};

/// Strengths F/d^2 (Pa) of all orientations of one seed, in their order.
struct series {
    std::vector<crush::outcome> all;
    std::vector<double> strength;
};

series run(const crush::test_settings& s, int n, unsigned threads, const char* what) {
    series out;
    out.all.resize(static_cast<std::size_t>(n));
    std::atomic<int> next{0}, done{0};
    std::exception_ptr failed;
    std::mutex lock;
    std::vector<std::thread> crew;
    for (unsigned t = 0; t < threads; ++t)
        crew.emplace_back([&] {
            for (int k; (k = next++) < n;) {
                try {
                    out.all[static_cast<std::size_t>(k)] = crush::crush_grain(s, static_cast<std::uint64_t>(k));
                } catch (...) {
                    const std::lock_guard guard(lock);
                    failed = std::current_exception();
                    next = n;
                }
                const std::lock_guard guard(lock);
                fmt::print(stderr, "\r{}: {} of {}", what, ++done, n);
            }
        });
    for (std::thread& t : crew) t.join();
    fmt::print(stderr, "\n");
    if (failed) std::rethrow_exception(failed);
    const double d = s.form.diameter;
    for (const crush::outcome& o : out.all) out.strength.push_back(o.peak / (d * d));
    return out;
}

std::string text_of(const crush::statistics& s) {
    return fmt::format("mean {:.2f} +- {:.2f} MPa, median {:.2f}, CV {:.2f}, Weibull m {:.2f} about {:.2f} MPa, n = {}",
                       1e-6 * s.mean, 1e-6 * s.standard_error, 1e-6 * s.median, s.cv, s.modulus,
                       1e-6 * s.characteristic, s.n);
}

void write(const call& c, const crush::test_settings& s, const series& of) {
    const fs::path folder = c.out;
    fs::create_directories(folder);
    const double d2 = s.form.diameter * s.form.diameter;
    std::ofstream table(folder / "grains.csv");
    table << "orientation,first_break_N,peak_N,first_break_Pa,strength_Pa,broken_bonds\n";
    for (std::size_t k = 0; k < of.all.size(); ++k)
        table << fmt::format("{},{},{},{},{},{}\n", k, of.all[k].first, of.all[k].peak, of.all[k].first / d2,
                             of.all[k].peak / d2, of.all[k].bonds);
    // survival: rank (n + 1 - k) / (n + 1), and the fit
    std::vector<double> sorted = of.strength;
    std::sort(sorted.begin(), sorted.end());
    const crush::statistics fit = crush::statistics_of(sorted);
    std::ofstream curve(folder / "survival.csv");
    curve << "strength_MPa,survival,weibull\n";
    for (std::size_t k = 0; k < sorted.size(); ++k)
        curve << fmt::format("{},{},{}\n", 1e-6 * sorted[k],
                             1.0 - static_cast<double>(k + 1) / static_cast<double>(sorted.size() + 1),
                             std::exp(-std::pow(sorted[k] / fit.characteristic, fit.modulus)));
    table.close(), curve.close(); // before they are drawn
    std::ofstream(folder / "survival.gp")
        << "set datafile separator ','\nset terminal pngcairo size 900,650 font ',13'\nset output 'survival.png'\n"
           "set xlabel 'strength F/d^2 (MPa)'\nset ylabel 'share of grains that survive'\nset yrange [0:1]\nset grid\n"
        << fmt::format("set title '{}, {} orientations'\n", s.form.name, sorted.size())
        << "plot 'survival.csv' skip 1 using 1:2 with points pt 7 title 'grains', '' skip 1 using 1:3 with lines lw 2 "
        << fmt::format("title 'Weibull, m = {:.2f}'\n", fit.modulus);
    const std::string draw = fmt::format("cd '{}' && gnuplot survival.gp >/dev/null 2>&1", folder.string());
    const bool drawn = folder.string().find('\'') == std::string::npos && std::system(draw.c_str()) == 0;
    fmt::print("  {}/grains.csv, survival.csv{}\n", folder.string(), drawn ? ", survival.png" : "");
}

int work(const call& c) {
    const auto choose = [](const char* option, const std::string& value, const char* a, const char* b) {
        if (value != a && value != b)
            throw input_error(option, value, fmt::format("{}, {}", a, b),
                              fmt::format("Write for example {} {}.", option, a));
        return value == a;
    };
    if (c.orientations < 2 || c.orientations > 100000)
        throw input_error("--orientations", fmt::format("{}", c.orientations), "2 to 100000", "60 is usual.");
    if (!(c.fall > 0.0 && c.fall < 1.0))
        throw input_error("--fall", fmt::format("{}", c.fall), "above 0, below 1",
                          "0.5: a peak is over at half of it.");
    const double target = clast::parse<clast::quantities::stress>(c.strength, "--strength").si();
    if (!(target > 0.0))
        throw input_error("--strength", c.strength, "above 0", "The weak rock of the paper has 23.2MPa.");
    crush::test_settings s;
    const bool equivalent = choose("--grain-size", c.grain_size, "equivalent", "circumscribed");
    s.form = clast::shapes::by_name(
        c.shape, {0.02, equivalent ? clast::size_reading::equivalent : clast::size_reading::circumscribed});
    if (s.form.bonds.empty())
        throw input_error("--shape", c.shape, "a shape with bonds", "A single sphere does not break: take 4B or 14B.");
    s.materials =
        choose("--stiffness", c.stiffness, "contact", "series") ? clast::table_1{} : clast::table_1::of_pieces();
    s.materials.platen.friction = c.friction;
    s.fall = c.fall, s.speed = c.speed, s.seed = c.seed;
    const auto with = [&](double tension) {
        crush::test_settings other = s;
        other.bond.tensile_strength = tension, other.bond.cohesion = 2.0 * tension;
        return other;
    };
    const unsigned threads = c.threads > 0 ? c.threads : std::max(1U, std::thread::hardware_concurrency());
    double tension = c.bonds;
    series of = run(with(tension), c.orientations, threads, "grains");
    crush::statistics now = crush::statistics_of(of.strength);
    fmt::print("{}, bonds {:.3g} / {:.3g} MPa: {}\n", c.shape, 1e-6 * tension, 2e-6 * tension, text_of(now));
    // strength grows as a power of that of bonds: the first guess is 1, the next ones what the last two rounds say.
    // Less than 1 where grains turn, or are pressed flat, before they break
    double power = 1.0;
    for (int round = 0; c.calibrate && std::abs(now.mean / target - 1.0) > 0.02; ++round) {
        if (round == 8)
            throw input_error("--strength", c.strength, "a strength that bonds can give this grain",
                              fmt::format("Eight rounds ended at {:.3g} MPa: take more --orientations, or another "
                                          "--fall.",
                                          1e-6 * now.mean));
        const double before = tension, mean_before = now.mean;
        tension *= std::pow(target / now.mean, 1.0 / power);
        of = run(with(tension), c.orientations, threads, "calibrated");
        now = crush::statistics_of(of.strength);
        power = std::clamp(std::log(now.mean / mean_before) / std::log(tension / before), 0.4, 1.5);
        fmt::print("{}, bonds {:.4g} / {:.4g} MPa: {}\n", c.shape, 1e-6 * tension, 2e-6 * tension, text_of(now));
    }
    write(c, with(tension), of);
    if (!c.calibrate) return 0;
    crush::test_settings fresh = with(tension);
    fresh.seed = c.seed + 1000003;
    const crush::statistics check =
        crush::statistics_of(run(fresh, c.orientations, threads, "fresh orientations").strength);
    const double error = std::hypot(now.standard_error, check.standard_error);
    fmt::print("fresh orientations: {}\n  off by {:.1f} standard errors of the difference\n", text_of(check),
               (check.mean - now.mean) / error);
    std::ofstream(fs::path(c.out) / "calibration.json") << fmt::format(
        "{{\"shape\": \"{}\", \"grain_size\": \"{}\", \"stiffness\": \"{}\", \"platen_friction\": {}, \"fall\": {}, "
        "\"target_Pa\": {}, \"bond_tensile_strength_Pa\": {}, \"bond_cohesion_Pa\": {}, \"n\": {}, \"mean_Pa\": {}, "
        "\"standard_error_Pa\": {}, \"cv\": {}, \"weibull_modulus\": {}, \"fresh_mean_Pa\": {}, "
        "\"fresh_standard_error_Pa\": {}}}\n",
        c.shape, c.grain_size, c.stiffness, c.friction, c.fall, target, tension, 2.0 * tension, now.n, now.mean,
        now.standard_error, now.cv, now.modulus, check.mean, check.standard_error);
    fmt::print("  {}/calibration.json\n", c.out);
    return 0;
}

} // namespace

int main(int count, char** words) {
    call c;
    CLI::App app{"Crushes single grains of bonded balls between two platens, in random orientations, and says what "
                 "strength F/d^2 they have.\nWith --calibrate it finds the strength of bonds for a mean strength.",
                 "crush"};
    app.get_formatter()->column_width(28);
    app.add_option("--shape", c.shape, "4B, 14B, or a file with a pebble 'x y z r' per line")->capture_default_str();
    app.add_option("--grain-size", c.grain_size, "what 2 cm is: equivalent, circumscribed")->capture_default_str();
    app.add_option("--stiffness", c.stiffness, "what 5.8e6 N/m is that of: contact, series")->capture_default_str();
    app.add_flag("--calibrate", c.calibrate, "find bonds for --strength, and try them on fresh orientations");
    app.add_option("--strength", c.strength, "mean strength to calibrate for, F/d^2")->capture_default_str();
    std::string bonds = "30MPa";
    app.add_option("--bonds", bonds, "tensile strength of bonds to begin with; cohesion is twice that")
        ->capture_default_str();
    app.add_option("--orientations", c.orientations, "number of grains")->capture_default_str();
    app.add_option("--seed", c.seed, "of the orientations")->capture_default_str();
    app.add_option("--platen-friction", c.friction, "of the platens")->capture_default_str();
    app.add_option("--fall", c.fall, "a peak is over when the force has fallen by this share of it")
        ->capture_default_str();
    app.add_option("--speed", c.speed, "of each platen (m/s)")->capture_default_str();
    app.add_option("--threads", c.threads, "0: as many as the machine has")->capture_default_str();
    app.add_option("--out", c.out, "folder of the results")->capture_default_str();
    try {
        app.parse(count, words);
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "error: {}. See --help.\n", error.what());
        return 2;
    }
    try {
        c.bonds = clast::parse<clast::quantities::stress>(bonds, "--bonds").si();
        if (!(c.bonds > 0.0)) throw input_error("--bonds", bonds, "above 0", "Table 1 has 30MPa for the weak rock.");
        if (!(c.speed > 0.0 && c.speed <= 10.0))
            throw input_error("--speed", fmt::format("{}", c.speed), "above 0, up to 10 m/s", "0.1 is quasi-static.");
        return work(c);
    } catch (const input_error& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return 2;
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return 3;
    }
}
