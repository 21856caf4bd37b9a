// SPDX-License-Identifier: MIT
// Every number of the library is a fraction of something of the scene: a test whose length, density and stress are
// multiplied by powers of four goes on with the same bits in units of its own. Powers of four, because their square
// roots are exact; of 64 where a model takes cube roots. One absolute number in a step, a control or a condition, a
// time, a force or a stress, and rows differ.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/boundaries/rigid_cylinder.hpp>
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/core/random.hpp>
#include <clast/criteria/hertz_contact.hpp>
#include <clast/criteria/nominal_force.hpp>
#include <clast/criteria/weibull.hpp>
#include <clast/fields/gravity.hpp>
#include <clast/io/csv.hpp>
#include <clast/measure/stress.hpp>
#include <clast/protocol/triaxial.hpp>
#include <clast/replacements/modified.hpp>
#include <clast/spaces/periodic.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"
#include "equivalence/toy.hpp"

using namespace clast;

namespace {

/// By how much a scene is larger than the original one, and what follows for other units.
struct factors {
    double length = 1.0, density = 1.0, stress = 1.0;

    double time() const { return length * std::sqrt(density / stress); }
    double stiffness() const { return stress * length; }
    double force() const { return stress * length * length; }
    double energy() const { return force() * length; }
    /// Of a column; not a number where its unit is new here.
    double of_unit(std::string_view unit) const {
        const std::pair<std::string_view, double> known[] = {
            {"", 1.0},      {"deg", 1.0},   {"s", time()},   {"m", length},   {"m3", length * length * length},
            {"N", force()}, {"Pa", stress}, {"J", energy()}, {"Nm", energy()}};
        for (const auto& [name, factor] : known)
            if (unit == name) return factor;
        return std::numeric_limits<double>::quiet_NaN();
    }
};
/// Each alone, small and large, and mixtures.
constexpr factors powers_of_4[] = {
    {4.0, 1.0, 1.0}, {1.0, 0.0625, 1.0}, {16.0, 4.0, 16.0}, {0.25, 4.0, 4.0}, {1024.0, 1.0, 4.0}};
constexpr factors powers_of_64[] = {{64.0, 1.0, 1.0}, {1.0 / 64.0, 4.0, 64.0}, {4096.0, 0.0625, 1.0}};

/// What a test of one scene has left behind.
struct record {
    std::vector<sample> rows;
    std::vector<fracture_event> events;
};

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// Names of the columns in which a row of the scaled scene is not that of the original one in its units; the clock on
/// the wall left out.
template <class Row> std::string differences(Row original, Row scaled, const factors& by) {
    std::string names;
    for (const column<Row>& c : clast::detail::columns_of<Row>()) {
        if (std::string_view(c.name) == "wall_time") continue;
        const cell other = c.member(scaled);
        const bool same = std::visit(
            [&]<class T>(T* value) {
                if constexpr (std::is_same_v<T, double>)
                    return same_bits(*value * by.of_unit(c.unit), **std::get_if<T*>(&other));
                else
                    return *value == **std::get_if<T*>(&other);
            },
            c.member(original));
        if (c.title() == "hardin_Br") continue; // by definition against 0.074 mm, whatever the size of grains
        if (!same) names += c.title() + ' ';
    }
    return names;
}
template <class Row>
void check_rows(const std::vector<Row>& original, const std::vector<Row>& scaled, const factors& by) {
    for (std::size_t k = 0; k < std::min(original.size(), scaled.size()); ++k) {
        const std::string different = differences(original[k], scaled[k], by);
        if (different.empty()) continue;
        INFO("row " << k << " of " << original.size());
        CHECK(different == ""); // the first one tells: the rest follows from it
        return;
    }
    CHECK(original.size() == scaled.size());
}
template <class Run, std::size_t N> record check_similar(Run&& run, const factors (&all)[N]) {
    const record original = run(factors{});
    for (const factors& by : all) {
        INFO("length x " << by.length << ", density x " << by.density << ", stress x " << by.stress);
        const record scaled = run(by);
        check_rows(original.rows, scaled.rows, by);
        check_rows(original.events, scaled.events, by);
    }
    return original;
}

// ---- whole tests ----------------------------------------------------------------------------------------------------

table_1 pieces(const factors& by) {
    table_1 t;
    for (contacts::piece* one : {&t.pebble, &t.platen, &t.membrane})
        one->normal_stiffness *= by.stiffness(), one->shear_stiffness *= by.stiffness();
    t.density *= by.density;
    return t;
}
/// Bonds as soft and weak as those of toy.hpp; the unit of a stiffness is that of its reading.
bonds::parallel bond(const factors& by, bonds::stiffness_reading reading) {
    using enum bonds::stiffness_reading;
    constexpr double radius = 0.0045; // about that of a pebble (m): the readings give bonds about as stiff
    const double unit = reading == force      ? by.stiffness()
                        : reading == per_area ? by.stress / by.length / (3.14 * radius * radius)
                                              : by.stress * 2.0 / (3.14 * radius);
    bonds::parallel b;
    b.reading = reading;
    b.normal_stiffness *= 0.06 * unit, b.shear_stiffness *= 0.06 * unit;
    b.tensile_strength *= 0.06 * by.stress, b.cohesion *= 0.06 * by.stress;
    return b;
}
/// A toy of clumps or spheres with what differs from bundle to bundle.
template <class P>
triaxial_setup<P> toy_setup(const factors& by, materials_of<typename P::contact> materials,
                            typename P::breakage breakage = {}, typename P::replacement replacement = {}) {
    shape grain =
        P::body::turns ? shapes::tetrahedron_4(circumscribed(0.02 * by.length)) : shapes::sphere(0.02 * by.length);
    return {.grain = std::move(grain),
            .diameter = quantities::length(0.066 * by.length),
            .height = quantities::length(0.075 * by.length),
            .confining = quantities::stress(2e5 * by.stress),
            .breakage = std::move(breakage),
            .replacement = std::move(replacement),
            .porosity = 0.62,
            .rings = 4,
            .tiles_per_ring = 8,
            .materials = materials,
            .inertial_number = 5e-3};
}
/// The ready-made test, with a consolidation that is soon content. impatient: the relaxation is given up early, so that
/// the specimen is seated.
template <class P> record run_toy(triaxial_setup<P> setup, double strain, bool impatient) {
    std::vector<stage> stages = protocol::triaxial_compression(quantities::ratio(strain));
    stages[0].yields_at = 0.1; // for fewer steps
    if (impatient) stages[1].most_steps = 400, stages[2].end = until::steps(500);
    stages[3].end = until::stresses_within(0.05) || until::steps(6000);
    stages[3].breakage = false;
    triaxial_test<P> test(std::move(setup), std::move(stages));
    toy::recorder watch;
    REQUIRE(test.run(watch));
    return {std::move(watch.rows), std::move(watch.events)};
}
std::size_t rows_of(const record& r, const std::string& stage) {
    return static_cast<std::size_t>(
        std::count_if(r.rows.begin(), r.rows.end(), [&](const sample& s) { return s.stage == stage; }));
}

template <class Boundary, class Body = bodies::clumps, class Contact = contacts::linear>
struct whole : scenes::unbreakable<Boundary> {
    using body = Body;
    using contact = Contact;
};
struct by_pressure : scenes::breakable<boundaries::ring_walls> {
    using breakage = criteria::weibull<criteria::hertz_contact>;
};

} // namespace

