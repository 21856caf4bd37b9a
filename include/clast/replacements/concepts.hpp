// SPDX-License-Identifier: MIT
// What a replacement policy is: which clumps it wants, and what becomes of them.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <clast/bonds/lattice.hpp>

namespace clast::replacements {

/// What a policy remembers of a grain if it declares no `grain_state`, and plans if it declares no `plan`: nothing.
struct nothing {};

namespace detail {
template <class R> struct state_of { using type = nothing; };
template <class R>
requires requires { typename R::grain_state; }
struct state_of<R> {
    using type = typename R::grain_state;
};
template <class R> struct plan_of { using type = nothing; };
template <class R>
requires requires { typename R::plan; }
struct plan_of<R> {
    using type = typename R::plan;
};
} // namespace detail

/// What a policy remembers of every grain: its `grain_state`, which is default constructible and goes into checkpoints.
template <class R> using grain_state_of = typename detail::state_of<R>::type;
/// What `wants` answers and `act` is given: its `plan`.
template <class R> using plan_of = typename detail::plan_of<R>::type;

/// A run of consecutive pebbles of a grain, counted from its first one.
struct pebble_run {
    std::int32_t first = 0;
    std::int32_t count = 0;
};

/// What `wants` sees of a clump: declared only, so that a policy can be checked without an engine. An engine hands over
/// a view with these members (engine/grain_view.hpp), of the instant at which the loads of the clump are complete and
/// it has not moved yet. What costs something is found when it is asked for.
template <class State> struct view_archetype {
    std::int32_t grain() const;                           ///< place in the table of grains
    std::int64_t id() const;                              ///< its number for life
    double strength_factor() const;                       ///< its strength over that of its like (criterion)
    double utilisation() const;                           ///< of the criterion, >= 0; the grain breaks at 1
    std::vector<bonds::pebble_load> pebble_loads() const; ///< per pebble: force (N), moment about its centre (N m)
    std::size_t neighbours() const;                       ///< clumps, fragments, platens, wall that touch it
    const clast::shape& shape() const;
    bonds::likeness like() const;          ///< its size over that of its shape, its density over the specimen's
    const bonds::lattice& lattice() const; ///< the bonds of its shape, at ratios of 1; only where `makes_bonds`
    const vec3& centre() const;            ///< mass centre (m)
    const vec3& velocity() const;          ///< m/s
    const vec3& spin() const;              ///< rad/s, world axes
    const quaternion& orientation() const; ///< turns the axes of its shape into those of the world
    const State& state() const;            ///< what the policy remembers of it
};

/// What `act` may do: declared only. An engine hands over its room of that name (engine/surgery.hpp), where each
/// operation is described.
template <class State> struct surgery_archetype {
    const clast::shape& shape_of(std::int32_t grain) const;
    double strength_factor(std::int32_t grain) const;
    double time() const;
    std::int32_t intact_bonds(std::int32_t grain) const;
    std::vector<std::int32_t> pieces(std::int32_t grain) const;
    double bond_load(std::int32_t grain) const;
    State& state(std::int32_t grain);
    void release(std::int32_t grain);
    void bond(std::int32_t grain, const std::vector<bonds::state>& born, double strength);
    void split(std::int32_t grain, std::span<const pebble_run> parts);
    void freeze(std::int32_t grain, std::span<const pebble_run> parts);
    void freeze(std::int32_t grain, std::span<const std::int32_t> part);
    void again_in(std::int32_t grain, std::int64_t steps);
};

/// Either a policy that never replaces (`replaces` false, nothing else required) ...
template <class R>
concept unbreakable = requires {
    requires !bool(R::replaces);
};

/// ... or one that replaces clumps. Every `looks_every()` steps `wants(view)` is asked for every clump, by the thread
/// that sweeps it, so it must change nothing; an answer marks the clump. At the end of the step `act(grain, plan,
/// surgery)` is called for those marked, in the order of grains: the next evaluation of forces sees what it has made.
/// - `makes_bonds`: whether clumps may become balls and bonds; then it names the material, `bond`. Without, a scene
///   holds neither.
/// - `plan`, `grain_state` (optional): what passes from `wants` to `act`; what is remembered of each grain.
/// - `again(grain, surgery)` (optional): what surgery.again_in() asks for.
template <class R>
concept replacing = std::copyable<R> && requires {
    requires bool(R::replaces);
} && requires {
    { R::makes_bonds } -> std::convertible_to<bool>;
} &&(!bool(R::makes_bonds) ||
     requires(const R r) {
         { r.bond } -> std::convertible_to<bonds::parallel>;
     }) &&
    requires(const R r, const view_archetype<grain_state_of<R>>& clump, const plan_of<R>& plan,
             surgery_archetype<grain_state_of<R>>& surgery) {
    { r.looks_every() } -> std::convertible_to<int>;
    { r.wants(clump) } -> std::same_as<std::optional<plan_of<R>>>;
    r.act(std::int32_t{}, plan, surgery);
};

template <class R>
concept replacement = unbreakable<R> || replacing<R>;

/// Whether a scene with this policy holds balls and bonds.
template <replacement R> constexpr bool makes_bonds() {
    if constexpr (unbreakable<R>)
        return false;
    else
        return R::makes_bonds;
}

} // namespace clast::replacements
