// SPDX-License-Identifier: MIT
// A dense packing of spheres in a periodic cell, in pure shear.
#include <cstdio>
#include <exception>

#include <clast/measure/stress.hpp>
#include <clast/spaces/periodic.hpp>

#include "scene.hpp"

int main(int argc, char** argv) try {
    using packing = peers::spheres_in<clast::boundaries::none, clast::spaces::periodic>;
    const peers::scene s = peers::read(argc, argv);
    clast::spaces::periodic cell(s.high - s.low);
    for (int a = 0; a < 3; ++a) cell.axes[static_cast<std::size_t>(a)].rate = s.rates()[a];
    const auto law = peers::grain_law(s);
    clast::engine<packing> e(peers::settings<packing>(s, law, law), peers::spheres_of(s, s.centre()), cell);
    double seconds = 0.0, cpu = 0.0;
    peers::timed(e, s.steps, seconds, cpu);
    const clast::mat3 sigma = clast::measure::love_weber(e, e.space.volume());
    peers::print("packing", s, s.spheres.size(), seconds, cpu, {sigma(0, 0), sigma(1, 1), sigma(2, 2)},
                 peers::touching_pairs(e), e.totals().rebuilds);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
