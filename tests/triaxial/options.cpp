// SPDX-License-Identifier: MIT
// The command line of examples/triaxial, compiled into this test. errors_test.sh beside the program runs the binary.
#include "../../examples/triaxial/options.cpp"

#include <catch.hpp>

using namespace triaxial;

namespace {

options read(std::vector<std::string> arguments) { return parse_options(std::move(arguments)).values; }

std::string refusal(std::vector<std::string> arguments) {
    try {
        (void)parse_options(std::move(arguments));
    } catch (const clast::input_error& e) {
        return e.what();
    }
    return "accepted";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_CASE("without options the program runs the small weak 4B specimen in tiles") {
    const options o = read({});
    REQUIRE(o.shape == "4B");
    REQUIRE(o.rock().characteristic == 23.2e6);
    REQUIRE(o.membrane == "tiles");
    REQUIRE(o.confining == 2e6);
    REQUIRE(o.strain == 0.25);
    REQUIRE(o.grain_size == "equivalent");
    REQUIRE(o.stiffness == "contact");
    REQUIRE(o.contact_force == "resultant");
    REQUIRE(o.weibull == 10.0);
    REQUIRE(o.diameter() == Approx(0.18).epsilon(1e-14));
    REQUIRE(o.height() == Approx(0.42).epsilon(1e-14));
    REQUIRE(o.rings == 22);
    REQUIRE(o.tiles_per_ring == 12);
    REQUIRE(o.bond_stiffness == 9.6e8);
    REQUIRE(o.bond_stiffness_reading == bond_reading::force);
    REQUIRE(o.breakable());
    REQUIRE(o.out == "results/4B-tiles-weak-2MPa");
}

TEST_CASE("at full scale the membrane is that of the paper, at half scale that of the study") {
    options o = read({"--scale", "1"});
    REQUIRE(o.rings == 36);
    REQUIRE(o.tiles_per_ring == 20);
    REQUIRE(tile_width(o.diameter(), o.tiles_per_ring) == Approx(0.0475).epsilon(1e-3)); // 2 R tan(pi/20)
    o = read({"--scale", "0.5"});
    REQUIRE(o.rings == 18);
    REQUIRE(o.tiles_per_ring == 10);
    REQUIRE(read({"--scale", "0.5", "--membrane", "solid"}).rings == 1);
}

TEST_CASE("default tiles are never narrower than a grain") {
    const double widest = 2.0 * clast::shapes::tetrahedron_4(grain_diameter).circumscribed_radius;
    for (double s = 0.23; s <= 2.0; s += 0.01) {
        const options o = read({"--scale", fmt::format("{:.2f}", s)});
        REQUIRE(tile_width(o.diameter(), o.tiles_per_ring) >= widest);
        REQUIRE(o.tiles_per_ring >= 8);
    }
    REQUIRE(has(refusal({"--scale", "0.22"}), "0.23 to 2"));
    REQUIRE(has(refusal({"--scale", "0.16", "--grain-size", "circumscribed"}), "0.17 to 2"));
    REQUIRE(read({"--scale", "0.22", "--tiles-per-ring", "6"}).tiles_per_ring == 6); // the user knows better
}

TEST_CASE("quantities are read in their units") {
    const options o = read({"--confining=150kPa", "--strain", "0.1", "--save-every", "90s", "--inertial-number", "1e-3",
                            "--damping=0", "--seed", "18446744073709551615"});
    REQUIRE(o.confining == Approx(150e3).epsilon(1e-14));
    REQUIRE(o.strain == 0.1);
    REQUIRE(o.save_every == 90.0);
    REQUIRE(o.inertial_number == 1e-3);
    REQUIRE(o.damping == 0.0);
    REQUIRE(o.seed == ~std::uint64_t{0});
    REQUIRE(o.out == "results/4B-tiles-weak-0.15MPa");
    REQUIRE(read({"--save-every", "2"}).save_every == 120.0); // a bare number is minutes
    REQUIRE(read({"--save-every", "1h"}).save_every == 3600.0);
}

TEST_CASE("the bond stiffness is a reading of Table 1 or a value whose unit tells the reading") {
    REQUIRE(read({"--bond-stiffness", "modulus"}).bond_stiffness_reading == bond_reading::modulus);
    REQUIRE(read({"--bond-stiffness", "modulus"}).bond_stiffness == 9.6e8);
    REQUIRE(read({"--bond-stiffness", "per_area"}).bond_stiffness_reading == bond_reading::per_area);
    options o = read({"--bond-stiffness", "116MN/m"});
    REQUIRE(o.bond_stiffness_reading == bond_reading::force);
    REQUIRE(o.bond_stiffness == 116e6);
    o = read({"--bond-stiffness", "46.8 GPa"});
    REQUIRE(o.bond_stiffness_reading == bond_reading::modulus);
    REQUIRE(o.bond_stiffness == Approx(46.8e9).epsilon(1e-14));
    o = read({"--bond-stiffness", "1e13Pa/m"});
    REQUIRE(o.bond_stiffness_reading == bond_reading::per_area);
    REQUIRE(has(refusal({"--bond-stiffness", "5"}), "N/m"));
}

TEST_CASE("tiles and rings below the size of a pebble are refused with the largest number that fits") {
    REQUIRE(has(refusal({"--tiles-per-ring", "45"}), "6 to 44"));
    REQUIRE(refusal({"--tiles-per-ring", "44"}) == "accepted");
    REQUIRE(has(refusal({"--rings", "34"}), "1 to 33"));
    REQUIRE(refusal({"--rings", "33"}) == "accepted");
}

TEST_CASE("the stored arguments give the same options again") {
    const options o = read({"--shape",
                            "14B",
                            "--strength=strong",
                            "--membrane",
                            "solid",
                            "--confining",
                            "1.5MPa",
                            "--scale",
                            "0.3",
                            "--criterion",
                            "mean",
                            "--bond-stiffness",
                            "0.1GPa/m",
                            "--birth",
                            "zero",
                            "--protocol",
                            "unload",
                            "--rows",
                            "77",
                            "--no-plots",
                            "--threads",
                            "2",
                            "--inertial-number",
                            "0.00012345678901234567"});
    const options again = read(to_arguments(o));
    REQUIRE(to_arguments(again) == to_arguments(o));
    REQUIRE(physics_text(again) == physics_text(o));
    REQUIRE(again.inertial_number == o.inertial_number);
    REQUIRE(again.bond_stiffness_reading == bond_reading::per_area);
}

TEST_CASE("every option that decides results changes the fingerprint, and no other does") {
    const std::string base = physics_text(read({}));
    for (const std::vector<std::string>& changed :
         std::vector<std::vector<std::string>>{{"--shape", "14B"},
                                               {"--shape", "14B,4B"},
                                               {"--shape", "14B:0.7,4B:0.3"},
                                               {"--strength", "medium"},
                                               {"--membrane", "solid"},
                                               {"--rings", "12"},
                                               {"--tiles-per-ring", "11"},
                                               {"--confining", "1MPa"},
                                               {"--scale", "0.3"},
                                               {"--strain", "24%"},
                                               {"--protocol", "unload"},
                                               {"--inertial-number", "2e-4"},
                                               {"--friction", "0.4"},
                                               {"--grain-size", "circumscribed"},
                                               {"--stiffness", "series"},
                                               {"--membrane-stiffness", "3kN/m"},
                                               {"--contact-force", "single"},
                                               {"--bonds", "calibrated"},
                                               {"--weibull", "none"},
                                               {"--strength", "30MPa"},
                                               {"--damping", "0.5"},
                                               {"--seed", "2"},
                                               {"--criterion", "octahedral"},
                                               {"--replacement", "none"},
                                               {"--birth", "zero"},
                                               {"--bond-stiffness", "1e8N/m"},
                                               {"--bond-stiffness", "modulus"}})
        REQUIRE(physics_text(read(changed)) != base);
    REQUIRE(physics_text(read({"--threads", "7", "--save-every", "1", "--quiet", "--no-plots", "--out", "x"})) == base);
}

TEST_CASE("a misspelt option is answered with the nearest one") {
    REQUIRE(has(refusal({"--tile-per-ring", "10"}), "Did you mean --tiles-per-ring?"));
    REQUIRE(!has(refusal({"--xyz", "10"}), "Did you mean"));
}

TEST_CASE("the table of the paper names every decision once it matters") {
    const std::string text = paper_preset_text();
    for (int d = 1; d <= 15; ++d) REQUIRE(has(text, fmt::format("D{}", d)));
    for (const char* value : {"23.2 / 43.2 / 350.7", "0.3e8 / 0.5e8 / 4.2e8", "0.6e8 / 1.0e8 / 8.4e8", "46.8 GPa",
                              "5.8e6", "9.6e8, 4.8e8", "3.2e8", "3.2e6", "58 %"})
        REQUIRE(has(text, value));
    for (const char* option : {"--grain-size", "--strength", "--contact-force", "--stiffness", "--weibull"})
        REQUIRE(has(text, option));
    for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
        REQUIRE(end - at <= 112);
}

TEST_CASE("a strength is a rock of Table 1 or a stress, whose bonds are in the proportion of the weak one") {
    const options o = read({"--strength", "46.4MPa"});
    REQUIRE(o.rock().characteristic == Approx(46.4e6).epsilon(1e-14));
    REQUIRE(o.rock().bond_tension == Approx(0.6e8).epsilon(1e-14));
    REQUIRE(o.rock().bond_cohesion == Approx(1.2e8).epsilon(1e-14));
    REQUIRE(o.out == "results/4B-tiles-46.4MPa-2MPa");
    REQUIRE(read(to_arguments(o)).rock().characteristic == o.rock().characteristic);
    REQUIRE(read({"--strength", "strong"}).rock().bond_cohesion == 8.4e8);
    REQUIRE(has(refusal({"--strength", "week"}), "weak, medium, strong"));
    REQUIRE(has(refusal({"--strength", "23"}), "MPa"));
    REQUIRE(has(refusal({"--strength", "0MPa"}), "1kPa to 1TPa"));
}

TEST_CASE("calibrated bonds are those of the crushing tests, by a power of strength, and only for what was crushed") {
    for (const bond_calibration& c : bond_calibrations) {
        const std::string shape(c.shape);
        const auto bonds = [&](const char* strength) {
            return read({"--shape", shape, "--bonds", "calibrated", "--strength", strength}).rock();
        };
        REQUIRE(bonds("weak").bond_tension == Approx(c.weak).epsilon(1e-12));
        REQUIRE(bonds("medium").bond_tension == Approx(c.medium).epsilon(1e-12));
        REQUIRE(bonds("medium").bond_cohesion == Approx(2.0 * c.medium).epsilon(1e-12));
        REQUIRE(bonds("weak").characteristic == 23.2e6);
        const double between = bonds("31.6582MPa").bond_tension; // the geometric mean of both strengths
        REQUIRE(between == Approx(std::sqrt(c.weak * c.medium)).epsilon(1e-4));
    }
    REQUIRE(read({}).rock().bond_tension == 0.3e8);
    REQUIRE(has(refusal({"--bonds", "calibrated", "--stiffness", "series"}), "default readings"));
    REQUIRE(has(refusal({"--bonds", "calibrated", "--shape", "14B:0.5,4B:0.5"}), "4B or 14B alone"));
    REQUIRE(has(refusal({"--bonds", "glued"}), "table, calibrated"));
}

TEST_CASE("porosity is a target between loose and dense, part of what decides the results") {
    REQUIRE(read({}).porosity == 0.58);
    REQUIRE(read({"--porosity", "62%"}).porosity == Approx(0.62));
    REQUIRE(has(refusal({"--porosity", "0.2"}), "0.3 to 0.9"));
    REQUIRE(has(physics_text(read({"--porosity", "0.5"})), "porosity = 0.5\n"));
    REQUIRE(read(to_arguments(read({"--porosity", "0.5"}))).porosity == 0.5);
}

TEST_CASE("a specimen of another run brings its grains, size, porosity and seed, which may not be contradicted") {
    const fs::path place = fs::temp_directory_path() / fmt::format("clast_from_{}", ::getpid());
    fs::create_directories(place);
    REQUIRE(has(refusal({"--from", place.string()}), "--protocol prepare"));
    std::ofstream(place / prepared_file) << "grains";
    REQUIRE(has(refusal({"--from", place.string()}), arguments_file));
    {
        std::ofstream file(place / arguments_file);
        for (const std::string& a :
             to_arguments(read({"--shape", "14B", "--scale", "0.3", "--porosity", "0.6", "--seed", "7", "--protocol",
                                "prepare", "--friction", "0.2", "--grain-size", "circumscribed"})))
            file << a << '\n';
    }
    const options o = read({"--from", place.string(), "--membrane", "solid", "--confining", "1MPa"});
    REQUIRE(o.shape == "14B");
    REQUIRE(o.scale == 0.3);
    REQUIRE(o.grain_size == "circumscribed");
    REQUIRE(o.porosity == 0.6);
    REQUIRE(o.seed == 7);
    REQUIRE(o.protocol == "triaxial"); // what is done with it is not taken over
    REQUIRE(o.friction == 0.3);
    REQUIRE(o.from == (place / prepared_file).string());
    REQUIRE(o.checksums.size() == 1);
    REQUIRE(has(physics_text(o), "prepared specimen = prepared (checksum"));
    REQUIRE(read(to_arguments(o)).from == o.from); // by the file itself
    REQUIRE(read({"--from", place.string(), "--scale", "30%", "--seed", "7"}).scale == 0.3);
    REQUIRE(has(refusal({"--from", place.string(), "--scale", "0.4"}), "--scale"));
    REQUIRE(has(refusal({"--from", place.string(), "--shape", "4B"}), "Allowed: 14B"));
    REQUIRE(has(refusal({"--from", place.string(), "--grading", "curve.txt"}), "Allowed: nothing"));
    REQUIRE(has(refusal({"--from", place.string(), "--protocol", "prepare"}), "prepared already"));
    // a cube is no cylinder
    REQUIRE(has(refusal({"--from", place.string(), "--protocol", "true_triaxial"}), "--membrane box"));
    {
        std::ofstream file(place / arguments_file);
        for (const std::string& a :
             to_arguments(read({"--scale", "0.3", "--membrane", "box", "--protocol", "prepare"})))
            file << a << '\n';
    }
    REQUIRE(read({"--from", place.string(), "--protocol", "true_triaxial"}).membrane == "box");
    REQUIRE(read({"--from", place.string(), "--membrane", "box"}).scale == 0.3);
    REQUIRE(has(refusal({"--from", place.string()}), "Say --membrane box"));
    fs::remove_all(place);
}

TEST_CASE("each protocol has its wall, its strain and its own options, which others refuse") {
    const auto with = [](std::string protocol, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"--protocol", std::move(protocol)});
        return more;
    };
    REQUIRE(read(with("extension")).strain == 0.1);
    REQUIRE(read(with("extension", {"--strain", "5%"})).strain == 0.05);
    REQUIRE(read(with("extension")).membrane == "tiles");
    REQUIRE(read(with("extension")).out == "results/4B-tiles-weak-2MPa-extension");
    REQUIRE(read(with("oedometer")).membrane == "solid");
    REQUIRE(read(with("oedometer")).strain == 0.5);
    REQUIRE(read(with("oedometer", {"--confining", "1MPa"})).path.axial_stress == 1e6);
    REQUIRE(read(with("oedometer", {"--axial-stress", "5MPa"})).path.axial_stress == 5e6);
    REQUIRE(read(with("undrained")).membrane == "tiles");
    const options cube = read(with("true_triaxial", {"--b", "0.25"}));
    REQUIRE(cube.membrane == "box");
    REQUIRE(cube.path.b == 0.25);
    REQUIRE(cube.rings == 1);
    REQUIRE(cube.height() == Approx(cube.diameter()));
    REQUIRE(has(refusal(with("true_triaxial", {"--membrane", "tiles"})), "box with --protocol true_triaxial"));
    REQUIRE(has(refusal(with("true_triaxial", {"--b", "2"})), "0 to 1"));

