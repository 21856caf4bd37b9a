// SPDX-License-Identifier: MIT
// A membrane passes sigma_3 (A(z) - A_bottom) along the axis between the bottom and a section z, and nothing else: hand
// statics, against what the grains at the wall say.
#include <algorithm>
#include <cmath>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/stepped_tiles.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/grains/shape.hpp>
#include <clast/measure/stress.hpp>
#include <clast/protocol/triaxial.hpp>

using namespace clast;
using namespace clast::literals;

namespace {

template <class B> struct whole : triaxial_policies_default {
    using boundary = B;
    using breakage = criteria::none;
    using replacement = replacements::none;
};

struct seen {
    double worst = 0.0;   ///< largest imbalance over sections, over the axial force; mean of the last rows
    double unequal = 0.0; ///< of the two ends
    double q = 0.0, q_contacts = 0.0, error = 0.0, residual = 0.0;
};

/// A small specimen sheared to 6 %.
template <class B> seen sheared() {
    using test_type = triaxial_test<whole<B>>;
    test_type test({.grain = shapes::apollonian_14(circumscribed(0.02)),
                    .diameter = 75_mm,
                    .height = 150_mm,
                    .confining = 2_MPa,
                    .breakage = {},
                    .replacement = {},
                    .rings = 8,
                    .tiles_per_ring = 8,
                    .inertial_number = 1e-3},
                   protocol::triaxial_compression(6_percent));
    struct : observer {
        test_type* test = nullptr;
        seen sum;
        int rows = 0;
        void on_row(const sample& s) override {
            if (s.stage != "shear" || s.axial_strain < 0.04) return;
            const auto& sim = test->sim();
            const auto& b = sim.boundary;
            const double force = 0.5 * (sim.loads()[0].force + sim.loads()[1].force);
            double worst = 0.0;
            for (const double part : {0.25, 0.5, 0.75}) {
                const double z = b.bottom() + part * b.height();
                double below = 0.0;
                sim.each_wall_row([&](const auto& w) {
                    const auto& p = sim.grains.pebbles[static_cast<std::size_t>(w.pebble)];
                    for (const auto& t : w.touch)
                        if (!t.at_platen() && p.x.z - p.radius * t.normal.z < z) below += w.share(t) * t.normal.z;
                });
                const double areas = b.section_at(z - 1e-6) + b.section_at(z + 1e-6); // at an edge of rings: both
                worst = std::max(worst, std::abs(below - s.sigma_3 * (0.5 * areas - b.end_section(0))) / force);
            }
            const double ends = sim.loads()[1].force - sim.loads()[0].force;
            sum.worst += worst, ++rows;
            sum.unequal += std::abs(ends - s.sigma_3 * (b.end_section(1) - b.end_section(0))) / force;
            sum.q += s.q, sum.q_contacts += s.q_contacts, sum.error += s.confining_error;
            sum.residual = std::max(sum.residual, std::abs(s.energy_residual));
        }
    } watch;
    watch.test = &test;
    REQUIRE(test.run(watch));
    REQUIRE(watch.rows > 10);
    const double n = watch.rows;
    return {watch.sum.worst / n,      watch.sum.unequal / n, watch.sum.q / n,
            watch.sum.q_contacts / n, watch.sum.error / n,   watch.sum.residual};
}

} // namespace

TEST_CASE("joined tiles pass no load along the axis that a membrane cannot pass, and rectangles with ledges do") {
    const seen tiles = sheared<boundaries::tiles>();
    UNSCOPED_INFO("tiles " << tiles.worst << ", " << tiles.unequal << ", q " << tiles.q << " and " << tiles.q_contacts
                           << ", error " << tiles.error << ", residual " << tiles.residual);
    CHECK(tiles.worst < 0.02);
    CHECK(tiles.unequal < 0.02); // four grains across: at 12 cm it is 0.4 %
    CHECK(tiles.q_contacts == Approx(tiles.q).epsilon(0.01));
    CHECK(tiles.residual < 5e-3);
    const seen rings = sheared<boundaries::ring_walls>();
    UNSCOPED_INFO("rings " << rings.worst << ", " << rings.unequal << ", q " << rings.q << " and " << rings.q_contacts
                           << ", error " << rings.error << ", residual " << rings.residual);
    CHECK(rings.worst < 0.02);
    CHECK(rings.unequal < 0.01);
    CHECK(rings.q_contacts == Approx(rings.q).epsilon(0.01));
    CHECK(rings.residual < 5e-3);
    CHECK(sheared<boundaries::stepped_tiles>().worst > 0.03); // the way of looking sees it
}
