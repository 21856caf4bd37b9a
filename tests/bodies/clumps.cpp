// SPDX-License-Identifier: MIT
#include <clast/bodies/clumps.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <clast/core/random.hpp>
#include <clast/io/archive.hpp>

#include <catch.hpp>

static_assert(clast::bodies::specimen<clast::bodies::clumps>);

using namespace clast;

TEST_CASE("a clump that is added has its pebbles in a row, turned and moved, and owns them") {
    bodies::clumps s;
    s.shapes = {shapes::tetrahedron_4(circumscribed(0.02)), shapes::sphere(0.01)};
    const quaternion q = unit(quaternion{1.0, 0.2, -0.5, 0.4});
    CHECK(s.add(1, {1, 2, 3}, {}) == 0);
    CHECK(s.add(0, {0.1, -0.2, 0.3}, q) == 1);
    CHECK(s.grain_count() == 2);
    CHECK(s.pebble_count() == 5);
    CHECK(s.grains[1].first == 1);
    CHECK(s.is_clump(1));
    for (std::size_t k = 0; k < 4; ++k) {
        const shape_pebble& p = s.shapes[0].pebbles[k];
        CHECK(norm(s.pebbles[1 + k].x - vec3{0.1, -0.2, 0.3}) == Approx(norm(p.offset)).epsilon(1e-14));
        CHECK(norm(rotate_back(q, s.pebbles[1 + k].x - vec3{0.1, -0.2, 0.3}) - p.offset) < 1e-16);
        CHECK(s.pebbles[1 + k].radius == p.radius);
        CHECK(s.mother[1 + k] == 1);
        CHECK(s.owner[1 + k] == 1);
    }
    CHECK(s.owner[0] == 0);
    CHECK(norm(s.motion[1].v) == 0.0);
}

TEST_CASE("mass, inertia and solid volume are those of the pebbles") {
    bodies::clumps s;
    s.density = 2000.0;
    s.shapes = {shapes::sphere(0.02)};
    s.add(0, {}, {});
    const double m = 2000.0 * 4.0 / 3.0 * 3.14159265358979323846 * 1e-6;
    CHECK(s.mass_of(s.grains[0]) == Approx(m).epsilon(1e-14));
    CHECK(s.ball_mass(0) == Approx(m).epsilon(1e-14));
    CHECK(s.ball_inertia(0) == Approx(0.4 * m * 1e-4).epsilon(1e-14));
    CHECK(s.inverse_inertia(s.grains[0]).x == Approx(1.0 / (0.4 * m * 1e-4)).epsilon(1e-14));
    CHECK(s.solid_volume() == Approx(m / 2000.0).epsilon(1e-14));
    CHECK(s.solid_volume() == Approx(s.shapes[0].volume).epsilon(1e-14));
}

TEST_CASE("a specimen comes back from an archive") {
    bodies::clumps s, copy;
    s.shapes = {shapes::apollonian_14(circumscribed(0.02))};
    s.add(0, {1, 2, 3}, unit(quaternion{1.0, 0.2, -0.5, 0.4}));
    s.turning[0].l = {1, 2, 3};
    s.losses[0].friction = 5.0;
    from_bytes(to_bytes(s), copy);
    CHECK(checksum(copy) == checksum(s));
    CHECK(copy.turning[0].l == s.turning[0].l);
    CHECK(copy.pebble_count() == 14);
}

