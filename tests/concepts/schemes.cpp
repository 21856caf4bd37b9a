// SPDX-License-Identifier: MIT
// What a scheme may be, in an engine: several evaluations of forces in a step, a memory, a turn of its own.
#include <clast/integrators/concepts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/io/archive.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

/// The poorest one.
struct archetype {
    struct memory {};
    static constexpr std::array<integrators::stage, 1> stages{{{1.0, 1.0}}};
    vec3 extra(const vec3&, const vec3&) const { return {}; }
    vec3 kick(const vec3& v, const vec3& force, double by) const { return v + by * force; }
};
static_assert(integrators::scheme<archetype> && !integrators::multirate<archetype>); // no damping for bonds
static_assert(integrators::multirate<integrators::leapfrog>);
static_assert(!integrators::scheme<int>);

/// Forest and Ruth 1990, doi:10.1016/0167-2789(90)90019-L: fourth order in three evaluations. Between steps places are
/// ahead of velocities by half the last drift.
struct forest_ruth : archetype {
    static constexpr double theta = 1.3512071919596578;
    static constexpr std::array<integrators::stage, 3> stages{
        {{theta, 0.5 * (1.0 - theta)}, {1.0 - 2.0 * theta, 0.5 * (1.0 - theta)}, {theta, theta}}};
};
static_assert(!integrators::multirate<forest_ruth>);

/// Counts its kicks.
struct counts : archetype {
    struct memory {
        double kicks = 0.0;
    };
    vec3 kick(const vec3& v, const vec3& force, double by, memory& m) const {
        m.kicks += 1.0;
        return v + by * force;
    }
};
/// Turns by the full method, one body at a time.
struct turns : integrators::leapfrog {
    turned turn(const quaternion& q, const vec3& l, const vec3& inverse, double dt) const {
        return advance_rotation(q, l, inverse, dt);
    }
};
static_assert(integrators::turns_itself<turns> && !integrators::multirate<turns>);

template <class Scheme, class Body> struct bundle : scenes::unbreakable<> {
    using scheme = Scheme;
    using body = Body;
};
template <class Scheme> struct pair_of_spheres : bundle<Scheme, bodies::spheres> { using boundary = boundaries::none; };

/// Largest error of the energy of two spheres that a spring pushes apart, over the energy; ahead: by how much of a step
/// places are ahead of velocities.
template <class Scheme> double energy_error(double safety, double ahead) {
    constexpr double k = 1e6, r = 0.01, depth = 1e-4;
    bodies::spheres s;
    s.add({-r + 0.5 * depth, 0, 0}, r), s.add({r - 0.5 * depth, 0, 0}, r);
    const double m = s.body_mass(0), energy = 0.5 * k * depth * depth;
    engine<pair_of_spheres<Scheme>> probe({.grain_contact = {k, 0.0, 0.0},
                                           .platen_contact = {},
                                           .lateral_contact = {},
                                           .breakage = {},
                                           .replacement = {},
                                           .safety = safety},
                                          s, spaces::open{});
    // a quarter of the period; velocities of leapfrog begin half a step earlier
    const double end = 0.45 * 3.14159265358979 * std::sqrt(0.5 * m / k);
    auto e = probe;
    if (Scheme::stages.size() == 1)
        for (int i : {0, 1})
            e.grains.pebbles[static_cast<std::size_t>(i)].v.x = (i == 0 ? 0.5 : -0.5) * e.dt() * k * depth / m;
    double worst = 0.0;
    while (e.time() < end) {
        e.step();
        const double v = e.grains.pebbles[1].v.x, x = e.grains.pebbles[1].x.x - ahead * e.dt() * v;
        const double d = 2.0 * (r - x);
        worst = std::max(worst, std::abs(m * v * v + 0.5 * k * d * d - energy) / energy);
    }
    return worst;
}

} // namespace

TEST_CASE("several evaluations of forces make a step: order two and order four, as theory says") {
    // leapfrog: places are half a step ahead of velocities
    const double two = energy_error<archetype>(0.2, 0.5), half = energy_error<archetype>(0.1, 0.5);
    CHECK(two / half == Approx(4.0).epsilon(0.1));
    const double four = energy_error<forest_ruth>(0.2, 0.5 * forest_ruth::theta),
                 fourth = energy_error<forest_ruth>(0.1, 0.5 * forest_ruth::theta);
    CHECK(four / fourth == Approx(16.0).epsilon(0.15));
    CHECK(fourth < 0.05 * half);
}

TEMPLATE_TEST_CASE("what a scheme remembers of each body is kept, and saved", "", bodies::spheres, bodies::clumps) {
    using P = bundle<counts, TestType>;
    TestType s;
    if constexpr (TestType::turns) {
        s.shapes = {shapes::tetrahedron_4(circumscribed(0.02))};
        s.add(0, {0, 0, 0}, {}), s.add(0, {0.05, 0, 0}, {});
    } else
        s.add({0, 0, 0}, 0.01), s.add({0.05, 0, 0}, 0.01);
    engine<P> e(scenes::settings<P>(), s, boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
    e.step(7);
    engine<P> other(scenes::settings<P>(), s, boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
    from_bytes(to_bytes(e), other);
    other.step(2);
    REQUIRE(other.state().memory.size() == 2);
    for (const auto& m : other.state().memory) CHECK((m.translation.kicks == 9.0 && m.rotation.kicks == 9.0));
    static_assert(std::is_empty_v<decltype(scene<bundle<archetype, TestType>>::memory)>);
}

TEST_CASE("a turn of its own takes the place of the library's") {
    using own = bundle<turns, bodies::clumps>;
    using usual = bundle<integrators::leapfrog, bodies::clumps>;
    auto a = scenes::collision(scenes::settings<own>());
    auto b = scenes::collision(scenes::settings<usual>());
    a.step(2000), b.step(2000);
    CHECK(b.losses().friction > 0.0);
    for (std::size_t g = 0; g < 2; ++g) {
        CHECK(norm(a.grains.motion[g].x - b.grains.motion[g].x) < 1e-9);
        CHECK(std::abs(a.grains.turning[g].q.w - b.grains.turning[g].q.w) < 1e-7);
    }
}
