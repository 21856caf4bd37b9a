// SPDX-License-Identifier: MIT
#include <clast/replacements/one_of.hpp>

#include <cstdint>

#include <clast/measure/digest.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;
namespace of = clast::replacements;

static_assert(of::replacing<of::any>);

namespace {
template <class R> struct with : scenes::breakable<> { using replacement = R; };

/// What has become of a small packing whose grains break at a low load.
struct end {
    std::uint64_t state;
    std::int64_t replaced, broken;
    std::size_t grains;
};
template <class R> end run(R how) {
    const auto weak = [](auto& policy) { policy.bond.tensile_strength *= 0.02, policy.bond.cohesion *= 0.02; };
    if constexpr (requires { how.model; }) std::visit(weak, how.model);
    weak(how);
    engine_settings<with<R>> s{.grain_contact = contacts::linear::between(scenes::pebble, scenes::pebble),
                               .platen_contact = contacts::linear::between(scenes::pebble, scenes::platen),
                               .lateral_contact = contacts::linear::between(scenes::pebble, scenes::membrane),
                               .breakage = {criteria::crushing_strength(3e5)},
                               .replacement = how};
    auto e = scenes::packed<with<R>>(s, shapes::tetrahedron_4(circumscribed(0.02)), 12, 0.04, 2e5, 2500);
    e.breakage_on = true;
    e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.1};
    e.step(1500);
    e.take_events();
    return {measure::digest_of_state(e), e.totals().replaced, e.totals().broken_tension + e.totals().broken_shear,
            e.grains.grain_count()};
}
template <class R> void check_same(const R& how) {
    const end alone = run(how), picked = run(of::any(how));
    CHECK(alone.replaced > 0);
    CHECK((picked.state == alone.state && picked.replaced == alone.replaced && picked.broken == alone.broken &&
           picked.grains == alone.grains));
}
} // namespace

TEST_CASE("a replacement picked at run time does what it does alone, to the last bit") {
    check_same(of::modified{});
    of::refreezing quick;
    quick.rest = 1e-5;
    check_same(quick);
    check_same(of::rigid_bonded{});
    check_same(of::bonded_from_start{});
}

TEST_CASE("a replacement picked at run time has the bond of the one picked, and refuses what that refuses") {
    of::rigid_bonded soft;
    soft.bond.normal_stiffness = 1e6;
    const of::any picked = soft;
    CHECK(picked.bond.normal_stiffness == 1e6);
    CHECK_THROWS_AS(picked.check(shapes::tetrahedron_4(0.02), 1.0, 2.9e6), input_error);
    picked.check(shapes::sphere(0.02), 1.0, 2.9e6); // without bonds
    of::any(of::modified{.bond = soft.bond}).check(shapes::tetrahedron_4(0.02), 1.0, 2.9e6);
}
