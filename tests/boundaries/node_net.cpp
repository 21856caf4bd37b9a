// SPDX-License-Identifier: MIT
// What touches a surface on nodes, against all of its triangles, one by one.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/node_net.hpp>
#include <clast/boundaries/node_rows.hpp>
#include <clast/core/random.hpp>
#include <clast/io/archive.hpp>

using namespace clast;
using namespace clast::boundaries;

namespace {

/// A surface whose nodes can be put somewhere.
struct movable : node_rows<> {
    explicit movable(const cylinder_settings& s) : node_rows<>(s.rings, checked(s)) {}
    void put(int j, double r) { apothem_[static_cast<std::size_t>(j)] = r; }
    void speed(int j, double v) {
        velocity_[static_cast<std::size_t>(j)] = v;
        lateral_speed_ = std::max(lateral_speed_, std::abs(v));
    }
    void moved() { advance(0.0); }
};

double between(random_stream& random, double low, double high) { return low + (high - low) * uniform01(random); }

/// Nodes up to `by` metres nearer to or further from the axis, each or row by row.
movable crumpled(int rings, int around, double by, std::uint64_t seed, bool rows = false) {
    cylinder_settings s;
    s.radius = 0.06, s.bottom = -0.14, s.top = 0.14;
    s.rings = rings, s.tiles_per_ring = around;
    s.smallest_radius = 0.001;
    s.largest_gap = 0.01;
    s.contact_stiffness_floor = 2e6;
    movable wall(s);
    random_stream random{seed, 0};
    const double regular = wall.node_radius(2);
    double out = 0.0;
    for (int j = 0; j < rings * around; ++j) {
        if (!rows || j % around == 0) out = by * between(random, -1.0, 1.0);
        wall.put(j, regular + out);
    }
    wall.moved();
    return wall;
}

constexpr std::array<std::array<std::array<double, 4>, 3>, 4> parts_of_quarters{
    {{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0.25, 0.25, 0.25, 0.25}}},
     {{{0, 1, 0, 0}, {0, 0, 1, 0}, {0.25, 0.25, 0.25, 0.25}}},
     {{{0, 0, 1, 0}, {0, 0, 0, 1}, {0.25, 0.25, 0.25, 0.25}}},
     {{{0, 0, 0, 1}, {1, 0, 0, 0}, {0.25, 0.25, 0.25, 0.25}}}}};

/// All triangles between nodes and, at the ends, of the vertical wall beyond the platens.
std::vector<plate> triangles_of(const node_rows<>& wall) {
    const int rings = wall.ring_count(), around = wall.tiles_per_ring();
    const auto facet = [&](int k, int i) { return 2 + k * around + (i + around) % around; };
    const auto at = [&](int k, int i) {
        const int row = std::clamp(k, 0, rings - 1);
        const double angle = 2.0 * std::numbers::pi * (i + 0.5) / around, r = wall.node_radius(facet(row, i));
        const double level = wall.bottom() + wall.height() * (row + 0.5) / rings;
        return vec3{r * std::cos(angle), r * std::sin(angle), level + (k < 0 ? -0.3 : k >= rings ? 0.3 : 0.0)};
    };
    std::vector<plate> all;
    for (int k = -1; k < rings; ++k)
        for (int i = 0; i < around; ++i) {
            const int low = std::max(k, 0), high = std::min(k + 1, rings - 1);
            const std::array<vec3, 4> c{at(k, i - 1), at(k, i), at(k + 1, i), at(k + 1, i - 1)};
            const vec3 middle = 0.25 * ((c[0] + c[1]) + (c[2] + c[3]));
            for (std::size_t t = 0; t < 4; ++t) {
                plate p{c[t],
                        c[(t + 1) % 4],
                        middle,
                        {},
                        {facet(low, i - 1), facet(low, i), facet(high, i), facet(high, i - 1)},
                        &parts_of_quarters[t]};
                p.orient();
                all.push_back(p);
            }
        }
    return all;
}

/// The shortest way out of all triangles at once.
touches pushed(const std::vector<plate>& all, const node_rows<>& wall, const vec3& x, double r) {
    plates_near near;
    for (const plate& p : all) near.add(p, separate(p, x));
    touches out;
    push_out(
        near, x, r, [&](int facet) { return -wall.inward(facet); }, out);
    return out;
}

