// SPDX-License-Identifier: MIT
// What the engine asks of a boundary: a lateral wall and two platens that confine a specimen.
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::boundaries {

/// Finds contacts: near (cheap, conservative), touch (present and `ahead` seconds later), outside (a lost pebble).
template <class B>
concept confines = requires(const B& b, vec3 x, double length, double time) {
    { b.near(x, length) } -> std::same_as<bool>;
    { b.touch(x, length) } -> std::same_as<touches>;
    { b.touch(x, length, time) } -> std::same_as<touches>;
    { b.outside(x, length) } -> std::same_as<bool>;
};

/// Consists of numbered facets: 0 and 1 are the platens. Stiffness in N/m, velocity inward in m/s, area in m^2.
template <class B>
concept has_facets = requires(const B& b, int facet) {
    { b.facet_count() } -> std::convertible_to<int>;
    { b.stiffness(facet) } -> std::convertible_to<double>;
    { b.velocity(facet) } -> std::convertible_to<double>;
    { b.area(facet) } -> std::convertible_to<double>;
};

/// Is driven: control sets velocities from loads, advance moves facets by one step, fastest is the largest speed (m/s).
template <class B>
concept driven = requires(B& b, const B& seen, std::span<const facet_load> loads, const drives& d, double dt,
                          std::span<const coupling> couplings) {
    b.control(loads, d, dt, couplings);
    b.advance(dt);
    { seen.fastest() } -> std::convertible_to<double>;
};

/// Knows the specimen's size: enclosed volume (m^3), height (m), mean section (m^2).
template <class B>
concept encloses = requires(const B& b) {
    { b.volume() } -> std::convertible_to<double>;
    { b.height() } -> std::convertible_to<double>;
    { b.section() } -> std::convertible_to<double>;
};

/// Measures stress (Pa, compression positive), the relative error of the confining stress, and power on the specimen
/// (W).
template <class B>
concept measures_stress = requires(const B& b, std::span<const facet_load> loads, double sigma) {
    { b.axial_stress(loads) } -> std::convertible_to<double>;
    { b.lateral_stress(loads) } -> std::convertible_to<double>;
    { b.confining_error(loads, sigma) } -> std::convertible_to<double>;
    { b.confining_rms(loads, sigma) } -> std::convertible_to<double>;
    { b.power(loads) } -> std::convertible_to<double>;
};

/// Can be drawn: visible facets as quadrilaterals.
template <class B>
concept can_be_drawn = requires(const B& b, std::span<const facet_load> loads) {
    { b.view(loads) } -> std::same_as<std::vector<facet_view>>;
};

namespace detail {
struct any_archive {
    template <class... Members> void operator()(Members&...) {}
};
} // namespace detail

/// Can be copied and saved: archive(a) passes the complete state to a.
template <class B>
concept saved = std::copyable<B> && requires(B& b, detail::any_archive& a) {
    b.archive(a);
};

/// A periodic cell around the origin: edge lengths (m) and their rates (m/s). Every `look` steps it is told the stress,
/// if it has a servo that follows it.
template <class B>
concept periodic = requires(B& b, const B& seen, vec3 stress, vec3 modulus, double dt) {
    { seen.edges() } -> std::convertible_to<vec3>;
    { seen.edge_speeds() } -> std::convertible_to<vec3>;
    { B::look } -> std::convertible_to<int>;
    { seen.has_servo() } -> std::same_as<bool>;
    b.observe(stress, modulus, dt);
};

/// A boundary as the engine uses it.
template <class B>
concept boundary =
    confines<B> && has_facets<B> && driven<B> && encloses<B> && measures_stress<B> && can_be_drawn<B> && saved<B>;

} // namespace clast::boundaries
