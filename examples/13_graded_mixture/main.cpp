// SPDX-License-Identifier: MIT
// Two shapes with shares of the mass, and sizes by a sieve curve from a file, in a ready-made test.
#include <cmath>
#include <fstream>

#include <clast/clast.hpp>
#include <clast/io/grading.hpp>
#include <fmt/core.h>

using namespace clast;
using namespace clast::literals;

struct my_policies : triaxial_policies_default {
    using boundary = boundaries::solid_strips;
};

int main() {
    std::ofstream("sieve_curve.txt") << "# size (mm), finer (% by mass)\n14 0\n18 30\n24 65\n30 100\n";
    // the curve of a rockfill with grains of up to 60 cm would be made parallel to one that fits: .parallel_to(0.03)
    const grading curve = read_grading("sieve_curve.txt");
    const mixture grains({{shapes::apollonian_14(1.0), 0.6}, {shapes::tetrahedron_4(1.0), 0.4}}, curve);

    triaxial_test<my_policies> test({.grain = grains,
                                     .diameter = 10_cm,
                                     .height = 11_cm,
                                     .confining = 500_kPa,
                                     .breakage = {criteria::crushing_strength(3e6, 0.02, 3.0)}, // at 2 cm, m = 3
                                     .replacement = {},
                                     .tiles_per_ring = 10,
                                     .inertial_number = 5e-3,
                                     .threads = available_threads()},
                                    protocol::triaxial_compression(2_percent));
    observer quiet;
    test.run(quiet);

    // what is in there, sieve by sieve, against the curve asked for; and who broke
    const bodies::clumps& made = test.sim().grains;
    const auto mass = [&](auto&& counts) {
        double m = 0.0;
        for (const grain& g : made.grains) m += counts(g) ? made.mass_of(g) : 0.0;
        return m;
    };
    const double all = mass([](const grain&) { return true; });
    double worst = 0.0;
    for (const sieve& s : curve.curve()) {
        const double finer = mass([&](const grain& g) { return made.diameter_of(g) < s.size; }) / all;
        fmt::print("{:4.0f} mm: {:5.1f} % finer, asked for {:5.1f} %\n", 1e3 * s.size, 100 * finer, 100 * s.finer);
        worst = std::max(worst, std::abs(finer - s.finer));
    }
    const double of_14 = mass([](const grain& g) { return g.shape == 0; }) / all;
    const sample end = test.protocol().measure();
    fmt::print("14B: {:.1f} % of the mass of {} grains; q = {:.0f} kPa, {} replaced, {} bonds broken\n", 100 * of_14,
               made.grain_count(), 1e-3 * end.q, end.replaced, end.broken_tension + end.broken_shear);
    return worst < 0.05 && std::abs(of_14 - 0.6) < 0.05 && end.q > 0.0 && end.replaced > 0 ? 0 : 1;
}
