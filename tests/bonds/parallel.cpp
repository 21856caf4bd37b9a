// SPDX-License-Identifier: MIT
#include <clast/bonds/parallel.hpp>

#include <cmath>
#include <numbers>

#include <clast/core/random.hpp>
#include <clast/grains/shape.hpp>
#include <clast/io/archive.hpp>

#include <catch.hpp>

using namespace clast;
using namespace clast::bonds;

namespace {

constexpr double pi = std::numbers::pi;

struct motion_of_two {
    vec3 va, wa, vb, wb;
};

/// A bond with its geometry, moved by prescribed velocities.
struct specimen {
    constants c;
    vec3 n;
    double ra, rb;
    state s{};

    void move(const motion_of_two& m, double dt) {
        stretch(c, s, n, relative_velocity(n, ra, rb, m.va, m.wa, m.vb, m.wb), m.wb - m.wa, dt);
    }
    wrench load() const { return loads(s, n, ra, rb); }
};

/// A bond whose stiffnesses are all different (with the 2 : 1 of Table 1 twist and bending are equally stiff).
specimen made(const vec3& n, double ra = 0.004, double rb = 0.003) {
    parallel m;
    m.shear_stiffness = 3.6e8;
    return {constants_of(m, ra, rb), n, ra, rb};
}

vec3 any(random_stream& random) { return {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)}; }

/// Strengths are crossed within this relative distance.
constexpr double just = 1e-12;
bool fails(const constants& c, const state& s) { return failing(c, s).tension || failing(c, s).shear; }

} // namespace

TEST_CASE("a bond is a disc of the smaller radius times its multiplier") {
    parallel m;
    m.radius_multiplier = 0.5;
    m.moment_contribution = 0.25;
    const constants c = constants_of(m, 0.004, 0.003);
    const double r = 0.0015, area = pi * r * r, inertia = 0.25 * pi * r * r * r * r;
    CHECK(1.0 / c.per_area == Approx(area).epsilon(1e-14));
    CHECK(c.per_bending == Approx(0.25 * r / inertia).epsilon(1e-14));
    CHECK(c.per_twist == Approx(0.25 * r / (2.0 * inertia)).epsilon(1e-14)); // J = 2 I
    // moments of the same springs per area: k_n I and k_s J
    CHECK(c.kb == Approx(c.kn / area * inertia).epsilon(1e-14));
    CHECK(c.kt == Approx(c.ks / area * 2.0 * inertia).epsilon(1e-14));
    CHECK(constants_of(m, 0.003, 0.004).kn == c.kn);
}

TEST_CASE("the three readings of the bond stiffness in Table 1") {
    const auto pebbles_4 = shapes::tetrahedron_4(circumscribed(0.02)).pebbles,
               pebbles_14 = shapes::apollonian_14(circumscribed(0.02)).pebbles;
    const double r4 = pebbles_4.front().radius, small = pebbles_14.back().radius, big = pebbles_14.front().radius;
    CHECK(r4 == Approx(4.495e-3).epsilon(1e-4));
    struct row {
        stiffness_reading reading;
        double k4, k_small;              // N/m; small: two pebbles of that radius
        double stretch_4, stretch_small; // m, at 30 MPa
    };
    for (const row& r : {row{stiffness_reading::per_area, 6.1e4, 1.6e4, 31e-3, 31e-3},
                         row{stiffness_reading::force, 9.6e8, 9.6e8, 2.0e-6, 0.52e-6},
                         row{stiffness_reading::modulus, 6.8e6, 3.5e6, 0.28e-3, 0.14e-3}}) {
        parallel m;
        m.reading = r.reading;
        const constants four = constants_of(m, r4, r4), two = constants_of(m, small, small);
        CHECK(four.kn == Approx(r.k4).epsilon(0.01));
        CHECK(two.kn == Approx(r.k_small).epsilon(0.02));
        CHECK(four.ks == Approx(0.5 * four.kn).epsilon(1e-14));
        CHECK(m.tensile_strength / four.per_area / four.kn == Approx(r.stretch_4).epsilon(0.02));
        CHECK(m.tensile_strength / two.per_area / two.kn == Approx(r.stretch_small).epsilon(0.03));
    }
    // exact: a reading only says what is multiplied by what
    parallel m;
    const double area = pi * small * small;
    CHECK(constants_of(m, big, small).kn == 9.6e8);
    m.reading = stiffness_reading::per_area;
    CHECK(constants_of(m, big, small).kn == Approx(9.6e8 * area).epsilon(1e-14));
    m.reading = stiffness_reading::modulus;
    CHECK(constants_of(m, big, small).kn == Approx(9.6e8 * area / (big + small)).epsilon(1e-14));
}

