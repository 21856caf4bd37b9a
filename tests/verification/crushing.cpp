// SPDX-License-Identifier: MIT
// A single grain between platens: it breaks at the load that the statics of its lattice of bonds says.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <clast/bonds/lattice.hpp>
#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using brittle = scenes::breakable<>;

struct crushed {
    double force = 0.0; ///< of the platens when the first bond broke (N)
    double all = 0.0;   ///< largest force of the test (N)
    std::int64_t broken = 0;
};

/// Crushes a 4B grain with the given orientation: replaced at about half the load of the first break.
crushed crush(const quaternion& q, double strength, double trigger_force, double safety, double distance) {
    const shape grain = shapes::tetrahedron_4(circumscribed(0.02));
    bodies::clumps sp = scenes::empty(grain);
    sp.add(0, {}, q);
    const boundaries::cylinder_settings c = scenes::cylinder_around(sp);
    auto s = scenes::settings<brittle>(trigger_force / (0.9 * 0.02 * 0.02), strength);
    s.safety = safety;
    engine<brittle> e(s, std::move(sp), boundaries::solid_strips(c));
    e.drives.platens.how = boundaries::drive::mode::velocity;
    e.drives.platens.value = 5e-4;
    crushed out;
    const double start = e.boundary.height();
    while (start - e.boundary.height() < distance) {
        const double before = e.loads()[boundaries::top_platen].force;
        e.step();
        out.broken += static_cast<std::int64_t>(e.take_events().size());
        out.all = std::max(out.all, e.loads()[boundaries::top_platen].force);
        if (out.force == 0.0 && out.broken > 0) out.force = before;
        if (out.force > 0.0 && distance > 1.0) break;
    }
    return out;
}

/// The load at which the first bond fails, if platens push pebbles up and down in equal parts: utilisation is linear in
/// the load.
double by_statics(const quaternion& q, double strength) {
    bonds::parallel material;
    material.tensile_strength *= strength;
    material.cohesion *= strength;
    const shape grain = shapes::tetrahedron_4(circumscribed(0.02));
    const bonds::lattice lattice(grain, material, 2650.0);
    std::vector<double> z;
    for (const shape_pebble& p : grain.pebbles) z.push_back(rotate(q, p.offset).z);
    const double top = *std::max_element(z.begin(), z.end()), bottom = *std::min_element(z.begin(), z.end());
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-6; };
    double up = 0.0, down = 0.0;
    for (const double one : z) up += near(one, bottom) ? 1.0 : 0.0, down += near(one, top) ? 1.0 : 0.0;
    std::vector<bonds::pebble_load> load(4);
    for (std::size_t p = 0; p < 4; ++p) {
        if (near(z[p], bottom)) load[p].force.z += 1.0 / up;
        if (near(z[p], top)) load[p].force.z -= 1.0 / down;
    }
    double worst = 0.0;
    const std::vector<bonds::state> unit_load = lattice.statics(load, q, {});
    for (std::size_t b = 0; b < lattice.bond.size(); ++b)
        worst = std::max(worst, bonds::utilisation(lattice.bond[b], unit_load[b]));
    return 1.0 / worst;
}

const quaternion face_down = scenes::turning(unit(vec3{1, 1, 1}), {0, 0, 1});
const quaternion edge_down{}; // two pebbles up, two down

} // namespace

TEST_CASE("the first bond of a grain on its face breaks within one per cent of lattice statics") {
    const double expected = by_statics(face_down, 0.1);
    INFO("statics: " << expected << " N");
    CHECK(crush(face_down, 0.1, 0.5 * expected, 0.8, 2.0).force == Approx(expected).epsilon(0.01));
}

TEST_CASE("the first bond of a grain on its edge breaks within one per cent of lattice statics") {
    const double expected = by_statics(edge_down, 0.1);
    INFO("statics: " << expected << " N");
    CHECK(crush(edge_down, 0.1, 0.5 * expected, 0.8, 2.0).force == Approx(expected).epsilon(0.01));
}

TEST_CASE("a crushing test with half the step has the same result") {
    const double expected = by_statics(face_down, 0.1);
    const crushed whole = crush(face_down, 0.1, 0.5 * expected, 0.8, 4e-4);
    const crushed half = crush(face_down, 0.1, 0.5 * expected, 0.4, 4e-4);
    CHECK(whole.broken > 0);
    CHECK(whole.force == Approx(half.force).epsilon(0.005));
    CHECK(whole.all == Approx(half.all).epsilon(0.03));
    CHECK(std::abs(whole.broken - half.broken) <= 1);
}
