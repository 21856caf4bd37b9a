// SPDX-License-Identifier: MIT
#include <clast/bonds/cluster_pool.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include <clast/core/random.hpp>
#include <clast/io/archive.hpp>

#include <catch.hpp>

using namespace clast;
using namespace clast::bonds;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double density = 2650.0;

shape pair_of_balls(double r) { return make_shape("pair", {{{0, 0, 0}, r}, {{2 * r, 0, 0}, r}}); }

parallel unbreakable_bond() {
    parallel m;
    m.tensile_strength = m.cohesion = 1e30;
    return m;
}

/// Clusters of one shape in space, moved as the engine moves them.
struct world {
    cluster_pool pool;
    std::vector<vec3> position; // clusters x pebbles
    std::vector<ball_motion> motion;
    std::vector<pebble_load> load;
    std::vector<break_report> broken;
    double dissipated = 0.0;
    double work = 0.0; // of the loads
    bool packs = false;

    world(const shape& s, const parallel& material, double damping, double rho = density)
        : pool(lattice(s, material, rho), damping) {}

    std::size_t pebbles() const { return pool.shape().size(); }

    std::size_t add(const quaternion& q = {}, const std::vector<state>& born = {}, double strength = 1.0,
                    double scale = 1.0, double density_ratio = 1.0) {
        for (const vec3& x : pool.shape().offset) position.push_back(rotate(q, scale * x));
        motion.resize(position.size());
        load.resize(position.size());
        return pool.add(born.empty() ? std::vector<state>(pool.bonds()) : born, strength, {scale, density_ratio});
    }
    /// Of a bond in `later` seconds, at the present velocities.
    vec3 normal(std::size_t cluster, std::size_t bond, double later = 0.0) const {
        const shape_bond& ends = pool.shape().ends[bond];
        const std::size_t a = cluster * pebbles() + static_cast<std::size_t>(ends.a);
        const std::size_t b = cluster * pebbles() + static_cast<std::size_t>(ends.b);
        return unit(position[b] + later * motion[b].velocity - position[a] - later * motion[a].velocity);
    }
    void step(double dt) {
        const std::size_t n = pebbles();
        if (packs) pool.pack();
        std::vector<break_report> now;
        for (std::size_t batch = 0; batch < pool.batches(); ++batch) {
            std::vector<ball_motion> balls(lanes * n);
            std::vector<pebble_load> loads(lanes * n);
            std::vector<vec3> moved(lanes * n);
            std::vector<std::pair<std::size_t, std::size_t>> place; // in the batch and in the world
            for (std::size_t l = 0; l < lanes; ++l)
                for (std::size_t k = 0; k < n && pool.living(batch, l) >= 0; ++k)
                    place.emplace_back(l * n + k, static_cast<std::size_t>(pool.living(batch, l)) * n + k);
            for (const auto& [here, k] : place) {
                balls[here] = {motion[k].velocity, motion[k].spin, position[k] + 0.5 * dt * motion[k].velocity};
                loads[here] = load[k];
            }
            const auto lost = pool.advance(batch, dt, balls, loads, moved, now);
            for (const double d : lost) dissipated += d;
            for (const auto& [here, k] : place) {
                work += dot(load[k].force, moved[here]);
                work += 0.5 * dt * dot(load[k].moment, motion[k].spin + balls[here].spin);
                motion[k] = balls[here];
                position[k] += moved[here];
            }
        }
        if (packs) std::sort(now.begin(), now.end(), told_before);
        broken.insert(broken.end(), now.begin(), now.end());
    }
    double mass(std::size_t k) const { return pool.shape().mass[k % pebbles()]; }
    double inertia(std::size_t k) const { return pool.shape().inertia[k % pebbles()]; }
    double kinetic() const {
        double e = 0.0;
        for (std::size_t k = 0; k < motion.size(); ++k)
            e += 0.5 * (mass(k) * norm2(motion[k].velocity) + inertia(k) * norm2(motion[k].spin));
        return e;
    }
    double stored() const {
        double e = 0.0;
        for (std::size_t c = 0; c < pool.size(); ++c) e += pool.energy(c);
        return e;
    }
    vec3 momentum() const {
        vec3 p;
        for (std::size_t k = 0; k < motion.size(); ++k) p += mass(k) * motion[k].velocity;
        return p;
    }
    vec3 angular_momentum() const {
        vec3 p;
        for (std::size_t k = 0; k < motion.size(); ++k)
            p += mass(k) * cross(position[k], motion[k].velocity) + inertia(k) * motion[k].spin;
        return p;
    }
};

bool same(const state& a, const state& b) { return a.n == b.n && a.v == b.v && a.mt == b.mt && a.mb == b.mb; }

