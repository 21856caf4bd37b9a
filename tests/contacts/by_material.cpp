// SPDX-License-Identifier: MIT
#include <clast/contacts/by_material.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <type_traits>

#include <clast/bodies/spheres.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/contacts/rolling.hpp>
#include <clast/measure/digest.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {
using two_rocks = contacts::by_material<contacts::linear, 2>;
static_assert(contacts::contact_law<two_rocks> && contacts::frictional<two_rocks>);
static_assert(contacts::contact_law<contacts::by_material<contacts::rolling<contacts::linear>, 3>>);
static_assert(contacts::resists_rotation<contacts::by_material<contacts::rolling<contacts::linear>, 3>>);
static_assert(!contacts::resists_rotation<two_rocks>);

const contacts::linear soft{1e6, 5e5, 0.2}, mixed{2e6, 1e6, 0.3}, hard{4e6, 2e6, 0.6};

two_rocks law() {
    return two_rocks::of([](std::size_t a, std::size_t b) { return a == 0 ? soft : b == 0 ? mixed : hard; });
}
contacts::overlap<double> between(double i, double j) {
    contacts::overlap<double> o{0, 0, 1, 1e-5, 100.0, 100.0};
    o.material_i = i, o.material_j = j;
    return o;
}

template <class Law> struct bundle : scenes::unbreakable_spheres<> { using contact = Law; };
/// Two spheres that hit each other off centre.
template <class Law> engine<bundle<Law>> hit(const Law& l, std::uint8_t first, std::uint8_t second) {
    bodies::spheres s;
    s.add({-0.0101, 0.002, 0}, 0.01), s.add({0.0101, -0.001, 0.001}, 0.01);
    s.pebbles[0].v = {1, 0, 0}, s.pebbles[1].v = {-1, 0.1, 0}, s.pebbles[0].w = {0, 5, 20};
    if constexpr (contacts::reads_materials<Law>()) s.set_material(0, first), s.set_material(1, second);
    return engine<bundle<Law>>({.grain_contact = l,
                                .platen_contact = l,
                                .lateral_contact = l,
                                .breakage = {},
                                .replacement = {},
                                .scheme = {.damping = 0.0},
                                .safety = 0.1,
                                .largest_step = 2e-6},
                               s, spaces::open{});
}
} // namespace

TEST_CASE("the pair of materials chooses the law, whichever is first, and a wall goes by the pebble") {
    const two_rocks l = law();
    CHECK(l.normal_stiffness(between(0, 0)) == soft.kn);
    CHECK(l.normal_stiffness(between(0, 1)) == mixed.kn);
    CHECK(l.normal_stiffness(between(1, 0)) == mixed.kn);
    CHECK(l.normal_stiffness(between(1, 1)) == hard.kn);
    CHECK(l.shear_stiffness(between(1, 1)) == hard.ks);
    CHECK(l.normal_stiffness(between(1, -1)) == hard.kn);
    CHECK(l.normal_stiffness(between(0, -1)) == soft.kn);
    CHECK(l.normal_stiffness(between(-1, -1)) == hard.kn); // not known: the stiffest
    CHECK(l.law(0, 1).mu == 0.3);
    CHECK(l.stored(between(0, 1), {}) == mixed.stored(between(0, 1), {}));
}

TEST_CASE("a bound of friction holds for all pairs, and without one every pair has its own") {
    two_rocks l = law();
    CHECK(l.mu == 0.6);
    contacts::motion<double> slide{};
    slide.ux = 1.0; // far beyond every slider
    const auto shear = [&](double i, double j) {
        contacts::shear_history h;
        return std::abs(l(between(i, j), slide, h, 1e-6).fx);
    };
    CHECK(shear(0, 0) == Approx(0.2 * soft.kn * 1e-5));
    CHECK(shear(0, 1) == Approx(0.3 * mixed.kn * 1e-5));
    CHECK(shear(1, 1) == Approx(0.6 * hard.kn * 1e-5));
    l.mu = 0.25;
    CHECK(shear(0, 0) == Approx(0.2 * soft.kn * 1e-5));
    CHECK(shear(0, 1) == Approx(0.25 * mixed.kn * 1e-5));
    CHECK(shear(1, 1) == Approx(0.25 * hard.kn * 1e-5));
}

TEST_CASE("spheres of two materials collide as spheres of the law of their pair do, to the last bit") {
    for (const auto& [first, second, alone] :
         {std::tuple(0, 0, soft), std::tuple(0, 1, mixed), std::tuple(1, 0, mixed), std::tuple(1, 1, hard)}) {
        auto by_pair = hit(law(), static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(second));
        auto plain = hit(alone, 0, 0);
        by_pair.step(2000), plain.step(2000);
        CHECK(plain.losses().friction > 0.0);
        CHECK(by_pair.dt() == 2e-6); // both at their bound, or they could not agree
        CHECK(plain.dt() == 2e-6);
        CHECK(measure::digest(by_pair) == measure::digest(plain));
    }
}

TEST_CASE("the stiffest law of all bounds the step before anything touches") {
    auto by_pair = hit(law(), 0, 0);
    auto plain = hit(hard, 0, 0);
    by_pair.settings.largest_step = plain.settings.largest_step = 1.0;
    by_pair.step(100), plain.step(100); // not in touch yet
    CHECK(plain.elastic_energy() == 0.0);
    CHECK(by_pair.dt() == plain.dt());
}

TEST_CASE("clumps of two materials and densities: heavier ones are, and friction is that of the pair") {
    struct rocks : scenes::unbreakable<> {
        using contact = two_rocks;
    };
    bodies::clumps s = scenes::empty(shapes::tetrahedron_4(circumscribed(0.02)));
    s.add(0, {-0.02, 0, 0}, {}), s.add(0, {0.02, 0, 0}, {}, 0.5);
    s.set_material(1, 1, 2.0);
    CHECK(s.body_mass(1) == Approx(0.25 * s.body_mass(0)).epsilon(1e-14));
    CHECK(s.body_inertia(1).x == Approx(s.body_inertia(0).x / 16.0).epsilon(1e-14));
    CHECK(s.ball_mass(4) == Approx(0.25 * s.body_mass(1)).epsilon(1e-14));
    CHECK(s.motion[1].inverse_mass == Approx(1.0 / s.body_mass(1)).epsilon(1e-14));
    s.set_velocity(0, {1, 0, 0}), s.set_velocity(1, {-1, 0, 0});
    engine<rocks> e({.grain_contact = law(),
                     .platen_contact = law(),
                     .lateral_contact = law(),
                     .breakage = {},
                     .replacement = {},
                     .scheme = {.damping = 0.0},
                     .safety = 0.05},
                    s, boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
    const vec3 p = scenes::momentum(e.grains);
    const double before = e.kinetic_energy();
    e.step(40000);
    CHECK(e.losses().friction > 0.0);
    CHECK(norm(scenes::momentum(e.grains) - p) < 1e-12 * norm(p));
    CHECK(e.kinetic_energy() + e.elastic_energy() + e.losses().friction == Approx(before).epsilon(1e-3));
}

TEST_CASE("a material that the law does not know is refused, with the numbers that it does") {
    std::string text;
    try {
        (void)hit(law(), 0, 2);
    } catch (const input_error& e) {
        text = e.what();
    }
    CHECK(text.find("material of a grain: '2'") == 0);
    CHECK(text.find("0 to 1") != std::string::npos);
}
