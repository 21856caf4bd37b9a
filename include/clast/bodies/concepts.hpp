// SPDX-License-Identifier: MIT
// What an engine asks of the bodies that it sweeps, and what it hands them.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <clast/bodies/contact_list.hpp>
#include <clast/core/vector.hpp>
#include <clast/grains/shape.hpp>
#include <clast/integrators/concepts.hpp>
#include <clast/integrators/leapfrog.hpp>

namespace clast {

/// Energy that a body has lost so far (J).
struct body_losses {
    double friction = 0.0;
    double damping = 0.0;
};

/// A body that is about to move, and what acts on it.
struct moving_body {
    std::size_t body = 0;
    load_sum load;
};

/// How far bodies have gone of the way for which contact lists allow.
enum class margin_use { within, used_up, not_finite };
/// The same for a way (m) and its margin (m), or for the squares of both.
inline margin_use use_of(double way, double margin) {
    if (way < margin) return margin_use::within;
    return std::isfinite(way) ? margin_use::used_up : margin_use::not_finite;
}
/// Ways of bodies count from `since`, in a space that has been stretched in between, and may be as long as `margins`
/// (m).
template <class Reference> struct allowance {
    std::span<const Reference> since; ///< per body
    std::span<const double> margins;  ///< per body
    vec3 stretch;
};

/// Items of every body, side by side: those of body b are items[start[b]] to items[start[b + 1] - 1].
struct body_items {
    std::vector<std::uint32_t> start;
    std::vector<std::int32_t> items;

    std::span<const std::int32_t> of(std::size_t body) const {
        return {items.data() + start[body], items.data() + start[body + 1]};
    }
    /// Makes room for a number of items, and one to spare.
    void resize(std::size_t bodies, std::size_t count) {
        start.assign(bodies + 1, 0);
        items.resize(count + 1);
    }
    template <class A> void archive(A& a) { a(start, items); }
};

namespace bodies {

/// What an engine sweeps: bodies::clumps (which may break) or bodies::spheres.
template <class S>
concept swept = std::movable<S> && requires(S& s, const S& c, std::size_t b, vec3 x, const body_items& wanted) {
    { S::turns } -> std::convertible_to<bool>;
    { c.body_count() } -> std::same_as<std::size_t>;
    { c.movable_count() } -> std::same_as<std::size_t>;
    { c.is_swept(b) } -> std::same_as<bool>;
    { c.body_of(std::int32_t{}) } -> std::same_as<std::size_t>;
    { c.group_of(std::int32_t{}) } -> std::same_as<std::size_t>;
    { c.velocity_of(std::int32_t{}) } -> std::convertible_to<vec3>;
    { c.spin_of_pebble(std::int32_t{}) } -> std::convertible_to<vec3>;
    { c.inverse_mass_of(std::int32_t{}) } -> std::same_as<double>;
    c.view();
    { c.centre(b) } -> std::convertible_to<vec3>;
    { c.velocity(b) } -> std::convertible_to<vec3>;
    { c.bounding_radius(b) } -> std::same_as<double>;
    { c.pebbles_of(b) } -> std::same_as<index_range>;
    { c.body_mass(b) } -> std::same_as<double>;
    { c.body_inertia(b) } -> std::same_as<vec3>;
    { c.body_axes(b) } -> std::same_as<mat3>;
    { c.kinetic_energy(b) } -> std::same_as<double>;
    { c.refer(b) } -> std::same_as<typename S::reference>;
    { c.moved(b, c.refer(b), x) } -> std::same_as<double>;
    { c.surface_speed(b, x) } -> std::same_as<double>;
    {
        s.advance(std::span<const moving_body>{}, integrators::rule<integrators::leapfrog>{}, wanted,
                  allowance<typename S::reference>{}, [](std::size_t) { return 0.0; })
        } -> std::same_as<margin_use>;
    s.place(b);
    s.place(b, std::span<const std::int32_t>{});
    s.shift(b, x, x);
    { c.smallest_mass() } -> std::same_as<double>;
    { c.pebble_count() } -> std::same_as<std::size_t>;
    { c.pebbles[b].x } -> std::convertible_to<vec3>;
    { c.pebbles[b].radius } -> std::convertible_to<double>;
    c.losses;
};

/// What a test asks of them beyond: it starts from an empty table and a density, adds grains of shapes, each of `scale`
/// times the size of its shape and of some material (a number, and its density over that of the specimen), counts them
/// and their volume. kind_of(shape) is what add() takes for it; it throws input_error where bodies cannot be of it.
/// add() answers with the number of the body. ball_mass() is the mass of a pebble as a solid ball (kg).
template <class S>
concept specimen = swept<S> && std::default_initializable<S> &&
    requires(S& s, const S& c, const shape& grain, vec3 x, quaternion q, std::size_t b) {
    s.density = 1.0;
    { s.add(s.kind_of(grain), x, q, 1.0) } -> std::convertible_to<std::int32_t>;
    s.set_material(std::size_t{}, std::uint8_t{}, 1.0);
    { c.grain_count() } -> std::same_as<std::size_t>;
    { c.ball_mass(b) } -> std::same_as<double>;
    { c.solid_volume() } -> std::same_as<double>;
};
} // namespace bodies
} // namespace clast