/// Loads that hold themselves in balance: pairs of opposite forces along the lines of two pebbles, and couples.
std::vector<pebble_load> balanced(random_stream& random, const lattice& l, const quaternion& q, double size) {
    std::vector<pebble_load> load(l.size());
    for (std::size_t i = 0; i < l.size(); ++i)
        for (std::size_t j = i + 1; j < l.size(); ++j) {
            const vec3 f = uniform(random, -size, size) * rotate(q, unit(l.offset[j] - l.offset[i]));
            const vec3 m = 1e-3 * size * direction(random);
            load[i].force += f, load[j].force -= f;
            load[i].moment += m, load[j].moment -= m;
        }
    return load;
}

} // namespace

TEST_CASE("two bonded balls swing at the frequency of their bond, in the exact numbers of the leapfrog") {
    const double r = 0.004;
    const parallel m = unbreakable_bond();
    const double mass = density * sphere_volume(r), kn = m.normal_stiffness, ks = m.shear_stiffness;
    struct mode {
        const char* name;
        double square; // of the frequency
        ball_motion a, b;
    };
    const double v = 1e-6, w = 1e-3, roll = 2.5 * v / r;
    for (const mode& now : {mode{"stretch", 2 * kn / mass, {{-v, 0, 0}, {}}, {{v, 0, 0}, {}}},
                            mode{"twist", 2.5 * ks / mass, {{}, {-w, 0, 0}}, {{}, {w, 0, 0}}},
                            mode{"bending", 1.25 * kn / mass, {{}, {0, -w, 0}}, {{}, {0, w, 0}}},
                            // balls that move across and turn alike, in the ratio of the mode
                            mode{"shear", 7 * ks / mass, {{0, -v, 0}, {0, 0, -roll}}, {{0, v, 0}, {0, 0, -roll}}}}) {
        INFO(now.name);
        world two(pair_of_balls(r), m, 0.0);
        two.add();
        two.motion = {now.a, now.b};
        const double omega = std::sqrt(now.square), dt = 0.05 / omega;
        REQUIRE(two.pool.substeps(dt) == 1);
        const double turning = 2.0 * std::asin(0.5 * omega * dt); // per step, of the leapfrog
        double worst = 0.0;
        for (int k = 1; k <= 1000; ++k) {
            two.step(dt);
            // from zero force, half a drift at either end of a step
            const double expected = std::cos(turning * k);
            worst = std::max(worst, norm(two.motion[1].velocity - expected * now.b.velocity) / v);
            worst = std::max(worst, norm(two.motion[1].spin - expected * now.b.spin) / (roll + w));
        }
        CHECK(worst < 1e-6);
        CHECK(turning / dt ==
              Approx(omega).epsilon(0.05 * 0.05 / 23.0)); // and so the true one, to the order of the step
    }
}

TEST_CASE("sub-steps turn the stiffest mode by at most one radian, and are steps of their own") {
    world two(pair_of_balls(0.004), unbreakable_bond(), 0.0);
    two.add();
    const double omega = two.pool.shape().highest_frequency;
    CHECK(two.pool.substeps(0.99 / omega) == 1);
    CHECK(two.pool.substeps(1.01 / omega) == 2);
    CHECK(two.pool.substeps(99.5 / omega) == 100);
    CHECK(cluster_pool().substeps(1.0) == 1);
    // one step of 100 sub-steps is 100 steps of one while nothing but the bond acts
    const double dt = 99.5 / omega;
    two.motion = {{{-1e-6, 0, 0}, {1e-3, 0, 0}}, {{1e-6, 0, 0}, {0, 1e-3, 0}}};
    world fine = two;
    two.step(dt);
    for (int i = 0; i < 100; ++i) fine.step(dt / 100.0);
    CHECK(norm(two.motion[0].velocity - fine.motion[0].velocity) < 1e-12);
    CHECK(norm(two.position[1] - fine.position[1]) < 1e-15);
    CHECK(two.pool.get(0, 0).n == Approx(fine.pool.get(0, 0).n).epsilon(1e-6));
}

