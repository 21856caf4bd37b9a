// SPDX-License-Identifier: MIT
// What a scheme is: how one body goes on under its load, and what the scheme takes out of it meanwhile.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include <clast/core/vector.hpp>
#include <clast/integrators/rotation.hpp>

namespace clast::integrators {

/// One evaluation of forces in a step: velocities are kicked by it over `kick` dt, then bodies drift over `drift` dt.
struct stage {
    double kick, drift;
};

/// A scheme is a small value with
/// - `static constexpr std::array<stage, N> stages`: the evaluations of forces that make a step; sums of 1;
/// - `memory`: what it keeps per body from step to step of a kicked vector (of the velocity, and of the angular
/// momentum),
///   trivially copyable, archived; empty if nothing;
/// - `V extra(force, v)`: a force beside the load (N), or a moment (N m) from moment and spin, by components: damping.
/// v is
///   relative to the mean flow of the space. Of a clump's moment the components are those in its own axes;
/// - `V kick(v, force, by)`: the velocity after a kick, by = kick dt / m; the same for angular momentum with by = kick
/// dt.
///   With a memory: `kick(v, force, by, memory&)`.
/// It may offer
/// - `bool damps() const`: false if extra() is zero now, which need not be asked then;
/// - `turned turn(q, l, inverse_inertia, dt)`: the drift of an orientation at an angular momentum; without it, that of
///   rotation.hpp;
/// - a member `damping`: coefficient of local damping. Balls and bonds, which take steps of their own, need it, one
/// stage,
///   no memory and no turn of its own (multirate).
/// V is vec3, or a record of four numbers of which the fourth is of no use (core/packs.hpp): a scheme whose functions
/// are not templates is handed vec3.
template <class S>
concept scheme = std::copyable<S> && std::is_trivially_copyable_v<typename S::memory> &&
                 std::default_initializable<typename S::memory> &&(S::stages.size() > 0) &&
                 requires(const S s, vec3 v, double by, typename S::memory& memory) {
    { s.extra(v, v) } -> std::same_as<vec3>;
    requires requires {
        { s.kick(v, v, by) } -> std::same_as<vec3>;
    } || requires {
        { s.kick(v, v, by, memory) } -> std::same_as<vec3>;
    };
};

/// Whether the functions of a scheme take records of four numbers.
template <class S, class V>
concept takes = requires(const S s, const V& v) {
    { s.extra(v, v) } -> std::same_as<V>;
};

/// A scheme that keeps nothing.
template <class S>
concept forgetful = std::is_empty_v<typename S::memory>;

/// A scheme with an orientation drift of its own.
template <class S>
concept turns_itself = requires(const S s, quaternion q, vec3 l, double dt) {
    { s.turn(q, l, l, dt) } -> std::same_as<turned>;
};

/// Whether a scheme may have a force beside the load.
template <class S> constexpr bool damps(const S& s) {
    if constexpr (requires {
                      { s.damps() } -> std::same_as<bool>;
                  })
        return s.damps();
    return true;
}

/// A scheme that can be left and taken up again within a step, as balls and bonds do.
template <class S>
concept multirate = scheme<S> && forgetful<S> && !turns_itself<S> && S::stages.size() == 1 && requires(const S s) {
    { s.damping } -> std::convertible_to<double>;
};

/// What a scheme keeps of one body.
template <class S> struct body_memory { typename S::memory translation{}, rotation{}; };

/// A space without a mean flow.
struct no_flow {
    template <class V> static constexpr const V& relative(const V& v, const V&, double) { return v; }
};

/// How bodies go on: a scheme, the flow that it sees velocities in, and the spans of kick and drift (s). memory: per
/// body, or nullptr for schemes that keep nothing.
template <class Scheme, class Flow = no_flow> struct rule {
    Scheme scheme;
    Flow flow;
    double kick, drift;
    body_memory<Scheme>* memory = nullptr;

    /// The kick of a body's velocity or of its angular momentum.
    template <class V>
    [[gnu::always_inline]] V kicked(const V& v, const std::type_identity_t<V>& force, double by,
                                    [[maybe_unused]] typename Scheme::memory* of) const {
        if constexpr (forgetful<Scheme>)
            return scheme.kick(v, force, by);
        else
            return scheme.kick(v, force, by, *of);
    }
};

} // namespace clast::integrators
