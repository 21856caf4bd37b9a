// SPDX-License-Identifier: MIT
// Scenes of spheres alone: no clump, no orientation, in a periodic cell or a box.
#include <cmath>
#include <cstddef>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/criteria/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/io/archive.hpp>
#include <clast/measure/stress.hpp>
#include <clast/replacements/none.hpp>
#include <clast/spaces/periodic.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

struct in_a_cell : triaxial_policies_default {
    using body = bodies::spheres;
    using boundary = boundaries::none;
    using space = spaces::periodic;
    using breakage = criteria::none;
    using replacement = replacements::none;
};
struct in_a_box : in_a_cell {
    using space = spaces::open;
    using boundary = boundaries::box;
};
static_assert(simulator_policies<in_a_cell> && simulator_policies<in_a_box>);

template <class S>
concept has_orientation = requires(S s) {
    s.turning;
    s.owner;
};

template <class P> engine_settings<P> settings(double mu, double damping, double skin, int threads = 1) {
    const contacts::linear law{1e6, 5e5, mu}, wall{2e6, 0.0, 0.0};
    return {.grain_contact = law,
            .platen_contact = wall,
            .lateral_contact = wall,
            .breakage = {},
            .replacement = {},
            .scheme = {.damping = damping},
            .safety = 0.2,
            .skin = skin,
            .largest_step = 2e-5,
            .run = execution(threads),
            .contacts_per_thread = 8};
}

/// n^3 spheres of 9 to 10 mm on a grid of 22 mm around the origin, moving at random.
bodies::spheres cloud(int n, double speed) {
    bodies::spheres s;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int k = 0; k < n * n * n; ++k) {
        const auto at = [&](int i) { return 0.022 * (i - 0.5 * (n - 1)); };
        s.add({at(k % n), at(k / n % n), at(k / n / n)}, 0.0095 + 0.0005 * u(random));
        s.pebbles.back().v = speed * vec3{u(random), u(random), u(random)};
    }
    return s;
}

template <class P> vec3 momentum(const engine<P>& e) {
    vec3 p;
    for (const pebble_motion& b : e.grains.pebbles) p += b.v / b.inverse_mass;
    return p;
}
template <class P> double residual(const engine<P>& e) {
    const engine_totals& t = e.totals();
    const body_losses lost = e.losses();
    return t.boundary_work + t.initial_energy - e.kinetic_energy() - e.elastic_energy() - lost.friction - lost.damping;
}

/// A cell closed by its servos from a cloud to 50 kPa.
engine<in_a_cell> packed(double skin, int threads = 1) {
    engine<in_a_cell> e(settings<in_a_cell>(0.2, 0.5, skin, threads), cloud(7, 0.1),
                        spaces::periodic({0.154, 0.154, 0.154}));
    for (auto& axis : e.space.axes) axis = {.target = 50e3, .max_rate = 2.0, .gain = 0.2};
    while (e.time() < 0.25) e.step();
    return e;
}

} // namespace

TEST_CASE("a scene of spheres holds no quaternion and no owner") {
    static_assert(!has_orientation<bodies::spheres> && has_orientation<bodies::clumps>);
    static_assert(sizeof(pebble_motion) == 12 * sizeof(double));
    static_assert(sizeof(bodies::spheres::reference) == sizeof(vec3));
    CHECK(cloud(2, 0.0).pebble_count() == 8);
}

TEST_CASE("two spheres that meet across the faces of a cell do what they do in its middle") {
    const auto collide = [](const vec3& where) {
        bodies::spheres s;
        s.add(where - vec3{0.0102, 0.001, 0.0}, 0.01);
        s.add(where + vec3{0.0102, 0.001, 0.003}, 0.01);
        s.pebbles[0].v = {0.5, 0.0, 0.1};
        s.pebbles[1].v = {-0.5, 0.2, 0.0};
        s.pebbles[1].w = {0.0, 30.0, 0.0};
        engine<in_a_cell> e(settings<in_a_cell>(0.3, 0.0, 2e-3), s, spaces::periodic({0.2, 0.2, 0.2}));
        double deepest = 0.0;
        while (e.time() < 4e-3) {
            e.step();
            e.each_contact([&](const force_row& r, const pebble_pair&) { deepest = std::max(deepest, r.depth); });
        }
        CHECK(deepest > 5e-5);
        return e;
    };
    const auto middle = collide({0, 0, 0}), face = collide({0.1, 0, 0}), corner = collide({0.1, 0.1, -0.1});
    for (std::size_t k = 0; k < 2; ++k) {
        CHECK(norm(middle.grains.pebbles[k].v - face.grains.pebbles[k].v) < 1e-10);
        CHECK(norm(middle.grains.pebbles[k].w - corner.grains.pebbles[k].w) < 1e-8);
        CHECK(norm(middle.grains.pebbles[k].v - corner.grains.pebbles[k].v) < 1e-10);
    }
    CHECK(norm(middle.grains.pebbles[0].v - vec3{0.5, 0.0, 0.1}) > 0.1);
}