TEST_CASE("clumps move as one alone, however many move together, and their wanted pebbles follow") {
    bodies::clumps s;
    s.shapes = {shapes::tetrahedron_4(circumscribed(0.02)), shapes::apollonian_14(circumscribed(0.03))};
    random_stream random{5, 1};
    const auto any = [&](double size) { return uniform(random, 0.0, size) * direction(random); };
    constexpr std::size_t n = 23; // a whole strip, a whole block of four, and three more
    std::vector<moving_body> bodies;
    std::vector<bodies::clumps::reference> since;
    body_items wanted{{0}, {}};
    for (std::size_t g = 0; g < n; ++g) {
        s.add(g % 3 == 0 ? 1 : 0, any(1.0), orientation(random));
        since.push_back(s.refer(g));
        s.motion[g].x += any(1e-4), s.motion[g].v = any(0.1);
        s.turning[g].l = 1e-7 * direction(random);
        s.motion[g].w = spin_of(s.turning[g].q, s.turning[g].l, s.inverse_inertia(s.grains[g]));
        bodies.push_back({n - 1 - g, {any(10.0), any(0.1), 0.25 * static_cast<double>(g)}});
        for (std::size_t p = s.pebbles_of(g).begin; p < s.pebbles_of(g).end; p += 2)
            wanted.items.push_back(static_cast<std::int32_t>(p));
        wanted.start.push_back(static_cast<std::uint32_t>(wanted.items.size()));
    }
    const double h = 1e-5, damping = 0.7;
    const vec3 stretch{1.001, 0.999, 1.0};
    const auto further = [](std::size_t g) { return 1e-3 * static_cast<double>(g); };
    std::vector<double> margins(n, 1.0);
    const auto move = [&](bodies::clumps& some, std::span<const moving_body> which) {
        return some.advance(which, integrators::rule<integrators::leapfrog>{{damping}, {}, h, h}, wanted,
                            {since, margins, stretch}, further);
    };
    bodies::clumps together = s, alone = s;
    CHECK(move(together, bodies) == margin_use::within);
    const auto way = [&](std::size_t g) { return together.moved(g, since[g], stretch) + further(g); };
    for (std::size_t g = 0; g < n; ++g) margins[g] = (1.0 + 1e-9) * way(g);
    for (const moving_body& one : bodies) {
        CHECK(move(alone, {&one, 1}) == margin_use::within);
        const body_motion &old = s.motion[one.body], &now = alone.motion[one.body];
        CHECK(norm(now.x - (old.x + h * now.v)) < 1e-15);
        CHECK(alone.losses[one.body].friction == one.load.dissipated);
        CHECK(way(one.body) >= norm(now.x - scale(stretch, since[one.body].centre)) + further(one.body));
        // kick and turn, as in tests/engine/clump_strip.cpp
        const quaternion q = s.turning[one.body].q;
        const vec3 df = damping_force(one.load.force, old.v, damping);
        const vec3 l =
            s.turning[one.body].l + h * (one.load.moment + damping_moment(q, one.load.moment, old.w, damping));
        const double inverse_mass = 1.0 / s.mass_of(s.grains[one.body]);
        CHECK(norm(now.v - (old.v + (h * inverse_mass) * (one.load.force + df))) <= 1e-14 * norm(now.v));
        CHECK(norm(alone.turning[one.body].l - l) <= 1e-13 * norm(l));
        CHECK(norm(now.w - advance_rotation(q, l, s.inverse_inertia(s.grains[one.body]), h).spin) <=
              1e-12 * norm(now.w));
        // every other pebble is placed, the others stay
        const std::size_t first = s.pebbles_of(one.body).begin;
        for (std::size_t p = first; p < s.pebbles_of(one.body).end; ++p) {
            const shape_pebble& own = s.shape_of(s.grains[one.body]).pebbles[p - first];
            const vec3 there = now.x + rotate(alone.turning[one.body].q, own.offset);
            CHECK(norm(alone.pebbles[p].x - ((p - first) % 2 == 0 ? there : s.pebbles[p].x)) < 1e-15);
            CHECK(alone.pebbles[p].radius == own.radius);
        }
    }
    CHECK(checksum(together) == checksum(alone));

    for (std::size_t g : {std::size_t{7}, n - 1}) { // one body that has gone too far is enough
        bodies::clumps again = s;
        margins[g] = (1.0 - 1e-9) * way(g);
        CHECK(move(again, bodies) == margin_use::used_up);
        margins[g] = 1.0;
    }
    bodies::clumps lost = s;
    lost.motion[7].v.x = std::numeric_limits<double>::quiet_NaN();
    CHECK(move(lost, bodies) == margin_use::not_finite);
}

