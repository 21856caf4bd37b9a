// SPDX-License-Identifier: MIT
#include <clast/bonds/lattice.hpp>

#include <algorithm>
#include <cmath>

#include <clast/core/random.hpp>

#include <Eigen/Dense>
#include <catch.hpp>

using namespace clast;
using namespace clast::bonds;

namespace {

constexpr double density = 2650.0;

Eigen::MatrixXd eigen(const square_matrix& m) {
    const auto n = static_cast<Eigen::Index>(m.size());
    return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(m.data(), n, n);
}
double largest(const Eigen::MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }
std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// n + 1 equal balls of radius r in a row.
shape chain(int bonds_in_row, double r) {
    std::vector<shape_pebble> balls;
    for (int i = 0; i <= bonds_in_row; ++i) balls.push_back({{2.0 * r * i, 0, 0}, r});
    return make_shape("chain", balls);
}
/// Pebbles of unlike size in no symmetric place.
shape lump() {
    return make_shape("lump", {{{0, 0, 0}, 0.004},
                               {{0.007, 0, 0}, 0.003},
                               {{0.0035, std::sqrt(0.007 * 0.007 - 0.0035 * 0.0035), 0}, 0.003},
                               {0.0054 * unit(vec3{-5, -2, 1}), 0.0014}});
}
/// The same pebbles, each smaller by a share: bonds with gaps of twice that share of a radius.
shape shrunk(shape s, double share) {
    for (shape_pebble& p : s.pebbles) p.radius *= 1.0 - share;
    return make_shape(s.name, s.pebbles);
}
std::vector<shape> shapes_of_test() {
    return {chain(1, 0.004), chain(6, 0.004), shapes::tetrahedron_4(circumscribed(0.02)),
            shapes::apollonian_14(circumscribed(0.02)), lump()};
}

std::vector<pebble_load> any_load(random_stream& random, std::size_t n) {
    std::vector<pebble_load> load(n);
    for (pebble_load& p : load) p = {1000.0 * direction(random), 3.0 * direction(random)};
    return load;
}

/// What is left per pebble of load + bonds - mass x acceleration of the rigid motion (N, and N m), at worst.
struct residual {
    double force = 0.0;
    double moment = 0.0;
};
residual out_of_balance(const lattice& l, const std::vector<pebble_load>& load, const std::vector<state>& born,
                        const quaternion& q, const vec3& spin) {
    const std::size_t n = l.size();
    // Newton and Euler for the whole, by a path that the lattice does not take: angular momentum of point masses and
    // balls, and its rate with the spin
    vec3 force, moment;
    double mass = 0.0;
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    std::vector<vec3> x(n);
    vec3 rate; // of angular momentum at zero angular acceleration
    for (std::size_t i = 0; i < n; ++i) {
        x[i] = matrix(q) * l.offset[i];
        force += load[i].force;
        moment += cross(x[i], load[i].force) + load[i].moment;
        mass += l.mass[i];
        rate += l.mass[i] * cross(x[i], cross(spin, cross(spin, x[i])));
        for (int k = 0; k < 3; ++k) {
            vec3 e;
            e[k] = 1.0;
            const vec3 column = l.mass[i] * cross(x[i], cross(e, x[i])) + l.inertia[i] * e;
            for (int r = 0; r < 3; ++r) tensor(r, k) += column[r];
        }
    }
    const vec3 net = moment - rate;
    const Eigen::Vector3d alpha = tensor.fullPivLu().solve(Eigen::Vector3d(net.x, net.y, net.z));
    const vec3 turning{alpha(0), alpha(1), alpha(2)};
    std::vector<pebble_load> rest = load;
    for (std::size_t i = 0; i < n; ++i) {
        rest[i].force -= l.mass[i] * ((1.0 / mass) * force + cross(turning, x[i]) + cross(spin, cross(spin, x[i])));
        rest[i].moment -= l.inertia[i] * turning;
    }
    for (std::size_t e = 0; e < l.ends.size(); ++e) {
        const std::size_t a = at(l.ends[e].a), b = at(l.ends[e].b);
        const vec3 f = born[e].n * rotate(q, l.normal[e]) + born[e].v,
                   m = born[e].mt * rotate(q, l.normal[e]) + born[e].mb;
        // at the middle of the gap between the balls
        const vec3 point =
            x[a] + (l.radius[a] + 0.5 * (norm(x[b] - x[a]) - l.radius[a] - l.radius[b])) * unit(x[b] - x[a]);
        rest[a].force += f;
        rest[a].moment += m + cross(point - x[a], f);
        rest[b].force -= f;
        rest[b].moment -= m + cross(point - x[b], f);
    }
    residual worst;
    for (const pebble_load& p : rest) {
        worst.force = std::max(worst.force, norm(p.force));
        worst.moment = std::max(worst.moment, norm(p.moment));
    }
    return worst;
}

Eigen::VectorXd unit_load(Eigen::Index size, Eigen::Index which) {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(size);
    f(which) = 1.0;
    return f;
}

/// Displacements of a chain of N bonds whose first ball is held, under a unit load on the last one (component 0 to 5).
Eigen::VectorXd held_chain(const lattice& l, int component) {
    const auto free = static_cast<Eigen::Index>(6 * (l.size() - 1));
    const Eigen::MatrixXd k = eigen(l.stiffness()).bottomRightCorner(free, free);
    return k.ldlt().solve(unit_load(free, free - 6 + component)).tail(6);
}

} // namespace

