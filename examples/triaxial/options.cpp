// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <string_view>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>

#include <clast/core/errors.hpp>
#include <clast/core/quantity.hpp>
#include <clast/version.hpp>

#include "grains.hpp"

namespace triaxial {

using clast::input_error;
namespace quantities = clast::quantities;
namespace fs = std::filesystem;

namespace {

/// Tensile strength of bonds (Pa; cohesion is twice that) with which bonded grains of a shape crush at the strengths of
/// the weak and the medium rock in the mean, between rough platens, in the default readings: examples/crush --calibrate
/// --strength 23.2MPa, 43.2MPa, 240 orientations of 4B and 150 of 14B.
struct bond_calibration {
    std::string_view shape;
    double weak, medium;
};
constexpr bond_calibration bond_calibrations[] = {{"4B", 6.166e6, 12.99e6}, {"14B", 13.99e6, 24.75e6}};

constexpr int fewest_default_tiles = 8;
constexpr double smallest_scale = 0.15; // the diameter is then 2.25 grains
constexpr double largest_scale = 2.0;

/// What was typed; empty where the option was not given.
struct raw {
    std::string shape, grain_size, stiffness, contact_force, grading, packing, from, porosity, strength, membrane,
        rings, tiles, confining, scale, strain, inertial_number, criterion, weibull, replacement, birth, bond_stiffness,
        friction, platen_friction, membrane_friction, damping, seed, threads, out, resume, save_every, snapshots, rows,
        stop_after, protocol, preset, cycles, cycle_deviator, cycle_low_deviator, cycle_strain, axial_stress, b,
        until_peak, membrane_stiffness, bonds;
    bool no_plots = false, quiet = false, overwrite = false, version = false;
};

std::string joined(std::initializer_list<const char*> words) {
    std::string text;
    for (const char* w : words) text += (text.empty() ? "" : ", ") + std::string(w);
    return text;
}

void choose(std::string& target, const std::string& text, const char* option,
            std::initializer_list<const char*> allowed) {
    if (text.empty()) return;
    for (const char* name : allowed)
        if (text == name) {
            target = text;
            return;
        }
    throw input_error(option, text, joined(allowed), fmt::format("Write for example {} {}.", option, *allowed.begin()));
}

template <class Integer>
Integer whole_number(const std::string& text, const char* option, Integer low, Integer high,
                     const std::string& way_out) {
    Integer value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < low || value > high)
        throw input_error(option, text, fmt::format("a whole number from {} to {}", low, high), way_out);
    return value;
}

template <class Quantity>
double checked(const std::string& text, const char* option, double low, double high, bool low_itself,
               const std::string& allowed, const std::string& way_out) {
    const double value = clast::parse<Quantity>(text, option).si();
    if (value < low || value > high || (value == low && !low_itself)) throw input_error(option, text, allowed, way_out);
    return value;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

/// The command line; every option is text first, so that our own messages name unit, range and a way out.
void declare(CLI::App& app, raw& r) {
    const char* group = "Test";
    const auto add = [&](const char* name, std::string& target, const char* kind, const std::string& text,
                         const std::string& fallback) {
        app.add_option(name, target, fallback.empty() ? text : fmt::format("{} [{}]", text, fallback))
            ->type_name(kind)
            ->group(group);
    };
    add("--shape", r.shape, "NAME|FILE",
        "grain: 14B, 4B, sphere, or a file with a pebble 'x y z r' per line;\nseveral with parts of the mass "
        "(1 if left out):\n14B:0.7,4B:0.3",
        "4B");
    add("--grain-size", r.grain_size, "NAME",
        "what 2 cm, and a size of a grading, is: equivalent (diameter of the ball of equal volume),\ncircumscribed (of "
        "the sphere around a grain)",
        "equivalent");
    add("--grading", r.grading, "FILE", "sieve curve: lines 'size finer', in mm and % of the mass", "all grains 20 mm");
    add("--packing", r.packing, "FILE",
        "where grains start: packing.csv of another run\n(repeat its --shape and --scale), or lines 'x y z d' (m) for "
        "spheres",
        "a cloud");
    add("--porosity", r.porosity, "N",
        "of the specimen as prepared, 0.3 to 0.9, loose to dense; friction is lowered\nfor it while grains are packed",
        "0.58");
    add("--from", r.from, "DIR",
        "starts with the specimen that another run has prepared (its --shape, --grading,\n--scale, --porosity, "
        "--seed), at "
        "its consolidation",
        "prepare one");
    add("--strength", r.strength, "NAME|STRESS",
        "rock of Table 1 of the paper: weak (23.2 MPa), medium (43.2), strong (350.7);\nor the crushing strength "
        "F/d^2, "
        "with bonds in the proportion of the weak rock",
        "weak");
    add("--membrane", r.membrane, "NAME",
        "lateral boundary: tiles (each on its own), rings, solid (strips that move as one),\nrigid (a round cylinder), "
        "box (around a cube, 30 cm at scale 1)",
        "tiles; solid for oedometer,\nbox for true_triaxial");
    add("--rings", r.rings, "N", "rings of tiles over the height (V_sec)", "36 * scale");
    add("--tiles-per-ring", r.tiles, "N", "tiles, or strips, around the specimen (H_part)", "20 * scale, at least 10");
    add("--confining", r.confining, "STRESS", "confining stress in Pa, kPa, MPa or GPa", "2MPa");
    add("--scale", r.scale, "S", "size of the specimen: 1 is 30 cm x 70 cm; grains stay 2 cm", "0.6");
    add("--strain", r.strain, "STRAIN", "axial strain at the end of shear, 25% or 0.25; in extension its amount",
        "25%; extension 10%,\noedometer 50%");
    add("--protocol", r.protocol, "NAME",
        "triaxial, isotropic (no shear), unload (shear, then back to q = 0),\nextension (axial stress falls, cell "
        "pressure "
        "stays), cyclic (unloads and reloads),\nconstant_p (mean stress stays), undrained (volume stays; gives pore "
        "pressure),\noedometer (no lateral strain; gives K0), true_triaxial (b stays; a box),\nprepare (no "
        "consolidation: a specimen for --from)",
        "triaxial");
    add("--cycles", r.cycles, "N", "cyclic: number of cycles, before shear goes on to --strain", "3");
    add("--cycle-deviator", r.cycle_deviator, "STRESS", "cyclic: q at which loading turns round",
        "half of --confining");
    add("--cycle-low-deviator", r.cycle_low_deviator, "STRESS", "cyclic: q at which unloading turns round",
        "5 % of --confining");
    add("--cycle-strain", r.cycle_strain, "STRAIN", "cyclic: loading turns round each time that much further, at any q",
        "by q");
    add("--axial-stress", r.axial_stress, "STRESS", "oedometer: sigma_1 at its end", "as --confining");
    add("--b", r.b, "B", "true_triaxial: (sigma_2 - sigma_3)/(sigma_1 - sigma_3), 0 to 1", "0.5");
    add("--until-peak", r.until_peak, "DROP", "ends shear also where q has fallen by this share of its peak, as 10%",
        "only at --strain");
    add("--inertial-number", r.inertial_number, "I", "limit of the inertial number in shear", "1e-4");
    add("--stiffness", r.stiffness, "NAME",
        "what 5.8e6 N/m of Table 1 is that of: contact (of two pebbles), series (of a pebble,\nhalf of it between two)",
        "contact");
    add("--friction", r.friction, "MU", "friction coefficient between grains", "0.3");
    add("--platen-friction", r.platen_friction, "MU",
        "friction coefficient of the platens; a contact takes the smaller of its two pieces", "0");
    add("--membrane-friction", r.membrane_friction, "MU", "the same of the membrane", "0");
    add("--membrane-stiffness", r.membrane_stiffness, "E t",
        "modulus times thickness of the rubber, as 3kN/m: what tiles or rings hold by\nstretching, beside the pressure",
        "0N/m");
    add("--damping", r.damping, "A", "local damping", "0.7");
    add("--seed", r.seed, "N", "of the random packing", "1");
    group = "Breakage";
    add("--criterion", r.criterion, "NAME",
        "when a grain breaks: nominal_force, hertz_literal, hertz_calibrated,\noctahedral, mean, major_principal, none",
        "nominal_force");
    add("--contact-force", r.contact_force, "NAME",
        "force of a neighbour that breaks a grain: resultant (of all its contacts, as a platen's\nin the crushing "
        "test), single (the largest contact)",
        "resultant");
    add("--weibull", r.weibull, "M",
        "Weibull modulus of grain strengths (and of their bonds), 1 to 100: of their scatter and\nof their size "
        "effect; "
        "none: no scatter, and the size effect of 10",
        "10");
    add("--replacement", r.replacement, "NAME",
        "what becomes of it: modified (bonded cluster, MPRM), refreezing (that is rigid again\nonce at rest), "
        "rigid_bonded (rigid but for moments in which bonds fail),\nbonded_from_start (all grains, slow), none",
        "modified");
    add("--birth", r.birth, "NAME", "forces of new bonds: warm (in equilibrium with the load),\nzero (as in PFC)",
        "warm");
    add("--bonds", r.bonds, "NAME",
        "their strength: table (of Table 1), calibrated (so that 4B or 14B crush at --strength\nin the mean, see "
        "examples/crush)",
        "table");
    add("--bond-stiffness", r.bond_stiffness, "READING|VALUE",
        "how 9.6e8 of Table 1 is read: force (N/m per bond), modulus (Pa),\nper_area (Pa/m); or a value with one of "
        "these "
        "units",
        "force");
    group = "Run";
    add("--threads", r.threads, "N", "number of threads; 0: as many as the machine has", "0");
    add("--out", r.out, "DIR", "folder of the results", "results/SHAPE-MEMBRANE-STRENGTH-CONFINING");
    add("--resume", r.resume, "DIR", "go on with the interrupted run in this folder, with its options", "");
    app.add_flag("--overwrite", r.overwrite, "replace earlier results in the folder")->group(group);
    add("--save-every", r.save_every, "TIME", "wall time between checkpoints, in minutes or with s, min, h", "5min");
    add("--snapshots", r.snapshots, "N", "ParaView snapshots over the shear", "10");
    add("--rows", r.rows, "N", "rows of series.csv over the shear", "500");
    app.add_flag("--no-plots", r.no_plots, "do not draw the figures at the end")->group(group);
    app.add_flag("--quiet", r.quiet, "no progress on the screen")->group(group);
    group = ""; // for tests, not listed
    add("--stop-after", r.stop_after, "STAGE|STEPS", "stop with a checkpoint after a stage or a number of steps", "");
    group = "Information";
    add("--preset", r.preset, "NAME", "paper: print Table 1 of the paper with our reading of each row", "");
    app.add_flag("--version", r.version, "print the version")->group(group);
    app.set_help_flag("-h,--help", "print this text")->group(group);
}

/// Options that may be given together with --resume, because they change no result.
bool allowed_with_resume(const std::string& name) {
    for (const char* free :
         {"--resume", "--threads", "--save-every", "--no-plots", "--quiet", "--stop-after", "--help", "--version"})
        if (name == free) return true;
    return false;
}

[[noreturn]] void explain(const CLI::App& app, const CLI::ParseError& error,
                          const std::vector<std::string>& arguments) {
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        for (const std::string& a : arguments) {
            const std::string name = a.substr(0, a.find('='));
            if (!name.starts_with("-") || app.get_option_no_throw(name)) continue;
            std::string nearest;
            std::size_t best = name.size() / 2;
            for (const CLI::Option* o : app.get_options())
                if (const std::size_t d = edit_distance(name, o->get_name()); d < best)
                    best = d, nearest = o->get_name();
            throw input_error(fmt::format("{}: there is no such option.{} See --help for all of them.", name,
                                          nearest.empty() ? "" : fmt::format(" Did you mean {}?", nearest)));
        }
        throw input_error(fmt::format("{} Every value belongs to an option; see --help.", error.what()));
    }
    throw input_error(fmt::format("{}. See --help.", error.what()));
}

void read_tiles(options& o, const raw& r) {
    const bool solid = o.membrane == "solid" || o.membrane == "rigid" || o.membrane == "box";
    const clast::grain_sizes grains = sizes_of(o);
    // about as high as the paper's tiles, and none lower than a pebble
    const int high_enough = static_cast<int>(o.height() / (2.0 * grains.largest_radius) * (1.0 + 1e-9));
    o.rings = solid ? 1 : std::max(1, std::min(static_cast<int>(std::lround(36 * o.scale)), high_enough));
    if (!r.rings.empty())
        o.rings = whole_number(r.rings, "--rings", 1, 1000, "The paper uses 12, 24 and 36 at scale 1.");
    if (solid && o.rings != 1)
        throw input_error("--rings", r.rings, "1 with --membrane " + o.membrane + ", which is rigid over its height",
                          "Leave --rings out, or use --membrane tiles.");

    if (!r.tiles.empty()) {
        o.tiles_per_ring =
            whole_number(r.tiles, "--tiles-per-ring", fewest_tiles, 1000, "The paper uses 20 at scale 1.");
        return;
    }
    // about the width of the paper's tiles, but ten for a round ring, and none narrower than a grain
    const double grain = grains.largest_circumscribed;
    const int wide_enough = static_cast<int>(std::numbers::pi / std::atan(grain / o.diameter()));
    o.tiles_per_ring = std::min(std::max(10, static_cast<int>(std::lround(20 * o.scale))), wide_enough);
    if (o.tiles_per_ring < fewest_default_tiles) {
        const double enough = grain / std::tan(std::numbers::pi / fewest_default_tiles) / full_diameter;
        throw input_error(
            "--scale", fmt::format("{}", o.scale),
            fmt::format("{:.2f} to {:g}: a ring needs {} tiles that are wider than a grain",
                        std::ceil(100 * enough) / 100, largest_scale, fewest_default_tiles),
            fmt::format("Use a larger scale, or set --tiles-per-ring ({} or more) yourself.", fewest_tiles));
    }
}

void read_bond_stiffness(options& o, const std::string& text) {
    if (text.empty()) return;
    for (const auto& [name, reading] : {std::pair{"force", bond_reading::force},
                                        {"modulus", bond_reading::modulus},
                                        {"per_area", bond_reading::per_area}})
        if (text == name) {
            o.bond_stiffness_reading = reading; // of the value in Table 1
            return;
        }
    const std::string allowed =
        fmt::format("force, modulus, per_area, or a positive number with one of the units {} (force per bond), {} "
                    "(modulus), {} (per area)",
                    clast::unit_list({1, 0, -2}), clast::unit_list({1, -1, -2}), clast::unit_list({1, -2, -2}));
    const auto parts = clast::detail::split_number(text);
    const clast::named_unit* unit = nullptr;
    if (parts)
        for (const clast::dimension d :
             {clast::dimension{1, 0, -2}, clast::dimension{1, -1, -2}, clast::dimension{1, -2, -2}})
            if (const auto* found = clast::detail::find_unit(d, parts->unit)) unit = found;
    if (!unit || parts->number <= 0.0)
        throw input_error("--bond-stiffness", text, allowed, "Write for example --bond-stiffness 9.6e8N/m.");
    o.bond_stiffness = parts->number * unit->factor;
    o.bond_stiffness_reading = unit->dimension == clast::dimension{1, 0, -2}    ? bond_reading::force
                               : unit->dimension == clast::dimension{1, -1, -2} ? bond_reading::modulus
                                                                                : bond_reading::per_area;
}

bool shears(const options& o) { return o.protocol != "isotropic" && o.protocol != "prepare"; }

/// What depends on the protocol: wall and strain where they are not given, and its own options. Throws input_error for
/// an option of another protocol.
void read_path(options& o, const raw& r) {
    const bool cyclic = o.protocol == "cyclic", oedometer = o.protocol == "oedometer",
               three = o.protocol == "true_triaxial";
    if (r.membrane.empty() && (oedometer || three)) o.membrane = oedometer ? "solid" : "box"; // the polygon of tiles
    if (three && o.membrane != "box")
        throw input_error("--membrane", o.membrane, "box with --protocol true_triaxial",
                          "Leave --membrane out: a wall around the axis has one lateral stress.");
    if (r.strain.empty() && o.protocol == "extension") o.strain = 0.1;
    if (r.strain.empty() && oedometer) o.strain = 0.5;
    const auto own = [&](const std::string& text, const char* option, bool mine, const char* of) {
        if (!text.empty() && !mine)
            throw input_error(option, text, fmt::format("only with --protocol {}", of),
                              fmt::format("This one is {}: leave {} out.", o.protocol, option));
        return !text.empty();
    };
    path_options& p = o.path;
    const auto stress = [](const std::string& text, const char* option, const char* way_out) {
        return checked<quantities::stress>(text, option, 0.0, 1e10, false, "more than 0", way_out);
    };
    if (own(r.cycles, "--cycles", cyclic, "cyclic"))
        p.cycles = whole_number(r.cycles, "--cycles", 1, 10000, "3 is the default.");
    if (own(r.cycle_deviator, "--cycle-deviator", cyclic, "cyclic"))
        p.cycle_high = stress(r.cycle_deviator, "--cycle-deviator", "Half of the confining stress is the default.");
    if (own(r.cycle_low_deviator, "--cycle-low-deviator", cyclic, "cyclic"))
        p.cycle_low =
            stress(r.cycle_low_deviator, "--cycle-low-deviator", "5 % of the confining stress is the default.");
    if (own(r.cycle_strain, "--cycle-strain", cyclic, "cyclic")) {
        p.cycle_strain = checked<quantities::ratio>(r.cycle_strain, "--cycle-strain", 0.0, o.strain, false,
                                                    "more than 0, up to --strain", "1% is usual.");
        if (!r.cycle_deviator.empty())
            throw input_error("--cycle-strain", r.cycle_strain, "without --cycle-deviator",
                              "Cycles turn round at a q or at strains: give one of the two.");
    }
    if (cyclic) {
        if (p.cycle_high == 0.0 && p.cycle_strain == 0.0) p.cycle_high = 0.5 * o.confining;
        if (p.cycle_low == 0.0) p.cycle_low = 0.05 * o.confining;
        if (p.cycle_strain == 0.0 && p.cycle_high <= p.cycle_low)
            throw input_error("--cycle-low-deviator", stress_text(p.cycle_low),
                              "below --cycle-deviator, " + stress_text(p.cycle_high), "Exchange them.");
    }
    if (own(r.axial_stress, "--axial-stress", oedometer, "oedometer"))
        p.axial_stress = checked<quantities::stress>(r.axial_stress, "--axial-stress", 1e3, 1e8, true, "1kPa to 100MPa",
                                                     "--confining is the default.");
    if (oedometer && p.axial_stress == 0.0) p.axial_stress = o.confining;
    if (own(r.b, "--b", three, "true_triaxial"))
        p.b = checked<quantities::ratio>(r.b, "--b", 0.0, 1.0, true, "0 to 1",
                                         "0 is triaxial compression, 1 triaxial extension.");
    const bool monotonic = shears(o) && !cyclic && !oedometer && o.protocol != "extension";
    if (own(r.until_peak, "--until-peak", monotonic, "triaxial, unload, constant_p, undrained, true_triaxial"))
        p.peak_drop = checked<quantities::ratio>(r.until_peak, "--until-peak", 0.0, 1.0, false, "more than 0, up to 1",
                                                 "q scatters from step to step: 10% is usual.");
}

void read_run(options& o, const raw& r) {
    if (!r.threads.empty())
        o.threads = whole_number(r.threads, "--threads", 0, 1024, "0 takes as many as the machine has.");
    if (!r.save_every.empty()) {
        const auto parts = clast::detail::split_number(r.save_every);
        o.save_every = parts && parts->unit.empty()
                           ? 60.0 * parts->number
                           : clast::parse<quantities::duration>(r.save_every, "--save-every").si();
        if (!(o.save_every > 0.0))
            throw input_error("--save-every", r.save_every, "a time longer than 0",
                              "Write for example --save-every 5min.");
    }
    if (!r.stop_after.empty()) {
        const bool number = r.stop_after.find_first_not_of("0123456789") == std::string::npos;
        if (number)
            o.stop_after_steps = whole_number<std::int64_t>(r.stop_after, "--stop-after", 1, 1'000'000'000'000,
                                                            "Write a number of steps or the name of a stage.");
        else
            o.stop_after_stage = r.stop_after;
    }
    o.plots = o.plots && !r.no_plots;
    o.quiet = o.quiet || r.quiet;
}

void read_strength(options& o, const std::string& text) {
    if (text.empty()) return;
    for (const strength_class& c : strength_classes)
        if (text == c.name) {
            o.strength = text;
            return;
        }
    const std::string allowed = "weak, medium, strong, or a crushing strength from 1kPa to 1TPa";
    const std::string way_out = "Write for example --strength medium, or --strength 43.2MPa.";
    if (text.find_first_of("0123456789") == std::string::npos) throw input_error("--strength", text, allowed, way_out);
    o.strength =
        fmt::format("{}Pa", checked<quantities::stress>(text, "--strength", 1e3, 1e12, true, allowed, way_out));
}

/// Throws where there is no calibration.
void check_bonds(const options& o) {
    if (o.bonds == "table") return;
    const bool known = o.grain_size == "equivalent" && o.stiffness == "contact" && o.grading.empty();
    bool shape = false;
    for (const bond_calibration& c : bond_calibrations) shape = shape || o.shape == c.shape;
    if (!known || !shape)
        throw input_error(
            "--bonds", "calibrated", "with --shape 4B or 14B alone, of 2 cm in the default readings",
            "Calibrate others by examples/crush, and take --strength and a bond of your own in a bundle.");
}

options checked_options(const raw& r) {
    options o;
    if (!r.shape.empty()) o.shape = r.shape;
    if (o.shape == "4b" || o.shape == "14b") o.shape.back() = 'B';
    o.grading = r.grading, o.packing = r.packing, o.from = r.from;
    choose(o.grain_size, r.grain_size, "--grain-size", {"equivalent", "circumscribed"});
    choose(o.stiffness, r.stiffness, "--stiffness", {"contact", "series"});
    choose(o.contact_force, r.contact_force, "--contact-force", {"resultant", "single"});
    read_strength(o, r.strength);
    choose(o.membrane, r.membrane, "--membrane", {"tiles", "rings", "solid", "rigid", "box"});
    choose(o.protocol, r.protocol, "--protocol",
           {"triaxial", "isotropic", "unload", "extension", "cyclic", "constant_p", "undrained", "oedometer",
            "true_triaxial", "prepare"});
    choose(o.criterion, r.criterion, "--criterion",
           {"nominal_force", "hertz_literal", "hertz_calibrated", "octahedral", "mean", "major_principal", "none"});
    choose(o.replacement, r.replacement, "--replacement",
           {"modified", "refreezing", "rigid_bonded", "bonded_from_start", "none"});
    choose(o.birth, r.birth, "--birth", {"warm", "zero"});
    choose(o.bonds, r.bonds, "--bonds", {"table", "calibrated"});
    check_bonds(o);
    if (!r.confining.empty())
        o.confining =
            checked<quantities::stress>(r.confining, "--confining", 1e3, 1e8, true,
                                        "1kPa to 100MPa, compression is positive", "The paper uses 1.5MPa and 2MPa.");
    if (!r.scale.empty())
        o.scale = checked<quantities::ratio>(r.scale, "--scale", smallest_scale, largest_scale, true,
                                             fmt::format("{:g} to {:g}", smallest_scale, largest_scale),
                                             "1 is the specimen of the paper, 0.4 a quick test.");
    if (!r.porosity.empty())
        o.porosity = checked<quantities::ratio>(r.porosity, "--porosity", 0.3, 0.9, true, "0.3 to 0.9",
                                                "The paper uses 0.58; what is too dense for the grains is said.");
    if (!o.from.empty() && o.protocol == "prepare")
        throw input_error("--protocol", "prepare", "another one with --from, which is prepared already",
                          "Leave one of the two out.");
    if (!r.strain.empty())
        o.strain = checked<quantities::ratio>(r.strain, "--strain", 0.0, 0.5, false, "more than 0, up to 50%",
                                              "The paper goes to 25%; 25 without % would be 2500 %.");
    if (!r.inertial_number.empty())
        o.inertial_number = checked<quantities::ratio>(
            r.inertial_number, "--inertial-number", 0.0, 0.1, false, "more than 0, up to 0.1",
            "Up to 1e-3 a test counts as quasi-static; the paper uses 1e-4.");
    if (!r.friction.empty())
        o.friction =
            checked<quantities::ratio>(r.friction, "--friction", 0.0, 10.0, true, "0 to 10", "The paper uses 0.3.");
    if (!r.platen_friction.empty())
        o.platen_friction = checked<quantities::ratio>(r.platen_friction, "--platen-friction", 0.0, 10.0, true,
                                                       "0 to 10", "Lubricated platens have nearly none, the default.");
    if (!r.membrane_friction.empty())
        o.membrane_friction = checked<quantities::ratio>(r.membrane_friction, "--membrane-friction", 0.0, 10.0, true,
                                                         "0 to 10", "0 is the default.");
    if (!r.membrane_stiffness.empty()) {
        o.membrane_stiffness =
            checked<quantities::stiffness>(r.membrane_stiffness, "--membrane-stiffness", 0.0, 1e6, true,
                                           "0N/m to 1MN/m", "Rubber of 1.5 MPa and 2 mm has 3kN/m.");
        if (o.membrane_stiffness > 0.0 && o.membrane != "tiles" && o.membrane != "rings")
            throw input_error("--membrane-stiffness", r.membrane_stiffness, "none with --membrane " + o.membrane,
                              "Only a wall that is one sheet stretches: --membrane tiles or rings.");
    }
    if (r.weibull == "none")
        o.weibull = 0.0;
    else if (!r.weibull.empty())
        o.weibull = checked<quantities::ratio>(r.weibull, "--weibull", 1.0, 100.0, true, "1 to 100, or none",
                                               "3 is usual for rockfill, 10 for intact rock; 10 is the default.");
    if (!r.damping.empty())
        o.damping = checked<quantities::ratio>(r.damping, "--damping", 0.0, 0.95, true, "0 to 0.95", "0.7 is usual.");
    if (!r.seed.empty())
        o.seed = whole_number<std::uint64_t>(r.seed, "--seed", 0, ~std::uint64_t{0}, "Any whole number will do.");
    if (!r.snapshots.empty()) o.snapshots = whole_number(r.snapshots, "--snapshots", 0, 100000, "10 is usual.");
    if (!r.rows.empty()) o.rows = whole_number(r.rows, "--rows", 1, 10000000, "500 is usual.");
    read_bond_stiffness(o, r.bond_stiffness);
    read_path(o, r);
    read_tiles(o, r);
    check_grains(o);
    read_run(o, r);
    o.overwrite = r.overwrite;
    const bool usual =
        o.protocol == "triaxial" || o.protocol == "isotropic" || o.protocol == "unload" || o.protocol == "prepare";
    o.out = !r.out.empty()
                ? fs::path(r.out)
                : fs::path("results") / fmt::format("{}-{}-{}-{}{}", grains_title(o), o.membrane, strength_text(o),
                                                    stress_text(o.confining), usual ? "" : "-" + o.protocol);
    return o;
}

/// Arguments of an earlier run in a folder; copies of its files are in that folder, wherever that is now. option: which
/// one names it.
std::vector<std::string> stored_arguments(const fs::path& folder, const char* option) {
    std::ifstream file(folder / arguments_file);
    if (!file)
        throw input_error(option, folder.string(), "the folder of an earlier run (--out)",
                          fmt::format("There is no '{}' in it.", arguments_file));
    std::vector<std::string> stored;
    for (std::string line; std::getline(file, line);)
        if (!line.empty()) stored.push_back(line);
    for (std::string& a : stored)
        if (a.starts_with("--shape=") || a.starts_with("--grading=") || a.starts_with("--packing=") ||
            a.starts_with("--from=")) {
            const std::string own = std::string(input_folder) + "/", there = (folder / input_folder).string() + "/";
            for (std::size_t at = a.find(own); at != std::string::npos; at = a.find(own, at + there.size())) {
                if (a[at - 1] == '=' || a[at - 1] == ',') a.replace(at, own.size(), there);
            }
        }
    return stored;
}

/// What --from takes over from the run that prepared the specimen: its grains and sizes. Throws input_error where the
/// command line says another thing. `--from` becomes the path of the specimen itself.
void take_from(raw& r) {
    const fs::path folder = r.from;
    std::error_code none;
    if (!fs::is_directory(folder, none)) return; // of a run that is resumed: everything has been said
    if (!fs::exists(folder / prepared_file, none))
        throw input_error("--from", r.from, "the folder of a run that has prepared a specimen",
                          fmt::format("There is no '{}' in it: run --protocol prepare first.", prepared_file));
    const std::vector<std::string> stored = stored_arguments(folder, "--from");
    for (const auto& [name, mine] : {std::pair<std::string, std::string*>{"--shape", &r.shape},
                                     {"--grain-size", &r.grain_size},
                                     {"--grading", &r.grading},
                                     {"--packing", &r.packing},
                                     {"--scale", &r.scale},
                                     {"--porosity", &r.porosity},
                                     {"--seed", &r.seed}}) {
        std::string theirs;
        for (const std::string& a : stored)
            if (a.starts_with(name + "=")) theirs = a.substr(name.size() + 1);
        const auto number = [](const std::string& text) {
            const auto parts = clast::detail::split_number(text);
            return !parts                ? std::numeric_limits<double>::quiet_NaN()
                   : parts->unit == "%"  ? 0.01 * parts->number
                   : parts->unit.empty() ? parts->number
                                         : std::numeric_limits<double>::quiet_NaN();
        };
        if (!mine->empty() && *mine != theirs && !(number(*mine) == number(theirs)))
            throw input_error(name, *mine, theirs.empty() ? "nothing" : theirs,
                              fmt::format("Leave it out: '{}' was prepared with it.", r.from));
        *mine = theirs;
    }
    const auto cube = [](const std::vector<std::string>& arguments) {
        return std::find(arguments.begin(), arguments.end(), "--membrane=box") != arguments.end();
    };
    const bool mine = r.membrane == "box" || (r.membrane.empty() && r.protocol == "true_triaxial");
    if (cube(stored) != mine)
        throw input_error("--membrane", r.membrane.empty() ? mine ? "box" : "tiles" : r.membrane,
                          mine ? "a wall around a cylinder" : "box, around the cube that was prepared",
                          mine ? "Prepare the cube with --membrane box." : "Say --membrane box.");
    r.from = (folder / prepared_file).string();
}

options resumed_options(const CLI::App& app, const raw& r) {
    for (const CLI::Option* given : app.get_options()) {
        // get_name() is empty for options that --help does not list
        const std::string name = "--" + given->get_lnames().at(0);
        if (given->count() > 0 && !allowed_with_resume(name))
            throw input_error(fmt::format(
                "{}: an option that decides results cannot be changed by --resume, which goes on with those of '{}'. "
                "Leave it out, or start a new run with another --out.",
                name, r.resume));
    }
    const fs::path folder = r.resume;
    const std::vector<std::string> stored = stored_arguments(folder, "--resume");
    options o;
    try {
        o = parse_options(stored).values;
    } catch (const input_error& e) {
        throw input_error(
            fmt::format("--resume: '{}' cannot be used: {}", (folder / arguments_file).string(), e.what()));
    }
    o.out = folder;
    o.resume = true;
    o.overwrite = false;
    read_run(o, r);
    return o;
}

/// Own options of the protocol, by the names of the command line.
struct path_line {
    const char* name;
    double value;
    const char* unit;
};
std::vector<path_line> path_lines(const options& o) {
    std::vector<path_line> lines;
    const path_options& p = o.path;
    if (o.protocol == "cyclic") {
        lines.push_back({"cycles", static_cast<double>(p.cycles), ""});
        if (p.cycle_strain > 0.0)
            lines.push_back({"cycle-strain", p.cycle_strain, ""});
        else
            lines.push_back({"cycle-deviator", p.cycle_high, "Pa"});
        lines.push_back({"cycle-low-deviator", p.cycle_low, "Pa"});
    }
    if (o.protocol == "oedometer") lines.push_back({"axial-stress", p.axial_stress, "Pa"});
    if (o.protocol == "true_triaxial") lines.push_back({"b", p.b, ""});
    if (p.peak_drop > 0.0) lines.push_back({"until-peak", p.peak_drop, ""});
    return lines;
}

} // namespace

