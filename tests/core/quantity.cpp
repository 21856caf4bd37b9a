// SPDX-License-Identifier: MIT
#include <clast/core/quantity.hpp>

#include <string>

#include <catch.hpp>

using namespace clast;
using namespace clast::literals;

namespace {

template <class Q> std::string message_of(const char* text) {
    try {
        (void)parse<Q>(text, "--option");
    } catch (const input_error& e) {
        return e.what();
    }
    return "no error";
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

template <class A, class B>
concept addable = requires(A a, B b) {
    a + b;
};

} // namespace

TEST_CASE("literals and unit constants give SI values") {
    STATIC_REQUIRE((2.0_MPa).si() == 2.0e6);
    STATIC_REQUIRE((2_MPa).si() == 2.0e6);
    STATIC_REQUIRE((20_mm).si() == 0.02);
    STATIC_REQUIRE((30_cm).si() == 0.3);
    STATIC_REQUIRE((9.6e8_N_per_m).si() == 9.6e8);
    STATIC_REQUIRE((5_ms).si() == 5 * 1e-3);
    STATIC_REQUIRE((25 * percent).si() == 0.25);
    REQUIRE((46.8_GPa).in(units::GPa) == Approx(46.8).epsilon(1e-15));
    REQUIRE((180_deg).si() == Approx(3.14159265358979323846).epsilon(1e-15));
}

TEST_CASE("dimensions follow the arithmetic of the quantities") {
    constexpr auto force = 2.0_MPa * (3.0_m * 4.0_m);
    STATIC_REQUIRE(std::is_same_v<decltype(force), const quantities::force>);
    STATIC_REQUIRE(force.si() == 24e6);
    STATIC_REQUIRE(std::is_same_v<decltype(force / 2.0_m), quantities::stiffness>);
    STATIC_REQUIRE(std::is_same_v<decltype(1.0_MPa / 2.0_m), quantities::stiffness_per_area>);
    STATIC_REQUIRE(std::is_same_v<decltype(1.0 / 2.0_s), quantities::rate>);
    STATIC_REQUIRE(std::is_same_v<decltype(1.0_kg / (1.0_m * 1.0_m * 1.0_m)), quantities::density>);
    STATIC_REQUIRE(std::is_same_v<decltype(1.0_kg * 1.0_m_per_s2), quantities::force>);
    STATIC_REQUIRE((1_MPa + 500_kPa) == 1.5_MPa);
    STATIC_REQUIRE((1_MPa - 500_kPa) < 1_MPa);
    STATIC_REQUIRE(-(1_MPa) == -1.0 * 1_MPa);
}

TEST_CASE("pascals do not add to metres and a bare number is no quantity") {
    STATIC_REQUIRE(addable<quantities::stress, quantities::stress>);
    STATIC_REQUIRE(!addable<quantities::stress, quantities::length>);
    STATIC_REQUIRE(!addable<quantities::stress, double>);
    STATIC_REQUIRE(!std::is_convertible_v<double, quantities::length>);
    STATIC_REQUIRE(!std::is_default_constructible_v<quantities::length>);
}

TEST_CASE("a typed quantity is read with its unit") {
    for (const char* text : {"2MPa", "2 MPa", " 2.0e6 Pa ", "+2000kPa", "0.002GPa", "2e0MPa"})
        REQUIRE(parse<quantities::stress>(text, "--confining").si() == Approx(2e6).epsilon(1e-15));
    REQUIRE(parse<quantities::length>("20 mm", "--size").si() == Approx(0.02).epsilon(1e-15));
    REQUIRE(parse<quantities::duration>("5min", "--save-every").si() == 300.0);
    REQUIRE(parse<quantities::stiffness>("9.6e8 N/m", "--bond-stiffness").si() == 9.6e8);
    REQUIRE(parse<quantities::stiffness_per_area>("9.6e8 Pa/m", "--bond-stiffness").si() == 9.6e8);
    REQUIRE(parse<quantities::ratio>("25%", "--strain").si() == 0.25);
    REQUIRE(parse<quantities::ratio>("0.25", "--strain").si() == 0.25);
    REQUIRE(parse<quantities::ratio>("-0.25", "--strain").si() == -0.25);
    REQUIRE(parse<dimension{1, -1, -2}>("-2MPa", "--confining").si() == -2e6);
}

TEST_CASE("a stress without unit is refused with the units and an example") {
    const std::string message = message_of<quantities::stress>("2e6");
    REQUIRE(has(message, "--option"));
    REQUIRE(has(message, "'2e6'"));
    REQUIRE(has(message, "MPa, kPa, Pa, GPa"));
    REQUIRE(has(message, "unit is missing"));
    REQUIRE(has(message, "for example"));
}

TEST_CASE("an unknown unit is refused with the list of units") {
    const std::string message = message_of<quantities::stress>("2 bar");
    REQUIRE(has(message, "'bar' is not a unit"));
    REQUIRE(has(message, "MPa, kPa, Pa, GPa"));
    REQUIRE(has(message_of<quantities::stress>("2 mm"), "'mm' is not a unit"));
    REQUIRE(has(message_of<quantities::stress>("2 mpa"), "'mpa' is not a unit"));
    REQUIRE(has(message_of<quantities::ratio>("25 MPa"), "a number, or a number with one of the units %"));
}

TEST_CASE("what is no finite decimal number is refused") {
    for (const char* text :
         {"", " ", "MPa", "nan MPa", "inf", "1e999 Pa", "+-2MPa", "0x10 Pa", "2,5 MPa", "--", "2 MPa x"})
        REQUIRE(message_of<quantities::stress>(text) != "no error");
}
