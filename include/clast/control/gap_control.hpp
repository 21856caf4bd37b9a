// SPDX-License-Identifier: MIT
// Gap control of a flexible membrane (paper section 2.2, Fig. 4): no step between two neighbouring tiles may grow so
// large that a particle slips through. Knows apothems and velocities, no grain and no tile.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace clast::control {

/// Neighbouring walls in a row: the tiles of a column, or of a closed ring. Wall j of the row is element
/// first + j * stride of the arrays of apothems and velocities; the pair (j, j + 1) has latch first_latch + j.
struct chain {
    int first = 0;
    int stride = 1;
    int count = 0;
    bool closed = false; ///< true: the last wall is also a neighbour of the first one
    int first_latch = 0;
    double limit = 0.0; ///< largest step between neighbours (m), > 0; paper: the smallest particle size

    constexpr int pairs() const { return count < 2 ? 0 : closed ? count : count - 1; }
    template <class A> void archive(A& a) { a(first, stride, count, closed, first_latch, limit); } // it has padding
};

/// Constants of the rule; defaults are ours, the paper gives none.
struct gap_rule {
    double closing = 0.5; ///< the leading wall of a runaway pair gets this share of the other's velocity, in (0, 1)
    double release = 0.9; ///< a pair stays under control until its step is below this share of the limit, in (0, 1]
};

/// How often the rule acted, counted per pair and sweep.
struct gap_events {
    std::int64_t slowed = 0;  ///< same direction: the leading wall was slowed down
    std::int64_t relaxed = 0; ///< opposite directions, or one at rest: both were stopped
    std::int64_t forced = 0;  ///< sweeps did not settle: a pair was stopped to end them (rare)
};

namespace detail {

struct gap_pair {
    std::size_t a, b, latch;
};

constexpr gap_pair pair_of(const chain& c, int j) {
    const int next = j + 1 == c.count ? 0 : j + 1;
    return {static_cast<std::size_t>(c.first + j * c.stride), static_cast<std::size_t>(c.first + next * c.stride),
            static_cast<std::size_t>(c.first_latch + j)};
}

/// Rate at which |R_a - R_b| grows; velocities are inward, so dR/dt = -V.
inline double opening_rate(double ra, double rb, double va, double vb) { return ra >= rb ? vb - va : va - vb; }

} // namespace detail

/// Latches the pairs whose step reached the limit, releases those well below it; returns the number of latched pairs.
inline int latch_gaps(const chain& c, const gap_rule& rule, const std::vector<double>& apothem,
                      std::vector<std::uint8_t>& latch) {
    int latched = 0;
    for (int j = 0; j < c.pairs(); ++j) {
        const auto [a, b, l] = detail::pair_of(c, j);
        const double gap = std::abs(apothem[a] - apothem[b]);
        if (gap >= c.limit)
            latch[l] = 1;
        else if (gap <= rule.release * c.limit)
            latch[l] = 0;
        latched += latch[l];
    }
    return latched;
}

/// One pass over the latched pairs of a chain that would open further; returns whether a velocity was altered.
/// Same direction: the wall whose motion opens the step gets `closing` times the other's velocity, so that the step
/// closes. Otherwise both stop. Velocities only ever shrink.
inline bool sweep_gaps(const chain& c, const gap_rule& rule, const std::vector<double>& apothem,
                       std::vector<double>& velocity, const std::vector<std::uint8_t>& latch, bool backward,
                       gap_events& events) {
    bool changed = false;
    const int pairs = c.pairs();
    for (int k = 0; k < pairs; ++k) {
        const auto [a, b, l] = detail::pair_of(c, backward ? pairs - 1 - k : k);
        if (!latch[l]) continue;
        double& va = velocity[a];
        double& vb = velocity[b];
        if ((va == 0.0 && vb == 0.0) || detail::opening_rate(apothem[a], apothem[b], va, vb) < 0.0) continue;
        if (va * vb > 0.0) {
            // an opening pair of one direction: the leader is the faster one (inward: the wall further in)
            if (std::abs(va) > std::abs(vb) || (va == vb && (va > 0.0) == (apothem[a] < apothem[b])))
                va = rule.closing * vb;
            else
                vb = rule.closing * va;
            ++events.slowed;
        } else {
            va = vb = 0.0;
            ++events.relaxed;
        }
        changed = true;
    }
    return changed;
}

/// Gap control over any number of chains that share walls (columns and rings): changes the fresh servo velocities
/// (inward, m/s) so that no latched pair opens, by sweeps that only reduce speeds; call `latch_gaps` on each chain
/// first. Alternate `backward` from step to step, so that no end of the chain is favoured. Returns the sweeps used;
/// sweeps that do not settle within the number of walls end by stopping the pairs that still open.
inline int control_gaps(const std::vector<chain>& chains, const gap_rule& rule, const std::vector<double>& apothem,
                        std::vector<double>& velocity, const std::vector<std::uint8_t>& latch, bool backward,
                        gap_events& events) {
    int longest = 0;
    for (const chain& c : chains) longest = longest < c.count ? c.count : longest;
    for (int sweep = 1; sweep <= longest; ++sweep) {
        bool changed = false;
        for (const chain& c : chains)
            if (sweep_gaps(c, rule, apothem, velocity, latch, backward, events)) changed = true;
        if (!changed) return sweep;
    }
    for (bool opens = true; opens;) { // every pass stops at least one moving wall, so this ends
        opens = false;
        for (const chain& c : chains)
            for (int j = 0; j < c.pairs(); ++j) {
                const auto [a, b, l] = detail::pair_of(c, j);
                if (!latch[l] || !(detail::opening_rate(apothem[a], apothem[b], velocity[a], velocity[b]) > 0.0))
                    continue;
                velocity[a] = velocity[b] = 0.0;
                ++events.forced;
                opens = true;
            }
    }
    return longest;
}

/// Holds latched pairs from opening further by a force between their walls, equal and opposite, which leaves the sum of
/// their loads what the servos want: the velocities (inward, m/s) nearest to those given, weighed by the walls'
/// stiffness (N/m, > 0), at which no latched pair opens. Projected Gauss-Seidel; `holding`: work space. Returns how
/// many pairs are held.
inline int hold_gaps(const std::vector<chain>& chains, const std::vector<double>& apothem,
                     std::vector<double>& velocity, const std::vector<double>& stiffness,
                     const std::vector<std::uint8_t>& latch, std::vector<double>& holding) {
    holding.assign(latch.size(), 0.0);
    for (int sweep = 0; sweep < 100; ++sweep) {
        double moved = 0.0, fastest = 0.0;
        for (const chain& c : chains)
            for (int j = 0; j < c.pairs(); ++j) {
                const auto [a, b, l] = detail::pair_of(c, j);
                if (!latch[l]) continue;
                const double rate = detail::opening_rate(apothem[a], apothem[b], velocity[a], velocity[b]);
                const double push = std::max(-holding[l], rate / (1.0 / stiffness[a] + 1.0 / stiffness[b]));
                const double inward = apothem[a] >= apothem[b] ? push : -push;
                holding[l] += push;
                velocity[a] += inward / stiffness[a], velocity[b] -= inward / stiffness[b];
                moved = std::max(moved, std::abs(push) * (1.0 / stiffness[a] + 1.0 / stiffness[b]));
                fastest = std::max({fastest, std::abs(velocity[a]), std::abs(velocity[b])});
            }
        if (moved <= 1e-3 * fastest) break;
    }
    return static_cast<int>(std::count_if(holding.begin(), holding.end(), [](double f) { return f > 0.0; }));
}

} // namespace clast::control
