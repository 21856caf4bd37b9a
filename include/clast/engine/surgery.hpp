// SPDX-License-Identifier: MIT
// The only room that changes owners: clumps become balls, clusters of balls or smaller clumps, and balls become clumps.
// Nothing is made or lost here: pebbles get other owners, and pairs go from one list to another with what they
// remember.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/bodies/contact_list.hpp>
#include <clast/bonds/cluster_pool.hpp>
#include <clast/bonds/parallel.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>
#include <clast/criteria/concepts.hpp>
#include <clast/engine/neighbourhood.hpp>
#include <clast/engine/rearrange.hpp>
#include <clast/engine/scene.hpp>
#include <clast/grains/shape.hpp>
#include <clast/integrators/rotation.hpp>
#include <clast/measure/sample.hpp>
#include <clast/replacements/concepts.hpp>

namespace clast::rooms {

/// What a replacement policy is given to act with, at the end of a step. Grains are named by their places in the table;
/// a place holds while a policy acts on one grain, unless that is split. Everything here keeps mass, momentum and
/// angular momentum to rounding, and contacts with their histories.
template <class S> class surgery {
  public:
    using policy = typename S::policies::replacement;
    using state_type = typename decltype(S::replacing)::grain_state;
    static constexpr bool may_be_asked_again =
        requires(const policy r, replacements::surgery_archetype<state_type>& room) {
        r.again(std::int32_t{}, room);
    };

    explicit surgery(S& s) : s_(s) {}

    const clast::shape& shape_of(std::int32_t grain) const { return s_.grains.shape_of(one(grain)); }
    /// Strength of a grain over that of its like, by the criterion; 1 if it knows of none. Parts that were frozen keep
    /// that of the grain whose bonds they have.
    double strength_factor(std::int32_t grain) const {
        return criteria::strength_factor_of(s_.settings.breakage, one(grain).origin);
    }
    double time() const { return s_.totals.time + s_.dt; } ///< at the end of this step (s)
    /// How many of the bonds of its shape a grain has left: all of them as long as it is a clump.
    std::int32_t intact_bonds(std::int32_t grain) const;
    /// Per pebble of a grain the piece that it belongs to, joined by intact bonds: numbers from 0, in the order of the
    /// first pebbles of pieces. A clump is one piece.
    std::vector<std::int32_t> pieces(std::int32_t grain) const;
    /// Largest load of an intact bond of a grain over its strength (bonds::load_ratio); 0 if it has none, or is a
    /// clump, whose bonds are not there.
    double bond_load(std::int32_t grain) const;
    /// What the policy remembers of a grain.
    state_type& state(std::int32_t grain) requires(decltype(S::replacing)::remembers) {
        return s_.replacing.of_grain[s_.at(grain)];
    }

    /// A clump's pebbles become balls of their own in the same place with the same motion; kinetic energy is kept, too.
    /// Counted in engine_totals::replaced. Throws input_error if it is no clump.
    void release(std::int32_t grain);
    /// Joins the balls of a grain that was released by the bonds of its shape, with these states (world axes, one per
    /// bond) and their strength over that of the material. What energy the bonds hold is booked as negative
    /// bond_dissipation: no one paid for it. Throws input_error if there are not as many states as bonds.
    void bond(std::int32_t grain, const std::vector<bonds::state>& born, double strength);
    /// A clump becomes several rigid ones without bonds, in the same place and with the same motion; kinetic energy is
    /// kept, too. The parts are runs of its pebbles that share them out without rest, in their order. They take the
    /// places grain, grain + 1, ...: the grains behind move up; the first keeps the number for life (and so its
    /// strength), and all start with what was remembered of the whole. Equal runs of one shape share one new shape.
    /// Pebbles of two parts that overlap are in contact from now on, without a history; their elastic energy (none for
    /// tangent pebbles; shapes allow overlaps of 1e-9 d) is booked as negative bond_dissipation. Counted in
    /// engine_totals::replaced. Throws input_error if the parts are not such.
    void split(std::int32_t grain, std::span<const replacements::pebble_run> parts);
    /// The balls of a grain become rigid clumps where they are: parts as for split(), places and numbers, too. Momentum
    /// and angular momentum are kept to rounding, and contacts with other grains and between parts; bonds are gone. The
    /// kinetic energy that this takes, and what bonds and contacts within a part held, are booked as bond_dissipation,
    /// less what contacts between parts hold that a bond has carried until now. Parts get shapes of their own, with the
    /// bonds that were intact, and keep the strength factor of the whole. Throws input_error if the grain is a clump,
    /// or the parts are not such.
    void freeze(std::int32_t grain, std::span<const replacements::pebble_run> parts);
    /// The same for any parts: part[k] says to which of them pebble k belongs, counted from 0 without a gap. Pebbles
    /// exchange places within the grain until those of a part stand together, in their order; their numbers for life
    /// (clumps::numbers) go with them. Throws input_error if the grain is a clump, or a number makes no sense.
    void freeze(std::int32_t grain, std::span<const std::int32_t> part);
    /// The policy's again(grain, surgery) is called at the end of the step that comes `steps` (>= 1) after this one.
    /// If the grain is split meanwhile, about the first part. Throws input_error for less than one step.
    void again_in(std::int32_t grain, std::int64_t steps) {
        static_assert(may_be_asked_again, "again_in() needs a member again(grain, surgery) of the replacement");
        if (steps < 1) throw input_error("again_in", fmt::format("{} steps", steps), "at least 1", "Act at once.");
        s_.replacing.ask_again(s_.totals.steps + steps, grain);
    }

    /// Makes lists follow what was done. For the engine, when all have acted.
    void finish();

  private:
    const clast::grain& one(std::int32_t grain) const { return s_.grains.grains[s_.at(grain)]; }
    std::int32_t add_shape(clast::shape made);
    std::int32_t shape_of_part(std::int32_t whole, const replacements::pebble_run& part);
    std::int32_t shape_of_frozen(std::int32_t grain, std::span<const std::int32_t> part, std::int32_t which);
    /// How many parts there are.
    std::int32_t check(std::int32_t grain, std::span<const std::int32_t> part) const;
    void check(std::int32_t grain, std::span<const replacements::pebble_run> parts, bool is_clump) const;
    void divide(std::int32_t grain, std::size_t parts);
    /// Elastic energy (J) of contacts between parts of a grain.
    double energy_between(std::int32_t grain, std::span<const replacements::pebble_run> parts) const;
    /// Elastic energy (J) of bonds of a grain and of contacts within its parts, less that of contacts between parts
    /// that a bond carries.
    double energy_within(std::int32_t grain, std::span<const std::int32_t> part) const;

    S& s_;
    bool cut_ = false, owners_changed_ = false;
};

template <class S> std::int32_t surgery<S>::intact_bonds(std::int32_t number) const {
    const clast::grain& g = one(number);
    if constexpr (S::breakable) {
        if (g.cluster == clast::grain::is_loose) return 0;
        if (g.cluster >= 0) return s_.broken.pools[s_.at(g.shape)].intact_bonds(s_.at(g.cluster));
    }
    return static_cast<std::int32_t>(shape_of(number).bonds.size());
}

template <class S> std::vector<std::int32_t> surgery<S>::pieces(std::int32_t number) const {
    const clast::grain& g = one(number);
    std::vector<std::int32_t> piece(shape_of(number).pebbles.size(), 0);
    if (s_.grains.is_clump(s_.at(number))) return piece;
    std::int32_t found = 0;
    for (std::size_t k = 0; k < piece.size(); ++k) { // a fragment is named by its first pebble
        const std::int32_t named = s_.broken.fragment[s_.at(g.first) + k] - g.first;
        piece[k] = s_.at(named) == k ? found++ : piece[s_.at(named)];
    }
    return piece;
}

template <class S> double surgery<S>::bond_load(std::int32_t number) const {
    const clast::grain& g = one(number);
    if (g.cluster < 0) return 0.0;
    const bonds::cluster_pool& pool = s_.broken.pools[s_.at(g.shape)];
    double most = 0.0;
    for (std::size_t b = 0; b < pool.bonds(); ++b)
        if (pool.is_intact(s_.at(g.cluster), b)) most = std::max(most, pool.load_of(s_.at(g.cluster), b));
    return most;
}

template <class S> void surgery<S>::release(std::int32_t number) {
    static_assert(S::breakable, "release() needs balls, which a scene has if the replacement says makes_bonds = true");
    auto& b = s_.broken;
    const auto g = s_.at(number);
    clast::grain& one = s_.grains.grains[g];
    if (!s_.grains.is_clump(g))
        throw input_error("release", fmt::format("grain {}", number), "a clump", "It has been released already.");
    s_.grains.place(g, s_.unlisted.of(g));
    const vec3 spin = spin_of(s_.grains.turning[g].q, s_.grains.turning[g].l, s_.grains.inverse_inertia(one));
    const index_range own = s_.grains.pebbles_of(g);
    for (auto p = static_cast<std::int32_t>(own.begin); p < static_cast<std::int32_t>(own.end); ++p) {
        const std::size_t ball = s_.grains.ball(p);
        const vec3 x = s_.position(p);
        const vec3 v = s_.grains.motion[g].v + cross(spin, x - s_.grains.motion[g].x);
        // the motion of a ball trails t_n by the lag
        s_.grains.motion[ball] = {x - b.lag * v, v, spin, 1.0 / s_.grains.ball_mass(s_.at(p))};
        s_.grains.owner[s_.at(p)] = static_cast<std::int32_t>(ball);
        b.fragment[s_.at(p)] = p;
        b.balls.push_back(p);
    }
    one.cluster = clast::grain::is_loose;
    ++s_.totals.replaced;
    owners_changed_ = true;
}

template <class S> void surgery<S>::bond(std::int32_t number, const std::vector<bonds::state>& born, double strength) {
    static_assert(S::breakable, "bond() needs a replacement that says makes_bonds = true");
    auto& b = s_.broken;
    clast::grain& one = s_.grains.grains[s_.at(number)];
    bonds::cluster_pool& pool = b.pools[s_.at(one.shape)];
    if (one.cluster != clast::grain::is_loose || born.size() != pool.bonds() || born.empty())
        throw input_error("bond", fmt::format("{} states for grain {}", born.size(), number),
                          fmt::format("{} states (more than 0) for a grain that was released", pool.bonds()),
                          "Release it first; a grain whose shape has no bonds stays loose.");
    for (std::size_t k = 0; k < pool.shape().size(); ++k) {
        const std::size_t p = s_.at(one.first) + k;
        b.bonded[p] = 1;
        b.fragment[p] = one.first; // a shape with bonds is one piece
    }
    one.cluster = static_cast<std::int32_t>(pool.add(born, strength, {one.scale, one.density_ratio}));
    b.members[s_.at(one.shape)].push_back(number);
    s_.totals.bond_dissipation -= pool.energy(s_.at(one.cluster)); // born with energy that no one paid for
}

template <class S>
void surgery<S>::check(std::int32_t number, std::span<const replacements::pebble_run> parts, bool is_clump) const {
    std::int32_t next = 0;
    bool fine = s_.grains.is_clump(s_.at(number)) == is_clump && !parts.empty();
    for (const replacements::pebble_run& p : parts) fine = fine && p.first == next && p.count > 0, next += p.count;
    const auto pebbles = static_cast<std::int32_t>(shape_of(number).pebbles.size());
    if (!fine || next != pebbles)
        throw input_error(is_clump ? "split" : "freeze", fmt::format("{} parts of grain {}", parts.size(), number),
                          fmt::format("a {}, and runs that share out its {} pebbles in their order",
                                      is_clump ? "clump" : "grain that was released", pebbles),
                          "The first run starts at 0, each other one where the one before it ends.");
}

template <class S> std::int32_t surgery<S>::check(std::int32_t number, std::span<const std::int32_t> part) const {
    const std::size_t pebbles = shape_of(number).pebbles.size();
    std::vector<std::uint8_t> used(pebbles, 0);
    bool fine = !s_.grains.is_clump(s_.at(number)) && part.size() == pebbles;
    for (const std::int32_t k : part)
        if (fine = fine && k >= 0 && s_.at(k) < pebbles; fine) used[s_.at(k)] = 1;
    const auto parts = std::count(used.begin(), used.end(), 1);
    if (!fine || std::find(used.begin(), used.begin() + parts, 0) != used.begin() + parts)
        throw input_error("freeze", fmt::format("{} numbers of parts for grain {}", part.size(), number),
                          fmt::format("a grain that was released, and a number for each of its {} pebbles", pebbles),
                          "Number the parts from 0, and leave none out.");
    return static_cast<std::int32_t>(parts);
}

template <class S>
double surgery<S>::energy_between(std::int32_t number, std::span<const replacements::pebble_run> parts) const {
    const std::int32_t first = one(number).first;
    double e = 0.0;
    for (const replacements::pebble_run& part : parts)
        for (std::int32_t i = first; i < first + part.first; ++i)
            for (std::int32_t j = first + part.first; j < first + part.first + part.count; ++j) {
                const double depth = s_.radius(i) + s_.radius(j) - norm(s_.position(j) - s_.position(i));
                if (depth > 0.0) e += s_.settings.grain_contact.stored(s_.overlap_of({i, j}, depth), {});
            }
    return e;
}

template <class S> double surgery<S>::energy_within(std::int32_t number, std::span<const std::int32_t> part) const {
    const clast::grain& g = one(number);
    const auto part_at = [&](std::int32_t pebble) { // -1: of another grain
        const std::int32_t p = pebble - g.first;
        return 0 <= p && s_.at(p) < part.size() ? part[s_.at(p)] : -1;
    };
    const auto stored = [&](const pebble_pair& p, const typename S::history& h) {
        const double depth = s_.radius(p.i) + s_.radius(p.j) - norm(s_.position(p.j) - s_.position(p.i));
        return s_.settings.grain_contact.stored(s_.overlap_of(p, depth), h);
    };
    double e = g.cluster >= 0 ? s_.broken.pools[s_.at(g.shape)].energy(s_.at(g.cluster)) : 0.0;
    for (std::size_t k = 0; k < s_.light.size(); ++k) {
        const pebble_pair& p = s_.light.pairs[k];
        if (const int a = part_at(p.i); a < 0 || a != part_at(p.j)) continue;
        if constexpr (decltype(S::light)::remembers)
            e += stored(p, s_.light.history[k]);
        else
            e += stored(p, {});
    }
    for (const pebble_pair& p : s_.asleep)
        if (const int a = part_at(p.i); a >= 0 && a != part_at(p.j)) e -= stored(p, {});
    return e;
}

template <class S> std::int32_t surgery<S>::add_shape(clast::shape made) {
    s_.grains.shapes.push_back(std::move(made));
    s_.broken.make_pools(s_.grains, s_.settings);
    s_.smallest_mass = s_.grains.smallest_mass();
    return static_cast<std::int32_t>(s_.grains.shapes.size()) - 1;
}

template <class S> std::int32_t surgery<S>::shape_of_part(std::int32_t whole, const replacements::pebble_run& part) {
    if (part.count == static_cast<std::int32_t>(s_.grains.shapes[s_.at(whole)].pebbles.size())) return whole;
    for (const auto& k : s_.replacing.parts)
        if (k.whole == whole && k.first == part.first && k.count == part.count) return k.part;
    const std::int32_t made = add_shape(part_of(s_.grains.shapes[s_.at(whole)], s_.at(part.first), s_.at(part.count)));
    s_.replacing.parts.push_back({whole, part.first, part.count, made});
    return made;
}

template <class S>
std::int32_t surgery<S>::shape_of_frozen(std::int32_t number, std::span<const std::int32_t> part, std::int32_t which) {
    const clast::grain& g = one(number);
    const clast::shape& whole = shape_of(number);
    std::vector<shape_pebble> pebbles;
    std::vector<std::int32_t> place(part.size(), -1);
    vec3 origin;
    for (std::size_t k = 0; k < part.size(); ++k) {
        if (part[k] != which) continue;
        const std::int32_t p = g.first + static_cast<std::int32_t>(k);
        if (pebbles.empty()) origin = s_.position(p);
        place[k] = static_cast<std::int32_t>(pebbles.size());
        pebbles.push_back({s_.position(p) - origin, s_.radius(p)});
    }
    std::vector<shape_bond> bonds;
    std::vector<std::int32_t> numbers;
    for (std::size_t e = 0; g.cluster >= 0 && e < whole.bonds.size(); ++e) {
        const shape_bond b{place[s_.at(whole.bonds[e].a)], place[s_.at(whole.bonds[e].b)]};
        if (b.a < 0 || b.b < 0 || !s_.broken.pools[s_.at(g.shape)].is_intact(s_.at(g.cluster), e)) continue;
        bonds.push_back(b);
        numbers.push_back(number_of_bond(whole, static_cast<std::int32_t>(e)));
    }
    // its name tells once that it was frozen, however often it was
    const std::string frozen = whole.name.ends_with(" frozen") ? whole.name : whole.name + " frozen";
    clast::shape made = rigid_shape(frozen, std::move(pebbles), std::move(bonds));
    if (!made.bonds.empty()) made.bond_numbers = std::move(numbers);
    clast::detail::read_size(made, whole.reading);
    return add_shape(std::move(made));
}

template <class S> void surgery<S>::divide(std::int32_t number, std::size_t parts) {
    const auto g = s_.at(number);
    if constexpr (S::constraint_type::acts) // it names bodies by their places, which move up
        if (parts > 1)
            throw run_error({"a grain was divided in a scene with constraints", fmt::format("grain {}", one(number).id),
                             fmt::format("step {}", s_.totals.steps), "constraints name bodies by numbers that change",
                             "take constraints::none, or a replacement that does not divide grains"});
    s_.broken.grain_was_split(s_.grains, g, parts);
    s_.replacing.grain_was_split(g, parts);
    if constexpr (!integrators::forgetful<typename S::scheme_type>) {
        const auto own = s_.memory[g];
        s_.memory.insert(s_.memory.begin() + static_cast<std::ptrdiff_t>(g) + 1, parts - 1, own);
    }
    s_.near.margins.insert(s_.near.margins.begin() + static_cast<std::ptrdiff_t>(g) + 1, parts - 1, 0.0);
    sort_pebbles(s_);
    owners_changed_ = cut_ = true;
}

template <class S> void surgery<S>::split(std::int32_t number, std::span<const replacements::pebble_run> parts) {
    check(number, parts, true);
    if (parts.size() == 1) return;
    const auto g = s_.at(number);
    s_.grains.place(g, s_.unlisted.of(g));
    s_.totals.bond_dissipation -= energy_between(number, parts);
    std::vector<clump_part> made;
    for (const replacements::pebble_run& p : parts) made.push_back({p.first, shape_of_part(one(number).shape, p)});
    s_.grains.split(g, made);
    ++s_.totals.replaced;
    divide(number, parts.size());
}

template <class S> void surgery<S>::freeze(std::int32_t number, std::span<const replacements::pebble_run> parts) {
    static_assert(S::breakable, "freeze() needs balls, which a scene has if the replacement says makes_bonds = true");
    check(number, parts, false);
    std::vector<std::int32_t> part;
    for (const replacements::pebble_run& p : parts)
        part.insert(part.end(), s_.at(p.count), static_cast<std::int32_t>(&p - parts.data()));
    freeze(number, part);
}

template <class S> void surgery<S>::freeze(std::int32_t number, std::span<const std::int32_t> part) {
    static_assert(S::breakable, "freeze() needs balls, which a scene has if the replacement says makes_bonds = true");
    const std::int32_t parts = check(number, part);
    s_.totals.bond_dissipation += energy_within(number, part);
    std::vector<clump_part> made;
    std::vector<std::int32_t> order;
    for (std::int32_t which = 0; which < parts; ++which) {
        made.push_back({static_cast<std::int32_t>(order.size()), shape_of_frozen(number, part, which)});
        for (std::size_t k = 0; k < part.size(); ++k)
            if (part[k] == which) order.push_back(static_cast<std::int32_t>(k));
    }
    const clast::grain& g = one(number);
    const std::int32_t lost = g.lost + static_cast<std::int32_t>(shape_of(number).bonds.size()) - intact_bonds(number);
    s_.broken.balls_were_frozen(s_.grains, g);
    std::erase_if(s_.asleep, [&](const pebble_pair& p) { return s_.grains.mother[s_.at(p.i)] == number; });
    if (!std::is_sorted(order.begin(), order.end())) rearrange(s_, s_.at(number), order);
    s_.totals.bond_dissipation += s_.grains.freeze(s_.at(number), made);
    for (std::size_t k = 0; k < made.size(); ++k) s_.grains.grains[s_.at(number) + k].lost = lost;
    erase_contacts(s_.light, [&](const pebble_pair& p) { return s_.grains.body_of(p.i) == s_.grains.body_of(p.j); });
    divide(number, made.size());
}

template <class S> void surgery<S>::finish() {
    if (!owners_changed_) return;
    if constexpr (S::breakable) std::sort(s_.broken.balls.begin(), s_.broken.balls.end());
    s_.near.must_search = s_.estimate_due = true;
    if (!cut_) return;
    // pairs are sorted by grains, of which there are others now; what the last search has found is not asked any more
    sort_by(s_.heavy, s_.pair_order());
    sort_by(s_.light, s_.pair_order());
    s_.near.wide.heavy = s_.near.wide.light = {};
    s_.heavy_of.reset();
}

} // namespace clast::rooms