TEST_CASE("grains that break in tiles are similar to the last bit, large or small, dense or light, hard or soft") {
    using P = toy::bundle<boundaries::tiles>;
    const record r = check_similar(
        [](const factors& by) {
            return run_toy<P>(toy_setup<P>(by, pieces(by),
                                           {criteria::crushing_strength(5e5 * by.stress, 0.02 * by.length)},
                                           {.bond = bond(by, bonds::stiffness_reading::force)}),
                              0.04, false);
        },
        powers_of_4);
    CHECK(r.rows.back().replaced >= 3);
    CHECK(r.events.size() >= 7);
    CHECK(rows_of(r, "relax") >= 2); // ended by a stress or a force
    CHECK(rows_of(r, "seat") == 0);
    CHECK(rows_of(r, "consolidate") >= 2);
    CHECK(rows_of(r, "shear") >= 40);
}

TEST_CASE("so are those that break in rings by a pressure of Hertz, with scatter and bonds of a modulus") {
    const record r = check_similar(
        [](const factors& by) {
            const auto model = criteria::hertz_contact::calibrated(
                criteria::crushing_strength(5e5 * by.stress, 0.015 * by.length, 3.0), 46.8e9 * by.stress);
            return run_toy<by_pressure>(toy_setup<by_pressure>(by, pieces(by), {.model = model, .m = 5.0, .seed = 1},
                                                               {.bond = bond(by, bonds::stiffness_reading::modulus)}),
                                        0.03, false);
        },
        powers_of_64);
    CHECK(r.events.size() >= 7);
}

