// SPDX-License-Identifier: MIT
#include <clast/engine/step_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/constraints/held.hpp>
#include <clast/engine/engine.hpp>
#include <clast/io/archive.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {
using spheres_alone = scenes::unbreakable_spheres<>;
constexpr double kn = 1e6, ks = 5e5, r = 0.01;

/// n spheres in a row, overlapping by a hundredth.
engine<spheres_alone> row(int n, double largest_step = 1.0) {
    bodies::spheres s;
    for (int k = 0; k < n; ++k) s.add({1.99 * r * k, 0.0, 0.0}, r);
    return engine<spheres_alone>({.grain_contact = {kn, ks, 0.3},
                                  .platen_contact = {},
                                  .lateral_contact = {},
                                  .breakage = {},
                                  .replacement = {},
                                  .safety = 0.5,
                                  .largest_step = largest_step},
                                 s, spaces::open{});
}
} // namespace

TEST_CASE("the step is that of the body with the stiffest contacts, by hand") {
    const double m = 2650.0 * sphere_volume(r), inertia = 2650.0 * sphere_inertia_per_density(r);
    const double arm = 0.995 * r; // to the middle of the overlap
    for (const int contacts : {1, 2}) {
        const double translation = contacts * kn / m, rotation = contacts * ks * arm * arm / inertia;
        const double by_contacts = 0.5 / std::sqrt(std::max(translation, rotation));
        const double typical = 0.5 * std::sqrt(m / (kn + 2.0 * ks)); // three contacts of mean stiffness
        CHECK(row(contacts + 1).dt() == Approx(std::min(by_contacts, typical)).epsilon(1e-12));
    }
    CHECK(row(1).dt() == Approx(0.5 * std::sqrt(m / (kn + 2.0 * ks))).epsilon(1e-12));
    CHECK(row(3, 1e-7).dt() == 1e-7);
}

TEST_CASE("what is soft and heavy takes long steps, as long as its contacts allow, unless it is told otherwise") {
    bodies::spheres s;
    s.add({}, 1.0);
    engine_settings<spheres_alone> soft{.grain_contact = {1e4, 1e4, 0.3},
                                        .platen_contact = {},
                                        .lateral_contact = {},
                                        .breakage = {},
                                        .replacement = {}};
    const double typical = 0.8 * std::sqrt(2650.0 * sphere_volume(1.0) / 3e4);
    CHECK(typical > 0.4);
    CHECK(engine<spheres_alone>(soft, s, spaces::open{}).dt() == Approx(typical).epsilon(1e-12));
    soft.largest_step = 1e-4;
    CHECK(engine<spheres_alone>(soft, s, spaces::open{}).dt() == 1e-4);
}

TEST_CASE("a scene without bodies can be made, to read one into it, but makes no step") {
    engine<spheres_alone> full = row(2), empty = row(0, std::numeric_limits<double>::infinity());
    CHECK(empty.dt() == 0.0);
    CHECK_THROWS_AS(empty.step(), input_error);
    from_bytes(to_bytes(full), empty);
    full.step(100), empty.step(100);
    CHECK(empty.dt() == full.dt());
    CHECK(checksum(empty) == checksum(full));
}

namespace {
struct held_spheres : spheres_alone {
    using constraint = constraints::held;
};
} // namespace

TEST_CASE("fixed bodies do not limit the step, and where all are fixed it is that of the lightest") {
    bodies::spheres s;
    s.add({}, r), s.add({0.1, 0.0, 0.0}, 0.5 * r);
    engine<held_spheres> e({.grain_contact = {kn, ks, 0.3},
                            .platen_contact = {},
                            .lateral_contact = {},
                            .breakage = {},
                            .replacement = {}},
                           s, spaces::open{});
    const auto of = [](double radius) { return 0.8 * std::sqrt(2650.0 * sphere_volume(radius) / (kn + 2.0 * ks)); };
    CHECK(e.dt() == Approx(of(0.5 * r)).epsilon(1e-12));
    scene<held_spheres> now = e.state();
    now.constraint.fix(1);
    rooms::estimate_step(now, true);
    CHECK(now.dt == Approx(of(r)).epsilon(1e-12));
    now.constraint.fix(0);
    rooms::estimate_step(now, true);
    CHECK(now.dt == Approx(of(0.5 * r)).epsilon(1e-12));
}

