// SPDX-License-Identifier: MIT
// A whole triaxial test at toy size, with grains so weak that dozens of bonds break.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <clast/criteria/nominal_force.hpp>
#include <clast/io/archive.hpp>
#include <clast/protocol/triaxial.hpp>
#include <clast/replacements/modified.hpp>

namespace clast::toy {

template <class Boundary> struct bundle : triaxial_policies_default { using boundary = Boundary; };

template <class P> triaxial_setup<P> setup(int threads = 1, double diameter = 0.066, double height = 0.075) {
    bonds::parallel bond;
    bond.normal_stiffness *= 0.06; // fewer sub-steps
    bond.shear_stiffness *= 0.06;
    bond.tensile_strength *= 0.06;
    bond.cohesion *= 0.06;
    return {.grain = shapes::tetrahedron_4(circumscribed(0.02)),
            .diameter = quantities::length(diameter),
            .height = quantities::length(height),
            .confining = quantities::stress(2e5),
            .breakage = {criteria::crushing_strength(5e5)},
            .replacement = {.bond = bond},
            .porosity = 0.62,
            .rings = 4,
            .tiles_per_ring = 8,
            .inertial_number = 5e-3,
            .threads = threads};
}

/// Compaction, consolidation in few steps, then some shear.
template <class P> std::vector<stage> stages(const triaxial_setup<P>& t, double strain) {
    std::vector<stage> s;
    s.push_back(protocol::preparation(t.diameter, t.height)[0]); // compact
    s.back().yields_at = 0.0;
    stage c = protocol::consolidation(t.confining);
    c.walls_at_rest = false;
    c.end = until::stresses_within(0.05) || until::steps(6000);
    c.breakage = false;
    s.push_back(c);
    s.push_back(protocol::shear(t.confining, quantities::ratio(strain), t.inertial_number));
    return s;
}

/// Collects rows and events; asks to stop when told to.
struct recorder : observer {
    std::function<bool()> stop_when;
    std::vector<sample> rows;
    std::vector<fracture_event> events;
    void on_row(const sample& s) override { rows.push_back(s); }
    void on_events(const std::vector<fracture_event>& e) override { events.insert(events.end(), e.begin(), e.end()); }
    bool stop_requested() override { return stop_when && stop_when(); }
};

/// What two equal runs have in common: every bit of the engine's state.
template <class P> std::uint64_t fingerprint(const triaxial_test<P>& t) { return checksum(t.sim()); }

} // namespace clast::toy
