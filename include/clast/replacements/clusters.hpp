// SPDX-License-Identifier: MIT
// What replacements with bonds have in common: how a cluster is born, and how its pieces become rigid again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/bonds/lattice.hpp>

namespace clast::replacements {

/// How the bonds of a new cluster are born.
enum class birth : std::uint8_t {
    warm_start, ///< with the forces that hold the cluster in equilibrium under its present load (default)
    zero_force  ///< without force, as PFC makes them: the load arrives suddenly, overshoots and breaks bonds falsely
};

/// Bond states (world axes) for a cluster under these loads on its pebbles, with orientation q and spin w (rad/s).
inline std::vector<bonds::state> born(birth how, const bonds::lattice& lattice,
                                      const std::vector<bonds::pebble_load>& load, const quaternion& q, const vec3& w,
                                      bonds::likeness like = {}) {
    if (how == birth::zero_force) return std::vector<bonds::state>(lattice.ends.size());
    return lattice.statics(load, q, w, like);
}
/// The same for a clump under its present load.
template <class View> std::vector<bonds::state> born(birth how, const View& clump) {
    return born(how, clump.lattice(), clump.pebble_loads(), clump.orientation(), clump.spin(), clump.like());
}

/// Balls in the place of a clump, joined by bonds as strong or weak as the clump was among its like.
template <class Surgery>
void become_cluster(std::int32_t grain, const std::vector<bonds::state>& states, Surgery& surgery) {
    surgery.release(grain);
    surgery.bond(grain, states, surgery.strength_factor(grain));
}

/// What is remembered of a cluster that shall become rigid again when it is at rest.
struct unrest {
    double since = 0.0;      ///< when a bond broke last, or what else counts (s)
    std::int32_t bonds = 0;  ///< how many were left then
    std::int32_t frozen = 0; ///< how often it, or what it is a part of, has become rigid again
};

/// The pieces of a cluster become rigid clumps where they are, with the bonds that they have left. Single pebbles
/// become clumps, too, or stay balls, which do not shrink the time step of the others. Nothing happens to a grain that
/// is single balls already. Returns how many bodies and balls there are now, in the places grain, grain + 1, ...
template <class Surgery> std::int32_t freeze_pieces(std::int32_t grain, bool singles_stay_balls, Surgery& surgery) {
    const std::vector<std::int32_t> piece = surgery.pieces(grain);
    std::vector<std::int32_t> pebbles(piece.size(), 0);
    for (const std::int32_t k : piece) ++pebbles[static_cast<std::size_t>(k)];
    const auto count =
        static_cast<std::int32_t>(std::count_if(pebbles.begin(), pebbles.end(), [](int n) { return n > 0; }));
    if (singles_stay_balls && surgery.intact_bonds(grain) == 0) return count;
    surgery.freeze(grain, piece);
    for (std::int32_t k = 0; singles_stay_balls && k < count; ++k)
        if (pebbles[static_cast<std::size_t>(k)] == 1) surgery.release(grain + k);
    return count;
}

} // namespace clast::replacements
