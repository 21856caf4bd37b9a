// SPDX-License-Identifier: MIT
// What a protocol asks of a boundary beyond what an engine does.
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include <clast/boundaries/concepts.hpp>
#include <clast/boundaries/vessel_settings.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/policies.hpp>
#include <clast/measure/sample.hpp>

namespace clast::protocol {

/// Knows the specimen's size: enclosed volume (m^3), height (m), the lower platen's level (m), the radius (m), whether
/// a sphere has room inside, touching nothing, and whether it has got out.
template <class B>
concept encloses = requires(const B& b, vec3 x, double length) {
    { b.volume() } -> std::convertible_to<double>;
    { b.height() } -> std::convertible_to<double>;
    { b.bottom() } -> std::convertible_to<double>;
    { b.radius() } -> std::convertible_to<double>;
    { b.holds(x, length) } -> std::same_as<bool>;
    { b.outside(x, length) } -> std::same_as<bool>;
};

/// Measures stress (Pa, compression positive) and the relative error of the confining stress.
template <class B>
concept measures_stress = requires(const B& b, std::span<const boundaries::facet_load> loads, double sigma) {
    { b.axial_stress(loads) } -> std::convertible_to<double>;
    { b.lateral_stress(loads) } -> std::convertible_to<double>;
    { b.confining_error(loads, sigma) } -> std::convertible_to<double>;
};

/// Can be drawn: visible facets as quadrilaterals.
template <class B>
concept can_be_drawn = requires(const B& b, std::span<const boundaries::facet_load> loads) {
    { b.view(loads) } -> std::same_as<std::vector<facet_view>>;
};

/// Can be made from plain sizes, and made anew in the same place: the vessel of the cloud, and the membrane that takes
/// its place. `made` throws input_error for settings that make no sense, by the names of triaxial_setup.
template <class B>
concept can_be_made = requires(const B& b, const boundaries::vessel_settings& s) {
    { B::made(s) } -> std::same_as<B>;
    { b.resized(s) } -> std::same_as<B>;
};

/// A boundary that a triaxial test can be made in: all that triaxial_test and runner ask, and nothing else.
template <class B>
concept vessel = boundaries::surface<B> && encloses<B> && measures_stress<B> && can_be_drawn<B> && can_be_made<B>;

} // namespace clast::protocol

namespace clast {

/// A bundle that a triaxial test can be made of: what an engine asks, a vessel, and bodies that can be made of a shape.
template <class P>
concept triaxial_policies =
    simulator_policies<P> && protocol::vessel<typename P::boundary> && bodies::specimen<typename P::body>;

} // namespace clast
