// SPDX-License-Identifier: MIT
// What an engine asks of a boundary: a lateral wall and two platens that confine a specimen, or less.
#pragma once

#include <concepts>
#include <span>

#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>

namespace clast::boundaries {

/// Finds contacts: near (cheap, conservative) and touch (present and `ahead` seconds later).
template <class B>
concept confines = requires(const B& b, vec3 x, double length, double time) {
    { b.near(x, length) } -> std::same_as<bool>;
    { b.touch(x, length) } -> std::same_as<touches>;
    { b.touch(x, length, time) } -> std::same_as<touches>;
};

/// Consists of numbered facets: 0 and 1 are the platens. Velocity inward in m/s.
template <class B>
concept has_facets = requires(const B& b, int facet) {
    { b.facet_count() } -> std::convertible_to<int>;
    { b.velocity(facet) } -> std::convertible_to<double>;
};

/// Is driven: control sets velocities from loads, advance moves facets by one step, fastest is the largest speed (m/s),
/// power what it does on the specimen (W).
template <class B>
concept driven = requires(B& b, const B& seen, std::span<const facet_load> loads, const drives& d, double dt,
                          std::span<const coupling> couplings) {
    b.control(loads, d, dt, couplings);
    b.advance(dt);
    { seen.fastest() } -> std::convertible_to<double>;
    { seen.power(loads) } -> std::convertible_to<double>;
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

/// What an engine asks of a boundary. A protocol asks more: protocol/vessel.hpp.
template <class B>
concept surface = confines<B> && has_facets<B> && driven<B> && saved<B>;

} // namespace clast::boundaries
