// SPDX-License-Identifier: MIT
// Strong SI quantities for everything a user types: `2.0_MPa`, `20_mm`, `25 * percent`, `parse<...>("2 MPa", ...)`.
// Inside kernels the library computes with plain SI doubles; a quantity hands its value over with `.si()`.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include <clast/core/errors.hpp>

namespace clast {

/// Physical dimension mass^mass * length^length * time^time (kg, m, s).
struct dimension {
    int mass = 0;
    int length = 0;
    int time = 0;

    constexpr bool operator==(const dimension&) const = default;
};

constexpr dimension operator*(dimension a, dimension b) {
    return {a.mass + b.mass, a.length + b.length, a.time + b.time};
}
constexpr dimension operator/(dimension a, dimension b) {
    return {a.mass - b.mass, a.length - b.length, a.time - b.time};
}

/// A number with a dimension, stored in SI units: the size and speed of a double, but metres do not add to seconds.
/// There is no default constructor, so that a forgotten member of an option struct does not compile.
template <dimension D> class quantity {
  public:
    quantity() = delete;
    /// The value in the coherent SI unit of the dimension (m, Pa, N/m, ...).
    constexpr explicit quantity(double value_in_si) : value_(value_in_si) {}

    /// The value in the coherent SI unit of the dimension.
    [[nodiscard]] constexpr double si() const { return value_; }
    /// The value counted in `unit`, e.g. `pressure.in(units::MPa)`.
    [[nodiscard]] constexpr double in(quantity unit) const { return value_ / unit.value_; }

    constexpr quantity operator-() const { return quantity(-value_); }
    constexpr quantity& operator+=(quantity b) { return value_ += b.value_, *this; }
    constexpr quantity& operator-=(quantity b) { return value_ -= b.value_, *this; }
    constexpr quantity& operator*=(double s) { return value_ *= s, *this; }
    constexpr quantity& operator/=(double s) { return value_ /= s, *this; }
    constexpr auto operator<=>(const quantity&) const = default;

    friend constexpr quantity operator+(quantity a, quantity b) { return quantity(a.value_ + b.value_); }
    friend constexpr quantity operator-(quantity a, quantity b) { return quantity(a.value_ - b.value_); }
    friend constexpr quantity operator*(double s, quantity a) { return quantity(s * a.value_); }
    friend constexpr quantity operator*(quantity a, double s) { return quantity(s * a.value_); }
    friend constexpr quantity operator/(quantity a, double s) { return quantity(a.value_ / s); }

  private:
    double value_;
};

template <dimension A, dimension B> constexpr quantity<A * B> operator*(quantity<A> a, quantity<B> b) {
    return quantity<A * B>(a.si() * b.si());
}
template <dimension A, dimension B> constexpr quantity<A / B> operator/(quantity<A> a, quantity<B> b) {
    return quantity<A / B>(a.si() / b.si());
}
template <dimension A> constexpr quantity<dimension{} / A> operator/(double a, quantity<A> b) {
    return quantity<dimension{} / A>(a / b.si());
}

/// The quantities by name; their SI units are in brackets.
namespace quantities {
using ratio = quantity<dimension{0, 0, 0}>;                ///< strain, friction, angle in radians [1]
using mass = quantity<dimension{1, 0, 0}>;                 ///< [kg]
using length = quantity<dimension{0, 1, 0}>;               ///< [m]
using area = quantity<dimension{0, 2, 0}>;                 ///< [m^2]
using volume = quantity<dimension{0, 3, 0}>;               ///< [m^3]
using duration = quantity<dimension{0, 0, 1}>;             ///< [s]
using rate = quantity<dimension{0, 0, -1}>;                ///< [1/s]
using velocity = quantity<dimension{0, 1, -1}>;            ///< [m/s]
using acceleration = quantity<dimension{0, 1, -2}>;        ///< [m/s^2]
using density = quantity<dimension{1, -3, 0}>;             ///< [kg/m^3]
using force = quantity<dimension{1, 1, -2}>;               ///< [N]
using energy = quantity<dimension{1, 2, -2}>;              ///< also moments [J = N m]
using stress = quantity<dimension{1, -1, -2}>;             ///< also moduli [Pa]
using stiffness = quantity<dimension{1, 0, -2}>;           ///< force per displacement [N/m]
using stiffness_per_area = quantity<dimension{1, -2, -2}>; ///< stress per displacement [Pa/m]
} // namespace quantities

/// Unit constants: `25 * units::percent`, `2 * units::MPa`.
namespace units {
inline constexpr quantities::ratio one{1.0};
inline constexpr quantities::ratio percent{1e-2};
inline constexpr quantities::ratio degree{0.017453292519943295};
inline constexpr quantities::mass kg{1.0}, g{1e-3}, t{1e3};
inline constexpr quantities::length m{1.0}, cm{1e-2}, mm{1e-3}, um{1e-6};
inline constexpr quantities::duration s{1.0}, ms{1e-3}, us{1e-6}, min{60.0}, h{3600.0};
inline constexpr quantities::rate per_s{1.0};
inline constexpr quantities::velocity m_per_s{1.0}, mm_per_s{1e-3};
inline constexpr quantities::acceleration m_per_s2{1.0};
inline constexpr quantities::density kg_per_m3{1.0}, g_per_cm3{1e3};
inline constexpr quantities::force N{1.0}, kN{1e3}, MN{1e6};
inline constexpr quantities::energy J{1.0}, mJ{1e-3};
inline constexpr quantities::stress Pa{1.0}, kPa{1e3}, MPa{1e6}, GPa{1e9};
inline constexpr quantities::stiffness N_per_m{1.0}, kN_per_m{1e3}, MN_per_m{1e6};
inline constexpr quantities::stiffness_per_area Pa_per_m{1.0}, MPa_per_m{1e6}, GPa_per_m{1e9};
} // namespace units

using units::percent;

/// User-defined literals: `using namespace clast::literals; auto p = 2.0_MPa;`
namespace literals {
// clang-format off
constexpr auto operator""_percent(long double v) { return static_cast<double>(v) * units::percent; }
constexpr auto operator""_percent(unsigned long long v) { return static_cast<double>(v) * units::percent; }
constexpr auto operator""_deg(long double v) { return static_cast<double>(v) * units::degree; }
constexpr auto operator""_deg(unsigned long long v) { return static_cast<double>(v) * units::degree; }
constexpr auto operator""_kg(long double v) { return static_cast<double>(v) * units::kg; }
constexpr auto operator""_kg(unsigned long long v) { return static_cast<double>(v) * units::kg; }
constexpr auto operator""_g(long double v) { return static_cast<double>(v) * units::g; }
constexpr auto operator""_g(unsigned long long v) { return static_cast<double>(v) * units::g; }
constexpr auto operator""_m(long double v) { return static_cast<double>(v) * units::m; }
constexpr auto operator""_m(unsigned long long v) { return static_cast<double>(v) * units::m; }
constexpr auto operator""_cm(long double v) { return static_cast<double>(v) * units::cm; }
constexpr auto operator""_cm(unsigned long long v) { return static_cast<double>(v) * units::cm; }
constexpr auto operator""_mm(long double v) { return static_cast<double>(v) * units::mm; }
constexpr auto operator""_mm(unsigned long long v) { return static_cast<double>(v) * units::mm; }
constexpr auto operator""_um(long double v) { return static_cast<double>(v) * units::um; }
constexpr auto operator""_um(unsigned long long v) { return static_cast<double>(v) * units::um; }
constexpr auto operator""_s(long double v) { return static_cast<double>(v) * units::s; }
constexpr auto operator""_s(unsigned long long v) { return static_cast<double>(v) * units::s; }
constexpr auto operator""_ms(long double v) { return static_cast<double>(v) * units::ms; }
constexpr auto operator""_ms(unsigned long long v) { return static_cast<double>(v) * units::ms; }
constexpr auto operator""_us(long double v) { return static_cast<double>(v) * units::us; }
constexpr auto operator""_us(unsigned long long v) { return static_cast<double>(v) * units::us; }
constexpr auto operator""_min(long double v) { return static_cast<double>(v) * units::min; }
constexpr auto operator""_min(unsigned long long v) { return static_cast<double>(v) * units::min; }
constexpr auto operator""_per_s(long double v) { return static_cast<double>(v) * units::per_s; }
constexpr auto operator""_per_s(unsigned long long v) { return static_cast<double>(v) * units::per_s; }
constexpr auto operator""_m_per_s(long double v) { return static_cast<double>(v) * units::m_per_s; }
constexpr auto operator""_m_per_s(unsigned long long v) { return static_cast<double>(v) * units::m_per_s; }
constexpr auto operator""_mm_per_s(long double v) { return static_cast<double>(v) * units::mm_per_s; }
constexpr auto operator""_mm_per_s(unsigned long long v) { return static_cast<double>(v) * units::mm_per_s; }
constexpr auto operator""_m_per_s2(long double v) { return static_cast<double>(v) * units::m_per_s2; }
constexpr auto operator""_m_per_s2(unsigned long long v) { return static_cast<double>(v) * units::m_per_s2; }
constexpr auto operator""_kg_per_m3(long double v) { return static_cast<double>(v) * units::kg_per_m3; }
constexpr auto operator""_kg_per_m3(unsigned long long v) { return static_cast<double>(v) * units::kg_per_m3; }
constexpr auto operator""_N(long double v) { return static_cast<double>(v) * units::N; }
constexpr auto operator""_N(unsigned long long v) { return static_cast<double>(v) * units::N; }
constexpr auto operator""_kN(long double v) { return static_cast<double>(v) * units::kN; }
constexpr auto operator""_kN(unsigned long long v) { return static_cast<double>(v) * units::kN; }
constexpr auto operator""_J(long double v) { return static_cast<double>(v) * units::J; }
constexpr auto operator""_J(unsigned long long v) { return static_cast<double>(v) * units::J; }
constexpr auto operator""_Pa(long double v) { return static_cast<double>(v) * units::Pa; }
constexpr auto operator""_Pa(unsigned long long v) { return static_cast<double>(v) * units::Pa; }
constexpr auto operator""_kPa(long double v) { return static_cast<double>(v) * units::kPa; }
constexpr auto operator""_kPa(unsigned long long v) { return static_cast<double>(v) * units::kPa; }
constexpr auto operator""_MPa(long double v) { return static_cast<double>(v) * units::MPa; }
constexpr auto operator""_MPa(unsigned long long v) { return static_cast<double>(v) * units::MPa; }
constexpr auto operator""_GPa(long double v) { return static_cast<double>(v) * units::GPa; }
constexpr auto operator""_GPa(unsigned long long v) { return static_cast<double>(v) * units::GPa; }
constexpr auto operator""_N_per_m(long double v) { return static_cast<double>(v) * units::N_per_m; }
constexpr auto operator""_N_per_m(unsigned long long v) { return static_cast<double>(v) * units::N_per_m; }
constexpr auto operator""_MN_per_m(long double v) { return static_cast<double>(v) * units::MN_per_m; }
constexpr auto operator""_MN_per_m(unsigned long long v) { return static_cast<double>(v) * units::MN_per_m; }
constexpr auto operator""_Pa_per_m(long double v) { return static_cast<double>(v) * units::Pa_per_m; }
constexpr auto operator""_Pa_per_m(unsigned long long v) { return static_cast<double>(v) * units::Pa_per_m; }
// clang-format on
} // namespace literals

/// A unit that `parse` understands: its spelling, dimension and size in SI.
struct named_unit {
    std::string_view name;
    clast::dimension dimension;
    double factor;
};

/// Every unit that can be typed; the first of a dimension is used in examples.
inline constexpr auto known_units = std::to_array<named_unit>({
    {"%", {0, 0, 0}, 1e-2},     {"percent", {0, 0, 0}, 1e-2}, {"deg", {0, 0, 0}, units::degree.si()},
    {"rad", {0, 0, 0}, 1.0},    {"kg", {1, 0, 0}, 1.0},       {"g", {1, 0, 0}, 1e-3},
    {"t", {1, 0, 0}, 1e3},      {"mm", {0, 1, 0}, 1e-3},      {"cm", {0, 1, 0}, 1e-2},
    {"m", {0, 1, 0}, 1.0},      {"um", {0, 1, 0}, 1e-6},      {"m2", {0, 2, 0}, 1.0},
    {"cm2", {0, 2, 0}, 1e-4},   {"mm2", {0, 2, 0}, 1e-6},     {"m3", {0, 3, 0}, 1.0},
    {"cm3", {0, 3, 0}, 1e-6},   {"s", {0, 0, 1}, 1.0},        {"ms", {0, 0, 1}, 1e-3},
    {"us", {0, 0, 1}, 1e-6},    {"min", {0, 0, 1}, 60.0},     {"h", {0, 0, 1}, 3600.0},
    {"1/s", {0, 0, -1}, 1.0},   {"m/s", {0, 1, -1}, 1.0},     {"mm/s", {0, 1, -1}, 1e-3},
    {"m/s2", {0, 1, -2}, 1.0},  {"kg/m3", {1, -3, 0}, 1.0},   {"g/cm3", {1, -3, 0}, 1e3},
    {"kN", {1, 1, -2}, 1e3},    {"N", {1, 1, -2}, 1.0},       {"MN", {1, 1, -2}, 1e6},
    {"J", {1, 2, -2}, 1.0},     {"mJ", {1, 2, -2}, 1e-3},     {"MPa", {1, -1, -2}, 1e6},
    {"kPa", {1, -1, -2}, 1e3},  {"Pa", {1, -1, -2}, 1.0},     {"GPa", {1, -1, -2}, 1e9},
    {"N/m", {1, 0, -2}, 1.0},   {"kN/m", {1, 0, -2}, 1e3},    {"MN/m", {1, 0, -2}, 1e6},
    {"Pa/m", {1, -2, -2}, 1.0}, {"MPa/m", {1, -2, -2}, 1e6},  {"GPa/m", {1, -2, -2}, 1e9},
});

/// The spellings of all units of a dimension, e.g. "MPa, kPa, Pa, GPa".
inline std::string unit_list(dimension d) {
    std::string list;
    for (const named_unit& u : known_units)
        if (u.dimension == d) list += (list.empty() ? "" : ", ") + std::string(u.name);
    return list;
}

namespace detail {

constexpr std::string_view trim(std::string_view text) {
    constexpr std::string_view blank = " \t\r\n";
    const auto first = text.find_first_not_of(blank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

struct number_and_unit {
    double number = 0.0;
    std::string_view unit; ///< empty for a bare number
};

/// Splits "2.0e6 Pa" into 2.0e6 and "Pa"; nothing where the text does not start with a finite decimal number.
inline std::optional<number_and_unit> split_number(std::string_view text) {
    text = trim(text);
    if (text.starts_with("+-")) return std::nullopt;
    if (text.starts_with('+')) text.remove_prefix(1); // from_chars does not take it
    number_and_unit result;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result.number);
    if (error != std::errc{} || !std::isfinite(result.number)) return std::nullopt;
    result.unit = trim(std::string_view(end, static_cast<std::size_t>(text.data() + text.size() - end)));
    return result;
}

inline const named_unit* find_unit(dimension d, std::string_view name) {
    for (const named_unit& u : known_units)
        if (u.dimension == d && u.name == name) return &u;
    return nullptr;
}

} // namespace detail

/// Reads "2MPa", "2 MPa", "2.0e6 Pa", "25%", "0.25" (bare numbers only where the quantity has no dimension) into SI.
/// `option` names what is being read in the message. Throws input_error for anything else.
template <dimension D> quantity<D> parse(std::string_view text, const std::string& option) {
    constexpr bool dimensionless = D == dimension{};
    const std::string allowed = dimensionless ? "a number, or a number with one of the units " + unit_list(D)
                                              : "a number with one of the units " + unit_list(D);
    std::string_view first_unit;
    for (const named_unit& u : known_units)
        if (first_unit.empty() && u.dimension == D) first_unit = u.name;
    const std::string example = fmt::format("Write for example '2{}'.", first_unit);

    const auto parts = detail::split_number(text);
    if (!parts) throw input_error(option, std::string(text), allowed, example);
    if (parts->unit.empty()) {
        if (!dimensionless)
            throw input_error(option, std::string(text), allowed,
                              "The unit is missing: nobody should have to guess it. " + example);
        return quantity<D>(parts->number);
    }
    const named_unit* unit = detail::find_unit(D, parts->unit);
    if (!unit)
        throw input_error(option, std::string(text), allowed,
                          fmt::format("'{}' is not a unit of this quantity. {}", parts->unit, example));
    return quantity<D>(parts->number * unit->factor);
}

/// The same for a named quantity: `parse<quantities::stress>("2 MPa", "--confining")`.
template <class Quantity> Quantity parse(std::string_view text, const std::string& option) {
    return [&]<dimension D>(std::type_identity<quantity<D>>) {
        return parse<D>(text, option);
    }(std::type_identity<Quantity>{});
}

static_assert(sizeof(quantities::stress) == sizeof(double));
static_assert(std::is_trivially_copyable_v<quantities::stress>);
static_assert(!std::is_default_constructible_v<quantities::stress>);
static_assert(!std::is_convertible_v<double, quantities::stress>);

} // namespace clast
