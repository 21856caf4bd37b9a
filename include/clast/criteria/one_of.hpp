// SPDX-License-Identifier: MIT
// A criterion chosen at run time: criteria are evaluated rarely, so the choice need not multiply the engine.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <clast/criteria/concepts.hpp>
#include <clast/criteria/hertz_contact.hpp>
#include <clast/criteria/major_principal.hpp>
#include <clast/criteria/mean_stress.hpp>
#include <clast/criteria/nominal_force.hpp>
#include <clast/criteria/octahedral.hpp>

namespace clast::criteria {

/// One of several criteria, picked when it is made. `needs` is the union over all (memory may be set aside by it),
/// needs_of(value) that of the one picked.
template <evaluated_criterion... C> struct one_of {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = (C::needs | ... | criteria::needs::nothing);

    std::variant<C...> model;

    /// From any of the criteria.
    template <class M>
    requires(std::same_as<std::remove_cvref_t<M>, C> || ...) one_of(M&& picked) : model(std::forward<M>(picked)) {}

    double utilisation(const grain_load& load) const {
        return std::visit([&load](const auto& m) { return m.utilisation(load); }, model);
    }
    criteria::needs active_needs() const {
        return std::visit([](const auto& m) { return needs_of(m); }, model);
    }
    /// That of the one picked: 1 if it has none.
    double strength_factor(std::int64_t grain) const {
        return std::visit([grain](const auto& m) { return strength_factor_of(m, grain); }, model);
    }
};

/// Every criterion of the library that is evaluated.
using any = one_of<nominal_force, hertz_contact, octahedral, mean_stress, major_principal>;

/// Criterion by name: nominal_force, hertz_contact (calibrated), hertz_literal (Eq. 1 as printed), octahedral,
/// mean_stress or major_principal; which: for those that read a force. Throws input_error for another name.
inline any by_name(const std::string& name, const crushing_strength& strength, force_of which = force_of::neighbour) {
    const auto of_force = [which](hertz_contact c) {
        c.which = which;
        return c;
    };
    if (name == "nominal_force") return nominal_force{strength, which};
    if (name == "hertz_contact") return of_force(hertz_contact::calibrated(strength));
    if (name == "hertz_literal") return of_force(hertz_contact::literal(strength));
    if (name == "octahedral") return octahedral{strength};
    if (name == "mean_stress") return mean_stress{strength};
    if (name == "major_principal") return major_principal{strength};
    throw input_error("breakage criterion", name,
                      "nominal_force, hertz_contact, hertz_literal, octahedral, mean_stress, major_principal",
                      "nominal_force is the default.");
}

/// Criterion by name for a strength class of the paper (weak, medium, strong) at d0 (m) with Weibull modulus m. Throws
/// input_error for another name or class.
inline any by_name(const std::string& name, const std::string& strength_class, double d0 = 0.02, double m = 10.0) {
    return by_name(name, crushing_strength(strength_of_class(strength_class), d0, m));
}

} // namespace clast::criteria
