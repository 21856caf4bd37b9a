// SPDX-License-Identifier: MIT
#include <clast/replacements/refreezing.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <clast/engine/engine.hpp>
#include <clast/io/archive.hpp>
#include <clast/measure/digest.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

static_assert(clast::replacements::replacing<clast::replacements::refreezing>);

using namespace clast;

namespace {
struct freezing : scenes::breakable<> {
    using replacement = replacements::refreezing;
};
} // namespace

TEST_CASE("a cluster at rest becomes rigid again where it is, with all bonds, and then asks for twice the rest") {
    engine<freezing> e = scenes::pressed(scenes::settings<freezing>(1e15), 400.0);
    const double left = scenes::residual(e), stored = e.elastic_energy();
    scenes::set_utilisation(e, 0.91); // the criterion wants it again each time
    const double force = scenes::load(e), kinetic = 1e-6 * stored;
    std::vector<double> spans;
    double since = 0.0;
    bool rigid = true;
    std::vector<vec3> places;
    for (int k = 0; k < 20000 && spans.size() < 3; ++k) {
        const auto before = e.grains.pebbles;
        e.step();
        CHECK(scenes::load(e) == Approx(force).epsilon(1e-4));
        CHECK(e.kinetic_energy() < kinetic);
        if (e.grains.is_clump(0) == rigid) continue;
        rigid = !rigid;
        e.place_all();
        for (std::size_t p = 0; p < 4; ++p) CHECK(norm(e.grains.pebbles[p].x - before[p].x) < 1e-9);
        if (!rigid) since = e.time();
        if (rigid) {
            spans.push_back(e.time() - since);
            CHECK(e.grains.shape_of(e.grains.grains[0]).bonds.size() == 6);
            CHECK((e.grains.grains[0].id == 0 && e.grains.grains[0].lost == 0));
            CHECK(std::abs(scenes::residual(e) - left) < 1e-6 * stored);
        }
    }
    REQUIRE(spans.size() == 3);
    const double look = 100 * e.dt();
    for (std::size_t k = 0; k < 3; ++k) {
        const double rest = std::ldexp(e.settings.replacement.rest, static_cast<int>(k));
        CHECK(spans[k] >= rest);
        CHECK(spans[k] < rest + 1.5 * look);
    }
}

TEST_CASE("a cluster whose bonds are loaded beyond the calm share stays a cluster") {
    auto s = scenes::settings<freezing>(1e15, 0.05);
    engine<freezing> e = scenes::pressed(s, 400.0);
    scenes::set_utilisation(e, 0.91);
    e.settings.replacement.calm = 1e-3;
    for (int k = 0; k < 3000; ++k) e.step();
    CHECK((e.totals().replaced == 1 && !e.grains.is_clump(0)));
    const bonds::cluster_pool& pool = e.breakage().pools[0];
    double worst = 0.0;
    for (std::size_t b = 0; b < 6; ++b) worst = std::max(worst, pool.load_of(0, b));
    CHECK((worst > 1e-3 && worst < 1.0));
}

TEST_CASE("in a crushed packing pieces become rigid and break on, on any number of threads and through checkpoints") {
    const auto crush = [](int threads, bool stored) {
        auto s = scenes::settings<freezing>(1e15, 0.05);
        s.run = execution(threads);
        s.contacts_per_thread = 8;
        s.replacement.rest = 2e-4, s.replacement.rest_interval = 20;
        auto e = scenes::packed<freezing>(s, shapes::apollonian_14(circumscribed(0.02)), 12, 0.04, 2e5, 2500);
        engine<freezing> fresh = e;
        const auto press = [](engine<freezing>& one) {
            one.settings.breakage.strength.sigma0 = 3e5;
            one.breakage_on = true;
            one.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.1};
        };
        press(e), press(fresh);
        while (e.grains.grain_count() < 14) e.step();
        e.take_events();
        if (stored) {
            from_bytes(to_bytes(e), fresh);
            std::swap(e, fresh);
        }
        e.step(1500);
        e.take_events();
        return e;
    };
    const auto digest_of = [](auto e) { return measure::digest_of_state(e); };
    const engine<freezing> one = crush(1, false);
    std::size_t frozen = 0, again = 0, bonds = 0;
    for (std::size_t g = 0; g < one.grains.grain_count(); ++g) {
        const grain& part = one.grains.grains[g];
        const bool piece = one.grains.shape_of(part).pebbles.size() > 1 && part.shape > 0;
        frozen += piece && one.grains.is_clump(g), again += piece && part.cluster >= 0;
        bonds += part.cluster >= 0
                     ? static_cast<std::size_t>(one.breakage().pools[static_cast<std::size_t>(part.shape)].intact_bonds(
                           static_cast<std::size_t>(part.cluster)))
                 : one.grains.is_clump(g) ? one.grains.shape_of(part).bonds.size()
                                          : 0;
    }
    CHECK((frozen > 2 && again > 0));
    const std::int64_t broken = one.totals().broken_tension + one.totals().broken_shear;
    CHECK(bonds == 12 * 36 - static_cast<std::size_t>(broken)); // broken ones stay broken, the others are there
    CHECK(digest_of(one) == digest_of(crush(3, false)));
    CHECK(digest_of(one) == digest_of(crush(2, true)));
    CHECK(to_bytes(one) == to_bytes(crush(3, true)));
}
