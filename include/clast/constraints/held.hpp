// SPDX-License-Identifier: MIT
// Bodies that are fixed, driven, kept from turning, or pushed from outside: a list of them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/bodies/contact_list.hpp>
#include <clast/bodies/spheres.hpp>
#include <clast/constraints/concepts.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>

namespace clast::constraints {

/// World axes along which a velocity is prescribed; along the others the body moves by what acts on it.
struct axes {
    bool x = true, y = true, z = true;
};

/// What is prescribed of bodies, by their numbers in the table of bodies (of clumps: grains). Change it between steps.
/// The force that would change a prescribed velocity is taken from the load of the body before the integrator sees it:
/// the velocity stays what it was to the last bit, local damping finds nothing to take, and what was taken, turned
/// round, is the reaction. The work of reactions and of pushes, and the energy to set a velocity, are booked as work of
/// the boundary, body by body in the order in which they were first named.
class held {
  public:
    static constexpr bool acts = true;

    /// Prescribes a velocity (m/s) along some axes, none along the others. Throws input_error if it is not finite.
    void drive(std::size_t body, const vec3& velocity, axes along = {}) {
        check(velocity, "velocity", "m/s");
        entry& e = named(body);
        set(e.along[0], along.x), set(e.along[1], along.y), set(e.along[2], along.z);
        e.velocity = velocity;
    }
    /// Prescribes a spin (rad/s). Of clumps only 0: else the next step throws input_error. Throws input_error if it is
    /// not finite.
    void spin(std::size_t body, const vec3& spin) {
        check(spin, "spin", "rad/s");
        entry& e = named(body);
        set(e.turning, true);
        e.spin = spin;
    }
    /// Keeps a body from turning.
    void lock(std::size_t body) { spin(body, {}); }
    /// Neither moves nor turns.
    void fix(std::size_t body) { drive(body, {}), lock(body); }
    /// A force (N) and a moment about the centre (N m) from outside, in every step until it is set anew; they are
    /// damped like others. Throws input_error if they are not finite.
    void push(std::size_t body, const vec3& force, const vec3& moment = {}) {
        check(force, "force", "N"), check(moment, "moment", "N m");
        entry& e = named(body);
        e.force = force, e.moment = moment;
    }
    /// Takes a body off the list: it goes on as it moves now.
    void release(std::size_t body) {
        const std::size_t place = place_of(body);
        if (place == list_.size()) return;
        list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(place));
        changed_ = true;
        where_.assign(where_.size(), 0);
        for (std::size_t k = 0; k < list_.size(); ++k) where_[list_[k].body] = static_cast<std::uint32_t>(k + 1);
    }

    bool holds(std::size_t body) const { return place_of(body) < list_.size(); } ///< whether it is on the list
    std::size_t size() const { return list_.size(); }                            ///< bodies on the list
    /// Force (N) with which a body was held in the last step: on it, along the prescribed axes, else 0. Throws
    /// input_error for a body that is not on the list.
    const vec3& reaction(std::size_t body) const { return of(body).reaction; }
    /// Moment (N m) that prescribed its spin, in the same way.
    const vec3& reaction_moment(std::size_t body) const { return of(body).reaction_moment; }

    // ---- what an engine asks (concepts.hpp) -------------------------------------------------------------------------
    template <settable Bodies> double begin_step(Bodies& bodies, double time) {
        double work = 0.0;
        for (entry& e : list_) {
            refuse<Bodies::turns>(e, e.body < bodies.body_count(),
                                  e.body < bodies.body_count() && bodies.is_swept(e.body), time);
            vec3 v = bodies.velocity(e.body), w = bodies.spin(e.body);
            for (int a = 0; a < 3; ++a)
                if (e.along[at(a)] != 0) v[a] = e.velocity[a];
            if (e.turning != 0) w = e.spin;
            if (v != bodies.velocity(e.body) || w != bodies.spin(e.body)) {
                const double before = bodies.kinetic_energy(e.body);
                bodies.set_velocity(e.body, v);
                if (e.turning != 0) bodies.set_spin(e.body, w);
                work += bodies.kinetic_energy(e.body) - before;
            }
            e.velocity_before = v, e.spin_before = w;
        }
        return work;
    }
    void act(std::size_t body, load_sum& load) {
        const std::size_t place = place_of(body);
        if (place == list_.size()) return;
        entry& e = list_[place];
        load.force += e.force, load.moment += e.moment;
        e.reaction = e.reaction_moment = {};
        for (int a = 0; a < 3; ++a)
            if (e.along[at(a)] != 0) e.reaction[a] = -load.force[a], load.force[a] = 0.0;
        if (e.turning != 0) e.reaction_moment = -load.moment, load.moment = {};
    }
    template <settable Bodies> double end_step(const Bodies& bodies, double dt) {
        double work = 0.0;
        for (const entry& e : list_) {
            // with the mean of the velocities before and after, in step with the kinetic energy of a leapfrog
            work += 0.5 * dt * dot(e.force + e.reaction, e.velocity_before + bodies.velocity(e.body));
            work += 0.5 * dt * dot(e.moment + e.reaction_moment, e.spin_before + bodies.spin(e.body));
        }
        return work;
    }
    vec3 outer_force(std::size_t body) const {
        const std::size_t place = place_of(body);
        return place < list_.size() ? list_[place].force + list_[place].reaction : vec3{};
    }
    bool is_fixed(std::size_t body) const {
        const std::size_t place = place_of(body);
        if (place == list_.size()) return false;
        const entry& e = list_[place];
        return e.turning != 0 && e.along[0] != 0 && e.along[1] != 0 && e.along[2] != 0;
    }
    bool take_change() { return std::exchange(changed_, false); }