TEST_CASE("bond stiffness: symmetric, and a rigid motion costs nothing in exactly six ways") {
    std::vector<shape> all = shapes_of_test();
    all.push_back(shrunk(shapes::tetrahedron_4(circumscribed(0.02)), 4e-4));
    all.push_back(shrunk(shapes::apollonian_14(circumscribed(0.02)), 1e-5));
    for (const shape& s : all) {
        const lattice l(s, parallel{}, density);
        const Eigen::MatrixXd k = eigen(l.stiffness());
        REQUIRE(k.rows() == static_cast<Eigen::Index>(6 * s.pebbles.size()));
        const double size = largest(k);
        CHECK(largest(k - k.transpose()) < 1e-15 * size);
        random_stream random{8, 1};
        for (int i = 0; i < 20; ++i) {
            const vec3 v = 0.01 * direction(random), w = direction(random);
            Eigen::VectorXd rigid(k.rows());
            for (std::size_t p = 0; p < l.size(); ++p) {
                const vec3 move = v + cross(w, l.offset[p]);
                for (int a = 0; a < 3; ++a) {
                    rigid(static_cast<Eigen::Index>(6 * p) + a) = move[a];
                    rigid(static_cast<Eigen::Index>(6 * p) + 3 + a) = w[a];
                }
            }
            CHECK(largest(k * rigid) < 1e-15 * size * largest(rigid));
        }
        // lengths in units of 5 mm, so that forces and moments compare
        Eigen::VectorXd length = Eigen::VectorXd::Ones(k.rows());
        for (Eigen::Index i = 0; i < k.rows(); ++i)
            if (i % 6 > 2) length(i) = 1.0 / 0.005;
        const Eigen::VectorXd value = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                                          Eigen::MatrixXd(length.asDiagonal() * k * length.asDiagonal()))
                                          .eigenvalues();
        const double top = value(value.size() - 1);
        CHECK(std::abs(value(0)) < 1e-13 * top);
        CHECK(std::abs(value(5)) < 1e-13 * top);
        CHECK(value(6) > 1e-6 * top);
    }
}