TEST_CASE(
    "tension and compression: k_n times the stretch along the bond, tension positive, pulling the balls together") {
    const vec3 n = unit(vec3{1, -2, 3});
    specimen b = made(n);
    b.move({{}, {}, 1e-3 * n, {}}, 1e-4); // opens by 1e-7 m
    CHECK(b.s.n == Approx(96.0).epsilon(1e-13));
    CHECK(norm(b.load().force_a - 96.0 * n) < 1e-11);
    CHECK(norm(b.load().moment_a) < 1e-14);
    CHECK(norm(b.load().moment_b) < 1e-14);
    b.move({4e-3 * n, {}, {}, {}}, 1e-4); // closes by 4e-7 m
    CHECK(b.s.n == Approx(-288.0).epsilon(1e-13));
    CHECK(energy(b.c, b.s) == Approx(0.5 * 288.0 * 288.0 / 9.6e8).epsilon(1e-13));
}

TEST_CASE("shear: k_s times the slide, with moments by the arms of both balls") {
    const vec3 n = unit(vec3{1, -2, 3}), t = unit(cross(n, vec3{0, 0, 1}));
    specimen b = made(n);
    b.move({{}, {}, 1e-3 * t, {}}, 1e-4);
    CHECK(norm(b.s.v - 36.0 * t) < 1e-11);
    CHECK(std::abs(b.s.n) < 1e-11);
    CHECK(norm(b.load().force_a - 36.0 * t) < 1e-11);
    CHECK(norm(b.load().moment_a - 0.004 * 36.0 * cross(n, t)) < 1e-13);
    CHECK(norm(b.load().moment_b - 0.003 * 36.0 * cross(n, t)) < 1e-13);
    CHECK(energy(b.c, b.s) == Approx(0.5 * 36.0 * 36.0 / 3.6e8).epsilon(1e-12));
    // equal spins of both balls shear a bond as well: the points at the bond move by r w apart
    specimen roll = made(n);
    roll.move({{}, 2.0 * t, {}, 2.0 * t}, 1e-4);
    CHECK(norm(roll.s.v + (3.6e8 * 2e-4 * 0.007) * cross(t, n)) < 1e-9);
    CHECK(norm(roll.s.mb) == 0.0);
}

TEST_CASE("twist and bending: k_s J and k_n I per area times the angle, opposite on the two balls") {
    const vec3 n = unit(vec3{1, -2, 3}), t = unit(cross(n, vec3{0, 0, 1}));
    const double r = 0.003, inertia_over_area = 0.25 * r * r;
    specimen twisted = made(n);
    twisted.move({{}, {}, {}, 2.0 * n}, 1e-4);
    const double mt = 3.6e8 * 2.0 * inertia_over_area * 2e-4;
    CHECK(twisted.s.mt == Approx(mt).epsilon(1e-13));
    CHECK(norm(twisted.load().moment_a - mt * n) < 1e-12);
    CHECK(norm(twisted.load().moment_b + mt * n) < 1e-12);
    CHECK(norm(twisted.load().force_a) < 1e-12);
    specimen bent = made(n);
    bent.move({{}, -0.5 * t, {}, 0.5 * t}, 1e-4); // opposite spins; equal arms would leave no shear
    const double mb = 9.6e8 * inertia_over_area * 1e-4;
    CHECK(norm(bent.s.mb - mb * t) < 1e-13);
    CHECK(std::abs(bent.s.mt) < 1e-16);
    CHECK(energy(twisted.c, twisted.s) == Approx(0.5 * mt * 2e-4).epsilon(1e-13));
}

TEST_CASE("two bonded balls that move as one rigid body are not strained") {
    random_stream random{6, 1};
    for (int i = 0; i < 100; ++i) {
        const vec3 n = direction(random), v = any(random), w = any(random);
        specimen b = made(n);
        b.move({v, w, v + cross(w, 0.007 * n), w}, 1.0);
        CHECK(std::abs(b.s.n) + norm(b.s.v) < 9.6e8 * 1e-15);
        CHECK(std::abs(b.s.mt) + norm(b.s.mb) == 0.0);
    }
}

