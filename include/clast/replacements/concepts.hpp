// SPDX-License-Identifier: MIT
// What a replacement policy is: what becomes of a clump that its criterion calls critical.
#pragma once

#include <concepts>
#include <vector>

#include <clast/bonds/lattice.hpp>

namespace clast::replacements {

/// Either a policy that never replaces (makes_bonds false, nothing else required) ...
template <class R>
concept unbreakable = requires {
    { R::makes_bonds } -> std::convertible_to<bool>;
}
&&!R::makes_bonds;

/// ... or one that turns a clump into a cluster of bonded balls: it names the bond's material, when to look (trigger on
/// the criterion's utilisation, in steps of `check_interval`) and the forces with which the bonds are born.
template <class R>
concept bonding = requires {
    { R::makes_bonds } -> std::convertible_to<bool>;
}
&&R::makes_bonds&& std::copyable<R>&& requires(const R r, const bonds::lattice& lattice,
                                               const std::vector<bonds::pebble_load>& load, quaternion q, vec3 w) {
    { r.bond } -> std::convertible_to<bonds::parallel>;
    { r.trigger } -> std::convertible_to<double>;
    { r.check_interval } -> std::convertible_to<int>;
    { r.born(lattice, load, q, w) } -> std::same_as<std::vector<bonds::state>>;
};

template <class R>
concept replacement = unbreakable<R> || bonding<R>;

} // namespace clast::replacements