TEST_CASE("two equal bonded balls: all frequencies in closed form, and the highest one is reported") {
    const double r = 0.004, mass = density * sphere_volume(r);
    for (const double ratio : {0.1, 0.25, 0.5, 1.0}) {
        parallel m;
        m.shear_stiffness = ratio * m.normal_stiffness;
        const lattice l(chain(1, r), m, density);
        const double kn = m.normal_stiffness, ks = m.shear_stiffness;
        // stretch 2 kn/m; shear with equal spins 2 ks/m + 2 ks r^2/I = 7 ks/m; opposite spins 2 kb/I = 5/4 kn/m; twist
        // 2 kt/I
        std::vector<double> exact = {2 * kn, 7 * ks, 7 * ks, 1.25 * kn, 1.25 * kn, 2.5 * ks};
        std::sort(exact.begin(), exact.end());
        Eigen::VectorXd weight(12);
        for (int i = 0; i < 12; ++i) weight(i) = 1.0 / std::sqrt(i % 6 < 3 ? mass : 0.4 * mass * r * r);
        const Eigen::VectorXd squares =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                Eigen::MatrixXd(weight.asDiagonal() * eigen(l.stiffness()) * weight.asDiagonal()))
                .eigenvalues();
        for (int i = 0; i < 6; ++i)
            CHECK(squares(6 + i) == Approx(exact[static_cast<std::size_t>(i)] / mass).epsilon(1e-12));
        CHECK(l.highest_frequency == Approx(std::sqrt(exact.back() / mass)).epsilon(1e-12));
    }
}

TEST_CASE("two unlike bonded balls without much shear stiffness: the highest frequency is that of the reduced mass") {
    parallel m;
    m.shear_stiffness = 1e-3 * m.normal_stiffness;
    m.radius_multiplier = 0.1; // weak in bending
    const double r1 = 0.004, r2 = 0.0015;
    const lattice l(make_shape("pair", {{{0, 0, 0}, r1}, {{r1 + r2, 0, 0}, r2}}), m, density);
    const double m1 = density * sphere_volume(r1), m2 = density * sphere_volume(r2);
    CHECK(l.highest_frequency == Approx(std::sqrt(m.normal_stiffness * (1.0 / m1 + 1.0 / m2))).epsilon(1e-12));
    CHECK(l.mass[0] + l.mass[1] == Approx(m1 + m2).epsilon(1e-14));
    CHECK(l.inertia[1] * l.mass[0] * r1 * r1 == Approx(l.inertia[0] * l.mass[1] * r2 * r2).epsilon(1e-13));
}

TEST_CASE("a chain of N bonds as a cantilever: deflection, slope, stretch and twist of the discrete beam") {
    const double r = 0.004;
    for (const int n : {1, 2, 3, 10, 40}) {
        const parallel m;
        const lattice l(chain(n, r), m, density);
        const constants c = l.bond.front();
        const double step = 2.0 * r, length = n * step;
        const double stretching = c.kn * step, bending = c.kb * step, twisting = c.kt * step; // E A, E I, G J
        REQUIRE(norm(cross(l.normal.front(), {1, 0, 0})) < 1e-12);                            // along x
        CHECK(held_chain(l, 0)(0) == Approx(length / stretching).epsilon(1e-9));
        CHECK(held_chain(l, 3)(3) == Approx(length / twisting).epsilon(1e-9));
        const double deflection = length * length * length / (3.0 * bending) * (1.0 - 1.0 / (4.0 * n * n)) + n / c.ks;
        for (const int across : {1, 2}) {
            CHECK(held_chain(l, across)(across) == Approx(deflection).epsilon(1e-8));
            CHECK(std::abs(held_chain(l, across)(across == 1 ? 5 : 4)) ==
                  Approx(length * length / (2.0 * bending)).epsilon(1e-8));
        }
        // an end moment bends into an arc, exactly for any N
        CHECK(held_chain(l, 4)(4) == Approx(length / bending).epsilon(1e-9));
        CHECK(std::abs(held_chain(l, 4)(2)) == Approx(length * length / (2.0 * bending)).epsilon(1e-8));
    }
}

