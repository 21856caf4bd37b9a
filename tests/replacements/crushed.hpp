// SPDX-License-Identifier: MIT
// A single grain between two rough platens, seated gently, then crushed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <clast/core/random.hpp>
#include <clast/engine/engine.hpp>

#include "engine/scenes.hpp"

namespace clast::crushed {

template <class Replacement> struct policies : scenes::breakable<> { using replacement = Replacement; };

/// A grain of a shape of 20 mm in random orientation number k, pressed by 150 N or more without breaking, with the
/// bonds of Table 1. The step is small, or grains seat elsewhere with bonds than without.
template <class Replacement>
engine<policies<Replacement>> seated(const shape& form, std::uint64_t k, Replacement how = {}) {
    using P = policies<Replacement>;
    bodies::clumps sp = scenes::empty(form);
    random_stream random{77, k};
    sp.add(0, {}, orientation(random));
    boundaries::cylinder_settings c = scenes::cylinder_around(sp);
    c.radius = 0.1;
    auto s = scenes::settings<P>(1e15); // the criterion does not matter
    how.bond = s.replacement.bond;
    s.replacement = how;
    s.platen_contact.mu = 0.3;
    s.safety = 0.2;
    engine<P> e(s, std::move(sp), boundaries::solid_strips(c));
    e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.05};
    e.breakage_on = false;
    while (std::min(e.loads()[0].force, e.loads()[1].force) < 150.0) e.step();
    e.step(300);
    e.breakage_on = true;
    return e;
}

struct outcome {
    double first = 0.0; ///< force of the platens before the first bond broke (N)
    double peak = 0.0;  ///< largest force before it falls below half of that (N)
    std::int64_t bonds = 0;
    std::vector<fracture_event> events;
};

/// Crushes it by a speed of 0.1 m/s of each platen, until the force falls below half of its peak or a way has gone (m).
template <class P> outcome crush(engine<P>& e, double way = 0.01) {
    outcome o;
    e.drives.platens.value = 0.1;
    const double start = e.boundary.height();
    double before = 0.0;
    while (start - e.boundary.height() < way && (o.bonds == 0 || before >= 0.5 * o.peak)) {
        e.step();
        const std::vector<fracture_event> events = e.take_events();
        if (!events.empty() && o.bonds == 0) o.first = before;
        o.bonds += static_cast<std::int64_t>(events.size());
        o.events.insert(o.events.end(), events.begin(), events.end());
        before = 0.5 * (e.loads()[0].force + e.loads()[1].force);
        o.peak = std::max(o.peak, before);
    }
    return o;
}

} // namespace clast::crushed