TEST_CASE("a cluster without loads keeps its momentum, and with small steps its angular momentum and energy") {
    random_stream random{9, 1};
    for (const shape& s : {shapes::tetrahedron_4(circumscribed(0.02)), shapes::apollonian_14(circumscribed(0.02))}) {
        const quaternion q = orientation(random);
        double drift[2], swing[2];
        for (int fine = 0; fine < 2; ++fine) {
            world one(s, unbreakable_bond(), 0.0);
            one.add(q);
            random_stream kicks{9, 2};
            for (ball_motion& b : one.motion) b = {0.1 * direction(kicks), 20.0 * direction(kicks)};
            const vec3 p = one.momentum(), l = one.angular_momentum();
            const double total = one.kinetic(), dt = fine == 0 ? 1e-7 : 0.25e-7;
            double least = total, most = total;
            for (int i = 0; i < (fine == 0 ? 2000 : 8000); ++i) {
                one.step(dt);
                // velocities are half a step behind the bonds, so their sum swings about the true energy
                least = std::min(least, one.kinetic() + one.stored());
                most = std::max(most, one.kinetic() + one.stored());
            }
            CHECK(norm(one.momentum() - p) < 1e-12 * one.mass(0) * 0.1);
            drift[fine] = norm(one.angular_momentum() - l) / norm(l);
            swing[fine] = (most - least) / total;
        }
        CAPTURE(s.name, drift[0], drift[1], swing[0], swing[1]);
        CHECK(drift[0] < 1e-3);
        CHECK(swing[1] < 0.06);
        CHECK(swing[1] < 0.4 * swing[0]);
    }
}

TEST_CASE("zero-force birth under a sudden load overshoots by 1 + sqrt((1-a)/(1+a)) on one bond") {
    const double pull = 1000.0;
    for (const double a : {0.0, 0.5, 0.7, 0.8}) {
        world two(pair_of_balls(0.004), unbreakable_bond(), a);
        two.add();
        REQUIRE(two.position[0].x < two.position[1].x);
        two.load[0].force = {-pull, 0, 0};
        two.load[1].force = {pull, 0, 0};
        const double dt = 1e-3 / std::sqrt(2 * 9.6e8 / two.mass(0));
        double peak = 0.0;
        for (int i = 0; i < 5000; ++i) {
            two.step(dt);
            peak = std::max(peak, two.pool.get(0, 0).n);
        }
        CHECK(peak / pull == Approx(1.0 + std::sqrt((1.0 - a) / (1.0 + a))).epsilon(2e-3));
    }
}

TEST_CASE("a warm start stays where statics puts it, with or without damping") {
    random_stream random{9, 3};
    for (const shape& s : {shapes::tetrahedron_4(circumscribed(0.02)), shapes::apollonian_14(circumscribed(0.02))})
        for (const double a : {0.0, 0.7}) {
            world one(s, unbreakable_bond(), a);
            const quaternion q = orientation(random);
            const auto load = balanced(random, one.pool.shape(), q, 1000.0);
            const auto born = one.pool.shape().statics(load, q, {});
            one.add(q, born);
            one.load = load;
            double change = 0.0, most = 0.0, speed = 0.0;
            for (const state& b : born) most = std::max(most, std::abs(b.n));
            for (int i = 0; i < 100; ++i) {
                one.step(1e-5);
                for (std::size_t b = 0; b < born.size(); ++b) {
                    const state now = one.pool.get(0, b);
                    change = std::max(change, std::abs(now.n - born[b].n) + norm(now.v - born[b].v));
                    change = std::max(change, 250.0 * (std::abs(now.mt - born[b].mt) + norm(now.mb - born[b].mb)));
                }
                for (const ball_motion& m : one.motion) speed = std::max(speed, norm(m.velocity));
            }
            CHECK(most > 100.0);
            CHECK(change < 1e-6 * most);
            CHECK(speed < 1e-7);
        }
}

TEST_CASE("a warm start of a cluster that flies and turns holds its bonds near their static forces") {
    random_stream random{9, 4};
    world one(shapes::tetrahedron_4(circumscribed(0.02)), unbreakable_bond(), 0.0);
    const quaternion q = orientation(random);
    std::vector<pebble_load> load(4);
    for (pebble_load& p : load) p.force = 200.0 * direction(random);
    const auto born = one.pool.shape().statics(load, q, {});
    one.add(q, born);
    one.load = load;
    double most = 0.0, change = 0.0;
    for (const state& s : born) most = std::max(most, std::abs(s.n));
    for (int i = 0; i < 20; ++i) { // 40 us: the grain turns little against the loads
        one.step(2e-6);
        for (std::size_t b = 0; b < 6; ++b) change = std::max(change, std::abs(one.pool.get(0, b).n - born[b].n));
    }
    CHECK(norm(one.motion[0].velocity) > 0.1);
    CHECK(change < 0.03 * most);
}

