// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/stepped_tiles.hpp>
#include <clast/io/archive.hpp>

using namespace clast;
using namespace clast::boundaries;

namespace {

constexpr double r = 4e-3;
constexpr double contact = 2e6;

cylinder_settings specimen(int rings = 36) {
    cylinder_settings s;
    s.radius = 0.15;
    s.bottom = -0.35;
    s.top = 0.35;
    s.rings = rings;
    s.smallest_radius = 2.3e-3;
    s.largest_step = 5e-3; // around a ring another limit than up a column
    s.contact_stiffness_floor = 2.06e6;
    return s;
}

double uniform(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

// Loads under which the servo would give random velocities of up to `speed`.
std::vector<facet_load> random_loads(const stepped_tiles& wall, std::mt19937& random, double speed, double dt) {
    std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    for (int f = first_lateral_facet; f < wall.facet_count(); ++f) {
        const double wanted = uniform(random, -speed, speed) * contact * 4.0 * dt / 0.5;
        loads[static_cast<std::size_t>(f)] = {std::max(0.0, 1e6 * wall.area(f) - wanted), 4.0 * contact, 4};
    }
    return loads;
}

drives servo(double sigma, double speed, double platen_speed = 0.0) {
    drives d;
    d.platens = {drive::mode::velocity, platen_speed, 0.0, 0.5};
    d.lateral = {drive::mode::servo, sigma, speed, 0.5};
    return d;
}

// A membrane that random loads have bent out of shape, still moving; its gap control has been at work.
stepped_tiles bent(unsigned seed, int rings = 36, int steps = 60, double platen_speed = 0.0) {
    std::mt19937 random(seed);
    stepped_tiles wall(specimen(rings));
    const auto loads = random_loads(wall, random, 0.05, 1e-3); // the same forcing again and again
    for (int n = 0; n < steps; ++n) {
        wall.control(loads, servo(1e6, 0.05, platen_speed), 1e-3);
        wall.advance(1e-3);
    }
    wall.control(loads, servo(1e6, 0.05, platen_speed), 1e-3);
    return wall;
}

vec3 near_wall(std::mt19937& random, double inside, double outside) {
    const double azimuth = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const double rho = 0.15 + uniform(random, -inside, outside);
    return {rho * std::cos(azimuth), rho * std::sin(azimuth), uniform(random, -0.355, 0.355)};
}

double sum_of_area_times_velocity(const stepped_tiles& wall) {
    double sum = 0.0;
    for (int f = 0; f < wall.facet_count(); ++f) sum += wall.area(f) * wall.velocity(f);
    return sum;
}

} // namespace

TEST_CASE("a fresh membrane is the prism around the cylinder", "[boundaries]") {
    const stepped_tiles wall(specimen());
    CHECK(wall.facet_count() == 2 + 36 * 20);
    const double polygon = 20 * 0.15 * 0.15 * std::tan(std::numbers::pi / 20);
    CHECK(wall.section() == Approx(polygon).epsilon(1e-12));
    CHECK(wall.volume() == Approx(polygon * 0.7).epsilon(1e-12));
    CHECK(wall.area(top_platen) == Approx(polygon).epsilon(1e-12));
    CHECK(wall.area(2) == Approx(2 * 0.15 * std::tan(std::numbers::pi / 20) * 0.7 / 36).epsilon(1e-12));
    CHECK(wall.fastest() == 0.0);
}

TEST_CASE("on a fresh membrane seams are not felt: a sphere meets one plane, or two in a valley", "[boundaries]") {
    const stepped_tiles wall(specimen());
    std::mt19937 random(1);
    double error = 0.0;
    int valleys = 0;
    for (int n = 0; n < 20000; ++n) {
        const vec3 c = near_wall(random, 2 * r, 0.0);
        const touches t = wall.touch(c, r);
        // the two planes nearest to the sphere, by hand
        const double a = std::numbers::pi / 10;
        const int i = static_cast<int>(std::floor(std::atan2(c.y, c.x) / a));
        const vec3 n1{-std::cos(a * i), -std::sin(a * i), 0};
        const vec3 n2{-std::cos(a * (i + 1)), -std::sin(a * (i + 1)), 0};
        const double d1 = r - 0.15 - dot(n1, c);
        const double d2 = r - 0.15 - dot(n2, c);
        const double g = std::cos(a);
        const double l1 = (d1 - g * d2) / (1 - g * g);
        const double l2 = (d2 - g * d1) / (1 - g * g);
        vec3 u;
        if (l1 > 0 && l2 > 0)
            u = l1 * n1 + l2 * n2, ++valleys;
        else if (std::max(d1, d2) > 0)
            u = d1 > d2 ? d1 * n1 : d2 * n2;
        error = std::max(error, norm(lateral_push(t) - u));
    }
    CHECK(valleys > 30);
    CHECK(error < 1e-11 * r);
}

TEST_CASE("a sphere in the corner of platen and membrane touches both", "[boundaries]") {
    const stepped_tiles wall(specimen());
    const touches t = wall.touch({0.15 - 0.9 * r, 0, 0.35 - 0.8 * r}, r);
    REQUIRE(t.size == 2);
    CHECK(t.at[0].facet == top_platen);
    CHECK(t.at[0].depth == Approx(0.2 * r).epsilon(1e-9));
    CHECK(t.at[1].facet == 2 + 35 * 20);
    CHECK(t.at[1].depth == Approx(0.1 * r).epsilon(1e-9));
}

TEST_CASE("near() never misses a contact, and a contact seen ahead is the contact after the motion", "[boundaries]") {
    const stepped_tiles wall = bent(2, 36, 60, 0.3); // platens and ledges move, too
    stepped_tiles later = wall;
    later.advance(2e-4);
    std::mt19937 random(3);
    int found = 0;
    int missed = 0;
    int far = 0;
    double error = 0.0;
    for (int n = 0; n < 20000; ++n) {
        const vec3 c = near_wall(random, 4 * r, -0.2 * r);
        const touches now = wall.touch(c, r);
        found += now.size > 0;
        missed += now.size > 0 && !wall.near(c, r);
        far += !wall.near(c, r);
        error = std::max(error, norm(lateral_push(wall.touch(c, r, 2e-4)) - lateral_push(later.touch(c, r))));
    }
    CHECK(found > 1000);
    CHECK(missed == 0);
    CHECK(far > 1000); // and it is worth asking
    CHECK(error < 1e-12);
    CHECK_FALSE(wall.near({0, 0, 0}, r));
}

TEST_CASE("moving facets do exactly the work that their force times their velocity says", "[boundaries]") {
    const stepped_tiles wall = bent(4, 36, 60, 0.3); // platens move, and ledges with them
    std::mt19937 random(5);
    double worst = 0.0, at_ledges = 0.0;
    int edges = 0;
    for (int n = 0; n < 5000; ++n) {
        const vec3 c = near_wall(random, 1.5 * r, -0.6 * r);
        const touches t = wall.touch(c, r);
        if (t.size == 0) continue;
        std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
        for (const touch& one : t) {
            loads[static_cast<std::size_t>(one.facet)].add(one, contact * one.depth, contact);
            edges += one.along < 0.999;
        }
        const double dt = 1e-7; // 5 nm at most
        const double rate = (elastic_energy(wall.touch(c, r, dt), contact, contact) -
                             elastic_energy(wall.touch(c, r, -dt), contact, contact)) /
                            (2 * dt);
        worst = std::max(worst, std::abs(rate - wall.power(loads)));
        auto flat = loads;
        for (facet_load& l : flat) l.edge = {};
        at_ledges = std::max(at_ledges, std::abs(wall.power(loads) - wall.power(flat)));
    }
    CHECK(edges > 300);
    CHECK(at_ledges > 10.0); // W
    CHECK(worst < 1e-2);     // W, of forces up to 5 kN at up to 0.05 m/s: 250 W
}

TEST_CASE("the force on a sphere that slides along a bent membrane never jumps", "[boundaries]") {
    const stepped_tiles wall = bent(6);
    std::mt19937 random(7);
    double largest = 0.0;
    for (int path = 0; path < 60; ++path) {
        vec3 c = near_wall(random, 1.2 * r, -0.8 * r);
        c.z *= 0.95;
        const double azimuth = std::atan2(c.y, c.x) + 0.5 * std::numbers::pi;
        const double lift = uniform(random, -1.0, 1.0);
        const vec3 step = 2e-6 * unit(vec3{std::cos(azimuth), std::sin(azimuth), lift});
        vec3 before = lateral_push(wall.touch(c, r));
        for (int n = 0; n < 1500; ++n) {
            c += step;
            const vec3 now = lateral_push(wall.touch(c, r));
            if (norm(before) < 0.5 * r) largest = std::max(largest, norm(now - before));
            before = now;
        }
    }
    CHECK(largest < 2.0 * 2e-6);
}

TEST_CASE("the search for touched tiles finds what a look at all of them finds, also for large and deep spheres",
          "[boundaries]") {
    cylinder_settings s = specimen(12);
    s.tiles_per_ring = 60;
    stepped_tiles wall(s);
    std::mt19937 random(21);
    const auto loads = random_loads(wall, random, 0.05, 1e-3);
    for (int n = 0; n < 80; ++n) {
        wall.control(loads, servo(1e6, 0.05), 1e-3);
        wall.advance(1e-3);
    }
    std::vector<half_slab> all;
    for (int f = first_lateral_facet; f < wall.facet_count(); ++f) {
        const int ring = (f - first_lateral_facet) / 60;
        const vec3 n = wall.inward(f);
        all.push_back({-n.x, -n.y, wall.apothem(f), ring == 0 ? -9.0 : -0.35 + ring * 0.7 / 12,
                       ring == 11 ? 9.0 : -0.35 + (ring + 1) * 0.7 / 12, f});
    }
    double error = 0.0;
    int compared = 0;
    for (int n = 0; n < 3000; ++n) {
        const double size = n % 2 ? 3e-3 : 12e-3;
        const vec3 c = near_wall(random, 1.2 * size, -0.55 * size);
        double deepest = 0.0;
        for (const half_slab& one : all) deepest = std::max(deepest, size - separate(one, c).distance);
        std::vector<half_slab> near;
        for (const half_slab& one : all)
            if (separate(one, c).distance < size + 2.0 * deepest) near.push_back(one);
        if (deepest > 0.4 * size || near.size() > static_cast<std::size_t>(max_slabs)) continue;
        touches t;
        push_out(near, c, size, t);
        error = std::max(error, norm(lateral_push(wall.touch(c, size)) - lateral_push(t)));
        compared += t.size > 0;
    }
    CHECK(compared > 500);
    CHECK(error < 1e-12);
}

TEST_CASE("a sphere pushed off a ledge also meets the tile above that it did not touch before", "[boundaries]") {
    cylinder_settings s = specimen(3);
    const double step = 1.8 * r; // a pocket lower than the sphere
    s.bottom = -1.5 * step;
    s.top = 1.5 * step;
    s.smallest_radius = 1.2 * r;
    stepped_tiles wall(s);
    std::vector<facet_load> loads(62);
    for (int f = 2; f < 62; ++f) { // velocities that put the three rings at 144, 150 and 146.5 mm in one second
        const double move = f < 22 ? 6e-3 : f < 42 ? 0.0 : 3.5e-3;
        const double sigma = 1e8;
        loads[static_cast<std::size_t>(f)] = {sigma * wall.area(f) - move * 1e7 / 0.5, 1e7, 1};
    }
    wall.control(loads, servo(1e8, 1.0), 1.0);
    wall.advance(1.0);
    REQUIRE(wall.apothem(2) == Approx(0.144));
    REQUIRE(wall.apothem(42) == Approx(0.1465));
    const vec3 c{0.1445, 0.0, -0.5 * step + 0.6 * r};
    const vec3 u = lateral_push(wall.touch(c, r));
    CHECK(u.z > 0.1 * r);
    CHECK(u.x < -0.01 * r); // straight up there is no way out
    const vec3 free = c + u;
    CHECK(std::hypot(0.1465 - free.x, 0.5 * step - free.z) >= r * (1.0 - 1e-9));
}

TEST_CASE("volume falls at the rate of facet area times velocity, while rings become lower", "[boundaries]") {
    stepped_tiles wall = bent(8, 12, 80);
    std::mt19937 random(9);
    double worst = 0.0;
    for (int n = 0; n < 400; ++n) {
        const auto loads = random_loads(wall, random, 0.02, 1e-5);
        wall.control(loads, servo(1e6, 0.02, 0.4), 1e-4); // the platens close by 0.08 mm per step, 32 mm in all
        const double v0 = wall.volume();
        const double rate0 = sum_of_area_times_velocity(wall);
        stepped_tiles half = wall;
        half.advance(0.5e-4);
        const double rate = sum_of_area_times_velocity(half);
        wall.advance(1e-4);
        worst = std::max(worst, std::abs((wall.volume() - v0) / 1e-4 + rate) / std::abs(rate0));
    }
    CHECK(worst < 1e-6);
    CHECK(wall.height() == Approx(0.7 - 2 * 0.4 * 1e-4 * 400).epsilon(1e-12));
}

TEST_CASE("the volume of a bent membrane agrees with a count of grid points", "[boundaries]") {
    const stepped_tiles wall = bent(10, 12, 80);
    // inside = a point-like sphere touches nothing; the grid is shifted so that it meets no edge
    const int n = 100;
    const double cell = 0.36 / n;
    std::int64_t inside = 0;
    const int layers = 36; // three per ring
    for (int k = 0; k < layers; ++k)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const vec3 x{-0.18 + (i + 0.37) * cell, -0.18 + (j + 0.61) * cell, -0.35 + (k + 0.5) * 0.7 / layers};
                inside += wall.touch(x, 1e-9).size == 0;
            }
    const double counted = static_cast<double>(inside) * cell * cell * 0.7 / layers;
    CHECK(wall.volume() == Approx(counted).epsilon(1e-3));
    CHECK(wall.volume() != Approx(stepped_tiles(specimen(12)).volume()).epsilon(1e-3));
}

