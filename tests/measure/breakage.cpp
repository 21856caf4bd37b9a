// SPDX-License-Identifier: MIT
#include <clast/measure/breakage.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <clast/boundaries/solid_strips.hpp>
#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;
using measure::piece;
using measure::relative_breakage;

namespace {
/// Lets go of the second grain's pebbles, without bonds.
struct lets_go {
    static constexpr bool replaces = true, makes_bonds = true;
    bonds::parallel bond{};

    int looks_every() const { return 1; }
    template <class View> std::optional<replacements::nothing> wants(const View& clump) const {
        if (clump.utilisation() < 1.0) return std::nullopt;
        return replacements::nothing{};
    }
    template <class Surgery> void act(std::int32_t grain, replacements::nothing, Surgery& surgery) const {
        surgery.release(grain);
    }
};
struct second {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::needs::grain_id;
    double utilisation(const criteria::grain_load& load) const { return load.grain == 1 ? 2.0 : 0.0; }
};
struct crumbling : scenes::breakable<> {
    using breakage = second;
    using replacement = lets_go;
};
} // namespace

TEST_CASE("half of the mass of 10 mm goes to 1 mm: Hardin 0.5 / 2.1308, Einav 0.5 / 1.0857") {
    const relative_breakage of({{0.01, 3.0}, {0.01, 1.0}});
    CHECK(of.hardin({{0.01, 4.0}}) == Approx(0.0).margin(1e-15));
    CHECK(of.einav({{0.01, 4.0}}) == Approx(0.0).margin(1e-15));
    const std::vector<piece> now = {{0.01, 2.0}, {0.001, 1.5}, {0.001, 0.5}};
    CHECK(of.hardin(now) == Approx(0.234657).epsilon(1e-5));
    CHECK(of.einav(now) == Approx(0.460517).epsilon(1e-6));
    // below silt Hardin sees no difference, Einav does
    CHECK(of.hardin({{1e-5, 4.0}}) == Approx(1.0).epsilon(1e-14));
    CHECK(of.einav({{1e-5, 4.0}}) > of.einav({{7.4e-5, 4.0}}));
}

TEST_CASE("a grading between the initial and the ultimate one returns its breakage, after Einav") {
    // F_u = (d / d_M)^0.4 in equal shares of mass, and a grading of two sizes at the start
    const std::vector<piece> initial = {{0.02, 1.0}, {0.01, 1.0}};
    const relative_breakage of(initial);
    for (const double b : {0.0, 0.25, 0.7, 1.0}) {
        std::vector<piece> now;
        for (const piece& p : initial) now.push_back({p.size, (1.0 - b) * p.mass});
        const int n = 20000;
        for (int k = 0; k < n; ++k) now.push_back({0.02 * std::pow((k + 0.5) / n, 2.5), b * 2.0 / n});
        CHECK(of.einav(now) == Approx(b).margin(1e-4));
    }
}

TEST_CASE("pieces of a specimen: grains, and fragments that bonds join, with all of the mass") {
    bodies::clumps rock = scenes::empty(shapes::tetrahedron_4(0.02));
    rock.add(0, {}, {});
    rock.add(0, {0.03, 0, 0}, {});
    engine<crumbling> e({.grain_contact = contacts::linear::between(scenes::pebble, scenes::pebble),
                         .platen_contact = {},
                         .lateral_contact = {},
                         .breakage = {},
                         .replacement = {}},
                        std::move(rock), boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
    const double mass = e.grains.mass_of(e.grains.grains[0]), r = e.grains.pebbles[0].radius;
    auto pieces = measure::pieces_of(e);
    REQUIRE(pieces.size() == 2);
    for (const piece& p : pieces) {
        CHECK(p.size == Approx(0.02).epsilon(1e-14));
        CHECK(p.mass == Approx(mass).epsilon(1e-14));
    }
    // of a regular tetrahedron of balls every extent along its axes is that of an edge of the cube around their centres
    CHECK(measure::pieces_of(e, measure::size_of::sieve)[0].size == Approx((2.0 + std::sqrt(2.0)) * r).epsilon(1e-12));

    const relative_breakage of(pieces);
    e.breakage_on = true;
    e.step(2); // four loose balls
    pieces = measure::pieces_of(e);
    REQUIRE(pieces.size() == 5);
    double sum = 0.0;
    for (const piece& p : pieces) sum += p.mass;
    CHECK(sum == Approx(2.0 * mass).epsilon(1e-14));
    CHECK(pieces[1].size == Approx(2.0 * r).epsilon(1e-14));
    // half of the mass to the size of a quarter of the volume
    const double step = 0.5 * std::log10(std::cbrt(4.0));
    CHECK(of.hardin(pieces) == Approx(step / std::log10(0.02 / 7.4e-5)).epsilon(1e-12));
    CHECK(of.einav(pieces) == Approx(step * 0.4 * std::log(10.0)).epsilon(1e-12));
}

TEST_CASE("a sieve holds a piece by its second extent") {
    const auto of = [](std::vector<shape_pebble> balls) { return measure::detail::second_extent(balls); };
    CHECK(of({{{1, 2, 3}, 0.5}}) == 1.0);
    CHECK(of({{{0, 0, 0}, 1.0}, {{2, 0, 0}, 1.0}, {{4, 0, 0}, 1.0}}) == Approx(2.0));                   // a rod
    CHECK(of({{{0, 0, 0}, 1.0}, {{0, 2, 0}, 1.0}, {{0, 4, 0}, 1.0}, {{2, 2, 0}, 1.0}}) == Approx(4.0)); // flat
}