TEST_CASE("a cluster that turns steadily turns its bond forces with it") {
    // a quarter turn about z at 200 rad/s, held together by the forces of its whirl
    const double spin = 200.0, dt = 1e-6;
    world one(shapes::tetrahedron_4(circumscribed(0.02)), unbreakable_bond(), 0.0);
    const std::vector<pebble_load> none(4);
    const auto born = one.pool.shape().statics(none, {}, {0, 0, spin});
    one.add({}, born);
    for (std::size_t k = 0; k < 4; ++k) one.motion[k] = {cross(vec3{0, 0, spin}, one.position[k]), {0, 0, spin}};
    const int steps = static_cast<int>(0.5 * pi / spin / dt);
    for (int i = 0; i < steps; ++i) one.step(dt);
    const quaternion q = rotation({0, 0, spin * dt * steps});
    for (std::size_t k = 0; k < 4; ++k)
        CHECK(norm(one.position[k] - rotate(q, one.pool.shape().offset[k])) < 2e-4 * 0.0055);
    for (std::size_t b = 0; b < 6; ++b) { // bonds as stiff as these would turn a strain of 1e-6 into 9 N
        CHECK(std::abs(one.pool.get(0, b).n - born[b].n) < 0.1);
        CHECK(norm(one.pool.get(0, b).v - rotate(q, born[b].v)) < 0.02);
    }
}

TEST_CASE("a cluster gives the same bits in any lane, whatever its neighbours do") {
    random_stream random{9, 5};
    const shape s = shapes::tetrahedron_4(circumscribed(0.02));
    const quaternion q = orientation(random);
    std::vector<pebble_load> load(4);
    std::vector<ball_motion> start(4);
    for (std::size_t k = 0; k < 4; ++k) {
        load[k] = {4000.0 * direction(random), 3.0 * direction(random)};
        start[k] = {0.1 * direction(random), 5.0 * direction(random)};
    }
    const auto run = [&](std::size_t mine, bool company) {
        world w(s, parallel{}, 0.7);
        for (std::size_t c = 0; c < (company ? lanes + 3 : mine + 1); ++c) w.add(q);
        random_stream other{9, 6};
        for (std::size_t k = 0; k < w.motion.size(); ++k) {
            if (k / 4 == mine)
                w.motion[k] = start[k % 4], w.load[k] = load[k % 4];
            else if (company) // the others tear apart, each in its own time
                w.load[k] = {1000.0 * static_cast<double>(1 + k / 4) * direction(other), {}};
        }
        for (int i = 0; i < 40; ++i) w.step(2e-6);
        std::vector<std::int32_t> order;
        for (const break_report& b : w.broken)
            if (b.cluster == static_cast<std::int32_t>(mine)) order.push_back(b.bond);
        std::vector<ball_motion> end;
        for (std::size_t k = 0; k < 4; ++k) end.push_back(w.motion[4 * mine + k]);
        std::vector<state> left;
        for (std::size_t b = 0; b < 6; ++b) left.push_back(w.pool.get(mine, b));
        return std::tuple(order, end, left, w.broken.size());
    };
    const auto [order, end, left, alone] = run(0, false);
    CHECK(!order.empty());
    CHECK(order.size() == alone);
    for (const std::size_t lane : {std::size_t{0}, std::size_t{3}, std::size_t{7}, std::size_t{9}}) {
        const auto [order2, end2, left2, all] = run(lane, true);
        CHECK(order2 == order);
        CHECK(all > alone);
        for (std::size_t k = 0; k < 4; ++k) {
            CHECK(end2[k].velocity == end[k].velocity);
            CHECK(end2[k].spin == end[k].spin);
        }
        for (std::size_t b = 0; b < 6; ++b) CHECK(same(left2[b], left[b]));
    }
}

TEST_CASE("a bond lets go when its strength is reached, not before, and its load is gone at once") {
    const double r = 0.004, strength = 30e6 * pi * r * r;
    for (const bool beyond : {false, true}) {
        const double carried = (beyond ? 1.0 + 1e-12 : 1.0 - 1e-12) * strength;
        world two(pair_of_balls(r), parallel{}, 0.0);
        two.add({}, {{carried, {}, 0.0, {}}});
        two.load[0].force = {beyond ? 0.0 : -carried, 1.0, 0};
        two.load[1].force = {beyond ? 0.0 : carried, 1.0, 0};
        const double dt = 1e-7;
        two.step(dt);
        CHECK(two.pool.is_intact(0, 0) != beyond);
        CHECK(two.pool.intact_bonds(0) == (beyond ? 0 : 1));
        REQUIRE(two.broken.size() == (beyond ? 1U : 0U));
        // nothing but the load across moves the balls, as if there had never been a bond
        for (const ball_motion& b : two.motion) {
            CHECK(b.velocity.y == Approx(dt / two.mass(0)).epsilon(1e-13));
            CHECK(std::abs(b.velocity.x) < 1e-10 * strength * dt / two.mass(0));
        }
        if (beyond) {
            const break_report& b = two.broken.front();
            CHECK((b.cluster == 0 && b.bond == 0 && b.mode == break_mode::tension));
            CHECK(b.before.n == carried);
            CHECK(same(two.pool.get(0, 0), state{}));
            CHECK(two.pool.energy(0) == 0.0);
            const auto before = two.motion;
            two.step(dt); // what has no bond left is left alone
            CHECK(two.motion[0].velocity == before[0].velocity);
        }
    }
}

