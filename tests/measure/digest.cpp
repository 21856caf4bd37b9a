// SPDX-License-Identifier: MIT
#include <clast/measure/digest.hpp>

#include <cmath>
#include <limits>
#include <utility>

#include <catch.hpp>

#include <clast/bodies/spheres.hpp>
#include <clast/spaces/periodic.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

constexpr std::int64_t least_broken = 5;

/// Clumps, clusters and balls, with contacts of every kind.
engine<scenes::breakable<boundaries::tiles>> broken(int threads) {
    using P = scenes::breakable<boundaries::tiles>;
    auto s = scenes::settings<P>(3e5, 0.05);
    s.run = execution(threads);
    s.contacts_per_thread = 8; // cut even this scene into ranges
    auto e = scenes::packed<P>(s, shapes::tetrahedron_4(circumscribed(0.02)), 60, 0.052, 2e5, 1500);
    e.breakage_on = true;
    e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.2};
    e.step(1500);
    (void)e.take_events();
    return e;
}

/// Clumps or spheres on a grid in a cell that closes.
template <class Body> struct in_cell : triaxial_policies_default {
    using body = Body;
    using boundary = boundaries::none;
    using space = spaces::periodic;
    using breakage = criteria::none;
    using replacement = replacements::none;
};
template <class Body> engine<in_cell<Body>> cell(int threads) {
    constexpr int n = 5;
    Body s;
    if constexpr (Body::turns) s.shapes.push_back(shapes::tetrahedron_4(circumscribed(0.02)));
    for (int k = 0; k < n * n * n; ++k) {
        const auto at = [](int i) { return 0.0202 * (i - 0.5 * (n - 1)); };
        const vec3 x{at(k % n), at(k / n % n), at(k / n / n)};
        if constexpr (Body::turns)
            s.add(0, x, unit(quaternion{1.0, 0.1 * (k % 7), 0.2 * (k % 5), 0.3 * (k % 3)}));
        else
            s.add(x, 0.0095 + 0.0001 * (k % 5));
    }
    auto settings = scenes::settings<in_cell<Body>>();
    settings.run = execution(threads);
    settings.contacts_per_thread = 8;
    engine<in_cell<Body>> e(settings, std::move(s), spaces::periodic({0.101, 0.101, 0.101}));
    for (auto& axis : e.space.axes) axis = {.rate = -1.0};
    e.step(400);
    return e;
}

double next(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

/// Whether a change, which is taken back, shows in a digest.
template <class Engine> void check_that_change_shows(Engine& e, double& number, bool in_state = true) {
    const std::uint64_t all = measure::digest(e), state = measure::digest_of_state(e);
    const double before = std::exchange(number, next(number));
    CHECK(measure::digest(e) != all);
    CHECK((measure::digest_of_state(e) != state) == in_state);
    number = before;
    CHECK(measure::digest(e) == all);
}

template <class Make> void check_threads_and_archive(Make&& make) {
    auto one = make(1);
    const std::uint64_t digest = measure::digest(one), state = measure::digest_of_state(one);
    CHECK(digest != state);
    for (const int threads : {2, 3}) {
        auto e = make(threads);
        CHECK(measure::digest(e) == digest);
        CHECK(measure::digest_of_state(e) == state);
        from_bytes(to_bytes(one), e);
        CHECK(measure::digest_of_state(e) == state);
        auto on = make(1);
        on.step(7), e.step(7);
        CHECK(measure::digest(e) == measure::digest(on)); // wall forces are back
        CHECK(measure::digest(e) != digest);
    }
}

} // namespace

TEST_CASE("a digest is the same on 1, 2 and 3 threads and through an archive") {
    check_threads_and_archive([](int threads) {
        auto e = broken(threads);
        REQUIRE(e.totals().broken_tension + e.totals().broken_shear >= least_broken);
        REQUIRE(e.light_contacts().size() > 0);
        if (threads > 1) REQUIRE(e.heavy_contacts().shared > 0);
        return e;
    });
    check_threads_and_archive([](int threads) { return cell<bodies::spheres>(threads); });
    check_threads_and_archive([](int threads) { return cell<bodies::clumps>(threads); });
}