double tile_width(double specimen_diameter, int tiles_per_ring) {
    return specimen_diameter * std::tan(std::numbers::pi / tiles_per_ring);
}

std::string stress_text(double pascal) {
    return pascal >= 1e5 ? fmt::format("{:g}MPa", pascal / 1e6) : fmt::format("{:g}kPa", pascal / 1e3);
}

strength_class options::rock() const {
    strength_class rock = rock_of_table();
    if (bonds == "table") return rock;
    for (const bond_calibration& c : bond_calibrations) {
        if (shape != c.shape) continue;
        // strength of grains is a power of that of bonds, between weak and medium and beyond
        const double weak = strength_classes[0].characteristic, medium = strength_classes[1].characteristic;
        const double power = std::log(c.medium / c.weak) / std::log(medium / weak);
        rock.bond_tension = c.weak * std::pow(rock.characteristic / weak, power);
        rock.bond_cohesion = 2.0 * rock.bond_tension;
    }
    return rock;
}

strength_class options::rock_of_table() const {
    for (const strength_class& c : strength_classes)
        if (strength == c.name) return c;
    const strength_class& weak = strength_classes[0];
    const double value = clast::parse<quantities::stress>(strength, "--strength").si(), f = value / weak.characteristic;
    return {strength, value, f * weak.bond_tension, f * weak.bond_cohesion};
}