TEST_CASE("under growing pull a bond breaks in tension and under growing twist in shear, at its strength") {
    const double r = 0.004, area = pi * r * r;
    for (const bool twist : {false, true}) {
        world two(pair_of_balls(r), parallel{}, 0.7);
        two.add();
        const double strength = twist ? 60e6 * area * r / 2.0 : 30e6 * area;
        double load = 0.0;
        while (two.broken.empty() && load < 2.0 * strength) {
            load += 1e-4 * strength;
            for (std::size_t side = 0; side < 2; ++side) {
                const vec3 x{side == 0 ? -load : load, 0, 0};
                two.load[side] = twist ? pebble_load{{}, x} : pebble_load{x, {}};
            }
            two.step(1e-5);
        }
        CHECK(load == Approx(strength).epsilon(1e-3));
        REQUIRE(two.broken.size() == 1);
        CHECK(two.broken[0].mode == (twist ? break_mode::shear : break_mode::tension));
        const double carried = twist ? std::abs(two.broken[0].before.mt) : two.broken[0].before.n;
        CHECK(carried == Approx(strength).epsilon(1e-3));
        CHECK(carried >= strength * (1 - 1e-12));
    }
}

TEST_CASE("a cluster can be stronger or weaker than its kind, each on its own") {
    const double r = 0.004, strength = 30e6 * pi * r * r;
    world many(pair_of_balls(r), parallel{}, 0.0);
    const double factors[] = {1.0, 0.5, 2.0, 1.1};
    for (const double factor : factors) many.add({}, {{1.05 * strength, {}, 0.0, {}}}, factor);
    many.step(1e-9);
    CHECK_FALSE(many.pool.is_intact(0, 0));
    CHECK_FALSE(many.pool.is_intact(1, 0));
    CHECK(many.pool.is_intact(2, 0));
    CHECK(many.pool.is_intact(3, 0));
    cluster_pool copy(many.pool.shape(), 0.0);
    from_bytes(to_bytes(many.pool), copy);
    CHECK(checksum(copy) == checksum(many.pool));
}

TEST_CASE("damped turning: the energy that damping takes is the work that is missing") {
    world two(pair_of_balls(0.004), unbreakable_bond(), 0.5);
    two.add();
    for (std::size_t side = 0; side < 2; ++side) {
        const double sign = side == 0 ? -1.0 : 1.0;
        two.load[side] = {{}, {2.0 * sign, 1.0 * sign, -0.5 * sign}};
    }
    const double dt = 2e-9;
    for (int i = 0; i < 5000; ++i) two.step(dt);
    CHECK(two.stored() > 0.0);
    CHECK(two.dissipated > 0.2 * two.work);
    CHECK(two.work == Approx(two.kinetic() + two.stored() + two.dissipated).epsilon(5e-3));
}

TEST_CASE("failures are told in the order of steps, then bonds, then lanes") {
    world many(shapes::tetrahedron_4(circumscribed(0.02)), parallel{}, 0.7);
    const double strength = 30e6 / many.pool.shape().bond[0].per_area;
    for (int c = 0; c < 3; ++c) {
        std::vector<state> born(6);
        born[4].n = born[2].n = 1.1 * strength; // at once
        many.add({}, born);
    }
    many.step(1e-6);
    REQUIRE(many.broken.size() >= 6);
    for (std::size_t k = 0; k < 6; ++k) {
        CHECK(many.broken[k].bond == (k < 3 ? 2 : 4));
        CHECK(many.broken[k].cluster == static_cast<std::int32_t>(k % 3));
    }
}

TEST_CASE("work of the loads is kinetic, stored, damped and released energy, through all breaks") {
    double error[2];
    for (int fine = 0; fine < 2; ++fine) {
        world one(shapes::apollonian_14(circumscribed(0.02)), parallel{}, 0.3);
        one.add();
        random_stream random{9, 8};
        for (pebble_load& p : one.load) p.force = 3000.0 * direction(random);
        const double dt = fine == 0 ? 2e-8 : 0.5e-8;
        REQUIRE(one.pool.substeps(dt) == 1);
        for (int i = 0; i < (fine == 0 ? 2000 : 8000); ++i) one.step(dt);
        double released = 0.0;
        for (const break_report& b : one.broken)
            released += energy(one.pool.shape().bond[static_cast<std::size_t>(b.bond)], b.before);
        CHECK(one.broken.size() > 5);
        CHECK(one.pool.intact_bonds(0) == 36 - static_cast<std::int32_t>(one.broken.size()));
        CHECK(one.dissipated > 0.0);
        CHECK(released > 0.0);
        error[fine] = std::abs(one.work - one.kinetic() - one.stored() - one.dissipated - released) / one.work;
    }
    CHECK(error[0] < 0.02);
    CHECK(error[1] < 0.4 * error[0]);
}