TEST_CASE("forces and moments of a bond balance, and their work is the stored energy on any path") {
    random_stream random{6, 2};
    for (int trial = 0; trial < 20; ++trial) {
        const vec3 n = direction(random);
        specimen b = made(n);
        double work = 0.0, turnover = 0.0;
        for (int i = 0; i < 100; ++i) {
            const motion_of_two m{any(random), 100.0 * any(random), any(random), 100.0 * any(random)};
            const wrench before = b.load();
            b.move(m, 1e-6);
            const wrench after = b.load();
            const vec3 f = 0.5e-6 * (before.force_a + after.force_a);
            const double w = dot(f, m.vb - m.va) - 0.5e-6 * dot(before.moment_a + after.moment_a, m.wa) -
                             0.5e-6 * dot(before.moment_b + after.moment_b, m.wb);
            work += w;
            turnover += std::abs(w);
            // about the centre of a: the force on b acts at 7 mm
            REQUIRE(norm(after.moment_a + after.moment_b - cross((b.ra + b.rb) * n, after.force_a)) <
                    1e-14 * (norm(after.moment_a) + norm(after.moment_b)) + 1e-15);
        }
        CHECK(std::abs(work - energy(b.c, b.s)) < 1e-13 * turnover);
    }
}

TEST_CASE(
    "tensile strength: pure tension fails at sigma_t A, bending at sigma_t I / R, both at the sum of their stresses") {
    const constants c = constants_of(parallel{}, 0.004, 0.003);
    const double area = pi * 9e-6, section = area * 0.003 / 4.0; // I / R
    const double force = 30e6 * area, moment = 30e6 * section;
    const vec3 t{0.6, 0.8, 0};
    for (const double share : {0.0, 0.2, 0.7, 1.0}) {
        const auto at = [&](double x) { return state{x * share * force, {}, 0.0, (x * (1.0 - share) * moment) * t}; };
        CHECK_FALSE(fails(c, at(1.0 - just)));
        CHECK(failing(c, at(1.0 + just)).tension);
        CHECK_FALSE(failing(c, at(1.0 + just)).shear);
        CHECK(stresses_of(c, at(1.0)).sigma == Approx(30e6).epsilon(1e-13));
        CHECK(utilisation(c, at(0.37)) == Approx(0.37).epsilon(1e-13));
    }
    // compression makes room for bending, and alone breaks nothing
    CHECK_FALSE(fails(c, {-1e3 * force, {}, 0.0, {}}));
    CHECK_FALSE(fails(c, {-2.0 * force, {}, 0.0, (3.0 - just) * moment * t}));
    CHECK(failing(c, {-2.0 * force, {}, 0.0, (3.0 + just) * moment * t}).tension);
    CHECK(failing(c, {1.5 * force, {}, 0.0, {}}).tension);
}

TEST_CASE("shear strength: c A in shear, c J / R in twist of either sign, both at the sum of their stresses") {
    const constants c = constants_of(parallel{}, 0.003, 0.004);
    const double area = pi * 9e-6, section = area * 0.003 / 2.0; // J / R
    const double force = 60e6 * area, moment = 60e6 * section;
    const vec3 t{0.6, 0, 0.8};
    for (const double share : {0.0, 0.2, 0.7, 1.0})
        for (const double sign : {1.0, -1.0}) {
            const auto at = [&](double x) {
                return state{0.0, (x * share * force) * t, sign * x * (1.0 - share) * moment, {}};
            };
            CHECK_FALSE(fails(c, at(1.0 - just)));
            CHECK(failing(c, at(1.0 + just)).shear);
            CHECK_FALSE(failing(c, at(1.0 + just)).tension);
            CHECK(stresses_of(c, at(1.0)).tau == Approx(60e6).epsilon(1e-13));
            CHECK(utilisation(c, at(0.37)) == Approx(0.37).epsilon(1e-13));
        }
    CHECK(failing(c, {0.0, {}, 2.0 * moment, {}}).shear);
    const state both{1.1 * 30e6 * area, 1.1 * force * t, 0.0, {}};
    CHECK((failing(c, both).tension && failing(c, both).shear));
}

