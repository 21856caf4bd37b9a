// SPDX-License-Identifier: MIT
// Loads on one grain for the tests of criteria.
#pragma once

#include <initializer_list>
#include <utility>

#include <clast/criteria/concepts.hpp>

namespace clast::test {

/// Load of a grain of diameter d and pebble volume v under forces (N) that act inwards at the ends of the given radii
/// of its circumscribed sphere, one neighbour each.
inline criteria::grain_load pressed(double d, double v, std::initializer_list<std::pair<vec3, double>> forces) {
    criteria::grain_load load;
    load.diameter = d;
    load.volume = v;
    for (const auto& [outward, size] : forces) {
        const vec3 n = unit(outward);
        load.stress += (-1.0 / v) * outer(-size * n, (0.5 * d) * n);
        load.largest_force = size > load.largest_force ? size : load.largest_force;
    }
    return load;
}

/// Crushing test: two opposite forces along an axis.
inline criteria::grain_load crushed(double d, double v, double force, const vec3& axis = {1, 2, -2}) {
    return pressed(d, v, {{axis, force}, {-axis, force}});
}

} // namespace clast::test