TEST_CASE("the tip-loaded beam of the PFC manual: 200 in long, 8 in round, E 1e4 ksi, G 3759.4 ksi") {
    // inches, kips; the discs are thinner than the balls
    const int n = 10;
    const double length = 200.0, step = length / n, radius = 8.0;
    parallel m;
    m.reading = stiffness_reading::modulus;
    m.normal_stiffness = 1e4;
    m.shear_stiffness = 3759.4;
    m.radius_multiplier = radius / (0.5 * step);
    const lattice l(chain(n, 0.5 * step), m, 1.0);
    const double finite = 1.0 - 1.0 / (4.0 * n * n), slide = n / l.bond.front().ks;
    CHECK(held_chain(l, 1)(1) == Approx(0.0828931995 * finite + slide).epsilon(1e-8));
    CHECK(std::abs(held_chain(l, 1)(5)) == Approx(6.216989965e-4).epsilon(1e-8));
    CHECK(held_chain(l, 0)(0) == Approx(9.947183943e-5).epsilon(1e-8));
    CHECK(held_chain(l, 3)(3) == Approx(8.268593345e-6).epsilon(1e-8));
}

TEST_CASE("statics: loads, bonds and inertia balance on every pebble, for any load, orientation and spin") {
    random_stream random{8, 2};
    std::vector<shape> all = shapes_of_test();
    for (const double gap : {1e-6, 3e-5, 4e-4}) all.push_back(shrunk(shapes::tetrahedron_4(circumscribed(0.02)), gap));
    all.push_back(shrunk(shapes::apollonian_14(circumscribed(0.02)), 1e-4));
    for (const stiffness_reading reading :
         {stiffness_reading::force, stiffness_reading::per_area, stiffness_reading::modulus}) {
        parallel m;
        m.reading = reading;
        for (const shape& s : all) {
            const lattice l(s, m, density);
            INFO(s.name << ", reading " << static_cast<int>(reading) << ", first bond's gap "
                        << norm(l.offset[1] - l.offset[0]) - l.radius[0] - l.radius[1]);
            for (int i = 0; i < 5; ++i) {
                const quaternion q = orientation(random);
                const vec3 spin = 50.0 * i * direction(random);
                const std::vector<pebble_load> load = any_load(random, l.size());
                const std::vector<state> born = l.statics(load, q, spin);
                const residual left = out_of_balance(l, load, born, q, spin);
                CHECK(left.force < 1e-9 * 1000.0);
                CHECK(left.moment < 1e-9 * 3.0);
                double most = 0.0;
                for (std::size_t e = 0; e < born.size(); ++e) {
                    CHECK(std::abs(dot(born[e].v, rotate(q, l.normal[e]))) < 1e-9);
                    CHECK(std::abs(dot(born[e].mb, rotate(q, l.normal[e]))) < 1e-11);
                    most = std::max(most, std::abs(born[e].n) + norm(born[e].v));
                }
                CHECK(most < 2e4); // of the size of the loads
                CHECK(most > 10.0);
            }
        }
    }
}

TEST_CASE("statics does not depend on the frame: a turned grain under turned loads bears turned forces") {
    random_stream random{8, 3};
    const lattice l(lump(), parallel{}, density);
    const std::vector<pebble_load> load = any_load(random, l.size());
    const vec3 spin = 100.0 * direction(random);
    const quaternion q = orientation(random), turn = orientation(random);
    std::vector<pebble_load> turned = load;
    for (pebble_load& p : turned) p = {rotate(turn, p.force), rotate(turn, p.moment)};
    const auto before = l.statics(load, q, spin), after = l.statics(turned, turn * q, rotate(turn, spin));
    for (std::size_t e = 0; e < before.size(); ++e) {
        CHECK(after[e].n == Approx(before[e].n).epsilon(1e-9));
        CHECK(after[e].mt == Approx(before[e].mt).epsilon(1e-9));
        CHECK(norm(after[e].v - rotate(turn, before[e].v)) < 1e-8);
        CHECK(norm(after[e].mb - rotate(turn, before[e].mb)) < 1e-10);
    }
}

