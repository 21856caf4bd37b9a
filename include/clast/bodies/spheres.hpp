// SPDX-License-Identifier: MIT
// Single spheres: the least that a scene may consist of, and how they move.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include <fmt/core.h>

#include <clast/bodies/concepts.hpp>
#include <clast/bodies/contact_list.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/packs.hpp>
#include <clast/core/vector.hpp>
#include <clast/grains/shape.hpp>
#include <clast/integrators/concepts.hpp>

namespace clast::bodies {

/// Spheres that move on their own, nothing else: no grain, no orientation, no owner, and no memory for them. A body is
/// its pebble, and the pebble holds the body's motion.
struct spheres {
    double density = 2650.0; ///< kg/m^3
    std::vector<pebble_motion> pebbles;
    std::vector<body_losses> losses;
    std::vector<std::uint8_t>
        materials; ///< per sphere, for laws that read them; those behind its end are of material 0

    static constexpr bool turns = false;
    struct reference {
        vec3 centre;
    };

    /// Adds a sphere at rest and returns its number.
    std::int32_t add(const vec3& centre, double radius) {
        pebbles.push_back({centre, radius, {}, 0.0, {}, 0.0});
        weigh(pebbles.back(), density);
        losses.push_back({});
        return static_cast<std::int32_t>(pebbles.size() - 1);
    }
    /// Radius of the grains of a shape (m). Throws input_error for one that is not a single sphere.
    static double kind_of(const shape& s) {
        if (s.pebbles.size() != 1)
            throw input_error("grain", fmt::format("'{}', of {} pebbles", s.name, s.pebbles.size()),
                              "one pebble, where bodies are spheres",
                              "Take shapes::sphere(0.02), or bodies::clumps for the bundle's body.");
        return s.pebbles.front().radius;
    }
    /// As for clumps, where a radius is the kind; a sphere has no orientation to keep.
    std::int32_t add(double radius, const vec3& centre, const quaternion&, double scale = 1.0) {
        return add(centre, scale * radius);
    }
    /// As for clumps.
    void set_material(std::size_t b, std::uint8_t material, double density_ratio = 1.0) {
        materials.resize(pebbles.size(), 0);
        materials[b] = material;
        weigh(pebbles[b], density_ratio * density);
    }
    std::size_t pebble_count() const { return pebbles.size(); }
    std::size_t grain_count() const { return pebbles.size(); }
    static constexpr std::int32_t number_of(std::size_t g) { return static_cast<std::int32_t>(g); }
    double solid_volume() const {
        double v = 0.0;
        for (const pebble_motion& p : pebbles) v += sphere_volume(p.radius);
        return v;
    }

    std::size_t body_count() const { return pebbles.size(); }
    std::size_t movable_count() const { return pebbles.size(); }
    static constexpr bool is_swept(std::size_t) { return true; }
    static constexpr std::size_t body_of(std::int32_t pebble) { return static_cast<std::size_t>(pebble); }
    static constexpr std::size_t group_of(std::int32_t pebble) { return static_cast<std::size_t>(pebble); }
    sphere_view view() const { return {pebbles.data(), materials.data()}; }
    const vec3& velocity_of(std::int32_t pebble) const { return pebbles[static_cast<std::size_t>(pebble)].v; }
    const vec3& spin_of_pebble(std::int32_t pebble) const { return pebbles[body_of(pebble)].w; }
    double inverse_mass_of(std::int32_t pebble) const { return pebbles[body_of(pebble)].inverse_mass; }
    const vec3& centre(std::size_t b) const { return pebbles[b].x; }
    const vec3& velocity(std::size_t b) const { return pebbles[b].v; } ///< m/s
    const vec3& spin(std::size_t b) const { return pebbles[b].w; }     ///< rad/s
    void set_velocity(std::size_t b, const vec3& v) { pebbles[b].v = v; }
    /// A sphere has no orientation to keep.
    void set_place(std::size_t b, const vec3& x, const quaternion&) { pebbles[b].x = x; }
    void set_spin(std::size_t b, const vec3& w) { pebbles[b].w = w; }
    double bounding_radius(std::size_t b) const { return pebbles[b].radius; }
    index_range pebbles_of(std::size_t b) const { return {b, b + 1}; }
    double body_mass(std::size_t b) const { return 1.0 / pebbles[b].inverse_mass; }
    double ball_mass(std::size_t p) const { return body_mass(p); } ///< a pebble is a body (kg)
    vec3 body_inertia(std::size_t b) const {
        const double i = 1.0 / pebbles[b].inverse_inertia;
        return {i, i, i};
    }
    mat3 body_axes(std::size_t) const { return mat3::identity(); }
    /// A sphere whose inverse_inertia is 0 does not turn: it has no energy of rotation.
    double kinetic_energy(std::size_t b) const {
        const pebble_motion& p = pebbles[b];
        const double turning = p.inverse_inertia > 0.0 ? norm2(p.w) / p.inverse_inertia : 0.0;
        return 0.5 * (norm2(p.v) / p.inverse_mass + turning);
    }
    reference refer(std::size_t b) const { return {pebbles[b].x}; }
    double moved(std::size_t b, const reference& since, const vec3& stretch) const {
        return norm(pebbles[b].x - scale(stretch, since.centre));
    }
    double surface_speed(std::size_t b, const vec3& rate) const {
        return norm(pebbles[b].v - scale(rate, pebbles[b].x)); // to spin brings a sphere no nearer
    }
    /// As for clumps; there is no pebble to be placed, and `further` is not asked.
    template <class Rule, class Further>
    margin_use advance(std::span<const moving_body> bodies, const Rule& rule, const body_items&,
                       const allowance<reference>& allowed, Further&&) {
        return with_widest_registers([ =, this, &allowed ](auto width) __attribute__((always_inline)) {
            return this->move(width, bodies, rule, allowed);
        });
    }
    void place(std::size_t) {}
    void place(std::size_t, std::span<const std::int32_t>) {}
    void shift(std::size_t b, const vec3& by, const vec3& faster) { pebbles[b].x += by, pebbles[b].v += faster; }
    double smallest_mass() const {
        double most = 0.0;
        for (const pebble_motion& p : pebbles) most = std::max(most, p.inverse_mass);
        return 1.0 / most;
    }

