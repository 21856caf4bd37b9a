// SPDX-License-Identifier: MIT
#include <clast/replacements/clusters.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/engine/engine.hpp>
#include <clast/replacements/bonded_from_start.hpp>

#include <catch.hpp>

#include "replacements/crushed.hpp"

using namespace clast;
using bonded = crushed::policies<replacements::bonded_from_start>;

TEST_CASE("pieces of a broken cluster become clumps with the bonds that they have left, single pebbles as is asked") {
    auto e = crushed::seated<replacements::bonded_from_start>(shapes::apollonian_14(circumscribed(0.02)), 0);
    e.drives.platens.value = 0.1;
    while (e.totals().broken_tension + e.totals().broken_shear == 0) e.step();
    e.step(20);
    for (const bool balls : {true, false}) {
        scene<bonded> s = e.state();
        rooms::surgery<scene<bonded>> room(s);
        const std::vector<std::int32_t> piece = room.pieces(0);
        const std::int32_t left = room.intact_bonds(0);
        const double mass = e.grains.body_mass(0);
        const auto count = *std::max_element(piece.begin(), piece.end()) + 1;
        REQUIRE((count > 1 && left > 0 && left < 36)); // corners have come off
        CHECK(replacements::freeze_pieces(0, balls, room) == count);
        room.finish();
        REQUIRE(s.grains.grain_count() == static_cast<std::size_t>(count));
        std::size_t singles = 0, bonds = 0;
        double sum = 0.0;
        std::vector<int> bond(36, 0);
        for (std::size_t g = 0; g < s.grains.grain_count(); ++g) {
            const shape& form = s.grains.shape_of(s.grains.grains[g]);
            const bool single = form.pebbles.size() == 1;
            singles += single, bonds += form.bonds.size(), sum += s.grains.body_mass(g);
            CHECK(s.grains.is_clump(g) == (!single || !balls));
            CHECK((s.grains.grains[g].origin == 0 && s.grains.grains[g].lost == 36 - left));
            for (const std::int32_t number : form.bond_numbers) ++bond.at(static_cast<std::size_t>(number));
            const index_range own = s.grains.pebbles_of(g); // which were one piece
            for (std::size_t p = own.begin; p < own.end; ++p)
                CHECK(piece[static_cast<std::size_t>(s.grains.numbers[p])] == static_cast<std::int32_t>(g));
        }
        CHECK(singles > 0);
        CHECK(s.broken.balls.size() == (balls ? singles : 0));
        CHECK(bonds == static_cast<std::size_t>(left));
        CHECK(std::count(bond.begin(), bond.end(), 1) == left); // each by its name, once
        CHECK(sum == Approx(mass).epsilon(1e-14));
    }
}

TEST_CASE("a grain that is single balls already stays so") {
    engine<bonded> e = scenes::collision(scenes::settings<bonded>(1e15));
    scene<bonded> s = e.state();
    rooms::surgery<scene<bonded>> room(s);
    room.release(0);
    CHECK(room.pieces(0) == std::vector<std::int32_t>{0, 1, 2, 3});
    CHECK(replacements::freeze_pieces(0, true, room) == 4);
    CHECK((s.grains.grain_count() == 2 && s.broken.balls.size() == 4));
    CHECK(replacements::freeze_pieces(0, false, room) == 4);
    CHECK((s.grains.grain_count() == 5 && s.broken.balls.empty()));
}
