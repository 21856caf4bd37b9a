// SPDX-License-Identifier: MIT
// The two end platens: rigid, horizontal, unbounded planes (they reach beyond any bulge and pass through tiles).
#pragma once

#include <array>

#include <clast/boundaries/touch.hpp>

namespace clast::boundaries {

/// A pair of platens normal to z. Velocities are inward: the bottom one moves up, the top one down (m/s).
struct platens {
    double bottom = 0.0;
    double top = 0.0;
    std::array<double, 2> velocity{}; ///< [bottom_platen], [top_platen]

    double height() const { return top - bottom; }
    bool near(double z, double reach) const { return z - bottom < reach || top - z < reach; }
    /// Adds the contacts of a sphere with the platens as they will be `ahead` seconds later.
    void touch_sphere(const vec3& x, double r, double ahead, touches& out) const {
        const double below = r - (x.z - (bottom + velocity[0] * ahead));
        const double above = r - ((top - velocity[1] * ahead) - x.z);
        if (below > 0.0) out.add({bottom_platen, {0.0, 0.0, 1.0}, below, 1.0});
        if (above > 0.0) out.add({top_platen, {0.0, 0.0, -1.0}, above, 1.0});
    }
    void advance(double dt) {
        bottom += velocity[0] * dt;
        top -= velocity[1] * dt;
    }

    template <class A> void archive(A& a) { a(bottom, top, velocity); }
};

} // namespace clast::boundaries
