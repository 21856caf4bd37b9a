// SPDX-License-Identifier: MIT
// Packings at rest, part of whose grains have been replaced by bonded clusters or loose balls, and what becomes of a
// little noise in them: a step that makes energy by itself makes it grow exponentially, by whatever little it is.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <clast/bonds/parallel.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/random.hpp>
#include <clast/criteria/concepts.hpp>
#include <clast/engine/engine.hpp>
#include <clast/grains/shape.hpp>
#include <clast/io/archive.hpp>
#include <clast/replacements/modified.hpp>

namespace clast::noise {

/// Which grains are replaced.
enum class whom { nobody, one, half, all };

/// A criterion that names grains.
struct named {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::needs::grain_id;
    whom who = whom::nobody;

    double utilisation(const criteria::grain_load& l) const {
        const bool hit =
            who == whom::all || (who == whom::half && l.grain % 2 == 1) || (who == whom::one && l.grain == 1);
        return hit ? 1.0 : 0.0;
    }
};
struct policies : triaxial_policies_default {
    using contact = contacts::linear;
    using boundary = boundaries::box;
    using breakage = named;
};
using simulator = engine<policies>;

inline constexpr double kn = 2.9e6, ks = 1.45e6, wall = 5.7e6; // N/m

/// Bonds that never break, `ratio` times as stiff as contacts.
inline bonds::parallel stiff(double ratio) {
    bonds::parallel b;
    b.normal_stiffness = ratio * kn, b.shear_stiffness = ratio * ks;
    b.tensile_strength = b.cohesion = 1e30;
    return b;
}
inline engine_settings<policies> settings(whom who, const bonds::parallel& bond, double damping, double safety,
                                          double mu) {
    return {.grain_contact = {kn, ks, mu},
            .platen_contact = {wall, 0.0, 0.0},
            .lateral_contact = {wall, 0.0, 0.0},
            .breakage = {who},
            .replacement = {.bond = bond, .check_interval = 1},
            .scheme = {damping},
            .safety = safety};
}
/// Steps until kinetic energy is nothing beside the elastic one.
inline void settle(simulator& e, int most) {
    for (int k = 0; k < most / 1000; ++k) {
        e.step(1000);
        if (e.kinetic_energy() < 1e-24 * e.elastic_energy()) break;
    }
}
/// Grains nx by nx by nz at random orientations in a box, pressed to about 0.3 MPa.
inline simulator packing(const shape& s, int nx, int nz, unsigned seed, double mu) {
    const double a = 0.0204, speed = 0.3;
    bodies::clumps rock;
    rock.shapes.push_back(s);
    random_stream random{seed, 0};
    const auto any = [&] { return 0.5 * (uniform01(random) - 0.5); };
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < nx; ++y)
            for (int x = 0; x < nx; ++x)
                rock.add(0, {a * (x + 0.5), a * (y + 0.5), a * (z + 0.5)}, orientation(random));
    for (auto& m : rock.motion) m.v = vec3{any(), any(), any()};
    boundaries::box around({{0, 0, 0}, {a * nx, a * nx, a * nz}, 3.2e8, wall});
    simulator e(settings(whom::nobody, stiff(100.0), 0.3, 0.8, 0.7 * mu), std::move(rock), std::move(around));
    e.breakage_on = false;
    const auto least = [&] {
        return std::min(
            {e.boundary.stress(e.loads(), 0), e.boundary.stress(e.loads(), 1), e.boundary.stress(e.loads(), 2)});
    };
    using mode = boundaries::drive::mode;
    for (double share = 1.0;; share = 0.1) {
        e.drives.platens = {mode::velocity, share * speed * nz / nx},
        e.drives.lateral = {mode::velocity, share * speed};
        for (int k = 0; k < 40000 && !(least() > 3e5); ++k) e.step(10);
        e.drives.platens = {}, e.drives.lateral = {};
        e.settings.scheme.damping = 0.7;
        e.step(5000);
        if (least() > 0.2e6) break;
    }
    e.set_friction(mu);
    settle(e, 200000);
    return e;
}
/// Some grains of it are replaced, at rest again and with another damping. Where bonds are so weak that they let go at
/// once, what is loose is pressed again.
inline simulator replaced(const simulator& rest, whom who, const bonds::parallel& bond, double damping, double safety) {
    const auto& grains = rest.grains;
    simulator e(settings(who, bond, 0.7, 0.2, rest.friction()), grains, rest.boundary);
    e.step(2);
    e.breakage_on = false;
    if (bond.tensile_strength < 1.0) {
        e.drives.platens = e.drives.lateral = {boundaries::drive::mode::servo, 2e5, 0.1, 0.3};
        e.step(20000);
        e.drives.platens = e.drives.lateral = {};
    }
    settle(e, 40000);
    e.settings.safety = safety; // a step grows slowly, and shrinks at once
    e.step(5000);
    settle(e, 20000);
    simulator other(settings(who, bond, damping, safety, rest.friction()), grains, rest.boundary);
    from_bytes(to_bytes(e), other);
    other.breakage_on = false;
    return other;
}
/// Gives all bodies random velocities with this share of the elastic energy in all.
inline void shake(simulator& e, double share, unsigned seed) {
    random_stream random{seed, 1};
    const auto any = [&] { return vec3{uniform01(random) - 0.5, uniform01(random) - 0.5, uniform01(random) - 0.5}; };
    auto& g = e.grains;
    std::vector<std::size_t> clumps;
    for (std::size_t k = 0; k < g.grain_count(); ++k)
        if (g.is_clump(k)) clumps.push_back(k);
    const auto balls = e.breakage().balls;
    for (std::size_t k : clumps) {
        g.motion[k].v = any() / std::sqrt(g.body_mass(k));
        const vec3 i = g.body_inertia(k);
        g.set_spin(k, any() / std::sqrt(std::max({i.x, i.y, i.z})));
    }
    for (std::int32_t p : balls) {
        const auto k = static_cast<std::size_t>(p);
        auto& m = g.motion[g.ball(p)];
        m.v = any() / std::sqrt(g.ball_mass(k)), m.w = any() / std::sqrt(g.ball_inertia(k));
    }
    const double f = std::sqrt(share * e.elastic_energy() / e.kinetic_energy());
    for (std::size_t k : clumps) g.motion[k].v = f * g.motion[k].v, g.set_spin(k, f * g.motion[k].w);
    for (std::int32_t p : balls)
        g.motion[g.ball(p)].v = f * g.motion[g.ball(p)].v, g.motion[g.ball(p)].w = f * g.motion[g.ball(p)].w;
}
/// Kinetic energy after noise of 1e-14 of the elastic energy and some steps, over that of the noise; 1e10 or more if
/// it went so far before the end.
inline double growth(simulator& e, int steps) {
    e.step(101); // the step of its own settings
    shake(e, 1e-14, 7);
    const double elastic = e.elastic_energy();
    constexpr int window = 250;
    const auto mean = [&] { // kinetic energy swings
        double sum = 0.0;
        for (int k = 0; k < 10; ++k) e.step(window / 10), sum += e.kinetic_energy();
        return 0.1 * sum / (1e-14 * elastic);
    };
    double largest = 0.0;
    try {
        for (int k = 0; k < steps && largest < 1e10; k += window) largest = std::max(largest, mean());
    } catch (const run_error&) {
        return 1e30;
    }
    return largest;
}

} // namespace clast::noise
