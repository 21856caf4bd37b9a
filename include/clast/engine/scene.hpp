// SPDX-License-Identifier: MIT
// What there is: bodies, the surface around them, the space they are in, contact lists, loads, the clock and totals.
// Data of an engine, archived as one; what is done with them is in the rooms beside this header.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <clast/bodies/concepts.hpp>
#include <clast/bodies/contact_list.hpp>
#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/parallel.hpp>
#include <clast/core/vector.hpp>
#include <clast/engine/body_ranges.hpp>
#include <clast/engine/breakage_state.hpp>
#include <clast/engine/kernel.hpp>
#include <clast/engine/list_widths.hpp>
#include <clast/engine/policies.hpp>
#include <clast/engine/replacement_state.hpp>
#include <clast/engine/settings.hpp>
#include <clast/fields/concepts.hpp>
#include <clast/replacements/concepts.hpp>

namespace clast {

/// Totals that an audit needs (J), and counters.
struct engine_totals {
    double boundary_work = 0.0;    ///< done on the specimen by platens, lateral wall, moving images and constraints
    double bond_dissipation = 0.0; ///< released by broken bonds, less what was put into bonds at birth
    double initial_energy = 0.0;   ///< brought in with initial velocities, places in a field and overlaps
    std::int64_t steps = 0;
    std::int64_t rebuilds = 0; ///< searches for neighbours
    std::int64_t renewals = 0; ///< of the lists, from what a search has found
    std::int64_t replaced = 0; ///< clumps that became balls or other clumps
    std::int64_t broken_tension = 0;
    std::int64_t broken_shear = 0;
    double time = 0.0;
};

/// What the lists of contacts are made from, and until when they hold (engine/neighbourhood.hpp).
template <class Body, class Space> struct neighbour_state {
    /// Where displacements count from.
    struct origin {
        std::vector<typename Body::reference> bodies;        ///< per swept body
        std::vector<vec3> balls;                             ///< per pebble of a breakable scene
        [[no_unique_address]] typename Space::frame frame{}; ///< of the space
        double wall_travel = 0.0;                            ///< how far walls have moved since (m)

        template <class A> void archive(A& a) { a(bodies, balls, frame, wall_travel); }
    };
    /// What the last search has found, in the order of the lists.
    struct wide_lists {
        pair_list heavy, light;
        std::vector<std::int32_t> wall; ///< pebbles that a facet may touch
        origin since;

        template <class A> void archive(A& a) { a(heavy, light, wall, since); }
    };

    wide_lists wide;
    origin since;                ///< where bodies were at the last renewal of the lists
    std::vector<double> margins; ///< per body: how far it may go before lists are renewed (m)
    double wall_margin = 0.0;    ///< the same for walls and for the strain of the space (m)
    double widest = 0.0;         ///< largest bounding diameter, where bodies have images (m)
    list_widths widths;
    bool must_search = false;
    bool must_renew = false;

    template <class A> void archive(A& a) {
        a(wide, since, margins, wall_margin, widest, widths, must_search, must_renew);
    }
};

/// What one thread works with while it sweeps its range of bodies.
struct range_work {
    std::vector<moving_body> ready;      ///< bodies whose loads are complete, until a strip of them is moved
    margin_use use = margin_use::within; ///< of its bodies
};
/// The same where a replacement may want clumps.
template <class R> struct marking_work : range_work {
    std::vector<marked_grain<R>> marked; ///< of its clumps, ascending
};

namespace detail {
template <class R> struct replacement_types {
    using work = range_work;
    using state = nothing_replaced;
};
template <replacements::replacing R> struct replacement_types<R> {
    using work = marking_work<R>;
    using state = replacement_state<R>;
};
} // namespace detail

/// Heavy bodies are swept, each once in a step: clumps, or all spheres of a scene of spheres. Light bodies are balls,
/// which pass through the step in sub-steps. A contact is light if one of its bodies is.
template <simulator_policies P> struct scene {
    using policies = P;
    using contact = typename P::contact;
    using history = typename contact::history;
    using body_type = typename P::body;
    using boundary_type = typename P::boundary;
    using space_type = typename P::space;
    using field_type = typename P::field;
    using constraint_type = typename P::constraint;
    using wall_row = boundaries::wall_row;
    using wall_grip = boundaries::grip<history>;
    using scheme_type = typename P::scheme;
    using rule_type = integrators::rule<scheme_type, typename space_type::flow_type>;
    /// What a scheme keeps of every body, if anything.
    struct no_memory {
        static constexpr integrators::body_memory<scheme_type>* data() { return nullptr; }
        static constexpr void resize(std::size_t) {}
        template <class A> void archive(A&) {}
    };
    using work = typename detail::replacement_types<typename P::replacement>::work;
    static constexpr bool replaces = P::replacement::replaces;
    static constexpr bool breakable = replacements::makes_bonds<typename P::replacement>(); ///< has balls and bonds
    static constexpr bool has_criterion = P::breakage::evaluated;
    static constexpr bool has_walls = !std::same_as<boundary_type, boundaries::none>; ///< else wall rows stay empty

    engine_settings<P> settings;
    body_type grains;
    boundary_type boundary;
    [[no_unique_address]] space_type space;
    [[no_unique_address]] constraint_type constraint{}; ///< what is prescribed of single bodies
    boundaries::drives drives;
    bool breakage_on = true; ///< off: criteria are not looked at (bonds of existing clusters still break)

    contact_list<history> heavy, light;
    std::vector<pebble_pair> asleep; ///< pairs of balls that an intact bond carries, in the order of the lists
    std::vector<wall_row> heavy_wall, light_wall;
    std::vector<wall_grip> heavy_grip, light_grip; ///< per row of the wall, where walls rub; empty elsewhere
    std::optional<incidence> heavy_of;             ///< which heavy rows act on a body: made when it is asked for
    incidence light_of;
    body_items listed;   ///< pebbles of clumps that are in a list, so placed in every step
    body_items unlisted; ///< the others
    neighbour_state<body_type, space_type> near;
    [[no_unique_address]] std::conditional_t<breakable, breakage_state, unbroken> broken;
    [[no_unique_address]] typename detail::replacement_types<typename P::replacement>::state replacing;

    [[no_unique_address]] std::conditional_t<integrators::forgetful<scheme_type>, no_memory,
                                             std::vector<integrators::body_memory<scheme_type>>>
        memory; ///< per body

    engine_totals totals;
    double dt = 0.0;     ///< s
    int light_steps = 1; ///< sub-steps of light bodies in a step
    bool estimate_due = false;
    double smallest_mass = 0.0;   ///< of a body (kg)
    double smallest_radius = 0.0; ///< of a pebble (m)

    // ---- work space, written anew in every step ---------------------------------------------------------------------
    std::vector<boundaries::facet_load> loads;
    std::vector<boundaries::facet_load> light_loads; ///< mean over the sub-steps of light bodies
    std::vector<boundaries::coupling> couplings;
    body_ranges ranges;                      ///< of bodies, one for each thread
    std::vector<work> sweeping;              ///< per range
    std::vector<contact_load<>> shared_load; ///< of the contacts between two ranges
    std::vector<load_sum> acting;            ///< per body; zero between steps
    [[no_unique_address]] typename space_type::crossings crossings;

    scene(engine_settings<P> s, body_type bodies, boundary_type around, space_type in)
        : settings(std::move(s)), grains(std::move(bodies)), boundary(std::move(around)), space(std::move(in)) {}

    // ---- what is asked of them everywhere ---------------------------------------------------------------------------
    static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
    const vec3& position(std::int32_t pebble) const { return grains.pebbles[at(pebble)].x; } ///< m
    double radius(std::int32_t pebble) const { return grains.pebbles[at(pebble)].radius; }   ///< m
    auto body_of() const {
        return [this](std::int32_t pebble) { return grains.body_of(pebble); };
    }
    /// Two pebbles that overlap by `depth` (m), as a law sees them along their normal.
    contacts::overlap<double> overlap_of(const pebble_pair& p, double depth) const {
        return {0,
                0,
                1,
                depth,
                1.0 / radius(p.i),
                1.0 / radius(p.j),
                grains.inverse_mass_of(p.i),
                grains.inverse_mass_of(p.j),
                material(p.i),
                material(p.j)};
    }
    /// Of a pebble, by its number; -1 where the law reads none.
    double material([[maybe_unused]] std::int32_t pebble) const {
        if constexpr (contacts::reads_materials<contact>()) return grains.materials[at(pebble)];
        return -1.0;
    }
    /// Two of the smallest pebbles, of bodies of the smallest mass.
    contacts::overlap<double> typical_overlap(double depth) const {
        const double curvature = 1.0 / smallest_radius, inverse_mass = 1.0 / smallest_mass;
        return {0, 0, 1, depth, curvature, curvature, inverse_mass, inverse_mass};
    }
    /// The same for a pebble at a wall.
    contacts::overlap<double> overlap_at_wall(std::int32_t pebble, double depth) const {
        return {0, 0, 1, depth, 1.0 / radius(pebble), 0.0, grains.inverse_mass_of(pebble), 0.0, material(pebble), -1.0};
    }
    /// Whether a wall has friction.
    bool walls_rub() const {
        if constexpr (has_walls && contacts::frictional<contact> && !std::is_empty_v<history>)
            return settings.platen_contact.mu > 0.0 || settings.lateral_contact.mu > 0.0;
        return false;
    }
    /// Order of the lists: by first body, second pebble, first pebble.
    auto pair_order() const {
        return [this](const pebble_pair& a, const pebble_pair& b) {
            const std::size_t ga = grains.group_of(a.i), gb = grains.group_of(b.i);
            return ga != gb ? ga < gb : a.j != b.j ? a.j < b.j : a.i < b.i;
        };
    }
    /// f(k) for the heavy contacts in the order that one thread gives them.
    template <class F> void each_heavy(F&& f) const { heavy.each_in_order(pair_order(), f); }
    /// From pebble i to the image of pebble j that pair k of a list means (m).
    vec3 apart(const pair_list& list, std::size_t k) const {
        const pebble_pair& p = list.pairs[k];
        return space.across(position(p.j) - position(p.i), list.image_of(k));
    }
    void index_heavy() {
        if (!heavy_of)
            heavy_of = incidence(
                grains.body_count(), heavy, [&](auto&& f) { each_heavy(f); }, heavy_wall, body_of());
    }
    void index_light() {
        light_of = incidence(
            grains.movable_count(), light, [&](auto&& f) { light.each_in_order(pair_order(), f); }, light_wall,
            body_of());
    }

    /// Calls f(row, pair) for all contacts listed in the last step, in an order that does not depend on threads; body
    /// ids of a pair through grains.body_of. Before the first step there are none.
    template <class F> void each_contact(F&& f) const {
        if (!heavy.rows.empty()) each_heavy([&](std::size_t k) { f(heavy.rows[k], heavy.pairs[k]); });
        if constexpr (breakable) // else there are no light ones, nor the time to compile f for them
            for (std::size_t k = 0; k < light.size(); ++k) f(light.rows[k], light.pairs[k]);
    }
    template <class F> void each_wall_row(F&& f) const {
        if constexpr (has_walls)
            for (const wall_row& w : heavy_wall) f(w);
        if constexpr (has_walls && breakable)
            for (const wall_row& w : light_wall) f(w);
    }
    /// Centre of the body of a pebble (m).
    vec3 centre_of(std::int32_t pebble) const {
        const std::size_t body = grains.body_of(pebble);
        return body < grains.body_count() ? grains.centre(body) : position(pebble);
    }
    /// A body of the sweep as a field saw it `ago` seconds before.
    fields::body_at seen(std::size_t body, double ago = 0.0) const {
        const vec3& v = grains.velocity(body);
        return {grains.body_mass(body), grains.centre(body) - ago * v, v, totals.time - ago};
    }
    /// Of a body of the sweep in the field (J). Velocities are those of the middle of the last step: so is this.
    double potential_energy(std::size_t body) const {
        if constexpr (field_type::acts) return settings.field.potential(seen(body, 0.5 * dt));
        return 0.0;
    }
    static constexpr bool has_outer_forces = field_type::acts || constraint_type::acts;
    /// f(piece, force) for what acts on bodies and fragments from outside (N): field, pushes and reactions of
    /// constraints in the last step.
    template <class F> void each_outer_force(F&& f) const {
        for (std::size_t b = 0; has_outer_forces && b < grains.body_count(); ++b) {
            if (!grains.is_swept(b)) continue;
            if constexpr (field_type::acts) f(b, settings.field.force(seen(b)));
            if constexpr (constraint_type::acts) f(b, constraint.outer_force(b));
        }
        if constexpr (field_type::acts && breakable)
            broken.each_ball(grains, [&](std::int32_t p, const body_motion& m) {
                f(broken.piece_of(grains, p),
                  settings.field.force({grains.ball_mass(at(p)), m.x, m.v, totals.time - broken.lag}));
            });
    }
    /// From the centre of the first body of a contact to that of the second, through the contact (m): right across the
    /// faces of a periodic cell, too.
    vec3 branch_of(const force_row& row, const pebble_pair& pair) const {
        const vec3 between = (radius(pair.i) + radius(pair.j) - row.depth) * row.normal;
        if constexpr (body_type::turns)
            return position(pair.i) - centre_of(pair.i) + between + centre_of(pair.j) - position(pair.j);
        return between;
    }

    /// State, list order and reference positions included. Rows are not part of it, because a step writes all of them
    /// before it reads any; events must have been taken.
    template <class A> void archive(A& a) {
        a(grains, boundary, space, settings.grain_contact, breakage_on, totals, dt, light_steps, estimate_due);
        a(drives, near, heavy, heavy_wall, heavy_grip, light, light_wall, light_grip, light_of, asleep, listed,
          unlisted, memory);
        if constexpr (A::reading) { // of shapes that were made on the way
            broken.make_pools(grains, settings);
            smallest_mass = grains.smallest_mass();
        }
        broken.archive(a);
        replacing.archive(a);
        constraint.archive(a);
    }
};

} // namespace clast