TEST_CASE("a pool that went through an archive continues with the same bits") {
    random_stream random{9, 9};
    const shape s = shapes::tetrahedron_4(circumscribed(0.02));
    world a(s, parallel{}, 0.7);
    for (int c = 0; c < 11; ++c) a.add(orientation(random)); // not a whole number of batches
    for (pebble_load& p : a.load) p = {3000.0 * direction(random), 2.0 * direction(random)};
    for (int i = 0; i < 5; ++i) a.step(2e-6);
    CHECK(!a.broken.empty());
    world b = a;
    b.pool = cluster_pool(lattice(s, parallel{}, density), 0.7);
    from_bytes(to_bytes(a.pool), b.pool);
    CHECK(b.pool.size() == 11);
    for (int i = 0; i < 10; ++i) a.step(2e-6), b.step(2e-6);
    CHECK(checksum(a.pool) == checksum(b.pool));
    CHECK(a.broken.size() == b.broken.size());
    for (std::size_t k = 0; k < a.motion.size(); ++k) REQUIRE(a.motion[k].velocity == b.motion[k].velocity);
}

TEST_CASE("clusters that change seats keep their bits and the order in which they break") {
    random_stream random{9, 11};
    world plain(shapes::tetrahedron_4(circumscribed(0.02)), parallel{}, 0.7);
    for (int c = 0; c < 21; ++c) // some fall apart, some lose a bond or two, some stay whole
        plain.add(orientation(random), {}, c % 3 == 0 ? 50.0 : c % 3 == 1 ? 1.0 : 0.2);
    for (pebble_load& p : plain.load) p = {4000.0 * direction(random), 2.0 * direction(random)};
    world packed = plain;
    packed.packs = true;
    std::size_t fewest = packed.pool.batches();
    for (int i = 0; i < 60; ++i) {
        if (i == 40) { // one more comes in the middle
            const quaternion q = orientation(random);
            plain.add(q), packed.add(q);
        }
        plain.step(2e-6), packed.step(2e-6);
        fewest = std::min(fewest, packed.pool.batches());
        cluster_pool saved = packed.pool; // saving gives everybody the seat of their number
        REQUIRE(checksum(saved) == checksum(plain.pool));
        REQUIRE(packed.broken.size() == plain.broken.size());
    }
    CHECK(fewest < plain.pool.batches());
    CHECK(plain.broken.size() > 50);
    std::size_t elsewhere = 0; // clusters of the last batches that broke in one step with those of the first
    for (std::size_t k = 0; k < plain.broken.size(); ++k) {
        const break_report &a = plain.broken[k], &b = packed.broken[k];
        REQUIRE(std::tuple(a.cluster, a.bond, a.mode, a.step) == std::tuple(b.cluster, b.bond, b.mode, b.step));
        REQUIRE(same(a.before, b.before));
        elsewhere += k > 0 && a.cluster / 8 > plain.broken[k - 1].cluster / 8;
    }
    CHECK(elsewhere > 0);
    for (std::size_t k = 0; k < plain.motion.size(); ++k) {
        REQUIRE(packed.motion[k].velocity == plain.motion[k].velocity);
        REQUIRE(packed.motion[k].spin == plain.motion[k].spin);
        REQUIRE(packed.position[k] == plain.position[k]);
    }
    // everybody who has a bond left has a seat in front, and one only
    packed.pool.pack();
    std::vector<int> seats(packed.pool.size(), 0);
    for (std::size_t batch = 0; batch < packed.pool.batches(); ++batch)
        for (std::size_t l = 0; l < lanes; ++l)
            if (packed.pool.living(batch, l) >= 0) ++seats[static_cast<std::size_t>(packed.pool.living(batch, l))];
    std::size_t living = 0;
    for (std::size_t c = 0; c < seats.size(); ++c) {
        CHECK(seats[c] == (packed.pool.intact_bonds(c) > 0 ? 1 : 0));
        CHECK(packed.pool.intact_bonds(c) == plain.pool.intact_bonds(c));
        living += packed.pool.intact_bonds(c) > 0;
    }
    CHECK(packed.pool.batches() == (living + lanes - 1) / lanes);
}