std::string strength_text(const options& o) {
    return o.strength.back() == 'a' ? stress_text(o.rock().characteristic) : o.strength; // "...Pa" is a stress
}

parsed parse_options(std::vector<std::string> arguments) {
    CLI::App app{"Triaxial test on breakable rockfill: packs clumps, consolidates them, shears them, and writes "
                 "curves, fractures,\n"
                 "ParaView files and figures. Stresses, times and stiffnesses need a unit: 2MPa,\n"
                 "5min, 9.6e8N/m. Defaults are in brackets.",
                 "triaxial"};
    app.get_formatter()->column_width(32);
    app.set_help_flag(); // comes last
    raw r;
    declare(app, r);
    try {
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend()); // CLI11 takes them from the back
        app.parse(std::move(reversed));
    } catch (const CLI::CallForHelp&) {
        std::string text = app.help();
        for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;) text.erase(at, 1);
        fmt::print("{}Exit codes: 0 done, 2 wrong input, 3 the run failed, 130 and 143 stopped by a signal, with a "
                   "checkpoint.\n",
                   text);
        return {{}, true};
    } catch (const CLI::ParseError& error) {
        explain(app, error, arguments);
    }
    if (!r.from.empty()) take_from(r);
    if (r.version) {
        fmt::print("clast {}\n", clast::version());
        return {{}, true};
    }
    if (!r.preset.empty()) {
        if (r.preset != "paper")
            throw input_error("--preset", r.preset, "paper",
                              "The values of the paper are the defaults; --scale 1 gives its size.");
        fmt::print("{}", paper_preset_text());
        return {{}, true};
    }
    return {app.get_option("--resume")->count() > 0 ? resumed_options(app, r) : checked_options(r), false};
}

