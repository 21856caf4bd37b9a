// SPDX-License-Identifier: MIT
#include <clast/protocol/triaxial.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/boundaries/solid_strips.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;
using namespace clast::literals;

namespace {

using rigid = scenes::unbreakable<boundaries::tiles>;
using setup_type = triaxial_setup<rigid>;

setup_type good() {
    return {.grain = shapes::tetrahedron_4(0.02),
            .diameter = 66_mm,
            .height = 75_mm,
            .confining = 200_kPa,
            .breakage = {},
            .replacement = {},
            .porosity = 0.62,
            .rings = 4,
            .tiles_per_ring = 8,
            .inertial_number = 5e-3};
}
/// The message of a setup that is refused; empty if it is taken.
std::string refusal(const std::function<void(setup_type&)>& change) {
    setup_type s = good();
    change(s);
    try {
        const triaxial_test<rigid> test(s, protocol::preparation(s.diameter, s.height));
    } catch (const input_error& e) {
        return e.what();
    }
    return {};
}

} // namespace

TEST_CASE("a setup that makes no sense is refused by the name of its member, with what is allowed") {
    CHECK(refusal([](setup_type&) {}).empty());
    const auto names = [](const std::string& text, const char* member) {
        INFO(text);
        CHECK(text.find(member) != std::string::npos);
        CHECK(text.find("Allowed") != std::string::npos);
    };
    names(refusal([](setup_type& s) { s.confining = -2_MPa; }), "confining");
    names(refusal([](setup_type& s) { s.confining = 0_Pa; }), "confining");
    names(refusal([](setup_type& s) { s.tiles_per_ring = 40; }), "tiles_per_ring"); // 5 mm wide, pebbles 9 mm
    names(refusal([](setup_type& s) { s.tiles_per_ring = 5; }), "tiles_per_ring");
    names(refusal([](setup_type& s) { s.rings = 36; }), "rings");                // 2 mm high
    names(refusal([](setup_type& s) { s.rings = 36; }), "Take 8 rings at most"); // of 9 mm
    names(refusal([](setup_type& s) { s.diameter = 40_mm; }), "diameter");
    names(refusal([](setup_type& s) { s.height = 40_mm; }), "height");
    names(refusal([](setup_type& s) { s.porosity = 1.0; }), "porosity");
    names(refusal([](setup_type& s) { s.porosity = 0.1; }), "porosity");
    names(refusal([](setup_type& s) { s.damping = 1.0; }), "damping");
    names(refusal([](setup_type& s) { s.damping = -0.1; }), "damping");
    names(refusal([](setup_type& s) { s.safety = 0.0; }), "safety");
    names(refusal([](setup_type& s) { s.inertial_number = 0.0; }), "inertial_number");
    names(refusal([](setup_type& s) { s.vessel = 1.0; }), "vessel");
    names(refusal([](setup_type& s) { s.threads = 0; }), "threads");
    names(refusal([](setup_type& s) { s.grain = shape{}; }), "grain");
}

TEST_CASE("a specimen starts as a cloud in a larger vessel, with the number of grains that the porosity asks for") {
    const triaxial_test<rigid> test(good(), protocol::preparation(66_mm, 75_mm));
    const bodies::clumps& s = test.sim().grains;
    const double section = 8.0 * std::tan(std::numbers::pi / 8.0) * 0.033 * 0.033;
    CHECK(s.solid_volume() / (section * 0.075) == Approx(0.38).margin(0.5 * s.shapes[0].volume / (section * 0.075)));
    CHECK(test.sim().boundary.height() == Approx(1.8 * 0.075));
    CHECK(test.sim().boundary.apothem(boundaries::first_lateral_facet) == Approx(1.8 * 0.033));
    for (std::size_t g = 0; g < s.grain_count(); ++g) CHECK(dot(s.motion[g].v, s.motion[g].x) <= 0.0); // inwards
    CHECK(test.sim().elastic_energy() == 0.0);
    // stiffness in series, the smaller friction
    CHECK(test.sim().settings.grain_contact.kn == Approx(2.9e6));
    CHECK(test.sim().settings.grain_contact.mu == 0.3);
    CHECK(test.sim().settings.lateral_contact.kn == Approx(5.8e6 * 3.2e6 / 9.0e6));
    CHECK(test.sim().settings.lateral_contact.mu == 0.0);
}

TEST_CASE("a box counts its porosity in its own section, and has no use for rings and tiles") {
    using in_box = scenes::unbreakable<boundaries::box>;
    const triaxial_setup<in_box> s{.grain = shapes::tetrahedron_4(0.02),
                                   .diameter = 66_mm,
                                   .height = 75_mm,
                                   .confining = 200_kPa,
                                   .breakage = {},
                                   .replacement = {},
                                   .porosity = 0.62,
                                   .rings = 1000,
                                   .tiles_per_ring = 1};
    const triaxial_test<in_box> test(s, protocol::preparation(66_mm, 75_mm));
    const double volume = 0.066 * 0.066 * 0.075;
    CHECK(test.sim().grains.solid_volume() / volume == Approx(0.38).margin(0.5 * s.grain.volume / volume));
    CHECK(test.sim().boundary.volume() == Approx(1.8 * 1.8 * 1.8 * volume));
}

