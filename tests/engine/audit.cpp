// SPDX-License-Identifier: MIT
#include <clast/engine/audit.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <clast/boundaries/box.hpp>
#include <clast/engine/engine.hpp>
#include <clast/spaces/open.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using rigid = scenes::unbreakable<>;

} // namespace

TEST_CASE("the energy ledger of a collision closes, better with the square of the step") {
    const auto error = [](double safety, double damping) {
        auto s = scenes::settings<rigid>();
        s.scheme.damping = damping;
        s.safety = safety;
        engine<rigid> e = scenes::collision(s);
        while (e.time() < 0.02) e.step();
        CHECK(e.elastic_energy() == 0.0); // apart again
        return std::abs(scenes::residual(e)) / e.totals().initial_energy;
    };
    const double coarse = error(0.2, 0.0), fine = error(0.025, 0.0);
    CHECK(coarse < 1e-2);
    CHECK(fine < coarse / 32); // 64 in the limit
    CHECK(error(0.05, 0.7) < 1e-3);
}

TEST_CASE("the energy ledger of a packing under servo control closes to 2e-4 of the work") {
    auto e = scenes::packed<rigid>(scenes::settings<rigid>(), shapes::tetrahedron_4(circumscribed(0.02)), 40, 0.065,
                                   1e5, 6000);
    const double work = e.totals().boundary_work, open = scenes::residual(e);
    e.drives = scenes::isotropic(8e5, 0.02);
    for (int k = 0; k < 6000; ++k) e.step();
    CHECK(e.boundary.axial_stress(e.loads()) == Approx(8e5).epsilon(0.01));
    CHECK(std::abs(scenes::residual(e) - open) < 2e-4 * (e.totals().boundary_work - work));
}

TEST_CASE("a scene that begins loaded has the energy of its contacts at the start, of pebbles and of walls") {
    const double r = 0.01, depth = 1e-5, kn = 1e6, wall = 4e6;
    using free = scenes::unbreakable_spheres<>;
    bodies::spheres two;
    two.add({}, r), two.add({2.0 * r - depth, 0.0, 0.0}, r);
    engine<free> e({.grain_contact = {kn, 0.5 * kn, 0.0},
                    .platen_contact = {},
                    .lateral_contact = {},
                    .breakage = {},
                    .replacement = {},
                    .scheme = {.damping = 0.0},
                    .safety = 0.02},
                   two, spaces::open{});
    const double stored = 0.5 * kn * depth * depth;
    CHECK(e.totals().initial_energy == Approx(stored).epsilon(1e-9));
    e.count_initial_energy();
    CHECK(e.totals().initial_energy == Approx(stored).epsilon(1e-9));
    while (e.elastic_energy() > 0.0) e.step();
    CHECK(e.kinetic_energy() == Approx(stored).epsilon(1e-3));
    CHECK(std::abs(scenes::residual(e)) < 1e-3 * stored);
    // one ball between two platens
    using between = scenes::unbreakable_spheres<boundaries::box>;
    bodies::spheres one;
    one.add({}, r);
    engine<between> b({.grain_contact = {kn, 0.5 * kn, 0.0},
                       .platen_contact = {wall, 0.0, 0.0},
                       .lateral_contact = {wall, 0.0, 0.0},
                       .breakage = {},
                       .replacement = {}},
                      one, boundaries::box({{-0.5, -0.5, depth - r}, {0.5, 0.5, r - depth}, wall, wall}));
    CHECK(b.totals().initial_energy == Approx(2.0 * 0.5 * wall * depth * depth).epsilon(1e-9));
    b.step(100);
    CHECK(std::abs(scenes::residual(b)) < 1e-9 * b.totals().initial_energy);
}