TEST_CASE(
    "a cluster of a quarter of size and density of its lattice is one of that size and density, to the last bit") {
    // powers of four, because then roots are exact, too; frequencies of the readings are 8, 2 and 4 times as high
    const shape big = shapes::tetrahedron_4(circumscribed(0.08)), small = scaled_by(big, 0.25);
    for (const stiffness_reading reading :
         {stiffness_reading::force, stiffness_reading::per_area, stiffness_reading::modulus}) {
        parallel bond;
        bond.reading = reading;
        bond.friction_angle = 0.5;
        bond.radius_multiplier = 0.75;
        if (reading == stiffness_reading::per_area) bond.normal_stiffness = 1e13, bond.shear_stiffness = 5e12;
        if (reading == stiffness_reading::modulus) bond.normal_stiffness = 5e10, bond.shear_stiffness = 2e10;
        world by_scale(big, bond, 0.3, 4.0 * density), by_shape(small, bond, 0.3);
        by_scale.packs = by_shape.packs = true;
        random_stream random{9, 21};
        for (int c = 0; c < 11; ++c) {
            const quaternion q = orientation(random);
            const double strength = uniform(random, 0.5, 2.0);
            const std::vector<pebble_load> load = balanced(random, by_shape.pool.shape(), q, 500.0);
            const vec3 spin = direction(random);
            const auto born = by_shape.pool.shape().statics(load, q, spin);
            const auto from_scale = by_scale.pool.shape().statics(load, q, spin, {0.25, 0.25});
            for (std::size_t b = 0; b < born.size(); ++b) REQUIRE(same(born[b], from_scale[b]));
            by_scale.add(q, from_scale, strength, 0.25, 0.25), by_shape.add(q, born, strength);
        }
        for (std::size_t k = 0; k < by_shape.load.size(); ++k)
            by_scale.load[k] = by_shape.load[k] = {1200.0 * direction(random), 2.0 * direction(random)};
        CHECK(by_scale.pool.substeps(1e-5, {0.25, 0.25}) == by_shape.pool.substeps(1e-5));
        for (int i = 0; i < 60; ++i) by_scale.step(2e-6), by_shape.step(2e-6);
        CHECK(by_shape.broken.size() > 10);
        CHECK(by_shape.stored() > 0.0);
        CHECK(by_scale.stored() == by_shape.stored());
        CHECK(by_scale.dissipated == by_shape.dissipated);
        REQUIRE(by_scale.broken.size() == by_shape.broken.size());
        for (std::size_t k = 0; k < by_shape.broken.size(); ++k) {
            const break_report &a = by_scale.broken[k], &b = by_shape.broken[k];
            REQUIRE(std::tuple(a.cluster, a.bond, a.mode, a.step) == std::tuple(b.cluster, b.bond, b.mode, b.step));
            REQUIRE(same(a.before, b.before));
            const auto c = static_cast<std::size_t>(a.cluster), bond_of = static_cast<std::size_t>(a.bond);
            CHECK(by_scale.pool.energy_of(c, bond_of, a.before) == by_shape.pool.energy_of(c, bond_of, b.before));
        }
        for (std::size_t k = 0; k < by_shape.motion.size(); ++k) {
            REQUIRE(by_scale.motion[k].velocity == by_shape.motion[k].velocity);
            REQUIRE(by_scale.motion[k].spin == by_shape.motion[k].spin);
            REQUIRE(by_scale.position[k] == by_shape.position[k]);
        }
    }
}

TEST_CASE("clusters of many sizes side by side: each has the bits that it has alone, and the steps that it needs") {
    const shape s = shapes::tetrahedron_4(circumscribed(0.02));
    random_stream random{9, 22};
    const double dt = 2e-6;
    world all(s, parallel{}, 0.7);
    all.packs = true;
    std::vector<double> scale;
    for (int c = 0; c < 30; ++c) {
        scale.push_back(uniform(random, 0.2, 1.5));
        all.add(orientation(random), {}, 1.0, scale.back());
    }
    for (std::size_t k = 0; k < all.load.size(); ++k) {
        const double size = scale[k / 4] * scale[k / 4];
        all.load[k] = {(size * 3000.0) * direction(random), (size * scale[k / 4] * 2.0) * direction(random)};
    }
    std::vector<world> alone;
    for (std::size_t c = 0; c < scale.size(); ++c) {
        world one(s, parallel{}, 0.7);
        one.add({}, {}, 1.0, scale[c]);
        for (std::size_t k = 0; k < 4; ++k)
            one.position[k] = all.position[4 * c + k], one.load[k] = all.load[4 * c + k];
        alone.push_back(one);
    }
    for (int i = 0; i < 30; ++i) {
        all.step(dt);
        for (world& one : alone) one.step(dt);
        if (i == 10) from_bytes(to_bytes(all.pool), all.pool); // saving takes sizes along, and gives other seats
    }
    CHECK(all.broken.size() > 20);
    std::size_t whole = 0;
    for (std::size_t c = 0; c < scale.size(); ++c) {
        CHECK(all.pool.like(c).scale == scale[c]);
        CHECK(all.pool.intact_bonds(c) == alone[c].pool.intact_bonds(0));
        CHECK(all.pool.energy(c) == alone[c].pool.energy(0));
        whole += all.pool.intact_bonds(c) == 6;
        for (std::size_t k = 0; k < 4; ++k) REQUIRE(all.motion[4 * c + k].velocity == alone[c].motion[k].velocity);
        // the highest mode of that size turns by a radian at most, and not by much less
        const lattice own(scaled_to(s, circumscribed(scale[c] * 0.02)), parallel{}, density);
        const double far = 1e-3; // s: many steps, so that rounding up to a whole number says little
        CHECK(all.pool.substeps(far, {scale[c]}) >= far * own.highest_frequency);
        CHECK(all.pool.substeps(far, {scale[c]}) <= 1.2 * far * own.highest_frequency + 1.0);
    }
    CHECK(whole < scale.size());
    // no batch holds clusters of two classes, and none is left out
    all.pool.pack();
    std::size_t living = 0;
    for (std::size_t batch = 0; batch < all.pool.batches(); ++batch) {
        int steps = 0;
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::int32_t c = all.pool.living(batch, l);
            if (c < 0) continue;
            const int own = all.pool.substeps(1e-3, {scale[static_cast<std::size_t>(c)]});
            CHECK((steps == 0 || own == steps));
            steps = own, ++living;
        }
    }
    std::size_t with_bonds = 0;
    for (std::size_t c = 0; c < scale.size(); ++c) with_bonds += all.pool.intact_bonds(c) > 0;
    CHECK(living == with_bonds);
}

