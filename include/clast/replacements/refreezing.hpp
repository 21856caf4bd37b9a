// SPDX-License-Identifier: MIT
// The modified particle replacement method, with clusters that become rigid again when they have come to rest.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include <clast/replacements/clusters.hpp>
#include <clast/replacements/concepts.hpp>
#include <clast/replacements/modified.hpp>

namespace clast::replacements {

/// `modified`, but a cluster in which no bond has broken and none has been loaded beyond a share of its strength for
/// some time becomes rigid where it is, and so does every piece of it; broken bonds stay broken. A rigid piece is
/// looked at by the criterion like any clump, with its own size, and becomes a cluster of its bonds again when that
/// says so. Each time the rest that is asked for doubles, so a piece between two minds does not go back and forth.
/// Single pebbles stay balls.
struct refreezing {
    static constexpr bool replaces = true;
    static constexpr bool makes_bonds = true;
    using plan = modified::plan;
    using grain_state = unrest;

    bonds::parallel bond;    ///< material of the bonds
    double trigger = 0.9;    ///< utilisation at which a clump is replaced, > 0 (paper: 90 %)
    int check_interval = 10; ///< steps between looks at the criterion, >= 1
    birth how = birth::warm_start;
    double rest = 1e-3;      ///< s that a cluster must be at rest, > 0
    double calm = 0.5;       ///< load of its worst bond over the strength, up to which it counts as at rest, in (0, 1)
    int rest_interval = 100; ///< steps between looks at a cluster, >= 1

    int looks_every() const { return check_interval; }
    template <class View> std::optional<plan> wants(const View& clump) const {
        return modified{bond, trigger, check_interval, how}.wants(clump);
    }
    template <class Surgery> void act(std::int32_t grain, const plan& p, Surgery& surgery) const {
        become_cluster(grain, p.born, surgery);
        surgery.state(grain).since = surgery.time();
        surgery.state(grain).bonds = surgery.intact_bonds(grain);
        surgery.again_in(grain, rest_interval);
    }
    /// A look at a cluster.
    template <class Surgery> void again(std::int32_t grain, Surgery& surgery) const {
        unrest& u = surgery.state(grain);
        const std::int32_t left = surgery.intact_bonds(grain);
        if (left == 0) return; // single balls
        if (left != u.bonds || surgery.bond_load(grain) > calm) u.since = surgery.time(), u.bonds = left;
        if (surgery.time() - u.since < std::ldexp(rest, u.frozen)) return surgery.again_in(grain, rest_interval);
        ++u.frozen;
        freeze_pieces(grain, true, surgery);
    }
};

} // namespace clast::replacements
