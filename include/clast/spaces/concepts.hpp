// SPDX-License-Identifier: MIT
// What an engine asks of the space that its bodies are in.
#pragma once

#include <concepts>
#include <cstdint>

#include <clast/core/vector.hpp>

namespace clast::spaces {

/// A space says whether bodies have images, and how it deforms:
/// - `frame here()`: from which displacements count; `stretch_since(frame)`: edges over those of then;
/// - `rates()`: of extension along the axes (1/s), of a mean flow with the velocity rates * x;
/// - `flow_type flow()`: `relative(v, x, h)`, the velocity beside that flow (integrators/concepts.hpp);
/// - `travel(strain, reach)`: how much nearer (m, or m/s for a rate) a strain brings two grains a reach (m) apart;
/// - `room(widest)`: the widest margin (m) for which there is room between grains of this diameter (m);
/// - `across(x, image)`: where the image of a point is (m);
/// - `advance(dt)`: by one step.
/// What it does around a sweep (`gather`, `looks`, `begin_sweep`, `end_sweep`) takes a scene.
template <class S>
concept space = std::copyable<S> && std::default_initializable<typename S::crossings> &&
    requires(S& s, const S& c, typename S::frame since, vec3 strain, double length, std::uint8_t image) {
    { S::has_images } -> std::convertible_to<bool>;
    { c.here() } -> std::same_as<typename S::frame>;
    { c.stretch_since(since) } -> std::same_as<vec3>;
    { c.rates() } -> std::same_as<vec3>;
    { c.flow() } -> std::same_as<typename S::flow_type>;
    { c.flow().relative(strain, strain, length) } -> std::convertible_to<vec3>;
    { c.travel(strain, length) } -> std::same_as<double>;
    { c.room(length) } -> std::same_as<double>;
    { c.across(strain, image) } -> std::same_as<vec3>;
    { c.looks(std::int64_t{}, true, true) } -> std::same_as<bool>;
    s.advance(length);
};

} // namespace clast::spaces