TEST_CASE("a gas of spheres in a cell keeps its momentum to rounding and its energy with the step") {
    auto s = settings<in_a_cell>(0.0, 0.0, 1e-3);
    s.largest_step = 4e-6;
    engine<in_a_cell> e(s, cloud(6, 1.0), spaces::periodic({0.132, 0.132, 0.132}));
    const vec3 p = momentum(e);
    while (e.time() < 0.1) e.step();
    CHECK(e.totals().renewals > 50);
    CHECK(e.totals().rebuilds > 10);
    CHECK(norm(momentum(e) - p) < 1e-12);
    CHECK(std::abs(residual(e)) < 5e-4 * e.totals().initial_energy);
    // many have left through a face and come back through the other
    double farthest = 0.0;
    for (const pebble_motion& b : e.grains.pebbles) farthest = std::max(farthest, norm(b.x));
    CHECK(farthest < 0.132);
}

TEST_CASE("no overlap goes unseen, however unlike the speeds, in a cell as small as it may be") {
    bodies::spheres grains = cloud(4, 0.1);
    for (std::size_t k = 0; k < grains.pebble_count(); k += 7) grains.pebbles[k].v = 30.0 * grains.pebbles[k].v;
    auto s = settings<in_a_cell>(0.0, 0.0, 1e-4);
    s.largest_step = 4e-6;
    engine<in_a_cell> e(s, grains, spaces::periodic({0.088, 0.088, 0.088}));
    e.space.axes[0] = {.rate = 1.0};
    std::size_t met = 0, seen = 0;
    for (int step = 0; step < 4000; ++step) {
        const auto before = e.grains.pebbles;
        const vec3 edges = e.space.edges();
        e.step();
        for (std::size_t i = 0; i < before.size(); ++i)
            for (std::size_t j = i + 1; j < before.size(); ++j) {
                vec3 d = before[j].x - before[i].x;
                for (int a = 0; a < 3; ++a) d[a] -= edges[a] * std::round(d[a] / edges[a]);
                met += norm(d) < before[i].radius + before[j].radius;
            }
        e.each_contact([&](const force_row& row, const pebble_pair&) { seen += row.depth > 0.0; });
    }
    CHECK(met > 1000);
    CHECK(seen == met);
    CHECK(e.totals().rebuilds > 3);
    CHECK(e.totals().renewals > 3 * e.totals().rebuilds);
}

TEST_CASE("servos bring a periodic packing to their stress, and the work of the cell goes where the audit says") {
    auto e = packed(1e-3);
    const mat3 sigma = measure::love_weber(e, e.space.volume());
    for (int a = 0; a < 3; ++a) CHECK(sigma(a, a) == Approx(50e3).epsilon(5e-3));
    CHECK(measure::contacts_of(e).coordination > 4.0);

    // sheared at constant volume: z closes, x and y open
    for (int a = 0; a < 3; ++a) e.space.axes[static_cast<std::size_t>(a)] = {.rate = a == 2 ? -0.4 : 0.2};
    const double volume = e.space.volume(), work = e.totals().boundary_work, before = residual(e);
    const double until = e.time() + 0.1;
    while (e.time() < until) e.step();
    const mat3 sheared = measure::love_weber(e, e.space.volume());
    CHECK(e.space.volume() == Approx(volume).epsilon(1e-10));
    CHECK(sheared(2, 2) > 1.2 * sheared(0, 0));
    CHECK(e.totals().boundary_work - work > 0.1);
    CHECK(std::abs(residual(e) - before) < 1e-3 * (e.totals().boundary_work - work));
    CHECK(std::abs(residual(e)) < 1e-3 * e.totals().boundary_work);
}