    template <class A> void archive(A& a) { a(list_, where_, changed_); }

  private:
    struct entry {
        std::uint64_t body = 0;
        std::array<std::uint8_t, 3> along{};
        std::uint8_t turning = 0;
        vec3 velocity, spin;               ///< prescribed
        vec3 force, moment;                ///< from outside
        vec3 reaction, reaction_moment;    ///< of the last step
        vec3 velocity_before, spin_before; ///< in the step that runs

        template <class A> void archive(A& a) {
            a(body, along, turning, velocity, spin, force, moment, reaction, reaction_moment);
        }
    };

    static std::size_t at(int axis) { return static_cast<std::size_t>(axis); }
    static void check(const vec3& v, const char* what, const char* unit) {
        if (!is_finite(v))
            throw input_error(fmt::format("constraints::held, {}", what),
                              fmt::format("({}, {}, {}) {}", v.x, v.y, v.z, unit), "finite numbers",
                              "Give it in SI units.");
    }
    /// Sets a flag, and notes whether that changed it.
    void set(std::uint8_t& flag, bool to) {
        changed_ = changed_ || (flag != 0) != to;
        flag = to ? 1 : 0;
    }
    /// Place in the list; its size for bodies that are not on it.
    std::size_t place_of(std::size_t body) const {
        return body < where_.size() && where_[body] != 0 ? where_[body] - std::size_t{1} : list_.size();
    }
    const entry& of(std::size_t body) const {
        const std::size_t place = place_of(body);
        if (place == list_.size())
            throw input_error("constraints::held", fmt::format("body {}", body), "bodies that are held or pushed",
                              "Name it with fix, drive, spin or push first.");
        return list_[place];
    }
    entry& named(std::size_t body) {
        if (place_of(body) == list_.size()) {
            if (body >= where_.size()) where_.resize(body + 1, 0);
            list_.push_back({});
            list_.back().body = body;
            where_[body] = static_cast<std::uint32_t>(list_.size());
        }
        return list_[place_of(body)];
    }
    /// What cannot be held.
    template <bool turns> static void refuse(const entry& e, bool is_there, bool is_whole, double time) {
        if (!is_there)
            throw input_error("constraints::held", fmt::format("body {}", e.body), "numbers of bodies of the scene",
                              "Bodies are numbered from 0 in the order in which they were added.");
        if (turns && e.turning != 0 && e.spin != vec3{})
            throw input_error("constraints::held, spin",
                              fmt::format("({}, {}, {}) rad/s of clump {}", e.spin.x, e.spin.y, e.spin.z, e.body),
                              "0 of clumps", "Lock it, or take bodies::spheres.");
        if (!is_whole)
            throw run_error({fmt::format("grain {} is held, but it has broken", e.body),
                             fmt::format("grain {}", e.body), fmt::format("t = {:.6g} s", time),
                             "a constraint holds a body as a whole, and a replaced grain is one no more",
                             "release it before it breaks, or give it a strength that it does not reach"});
    }

    std::vector<entry> list_;          ///< in the order in which bodies were first named
    std::vector<std::uint32_t> where_; ///< per body: place in the list + 1, or 0
    bool changed_ = false;
};

} // namespace clast::constraints
