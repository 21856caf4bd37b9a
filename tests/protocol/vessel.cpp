// SPDX-License-Identifier: MIT
#include <clast/protocol/vessel.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/protocol/triaxial.hpp>

#include <catch.hpp>

using namespace clast;
using namespace clast::literals;

namespace {

struct without_wall : triaxial_policies_default {
    using boundary = boundaries::none;
};

/// The poorest vessel: a box that shows nothing but what the concepts ask.
class poorest {
  public:
    poorest() = delete;
    static poorest made(const boundaries::vessel_settings& s) { return poorest(boundaries::box::made(s)); }
    poorest resized(const boundaries::vessel_settings& s) const { return poorest(in_.resized(s)); }
    bool near(const vec3& x, double reach) const { return in_.near(x, reach); }
    boundaries::touches touch(const vec3& x, double r, double ahead = 0.0) const { return in_.touch(x, r, ahead); }
    int facet_count() const { return 6; }
    double velocity(int facet) const { return in_.velocity(facet); }
    void control(std::span<const boundaries::facet_load> loads, const boundaries::drives& d, double dt,
                 std::span<const boundaries::coupling>) {
        in_.control(loads, d, dt);
    }
    void advance(double dt) { in_.advance(dt); }
    double fastest() const { return in_.fastest(); }
    double power(std::span<const boundaries::facet_load> loads) const { return in_.power(loads); }
    double volume() const { return in_.volume(); }
    double height() const { return in_.height(); }
    double bottom() const { return in_.bottom(); }
    double radius() const { return in_.radius(); }
    double end_section(int platen) const { return in_.end_section(platen); }
    bool holds(const vec3& x, double r) const { return in_.holds(x, r); }
    bool outside(const vec3& x, double r) const { return in_.outside(x, r); }
    double lateral_stress(std::span<const boundaries::facet_load> loads) const { return in_.lateral_stress(loads); }
    double confining_error(std::span<const boundaries::facet_load> loads, double sigma) const {
        return in_.confining_error(loads, sigma);
    }
    std::vector<facet_view> view(std::span<const boundaries::facet_load> loads) const { return in_.view(loads); }
    template <class A> void archive(A& a) { a(in_); }

  private:
    explicit poorest(const boundaries::box& b) : in_(b) {}
    boundaries::box in_;
};

/// A box that does not say how large its ends are.
struct endless : boundaries::box {
    explicit endless(const box& b) : box(b) {}
    static endless made(const boundaries::vessel_settings& s) { return endless(box::made(s)); }
    endless resized(const boundaries::vessel_settings& s) const { return endless(box::resized(s)); }
    int end_section = 0; // hides the function
};

template <class Boundary, class Body> struct whole : triaxial_policies_default {
    using body = Body;
    using boundary = Boundary;
    using breakage = criteria::none;
    using replacement = replacements::none;
};

/// Packed, consolidated and sheared a little, at toy size.
template <class P> sample sheared(const shape& grain, double porosity) {
    const triaxial_setup<P> setup{.grain = grain,
                                  .diameter = 66_mm,
                                  .height = 75_mm,
                                  .confining = 200_kPa,
                                  .breakage = {},
                                  .replacement = {},
                                  .porosity = porosity,
                                  .rings = 4,
                                  .tiles_per_ring = 8,
                                  .inertial_number = 5e-3};
    stage compact = protocol::preparation(66_mm, 75_mm)[0], settle = protocol::consolidation(200_kPa);
    compact.yields_at = 0.0, settle.walls_at_rest = false; // in few steps
    settle.end = until::stresses_within(0.02) && until::unbalanced_below(0.02);
    triaxial_test<P> test(setup, {compact, settle, protocol::shear(200_kPa, 1_percent, 5e-3)});
    observer quiet;
    REQUIRE(test.run(quiet));
    const std::vector<pebble_view> seen = test.protocol().pebbles();
    REQUIRE(seen.size() == test.sim().grains.pebble_count());
    CHECK(seen.back().grain == static_cast<std::int32_t>(test.sim().grains.grain_count()) - 1);
    CHECK(seen.back().radius == grain.pebbles.back().radius);
    CHECK(norm(seen.back().displacement) > 0.0);
    const auto last = static_cast<std::int32_t>(seen.size()) - 1;
    CHECK(norm(seen.back().velocity) > 0.0);
    CHECK(norm(seen.back().velocity - test.sim().grains.velocity_of(last)) == 0.0);
    CHECK(seen.back().fragment == last + 1 - static_cast<std::int32_t>(grain.pebbles.size()));
    CHECK_FALSE(test.protocol().facets().empty());
    const sample s = test.protocol().measure();
    // stresses by hand: what the ends carry beyond the pressure there, on the mean section
    const auto loads = test.sim().loads();
    const auto& b = test.sim().boundary;
    double q = 0.0;
    for (const int end : {0, 1})
        q +=
            0.5 * (loads[static_cast<std::size_t>(end)].force - s.sigma_3 * b.end_section(end)) / (s.volume / s.height);
    CHECK(s.q == Approx(q).epsilon(1e-9));
    CHECK(s.sigma_1 == Approx(s.sigma_3 + q).epsilon(1e-9));
    CHECK(s.p == Approx(s.sigma_3 + q / 3.0).epsilon(1e-9));
    CHECK(std::sin(s.phi_mob_deg * std::numbers::pi / 180.0) == Approx(q / (q + 2.0 * s.sigma_3)).epsilon(1e-9));
    CHECK(s.q_contacts == Approx(s.sigma_1_love_weber - s.sigma_3_love_weber).epsilon(1e-12));
    return s;
}
void check(const sample& s, double porosity) {
    CHECK(s.axial_strain == Approx(0.01).epsilon(0.01)); // in the step that reaches it
    CHECK(s.sigma_3 == Approx(2e5).epsilon(0.1));
    CHECK(s.q > 2e4);
    CHECK(s.porosity == Approx(porosity).margin(0.06));
    CHECK(std::abs(s.energy_residual) < 0.05);
}

} // namespace

