// SPDX-License-Identifier: MIT
// The estimate of the time step in a packing: at it motion dies out, well below it energy is kept, above it all blows
// up.
#include <cmath>

#include <clast/core/errors.hpp>
#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {
using rigid = scenes::unbreakable<>;

/// Largest total energy over the one at the start, of a frictionless packing that rings between walls at rest.
double growth(double safety, double damping, int steps) {
    auto s = scenes::settings<rigid>();
    s.grain_contact.mu = 0.0;
    auto e = scenes::packed<rigid>(s, shapes::tetrahedron_4(circumscribed(0.02)), 40, 0.065, 5e5, 8000);
    e.drives = {};
    for (int k = 0; k < 2000; ++k) e.step();
    e.settings.scheme.damping = damping;
    e.settings.safety = safety;
    e.settings.largest_step = 1.0;
    for (std::size_t g = 0; g < e.grains.grain_count(); ++g)
        e.grains.motion[g].v = {1e-3 * static_cast<double>(g % 3), -1e-3 * static_cast<double>(g % 2), 1e-3};
    const double start = e.kinetic_energy() + e.elastic_energy();
    double largest = 0.0;
    try {
        for (int k = 0; k < steps; ++k) {
            e.step();
            largest = std::max(largest, (e.kinetic_energy() + e.elastic_energy()) / start);
        }
    } catch (const run_error&) {
        return 1e9;
    }
    return largest;
}
} // namespace

TEST_CASE("at the estimated step a damped packing gains no energy") {
    CHECK(growth(0.8, 0.7, 4000) < 1.0001);
    CHECK(growth(1.0, 0.7, 4000) < 1.0001);
}

TEST_CASE("at a quarter of the estimate an undamped packing keeps its energy over thousands of steps") {
    CHECK(growth(0.2, 0.0, 5000) < 1.02);
}

TEST_CASE("at three times the estimate the packing gains energy without end, damped or not: the estimate is no waste") {
    CHECK(growth(3.0, 0.0, 4000) > 2.0);
    CHECK(growth(3.0, 0.7, 4000) > 2.0);
}