TEST_CASE("a clump of half the size of its shape is one of the shape of half the size, to the last bit, as it moves") {
    // half, because then all powers of the scale are exact
    const shape big = shapes::apollonian_14(circumscribed(0.04)), small = scaled_by(big, 0.5);
    random_stream random{5, 3};
    bodies::clumps by_scale, by_shape;
    by_scale.shapes = {big}, by_shape.shapes = {small};
    std::vector<moving_body> load;
    std::vector<bodies::clumps::reference> since;
    body_items wanted{{0}, {}};
    for (std::size_t g = 0; g < 5; ++g) {
        const vec3 centre = direction(random), spin = 3.0 * direction(random);
        const quaternion q = orientation(random);
        by_scale.add(0, centre, q, 0.5), by_shape.add(0, centre, q);
        by_scale.set_spin(g, spin), by_shape.set_spin(g, spin);
        load.push_back({g, {direction(random), 1e-3 * direction(random), 0.0}});
        since.push_back(by_shape.refer(g));
        for (std::size_t p = by_shape.pebbles_of(g).begin; p < by_shape.pebbles_of(g).end; ++p)
            wanted.items.push_back(static_cast<std::int32_t>(p));
        wanted.start.push_back(static_cast<std::uint32_t>(wanted.items.size()));
        CHECK(by_scale.body_mass(g) == by_shape.body_mass(g));
        CHECK(by_scale.body_inertia(g) == by_shape.body_inertia(g));
        CHECK(by_scale.bounding_radius(g) == small.circumscribed_radius);
        CHECK(by_scale.kinetic_energy(g) == by_shape.kinetic_energy(g));
        CHECK(by_scale.diameter_of(by_scale.grains[g]) == small.diameter);
        CHECK(by_scale.volume_of(by_scale.grains[g]) == small.volume);
    }
    CHECK(by_scale.solid_volume() == by_shape.solid_volume());
    CHECK(by_scale.smallest_mass() == by_shape.smallest_mass());
    const std::vector<double> margins(5, 1.0);
    const auto same = [&] {
        CHECK(checksum(by_scale.pebbles) == checksum(by_shape.pebbles));
        CHECK(checksum(by_scale.motion) == checksum(by_shape.motion));
        CHECK(checksum(by_scale.turning) == checksum(by_shape.turning));
        for (std::size_t g = 0; g < by_shape.grain_count(); ++g)
            CHECK(by_scale.moved(g, since[g % 5], {1, 1, 1}) == by_shape.moved(g, since[g % 5], {1, 1, 1}));
    };
    same();
    for (int k = 0; k < 3; ++k)
        for (bodies::clumps* s : {&by_scale, &by_shape})
            s->advance(load, integrators::rule<integrators::leapfrog>{{0.3}, {}, 1e-4, 1e-4}, wanted,
                       {since, margins, {1, 1, 1}}, [](std::size_t) { return 0.0; });
    same();
    for (bodies::clumps* s : {&by_scale, &by_shape}) {
        s->place(2);
        const shape whole = s->shapes[0];
        const std::int32_t front = s->kind_of(part_of(whole, 0, 6)), back = s->kind_of(part_of(whole, 6, 8));
        const clump_part parts[] = {{0, front}, {6, back}};
        s->split(1, parts);
    }
    CHECK(by_scale.grain_count() == 6);
    CHECK(by_scale.grains[2].scale == 0.5);
    same();
}

TEST_CASE("a spin that is set has its angular momentum, and about an axis whose inverse inertia is 0 none turns") {
    bodies::clumps s;
    s.shapes = {make_shape("pair", {{{-0.01, 0, 0}, 0.01}, {{0.01, 0, 0}, 0.01}})};
    s.add(0, {}, unit(quaternion{1.0, 0.2, -0.5, 0.4}));
    const vec3 w{3.0, -2.0, 1.0};
    s.set_velocity(0, {1.0, 2.0, 2.0});
    s.set_spin(0, w);
    CHECK(s.spin(0) == w);
    CHECK(norm(spin_of(s.turning[0].q, s.turning[0].l, s.inverse_inertia(s.grains[0])) - w) < 1e-14);
    const double moving = 0.5 * s.body_mass(0) * 9.0;
    CHECK(s.kinetic_energy(0) == Approx(moving + 0.5 * dot(s.turning[0].l, w)));
    s.of_shape[0].inverse_inertia = {};
    CHECK(s.kinetic_energy(0) == Approx(moving));
    CHECK(s.body_inertia(0).z == std::numeric_limits<double>::infinity());
}

