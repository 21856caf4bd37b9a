// SPDX-License-Identifier: MIT
#include <clast/engine/walls.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

using rigid = scenes::unbreakable<>;

} // namespace

TEST_CASE("a clump thrown at a platen comes back with its energy, and the platen took the momentum") {
    auto s = scenes::settings<rigid>();
    s.scheme.damping = 0.0;
    s.safety = 0.05;
    bodies::clumps sp = scenes::empty(shapes::tetrahedron_4(circumscribed(0.02)));
    sp.add(0, {0, 0, -0.18}, unit(quaternion{1.0, 0.3, -0.2, 0.5}));
    sp.motion[0].v = {0.0, 0.0, -1.0};
    engine<rigid> e(s, sp, boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
    const double before = e.kinetic_energy(), p = scenes::momentum(e.grains).z;
    double impulse = 0.0;
    while (e.time() < 0.03) {
        e.step();
        impulse += e.loads()[boundaries::bottom_platen].force * e.dt();
    }
    CHECK(impulse > 0.0);
    CHECK(scenes::momentum(e.grains).z - p == Approx(impulse).epsilon(1e-12));
    CHECK(scenes::momentum(e.grains).x == 0.0); // platens are frictionless
    CHECK(e.elastic_energy() == 0.0);
    CHECK(e.kinetic_energy() == Approx(before).epsilon(1e-3));
    CHECK(e.totals().boundary_work == 0.0);
}

TEST_CASE("a platen that pushes a clump does the work that the clump receives") {
    auto s = scenes::settings<rigid>();
    s.scheme.damping = 0.0;
    s.safety = 0.05;
    bodies::clumps sp = scenes::empty(shapes::tetrahedron_4(circumscribed(0.02)));
    s.safety = 0.05;
    sp.add(0, {0, 0, -0.185}, unit(quaternion{1.0, 0.3, -0.2, 0.5}));
    engine<rigid> e(s, sp, boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
    e.drives.platens.how = boundaries::drive::mode::velocity;
    e.drives.platens.value = 0.5;
    while (e.time() < 0.04) e.step();
    CHECK(e.elastic_energy() == 0.0);
    CHECK(e.kinetic_energy() > 1e-4);
    CHECK(e.totals().boundary_work == Approx(e.kinetic_energy()).epsilon(1e-3));
    CHECK(scenes::momentum(e.grains).z > 0.0);
}

namespace {
/// Answers with the geometry that it is given.
struct told {
    struct history {};
    contacts::response<double> operator()(const contacts::overlap<double>& o, const contacts::motion<double>&, history&,
                                          double) const {
        return {0.0, 0.0, -o.reduced_radius() * o.reduced_mass(), 0.0};
    }
    double stored(const contacts::overlap<double>&, const history&) const { return 0.0; }
    double normal_stiffness(const contacts::overlap<double>&) const { return 1e6; }
    double shear_stiffness(const contacts::overlap<double>&) const { return 0.0; }
};
struct tells : rigid {
    using contact = told;
};
} // namespace

TEST_CASE("to a law a wall is flat and heavy: R is the radius of the pebble, m the mass of its body") {
    bodies::clumps sp = scenes::empty(shapes::tetrahedron_4(circumscribed(0.02)));
    sp.add(0, {}, {});
    boundaries::cylinder_settings c = scenes::cylinder_around(sp, 1e-5);
    const double r = sp.pebbles[0].radius, mass = sp.mass_of(sp.grains[0]);
    engine<tells> e(
        {.grain_contact = {}, .platen_contact = {}, .lateral_contact = {}, .breakage = {}, .replacement = {}}, sp,
        boundaries::solid_strips(c));
    e.step();
    std::size_t rows = 0;
    e.each_wall_row([&](const boundaries::wall_row& w) {
        if (w.touch.size == 0) return;
        CHECK(norm(w.force) == Approx(r * mass).epsilon(1e-12));
        ++rows;
    });
    CHECK(rows == 4);
}
