// SPDX-License-Identifier: MIT
#include <clast/measure/stress.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/core/random.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using rigid = scenes::unbreakable<>;
constexpr double r = 0.01;

/// Spheres in a column between platens that overlap their neighbours and the platens by `depth`.
engine<rigid> column(std::size_t count, double depth) {
    bodies::clumps sp = scenes::empty(shapes::sphere(2.0 * r));
    for (std::size_t k = 0; k < count; ++k)
        sp.add(0, {0, 0, (2.0 * r - depth) * (static_cast<double>(k) - 0.5 * static_cast<double>(count - 1))}, {});
    const double height = 2.0 * r + (2.0 * r - depth) * static_cast<double>(count - 1) - 2.0 * depth;
    auto s = scenes::settings<rigid>();
    s.platen_contact = s.grain_contact; // one stiffness: one force all along the column
    engine<rigid> e(s, std::move(sp), boundaries::solid_strips(scenes::cylinder(0.03, height, r)));
    e.step();
    return e;
}

} // namespace

TEST_CASE("Love-Weber stress of spheres squeezed between platens is force over section") {
    for (const double depth : {1e-5, 5e-4}) // the last is an overlap of a twentieth of the radius
        for (const std::size_t count : {1u, 2u, 3u, 5u}) {
            const engine<rigid> e = column(count, depth);
            const double force = 2.9e6 * depth, volume = e.boundary.volume();
            CHECK(e.loads()[boundaries::top_platen].force == Approx(force).epsilon(1e-9));
            const mat3 s = measure::love_weber(e, volume);
            // an octagon around a circle of 3 cm: 8 R^2 tan(pi / 8)
            const double section = 8.0 * 0.03 * 0.03 * std::tan(std::numbers::pi / 8.0);
            CHECK(s(2, 2) == Approx(force / section).epsilon(1e-9));
            CHECK(std::abs(s(0, 0)) + std::abs(s(1, 1)) + std::abs(s(0, 2)) < 1e-9 * s(2, 2));
        }
}

namespace {
struct boxed : rigid {
    using boundary = boundaries::box;
    using body = bodies::spheres;
};
} // namespace

TEST_CASE("grains at rest in a box under one stress: contacts carry what walls do, at any overlap") {
    for (const double stress : {2e4, 2e6}) {
        bodies::spheres grains;
        constexpr int n = 4;
        const double apart = 0.0215, half = 0.5 * n * apart;
        for (int k = 0; k < n * n * n; ++k) {
            random_stream random{7, static_cast<std::uint64_t>(k)};
            const auto at = [&](int i) { return apart * (i - 0.5 * (n - 1)); };
            grains.add({at(k % n), at(k / n % n), at(k / n / n)}, r);
            grains.pebbles.back().v = 0.05 * direction(random);
        }
        auto s = scenes::settings<boxed>();
        s.grain_contact.mu = 0.0;
        engine<boxed> e(s, std::move(grains),
                        boundaries::box({{-half, -half, -half}, {half, half, half}, 3.2e8, s.platen_contact.kn}));
        e.drives = scenes::isotropic(stress, 0.3);
        for (int k = 0; k < 600 && (k < 50 || measure::contacts_of(e).unbalanced_ratio > 1e-8); ++k) e.step(100);
        REQUIRE(measure::contacts_of(e).unbalanced_ratio < 1e-7);
        const mat3 lw = measure::love_weber(e, e.boundary.volume());
        for (int a = 0; a < 3; ++a) {
            CHECK(lw(a, a) == Approx(stress).epsilon(1e-6));
            CHECK(lw(a, a) == Approx(e.boundary.stress(e.loads(), a)).epsilon(1e-6));
        }
    }
}

TEST_CASE("the mean stress in a sphere counts the branches whose contact lies inside") {
    const double depth = 1e-5, force = 2.9e6 * depth;
    const engine<rigid> e = column(3, depth); // contacts at about -r, r and at both platens
    const double inner = 1.5 * r, volume = 4.0 / 3.0 * std::numbers::pi * inner * inner * inner;
    CHECK(measure::mean_stress_in_sphere(e, {}, inner) ==
          Approx(2.0 * force * (2.0 * r - depth) / (3.0 * volume)).epsilon(1e-9));
    CHECK(measure::mean_stress_in_sphere(e, {}, 0.5 * r) == 0.0);
}

TEST_CASE("contacts of a column: coordination, overlap, mean force and rest") {
    const double depth = 1e-5, force = 2.9e6 * depth;
    const measure::contact_state c = measure::contacts_of(column(4, depth));
    CHECK(c.contacts == 3);
    CHECK(c.coordination == 1.5); // 3 pairs of 4 bodies
    CHECK(c.mean_contact_force == Approx(force).epsilon(1e-9));
    CHECK(c.max_overlap_over_r == Approx(depth / r).epsilon(1e-9));
    CHECK(c.median_overlap_over_r == Approx(depth / r).epsilon(1e-9));
    CHECK(c.passing == Approx(depth / r).epsilon(1e-9));
    CHECK(c.unbalanced_ratio < 1e-9);
    const measure::contact_state open = measure::contacts_of(column(2, -1e-5));
    CHECK(open.contacts == 0);
    CHECK(open.coordination == 0.0);
    CHECK(open.unbalanced_ratio == 0.0);
}

