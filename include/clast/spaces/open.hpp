// SPDX-License-Identifier: MIT
// Space as it is outside a periodic cell: it holds nothing and does nothing.
#pragma once

#include <cstdint>
#include <limits>

#include <clast/core/vector.hpp>
#include <clast/integrators/concepts.hpp>
#include <clast/spaces/concepts.hpp>
#include <clast/spaces/crossings.hpp>

namespace clast::spaces {

/// No image, no flow, no strain of its own. Empty: it takes no memory, and all calls vanish.
struct open {
    static constexpr bool has_images = false;
    using crossings = no_crossings;
    using flow_type = integrators::no_flow;
    /// What displacements count from: nothing.
    struct frame {
        template <class A> void archive(A&) {}
    };

    static constexpr frame here() { return {}; }
    static constexpr vec3 stretch_since(const frame&) { return {1.0, 1.0, 1.0}; }
    static constexpr vec3 rates() { return {}; }
    static constexpr flow_type flow() { return {}; }
    static constexpr double travel(const vec3&, double) { return 0.0; }
    static constexpr double room(double) { return std::numeric_limits<double>::infinity(); }
    static constexpr vec3 across(const vec3& x, std::uint8_t) { return x; }
    template <class Scene, class Spheres> static void gather(Scene&, Spheres&) {}
    static constexpr bool looks(std::int64_t, bool, bool) { return false; }
    template <class Scene> static void begin_sweep(Scene&) {}
    template <class Scene> static void end_sweep(Scene&, bool) {}
    static constexpr void advance(double) {}

    template <class A> void archive(A&) {}
};

} // namespace clast::spaces