TEST_CASE("a chain that is pulled, accelerated, or whirled bears the textbook forces") {
    const double r = 0.004, mass = density * sphere_volume(r);
    const lattice l(chain(3, r), parallel{}, density);
    REQUIRE(l.offset[0].x < l.offset[3].x);
    std::vector<pebble_load> load(4);
    load[0].force = {-500, 0, 0}, load[3].force = {500, 0, 0};
    for (const state& s : l.statics(load, {}, {})) CHECK(s.n == Approx(500.0).epsilon(1e-9));
    load[0].force = {}; // pulled at one end only: every bond drags the balls behind it
    const auto dragged = l.statics(load, {}, {});
    for (std::size_t e = 0; e < 3; ++e)
        CHECK(dragged[e].n == Approx(125.0 * (static_cast<double>(e) + 1)).epsilon(1e-9));
    load[3].force = {}; // whirled: tension m w^2 x of the balls outside
    const double w = 300.0;
    const auto whirled = l.statics(load, {}, {0, 0, w});
    CHECK(whirled[0].n == Approx(mass * w * w * 3 * r).epsilon(1e-9));
    CHECK(whirled[1].n == Approx(mass * w * w * 4 * r).epsilon(1e-9));
    for (const state& s : l.statics(load, {}, {w, 0, 0}))
        CHECK(std::abs(s.n) + norm(s.v) < 1e-12); // about its own axis
    load[0].moment = {-2, 0, 0}, load[3].moment = {2, 0, 0};
    for (const state& s : l.statics(load, {}, {})) CHECK(s.mt == Approx(2.0).epsilon(1e-9));
}

TEST_CASE("a regular tetrahedron pulled at two opposite edges: its bonds share as symmetry and statics demand") {
    const lattice l(shapes::tetrahedron_4(circumscribed(0.02)), parallel{}, density);
    // pull the pebbles with z > 0 up and the others down: two bonds lie across, four bear the pull at 45 degrees
    std::vector<pebble_load> load(4);
    for (std::size_t i = 0; i < 4; ++i) load[i].force = {0, 0, l.offset[i].z > 0 ? 100.0 : -100.0};
    const auto born = l.statics(load, {}, {});
    double up = 0.0, across = 0.0;
    for (std::size_t e = 0; e < 6; ++e) {
        const double z = l.normal[e].z;
        if (std::abs(z) > 0.1) {
            up += std::abs(born[e].n * z + born[e].v.z);
            CHECK(born[e].n > 0.0);
            CHECK(born[e].n == Approx(born[1].n).epsilon(1e-9));
        } else {
            across += born[e].n;
        }
    }
    CHECK(up == Approx(200.0).epsilon(1e-9)); // a cut through the middle
    CHECK(across < 0.0);                      // squeezed
}

TEST_CASE("statics agrees with a minimum-norm solution found in another way") {
    random_stream random{8, 4};
    for (const shape& s : {shapes::tetrahedron_4(circumscribed(0.02)), lump()}) {
        const lattice l(s, parallel{}, density);
        const auto n = static_cast<Eigen::Index>(6 * l.size());
        // self-balanced loads: stretch every bond at random
        Eigen::VectorXd f = Eigen::VectorXd::Zero(n);
        const Eigen::MatrixXd k = eigen(l.stiffness());
        for (Eigen::Index i = 0; i < n; ++i) f += uniform(random, -1e-6, 1e-6) * k.col(i);
        const Eigen::VectorXd u = k.completeOrthogonalDecomposition().solve(f);
        std::vector<pebble_load> load(l.size());
        for (std::size_t i = 0; i < l.size(); ++i) {
            const auto first = static_cast<Eigen::Index>(6 * i);
            load[i] = {{f(first), f(first + 1), f(first + 2)}, {f(first + 3), f(first + 4), f(first + 5)}};
        }
        const auto born = l.statics(load, {}, {});
        for (std::size_t e = 0; e < born.size(); ++e) {
            const auto part = [&](std::int32_t p, int c) {
                return vec3{u(6 * p + c), u(6 * p + c + 1), u(6 * p + c + 2)};
            };
            const std::int32_t a = l.ends[e].a, b = l.ends[e].b;
            const vec3 d = part(b, 0) - part(a, 0), turn = part(b, 3) - part(a, 3);
            CHECK(born[e].n == Approx(l.bond[e].kn * dot(d, l.normal[e])).epsilon(1e-8).margin(1e-8));
            CHECK(born[e].mt == Approx(l.bond[e].kt * dot(turn, l.normal[e])).epsilon(1e-8).margin(1e-10));
        }
        CHECK(largest(eigen(l.pseudo_inverse) - eigen(l.pseudo_inverse).transpose()) <
              1e-12 * largest(eigen(l.pseudo_inverse)));
        CHECK(largest(k * (eigen(l.pseudo_inverse) * f) - f) < 1e-9 * largest(f));
    }
}

