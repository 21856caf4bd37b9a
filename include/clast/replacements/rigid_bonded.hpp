// SPDX-License-Identifier: MIT
// Clumps that know what their bonds carry: rigid until one fails, for a moment bonded, then rigid pieces.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <fmt/core.h>

#include <clast/bonds/lattice.hpp>
#include <clast/core/errors.hpp>
#include <clast/grains/shape.hpp>
#include <clast/replacements/clusters.hpp>
#include <clast/replacements/concepts.hpp>

namespace clast::replacements {

/// A clump stays rigid, and the forces of its bonds are those that hold it in equilibrium under its present load. When
/// one of them reaches its strength, the clump becomes a bonded cluster for a moment (a burst): with these forces,
/// scaled so that the worst bond is just at its strength. Then the load of what breaks moves to the neighbours with
/// inertia, overshoots and may break these, as in explicit bonds; statics alone would miss that. When no bond has
/// broken for `quiet`, the pieces become rigid clumps with the bonds that they have left, and break again by the same
/// rule.
///
/// For bonds much stiffer than contacts only: a soft cluster carries load through its inner contacts and
/// yields to its load, which a rigid one does not. The criterion is not asked (but must be there, because nobody is
/// looked at with criteria::none); its scatter of strengths scales the bonds, of pieces, too.
struct rigid_bonded {
    static constexpr bool replaces = true;
    static constexpr bool makes_bonds = true;

    /// The bonds with which a burst begins.
    struct plan {
        std::vector<bonds::state> born;
    };
    using grain_state = unrest;

    bonds::parallel bond;           ///< material of the bonds
    int check_interval = 10;        ///< steps between looks, >= 1
    double quiet = 30e-6;           ///< s without a broken bond after which a burst ends: some periods of a bond, > 0
    bool singles_stay_balls = true; ///< of pebbles without a bond; else they are clumps, and lightest of all
    double least_stiffness = 20.0;  ///< of bonds over that of contacts between pebbles, below which a scene is refused

    int looks_every() const { return check_interval; }
    /// A clump with a bond at its strength or beyond.
    template <class View> std::optional<plan> wants(const View& clump) const {
        if (clump.shape().bonds.empty()) return std::nullopt;
        const bonds::lattice& lattice = clump.lattice();
        const bonds::likeness like = clump.like();
        const double strength = clump.strength_factor();
        std::vector<bonds::pebble_load> load = clump.pebble_loads();
        if (lattice.load_bound(load, clump.spin(), like) < strength) return std::nullopt; // cheap, and clears most
        plan p{lattice.statics(std::move(load), clump.orientation(), clump.spin(), like)};
        double worst = 0.0;
        for (std::size_t b = 0; b < p.born.size(); ++b)
            worst = std::max(worst, lattice.load_ratio(b, p.born[b], like) / strength);
        if (!(worst >= 1.0)) return std::nullopt;
        const double just = (1.0 + 1e-9) / worst; // so that rounding does not let it live
        for (bonds::state& s : p.born) s = {just * s.n, just * s.v, just * s.mt, just * s.mb};
        return p;
    }
    template <class Surgery> void act(std::int32_t grain, const plan& p, Surgery& surgery) const {
        become_cluster(grain, p.born, surgery);
        unrest& u = surgery.state(grain);
        u.since = surgery.time(), u.bonds = surgery.intact_bonds(grain);
        surgery.again_in(grain, 1);
    }
    /// The burst goes on as long as bonds break.
    template <class Surgery> void again(std::int32_t grain, Surgery& surgery) const {
        unrest& u = surgery.state(grain);
        const std::int32_t left = surgery.intact_bonds(grain);
        if (left != u.bonds) u.since = surgery.time(), u.bonds = left;
        if (left > 0 && surgery.time() - u.since < quiet) return surgery.again_in(grain, 1);
        ++u.frozen;
        freeze_pieces(grain, singles_stay_balls, surgery);
    }

    /// Throws input_error if bonds of a shape, at the scale of a grain, are too soft. contact: stiffness between
    /// pebbles (N/m).
    void check(const shape& s, double scale, double contact) const {
        for (const shape_bond& b : s.bonds) {
            const double r1 = scale * s.pebbles[static_cast<std::size_t>(b.a)].radius,
                         r2 = scale * s.pebbles[static_cast<std::size_t>(b.b)].radius;
            const double ratio = bonds::constants_of(bond, r1, r2).kn / contact;
            if (!(ratio >= least_stiffness))
                throw input_error(
                    "replacement rigid_bonded",
                    fmt::format("bonds of shape '{}' {:.3g} times as stiff as contacts ({:.3g} N/m)", s.name, ratio,
                                contact),
                    fmt::format("at least {:g} times", least_stiffness),
                    "A rigid clump stands for stiff bonds only: take bonded_from_start, modified, or stiffer bonds.");
        }
    }
};

} // namespace clast::replacements
