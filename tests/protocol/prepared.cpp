// SPDX-License-Identifier: MIT
#include <clast/protocol/prepared.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include <clast/boundaries/tiles.hpp>
#include <clast/io/archive.hpp>
#include <clast/measure/digest.hpp>

#include <catch.hpp>

#include "small_test.hpp"

using namespace clast;
using namespace small_test;

namespace {

using in_tiles = scenes::unbreakable<boundaries::tiles>;
using breaking = scenes::breakable<boundaries::tiles>;

template <class P> typename P::breakage strength_of() {
    if constexpr (P::breakage::evaluated)
        return {criteria::crushing_strength(1e9)}; // Pa: none breaks
    else
        return {};
}
template <class P> triaxial_setup<P> setup_of() {
    const triaxial_setup<rigid> s = setup();
    return {.grain = s.grain,
            .diameter = s.diameter,
            .height = s.height,
            .confining = s.confining,
            .breakage = strength_of<P>(),
            .replacement = {},
            .porosity = s.porosity,
            .rings = 4,
            .tiles_per_ring = 8,
            .inertial_number = 5e-3};
}
stage hurried() {
    stage s = consolidate();
    s.end = until::steps(1000);
    return s;
}
/// A specimen that went through a file.
template <class P> prepared_specimen prepared_in() {
    triaxial_test<P> first(setup_of<P>(), {compact(), rest(100)});
    observer quiet;
    REQUIRE(first.run(quiet));
    prepared_specimen p;
    from_bytes(to_bytes(first.protocol().prepared()), p);
    return p;
}

} // namespace

TEST_CASE("a specimen that was handed over goes on with the bits of one that was prepared in the same run") {
    const prepared_specimen p = prepared_in<in_tiles>();
    triaxial_test<in_tiles> whole(setup_of<in_tiles>(), {compact(), rest(100), hurried()});
    triaxial_test<in_tiles> second(setup_of<in_tiles>(), {compact(), rest(100), hurried()});
    recorder all, later;
    REQUIRE(whole.run(all));
    second.protocol().take_over(p);
    REQUIRE(second.run(later));
    CHECK(later.begun == names{"consolidate"});
    CHECK(measure::digest_of_state(second.sim()) == measure::digest_of_state(whole.sim()));
    const std::size_t before = all.rows.size() - later.rows.size();
    REQUIRE(all.rows[before].stage == "consolidate");
    REQUIRE(all.rows[before - 1].stage == "rest");
    for (std::size_t k = 0; k < later.rows.size(); ++k) {
        const sample &a = all.rows[before + k], &b = later.rows[k];
        CHECK(a.time == b.time);
        CHECK(a.steps == b.steps);
        CHECK(a.axial_strain == b.axial_strain);
        CHECK(a.sigma_3 == b.sigma_3);
        CHECK(a.kinetic_energy == b.kinetic_energy);
        CHECK(a.boundary_work == b.boundary_work);
        CHECK(a.energy_residual == b.energy_residual);
        CHECK(a.friction_dissipation == b.friction_dissipation);
    }
    CHECK(second.protocol().records().size() == 3);
    CHECK(second.protocol().records()[0].name == "compact");
    const sample& start = later.rows.front(); // at rest, with nothing that contacts remember
    CHECK(start.kinetic_energy == 0.0);
    CHECK(std::abs(later.rows.back().energy_residual) < 5e-3);
    // what was taken out at the hand-over is booked: the ledger misses as much after it as before
    const auto open = [](const sample& s, double initial) {
        return s.boundary_work + initial - s.kinetic_energy - s.elastic_energy - s.friction_dissipation -
               s.damping_dissipation;
    };
    const sample& last = all.rows[before - 1];
    const double held = last.kinetic_energy + last.elastic_energy; // J
    REQUIRE(held > 0.0);
    CHECK(std::abs(open(start, whole.sim().totals().initial_energy) - open(last, p.totals.initial_energy + held)) <
          0.1 * held);
}

TEST_CASE("one specimen stands in every membrane, and whether grains may break, at the same places to the last digit") {
    const prepared_specimen p = prepared_in<rigid>();
    const auto check = [&](auto policies) {
        using P = decltype(policies);
        struct looker : scene_observer<P> {
            const prepared_specimen* expected = nullptr;
            std::size_t moved = 0, rows = 0;
            void on_scene(const scene<P>& s, const sample& now) override {
                if (++rows > 1) return; // before the first step
                CHECK(now.kinetic_energy == 0.0);
                for (std::size_t g = 0; g < s.grains.grain_count(); ++g) {
                    const prepared_grain& there = expected->grains[g];
                    const quaternion& q = s.grains.turning[g].q;
                    moved += s.grains.centre(g) == there.x && q.w == there.q.w && q.x == there.q.x &&
                                     q.y == there.q.y && q.z == there.q.z
                                 ? 0u
                                 : 1u;
                }
                CHECK(s.boundary.radius() == expected->radius);
                CHECK(s.boundary.bottom() == expected->bottom);
            }
        } watch;
        watch.expected = &p;
        triaxial_test<P> test(setup_of<P>(), {compact(), hurried()});
        test.protocol().take_over(p);
        REQUIRE(test.run(watch));
        CHECK(watch.rows > 1);
        CHECK(watch.moved == 0);
    };
    check(rigid{});
    check(in_tiles{});
    check(breaking{});
}

TEST_CASE("a specimen of other grains, and a protocol that takes none over, are refused") {
    prepared_specimen p = prepared_in<rigid>();
    test_type no_stage(setup(), {compact(), rest(100)});
    CHECK_THROWS_WITH(no_stage.protocol().take_over(p), Catch::Contains("hands_over"));
    p.grains.pop_back();
    test_type other(setup(), {compact(), hurried()});
    CHECK_THROWS_WITH(other.protocol().take_over(p), Catch::Contains("prepared specimen"));
}
