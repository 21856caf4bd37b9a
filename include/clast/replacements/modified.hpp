// SPDX-License-Identifier: MIT
// The modified particle replacement method (MPRM): a clump near breakage becomes a bonded cluster in the same place.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <clast/bonds/lattice.hpp>
#include <clast/replacements/concepts.hpp>

namespace clast::replacements {

/// How the bonds of a new cluster are born.
enum class birth : std::uint8_t {
    warm_start, ///< with the forces that hold the cluster in equilibrium under its present load (default)
    zero_force  ///< without force, as PFC makes them: the load arrives suddenly, overshoots and breaks bonds falsely
};

/// MPRM of the paper (section 2.1, Fig. 2): at `trigger` of its strength a clump is replaced by balls of identical size
/// in the same place, joined by parallel bonds. Positions, velocities, contact forces and their histories carry over,
/// so mass, momentum and kinetic energy are continuous.
struct modified {
    static constexpr bool replaces = true;
    static constexpr bool makes_bonds = true;

    /// The bonds with which a cluster will be born.
    struct plan {
        std::vector<bonds::state> born;
    };

    bonds::parallel bond;    ///< material of the bonds
    double trigger = 0.9;    ///< utilisation at which a clump is replaced, > 0 (paper: 90 %)
    int check_interval = 10; ///< steps between looks at the criterion, >= 1
    birth how = birth::warm_start;

    /// Bond states (world axes) for a cluster under these loads on its pebbles, with orientation q and spin w (rad/s).
    std::vector<bonds::state> born(const bonds::lattice& lattice, const std::vector<bonds::pebble_load>& load,
                                   const quaternion& q, const vec3& w, bonds::likeness like = {}) const {
        if (how == birth::zero_force) return std::vector<bonds::state>(lattice.ends.size());
        return lattice.statics(load, q, w, like);
    }

    int looks_every() const { return check_interval; }
    /// A clump at its trigger whose shape has bonds: they are solved for its present load.
    template <class View> std::optional<plan> wants(const View& clump) const {
        if (clump.shape().bonds.empty() || !(clump.utilisation() >= trigger)) return std::nullopt;
        return plan{born(clump.lattice(), clump.pebble_loads(), clump.orientation(), clump.spin(), clump.like())};
    }
    /// Balls in the place of the clump, joined by bonds as strong or weak as the clump was among its like.
    template <class Surgery> void act(std::int32_t grain, const plan& p, Surgery& surgery) const {
        surgery.release(grain);
        surgery.bond(grain, p.born, surgery.strength_factor(grain));
    }
};

} // namespace clast::replacements
