// SPDX-License-Identifier: MIT
// What comes from outside besides walls and space: constraints around a step. Fields and constraints enter the load of
// a body in sweep.hpp, fields that of a ball in light_bodies.hpp.
#pragma once

#include <clast/engine/scene.hpp>

namespace clast::rooms {

/// Before forces are found: constraints set the velocities that they prescribe.
template <class S> void begin_constraint([[maybe_unused]] S& s) {
    if constexpr (S::constraint_type::acts) {
        s.totals.boundary_work += s.constraint.begin_step(s.grains, s.totals.time);
        if (s.constraint.take_change()) s.estimate_due = true; // a body that was fixed may limit dt now
    }
}
/// After bodies have moved: the work of constraints is booked.
template <class S> void end_constraint([[maybe_unused]] S& s) {
    if constexpr (S::constraint_type::acts) s.totals.boundary_work += s.constraint.end_step(s.grains, s.dt);
}

} // namespace clast::rooms
