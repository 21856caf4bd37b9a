// SPDX-License-Identifier: MIT
// Grains of bonded balls from the beginning: what other replacements are measured by.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <clast/replacements/clusters.hpp>
#include <clast/replacements/concepts.hpp>

namespace clast::replacements {

/// Every clump whose shape has bonds becomes a bonded cluster at the first look, whatever its load. Nothing is assumed
/// of when and how grains break but the strength of bonds; every grain costs what a cluster costs from then on. The
/// criterion is not asked (but must be there, because nobody is looked at with criteria::none); its scatter
/// of strengths scales the bonds.
struct bonded_from_start {
    static constexpr bool replaces = true;
    static constexpr bool makes_bonds = true;

    /// The bonds with which a cluster will be born.
    struct plan {
        std::vector<bonds::state> born;
    };

    bonds::parallel bond;    ///< material of the bonds
    int check_interval = 10; ///< steps between looks for clumps, >= 1
    birth how = birth::warm_start;

    int looks_every() const { return check_interval; }
    template <class View> std::optional<plan> wants(const View& clump) const {
        if (clump.shape().bonds.empty()) return std::nullopt;
        return plan{replacements::born(how, clump)};
    }
    template <class Surgery> void act(std::int32_t grain, const plan& p, Surgery& surgery) const {
        become_cluster(grain, p.born, surgery);
    }
};

} // namespace clast::replacements
