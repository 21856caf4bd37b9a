// SPDX-License-Identifier: MIT
// Pebbles of a grain exchange places: all tables and lists follow.
#include <clast/engine/rearrange.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/contacts/rolling.hpp>
#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {
using brittle = scenes::breakable<>;
} // namespace

TEST_CASE("what tables say of a pebble goes with it to its new place") {
    engine<brittle> e = scenes::collision(scenes::settings<brittle>(1e15));
    scene<brittle> s = e.state();
    for (std::size_t p = 0; p < 8; ++p) {
        const auto x = static_cast<double>(p);
        s.grains.pebbles[p] = {{x, 0, 0}, 1.0 + x};
        s.grains.motion[2 + p].v.y = x;
        s.grains.losses[2 + p].damping = x;
        s.grains.materials.push_back(static_cast<std::uint8_t>(p));
    }
    s.heavy_wall.resize(2), s.light_wall.resize(1);
    s.heavy_wall[0].pebble = 3, s.heavy_wall[1].pebble = 4, s.light_wall[0].pebble = 6;
    s.light.pairs = {{0, 4}, {1, 6}, {4, 5}, {4, 7}, {5, 7}};
    s.light.resize();
    s.light.rows.resize(5);
    for (std::size_t k = 0; k < 5; ++k) {
        s.light.history[k].x = static_cast<double>(1 + k);
        s.light.rows[k].force.x = static_cast<double>(1 + k), s.light.rows[k].normal.y = 1.0;
    }
    rooms::rearrange(s, 1, std::vector<std::int32_t>{1, 3, 0, 2});
    const int stands[] = {0, 1, 2, 3, 5, 7, 4, 6};
    for (std::size_t p = 0; p < 8; ++p) {
        CHECK(s.grains.numbers[p] == stands[p]);
        CHECK(s.grains.number_of_pebble(static_cast<std::int32_t>(p)) == stands[p]);
        CHECK((s.grains.pebbles[p].x.x == stands[p] && s.grains.pebbles[p].radius == 1.0 + stands[p]));
        CHECK((s.grains.motion[2 + p].v.y == stands[p] && s.grains.losses[2 + p].damping == stands[p]));
        CHECK(s.grains.materials[p] == stands[p]);
    }
    CHECK((s.heavy_wall[0].pebble == 3 && s.heavy_wall[1].pebble == 6 && s.light_wall[0].pebble == 7));
    CHECK(s.light.pairs == std::vector<pebble_pair>{{0, 6}, {1, 7}, {4, 6}, {5, 6}, {4, 5}});
    const double side[] = {1, 1, -1, -1, 1};
    for (std::size_t k = 0; k < 5; ++k) {
        const double value = side[k] * static_cast<double>(1 + k);
        CHECK((s.light.history[k].x == value && s.light.rows[k].force.x == value));
        CHECK(s.light.rows[k].normal.y == side[k]);
    }
    // again: numbers are those for life
    rooms::rearrange(s, 1, std::vector<std::int32_t>{3, 0, 1, 2});
    CHECK(s.grains.numbers == std::vector<std::int32_t>{0, 1, 2, 3, 6, 5, 7, 4});
}

TEST_CASE("a contact seen from its other pebble remembers the opposite, its twist but the same") {
    using law = contacts::rolling<contacts::linear>;
    law::history h;
    h.base = {1, 2, 3}, h.roll = {4, 5, 6}, h.twist = 7;
    const law::history r = contacts::reversed(h);
    CHECK((r.base.x == -1 && r.base.y == -2 && r.base.z == -3 && r.roll.x == -4 && r.roll.z == -6 && r.twist == 7));
    struct silent {
        double x = 3.0;
    };
    CHECK(contacts::reversed(silent{5.0}).x == 3.0); // begins anew
}

TEST_CASE("two pebbles that exchange their sides feel each other as before") {
    // the law itself says what a history means: both views must answer with opposite forces and moments
    const contacts::rolling<contacts::linear> law{{5e6, 2e6, 0.3}, 40.0, 0.4, 30.0, 0.5};
    contacts::overlap<double> o{0.6, 0.0, 0.8, 1e-5, 200.0, 100.0};
    contacts::motion<double> m{4e-8, 0.0, -3e-8, 2e-4, 0.01, 0.6, 0.0, 0.8, 0.0, 1e-4, 2e-4, 3e-4};
    decltype(law)::history h;
    for (int k = 0; k < 5; ++k) law(o, m, h, 1e-6);
    auto seen = contacts::reversed(h);
    const auto a = law(o, m, h, 1e-6);
    o.nx = -o.nx, o.nz = -o.nz, o.curvature_i = 100.0, o.curvature_j = 200.0;
    m.ux = -m.ux, m.uz = -m.uz, m.mx = -m.mx, m.mz = -m.mz, m.spin = -m.spin;
    m.rx = -m.rx, m.ry = -m.ry, m.rz = -m.rz;
    const auto b = law(o, m, seen, 1e-6);
    CHECK(norm(vec3{a.fx + b.fx, a.fy + b.fy, a.fz + b.fz}) < 1e-12 * norm(vec3{a.fx, a.fy, a.fz}));
    CHECK(norm(vec3{a.mx, a.my, a.mz}) > 0.0);
    CHECK(norm(vec3{a.mx + b.mx, a.my + b.my, a.mz + b.mz}) < 1e-12 * norm(vec3{a.mx, a.my, a.mz}));
}