TEST_CASE("a test of spheres takes a single sphere as its grain, and says so") {
    struct of_spheres : rigid {
        using body = bodies::spheres;
    };
    triaxial_setup<of_spheres> s{.grain = shapes::tetrahedron_4(0.02),
                                 .diameter = 66_mm,
                                 .height = 75_mm,
                                 .confining = 200_kPa,
                                 .breakage = {},
                                 .replacement = {},
                                 .porosity = 0.62,
                                 .rings = 3,
                                 .tiles_per_ring = 8};
    std::string text;
    try {
        const triaxial_test<of_spheres> test(s, protocol::preparation(66_mm, 75_mm));
    } catch (const input_error& e) {
        text = e.what();
    }
    CHECK(text.find("grain") == 0);
    CHECK(text.find("'4B', of 4 pebbles") != std::string::npos);
    s.grain = shapes::sphere(0.02);
    const triaxial_test<of_spheres> test(s, protocol::preparation(66_mm, 75_mm));
    const bodies::spheres& grains = test.sim().grains;
    REQUIRE(grains.body_count() > 10);
    for (std::size_t b = 0; b < grains.body_count(); ++b) CHECK(dot(grains.pebbles[b].v, grains.centre(b)) < 0.0);
}

TEST_CASE("the stages of the paper come in their order, the membrane with the consolidation, strain from shear on") {
    const std::vector<stage> s = protocol::triaxial_compression(30_cm, 70_cm, 2_MPa, 25_percent);
    std::vector<std::string> names;
    for (const stage& one : s) names.push_back(one.name);
    CHECK(names == std::vector<std::string>{"compact", "relax", "seat", "consolidate", "shear"});
    CHECK(s[0].axial.value == Approx(0.7));
    CHECK(s[0].lateral.value == Approx(0.15));
    CHECK_FALSE(s[0].breakage);
    CHECK(s[3].membrane_here);
    CHECK(s[3].breakage);
    CHECK(s[4].reference_here);
    CHECK(s[4].lateral.how == axis_drive::kind::stress);
    CHECK(s[4].lateral.value == Approx(2e6));
    CHECK(s[4].axial.value == 1e-4);
    CHECK(protocol::unloading(2_MPa, 10_kPa).axial.value < 0.0);
}

TEST_CASE("stages take sizes, stress and inertial number from the setup, or are compared with it") {
    const auto taken = [](std::vector<stage> stages) -> std::vector<stage> {
        return triaxial_test<rigid>(good(), std::move(stages)).protocol().plan.stages;
    };
    std::vector<stage> s = protocol::triaxial_compression(1_percent);
    s.push_back(protocol::unloading(5_kPa));
    const std::vector<stage> from = taken(s);
    std::vector<stage> given = protocol::triaxial_compression(66_mm, 75_mm, 200_kPa, 1_percent, 5e-3);
    given.push_back(protocol::unloading(200_kPa, 5_kPa, 5e-3));
    REQUIRE(from.size() == given.size());
    for (std::size_t k = 0; k < from.size(); ++k) {
        CHECK(from[k].name == given[k].name);
        CHECK(from[k].axial.how == given[k].axial.how);
        CHECK(from[k].axial.value == given[k].axial.value);
        CHECK(from[k].lateral.value == given[k].lateral.value);
        CHECK_FALSE(from[k].axial.of_setup);
    }
    const auto refused = [&](const std::vector<stage>& stages) -> std::string {
        try {
            (void)taken(stages);
        } catch (const input_error& e) {
            return e.what();
        }
        return {};
    };
    const auto names = [](const std::string& text, const char* what, const char* values) {
        INFO(text);
        CHECK(text.find(what) == 0);
        CHECK(text.find(values) != std::string::npos);
    };
    names(refused(protocol::triaxial_compression(140_mm, 75_mm, 200_kPa, 1_percent)),
          "diameter of the setup, and of stage 'compact'", "66 and 140 mm");
    names(refused(protocol::triaxial_compression(66_mm, 150_mm, 200_kPa, 1_percent)),
          "height of the setup, and of stage 'compact'", "75 and 150 mm");
    names(refused(protocol::triaxial_compression(66_mm, 75_mm, 5_MPa, 1_percent)),
          "confining of the setup, and of stage 'shear'", "200 and 5000 kPa");
    // several on the way are well, and a preparation alone
    std::vector<stage> more = protocol::triaxial_compression(66_mm, 75_mm, 200_kPa, 1_percent);
    more.insert(more.begin(), protocol::preparation(80_mm, 90_mm)[0]);
    more.push_back(protocol::shear(300_kPa, 2_percent));
    CHECK(refused(more).empty());
    CHECK(refused(protocol::preparation(66_mm, 75_mm)).empty());
}

TEST_CASE("the paper's preparation at toy size ends relaxed, or seated at 1 kPa, at its size") {
    setup_type s = good();
    triaxial_test<rigid> test(s, protocol::preparation(s.diameter, s.height));
    observer quiet;
    REQUIRE(test.run(quiet));
    const sample now = test.protocol().measure();
    CHECK(now.height == Approx(0.075).epsilon(0.02));
    CHECK(now.porosity == Approx(0.62).epsilon(0.03));
    CHECK(now.p < 2e3);
    CHECK(now.replaced == 0);
}