TEST_CASE("a triaxial test needs a vessel, an engine needs none") {
    static_assert(protocol::vessel<boundaries::tiles> && protocol::vessel<boundaries::ring_walls> &&
                  protocol::vessel<boundaries::solid_strips> && protocol::vessel<boundaries::box>);
    static_assert(!protocol::vessel<boundaries::none> && !protocol::vessel<int>);
    static_assert(!protocol::vessel<endless> && boundaries::surface<endless>);
    static_assert(simulator_policies<without_wall> && !triaxial_policies<without_wall>);
    static_assert(triaxial_policies<triaxial_policies_default>);
    static_assert(triaxial_policies<whole<boundaries::box, bodies::spheres>>);
    SUCCEED("checked at compile time");
}

TEST_CASE("clumps in a box go through a triaxial test") {
    check(sheared<whole<boundaries::box, bodies::clumps>>(shapes::tetrahedron_4(circumscribed(0.02)), 0.6), 0.6);
}

TEST_CASE("spheres between tiles and in a box go through a triaxial test") {
    check(sheared<whole<boundaries::tiles, bodies::spheres>>(shapes::sphere(0.016), 0.45), 0.45);
    check(sheared<whole<boundaries::box, bodies::spheres>>(shapes::sphere(0.016), 0.45), 0.45);
}

TEST_CASE("the poorest vessel gives the bits of the box that it hides") {
    const sample one = sheared<whole<poorest, bodies::spheres>>(shapes::sphere(0.016), 0.45);
    const sample other = sheared<whole<boundaries::box, bodies::spheres>>(shapes::sphere(0.016), 0.45);
    CHECK(one.q == other.q);
    CHECK(one.volume == other.volume);
    CHECK(one.steps == other.steps);
}

TEST_CASE("a sphere that has got out stops a test, named like a grain") {
    using policies = whole<boundaries::box, bodies::spheres>;
    triaxial_test<policies> test({.grain = shapes::sphere(0.016),
                                  .diameter = 66_mm,
                                  .height = 75_mm,
                                  .confining = 200_kPa,
                                  .breakage = {},
                                  .replacement = {}},
                                 {stage{.name = "rest", .end = until::steps(200)}});
    test.protocol().plan.look_every = 1; // the wall would throw it back
    test.sim().grains.pebbles[7].x = {0.3, 0.0, 0.0};
    observer quiet;
    std::string text;
    try {
        test.run(quiet);
    } catch (const run_error& e) {
        text = e.what();
    }
    CHECK(text.find("grain 7 escaped (all of it)") == 0);
}
