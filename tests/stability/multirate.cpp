// SPDX-License-Identifier: MIT
// Whether steps of light bodies make energy by themselves: packings at rest with a little noise in them.
#include <vector>

#include <catch.hpp>

#include "stability/noise.hpp"

using namespace clast;
using noise::simulator;
using noise::whom;

TEST_CASE("damped as by default, clusters in sub-steps let noise die out, however soft or stiff their bonds are") {
    const auto rest = noise::packing(shapes::apollonian_14(circumscribed(0.02)), 2, 3, 3, 0.3);
    const auto dies_out = [&](whom who, double ratio) {
        const auto base = noise::replaced(rest, who, noise::stiff(ratio), 0.7, 0.8);
        REQUIRE(base.kinetic_energy() < 1e-18 * base.elastic_energy());
        for (const double safety : {0.5, 0.6, 0.7, 0.8}) {
            auto e = base;
            e.settings.safety = safety;
            INFO("whom " << static_cast<int>(who) << " ratio " << ratio << " safety " << safety);
            CHECK(noise::growth(e, 1000) < 1.0);
        }
    };
    dies_out(whom::one, 2.0);
    dies_out(whom::half, 2.0);
    dies_out(whom::all, 2.0);
    dies_out(whom::half, 331.0);
}

TEST_CASE("undamped, noise in packings of clumps and clusters does not grow, up to the default safety") {
    const auto stays = [](const simulator& rest, whom who, bonds::parallel bond, int steps) {
        const auto base = noise::replaced(rest, who, bond, 0.0, 0.8);
        REQUIRE(base.kinetic_energy() < 1e-18 * base.elastic_energy());
        for (const double safety : {0.3, 0.5, 0.6, 0.7, 0.8}) {
            auto e = base;
            e.settings.safety = safety;
            INFO("whom " << static_cast<int>(who) << " k " << bond.normal_stiffness << " safety " << safety);
            CHECK(noise::growth(e, steps) < 10.0);
            CHECK(e.light_steps() == 1);
        }
    };
    const auto small = noise::packing(shapes::tetrahedron_4(circumscribed(0.02)), 2, 3, 5, 0.0);
    for (const whom who : {whom::one, whom::half, whom::all})
        for (const double ratio : {0.5, 3.0, 331.0}) stays(small, who, noise::stiff(ratio), 1000);
    stays(noise::packing(shapes::apollonian_14(circumscribed(0.02)), 2, 3, 3, 0.0), whom::half, noise::stiff(10.0),
          1000);
}