TEST_CASE("friction angle of a bond: compression strengthens it in shear, tension weakens it, bending does neither") {
    parallel m;
    m.friction_angle = std::atan(0.5);
    const constants c = constants_of(m, 0.003, 0.003);
    const double area = pi * 9e-6;
    for (const double mean : {-40e6, -1e6, 0.0, 10e6, 29e6}) {
        const double strength = 60e6 - 0.5 * mean;
        const auto at = [&](double x) { return state{mean * area, {0, x * strength * area, 0}, 0.0, {}}; };
        CHECK_FALSE(fails(c, at(1.0 - just)));
        CHECK(failing(c, at(1.0 + just)).shear);
        CHECK(stresses_of(c, at(1.0)).tau == Approx(strength).epsilon(1e-13));
    }
    const vec3 bending{0.9 * 30e6 * area * 0.003 / 4.0, 0, 0};
    CHECK_FALSE(fails(c, {0.0, {0, (1.0 - just) * 60e6 * area, 0}, 0.0, bending}));
    CHECK(failing(c, {0.0, {0, (1.0 + just) * 60e6 * area, 0}, 0.0, bending}).shear);
    // beyond the tensile strength the shear strength stays at its value there: 60 - 15 MPa
    CHECK_FALSE(failing(c, {50e6 * area, {0, (1.0 - just) * 45e6 * area, 0}, 0.0, {}}).shear);
    CHECK(failing(c, {50e6 * area, {0, (1.0 + just) * 45e6 * area, 0}, 0.0, {}}).shear);
}

TEST_CASE("moment contribution: beta scales what moments add to the stresses, beta 0 leaves forces alone") {
    parallel m;
    const double area = pi * 9e-6, bending = 30e6 * area * 0.003 / 4.0, twisting = 60e6 * area * 0.003 / 2.0;
    for (const double beta : {0.1, 0.5, 1.0}) {
        m.moment_contribution = beta;
        const constants c = constants_of(m, 0.003, 0.003);
        CHECK_FALSE(fails(c, {0.0, {}, 0.0, {(1.0 - just) * bending / beta, 0, 0}}));
        CHECK(failing(c, {0.0, {}, 0.0, {(1.0 + just) * bending / beta, 0, 0}}).tension);
        CHECK_FALSE(fails(c, {0.0, {}, (1.0 - just) * twisting / beta, {}}));
        CHECK(failing(c, {0.0, {}, -(1.0 + just) * twisting / beta, {}}).shear);
    }
    m.moment_contribution = 0.0;
    const constants c = constants_of(m, 0.003, 0.003);
    CHECK_FALSE(fails(c, {0.0, {}, 1e6 * twisting, {0, 1e6 * bending, 0}}));
    CHECK(c.kb == constants_of(parallel{}, 0.003, 0.003).kb); // stiffness is not strength
}

TEST_CASE("the flags of failure are those of the stresses, for any state") {
    random_stream random{6, 3};
    parallel m;
    m.friction_angle = 0.4;
    m.moment_contribution = 0.7;
    const constants c = constants_of(m, 0.003, 0.004);
    const double force = 30e6 / c.per_area;
    int broken = 0;
    for (int i = 0; i < 20000; ++i) {
        const vec3 n = direction(random);
        const state s{force * uniform(random, -1.5, 1.5), 2.0 * force * reject(any(random), n),
                      0.002 * force * uniform(random, -1, 1), 0.001 * force * reject(any(random), n)};
        const stresses t = stresses_of(c, s);
        const double mean = s.n * c.per_area, strength = c.cohesion - std::min(mean, 30e6) * c.tan_friction;
        REQUIRE(failing(c, s).tension == (t.sigma >= c.tensile_strength));
        REQUIRE(failing(c, s).shear == (t.tau >= strength));
        REQUIRE(fails(c, s) == (utilisation(c, s) >= 1.0));
        broken += fails(c, s);
    }
    CHECK((broken > 2000 && broken < 18000));
}