TEST_CASE("a count of contacts that surely allows a step never hides a stiffer body") {
    const auto e = row(4);
    scene<spheres_alone> s = e.state();
    s.index_heavy();
    for (std::size_t b = 0; b < 4; ++b)
        for (double step = 1e-7; step < 1e-3; step *= 1.3) {
            if (!rooms::surely_allows(s, b, step)) continue;
            stiffness_sum k(mat3::identity());
            rooms::add_stiffness(s, k, *s.heavy_of, b, s.heavy, s.heavy_wall, s.grains.centre(b));
            CHECK(k.time_step(s.grains.body_mass(b), s.grains.body_inertia(b), s.settings.safety) >= step);
        }
    CHECK(rooms::surely_allows(s, 0, 1e-7));
}

namespace {
/// Hertz without friction, which begins without any stiffness.
struct hertz {
    struct history {};
    double modulus = 0.0;
    contacts::response<double> operator()(const contacts::overlap<double>& o, const contacts::motion<double>&, history&,
                                          double) const {
        if (o.depth <= 0.0) return {};
        const double f = 4.0 / 3.0 * modulus * std::sqrt(o.reduced_radius() * o.depth) * o.depth;
        return {-f * o.nx, -f * o.ny, -f * o.nz, 0.0};
    }
    double stored(const contacts::overlap<double>& o, const history&) const {
        return o.depth > 0.0 ? 8.0 / 15.0 * modulus * std::sqrt(o.reduced_radius() * o.depth) * o.depth * o.depth : 0.0;
    }
    double normal_stiffness(const contacts::overlap<double>& o) const {
        return 2.0 * modulus * std::sqrt(o.reduced_radius() * std::max(o.depth, 0.0));
    }
    double shear_stiffness(const contacts::overlap<double>&) const { return 0.0; }
};
struct of_hertz : spheres_alone {
    using contact = hertz;
};
} // namespace

TEST_CASE("a law that begins without stiffness gets a step that its first collision allows, and keeps its energy") {
    // Hertz: the deepest overlap of a central collision is (15 m v^2 / (16 E R^(1/2)))^(2/5) with the reduced m
    const double modulus = 1e9, m = 2650.0 * sphere_volume(r), v = 2.0; // each (m/s)
    const double deepest = std::pow(15.0 * 0.5 * m * 4.0 * v * v / (16.0 * modulus * std::sqrt(0.5 * r)), 0.4);
    bodies::spheres s;
    s.add({-1.5 * r, 0, 0}, r), s.add({1.5 * r, 0, 0}, r);
    s.pebbles[0].v = {v, 0, 0}, s.pebbles[1].v = {-v, 0, 0};
    engine<of_hertz> e({.grain_contact = {modulus},
                        .platen_contact = {},
                        .lateral_contact = {},
                        .breakage = {},
                        .replacement = {},
                        .scheme = {.damping = 0.0},
                        .safety = 0.2,
                        .largest_step = 1.0},
                       s, spaces::open{});
    const double stiffest = 2.0 * modulus * std::sqrt(0.5 * r * deepest);
    CHECK(e.dt() <= 0.2 * std::sqrt(m / stiffest)); // from the first step on
    CHECK(e.dt() >= 0.05 * std::sqrt(m / stiffest));
    const double before = e.kinetic_energy();
    double found = 0.0;
    while (e.grains.pebbles[0].v.x > -0.5 * v || found == 0.0) {
        e.step();
        e.each_contact([&](const force_row& one, const pebble_pair&) { found = std::max(found, one.depth); });
        REQUIRE(e.time() < 1.0);
    }
    while (e.elastic_energy() > 0.0) e.step();
    CHECK(found == Approx(deepest).epsilon(0.02));
    CHECK(e.kinetic_energy() == Approx(before).epsilon(1e-3));
}

TEST_CASE(
    "walls that are about to move shorten the step of such a law for what they press in before the next estimate") {
    const double modulus = 1e9, m = 2650.0 * sphere_volume(r), v = 0.1; // m/s
    bodies::spheres s;
    s.add({-1.5 * r, 0, 0}, r), s.add({1.5 * r, 0, 0}, r);
    engine<of_hertz> e({.grain_contact = {modulus},
                        .platen_contact = {},
                        .lateral_contact = {},
                        .breakage = {},
                        .replacement = {},
                        .safety = 0.5,
                        .largest_step = 1e-4},
                       s, spaces::open{});
    CHECK(e.dt() == 1e-4); // at rest, and free
    e.expect_speed(v);
    const double depth = v * 1e-4 * 50.0; // in fifty steps (m)
    const double k = 2.0 * modulus * std::sqrt(0.5 * r * depth) / 3.0;
    CHECK(e.dt() == Approx(0.5 * std::sqrt(m / (3.0 * k))).epsilon(1e-12));
    const double before = e.dt();
    e.expect_speed(0.0);
    CHECK(e.dt() == before);
    auto linear = row(2);
    const double step = linear.dt();
    linear.expect_speed(100.0); // a stiffness that does not change
    CHECK(linear.dt() == step);
}