    template <class A> void archive(A& a) { a(density, pebbles, losses, materials); }

  private:
    /// Gives a sphere the mass and the inertia of a density (kg/m^3).
    static void weigh(pebble_motion& p, double rho) {
        p.inverse_mass = 1.0 / (rho * sphere_volume(p.radius));
        p.inverse_inertia = 1.0 / (rho * sphere_inertia_per_density(p.radius));
    }
    /// In whole records of four numbers where the scheme takes them, else in vectors.
    template <std::size_t N, std::size_t Loop, class Rule>
    [[gnu::always_inline]] margin_use move(register_width<N, Loop>, std::span<const moving_body> bodies,
                                           const Rule& rule, const allowance<reference>& allowed) {
        using scheme_type = decltype(rule.scheme);
        using row = std::conditional_t<integrators::takes<scheme_type, quad<N>>, quad<N>, four_numbers>;
        const auto dot = [](const row& a, const row& b) __attribute__((always_inline)) {
            return clast::dot(vec3{a[0], a[1], a[2]}, vec3{b[0], b[1], b[2]});
        };
        // held by value, or they would be read again behind every store
        pebble_motion* const all = pebbles.data();
        body_losses* const all_losses = losses.data();
        const vec3 stretch = allowed.stretch;
        const double* const margins = allowed.margins.data();
        const reference* const since = allowed.since.data();
        const bool damped = integrators::damps(rule.scheme);
        margin_use use = margin_use::within;
        for (const moving_body& one : bodies) {
            pebble_motion& p = all[one.body];
            body_losses& lost = all_losses[one.body];
            const row x0 = row::load(&p.x), v0 = row::load(&p.v), w0 = row::load(&p.w);
            row force = row::load(&one.load.force), moment = row::load(&one.load.moment), df = force, dm = moment;
            lost.friction += one.load.dissipated;
            if (damped) {
                df = rule.scheme.extra(force, rule.flow.relative(v0, x0, rule.drift)),
                dm = rule.scheme.extra(moment, w0);
                force = force + df, moment = moment + dm;
            }
            typename scheme_type::memory *of_v = nullptr, *of_w = nullptr;
            if constexpr (!integrators::forgetful<scheme_type>)
                of_v = &rule.memory[one.body].translation, of_w = &rule.memory[one.body].rotation;
            const row v = rule.kicked(v0, force, rule.kick * p.inverse_mass, of_v);
            const row w = rule.kicked(w0, moment, rule.kick * p.inverse_inertia, of_w);
            if (damped) lost.damping -= 0.5 * rule.kick * (dot(df, v0 + v) + dot(dm, w0 + w));
            const row x = x0 + rule.drift * v;
            x.with_fourth_of(x0).store(&p.x), v.with_fourth_of(v0).store(&p.v), w.with_fourth_of(w0).store(&p.w);
            const double margin = margins[one.body];
            const vec3 way = vec3{x[0], x[1], x[2]} - scale(stretch, since[one.body].centre);
            use = std::max(use, use_of(norm2(way), margin * margin));
        }
        return use;
    }
    /// A record as a vector and its fourth number, for schemes that take vectors.
    struct four_numbers : vec3 {
        double fourth = 0.0;

        four_numbers(const vec3& a, double w = 0.0) : vec3(a), fourth(w) {}
        static four_numbers load(const void* from) {
            double of[4];
            std::memcpy(of, from, sizeof of);
            return {{of[0], of[1], of[2]}, of[3]};
        }
        void store(void* to) const {
            const double of[4] = {x, y, z, fourth};
            std::memcpy(to, of, sizeof of);
        }
        four_numbers with_fourth_of(const four_numbers& b) const { return {*this, b.fourth}; }
    };
};

} // namespace clast::bodies