/// A place that is about as far from the surface as `gap` (m), between platens.
vec3 place(random_stream& random, const std::vector<plate>& all, double gap) {
    const double angle = between(random, 0.0, 2.0 * std::numbers::pi), z = between(random, -0.139, 0.139);
    vec3 x;
    for (double rho = 0.02, further = 1.0; further > 1e-6 * gap;) { // no step is longer than the way to the surface
        x = {rho * std::cos(angle), rho * std::sin(angle), z};
        double distance = 1.0;
        for (const plate& p : all) distance = std::min(distance, separate(p, x).distance);
        further = distance - gap, rho += further;
    }
    return x;
}

std::vector<double> shares(const touches& t, int facets) {
    std::vector<double> of(static_cast<std::size_t>(facets), 0.0);
    for (const touch& one : t)
        if (!one.at_platen()) of[static_cast<std::size_t>(one.facet)] += one.depth * one.along;
    return of;
}

} // namespace

TEST_CASE("what is found near a sphere is what all triangles together do", "[boundaries]") {
    random_stream random{31, 0};
    int touched = 0, several = 0, missed = 0;
    for (const double by : {0.0, 0.0005, 0.003, 0.009}) {
        for (const int around : {7, 10, 16, -6}) {
            const bool rows = around < 0;
            const movable wall = crumpled(8, std::abs(around), by, 5 + static_cast<std::uint64_t>(around + 10), rows);
            const std::vector<plate> all = triangles_of(wall);
            for (int k = 0; k < 250; ++k) {
                const double r = between(random, 0.0015, 0.012);
                const vec3 x = place(random, all, r * between(random, 0.7, 1.02));
                const touches mine = wall.touch(x, r), theirs = pushed(all, wall, x, r);
                INFO("nodes out by " << by << ", " << around << " around, r " << r << ", x " << x.x << " " << x.y << " "
                                     << x.z);
                CHECK(norm(lateral_push(mine) - lateral_push(theirs)) <= 1e-10 * r);
                const std::vector<double> one = shares(mine, wall.facet_count()),
                                          other = shares(theirs, wall.facet_count());
                for (std::size_t f = 0; f < one.size(); ++f)
                    if (std::abs(one[f] - other[f]) > 1e-7 * r) ++missed; // shares of nearly parallel faces are soft
                touched += norm(lateral_push(theirs)) > 0.0;
                several += theirs.size > 6;
            }
        }
    }
    CHECK(missed == 0);
    CHECK(touched > 2000);
    CHECK(several > 20);
}

TEST_CASE("near says yes wherever a triangle is within reach and no well beyond", "[boundaries]") {
    random_stream random{8, 0};
    for (const double by : {0.001, 0.009, -0.009}) {
        const movable wall = crumpled(8, 10, by, 3, by < 0.0);
        const std::vector<plate> all = triangles_of(wall);
        for (int k = 0; k < 400; ++k) {
            const double r = between(random, 0.0015, 0.008);
            const vec3 x = place(random, all, r);
            if (std::abs(x.z) > 0.139 - 1.1 * r) continue; // by a platen
            double distance = 1.0;
            for (const plate& p : all) distance = std::min(distance, separate(p, x).distance);
            INFO("nodes out by " << by << ", x " << x.x << " " << x.y << " " << x.z << ", distance " << distance);
            CHECK(wall.near(x, distance * (1.0 + 1e-9)));
            CHECK_FALSE(wall.near(x, distance * (1.0 - 1e-9)));
        }
    }
}

TEST_CASE("a surface that was stored and read touches the same", "[boundaries]") {
    const movable wall = crumpled(6, 9, 0.004, 77);
    movable other = crumpled(6, 9, 0.004, 78);
    from_bytes(to_bytes(static_cast<const node_rows<>&>(wall)), static_cast<node_rows<>&>(other));
    const std::vector<plate> all = triangles_of(wall);
    random_stream random{4, 0};
    for (int k = 0; k < 100; ++k) {
        const vec3 x = place(random, all, 0.0045);
        const touches one = wall.touch(x, 0.005), two = other.touch(x, 0.005);
        REQUIRE(one.size == two.size);
        for (int i = 0; i < one.size; ++i) {
            const touch &a = one.at[static_cast<std::size_t>(i)], &b = two.at[static_cast<std::size_t>(i)];
            CHECK((a.facet == b.facet && a.normal == b.normal && a.depth == b.depth && a.part == b.part));
        }
    }
}
