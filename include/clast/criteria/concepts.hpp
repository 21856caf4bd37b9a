// SPDX-License-Identifier: MIT
// What a breakage criterion is: how close a clump is to breaking, from what its neighbours do to it.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include <clast/core/vector.hpp>

namespace clast::criteria {

/// What a criterion reads of a grain_load beyond diameter and volume. A set of flags: the engine fills only what is
/// asked.
enum class needs : unsigned {
    nothing = 0,
    largest_force = 1,    ///< grain_load::largest_force and largest_single
    largest_contact = 2,  ///< contact_radius and contact_at_wall of the contact behind largest_force
    stress = 4,           ///< grain_load::stress
    grain_id = 8,         ///< grain_load::grain
    coordination = 16,    ///< grain_load::coordination
    neighbour_forces = 32 ///< grain_load::neighbour_forces
};

constexpr needs operator|(needs a, needs b) {
    return static_cast<needs>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
/// True if everything in `asked` is in `given`.
constexpr bool contains(needs given, needs asked) {
    return (static_cast<unsigned>(asked) & ~static_cast<unsigned>(given)) == 0U;
}

/// All that there is to be asked for.
inline constexpr needs everything = needs::largest_force | needs::largest_contact | needs::stress | needs::grain_id |
                                    needs::coordination | needs::neighbour_forces;

/// Which force of a neighbour a criterion compares with its limit.
enum class force_of : std::uint8_t {
    neighbour, ///< resultant of all contacts with it: the crushing test measures the platen's force, which is one, too
    contact    ///< largest single contact of two pebbles, or of a pebble with a wall
};

/// What a criterion may know about one clump, filled by the engine. Members that it did not ask for are left at zero.
struct grain_load {
    double diameter = 0.0; ///< nominal, d (m), positive: grain_size
    double volume = 0.0;   ///< of the pebbles (m^3), positive
    /// Largest force by one neighbour (N), a clump, a fragment (balls that bonds join), a platen or the lateral wall:
    /// the resultant of its contacts.
    double largest_force = 0.0;
    double largest_single = 0.0; ///< largest force of a single contact (N)
    /// Mean stress (Pa, compression positive): -(1/V) sum f (x) l, f the force on the grain at the arm l from its mass
    /// centre, V the pebble volume. Symmetric only if the moments balance: criteria use the symmetric part.
    mat3 stress;
    /// r' = r1 r2 / (r1 + r2) of the contact behind largest_force (m), the largest of that neighbour: of two pebbles;
    /// at a wall the radius of the pebble.
    double contact_radius = 0.0;
    /// E', 1/E' = sum (1 - nu_i^2) / E_i, of that contact (Pa). 0: not known, which is what an engine says.
    double contact_modulus = 0.0;
    bool contact_at_wall = false; ///< whether that contact is one with a platen or the lateral wall
    double strength_factor = 1.0; ///< strength of this grain over that of its size (scatter), positive
    std::int64_t grain = -1;      ///< id of the grain
    std::size_t coordination = 0; ///< number of neighbours: clumps, fragments, platens, lateral wall
    /// What each of these exerts on the grain (N), in the order of its contacts. Valid during the call of
    /// `utilisation`.
    std::span<const vec3> neighbour_forces;
};

/// The force that counts (N).
inline double force(const grain_load& load, force_of what) {
    return what == force_of::contact ? load.largest_single : load.largest_force;
}

namespace detail {
// a member of the name that cannot be called like this would be passed over in silence
template <class C> constexpr bool optional_members_fit() {
    bool fit = true;
    if constexpr (requires { &C::active_needs; }) fit = requires(const C c) {
            { c.active_needs() } -> std::same_as<needs>;
        };
    if constexpr (requires { &C::strength_factor; }) fit = fit && requires(const C c) {
            { c.strength_factor(std::int64_t{}) } -> std::convertible_to<double>;
        };
    return fit;
}
} // namespace detail

/// A criterion that is evaluated: a small struct of plain values with
/// - `static constexpr bool evaluated = true`,
/// - `static constexpr criteria::needs needs`: all that it may ever read (a value may need less, see needs_of),
/// - `double utilisation(const grain_load&) const` -> u in [0, inf), pure; the grain breaks at u = 1, and a replacement
///   policy acts at its `trigger`.
/// and, if it likes,
/// - `criteria::needs active_needs() const`: what this value reads, if that is less than its type may,
/// - `double strength_factor(std::int64_t grain) const`: strength of a grain over that of its like, which its bonds
///   take over.
/// One that names such a member but gives it another form does not satisfy the concept.
/// Convention: two opposite forces F on the reference grain (diameter d0) give u = F / (sigma0 d0^2), so all criteria
/// agree on the crushing test that defines sigma0 and differ elsewhere.
template <class C>
concept evaluated_criterion = std::copyable<C> &&(detail::optional_members_fit<C>()) &&
                              requires(const C c, const grain_load load) {
    requires bool(C::evaluated);
    { C::needs } -> std::convertible_to<needs>;
    { c.utilisation(load) } -> std::same_as<double>;
};

/// A criterion: one that is evaluated, or one that declares `evaluated = false` and has nothing else (criteria::none).
template <class C>
concept criterion = evaluated_criterion<C> ||(std::copyable<C>&& requires { requires !bool(C::evaluated); });

/// What this value of a criterion reads: its `active_needs()` where it has one (the model or the rule is chosen at run
/// time), else all that its type declares.
template <evaluated_criterion C> constexpr needs needs_of(const C& c) {
    if constexpr (requires {
                      { c.active_needs() } -> std::same_as<needs>;
                  })
        return c.active_needs();
    else
        return C::needs;
}

/// Strength of a grain over that of its like: the criterion's `strength_factor`, or 1.
template <class C> constexpr double strength_factor_of(const C& c, std::int64_t grain) {
    if constexpr (requires { c.strength_factor(grain); })
        return c.strength_factor(grain);
    else
        return 1.0;
}

} // namespace clast::criteria
