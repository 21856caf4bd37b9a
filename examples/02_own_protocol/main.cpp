// SPDX-License-Identifier: MIT
// Stages are data: isotropic compression, shear to a condition of one's own, unloading.
#include <string>
#include <vector>

#include <clast/clast.hpp>
#include <fmt/core.h>

struct my_policies : clast::triaxial_policies_default {
    using boundary = clast::boundaries::solid_strips;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

struct printer : clast::observer {
    void on_stage(const std::string& name, bool begins) override {
        fmt::print("{} {}\n", name, begins ? "..." : "done");
    }
    void on_row(const clast::sample& s) override {
        if (s.stage != "compact")
            fmt::print("  p' {:6.1f} kPa  q {:6.1f} kPa  e {:.4f}\n", s.p / 1e3, s.q / 1e3, s.void_ratio);
    }
};

int main() {
    using namespace clast;
    using namespace clast::literals;
    const auto diameter = 8_cm, height = 12_cm;
    const double inertial_number = 1e-3; // ten times the paper's: a toy has to be quick

    // the paper's preparation, then two isotropic pressures
    std::vector<stage> stages = protocol::preparation(diameter, height);
    stages.push_back(protocol::consolidation(100_kPa));
    stages.push_back({.name = "compress",
                      .axial = drive_by::stress(200_kPa),
                      .lateral = drive_by::stress(200_kPa),
                      .end = until::stresses_within(1e-3) && until::unbalanced_below(1e-3)});

    // shear until 1 % of strain, or until q reaches the confining stress: a text, a test and a progress in [0, 1]
    const condition strong{"q >= 200 kPa", [](const stage_view& v) { return v.q >= 200e3; },
                           [](const stage_view& v) { return v.q / 200e3; }};
    stages.push_back(protocol::shear(200_kPa, 1_percent, inertial_number));
    stages.back().end = until::axial_strain(1_percent) || strong;
    stages.push_back(protocol::unloading(200_kPa, 10_kPa, inertial_number));

    triaxial_test<my_policies> test({.grain = shapes::tetrahedron_4(0.02),
                                     .diameter = diameter,
                                     .height = height,
                                     .confining = 200_kPa,
                                     .breakage = {},
                                     .replacement = {},
                                     .inertial_number = inertial_number},
                                    stages);
    printer rows;
    return test.run(rows) ? 0 : 1;
}
