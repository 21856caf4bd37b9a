// SPDX-License-Identifier: MIT
// The modified particle replacement method (MPRM): a clump near breakage becomes a bonded cluster in the same place.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <clast/replacements/clusters.hpp>
#include <clast/replacements/concepts.hpp>

namespace clast::replacements {

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

    int looks_every() const { return check_interval; }
    /// A clump at its trigger whose shape has bonds: they are solved for its present load.
    template <class View> std::optional<plan> wants(const View& clump) const {
        if (clump.shape().bonds.empty() || !(clump.utilisation() >= trigger)) return std::nullopt;
        return plan{replacements::born(how, clump)};
    }
    /// Balls in the place of the clump, joined by bonds as strong or weak as the clump was among its like.
    template <class Surgery> void act(std::int32_t grain, const plan& p, Surgery& surgery) const {
        become_cluster(grain, p.born, surgery);
    }
};

} // namespace clast::replacements