TEST_CASE("a digest shows a change of one place, velocity, history, bond or wall force by a bit") {
    auto e = broken(2);
    const auto ball = static_cast<std::size_t>(e.breakage().balls.at(0));
    const std::size_t clump = static_cast<std::size_t>(
        std::find_if(e.grains.grains.begin(), e.grains.grains.end(), [](const grain& g) { return g.cluster < 0; }) -
        e.grains.grains.begin());
    check_that_change_shows(e, e.grains.pebbles[ball].x.y);
    check_that_change_shows(e, e.grains.pebbles[ball].radius);
    check_that_change_shows(e, e.grains.motion[clump].v.z);
    check_that_change_shows(e, e.grains.motion[e.grains.grain_count() + ball].w.x);
    check_that_change_shows(e, e.grains.turning[clump].l.x);
    check_that_change_shows(e, e.grains.losses[clump].damping);
    // no engine lets these be written, and none of these is const
    using history = contacts::linear::history;
    check_that_change_shows(e, const_cast<history&>(e.heavy_contacts().history.back()).y);
    check_that_change_shows(e, const_cast<history&>(e.light_contacts().history.front()).z);
    check_that_change_shows(e, const_cast<engine_totals&>(e.totals()).boundary_work);
    check_that_change_shows(e, const_cast<boundaries::facet_load&>(e.loads()[1]).force, false);
    double* force = nullptr;
    e.each_wall_row([&](const auto& w) { force = &const_cast<vec3&>(w.force).x; });
    REQUIRE(force != nullptr);
    check_that_change_shows(e, *force, false);

    auto spheres = cell<bodies::spheres>(1);
    check_that_change_shows(spheres, spheres.grains.pebbles[7].x.z);
    check_that_change_shows(spheres, spheres.grains.pebbles[7].v.x);
    spheres.space.axes[1].rate = 1.0;
    CHECK(measure::digest(spheres) != measure::digest_of_state(spheres));
}

TEST_CASE("a digest does not look at what is left of bodies that are no more") {
    auto e = broken(1);
    const std::uint64_t digest = measure::digest(e);
    const std::size_t replaced = static_cast<std::size_t>(
        std::find_if(e.grains.grains.begin(), e.grains.grains.end(), [](const grain& g) { return g.cluster >= 0; }) -
        e.grains.grains.begin());
    REQUIRE(replaced < e.grains.grain_count());
    e.grains.motion[replaced].v.x += 1.0;
    CHECK(measure::digest(e) == digest);
}

TEST_CASE("a law without a history has a digest") {
    struct frictionless {
        struct history {};
        double k = 1e6;
        contacts::response<double> operator()(const contacts::overlap<double>& o, const contacts::motion<double>&,
                                              history&, double) const {
            const double f = o.depth > 0.0 ? k * o.depth : 0.0;
            return {-f * o.nx, -f * o.ny, -f * o.nz, 0.0};
        }
        double stored(const contacts::overlap<double>& o, const history&) const {
            return o.depth > 0.0 ? 0.5 * k * o.depth * o.depth : 0.0;
        }
        double normal_stiffness(const contacts::overlap<double>&) const { return k; }
        double shear_stiffness(const contacts::overlap<double>&) const { return 0.0; }
    };
    struct policies : scenes::unbreakable<> {
        using contact = frictionless;
    };
    const auto run = [](std::int64_t steps) {
        bodies::clumps sp = scenes::empty(shapes::tetrahedron_4(circumscribed(0.02)));
        sp.add(0, {}, {});
        sp.add(0, {0, 0, 0.0195}, {});
        engine<policies> e(
            {.grain_contact = {}, .platen_contact = {}, .lateral_contact = {}, .breakage = {}, .replacement = {}},
            std::move(sp), boundaries::solid_strips(scenes::cylinder(0.05, 0.08)));
        e.step(steps);
        return measure::digest(e);
    };
    CHECK(run(20) == run(20));
    CHECK(run(20) != run(21));
}
