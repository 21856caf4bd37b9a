// SPDX-License-Identifier: MIT
// One specimen, several tests: packed and consolidated once, saved, and sheared from the file with two strengths.
#include <algorithm>
#include <string>

#include <clast/clast.hpp>
#include <clast/io/checkpoint.hpp>
#include <fmt/core.h>

struct my_policies : clast::triaxial_policies_default { // breakable: nominal_force and modified (MPRM)
    using boundary = clast::boundaries::solid_strips;
};
using test_type = clast::triaxial_test<my_policies>;

// the same but for the strength of the grains (Pa), which no file keeps: it is that of the test that loads
test_type test_of(double strength) {
    using namespace clast::literals;
    const auto diameter = 7_cm, height = 8_cm;
    const double inertial_number = 5e-3; // fifty times the paper's: a toy has to be quick
    auto stages = clast::protocol::triaxial_compression(diameter, height, 200_kPa, 6_percent, inertial_number);
    for (clast::stage& s : stages) s.breakage = s.name == "shear"; // the specimen must not depend on the strength
    return test_type({.grain = clast::shapes::tetrahedron_4(0.02),
                      .diameter = diameter,
                      .height = height,
                      .confining = 200_kPa,
                      .breakage = {clast::criteria::crushing_strength(strength)},
                      .replacement = {.bond = {.tensile_strength = 1e5, .cohesion = 2e5}}, // Pa: weak
                      .porosity = 0.62,
                      .tiles_per_ring = 8,
                      .inertial_number = inertial_number},
                     stages);
}
struct until_shear : clast::observer { // stops before the first step of the shear
    bool shears = false;
    void on_stage(const std::string& name, bool begins) override { shears = begins && name == "shear"; }
    bool stop_requested() override { return shears; }
};
struct peak : clast::observer {
    double q = 0.0; // Pa
    void on_row(const clast::sample& s) override { q = std::max(q, s.q); }
};

int main() {
    const std::string file = "consolidated.clast", specimen = "7 x 8 cm, 200 kPa"; // what the file belongs to
    test_type first = test_of(350e6);
    until_shear prepare;
    if (first.run(prepare)) return 1; // over, without a shear
    clast::save_checkpoint(file, specimen, first);

    test_type strong = test_of(350e6), weak = test_of(0.5e6);
    peak of_strong, of_weak;
    clast::load_checkpoint(file, specimen, strong);
    clast::load_checkpoint(file, specimen, weak);
    const auto state = clast::checksum(first); // of every bit
    const bool same = clast::checksum(strong) == state && clast::checksum(weak) == state;
    strong.run(of_strong), weak.run(of_weak);
    fmt::print("loaded states {}; peak q {:.1f} kPa, with weak grains {:.1f} kPa ({} replaced)\n",
               same ? "are equal" : "differ", of_strong.q / 1e3, of_weak.q / 1e3, weak.sim().totals().replaced);
    return same && of_weak.q < of_strong.q && strong.sim().totals().replaced == 0 ? 0 : 1;
}
