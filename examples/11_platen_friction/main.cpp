// SPDX-License-Identifier: MIT
// Rough platens beside smooth ones: the same specimen, consolidated once each, sheared to 1 %.
#include <algorithm>

#include <clast/clast.hpp>
#include <fmt/core.h>

struct my_policies : clast::triaxial_policies_default {
    using boundary = clast::boundaries::tiles; // free to bulge between the ends that platens hold
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

/// Largest q (Pa), and the largest share of their limit that platens hold pebbles with.
struct result {
    double q = 0.0, held = 0.0;
};
result sheared(double friction) {
    using namespace clast::literals;
    clast::triaxial_setup<my_policies> setup{.grain = clast::shapes::tetrahedron_4(0.02),
                                             .diameter = 8_cm,
                                             .height = 12_cm,
                                             .confining = 500_kPa,
                                             .breakage = {},
                                             .replacement = {},
                                             .rings = 6,
                                             .tiles_per_ring = 10,
                                             .inertial_number = 1e-3};
    setup.materials.platen.friction = friction; // a contact takes the smaller of its two pieces: grains have 0.3
    clast::triaxial_test<my_policies> test(
        setup, clast::protocol::triaxial_compression(8_cm, 12_cm, 500_kPa, 1_percent, 1e-3));
    struct : clast::observer {
        double q = 0.0;
        void on_row(const clast::sample& s) override {
            if (s.stage == "shear") q = std::max(q, s.q);
        }
    } rows;
    test.run(rows);
    result out{rows.q, 0.0};
    test.sim().each_wall_row([&](const clast::boundaries::wall_row& w) {
        const double force = w.platen[0] + w.platen[1];
        if (force > 0.0 && w.lateral == 0.0) out.held = std::max(out.held, norm(w.friction) / (0.3 * force));
    });
    return out;
}

int main() {
    const result smooth = sheared(0.0), rough = sheared(0.3);
    fmt::print(
        "smooth platens: q {:.0f} kPa; rough ones: q {:.0f} kPa, they hold grains with up to {:.0f} % of the limit\n",
        smooth.q / 1e3, rough.q / 1e3, 100 * rough.held);
    return smooth.held == 0.0 && rough.held > 0.5 && rough.held < 1.0 + 1e-9 ? 0 : 1;
}