TEST_CASE(
    "so are those that break in a rough rigid cylinder once they were seated, with bonds of a stiffness per area") {
    using P = toy::bundle<boundaries::rigid_cylinder>;
    const record r = check_similar(
        [](const factors& by) {
            table_1 rough = pieces(by);
            rough.platen.friction = rough.membrane.friction = 0.2;
            return run_toy<P>(toy_setup<P>(by, rough,
                                           {criteria::crushing_strength(5e5 * by.stress, 0.015 * by.length, 3.0)},
                                           {.bond = bond(by, bonds::stiffness_reading::per_area)}),
                              0.02, true);
        },
        powers_of_4);
    CHECK(r.events.size() >= 7);
    CHECK(rows_of(r, "seat") >= 2);
}

TEST_CASE("so are whole grains in strips, and spheres of a law without stiffness at first touch in a box") {
    using strips = whole<boundaries::solid_strips>;
    using box = whole<boundaries::box, bodies::spheres, scenes::hertz>;
    check_similar([](const factors& by) { return run_toy<strips>(toy_setup<strips>(by, pieces(by)), 0.02, false); },
                  powers_of_4);
    const record r = check_similar(
        [](const factors& by) {
            const contacts_of_law<scenes::hertz> laws{
                {1e8 * by.stress, 0.3}, {2e8 * by.stress}, {2e8 * by.stress}, 2650.0 * by.density};
            return run_toy<box>(toy_setup<box>(by, laws), 0.02, true);
        },
        powers_of_4);
    CHECK(rows_of(r, "seat") >= 2);
    CHECK(r.rows.back().q > 1e4);
}

// ---- a periodic cell: no runner, so rows are made here --------------------------------------------------------------

namespace {

struct in_cell : whole<boundaries::none, bodies::spheres, contacts::linear_dashpot> {
    using space = spaces::periodic;
    using field = fields::gravity;
};

sample row_of(const engine<in_cell>& e) {
    sample s;
    const mat3 stress = measure::love_weber(e, e.space.volume());
    const measure::contact_state c = measure::contacts_of(e);
    const body_losses lost = e.losses();
    s.time = e.time(), s.dt = e.dt(), s.steps = e.totals().steps;
    s.height = e.space.edges().z, s.volume = e.space.volume();
    s.sigma_1 = e.space.stress().z, s.sigma_3 = e.space.stress().x;
    s.sigma_1_love_weber = stress(2, 2), s.sigma_3_love_weber = stress(0, 0);
    s.unbalanced_ratio = c.unbalanced_ratio, s.coordination = c.coordination;
    s.max_overlap_over_r = c.max_overlap_over_r;
    s.kinetic_energy = e.kinetic_energy(), s.elastic_energy = e.elastic_energy();
    s.boundary_work = e.totals().boundary_work;
    s.friction_dissipation = lost.friction, s.damping_dissipation = lost.damping;
    return s;
}
/// Spheres in a light field, brought from a grid to a stress, then compressed along z.
record run_cell(const factors& by) {
    constexpr int n = 4;
    const double spacing = 0.022 * by.length, rate = 1.0 / by.time(), speed = 0.1 * by.length * rate;
    bodies::spheres s;
    s.density = 2650.0 * by.density;
    for (int k = 0; k < n * n * n; ++k) {
        const auto at = [&](int i) { return spacing * (i - 0.5 * (n - 1)); };
        s.add({at(k % n), at(k / n % n), at(k / n / n)}, (k % 3 == 0 ? 0.008 : 0.01) * by.length);
        random_stream random{1, static_cast<std::uint64_t>(k)};
        s.pebbles.back().v = speed * direction(random);
    }
    const contacts::linear_dashpot law{1e6 * by.stiffness(), 5e5 * by.stiffness(), 0.3, 200.0 * rate};
    engine<in_cell> e({.grain_contact = law,
                       .platen_contact = law,
                       .lateral_contact = law,
                       .breakage = {},
                       .replacement = {},
                       .scheme = {.damping = 0.3},
                       .field = {{0.0, 0.0, -0.1 * by.length * rate * rate}}},
                      std::move(s), spaces::periodic({spacing * n, spacing * n, spacing * n}));
    for (auto& axis : e.space.axes) axis = {.target = 5e4 * by.stress, .max_rate = 2.0 * rate, .gain = 0.2};
    e.space.axes[1] = {.target = 5e4 * by.stress, .gain = 0.2}; // as fast as the library lets it
    record r;
    for (int k = 0; k < 80; ++k) {
        if (k == 60) e.space.axes[2] = {.rate = -0.5 * rate};
        for (int step = 0; step < 100; ++step) e.step();
        r.rows.push_back(row_of(e));
    }
    return r;
}

} // namespace

TEST_CASE("so are spheres with dashpots in a periodic cell, driven by stresses and by a rate") {
    const record r = check_similar(run_cell, powers_of_4);
    CHECK(r.rows[59].sigma_1 > 2e4);
    CHECK(r.rows.back().sigma_1 > 1.1 * r.rows.back().sigma_3);
}
