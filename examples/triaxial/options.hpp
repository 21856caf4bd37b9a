// SPDX-License-Identifier: MIT
// What a user can ask the triaxial program for, in SI values and names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace triaxial {

/// How the bond stiffness of Table 1 (paper) is read; physics of the readings: manual, page "bonds".
enum class bond_reading : std::uint8_t {
    force,    ///< N/m per bond, as printed
    modulus,  ///< Pa: bond stiffness = modulus * area / length
    per_area, ///< Pa/m: bond stiffness = value * area (what PFC calls pb_kn)
};

/// One of the three rocks of Table 1, or one of its kind.
struct strength_class {
    std::string_view name;
    double characteristic; ///< characteristic strength of a grain, platen force over d^2 (Pa)
    double bond_tension;   ///< tensile strength of a bond (Pa)
    double bond_cohesion;  ///< cohesion of a bond (Pa)
};
inline constexpr strength_class strength_classes[] = {
    {"weak", 23.2e6, 0.3e8, 0.6e8}, {"medium", 43.2e6, 0.5e8, 1.0e8}, {"strong", 350.7e6, 4.2e8, 8.4e8}};

inline constexpr double full_diameter = 0.30;  ///< of the specimen at scale 1 (m), paper section 2.3
inline constexpr double full_height = 0.70;    ///< of the specimen at scale 1 (m)
inline constexpr double grain_diameter = 0.02; ///< nominal, at every scale, without a grading (m)
inline constexpr int fewest_tiles = 6;         ///< in a ring: below, the polygon no longer resembles a cylinder

/// What some protocols ask besides; 0: not given.
struct path_options {
    int cycles = 3;            ///< cyclic
    double cycle_high = 0.0;   ///< cyclic: q at which loading turns round (Pa)
    double cycle_low = 0.0;    ///< cyclic: q at which unloading turns round (Pa)
    double cycle_strain = 0.0; ///< cyclic: axial strain between cycles, in the place of cycle_high
    double axial_stress = 0.0; ///< oedometer: sigma_1 at its end (Pa)
    double b = 0.5;            ///< true_triaxial: (sigma_2 - sigma_3) / (sigma_1 - sigma_3)
    double peak_drop = 0.0;    ///< share of its peak by which q has fallen where a shear ends
};

/// Everything that can be chosen. Values are checked; SI units.
struct options {
    // what is tested
    std::string grain_size = "equivalent"; ///< reading of 2 cm and of gradings: "equivalent" or "circumscribed"
    std::string shape = "4B"; ///< "4B", "14B", "sphere" or the path of a file; several as in "14B:0.7,4B:0.3"
    std::string grading;      ///< path of a sieve curve; empty: all grains have 2 cm
    std::string packing;      ///< path of a packing; empty: a cloud
    std::string from;         ///< path of a prepared specimen (prepared_file); empty: it is prepared
    double porosity = 0.58;   ///< as prepared
    std::vector<std::uint64_t> checksums{}; ///< of the files above (input_files)
    std::string strength = "weak";          ///< name of a strength class, or a stress in Pa
    std::string membrane = "tiles";         ///< "tiles", "rings", "solid", "rigid" or "box"
    int rings = 14;                         ///< V_sec; 1 for solid
    int tiles_per_ring = 10;                ///< H_part
    double confining = 2e6;                 ///< (Pa)
    double scale = 0.6;                     ///< 1 is 30 x 70 cm
    double strain = 0.25;                   ///< axial strain at the end of shear
    std::string protocol = "triaxial";      ///< one of protocol_names
    path_options path{};                    ///< further choices of some protocols
    double inertial_number = 1e-4;          ///< limit in shear
    std::string stiffness = "contact";      ///< what 5.8e6 N/m of Table 1 is that of: "contact" or "series" (a piece)
    double friction = 0.3;                  ///< between pebbles
    double membrane_stiffness = 0.0;        ///< E t of the membrane (N/m)
    double platen_friction = 0.0;           ///< of the platens
    double membrane_friction = 0.0;         ///< of the membrane
    double damping = 0.7;                   ///< local damping
    std::uint64_t seed = 1;
    // how grains break
    std::string criterion = "nominal_force";
    std::string contact_force = "resultant"; ///< what breaks a grain: "resultant" of a neighbour or "single" contact
    double weibull =
        10.0; ///< Weibull modulus of scatter and size effect of strengths; 0: no scatter, size effect of 10
    std::string replacement = "modified"; ///< name of a policy of replacements::any, or "none"
    std::string birth = "warm";           ///< "warm" or "zero"
    std::string bonds = "table";          ///< their strength: that of Table 1, "table", or "calibrated"
    bond_reading bond_stiffness_reading = bond_reading::force;
    double bond_stiffness = 9.6e8; ///< normal, in the unit of the reading; shear is half of it
    // how it is run; none of these changes a result
    int threads = 0;           ///< 0: as many as the machine has
    std::filesystem::path out; ///< folder of the results
    bool resume = false;       ///< go on with the run in `out`
    bool overwrite = false;    ///< replace the results in `out`
    double save_every = 300.0; ///< wall time between checkpoints (s)
    int snapshots = 10;        ///< ParaView snapshots over the shear
    int rows = 500;            ///< rows of series.csv over the shear
    bool plots = true;
    bool quiet = false;
    std::string stop_after_stage;      ///< stop with a checkpoint when this stage is done (tests)
    std::int64_t stop_after_steps = 0; ///< stop with a checkpoint after so many steps, 0: do not (tests)

    [[nodiscard]] double diameter() const { return full_diameter * scale; } ///< of the specimen (m)
    /// Of the specimen (m): a cylinder, or a cube.
    [[nodiscard]] double height() const { return (membrane == "box" ? full_diameter : full_height) * scale; }
    [[nodiscard]] strength_class rock_of_table() const; ///< with the bonds of Table 1
    [[nodiscard]] strength_class rock() const;          ///< the strength class by its name, or of its stress
    [[nodiscard]] bool breakable() const { return criterion != "none" && replacement != "none"; }
};

/// Reads a command line; `done` says that `--help`, `--version` or `--preset` was answered on stdout and there is
/// nothing to run. With --resume the options of the earlier run are read from its folder. Throws clast::input_error
/// with option, value, allowed range and a way out.
struct parsed {
    options values;
    bool done = false;
};
parsed parse_options(std::vector<std::string> arguments);

/// The options that decide the results, one "name = value" per line: fingerprint of checkpoints, inputs of the summary.
std::string physics_text(const options& o);

/// Command-line arguments that reproduce the run; stored with its results as `arguments_file`, one per line.
std::vector<std::string> to_arguments(const options& o);
inline constexpr const char* arguments_file = "arguments.txt";
inline constexpr const char* prepared_file = "prepared.clast"; ///< the specimen as prepared, for --from

/// Name of the rock, or "30MPa": short text of its strength.
std::string strength_text(const options& o);

/// "2MPa", "150kPa": short text of a stress (Pa).
std::string stress_text(double pascal);

/// Circumference of the specimen in equal tiles: width of one (m).
double tile_width(double specimen_diameter, int tiles_per_ring);

/// Table 1 of the paper with our reading of each row (physics decisions D1 to D15).
std::string paper_preset_text();

} // namespace triaxial
