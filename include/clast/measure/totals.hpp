// SPDX-License-Identifier: MIT
// What an engine has counted and lost so far, as a row of a series shows it.
#pragma once

#include <clast/engine/engine.hpp>
#include <clast/measure/sample.hpp>

namespace clast::measure {

/// Puts the time, counts, energies (J) and the step of an engine into a row.
template <class Engine> void add_totals(const Engine& e, sample& s) {
    const engine_totals& t = e.totals();
    s.replaced = t.replaced;
    s.broken_tension = t.broken_tension;
    s.broken_shear = t.broken_shear;
    s.kinetic_energy = e.kinetic_energy();
    s.elastic_energy = e.elastic_energy();
    const body_losses lost = e.losses();
    s.boundary_work = t.boundary_work;
    s.friction_dissipation = lost.friction;
    s.damping_dissipation = lost.damping;
    s.bond_dissipation = t.bond_dissipation;
    s.time = e.time();
    s.steps = t.steps;
    s.dt = e.dt();
}

} // namespace clast::measure