TEST_CASE("under the target stress nothing moves, and the errors are zero", "[boundaries]") {
    stepped_tiles wall = bent(12);
    std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    for (int f = 0; f < wall.facet_count(); ++f)
        loads[static_cast<std::size_t>(f)] = {2e6 * (f < 2 ? wall.end_section(f) : wall.area(f)), contact, 1};
    drives d = servo(2e6, 0.02);
    d.platens = {drive::mode::servo, 2e6, 0.02, 0.5};
    wall.control(loads, d, 1e-5);
    CHECK(wall.fastest() < 1e-9);
    CHECK(wall.lateral_stress(loads) == Approx(2e6).epsilon(1e-12));
    CHECK(wall.axial_stress(loads) == Approx(2e6).epsilon(1e-12));
    CHECK(wall.confining_error(loads, 2e6) < 1e-12);
    CHECK(wall.confining_rms(loads, 2e6) < 1e-12);
    CHECK(wall.confining_error(loads, 1e6) == Approx(1.0).epsilon(1e-12));
    // one tile ten per cent too high: little in the mean, and the rms of one in 720
    loads[100].force *= 1.1;
    CHECK(wall.confining_error(loads, 2e6) < 2.5e-4);
    CHECK(wall.confining_rms(loads, 2e6) == Approx(0.1 / std::sqrt(720)).epsilon(1e-9));
    wall.control(loads, d, 1e-5);
    CHECK(wall.velocity(100) < 0.0);
    CHECK(std::abs(wall.velocity(101)) < 1e-9);
}

