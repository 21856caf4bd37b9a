// SPDX-License-Identifier: MIT
#include <clast/protocol/triaxial.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/contacts/by_material.hpp>
#include <clast/fields/gravity.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;
using namespace clast::literals;

namespace {

using rigid = scenes::unbreakable<boundaries::tiles>;
using setup_type = triaxial_setup<rigid>;

template <class P = rigid> triaxial_setup<P> good() {
    return {.grain = shapes::tetrahedron_4(circumscribed(0.02)),
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
    try {
        change(s);
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
    CHECK(test.sim().boundary.radius() == Approx(1.8 * 0.033));
    CHECK(test.sim().kinetic_energy() == 0.0); // the stage that compacts sends it off
    CHECK(test.sim().elastic_energy() == 0.0);
    // stiffness in series, the smaller friction
    CHECK(test.sim().settings.grain_contact.kn == Approx(5.8e6));
    CHECK(test.sim().settings.grain_contact.mu == 0.3);
    CHECK(test.sim().settings.lateral_contact.kn == Approx(11.6e6 * 3.2e6 / 14.8e6));
    CHECK(test.sim().settings.lateral_contact.mu == 0.0);
}

TEST_CASE("a box counts its porosity in its own section, and has no use for rings and tiles") {
    using in_box = scenes::unbreakable<boundaries::box>;
    triaxial_setup<in_box> s = good<in_box>();
    s.rings = 1000, s.tiles_per_ring = 1, s.inertial_number = 1e-4;
    const triaxial_test<in_box> test(s, protocol::preparation(66_mm, 75_mm));
    const double volume = 0.066 * 0.066 * 0.075;
    CHECK(test.sim().grains.solid_volume() / volume ==
          Approx(0.38).margin(0.5 * s.grain.parts()[0].form.volume / volume));
    CHECK(test.sim().boundary.volume() == Approx(1.8 * 1.8 * 1.8 * volume));
}

TEST_CASE("a test of spheres takes a single sphere as its grain, and says so") {
    struct of_spheres : rigid {
        using body = bodies::spheres;
    };
    triaxial_setup<of_spheres> s = good<of_spheres>();
    s.rings = 3, s.inertial_number = 1e-4;
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
    CHECK(s[3].walls_at_rest);
    CHECK(s[3].ends_at_standstill);
    CHECK(s[3].breakage);
    CHECK(s[4].reference_here);
    CHECK(s[4].lateral.how == axis_drive::kind::stress);
    CHECK(s[4].lateral.value == Approx(2e6));
    CHECK(s[4].axial.value == 1e-4);
    CHECK(protocol::unloading(2_MPa, 10_kPa).axial.value < 0.0);
}

TEST_CASE("consolidation keeps to the paper's inertial numbers, or to that of a shear that is faster") {
    const auto numbers = [](double shear) {
        setup_type s = good();
        s.inertial_number = shear;
        const triaxial_test<rigid> test(s, protocol::preparation());
        const test_plan& p = test.protocol().plan;
        return std::pair(p.consolidation_inertial_number, p.final_inertial_number);
    };
    CHECK(numbers(1e-5) == std::pair(1e-3, 1e-4));
    CHECK(numbers(1e-4) == std::pair(1e-3, 1e-4));
    CHECK(numbers(5e-4) == std::pair(1e-3, 5e-4));
    CHECK(numbers(5e-3) == std::pair(5e-3, 5e-3));
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
          "diameter of the setup, and of stage 'seat'", "66 and 140 mm");
    names(refused(protocol::triaxial_compression(66_mm, 150_mm, 200_kPa, 1_percent)),
          "height of the setup, and of stage 'seat'", "75 and 150 mm");
    names(refused(protocol::triaxial_compression(66_mm, 75_mm, 5_MPa, 1_percent)),
          "confining of the setup, and of stage 'shear'", "200 and 5000 kPa");
    // several on the way are well, and a preparation alone
    std::vector<stage> more = protocol::triaxial_compression(66_mm, 75_mm, 200_kPa, 1_percent);
    more.insert(more.begin(), protocol::preparation(80_mm, 90_mm)[0]);
    more.push_back(protocol::shear(300_kPa, 2_percent));
    CHECK(refused(more).empty());
    CHECK(refused(protocol::preparation(66_mm, 75_mm)).empty());
}

TEST_CASE("the paper's preparation at toy size ends relaxed, or seated at a small stress, at its size") {
    setup_type s = good();
    triaxial_test<rigid> test(s, protocol::preparation(s.diameter, s.height));
    observer quiet;
    REQUIRE(test.run(quiet));
    const sample now = test.protocol().measure();
    CHECK(now.height == Approx(0.075).epsilon(0.02));
    CHECK(now.porosity == Approx(0.62).epsilon(0.03));
    CHECK(now.p < 1e3);
    CHECK(now.replaced == 0);
}

TEST_CASE("a graded mixture of shapes fills the specimen to its porosity, and walls and speeds suit its sizes") {
    triaxial_setup<rigid> s = good();
    s.grain =
        mixture({{shapes::apollonian_14(circumscribed(1.0)), 0.5}, {shapes::tetrahedron_4(circumscribed(1.0)), 0.5}},
                grading({{8e-3, 0.0}, {1.6e-2, 0.6}, {2.4e-2, 1.0}}));
    const triaxial_test<rigid> test(s, protocol::preparation());
    const bodies::clumps& grains = test.sim().grains;
    const double volume = 8.0 * std::tan(std::numbers::pi / 8.0) * 0.033 * 0.033 * 0.075;
    const double smallest = s.grain.volume({1, 8e-3 / s.grain.parts()[1].form.diameter});
    CHECK(std::abs(grains.solid_volume() - 0.38 * volume) < 2.0 * smallest * 2.0); // twice two shapes
    CHECK(grains.shapes.size() == 2);
    CHECK(grains.grain_count() > 60);
    double largest = 0.0;
    for (std::size_t g = 0; g < grains.grain_count(); ++g) largest = std::max(largest, grains.bounding_radius(g));
    CHECK(largest > 0.01);
    CHECK(test.protocol().plan.grain_diameter == s.grain.d50());
    CHECK(s.grain.d50() < 0.016);
    // tiles of 4.9 mm would do for grains of 8 mm, of 1.4 mm not
    s.tiles_per_ring = 40;
    CHECK_NOTHROW(triaxial_test<rigid>(s, protocol::preparation()));
    s.tiles_per_ring = 150;
    CHECK_THROWS_AS(triaxial_test<rigid>(s, protocol::preparation()), input_error);
}

TEST_CASE("a packing of one's own starts at the size of the specimen, without a cloud, and is taken as it is") {
    triaxial_setup<rigid> s = good();
    triaxial_test<rigid> first(s, protocol::preparation());
    observer quiet;
    REQUIRE(first.run(quiet));
    const bodies::clumps& packed = first.sim().grains;
    std::vector<placed_grain> grains;
    for (std::size_t g = 0; g < packed.grain_count(); ++g)
        grains.push_back({{0, packed.grains[g].scale}, packed.centre(g), packed.turning[g].q});
    s.packing = protocol::packing(s.grain, grains);
    triaxial_test<rigid> again(s, protocol::preparation());
    const double larger = again.sim().boundary.height() / 0.075; // tiles may have moved out when they were seated
    CHECK((larger >= 1.0 && larger < 1.15));
    REQUIRE(again.sim().grains.grain_count() == packed.grain_count());
    CHECK(again.sim().grains.centre(7) == packed.centre(7));
    CHECK(again.sim().kinetic_energy() == 0.0);
    const std::int64_t before = first.sim().totals().steps;
    REQUIRE(again.run(quiet));
    CHECK(again.sim().totals().steps < before); // no way to go in `compact`
    CHECK(again.sim().grains.solid_volume() == packed.solid_volume());
    triaxial_setup<rigid> large = s; // as if the size of the specimen that it was made for had been forgotten
    large.diameter = 200_mm, large.height = 200_mm;
    CHECK_THROWS_WITH(triaxial_test<rigid>(large, protocol::preparation()),
                      Catch::Contains("packing: 'a porosity of 0.9") && Catch::Contains("0.2 to 0.9"));
    grains[3].centre.x = 1.0;
    s.packing = protocol::packing(s.grain, grains);
    CHECK_THROWS_AS(triaxial_test<rigid>(s, protocol::preparation()), input_error);
}

TEST_CASE("slender and flat grains pack as others do: their cloud takes the room that they need to turn") {
    const std::vector<shape_pebble> row = {{{-2, 0, 0}, 1}, {{0, 0, 0}, 1}, {{2, 0, 0}, 1}};
    std::vector<shape_pebble> disc = {{{}, 1.0}};
    for (int k = 0; k < 6; ++k) {
        const double angle = k * std::numbers::pi / 3.0;
        disc.push_back({{2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.0}, 1.0});
    }
    for (const auto& [name, pebbles] : {std::pair("row", row), std::pair("disc", disc)}) {
        INFO(name);
        setup_type s = good();
        s.grain = scaled_to(make_shape(name, pebbles), circumscribed(0.024));
        s.porosity = 0.58;
        s.confining = 2_MPa;
        triaxial_test<rigid> test(s, protocol::preparation());
        CHECK(test.sim().boundary.height() > 1.8 * 0.075);
        observer quiet;
        REQUIRE(test.run(quiet));
        const sample now = test.protocol().measure();
        CHECK(now.porosity == Approx(0.58).margin(0.02));
        CHECK(now.p < 1e3); // not squeezed: of 2 MPa to come
    }
}

TEST_CASE("a field of the setup acts in the test: grains of the cloud fall freely until they meet") {
    struct heavy : rigid {
        using field = fields::gravity;
    };
    triaxial_setup<heavy> s = good<heavy>();
    s.damping = 0.0, s.field.acceleration = {0.0, 0.0, -100.0};
    triaxial_test<heavy> test(s, {{.name = "fall", .end = until::steps(100)}});
    const bodies::clumps before = test.sim().grains;
    observer quiet;
    REQUIRE(test.run(quiet));
    std::size_t free = 0;
    for (std::size_t g = 0; g < before.grain_count(); ++g) {
        const vec3 expected = before.motion[g].v + test.sim().time() * s.field.acceleration;
        free += norm(test.sim().grains.motion[g].v - expected) < 1e-9 ? 1u : 0u;
    }
    CHECK(free > before.grain_count() / 2);
}

TEST_CASE("a law that Table 1 knows nothing of has no default, and a setup without it is refused by its member") {
    struct rocks : rigid {
        using contact = contacts::by_material<contacts::linear, 2>;
    };
    const triaxial_setup<rocks> s = good<rocks>();
    CHECK_THROWS_WITH(triaxial_test<rocks>(s, protocol::preparation()),
                      Catch::Contains("materials.membrane") && Catch::Contains("contacts"));
}