TEST_CASE("a shape without bonds has no stiffness and no frequency") {
    const lattice l(shapes::sphere(0.02), parallel{}, density);
    CHECK(l.highest_frequency == 0.0);
    CHECK(eigen(l.pseudo_inverse).isZero());
    CHECK(l.statics(std::vector<pebble_load>(1), {}, {}).empty());
}

TEST_CASE("a shape whose bonds leave a piece apart is refused") {
    const shape apart = make_shape("apart", {{{0, 0, 0}, 0.004}, {{0.008, 0, 0}, 0.004}, {{0.03, 0, 0}, 0.004}});
    CHECK_THROWS_AS(lattice(apart, parallel{}, density), input_error);
}

TEST_CASE("the bound of loads is never below what a bond carries, and not above it by more than some thirty times") {
    random_stream random{23, 1};
    for (const shape& s : {shapes::tetrahedron_4(circumscribed(0.02)), shapes::apollonian_14(circumscribed(0.02))})
        for (const likeness like : {likeness{}, likeness{0.5, 1.3}}) {
            const lattice l(s, parallel{}, density);
            const double strongest = like.scale * like.scale; // of equal stress
            double nearest = 1e9, farthest = 0.0;
            for (int k = 0; k < 200; ++k) {
                std::vector<pebble_load> load(l.size());
                for (std::size_t i = 0; i < l.size(); ++i)
                    if (uniform(random, 0.0, 1.0) < (k % 2 == 0 ? 0.4 : 1.0))
                        load[i] = {uniform(random, 0.0, 1000.0) * strongest * direction(random),
                                   uniform(random, 0.0, 1.0) * strongest * direction(random)};
                const vec3 spin = (k % 3 == 0 ? 2000.0 : 0.0) * direction(random);
                const std::vector<state> born = l.statics(load, orientation(random), spin, like);
                double worst = 0.0;
                for (std::size_t e = 0; e < born.size(); ++e) {
                    worst = std::max(worst, l.load_ratio(e, born[e], like));
                    // of a bond of that size
                    const constants own =
                        constants_of(parallel{}, like.scale * l.radius[static_cast<std::size_t>(l.ends[e].a)],
                                     like.scale * l.radius[static_cast<std::size_t>(l.ends[e].b)]);
                    CHECK(l.load_ratio(e, born[e], like) == Approx(load_ratio(own, born[e])).epsilon(1e-9));
                }
                const double bound = l.load_bound(load, spin, like);
                CHECK(bound >= worst);
                if (worst > 0.0)
                    nearest = std::min(nearest, bound / worst), farthest = std::max(farthest, bound / worst);
            }
            CHECK(nearest < 6.0);
            CHECK(farthest < 40.0);
        }
    // a single force that presses two pebbles: nearly met
    const lattice pair(make_shape("pair", {{{0, 0, 0}, 0.005}, {{0.01, 0, 0}, 0.005}}), parallel{}, density);
    const std::vector<pebble_load> pull{{{-1000.0, 0, 0}, {}}, {{1000.0, 0, 0}, {}}};
    const double carried = pair.load_ratio(0, pair.statics(pull, {}, {})[0]);
    CHECK(carried == Approx(1000.0 / (3.0e7 * 3.14159265 * 0.005 * 0.005)).epsilon(1e-6));
    CHECK(pair.load_bound(pull, {}) >= carried);
}