TEST_CASE("a tile without contact moves in at the speed limit until a neighbour holds it", "[boundaries]") {
    stepped_tiles wall(specimen());
    std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    for (int f = 2; f < wall.facet_count(); ++f) loads[static_cast<std::size_t>(f)] = {1e6 * wall.area(f), contact, 1};
    const int lonely = 2 + 20 * 10 + 7;
    loads[lonely] = {};
    for (int n = 0; n < 1000; ++n) {
        for (int f = 2; f < wall.facet_count(); ++f)
            if (f != lonely) loads[static_cast<std::size_t>(f)].force = 1e6 * wall.area(f);
        wall.control(loads, servo(1e6, 0.02), 1e-3);
        if (n == 0) CHECK(wall.velocity(lonely) == 0.02);
        wall.advance(1e-3);
    }
    CHECK(wall.apothem(lonely) == Approx(0.15 - 4.6e-3).margin(2e-5 + 1e-9)); // a pebble cannot slip through
    CHECK(wall.counters().gaps.relaxed > 0);
    CHECK(wall.counters().latched_pairs == 2);
    CHECK(wall.counters().searching == 1000);
    CHECK(wall.counters().tile_steps == 720 * 1000);
}

TEST_CASE("random forces never open the membrane wider than its limits, up a column or around a ring", "[boundaries]") {
    cylinder_settings s = specimen(12);
    s.tiles_per_ring = 10;
    s.largest_radius = 2.0 * s.radius;
    stepped_tiles wall(s);
    std::mt19937 random(13);
    std::vector<facet_load> loads;
    double up = 0.0;
    double around = 0.0;
    for (int n = 0; n < 600; ++n) {
        if (n % 150 == 0) loads = random_loads(wall, random, 0.05, 1e-3);
        wall.control(loads, servo(1e6, 0.05), 1e-3);
        wall.advance(1e-3);
        for (int k = 0; k < 12; ++k)
            for (int i = 0; i < 10; ++i) {
                const double one = wall.apothem(2 + 10 * k + i);
                if (k > 0) up = std::max(up, std::abs(one - wall.apothem(2 + 10 * (k - 1) + i)));
                around = std::max(around, std::abs(one - wall.apothem(2 + 10 * k + (i + 1) % 10)));
            }
    }
    CHECK(up > 4.6e-3); // the limits were reached
    CHECK(around > 5e-3);
    CHECK(up <= 4.6e-3 + 2 * 0.05 * 1e-3 + 1e-12);
    CHECK(around <= 5e-3 + 2 * 0.05 * 1e-3 + 1e-12);
}

