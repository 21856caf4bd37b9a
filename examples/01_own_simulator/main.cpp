// SPDX-License-Identifier: MIT
#include <clast/clast.hpp>
#include <fmt/core.h>
struct my_policies : clast::triaxial_policies_default {
    using boundary = clast::boundaries::solid_strips; // instead of independent tiles
    using breakage = clast::criteria::none;           // and grains that never break
    using replacement = clast::replacements::none;
};
struct printer : clast::observer {
    void on_row(const clast::sample& s) override {
        if (s.stage == "shear") fmt::print("eps_a {:5.2f} %  q {:4.0f} kPa\n", 100 * s.axial_strain, s.q / 1000);
    }
};
int main() {
    using namespace clast::literals;
    clast::triaxial_test<my_policies> test({.grain = clast::shapes::tetrahedron_4(0.02),
                                            .diameter = 10_cm,
                                            .height = 15_cm,
                                            .confining = 500_kPa,
                                            .breakage = {},
                                            .replacement = {}},
                                           clast::protocol::triaxial_compression(1_percent));
    printer rows;
    test.run(rows);
}