std::string physics_text(const options& o) {
    constexpr const char* reading_names[] = {"N/m per bond", "Pa", "Pa/m"};
    std::string text;
    const auto line = [&text](std::string_view name, const auto& value, std::string_view unit = "") {
        text += fmt::format("{} = {}{}{}\n", name, value, unit.empty() ? "" : " ", unit);
    };
    text += grains_text(o);
    line("grain size", o.grain_size);
    line("porosity", o.porosity);
    line("strength", o.strength);
    line("membrane", o.membrane);
    line("rings", o.rings);
    line("tiles per ring", o.tiles_per_ring);
    line("confining stress", o.confining, "Pa");
    line("scale", o.scale);
    line("axial strain", o.strain);
    line("protocol", o.protocol);
    for (const auto& [name, value, unit] : path_lines(o)) line(name, value, unit);
    line("inertial number", o.inertial_number);
    line("stiffness", o.stiffness);
    line("friction", o.friction);
    line("platen friction", o.platen_friction);
    line("membrane friction", o.membrane_friction);
    line("membrane stiffness", o.membrane_stiffness, "N/m");
    line("contact force", o.contact_force);
    line("weibull", o.weibull);
    line("damping", o.damping);
    line("seed", o.seed);
    line("criterion", o.criterion);
    line("replacement", o.replacement);
    line("bond birth", o.birth);
    line("bonds", o.bonds);
    line("bond stiffness", o.bond_stiffness, reading_names[static_cast<std::size_t>(o.bond_stiffness_reading)]);
    line("rows", o.rows);
    line("snapshots", o.snapshots);
    return text;
}