TEST_CASE("the load ratio grows with the load, and a bond fails where it is 1, with friction of the bond, too") {
    random_stream random{5, 1};
    for (const double angle : {0.0, 0.5}) {
        parallel material;
        material.friction_angle = angle;
        const constants c = constants_of(material, 0.004, 0.005);
        int tension = 0, shear = 0;
        for (int k = 0; k < 2000; ++k) {
            state s{uniform(random, -2000.0, 1000.0), 1500.0 * uniform(random, 0.0, 1.0) * direction(random),
                    uniform(random, -1.0, 1.0), uniform(random, 0.0, 1.0) * direction(random)};
            const double ratio = load_ratio(c, s);
            if (!(ratio > 0.0)) continue; // pressed without limit
            const auto times = [&s](double x) { return state{x * s.n, x * s.v, x * s.mt, x * s.mb}; };
            CHECK(load_ratio(c, times(3.0)) == Approx(3.0 * ratio).epsilon(1e-12));
            const failure_flags below = failing(c, times((1.0 - 1e-9) / ratio)),
                                at = failing(c, times((1.0 + 1e-9) / ratio));
            CHECK((!below.tension && !below.shear));
            CHECK((at.tension || at.shear));
            tension += at.tension, shear += at.shear;
            if (angle == 0.0) CHECK(ratio == Approx(utilisation(c, s)).epsilon(1e-12));
        }
        CHECK((tension > 100 && shear > 100));
    }
}

TEST_CASE("a factor scales both strengths of a bond, and nothing else") {
    random_stream random{6, 5};
    parallel m, strong;
    m.friction_angle = strong.friction_angle = 0.3;
    strong.tensile_strength *= 1.7;
    strong.cohesion *= 1.7;
    const constants c = constants_of(m, 0.003, 0.004), reference = constants_of(strong, 0.003, 0.004);
    const double force = 30e6 / c.per_area;
    for (int i = 0; i < 5000; ++i) {
        const vec3 n = direction(random);
        const state s{force * uniform(random, -2.5, 2.5), 3.0 * force * reject(any(random), n),
                      0.003 * force * uniform(random, -1, 1), 0.002 * force * reject(any(random), n)};
        REQUIRE(failing(c, s, 1.7).tension == failing(reference, s).tension);
        REQUIRE(failing(c, s, 1.7).shear == failing(reference, s).shear);
    }
}

TEST_CASE("shear force and bending moment follow a bond that turns, keep their size, and their work stays zero") {
    random_stream random{6, 4};
    for (int trial = 0; trial < 10; ++trial) {
        const vec3 n0 = direction(random), axis = 2.0 * direction(random);
        const state born{5.0, 100.0 * unit(cross(n0, direction(random))), 7.0,
                         3.0 * unit(cross(n0, direction(random)))};
        const constants c = constants_of(parallel{}, 0.003, 0.003);
        double error[2];
        for (int fine = 0; fine < 2; ++fine) {
            const int steps = fine == 0 ? 200 : 400;
            state s = born;
            for (int k = 1; k <= steps; ++k) {
                const vec3 n = rotate(rotation((static_cast<double>(k) / steps) * axis), n0);
                turn(s, n, axis, 1.0 / steps);
                REQUIRE(std::abs(dot(s.v, n)) < 1e-10);
                REQUIRE(std::abs(dot(s.mb, n)) < 1e-12);
            }
            CHECK((s.n == 5.0 && s.mt == 7.0));
            CHECK(norm(s.v) == Approx(100.0).epsilon(1e-13));
            CHECK(norm(s.mb) == Approx(3.0).epsilon(1e-13));
            CHECK(energy(c, s) == Approx(energy(c, born)).epsilon(1e-12));
            const quaternion q = rotation(axis);
            error[fine] = std::max(norm(s.v - rotate(q, born.v)) / 100.0, norm(s.mb - rotate(q, born.mb)) / 3.0);
        }
        CHECK(error[0] < 1e-2);
        CHECK(error[1] < 0.55 * error[0]);
    }
    state nothing;
    turn(nothing, vec3{0, 0, 1}, vec3{1, 2, 3}, 0.1);
    CHECK((nothing.v == vec3{} && nothing.mb == vec3{}));
}

TEST_CASE("a bond state comes back from an archive") {
    const state s{1.5, {2, 3, 4}, 5.5, {6, 7, 8}};
    state copy;
    from_bytes(to_bytes(s), copy);
    CHECK((copy.n == s.n && copy.v == s.v && copy.mt == s.mt && copy.mb == s.mb));
}
