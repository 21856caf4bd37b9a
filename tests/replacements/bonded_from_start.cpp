// SPDX-License-Identifier: MIT
#include <clast/replacements/bonded_from_start.hpp>

#include <cstddef>
#include <cstdint>

#include <clast/criteria/weibull.hpp>
#include <clast/engine/engine.hpp>
#include <clast/measure/digest.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

static_assert(clast::replacements::replacing<clast::replacements::bonded_from_start>);

using namespace clast;

namespace {
struct bonded : scenes::breakable<> {
    using replacement = replacements::bonded_from_start;
};
struct scattered_strength : criteria::weibull<criteria::nominal_force> {
    scattered_strength(criteria::crushing_strength s) : weibull{{s}, 3.0, 0} {}
};
struct scattered : bonded {
    using breakage = scattered_strength;
};
} // namespace

TEST_CASE("all grains with bonds are clusters after the first look, whatever their load, the others stay") {
    bodies::clumps sp = scenes::empty(shapes::tetrahedron_4(circumscribed(0.02)));
    sp.shapes.push_back(shapes::sphere(0.01));
    sp.add(0, {}, {}), sp.add(1, {0.03, 0, 0}, {}), sp.add(0, {0, 0.03, 0}, {});
    engine<bonded> e(scenes::settings<bonded>(1e15), std::move(sp),
                     boundaries::solid_strips(scenes::cylinder(0.1, 0.2)));
    e.breakage_on = false;
    e.step(20);
    CHECK(e.totals().replaced == 0);
    e.breakage_on = true;
    e.step(e.settings.replacement.looks_every());
    CHECK(e.totals().replaced == 2);
    CHECK((e.grains.grains[0].cluster == 0 && e.grains.is_clump(1) && e.grains.grains[2].cluster == 1));
    CHECK(e.bonded_pairs().size() == 12);
    e.step(100);
    CHECK(e.totals().replaced == 2);
}

TEST_CASE("clusters of a loaded packing are born in equilibrium: nothing breaks, and no force jumps") {
    auto s = scenes::settings<bonded>(1e15, 1e6);
    auto e = scenes::packed<bonded>(s, shapes::tetrahedron_4(circumscribed(0.02)), 24, 0.055, 2e5, 6000);
    const double before = scenes::load(e), stored = e.elastic_energy();
    e.breakage_on = true;
    e.step(e.settings.replacement.looks_every() + 1);
    REQUIRE(e.totals().replaced == 24);
    CHECK(e.totals().bond_dissipation < 0.0); // bonds hold energy that no one has paid for
    CHECK(scenes::load(e) == Approx(before).epsilon(0.01));
    e.step(300);
    CHECK(e.totals().broken_tension + e.totals().broken_shear == 0);
    CHECK(e.kinetic_energy() < 1e-3 * stored);
    CHECK(e.elastic_energy() == Approx(stored).epsilon(0.03));
}

TEST_CASE("bonds are as strong as their grain among its like, and born without force if that is asked for") {
    auto s = scenes::settings<scattered>(1e15);
    s.replacement.how = replacements::birth::zero_force;
    engine<scattered> e = scenes::collision(s);
    e.step();
    REQUIRE(e.totals().replaced == 2);
    CHECK(e.totals().bond_dissipation == 0.0);
    const bonds::cluster_pool& pool = e.breakage().pools[0];
    // two equal bond states load a bond by the inverse of its strength
    while (pool.load_of(0, 0) == 0.0 || pool.load_of(1, 0) == 0.0) e.step();
    for (std::size_t c = 0; c < 2; ++c)
        CHECK(pool.load_of(c, 0) * s.breakage.strength_factor(static_cast<std::int64_t>(c)) ==
              Approx(bonds::load_ratio(pool.shape().bond[0], pool.get(c, 0))));
}
