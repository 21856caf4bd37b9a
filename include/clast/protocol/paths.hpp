// SPDX-License-Identifier: MIT
// Paths beyond the triaxial compression at constant cell pressure, as stages: extension, cycles, constant mean stress,
// undrained shear, one-dimensional compression, and true triaxial shear.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/core/quantity.hpp>
#include <clast/protocol/preparation.hpp>
#include <clast/protocol/stage.hpp>
#include <clast/protocol/triaxial.hpp>

namespace clast::protocol {

// Stresses and inertial number are those of the setup. Strains count from the start of the first stage of a path.

/// Triaxial extension: the platens withdraw, so that the axial stress falls at constant cell pressure; axial strain and
/// q are negative. Ends at the axial strain -`strain`, `strain` > 0.
inline stage extension(quantities::ratio strain) {
    stage s = shear(strain);
    s.name = "extend";
    s.axial = drive_by::inertial_number_of_setup(-1.0);
    s.end = until::axial_strain(quantities::ratio{-strain.si()});
    return s;
}

/// Shear at constant mean stress: sigma_3 = (3 p - sigma_1) / 2 with p the confining stress of the setup. Beyond q = 3
/// p, where sigma_3 would have to be negative, it is 0.
inline stage constant_p(quantities::ratio strain) {
    stage s = shear(strain);
    s.lateral = drive_by::stress_that([](const stage_view& v) { return 0.5 * (3.0 * v.confining - v.sigma_1); });
    return s;
}

/// Undrained shear of a saturated specimen whose water and grains do not compress: at constant volume. The membrane
/// takes the effective stress sigma_3'; at constant cell pressure the pore pressure is sample::pore_pressure.
inline stage undrained(quantities::ratio strain) {
    stage s = shear(strain);
    s.lateral = drive_by::constant_volume();
    return s;
}

/// True triaxial shear in a box: sigma_1 (platens) rises, sigma_3 (walls normal to x) is the confining stress of the
/// setup, and sigma_2 = sigma_3 + b (sigma_1 - sigma_3) (walls normal to y). b: 0 triaxial compression, 1 extension.
/// Throws input_error for another b.
inline stage true_triaxial(double b, quantities::ratio strain) {
    if (!(b >= 0.0 && b <= 1.0))
        throw input_error("b of a true triaxial test", fmt::format("{:g}", b), "0 to 1",
                          "0 is triaxial compression, 1 triaxial extension.");
    stage s = shear(strain);
    s.lateral_y = drive_by::stress_that([b](const stage_view& v) { return v.sigma_3 + b * (v.sigma_1 - v.sigma_3); });
    return s;
}

/// One-dimensional compression of the specimen as prepared, without lateral strain, until the axial stress is
/// `sigma_1`, or the axial strain `strain`. K0 is sigma_3 / sigma_1. Takes the place of consolidation.
inline stage oedometer(quantities::stress sigma_1, quantities::ratio strain) {
    return {.name = "load",
            .axial = drive_by::inertial_number_of_setup(),
            .end = until::axial_stress_above(sigma_1) || until::axial_strain(strain),
            .most_steps = 100'000'000,
            .reference_here = true,
            .membrane_here = true,
            .hands_over = true,
            .row_density = 4.0};
}

/// Cycles of unloading and reloading in triaxial compression, then shear to `strain`.
struct cycle_settings {
    int count = 3;
    quantities::stress high; ///< q at which a branch of loading turns round; where `strain` comes first, there
    quantities::stress low;  ///< q at which a branch of unloading turns round, below `high`
    /// Axial strain between the turning points of loading, the first one too, in the place of `high`: cycles on the way
    /// of a monotonic test.
    std::optional<quantities::ratio> every{};
};
/// Throws input_error for less than one cycle, or turning points in the wrong order.
inline std::vector<stage> cyclic(const cycle_settings& c, quantities::ratio strain) {
    if (c.count < 1)
        throw input_error("cycles", fmt::format("{}", c.count), "1 or more", "Without cycles it is a triaxial test.");
    if (!c.every && !(c.high.si() > c.low.si()))
        throw input_error("high deviator of cycles", fmt::format("{:g} Pa", c.high.si()),
                          fmt::format("above the low one, {:g} Pa", c.low.si()), "Exchange them.");
    // a strain that a branch may begin with already, so none that a direction follows from
    const condition at_last{fmt::format("axial strain {:g} %", 100.0 * strain.si()),
                            [last = strain.si()](const stage_view& v) { return v.axial_strain >= last; },
                            until::axial_strain(strain).progress};
    const auto loaded = [&](int branch) {
        if (!c.every) return until::deviator_above(c.high) || at_last;
        const double turn = (branch + 1) * c.every->si();
        return condition{fmt::format("axial strain {:g} %", 100.0 * turn),
                         [turn](const stage_view& v) { return v.axial_strain >= turn; },
                         until::axial_strain(quantities::ratio{turn}).progress} ||
               at_last;
    };
    std::vector<stage> path;
    for (int k = 0; k < c.count; ++k) {
        stage load = shear(strain);
        load.end = loaded(k);
        if (k > 0) load.name = "reload", load.reference_here = false;
        path.push_back(std::move(load));
        path.push_back(unloading(c.low));
    }
    stage back = shear(strain);
    back.name = "reload", back.reference_here = false;
    back.end = at_last;
    path.push_back(std::move(back));
    for (stage& s : path) s.row_density = 4.0; // branches are steep
    return path;
}

/// Ends a stage also when q has fallen from its peak by a share, as until::peak_passed(drop).
inline stage until_peak(stage s, quantities::ratio drop) {
    s.end = until::peak_passed(drop) || std::move(s.end);
    return s;
}

} // namespace clast::protocol