std::vector<std::string> to_arguments(const options& o) {
    constexpr const char* reading_units[] = {"N/m", "Pa", "Pa/m"};
    std::vector<std::string> a;
    const auto add = [&a](std::string_view name, const auto& value, std::string_view unit = "") {
        a.push_back(fmt::format("--{}={}{}", name, value, unit));
    };
    add("shape", o.shape);
    add("grain-size", o.grain_size);
    if (!o.grading.empty()) add("grading", o.grading);
    if (!o.packing.empty()) add("packing", o.packing);
    if (!o.from.empty()) add("from", o.from);
    add("porosity", o.porosity);
    add("strength", o.strength);
    add("membrane", o.membrane);
    add("rings", o.rings);
    add("tiles-per-ring", o.tiles_per_ring);
    add("confining", o.confining, "Pa");
    add("scale", o.scale);
    add("strain", o.strain);
    add("protocol", o.protocol);
    for (const auto& [name, value, unit] : path_lines(o)) add(name, value, unit);
    add("inertial-number", o.inertial_number);
    add("stiffness", o.stiffness);
    add("friction", o.friction);
    add("platen-friction", o.platen_friction);
    add("membrane-friction", o.membrane_friction);
    add("membrane-stiffness", o.membrane_stiffness, "N/m");
    add("contact-force", o.contact_force);
    if (o.weibull > 0.0)
        add("weibull", o.weibull);
    else
        a.push_back("--weibull=none");
    add("damping", o.damping);
    add("seed", o.seed);
    add("criterion", o.criterion);
    add("replacement", o.replacement);
    add("birth", o.birth);
    add("bonds", o.bonds);
    add("bond-stiffness", o.bond_stiffness, reading_units[static_cast<std::size_t>(o.bond_stiffness_reading)]);
    add("threads", o.threads);
    add("out", o.out.string());
    add("save-every", o.save_every, "s");
    add("snapshots", o.snapshots);
    add("rows", o.rows);
    if (!o.plots) a.emplace_back("--no-plots");
    if (o.quiet) a.emplace_back("--quiet");
    return a;
}