TEST_CASE("a tile behind its neighbours has no servo, it goes where they go", "[boundaries]") {
    cylinder_settings s = specimen(1);
    s.tiles_per_ring = 60; // hidden from 0.8 mm behind its neighbours
    stepped_tiles wall(s);
    std::vector<facet_load> loads(62);
    const auto settle = [&](int n, double left, double right) {
        for (int step = 0; step < n; ++step) {
            for (int f = 2; f < 62; ++f) loads[static_cast<std::size_t>(f)] = {1e6 * wall.area(f), contact, 1};
            loads[2 + 29].force *= left;
            loads[2 + 30].force *= 2.0;
            loads[2 + 31].force *= right;
            wall.control(loads, servo(1e6, 0.02), 1e-3);
            wall.advance(1e-3);
        }
    };
    settle(60, 1.0, 1.0);
    REQUIRE(wall.area(2 + 30) < 0.05 * wall.area(2));
    REQUIRE(wall.counters().hidden > 0);
    settle(1, 0.5, 1.0);
    CHECK(wall.velocity(2 + 29) == Approx(0.02));
    CHECK(wall.velocity(2 + 30) == Approx(0.5 * (wall.velocity(2 + 29) + wall.velocity(2 + 31))));
}

TEST_CASE("a lost pebble, a torn membrane and platens that meet are not overlooked", "[boundaries]") {
    stepped_tiles wall(specimen());
    const double past = 0.15 + r;
    CHECK_FALSE(wall.outside({0, 0, 0}, r));
    CHECK_FALSE(wall.outside({past - 1e-6, 0, 0}, r));
    CHECK(wall.outside({past + 1e-6, 0, 0}, r));
    const double corner = std::numbers::pi / 20; // the polygon reaches further there
    CHECK_FALSE(wall.outside({(past + 1e-6) * std::cos(corner), (past + 1e-6) * std::sin(corner), 0}, r));
    CHECK(wall.outside({0, 0, 0.35 + 1.01 * r}, r));
    CHECK(wall.outside({0, 0, std::nan("")}, r));
    CHECK(wall.outside({std::nan(""), 0, 0}, r));

    const std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()));
    drives d;
    d.lateral = {drive::mode::velocity, -0.1, 0.0, 0.5};
    stepped_tiles burst = wall;
    burst.control(loads, d, 1e-3);
    CHECK_THROWS_AS(burst.advance(1.0), run_error);
    d.lateral.how = drive::mode::hold;
    d.platens = {drive::mode::velocity, 0.1, 0.0, 0.5};
    stepped_tiles crushed = wall;
    crushed.control(loads, d, 1e-3);
    CHECK_THROWS_AS(crushed.advance(3.5), run_error);
    auto bad = loads;
    bad[50] = {std::nan(""), contact, 1};
    wall.control(bad, servo(1e6, 0.02), 1e-3);
    CHECK_THROWS_AS(wall.advance(1e-3), run_error);
}

