// SPDX-License-Identifier: MIT
// A dense packing of spheres in a periodic cell, in pure shear.
#include <cstdio>
#include <exception>

#include <clast/boundaries/periodic_cell.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/criteria/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/measure/stress.hpp>
#include <clast/replacements/none.hpp>

#include "scene.hpp"

struct packing : clast::triaxial_policies_default {
    using specimen = clast::sphere_specimen;
    using contact = clast::contacts::linear_dashpot;
    using boundary = clast::boundaries::periodic_cell;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

int main(int argc, char** argv) try {
    const peers::scene s = peers::read(argc, argv);
    const clast::contacts::linear_dashpot law{s["kn"], s["kt"], s["mu"], s["gamma_n"], s["density"]};
    clast::sphere_specimen spheres;
    spheres.density = s["density"];
    for (const peers::sphere& one : s.spheres) {
        const auto p = static_cast<std::size_t>(spheres.add(one.x - s.centre(), one.r));
        spheres.pebbles[p].v = s.flow(one.x);
    }
    clast::boundaries::periodic_cell cell(s.high - s.low);
    for (int a = 0; a < 3; ++a) cell.axes[static_cast<std::size_t>(a)].rate = s.rates()[a];
    clast::engine<packing> e({.grain_contact = law,
                              .platen_contact = law,
                              .lateral_contact = law,
                              .breakage = {},
                              .replacement = {},
                              .damping = 0.0,
                              .safety = 1.0,
                              .skin = s.skin * s.mean_diameter(),
                              .largest_step = s["dt"],
                              .run = clast::execution(s.threads)},
                             spheres, cell);
    double seconds = 0.0, cpu = 0.0;
    peers::timed(
        s.steps, [&] { e.step(); }, seconds, cpu);
    const clast::mat3 sigma = clast::measure::love_weber(e, e.boundary.volume());
    std::int64_t pairs = 0;
    e.each_contact([&](const clast::force_row& row, const clast::pebble_pair&) { pairs += row.depth > 0.0; });
    peers::print("packing", s, s.spheres.size(), seconds, cpu, {sigma(0, 0), sigma(1, 1), sigma(2, 2)}, pairs,
                 e.totals().rebuilds);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
