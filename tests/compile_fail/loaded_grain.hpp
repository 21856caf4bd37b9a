// SPDX-License-Identifier: MIT
// One grain in a box that is pressed: what each file here runs with its own policy in the bundle. The bundle itself is
// named in that file, so that the first error stands there.
#pragma once

#include <clast/clast.hpp>

inline constexpr clast::contacts::linear stiff{3e6, 1.5e6, 0.3};

inline clast::bodies::clumps one_grain() {
    clast::bodies::clumps grains;
    grains.add(grains.kind_of(clast::shapes::tetrahedron_4(clast::circumscribed(0.02))), {}, {});
    return grains;
}

template <class Wall = clast::boundaries::box> Wall small_box() {
    return Wall({{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, 3.2e8, 3e6});
}

template <class Engine> double pressed(Engine& e) {
    e.drives.platens.value = 0.1;
    e.step(10);
    return e.loads()[0].force + e.dt() + e.kinetic_energy() + e.grains.solid_volume();
}