TEST_CASE("the drawing shows the same areas, and closed facets", "[boundaries]") {
    const stepped_tiles wall = bent(14, 12, 80);
    const std::vector<facet_load> loads(static_cast<std::size_t>(wall.facet_count()), facet_load{100.0, contact, 1});
    const auto facets = wall.view(loads);
    double area = 0.0;
    for (const facet_view& f : facets) {
        if (f.ring < 0) continue;
        const double width = norm(f.corner[1] - f.corner[0]);
        const double height = norm(f.corner[2] - f.corner[1]);
        CHECK(width * height == Approx(f.area).epsilon(1e-9));
        CHECK(f.pressure * f.area == Approx(100.0).epsilon(1e-12));
        area += f.area;
    }
    double expected = 0.0;
    for (int f = 2; f < wall.facet_count(); ++f) expected += wall.area(f);
    CHECK(area == Approx(expected).epsilon(1e-12));
}

TEST_CASE("a membrane that comes back from a checkpoint goes on bit by bit", "[boundaries]") {
    stepped_tiles wall = bent(15, 12, 150, 0.1);
    REQUIRE(wall.counters().latched_pairs > 10); // gap control is at work
    write_archive out;
    wall.archive(out);
    stepped_tiles copy(specimen(6));
    read_archive in(out.buffer);
    copy.archive(in);
    std::mt19937 random(16);
    for (int n = 0; n < 30; ++n) {
        const auto loads = random_loads(wall, random, 0.05, 1e-3);
        for (stepped_tiles* one : {&wall, &copy}) {
            one->control(loads, servo(1e6, 0.05, 0.2), 1e-3);
            one->advance(1e-3);
        }
    }
    write_archive a;
    write_archive b;
    wall.archive(a);
    copy.archive(b);
    CHECK(a.buffer == b.buffer);
}
