// SPDX-License-Identifier: MIT
// What a protocol asks of a boundary beyond what an engine does.
#pragma once

#include <concepts>
#include <span>
#include <type_traits>
#include <vector>

#include <clast/boundaries/concepts.hpp>
#include <clast/boundaries/vessel_settings.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/check_policies.hpp>
#include <clast/engine/policies.hpp>
#include <clast/measure/sample.hpp>

namespace clast::protocol {

/// Knows the specimen's size: enclosed volume (m^3), height (m), the lower platen's level (m), the radius (m), the area
/// of the specimen at each platen (m^2; 0 bottom, 1 top), whether a sphere has room inside, touching nothing, and
/// whether it has got out.
template <class B>
concept encloses = requires(const B& b, vec3 x, double length, int platen) {
    { b.volume() } -> std::convertible_to<double>;
    { b.height() } -> std::convertible_to<double>;
    { b.bottom() } -> std::convertible_to<double>;
    { b.radius() } -> std::convertible_to<double>;
    { b.end_section(platen) } -> std::convertible_to<double>;
    { b.holds(x, length) } -> std::same_as<bool>;
    { b.outside(x, length) } -> std::same_as<bool>;
};

/// Measures the lateral stress (Pa, compression positive) and its relative error. The axial one follows from the forces
/// on the platens and the areas of the ends (boundaries/axial.hpp).
template <class B>
concept measures_stress = requires(const B& b, std::span<const boundaries::facet_load> loads, double sigma) {
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

namespace policy_checks {

template <class B> struct vessel {
    using loads = std::span<const boundaries::facet_load>;
    using sizes = boundaries::vessel_settings;
    static constexpr int missing = first_missing(
        protocol::vessel<B>, requires(const sizes& s) { B::made(s); },
        requires(const B& b, const sizes& s) { b.resized(s); }, requires(const B& b) { b.radius(); },
        requires(const B& b) { b.bottom(); }, requires(const B& b) { b.height(); },
        requires(const B& b) { b.volume(); }, requires(const B& b, vec3 x) { b.holds(x, 1.0); },
        requires(const B& b, vec3 x) { b.outside(x, 1.0); }, requires(const B& b) { b.end_section(0); },
        requires(const B& b, loads l) { b.lateral_stress(l); },
        requires(const B& b, loads l) { b.confining_error(l, 1.0); }, requires(const B& b, loads l) { b.view(l); });
    static_assert(missing != 1, "policy boundary of the bundle is no vessel of a test, it lacks `static B "
                                "made(vessel_settings)` (clast/protocol/vessel.hpp)");
    static_assert(missing != 2, "policy boundary of the bundle is no vessel of a test, it lacks "
                                "`resized(vessel_settings) const` (clast/protocol/vessel.hpp)");
    static_assert(missing != 3, "policy boundary of the bundle is no vessel of a test, it lacks `radius() const` "
                                "(clast/protocol/vessel.hpp)");
    static_assert(missing != 4, "policy boundary of the bundle is no vessel of a test, it lacks `bottom() const` "
                                "(clast/protocol/vessel.hpp)");
    static_assert(missing != 5, "policy boundary of the bundle is no vessel of a test, it lacks `height() const` "
                                "(clast/protocol/vessel.hpp)");
    static_assert(missing != 6, "policy boundary of the bundle is no vessel of a test, it lacks `volume() const` "
                                "(clast/protocol/vessel.hpp)");
    static_assert(missing != 7, "policy boundary of the bundle is no vessel of a test, it lacks `holds(x, radius) "
                                "const` (clast/protocol/vessel.hpp)");
    static_assert(missing != 8, "policy boundary of the bundle is no vessel of a test, it lacks `outside(x, radius) "
                                "const` (clast/protocol/vessel.hpp)");
    static_assert(missing != 9, "policy boundary of the bundle is no vessel of a test, it lacks "
                                "`end_section(platen) const` (clast/protocol/vessel.hpp)");
    static_assert(missing != 10, "policy boundary of the bundle is no vessel of a test, it lacks "
                                 "`lateral_stress(loads) const` (clast/protocol/vessel.hpp)");
    static_assert(missing != 11, "policy boundary of the bundle is no vessel of a test, it lacks "
                                 "`confining_error(loads, sigma) const` (clast/protocol/vessel.hpp)");
    static_assert(missing != 12, "policy boundary of the bundle is no vessel of a test, it lacks `view(loads) const` "
                                 "(clast/protocol/vessel.hpp)");
    static_assert(missing != 13, "policy boundary of the bundle is no vessel of a test, it answers with other types "
                                 "(clast/protocol/vessel.hpp)");
};

template <class S> struct specimen {
    static constexpr int missing = first_missing(
        bodies::specimen<S>, std::default_initializable<S>, requires(S& s) { s.density = 1.0; },
        requires(S& s, const shape& grain) { s.kind_of(grain); },
        requires(S& s, const shape& grain) { s.add(s.kind_of(grain), vec3{}, quaternion{}, 1.0); },
        requires(S& s) { s.set_material(std::size_t{}, std::uint8_t{}, 1.0); },
        requires(const S& c) { c.grain_count(); }, requires(const S& c) { c.solid_volume(); });
    static_assert(missing != 1, "policy body of the bundle is no specimen of a test, it lacks a default constructor "
                                "(clast/bodies/concepts.hpp)");
    static_assert(missing != 2, "policy body of the bundle is no specimen of a test, it lacks `density` "
                                "(clast/bodies/concepts.hpp)");
    static_assert(missing != 3, "policy body of the bundle is no specimen of a test, it lacks `kind_of(shape)` "
                                "(clast/bodies/concepts.hpp)");
    static_assert(missing != 4, "policy body of the bundle is no specimen of a test, it lacks `add(kind, centre, "
                                "orientation, scale)` (clast/bodies/concepts.hpp)");
    static_assert(missing != 5, "policy body of the bundle is no specimen of a test, it lacks `set_material(body, "
                                "material, density_ratio)` (clast/bodies/concepts.hpp)");
    static_assert(missing != 6, "policy body of the bundle is no specimen of a test, it lacks `grain_count() const` "
                                "(clast/bodies/concepts.hpp)");
    static_assert(missing != 7, "policy body of the bundle is no specimen of a test, it lacks `solid_volume() const` "
                                "(clast/bodies/concepts.hpp)");
    static_assert(missing != 8, "policy body of the bundle is no specimen of a test, it answers with other types "
                                "(clast/bodies/concepts.hpp)");
};

/// What a test asks beyond an engine.
template <class P> struct first_wrong_of_test : first_wrong_of<P> {};
template <simulator_policies P>
struct first_wrong_of_test<P> : first_wrong<check<protocol::vessel<typename P::boundary>, vessel<typename P::boundary>>,
                                            check<bodies::specimen<typename P::body>, specimen<typename P::body>>> {};

/// A bundle that simulates, with the default in place of what is no vessel or no specimen.
template <class P> struct repaired_for_test : P {
    using standard = triaxial_policies_default;
    using boundary =
        std::conditional_t<protocol::vessel<typename P::boundary>, typename P::boundary, standard::boundary>;
    using body = std::conditional_t<bodies::specimen<typename P::body>, typename P::body, standard::body>;
};

} // namespace policy_checks

/// Compiles for a bundle that a triaxial test can be made of (triaxial_policies); else its first error names the family
/// and what is missing.
template <class P> using check_test_policies = typename policy_checks::first_wrong_of_test<P>::type;

/// A bundle to go on with where one does not fit.
template <class P>
using repaired_test_policies =
    policy_checks::repaired_for_test<std::conditional_t<simulator_policies<P>, P, repaired_policies<P>>>;

} // namespace clast