TEST_CASE("a clump that is split goes on in parts: tables in order, nothing lost") {
    bodies::clumps s;
    s.shapes = {shapes::apollonian_14(circumscribed(0.02)), shapes::tetrahedron_4(circumscribed(0.01))};
    for (int k = 0; k < 3; ++k) s.add(k == 1 ? 0 : 1, {0.1 * k, -0.2, 0.3}, unit(quaternion{1.0, 0.2, -0.5, 0.1 * k}));
    s.motion[1].v = {1, 2, 3};
    s.turning[1].l = {2e-5, -1e-5, 3e-5};
    s.losses[1].friction = 5.0, s.losses[2].friction = 7.0;
    s.motion.resize(s.grain_count() + s.pebble_count()); // room for balls
    s.losses.resize(s.motion.size());
    s.owner[20] = static_cast<std::int32_t>(s.ball(20)); // one is its own
    s.motion[s.ball(20)].v = {9, 0, 0};
    const bodies::clumps whole = s;
    // runs of 1, 4 and 9
    s.shapes.push_back(part_of(s.shapes[0], 0, 1));
    s.shapes.push_back(part_of(s.shapes[0], 1, 4));
    s.shapes.push_back(part_of(s.shapes[0], 5, 9));
    const std::vector<clump_part> parts{{0, 2}, {1, 3}, {5, 4}};
    s.split(1, parts);
    REQUIRE(s.grain_count() == 5);
    CHECK(s.motion.size() == 5 + s.pebble_count());
    CHECK(s.losses.size() == s.motion.size());
    const std::int32_t first[] = {0, 4, 5, 9, 18}, id[] = {0, 1, 3, 4, 2};
    for (std::size_t g = 0; g < 5; ++g) {
        CHECK(s.grains[g].first == first[g]);
        CHECK(s.grains[g].id == id[g]);
        const index_range own = s.pebbles_of(g);
        for (std::size_t p = own.begin; p < own.end; ++p) {
            CHECK(s.mother[p] == static_cast<std::int32_t>(g));
            CHECK(s.owner[p] == static_cast<std::int32_t>(p == 20 ? s.ball(20) : g));
        }
    }
    CHECK(s.motion[s.ball(20)].v == vec3{9, 0, 0});
    CHECK((s.losses[1].friction == 5.0 && s.losses[2].friction == 0.0 && s.losses[4].friction == 7.0));
    CHECK(s.turning[4].q.z == whole.turning[2].q.z);
    double energy = 0.0, mass = 0.0;
    vec3 momentum, angular;
    for (std::size_t g = 1; g < 4; ++g) {
        energy += s.kinetic_energy(g), mass += s.body_mass(g);
        momentum += s.body_mass(g) * s.motion[g].v;
        angular += s.body_mass(g) * cross(s.motion[g].x, s.motion[g].v) + s.turning[g].l;
        s.place(g);
    }
    const double m = whole.body_mass(1);
    CHECK(energy == Approx(whole.kinetic_energy(1)).epsilon(1e-13));
    CHECK(mass == Approx(m).epsilon(1e-14));
    CHECK(norm(momentum - m * whole.motion[1].v) < 1e-14 * norm(momentum));
    const vec3 was = m * cross(whole.motion[1].x, whole.motion[1].v) + whole.turning[1].l;
    CHECK(norm(angular - was) < 1e-13 * norm(whole.turning[1].l));
    for (std::size_t p = 4; p < 18; ++p) CHECK(norm(s.pebbles[p].x - whole.pebbles[p].x) < 1e-16);
}
