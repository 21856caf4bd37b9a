// SPDX-License-Identifier: MIT
// No wall at all.
#pragma once

#include <span>

#include <clast/boundaries/concepts.hpp>
#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>

namespace clast::boundaries {

/// A surface without a facet, for grains in a periodic cell or in free flight: it touches nothing and takes no load.
struct none {
    static constexpr bool near(const vec3&, double) { return false; }
    static constexpr touches touch(const vec3&, double, double = 0.0) { return {}; }
    static constexpr int facet_count() { return 0; }
    static constexpr double velocity(int) { return 0.0; }
    static void control(std::span<const facet_load>, const drives&, double, std::span<const coupling>) {}
    static constexpr void advance(double) {}
    static constexpr double fastest() { return 0.0; }
    static constexpr double power(std::span<const facet_load>) { return 0.0; }

    template <class A> void archive(A&) {}
};

} // namespace clast::boundaries
