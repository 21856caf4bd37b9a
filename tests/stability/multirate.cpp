// SPDX-License-Identifier: MIT
// Whether steps of light bodies make energy by themselves: packings at rest with a little noise in them.
#include <vector>

#include <catch.hpp>

#include "stability/noise.hpp"

using namespace clast;
using noise::whom;

TEST_CASE("damped as by default, clusters in sub-steps let noise die out, however soft or stiff their bonds are") {
    const auto rest = noise::packing(shapes::apollonian_14(0.02), 2, 3, 3, 0.3);
    const auto dies_out = [&](whom who, double ratio) {
        const auto base = noise::replaced(rest, who, noise::stiff(ratio), 0.7, 0.8);
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
