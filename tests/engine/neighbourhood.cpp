// SPDX-License-Identifier: MIT
#include <clast/engine/neighbourhood.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <clast/engine/engine.hpp>
#include <clast/io/archive.hpp>
#include <clast/searches/brute_force.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using rigid = scenes::unbreakable<>;
struct looks_at_all : rigid {
    using search = searches::brute_force;
};

} // namespace

TEST_CASE("lists never miss a contact: any skin and any search give the same bits") {
    const auto run = [](auto bundle, double skin) {
        using P = decltype(bundle);
        auto s = scenes::settings<P>();
        s.skin = skin;
        auto e = scenes::packed<P>(s, shapes::tetrahedron_4(circumscribed(0.02)), 24, 0.055, 2e5, 3000);
        e.place_all(); // pebbles that no list names are placed on demand
        return std::pair(checksum(e.grains), e.totals().renewals);
    };
    const auto reference = run(looks_at_all{}, 1e-7);
    const auto wide = run(rigid{}, 4e-3);
    const auto usual = run(rigid{}, 5e-4);
    CHECK(reference.second > 1000); // renewed in nearly every step
    CHECK(wide.second < reference.second / 4);
    CHECK(wide.first == reference.first);
    CHECK(usual.first == reference.first);
}

TEST_CASE("every overlap at the time of a step, of pebbles or with a facet, has its force in that step") {
    auto s = scenes::settings<rigid>();
    auto e = scenes::packed<rigid>(s, shapes::tetrahedron_4(circumscribed(0.02)), 24, 0.055, 2e5, 4000);
    std::size_t met = 0, missed = 0, walls = 0;
    for (int k = 0; k < 400; ++k) {
        e.place_all();
        std::vector<vec3> x;
        for (const auto& p : e.grains.pebbles) x.push_back(p.x);
        const auto boundary = e.boundary;
        e.step();
        for (std::size_t i = 0; i < x.size(); ++i) {
            for (std::size_t j = i + 1; j < x.size(); ++j) {
                if (e.grains.owner[i] == e.grains.owner[j]) continue;
                if (norm(x[j] - x[i]) >= e.grains.pebbles[i].radius + e.grains.pebbles[j].radius) continue;
                ++met;
                const auto& list = e.heavy_contacts();
                const pebble_pair pair{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)};
                const auto at = scenes::position(list, pair);
                if (at == list.size() || !(list.rows[at].depth > 0.0)) ++missed;
            }
            if (boundary.touch(x[i], e.grains.pebbles[i].radius).size == 0) continue;
            ++walls;
            bool found = false;
            e.each_wall_row([&](const auto& w) {
                found = found || (w.pebble == static_cast<std::int32_t>(i) && w.touch.size > 0);
            });
            if (!found) ++missed;
        }
    }
    CHECK(met > 1000);
    CHECK(walls > 1000);
    CHECK(missed == 0);
}