TEST_CASE("overlaps are those of all touching contacts, at platens and wall, too") {
    // a column of three: 0.1 and 0.2 mm between spheres, 0.3 mm at the bottom, 0.5 mm at the top, and one sphere alone
    // that the wall touches by 0.7 mm
    bodies::clumps sp = scenes::empty(shapes::sphere(2.0 * r));
    double z = -0.03 + r - 3e-4;
    for (const double overlap : {1e-4, 2e-4, 0.0}) sp.add(0, {0, 0, z}, {}), z += 2.0 * r - overlap;
    const double top = z - 2.0 * r + r - 5e-4;
    sp.add(0, {0.05 - r + 7e-4, 0, 0.0}, {}); // against the middle of a tile
    boundaries::cylinder_settings around = scenes::cylinder(0.05, 0.06, r);
    around.bottom = -0.03, around.top = top;
    engine<rigid> e(scenes::settings<rigid>(), std::move(sp), boundaries::solid_strips(around));
    e.step();
    const measure::contact_state c = measure::contacts_of(e);
    CHECK(c.contacts == 2);
    CHECK(c.max_overlap_over_r == Approx(7e-4 / r).epsilon(1e-9));
    CHECK(c.median_overlap_over_r == Approx(3e-4 / r).epsilon(1e-9));
    CHECK(c.passing_i == 3);
    CHECK(c.passing_j == measure::contact_state::at_wall);
}

TEST_CASE("a pebble that is small in its grain may be inside of what it touches") {
    // a sphere of 10 mm and one of 1 mm or 6 mm that stands on it, and a grain that is a sphere of 1 mm
    const auto grain = [](double small) {
        return make_shape("studded", std::vector<shape_pebble>{{{0, 0, 0}, r}, {{0, 0, r + small}, small}});
    };
    bodies::clumps sp;
    sp.shapes = {grain(1e-3), grain(6e-3), shapes::sphere(2e-3)};
    for (int k = 0; k < 3; ++k) sp.add(k, {0.1 * k, 0, 0}, {});
    engine<rigid> e(scenes::settings<rigid>(), std::move(sp),
                    boundaries::solid_strips(scenes::cylinder(0.5, 0.5, 1e-3)));
    CHECK(measure::passing_overlap(e, 0) == Approx(r));       // the large sphere
    CHECK(measure::passing_overlap(e, 1) == Approx(0.5 * r)); // half of the one behind it
    CHECK(measure::passing_overlap(e, 3) == Approx(6e-3));    // large enough to be looked at by itself
    CHECK(measure::passing_overlap(e, 4) == Approx(1e-3));    // small, but all that its grain has
    CHECK(measure::passing_overlap(e, 4, 0) == Approx(r));    // in a large one, far from its centre
}

TEST_CASE("a body that no other balances shows in the unbalanced ratio") {
    bodies::clumps sp = scenes::empty(shapes::sphere(2.0 * r));
    sp.add(0, {0, 0, -0.5 * r}, {});
    sp.add(0, {0, 0, 1.5 * r - 1e-5}, {}); // pushed up by the other, held by nothing
    auto s = scenes::settings<rigid>();
    s.platen_contact = s.grain_contact;
    engine<rigid> e(s, std::move(sp), boundaries::solid_strips(scenes::cylinder(0.03, 0.2, r)));
    e.step();
    const measure::contact_state c = measure::contacts_of(e);
    CHECK(c.unbalanced_ratio == Approx(1.0).epsilon(1e-9)); // force over mean sum of forces: F / F
    CHECK(c.passing_i == 0);
    CHECK(c.passing_j == 1);
}

TEST_CASE("in a packing at rest under one stress all round, contacts and walls agree") {
    auto e = scenes::packed<rigid>(scenes::settings<rigid>(), shapes::tetrahedron_4(circumscribed(0.02)), 50, 0.07, 2e5,
                                   9000);
    e.drives = scenes::isotropic(2e5, 0.02);
    for (int k = 0; k < 3000; ++k) e.step();
    const mat3 s = measure::love_weber(e, e.boundary.volume());
    REQUIRE(measure::contacts_of(e).unbalanced_ratio < 1e-3);
    CHECK(e.boundary.axial_stress(e.loads()) == Approx(2e5).epsilon(1e-3));
    CHECK(s(2, 2) == Approx(e.boundary.axial_stress(e.loads())).epsilon(1e-4));
    CHECK(0.5 * (s(0, 0) + s(1, 1)) == Approx(e.boundary.lateral_stress(e.loads())).epsilon(1e-4));
    CHECK(std::abs(s(0, 1) - s(1, 0)) < 1e-4 * s(2, 2)); // moments balance
}

TEST_CASE("bonds of a cluster carry the stress that its clump did") {
    using brittle = scenes::breakable<>;
    const shape grain = shapes::tetrahedron_4(circumscribed(0.02));
    bodies::clumps sp = scenes::empty(grain);
    sp.add(0, {}, scenes::turning(unit(vec3{1, 1, 1}), {0, 0, 1}));
    const boundaries::cylinder_settings c = scenes::cylinder_around(sp, 2e-5);
    engine<brittle> e(scenes::settings<brittle>(1e15), std::move(sp), boundaries::solid_strips(c));
    for (int k = 0; k < 3000; ++k) e.step();
    const mat3 clump = measure::love_weber(e, 1e-4);
    e.settings.breakage.strength.sigma0 = e.loads()[boundaries::top_platen].force / (0.95 * 0.02 * 0.02);
    for (int k = 0; k < 100; ++k) e.step();
    REQUIRE(e.totals().replaced == 1);
    REQUIRE(e.totals().broken_shear + e.totals().broken_tension == 0);
    const mat3 cluster = measure::love_weber(e, 1e-4);
    CHECK(clump(2, 2) > 0.0);
    CHECK(cluster(2, 2) == Approx(clump(2, 2)).epsilon(2e-3));
    CHECK(std::abs(cluster(0, 0)) < 2e-3 * clump(2, 2)); // nothing pushes from the side
    const measure::contact_state state = measure::contacts_of(e);
    CHECK(state.coordination == 0.0); // a cluster is one body
    CHECK(state.unbalanced_ratio < 1e-3);
}