std::string paper_preset_text() {
    struct entry {
        const char *row, *value, *decision, *reading, *why;
    };
    constexpr entry table[] = {
        {"Characteristic strength of a grain", "23.2 / 43.2 / 350.7 MPa (weak / medium / strong)", "D1",
         "a grain is replaced when the force of a neighbour, the resultant of its contacts, reaches 0.9 sigma d^2: "
         "8.35 "
         "/ 15.6 / 126 kN at d = 2 cm (--strength, --criterion nominal_force, --contact-force resultant)",
         "Eq. 1 as printed gives 0.01 N for the weak rock, where a mean contact carries more than 1000 N; the values "
         "are those of crushing tests, platen force over d^2. Eq. 1 is kept: hertz_literal, hertz_calibrated"},
        {"Scatter of strength", "not given", "D1",
         "Weibull modulus 10 about the characteristic strength, in the size effect, too; bonds of a grain are scaled "
         "with it (--weibull)",
         "a characteristic strength is the value that 37 % of grains survive; with 10 many more weak grains break than "
         "medium ones and no strong one, as in the paper's Fig. 9; --weibull none leaves one strength for all"},
        {"Bond tensile strength", "0.3e8 / 0.5e8 / 4.2e8 N/m2", "D2",
         "stress, as printed; bond radius = smaller pebble, moment contribution 1",
         "not calibrated to our shapes: between rough platens bonded 4B crush at 73 MPa in the mean, 14B at 55, where "
         "the first "
         "row has 23.2 (--bonds table); --bonds calibrated takes those of examples/crush"},
        {"Bond cohesion", "0.6e8 / 1.0e8 / 8.4e8 N/m2", "D2", "shear strength, bond friction angle 0",
         "no angle is given"},
        {"Young's modulus, Poisson ratio", "46.8 GPa, 0.3", "D1", "enter only the Hertz criteria",
         "contacts are linear"},
        {"Linear normal, shear stiffness", "5.8e6, 2.9e6 N/m", "D6",
         "of a contact of two pebbles; a pebble has twice as much in series with a wall: 2.51e6 N/m at tiles, 1.12e7 "
         "at "
         "platens (--stiffness contact; series: 2.9e6, 2.06e6, 5.70e6)",
         "PFC's table of contacts takes the value of a contact; and grains are stiffer, k_n / (p d) = 145 at 2 MPa, "
         "which is rigid enough (above 100), where half of it is 73"},
        {"Bond normal, shear stiffness", "9.6e8, 4.8e8 N/m", "D2",
         "N/m per bond, as printed (--bond-stiffness force); modulus (Pa) and per_area (Pa/m) can be chosen",
         "Pa/m would let a bond stretch by 3 cm before it fails"},
        {"", "", "D3", "the stiff bonds of a cluster are sub-cycled, the step of the specimen stays",
         "an explicit step would be 20 to 70 times smaller"},
        {"Platen normal stiffness", "3.2e8 N/m", "D6, D7",
         "in series with the pebble; no friction with platens and tiles unless asked for",
         "none is listed; usual for lubricated platens"},
        {"Tile normal stiffness", "3.2e6 N/m", "D6, D7", "the same", ""},
        {"Coefficient of friction", "0.3", "D7", "between pebbles", ""},
        {"Sample initial porosity", "58 %", "D13", "from the volume of the pebbles: gaps inside a clump are voids",
         "the hulls then pack to 0.59 to 0.62, as loose packings do"},
        {"Sample (section 2.3)", "30 cm x 70 cm", "--scale 1", "the default is scale 0.6: 18 cm x 42 cm, same grains",
         "minutes and not days"},
        {"Grain size (section 2.3)", "2 cm", "D5",
         "diameter of the ball of the same volume, in F/d^2, inertial number and gradings: 4961 grains of either shape "
         "at scale 1; the spheres around them have 28.0 (4B) and 24.8 mm (14B) (--grain-size equivalent)",
         "so PFC means the diameter of a clump, and the paper's sphericity the same volume; circumscribed gives 13 658 "
         "and 9471 smaller grains"},
        {"Shapes (Fig. 5)", "14 balls, 4 balls", "D4",
         "14B: 6 + 8 balls in a sphere, 36 bonds; 4B: regular tetrahedron, 6 bonds",
         "no coordinates are given; --shape FILE takes others"},
        {"Membrane (section 2.2)", "H_part 20, V_sec 12 / 24 / 36", "D8",
         "the polygon surrounds the 30 cm circle; the centres of tiles are the nodes of one closed surface, vertical "
         "at "
         "the platens",
         "the paper's rectangles leave ledges, which carried up to a quarter of the axial force; a membrane cannot"},
        {"Gaps between tiles (Fig. 4)", "smallest particle", "D9",
         "none: two nodes above each other may differ by 0.9 of their distance", "a joined surface does not gape"},
        {"Tile velocity (section 2.3)", "0.01 mm/s", "D10",
         "at most 6 I sqrt(sigma_3 / rho) R / d, 0.12 m/s at scale 1: six times as fast as a specimen widens that is "
         "sheared at I = 1e-4",
         "at 0.01 mm/s a tile would need 750 s to bulge 5 %, the test lasts 2 s"},
        {"Tolerance of stress (section 2.3)", "0.1 %", "D15",
         "servo v = 0.5 (F_target - F)/(K dt) for each tile; 0.1 % holds for the mean",
         "a tile carries 2 to 7 contacts"},
        {"Damping, gravity, density", "not given", "D11", "local damping 0.7, no gravity, 2650 kg/m3",
         "usual for quasi-static tests"},
        {"Replacement (section 2.1)", "at 90 % of strength", "D12",
         "velocities and contacts are kept, bonds are born in equilibrium with the load (--birth warm)",
         "bonds born without force break at once by overshoot, which is numerical"},
        {"Volumetric strain", "sign not given", "D14",
         "files: compression positive; figures: dilation positive, and say so", "as the paper's text implies"},
    };
    const auto wrapped = [](std::string_view label, std::string_view text) {
        std::string out, line = "    " + std::string(label);
        const std::string indent(line.size(), ' ');
        while (!text.empty()) {
            const auto space = text.find(' ');
            const std::string_view word = text.substr(0, space);
            if (line.size() + word.size() + 1 > 110) {
                out += line + "\n";
                line = indent;
            }
            line += (line.back() == ' ' ? "" : " ") + std::string(word);
            text = space == std::string_view::npos ? std::string_view{} : text.substr(space + 1);
        }
        return out + line + "\n";
    };
    std::string text =
        "Table 1 of the paper (Granular Matter 2024, doi 10.1007/s10035-024-01441-3) and what else its test needs,\n"
        "each with our reading, numbered D1 to D15. These are the defaults of this program.\n";
    for (const entry& e : table) {
        if (*e.row) text += fmt::format("\n{}: {}\n", e.row, e.value);
        text += wrapped(fmt::format("{:<10} ", e.decision), e.reading);
        if (*e.why) text += wrapped("           why:", e.why);
    }
    return text;
}

} // namespace triaxial
