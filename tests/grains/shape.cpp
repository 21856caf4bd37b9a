// SPDX-License-Identifier: MIT
#include <clast/grains/shape.hpp>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include <catch.hpp>

using namespace clast;

namespace {

constexpr double pi = std::numbers::pi;

/// Inertia tensor by another road: for each pebble integrate (r^2 E - r r^T) over a ball with moments of a solid ball,
/// int x_i x_j dV = V (c_i c_j + delta_ij r^2 / 5).
double second_moment(const shape& s, int i, int j) {
    double sum = 0.0;
    for (const shape_pebble& p : s.pebbles)
        sum += 4.0 / 3.0 * pi * std::pow(p.radius, 3) *
               (p.offset[i] * p.offset[j] + (i == j ? p.radius * p.radius / 5.0 : 0.0));
    return sum;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_CASE("shape 4B is a regular tetrahedron of four touching pebbles in its circumscribed sphere") {
    const shape s = shapes::tetrahedron_4(circumscribed(0.02));
    REQUIRE(s.pebbles.size() == 4);
    CHECK(s.bonds.size() == 6);
    CHECK(s.diameter == Approx(0.02).epsilon(1e-15));
    for (const shape_pebble& p : s.pebbles) {
        CHECK(p.radius == Approx(0.01 * 0.4494897427831781).epsilon(1e-14)); // sqrt(6) - 2
        CHECK(norm(p.offset) + p.radius == Approx(0.01).epsilon(1e-15));
        CHECK(norm(p.offset) == Approx(5.505102572e-3).epsilon(1e-9));
    }
    CHECK(s.volume == Approx(1.522e-6).epsilon(5e-4));
    CHECK(s.volume / sphere_volume(0.01) == Approx(0.3632615).epsilon(1e-6));
    CHECK(s.phi_nominal == 0.71);
}

TEST_CASE("shape 14B is the octahedral Apollonian packing 6 + 8 with 36 bonds") {
    const shape s = shapes::apollonian_14(circumscribed(0.02));
    REQUIRE(s.pebbles.size() == 14);
    CHECK(s.bonds.size() == 36);
    int big_big = 0;
    int big_small = 0;
    for (const shape_bond& b : s.bonds) {
        CHECK(b.a < b.b);
        (b.b < 6 ? big_big : big_small) += 1;
        CHECK(b.a < 6); // no small-small contact
    }
    CHECK(big_big == 12);
    CHECK(big_small == 24);
    for (std::size_t i = 0; i < 14; ++i) {
        const shape_pebble& p = s.pebbles[i];
        CHECK(norm(p.offset) + p.radius == Approx(0.01).epsilon(1e-14)); // all touch the circumscribed sphere
        CHECK(p.radius == Approx(i < 6 ? 4.142e-3 : 2.30e-3).epsilon(1e-3));
    }
    CHECK(s.volume == Approx(2.194e-6).epsilon(5e-4));
    CHECK(s.volume / sphere_volume(0.01) == Approx(0.524).epsilon(1e-3));
}

TEST_CASE("the pebbles of a shape touch but do not overlap beyond rounding") {
    for (const shape& s : {shapes::tetrahedron_4(circumscribed(0.02)), shapes::apollonian_14(circumscribed(0.02))})
        for (const shape_bond& b : s.bonds) {
            const shape_pebble& p = s.pebbles[static_cast<std::size_t>(b.a)];
            const shape_pebble& q = s.pebbles[static_cast<std::size_t>(b.b)];
            CHECK(std::abs(norm(p.offset - q.offset) - p.radius - q.radius) < 1e-15 * 20 * s.diameter);
        }
}

TEST_CASE("4B and 14B have isotropic inertia that equals the second moments of their balls") {
    for (const shape& s : {shapes::tetrahedron_4(circumscribed(0.02)), shapes::apollonian_14(circumscribed(0.02)),
                           shapes::sphere(0.02)}) {
        CHECK(s.inertia_per_density.x == s.inertia_per_density.y); // bit-equal: integrators rely on it
        CHECK(s.inertia_per_density.y == s.inertia_per_density.z);
        for (int i = 0; i < 3; ++i) {
            const double exact =
                second_moment(s, (i + 1) % 3, (i + 1) % 3) + second_moment(s, (i + 2) % 3, (i + 2) % 3);
            CHECK(s.inertia_per_density[i] == Approx(exact).epsilon(1e-14));
            CHECK(std::abs(second_moment(s, i, (i + 1) % 3)) < 1e-14 * exact);
        }
        CHECK(s.to_input_frame == quaternion{});
        CHECK(norm(s.mass_centre) < 1e-17);
    }
    CHECK(shapes::sphere(0.02).inertia_per_density.x == Approx(0.4 * sphere_volume(0.01) * 1e-4).epsilon(1e-15));
}

TEST_CASE("a two-sphere clump has the mass, centroid and inertia of the parallel axis theorem") {
    // radii 1 and 0.5 at distance 3, along x
    const shape s = make_shape("pair", {{{2, 7, -1}, 1.0}, {{5, 7, -1}, 0.5}});
    const double v1 = 4.0 / 3.0 * pi;
    const double v2 = v1 / 8.0;
    CHECK(s.volume == Approx(1.125 * v1).epsilon(1e-15));
    CHECK(s.mass_centre.x == Approx(2.0 + 3.0 * v2 / (v1 + v2)).epsilon(1e-15)); // 2 + 1/3
    CHECK(s.mass_centre.y == Approx(7.0).epsilon(1e-15));
    const double axial = 0.4 * (v1 + v2 * 0.25);
    const double lateral = axial + v1 * v2 / (v1 + v2) * 9.0;
    CHECK(s.inertia_per_density.x == Approx(axial).epsilon(1e-14));
    CHECK(s.inertia_per_density.y == Approx(lateral).epsilon(1e-14));
    CHECK(s.inertia_per_density.y == s.inertia_per_density.z);
    CHECK(s.bonds.empty());
    CHECK(pieces(s) == 2);
    CHECK(s.circumscribed_radius == Approx(3.0 * 8.0 / 9.0 + 0.5).epsilon(1e-15));
}

TEST_CASE("principal axes are right-handed and lead back to the given pebbles") {
    const vec3 shift{0.3, -0.2, 0.9};
    const std::vector<shape_pebble> given = {
        {{0, 0, 0}, 1.0}, {{1.9, 0.4, 0.6}, 0.9}, {{-0.3, 1.6, 0.2}, 0.5}, {{0.5, -0.3, -1.5}, 0.55}};
    std::vector<shape_pebble> moved = given;
    for (shape_pebble& p : moved) p.offset += shift;
    const shape s = make_shape("irregular", moved);
    const double scale = s.inertia_per_density.z;
    CHECK(s.inertia_per_density.x < s.inertia_per_density.y);
    CHECK(s.inertia_per_density.y < s.inertia_per_density.z);
    for (int i = 0; i < 3; ++i) CHECK(std::abs(second_moment(s, i, (i + 1) % 3)) < 1e-13 * scale);
    for (std::size_t i = 0; i < given.size(); ++i)
        CHECK(norm(rotate(s.to_input_frame, s.pebbles[i].offset) + s.mass_centre - moved[i].offset) < 1e-14);
}

TEST_CASE("a body of revolution keeps its axis first and does not spin freely about it") {
    const vec3 axis = unit(vec3{1, 2, 2});
    const shape s = make_shape("dumbbell", {{axis, 1.0}, {-axis, 1.0}});
    CHECK(s.inertia_per_density.y == s.inertia_per_density.z);
    CHECK(s.inertia_per_density.x < s.inertia_per_density.y);
    CHECK(norm(rotate(s.to_input_frame, {1, 0, 0}) - axis) < 1e-14);
    // the second axis is the given axis that is least along the body's axis (here x), made normal to it
    CHECK(norm(rotate(s.to_input_frame, {0, 1, 0}) - unit(reject(vec3{1, 0, 0}, axis))) < 1e-14);
    CHECK(s.bonds.size() == 1);
}

TEST_CASE("scaling a shape scales volume with d^3 and inertia with d^5") {
    const shape a = shapes::apollonian_14(circumscribed(0.02));
    const shape b = scaled_to(a, circumscribed(0.06));
    const shape c = shapes::apollonian_14(circumscribed(0.06));
    CHECK(b.diameter == 0.06);
    CHECK(b.volume == Approx(27.0 * a.volume).epsilon(1e-14));
    CHECK(b.inertia_per_density.x == Approx(243.0 * a.inertia_per_density.x).epsilon(1e-14));
    CHECK(b.inertia_per_density.x == b.inertia_per_density.z);
    CHECK(c.inertia_per_density.x == Approx(b.inertia_per_density.x).epsilon(1e-14));
    CHECK(norm(c.pebbles[9].offset - b.pebbles[9].offset) < 1e-16);
    CHECK_THROWS_AS(scaled_to(a, circumscribed(0.0)), input_error);
    CHECK_THROWS_AS(scaled_to(a, circumscribed(std::nan(""))), input_error);
    CHECK_THROWS_AS(shapes::tetrahedron_4(circumscribed(-0.02)), input_error);
}

TEST_CASE("summed-surface sphericity has its analytic values") {
    CHECK(sphericity(shapes::sphere(0.02)) == Approx(1.0).epsilon(1e-14));
    CHECK(sphericity(shapes::tetrahedron_4(circumscribed(0.02))) ==
          Approx(std::pow(4.0, -1.0 / 3.0)).epsilon(1e-14)); // 0.630
    CHECK(sphericity(make_shape("two", {{{-1, 0, 0}, 1}, {{1, 0, 0}, 1}})) == Approx(0.7937005260).epsilon(1e-10));
    CHECK(sphericity(shapes::apollonian_14(circumscribed(0.02))) == Approx(0.447).epsilon(1e-3));
}

TEST_CASE("overlapping pebbles are refused with the pair, the overlap and the factor that cures it") {
    const auto overlapping = [] { return make_shape("bad", {{{0, 0, 0}, 1.0}, {{5, 0, 0}, 1.0}, {{5, 1.9, 0}, 1.0}}); };
    CHECK_THROWS_AS(overlapping(), input_error);
    try {
        overlapping();
    } catch (const input_error& error) {
        CHECK(contains(error.what(), "'bad'"));
        CHECK(contains(error.what(), "pebbles 1 and 2 overlap by 0.1 m"));
        CHECK(contains(error.what(), "multiply their radii by 0.95"));
    }
    // within the tolerance of 1e-9 d, and just outside it
    CHECK_NOTHROW(make_shape("touch", {{{-1, 0, 0}, 1.0}, {{1 - 2e-9, 0, 0}, 1.0}}));
    CHECK_THROWS_AS(make_shape("deep", {{{-1, 0, 0}, 1.0}, {{1 - 8e-9, 0, 0}, 1.0}}), input_error);
    CHECK_THROWS_AS(make_shape("empty", {}), input_error);
    CHECK_THROWS_AS(make_shape("flat", {{{0, 0, 0}, 0.0}}), input_error);
    CHECK_THROWS_AS(make_shape("nan", {{{std::nan(""), 0, 0}, 1.0}}), input_error);
}

TEST_CASE("pebbles are bonded up to a gap of a thousandth of the smallest radius") {
    CHECK(make_shape("close", {{{0, 0, 0}, 1.0}, {{1.5 + 4.9e-4, 0, 0}, 0.5}}).bonds.size() == 1);
    CHECK(make_shape("apart", {{{0, 0, 0}, 1.0}, {{1.5 + 5.1e-4, 0, 0}, 0.5}}).bonds.empty());
}

TEST_CASE("a part of a shape: its pebbles, in their places, with their bonds and its own mass properties") {
    const shape whole = shapes::apollonian_14(circumscribed(0.02));
    const shape part = part_of(whole, 2, 6);
    REQUIRE(part.pebbles.size() == 6);
    double volume = 0.0;
    for (std::size_t k = 0; k < 6; ++k) {
        volume += sphere_volume(part.pebbles[k].radius);
        CHECK(part.pebbles[k].radius == whole.pebbles[2 + k].radius);
        const vec3 place = part.mass_centre + rotate(part.to_input_frame, part.pebbles[k].offset);
        CHECK(norm(place - whole.pebbles[2 + k].offset) < 1e-17);
        CHECK(norm(part.pebbles[k].offset) + part.pebbles[k].radius <= part.circumscribed_radius);
    }
    CHECK(part.volume == volume);
    CHECK(part.diameter == 2.0 * part.circumscribed_radius);
    std::set<std::pair<int, int>> bonds;
    for (const shape_bond& b : whole.bonds)
        if (b.a >= 2 && b.b < 8) bonds.insert({b.a - 2, b.b - 2});
    REQUIRE((part.bonds.size() == bonds.size() && bonds.size() > 5));
    for (const shape_bond& b : part.bonds) CHECK(bonds.count({b.a, b.b}) == 1);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const double sum = second_moment(part, 0, 0) + second_moment(part, 1, 1) + second_moment(part, 2, 2);
            const double expected = i == j ? sum - second_moment(part, i, i) : -second_moment(part, i, j);
            CHECK(std::abs(expected - (i == j ? part.inertia_per_density[i] : 0.0)) < 1e-12 * sum);
        }
}

TEST_CASE("a part that bonds do not hold together has none, and a part of one pebble is a sphere") {
    const shape whole = shapes::apollonian_14(circumscribed(0.02));
    CHECK(part_of(whole, 0, 2).bonds.empty()); // opposite pebbles
    CHECK(part_of(whole, 6, 8).bonds.empty()); // the small ones, which do not touch each other
    CHECK(part_of(whole, 5, 3).bonds.empty()); // a big one that touches one of two small ones
    const shape one = part_of(whole, 13, 1);
    CHECK((one.bonds.empty() && norm(one.pebbles[0].offset) == 0.0));
    CHECK(one.circumscribed_radius == whole.pebbles[13].radius);
    CHECK((one.inertia_per_density.x == one.inertia_per_density.y && one.inertia_per_density.y > 0.0));
    CHECK(norm(one.mass_centre - whole.pebbles[13].offset) < 1e-18);
}

TEST_CASE("a grain of 2 cm is as large as a ball of 2 cm, or fits into one, by its reading") {
    const double ball = std::numbers::pi / 6.0 * 0.02 * 0.02 * 0.02;
    const shape four = shapes::tetrahedron_4(0.02), fourteen = shapes::apollonian_14(0.02);
    CHECK(four.pebbles[0].radius == Approx(0.01 / std::cbrt(4.0)).epsilon(1e-14));
    CHECK(2.0 * four.circumscribed_radius == Approx(0.0280).epsilon(2e-3));
    CHECK(2.0 * fourteen.circumscribed_radius == Approx(0.0248).epsilon(2e-3));
    for (const shape& s : {four, fourteen}) {
        CHECK(s.volume == Approx(ball).epsilon(1e-14));
        CHECK((s.diameter == 0.02 && s.reading == size_reading::equivalent));
        CHECK(part_of(s, 0, 2).diameter == Approx(std::cbrt(2.0) * 2.0 * s.pebbles[0].radius).epsilon(1e-14));
        // one reading into the other and back
        const shape around = scaled_to(s, circumscribed(0.02)), back = scaled_to(around, equivalent(0.02));
        CHECK((around.circumscribed_radius == 0.01 && around.diameter == 0.02));
        CHECK(around.volume < 0.6 * ball);
        CHECK(part_of(around, 0, 1).diameter == Approx(2.0 * around.pebbles[0].radius).epsilon(1e-15));
        CHECK(back.circumscribed_radius == Approx(s.circumscribed_radius).epsilon(1e-14));
        CHECK(scaled_by(s, 0.5).diameter == 0.01);
        CHECK(scaled_by(s, 0.5).volume == Approx(ball / 8.0).epsilon(1e-14));
    }
    const shape one = shapes::sphere(0.02), same = shapes::sphere(circumscribed(0.02));
    CHECK((one.diameter == 0.02 && same.diameter == 0.02)); // to the last digit
    CHECK(one.pebbles[0].radius == same.pebbles[0].radius);
}
