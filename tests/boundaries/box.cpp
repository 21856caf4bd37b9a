// SPDX-License-Identifier: MIT
#include <clast/boundaries/box.hpp>

#include <cmath>
#include <vector>

#include <clast/boundaries/concepts.hpp>
#include <clast/io/archive.hpp>

#include <catch.hpp>

using namespace clast;
using boundaries::box;
using boundaries::drive;
using boundaries::drives;
using boundaries::facet_load;
using boundaries::touches;

static_assert(boundaries::surface<box>);

namespace {
box unit_box() { return box({{0, 0, 0}, {1, 2, 3}, 1e8, 1e6}); }
drives moving(double platens, double lateral) {
    drives d;
    d.platens = {drive::mode::velocity, platens, 0.0, 0.5};
    d.lateral = {drive::mode::velocity, lateral, 0.0, 0.5};
    return d;
}
} // namespace

TEST_CASE("a sphere in a corner of a box touches three walls, each along its own normal") {
    const box b = unit_box();
    const touches t = b.touch({0.09, 1.92, 2.93}, 0.1);
    REQUIRE(t.size == 3);
    vec3 out;
    for (const auto& one : t) out += one.depth * one.normal;
    CHECK(norm(out - vec3{0.01, -0.02, -0.03}) < 1e-15);
    CHECK(b.touch({0.5, 1.0, 1.5}, 0.1).size == 0);
    CHECK(b.near({0.09, 1.0, 1.5}, 0.1));
    CHECK_FALSE(b.near({0.5, 1.0, 1.5}, 0.1));
    CHECK(b.outside({-0.11, 1.0, 1.0}, 0.1));
    CHECK_FALSE(b.outside({-0.09, 1.0, 1.0}, 0.1));
    CHECK(b.outside({std::nan(""), 1.0, 1.0}, 0.1));
}

TEST_CASE("walls move inward at their speed, areas and volume follow, and a contact seen ahead is the later one") {
    box b = unit_box();
    std::vector<facet_load> loads(6);
    b.control(loads, moving(0.1, -0.05), 1e-3);
    CHECK(b.velocity(0) == 0.1);
    CHECK(b.velocity(3) == -0.05);
    double rate = 0.0;
    for (int f = 0; f < 6; ++f) rate += b.area(f) * b.velocity(f);
    const double before = b.volume();
    const double ahead = b.touch({0.5, 1.0, 0.09}, 0.1, 0.1).at[0].depth;
    b.advance(1e-6);
    CHECK((before - b.volume()) / 1e-6 == Approx(rate).epsilon(1e-5));
    b.advance(0.1 - 1e-6);
    CHECK(b.touch({0.5, 1.0, 0.09}, 0.1).at[0].depth == Approx(ahead).epsilon(1e-12));
    CHECK(ahead == Approx(0.02).epsilon(1e-12));
    CHECK(b.height() == Approx(2.98).epsilon(1e-12));
    CHECK(b.low().x == Approx(-0.005).epsilon(1e-12));
    CHECK(b.section() == Approx(1.01 * 2.01).epsilon(1e-12));
}

TEST_CASE("servo walls of a box follow stress and area of their own pair") {
    box b = unit_box();
    std::vector<facet_load> loads(6);
    for (int f = 0; f < 6; ++f) loads[static_cast<std::size_t>(f)] = {1e5 * b.area(f), 1e7, 1};
    drives d;
    d.platens = d.lateral = {drive::mode::servo, 1e5, 0.1, 0.5};
    b.control(loads, d, 1e-5);
    CHECK(b.fastest() < 1e-12);
    CHECK(b.axial_stress(loads) == Approx(1e5).epsilon(1e-14));
    CHECK(b.confining_error(loads, 1e5) < 1e-14);
    loads[2].force *= 1.2; // x walls too hard: they open, the others stay
    b.control(loads, d, 1e-5);
    CHECK(b.velocity(2) == Approx(-std::min(0.1, 0.5 * 0.1 * 1e5 * b.area(2) / 1e7 / 1e-5)));
    CHECK(b.velocity(3) == b.velocity(2));
    CHECK(std::abs(b.velocity(4)) < 1e-12);
    CHECK(std::abs(b.velocity(0)) < 1e-12);
    CHECK(b.stress(loads, 0) == Approx(1.1e5).epsilon(1e-12));
    CHECK(b.confining_rms(loads, 1e5) == Approx(0.1 / std::sqrt(2.0)).epsilon(1e-9));
    CHECK(b.power(loads) == Approx(2.2e5 * b.area(2) * b.velocity(2)).epsilon(1e-9));
}

