// SPDX-License-Identifier: MIT
// The crushing test of a single grain (Jaeger 1967): bonded balls between two platens that close.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include <clast/boundaries/solid_strips.hpp>
#include <clast/core/random.hpp>
#include <clast/criteria/nominal_force.hpp>
#include <clast/engine/engine.hpp>
#include <clast/protocol/triaxial.hpp>
#include <clast/replacements/bonded_from_start.hpp>

namespace crush {

struct test_settings {
    clast::shape form;
    clast::bonds::parallel bond;
    clast::table_1 materials;
    double safety = 0.2;    ///< of the time step: at 0.8 first breaks are off by some per cent
    double damping = 0.7;   ///< local
    double seat = 150.0;    ///< load at which a grain lies before it is bonded (N)
    double speed = 0.1;     ///< of each platen (m/s)
    double fall = 0.5;      ///< the peak is over when the force has fallen by this share of it
    std::uint64_t seed = 1; ///< of the orientations
};

/// What one grain held.
struct outcome {
    double first = 0.0; ///< force of the platens when the first bond breaks (N)
    double peak = 0.0;  ///< largest force before it falls (N)
    std::int64_t bonds = 0;
};

struct policies : clast::triaxial_policies_default {
    using boundary = clast::boundaries::solid_strips;
    using breakage = clast::criteria::nominal_force; // is not asked, but has to be there
    using replacement = clast::replacements::bonded_from_start;
};

/// Orientation number k, uniform; the same for all settings of one seed.
inline outcome crush_grain(const test_settings& s, std::uint64_t k) {
    using namespace clast;
    bodies::clumps one;
    one.density = s.materials.density;
    one.shapes.push_back(s.form);
    random_stream random{mix(s.seed), k};
    one.add(0, {}, orientation(random));
    double low = 0.0, high = 0.0, smallest = s.form.circumscribed_radius;
    for (const auto& p : one.pebbles) {
        low = std::min(low, p.x.z - p.radius), high = std::max(high, p.x.z + p.radius);
        smallest = std::min(smallest, p.radius);
    }
    boundaries::cylinder_settings platens;
    platens.radius = 10.0 * s.form.circumscribed_radius; // out of reach
    platens.bottom = low, platens.top = high;
    platens.rings = 1, platens.tiles_per_ring = 8;
    platens.smallest_radius = smallest;
    platens.contact_stiffness_floor = s.materials.at_membrane().kn;
    engine<policies> e({.grain_contact = s.materials.between_grains(),
                        .platen_contact = s.materials.at_platen(),
                        .lateral_contact = s.materials.at_membrane(),
                        .breakage = {criteria::crushing_strength(1e15)},
                        .replacement = {.bond = s.bond},
                        .scheme = {.damping = s.damping},
                        .safety = s.safety},
                       std::move(one), boundaries::solid_strips(platens));
    const auto force = [&] { return 0.5 * (e.loads()[0].force + e.loads()[1].force); };
    // rigid until it lies, or grains would seat elsewhere with bonds of another stiffness
    e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.5 * s.speed};
    while (std::min(e.loads()[0].force, e.loads()[1].force) < s.seat) e.step();
    e.step(300);
    e.breakage_on = true;
    e.drives.platens.value = s.speed;
    outcome o;
    double before = 0.0;
    const double room = 0.5 * e.boundary.height(); // closed by half, a grain is crushed
    while (e.boundary.height() > room && (o.bonds == 0 || before >= (1.0 - s.fall) * o.peak)) {
        e.step();
        const auto broken = static_cast<std::int64_t>(e.take_events().size());
        if (broken > 0 && o.bonds == 0) o.first = before;
        o.bonds += broken;
        before = force();
        o.peak = std::max(o.peak, before);
    }
    return o;
}

} // namespace crush