TEST_CASE("where the origin of a cell is does not matter, also where damping acts") {
    const auto sheared = [](const vec3& by) {
        const auto start = packed(1e-3);
        bodies::spheres s = start.grains;
        spaces::periodic cell(start.space.edges());
        for (std::size_t a : {0U, 1U, 2U}) cell.axes[a] = {.rate = a == 2 ? -2.0 : 1.0};
        double u = 0.0; // affine, seen from either origin, and some motion beside that
        for (auto& p : s.pebbles) {
            p.x += by, u += 1.0;
            p.v = scale(cell.rates(), p.x) + 0.02 * vec3{std::sin(u), std::cos(2.0 * u), std::sin(3.0 * u)};
        }
        engine<in_a_cell> e(settings<in_a_cell>(0.2, 0.7, 1e-3), s, cell);
        for (int k = 0; k < 60; ++k) e.step();
        return e;
    };
    const vec3 by{0.031, -0.02, 0.043};
    const auto here = sheared({}), there = sheared(by);
    const vec3 edges = here.space.edges(), start = packed(1e-3).space.edges();
    const vec3 stretch{edges.x / start.x, edges.y / start.y, edges.z / start.z};
    double worst = 0.0;
    for (std::size_t k = 0; k < here.grains.pebble_count(); ++k) {
        vec3 d = there.grains.pebbles[k].x - here.grains.pebbles[k].x - scale(stretch, by);
        for (int a = 0; a < 3; ++a) d[a] -= edges[a] * std::round(d[a] / edges[a]);
        worst = std::max(worst, norm(d));
    }
    CHECK(here.losses().damping > 0.0);
    // grains keep their velocities in free flight while the edges of a cell at a constant rate are accelerated:
    // 6 cm (rate t)^2 = 3e-7 m; total velocities in the damping led 3e-5 apart
    CHECK(worst < 1e-6);
}

TEST_CASE("skin, search and threads do not change what a periodic packing does") {
    const auto one = packed(1e-3);
    auto three = packed(1e-3, 3);
    auto copy = one;
    CHECK(checksum(copy) == checksum(three));
    const auto wide = packed(3e-3);
    CHECK(wide.totals().renewals < one.totals().renewals);
    // not the same bits: grains are put back into the cell at other instants, and granular media are chaotic
    CHECK(wide.space.volume() == Approx(one.space.volume()).epsilon(5e-3));
}

TEST_CASE("spheres in a box: walls take their stress, and the audit closes") {
    const double l = 0.5 * 0.022 * 6;
    engine<in_a_box> e(settings<in_a_box>(0.2, 0.3, 1e-3), cloud(6, 0.2),
                       boundaries::box({{-l, -l, -l}, {l, l, l}, 1e8, 1e6}));
    e.drives.platens = e.drives.lateral = {boundaries::drive::mode::servo, 50e3, 0.2, 0.5};
    while (e.time() < 0.3) e.step();
    CHECK(e.boundary.axial_stress(e.loads()) == Approx(50e3).epsilon(1e-3));
    CHECK(e.boundary.stress(e.loads(), 0) == Approx(50e3).epsilon(1e-3));
    const mat3 sigma = measure::love_weber(e, e.boundary.volume());
    for (int a = 0; a < 3; ++a) CHECK(sigma(a, a) == Approx(50e3).epsilon(5e-3));
    CHECK(std::abs(residual(e)) < 1e-3 * e.totals().boundary_work);
}

TEST_CASE("the skin finds its size by itself, from too small and from too large") {
    const auto sheared = [](double start) {
        auto e = packed(start);
        e.space.axes[0] = {.rate = 5.0};
        e.space.axes[1] = {.rate = -5.0};
        const auto before = e.totals();
        e.step(8000);
        return std::pair{std::move(e), e.totals().renewals - before.renewals};
    };
    const auto [small, many] = sheared(0.004e-3);
    const auto [large, few] = sheared(0.1e-3);
    CHECK(many > 10);
    CHECK(static_cast<double>(many) < 2.0 * static_cast<double>(few)); // many times as many if it stayed
    CHECK(small.skin() == Approx(large.skin()).epsilon(0.4));
    // what costs more is done less often: open pairs in all steps against renewals
    CHECK(small.skin() > 0.008e-3);
    CHECK(large.skin() < 0.05e-3);
}

TEST_CASE("many steps at once are the same steps: bits of the grains, rows and stress of the last") {
    for (const bool servo : {true, false}) {
        auto one_by_one = packed(0.5e-3);
        for (auto& axis : one_by_one.space.axes) axis = servo ? axis : spaces::periodic::axis{.rate = -0.5};
        auto at_once = one_by_one;
        for (int k = 0; k < 3 * 37; ++k) one_by_one.step();
        for (int k = 0; k < 3; ++k) at_once.step(37);
        CHECK(checksum(at_once.grains) == checksum(one_by_one.grains));
        CHECK(at_once.space.edges() == one_by_one.space.edges());
        std::size_t touching = 0;
        std::vector<force_row> rows;
        one_by_one.each_contact([&](const force_row& row, const pebble_pair&) { rows.push_back(row); });
        std::size_t k = 0;
        at_once.each_contact([&](const force_row& row, const pebble_pair&) {
            CHECK(row.force == rows[k].force);
            touching += rows[k++].depth > 0.0;
        });
        CHECK(k == rows.size());
        CHECK(touching > 300);
        const mat3 sigma = measure::love_weber(at_once, at_once.space.volume());
        CHECK(at_once.space.stress().x == Approx(sigma(0, 0)).epsilon(servo ? 0.05 : 1e-3));
    }
}