TEST_CASE("a box has three driven axes: y walls follow a drive of their own where there is one, else that of x") {
    box b = unit_box();
    std::vector<facet_load> loads(6);
    drives d = moving(0.1, 0.2);
    b.control(loads, d, 1e-3);
    CHECK(b.velocity(4) == 0.2);
    d.lateral_y = drive{drive::mode::velocity, -0.3, 0.0, 0.5};
    b.control(loads, d, 1e-3);
    CHECK(b.velocity(0) == 0.1);
    CHECK(b.velocity(3) == 0.2);
    CHECK(b.velocity(4) == -0.3);
    CHECK(b.velocity(5) == -0.3);
    for (int f = 0; f < 6; ++f) loads[static_cast<std::size_t>(f)] = {1e5 * b.area(f), 1e7, 1};
    d.lateral = {drive::mode::servo, 1e5, 0.1, 0.5};
    d.lateral_y = drive{drive::mode::servo, 2e5, 0.1, 0.5};
    b.control(loads, d, 1e-5);
    CHECK(std::abs(b.velocity(2)) < 1e-12);
    CHECK(b.velocity(4) == Approx(std::min(0.1, 0.5 * 1e5 * b.area(4) / 1e7 / 1e-5)));
    d.lateral_y->max_speed = 0.0;
    CHECK_THROWS_AS(b.control(loads, d, 1e-5), input_error);
}

TEST_CASE("lateral walls of a box take a volume at one speed") {
    box b = unit_box();
    const std::vector<facet_load> loads(6);
    drives d = moving(0.1, 0.0);
    d.lateral = {drive::mode::volume, -0.5, 1.0, 0.5};
    b.control(loads, d, 1e-3);
    double taken = 0.0;
    for (int f = 2; f < 6; ++f) taken += b.area(f) * b.velocity(f);
    CHECK(taken == Approx(-0.5).epsilon(1e-12));
    CHECK(b.velocity(2) == b.velocity(5));
    d.lateral.max_speed = 0.0;
    CHECK_THROWS_AS(b.control(loads, d, 1e-3), input_error);
}

TEST_CASE("a box without inside is refused, walls that meet stop the run, and the rest comes back from an archive") {
    CHECK_THROWS_AS(box({{0, 0, 0}, {1, 0, 1}, 1e8, 1e6}), input_error);
    CHECK_THROWS_AS(box({{0, 0, 0}, {1, 1, 1}, 1e8, 0.0}), input_error);
    box b = unit_box(), copy({{0, 0, 0}, {1, 1, 1}, 1e8, 1e6});
    b.control(std::vector<facet_load>(6), moving(0.0, 1.0), 1e-3);
    b.advance(0.1);
    from_bytes(to_bytes(b), copy);
    CHECK(checksum(copy) == checksum(b));
    CHECK(copy.volume() == b.volume());
    CHECK_THROWS_AS(b.advance(0.5), run_error);
    double area = 0.0;
    for (const auto& f : copy.view(std::vector<facet_load>(6))) area += f.area;
    CHECK(area == Approx(2 * (0.8 * 1.8 + 0.8 * 3 + 1.8 * 3)).epsilon(1e-12));
}
