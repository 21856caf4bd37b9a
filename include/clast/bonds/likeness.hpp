// SPDX-License-Identifier: MIT
// Clusters of other sizes and densities than their lattice: how they are similar to one of the lattice's own.
#pragma once

#include <cmath>

#include <clast/bonds/parallel.hpp>

namespace clast::bonds {

/// How a cluster differs from the shape and the material of its lattice: ratios, > 0.
///
/// A cluster of the lattice's own size and density is similar to it: with lengths over scale, forces over scale^4
/// density, moments and energies over scale^5 density, masses and times as they are, both obey the same equations, but
/// for the stiffness and the strength (over scale^2 density) of their bonds.
struct likeness {
    double scale = 1.0;   ///< of sizes
    double density = 1.0; ///< of densities

    constexpr double force() const {
        return scale * scale * (scale * scale) * density;
    }                                                           ///< over that of the similar one
    constexpr double energy() const { return force() * scale; } ///< and moment
    /// Stiffness of bonds in the similar cluster over that of the lattice: what is k is k / (scale^3 density) there,
    /// and k grows with a power of the scale (lattice::stiffness_power).
    constexpr double stiffness(int power) const {
        double k = 1.0 / (scale * scale * scale * density);
        for (int p = 0; p < power; ++p) k *= scale;
        return k;
    }
    /// Class of frequencies: quarters of an octave above that of the lattice, rounded up. Frequencies go with the root
    /// of that stiffness.
    int frequency_class(int power) const { return static_cast<int>(std::ceil(2.0 * std::log2(stiffness(power)))); }
    constexpr likeness inverse() const { return {1.0 / scale, 1.0 / density}; }
};

/// State of a bond in a cluster of what it is in the similar one; of the inverse, the other way round.
constexpr state scaled(const state& s, const likeness& to) {
    const double force = to.force(), moment = to.energy();
    return {force * s.n, force * s.v, moment * s.mt, moment * s.mb};
}

} // namespace clast::bonds
