// SPDX-License-Identifier: MIT
// Several laws of one kind, chosen by the materials of the two pebbles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <clast/contacts/concepts.hpp>

namespace clast::contacts {

namespace detail {
struct no_friction {};
struct friction_bound {
    double mu = 0.0; ///< no pair has more friction; the largest of all pairs at first
};
} // namespace detail

/// A law for every pair of N materials, of one type with parameters of its own: two rocks with two frictions, or hard
/// grains among soft ones. Materials are numbers below N, which grains get by set_material of their bodies, or by
/// mixture_part::material; a wall has none, and there a law goes by the pebble's with itself. Where the law rubs, `mu`
/// is a bound for all pairs, so that stages of a test can lower friction.
template <contact_law Base, std::size_t N>
class by_material : public std::conditional_t<frictional<Base>, detail::friction_bound, detail::no_friction> {
    static_assert(N > 0, "by_material needs a material");

  public:
    using history = typename Base::history;
    static constexpr bool reads_materials = true;
    static constexpr std::size_t materials = N; ///< their numbers are below; an engine refuses others
    static constexpr bool uses_masses = contacts::reads_masses<Base>();
    static constexpr bool constant_stiffness = is_of_constant_stiffness<Base>();

    by_material() = default;
    /// f(a, b): the law between materials a and b, which is asked for a >= b.
    template <class F> static by_material of(F&& f) {
        by_material all;
        for (std::size_t a = 0; a < N; ++a)
            for (std::size_t b = 0; b <= a; ++b) {
                Base& one = all.laws_[number(a, b)];
                one = f(a, b);
                if constexpr (frictional<Base>) all.mu = std::max(all.mu, one.mu);
            }
        return all;
    }
    /// Between materials a and b, both below N.
    const Base& law(std::size_t a, std::size_t b) const { return laws_[number(std::max(a, b), std::min(a, b))]; }

    template <class T>
    [[gnu::always_inline]] auto operator()(const overlap<T>& o, const motion<T>& m, history& h, double dt) const {
        return acting(o)(o, m, h, dt);
    }
    /// Repulsion (N), of laws that tell it apart.
    template <class T>
    [[gnu::always_inline]] T normal_force(const overlap<T>& o, const motion<T>& m) const requires
        requires(const Base b) {
        b.normal_force(o, m);
    }
    { return acting(o).normal_force(o, m); }
    /// Of an overlap whose materials are not known, as of all others: by the stiffest law.
    double stored(const overlap<double>& o, const history& h) const { return known_or_stiffest(o).stored(o, h); }
    double normal_stiffness(const overlap<double>& o) const { return known_or_stiffest(o).normal_stiffness(o); }
    double shear_stiffness(const overlap<double>& o) const { return known_or_stiffest(o).shear_stiffness(o); }
    double rolling_stiffness(const overlap<double>& o) const requires resists_rotation<Base> {
        return known_or_stiffest(o).rolling_stiffness(o);
    }
    double twisting_stiffness(const overlap<double>& o) const requires resists_rotation<Base> {
        return known_or_stiffest(o).twisting_stiffness(o);
    }
    /// The largest of all laws (m).
    double reach() const requires requires(const Base b) { b.reach(); }
    {
        double most = 0.0;
        for (const Base& one : laws_) most = std::max(most, one.reach());
        return most;
    }

  private:
    static constexpr std::size_t number(std::size_t larger, std::size_t smaller) {
        return larger * (larger + 1) / 2 + smaller;
    }
    /// The law of a contact whose materials are known, with its friction bounded.
    template <class T> [[gnu::always_inline]] Base acting(const overlap<T>& o) const {
        const T i = o.material_i, j = o.material_j < 0.0 ? i : o.material_j;
        const T larger = i > j ? i : j, smaller = i > j ? j : i;
        Base one = laws_[static_cast<std::size_t>(static_cast<int>(0.5 * larger * (larger + 1.0) + smaller))];
        if constexpr (frictional<Base>) one.mu = one.mu < this->mu ? one.mu : this->mu;
        return one;
    }
    Base known_or_stiffest(const overlap<double>& o) const { return o.material_i < 0.0 ? stiffest(o) : acting(o); }
    template <class T> Base stiffest(const overlap<T>& o) const {
        return *std::max_element(laws_.begin(), laws_.end(), [&](const Base& a, const Base& b) {
            return a.normal_stiffness(o) < b.normal_stiffness(o);
        });
    }

    std::array<Base, N*(N + 1) / 2> laws_{};
};

} // namespace clast::contacts
