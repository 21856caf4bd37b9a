// SPDX-License-Identifier: MIT
// A replacement chosen at run time: policies are asked rarely, so the choice need not multiply the engine.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include <clast/replacements/bonded_from_start.hpp>
#include <clast/replacements/clusters.hpp>
#include <clast/replacements/concepts.hpp>
#include <clast/replacements/modified.hpp>
#include <clast/replacements/refreezing.hpp>
#include <clast/replacements/rigid_bonded.hpp>

namespace clast::replacements {

/// One of several policies that make bonds, picked when it is made. State is what a policy among them remembers of a
/// grain; others remember nothing.
template <class State, replacing... R> struct one_of {
    static constexpr bool replaces = true;
    static constexpr bool makes_bonds = true;
    static_assert((R::makes_bonds && ...), "policies of one_of make bonds");
    static_assert(((std::same_as<grain_state_of<R>, State> || std::same_as<grain_state_of<R>, nothing>)&&...),
                  "policies of one_of remember State or nothing");
    using plan = std::variant<plan_of<R>...>;
    using grain_state = State;

    std::variant<R...> model;
    bonds::parallel bond; ///< that of the model

    /// From any of the policies.
    template <class M>
    requires(std::same_as<std::remove_cvref_t<M>, R> || ...) one_of(M&& picked)
        : model(std::forward<M>(picked)), bond(std::visit([](const auto& m) { return m.bond; }, model)) {}
    one_of() : bond(std::visit([](const auto& m) { return m.bond; }, model)) {} ///< the first one, with its defaults

    int looks_every() const {
        return std::visit([](const auto& m) { return m.looks_every(); }, model);
    }
    template <class View> std::optional<plan> wants(const View& clump) const {
        return std::visit(
            [&]<class M>(const M& m) -> std::optional<plan> {
                if (auto made = m.wants(clump)) return plan(std::in_place_index<number_of<M>>, std::move(*made));
                return std::nullopt;
            },
            model);
    }
    template <class Surgery> void act(std::int32_t grain, const plan& p, Surgery& surgery) const {
        std::visit([&]<class M>(const M& m) { m.act(grain, std::get<number_of<M>>(p), surgery); }, model);
    }
    template <class Surgery> void again(std::int32_t grain, Surgery& surgery) const {
        std::visit(
            [&](const auto& m) {
                if constexpr (requires { m.again(grain, surgery); }) m.again(grain, surgery);
            },
            model);
    }
    /// Throws input_error where the policy cannot do with such a shape (engine_settings).
    void check(const shape& s, double scale, double contact) const {
        std::visit(
            [&](const auto& m) {
                if constexpr (requires { m.check(s, scale, contact); }) m.check(s, scale, contact);
            },
            model);
    }

  private:
    /// Place of a policy among all, by which its plans are told apart.
    template <class M>
    static constexpr std::size_t number_of = [] {
        const bool same[] = {std::same_as<M, R>...};
        std::size_t k = 0;
        while (!same[k]) ++k;
        return k;
    }();
};

/// Every policy of the library that makes bonds.
using any = one_of<unrest, modified, refreezing, rigid_bonded, bonded_from_start>;

} // namespace clast::replacements