    const options cycles = read(with("cyclic"));
    REQUIRE(cycles.path.cycles == 3);
    REQUIRE(cycles.path.cycle_high == 1e6);
    REQUIRE(cycles.path.cycle_low == Approx(1e5));
    REQUIRE(read(with("cyclic", {"--cycle-strain", "2%"})).path.cycle_strain == 0.02);
    REQUIRE(read(with("cyclic", {"--cycle-strain", "2%"})).path.cycle_high == 0.0);
    REQUIRE(has(refusal(with("cyclic", {"--cycle-strain", "2%", "--cycle-deviator", "1MPa"})), "one of the two"));
    REQUIRE(has(refusal(with("cyclic", {"--cycle-deviator", "50kPa"})), "below --cycle-deviator"));
    REQUIRE(has(refusal(with("cyclic", {"--cycles", "0"})), "from 1"));
    REQUIRE(has(refusal({"--cycles", "4"}), "only with --protocol cyclic"));
    REQUIRE(has(refusal({"--b", "0.2"}), "only with --protocol true_triaxial"));
    REQUIRE(has(refusal({"--axial-stress", "1MPa"}), "only with --protocol oedometer"));
    REQUIRE(has(refusal(with("isotropic", {"--until-peak", "10%"})), "--until-peak"));
    REQUIRE(read({"--until-peak", "10%"}).path.peak_drop == Approx(0.1));

    for (const std::vector<std::string>& one :
         {with("cyclic", {"--cycles", "7", "--cycle-deviator", "500kPa"}), with("cyclic", {"--cycle-strain", "2%"}),
          with("oedometer", {"--axial-stress", "5MPa"}), with("true_triaxial", {"--b", "0.25"}),
          with("undrained", {"--until-peak", "10%"})}) {
        const options o = read(one), again = read(to_arguments(o));
        REQUIRE(to_arguments(again) == to_arguments(o));
        REQUIRE(physics_text(again) == physics_text(o));
        REQUIRE(physics_text(o) != physics_text(read(with(o.protocol))));
        REQUIRE(again.path.cycles == o.path.cycles);
        REQUIRE(again.path.cycle_high == o.path.cycle_high);
        REQUIRE(again.path.axial_stress == o.path.axial_stress);
        REQUIRE(again.path.b == o.path.b);
    }
    REQUIRE(physics_text(read(with("cyclic", {"--cycle-low-deviator", "50kPa"}))) !=
            physics_text(read(with("cyclic"))));
}