TEST_CASE("a bond across a gap turns no grain") {
    shape s = shapes::tetrahedron_4(circumscribed(0.02));
    for (shape_pebble& p : s.pebbles) p.radius *= 1.0 - 4e-4;
    random_stream random{9, 10};
    for (const bool breaks : {false, true}) { // also while it lets go
        world one(make_shape("4B with gaps", s.pebbles), breaks ? parallel{} : unbreakable_bond(), 0.0);
        std::vector<state> born(6);
        one.add();
        for (std::size_t b = 0; b < 6; ++b)
            born[b].v = (breaks && b == 3 ? 1e6 : 100.0) * unit(cross(one.normal(0, b), direction(random)));
        one.pool = cluster_pool(one.pool.shape(), 0.0);
        one.pool.add(born); // sheared at birth: the bonds push the balls around, but not the whole
        one.step(1e-8);
        CHECK(one.pool.intact_bonds(0) == (breaks ? 5 : 6));
        double turned = 0.0;
        for (std::size_t k = 0; k < 4; ++k) turned += one.inertia(k) * norm(one.motion[k].spin);
        CHECK(turned > 0.0);
        CHECK(norm(one.angular_momentum()) < 1e-8 * turned);
    }
}

TEST_CASE("a cluster that is dissolved has no bond, no energy and no seat among the living") {
    cluster_pool pool(lattice(shapes::tetrahedron_4(circumscribed(0.02)), parallel{}, 2650.0), 0.0);
    std::vector<state> born(6);
    for (state& s : born) s.n = 100.0;
    for (int k = 0; k < 3; ++k) pool.add(born);
    pool.dissolve(1);
    CHECK(pool.intact_bonds(1) == 0);
    CHECK(pool.energy(1) == 0.0);
    for (std::size_t b = 0; b < 6; ++b) CHECK((!pool.is_intact(1, b) && pool.get(1, b).n == 0.0));
    CHECK(pool.living(0, 1) == -1);
    pool.pack();
    CHECK((pool.intact_bonds(0) == 6 && pool.intact_bonds(2) == 6 && pool.intact_bonds(1) == 0));
    CHECK(pool.get(2, 5).n == 100.0);
}

TEST_CASE("the longest step is that of the fastest cluster with a bond left, and of none where there is none") {
    cluster_pool pool(lattice(shapes::tetrahedron_4(circumscribed(0.02)), parallel{}, 2650.0), 0.0);
    CHECK(std::isinf(pool.longest_step()));
    const std::vector<state> born(6);
    pool.add(born);
    const double own = pool.longest_step();
    CHECK(own == Approx(1.0 / pool.shape().highest_frequency).epsilon(1e-12));
    CHECK((pool.substeps(0.999 * own) == 1 && pool.substeps(1.001 * own) == 2));
    // as stiff and an eighth of the mass and of the moments over lengths squared: frequencies go with scale^(-3/2)
    const std::size_t small = pool.add(born, 1.0, {0.5});
    CHECK(pool.longest_step() <= own / std::sqrt(8.0));
    CHECK(pool.substeps(pool.longest_step(), {0.5}) == 1);
    pool.dissolve(small);
    CHECK(pool.longest_step() == own);
    pool.dissolve(0);
    CHECK(std::isinf(pool.longest_step()));
}
