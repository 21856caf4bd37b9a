// SPDX-License-Identifier: MIT
// Clumps of pebbles, and balls where they break: their tables, and how clumps move. Pebbles are for ever; owners
// change.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <clast/bodies/clump_strip.hpp>
#include <clast/bodies/concepts.hpp>
#include <clast/bodies/contact_list.hpp>
#include <clast/core/packs.hpp>
#include <clast/core/vector.hpp>
#include <clast/grains/shape.hpp>
#include <clast/integrators/rotation.hpp>

namespace clast {

/// Where a mother grain is in the tables, and what has become of it.
struct grain {
    std::int32_t first = 0;          ///< first pebble; a grain's pebbles are consecutive
    std::int32_t shape = 0;          ///< index into the shapes
    std::int32_t cluster = is_whole; ///< number in the cluster pool of its shape once it is a cluster
    std::int32_t id = 0;             ///< its number for life; its place in the table grows as others are split
    double scale = 1.0;              ///< its size over that of its shape
    double density_ratio = 1.0;      ///< its density over that of the specimen
    /// The number for life of the grain whose bonds it has and by which its strength scatters: its own, or where it was
    /// made of balls (clumps::freeze) that of the grain that had become these.
    std::int32_t origin = 0;
    std::int32_t lost = 0; ///< bonds that its origin had lost when it froze

    static constexpr std::int32_t is_whole = -1; ///< a clump
    static constexpr std::int32_t is_loose = -2; ///< balls that no bond joins
};

/// A run of consecutive pebbles of a grain that becomes a clump of its own.
struct clump_part {
    std::int32_t first = 0; ///< counted from the grain's first pebble
    std::int32_t shape = 0; ///< made of these pebbles (part_of): its frame is that of the grain's shape
};

/// Orientation and angular momentum of a clump (world axes), in blocks of four numbers like its motion.
struct alignas(32) clump_rotation {
    quaternion q;
    vec3 l; ///< kg m^2/s
    double spare = 0.0;
};

namespace bodies {

/// Grains, pebbles and their bodies. Body g (g < grains) is the clump of grain g; body grains + p is the ball of pebble
/// p, which exists only in a breakable specimen. `owner` says which of them moves a pebble now.
struct clumps {
    std::vector<shape> shapes;
    double density = 2650.0; ///< kg/m^3

    std::vector<grain> grains;
    std::vector<clump_pebble> pebbles;   ///< per pebble; of clumps only those in a contact list are kept up to date
    std::vector<std::int32_t> mother;    ///< per pebble: its grain
    std::vector<std::int32_t> owner;     ///< per pebble: its body
    std::vector<body_motion> motion;     ///< per body
    std::vector<clump_rotation> turning; ///< per grain
    std::vector<body_losses> losses;     ///< per body
    std::vector<std::uint8_t>
        materials; ///< per pebble, for laws that read them; those behind its end are of material 0

    /// Per pebble its number for life, which is its place as long as no grain has been cut across the order of its
    /// pebbles; empty until then.
    std::vector<std::int32_t> numbers;

    /// What clumps of one shape have in common, at scale 1; made with the first grain of it, so shapes and density must
    /// not change after that.
    struct constants {
        vec3 inverse_inertia; ///< 1/(kg m^2), body axes
        double reach;         ///< radius of the circumscribed sphere (m)
        double mass;          ///< kg
    };
    std::vector<constants> of_shape;

    std::size_t grain_count() const { return grains.size(); }
    std::size_t pebble_count() const { return pebbles.size(); }
    const shape& shape_of(const grain& g) const { return shapes[static_cast<std::size_t>(g.shape)]; }
    /// Number of a grain for reports: it stays when others are cut into parts.
    std::int32_t number_of(std::size_t g) const { return grains[g].id; }
    /// Number of a pebble for reports: it stays when places are exchanged.
    std::int32_t number_of_pebble(std::int32_t pebble) const {
        return numbers.empty() ? pebble : numbers[static_cast<std::size_t>(pebble)];
    }
    bool is_clump(std::size_t g) const { return grains[g].cluster == grain::is_whole; }
    /// Number of the body that a pebble is when it moves on its own.
    std::size_t ball(std::int32_t pebble) const { return grains.size() + static_cast<std::size_t>(pebble); }
    double mass_of(const grain& g) const {
        return of_shape[static_cast<std::size_t>(g.shape)].mass * (g.scale * g.scale * g.scale * g.density_ratio);
    }
    double diameter_of(const grain& g) const { return shape_of(g).diameter * g.scale; } ///< nominal: grain_size (m)
    /// Of all its pebbles (m^3).
    double volume_of(const grain& g) const { return shape_of(g).volume * (g.scale * g.scale * g.scale); }
    double ball_mass(std::size_t p) const { return ball_density(p) * sphere_volume(pebbles[p].radius); }
    double ball_inertia(std::size_t p) const { return ball_density(p) * sphere_inertia_per_density(pebbles[p].radius); }
    vec3 inverse_inertia(const grain& g) const { ///< 1/(kg m^2), body axes
        return (1.0 / inertia_ratio(g)) * of_shape[static_cast<std::size_t>(g.shape)].inverse_inertia;
    }
    /// Of all grains (m^3): pebble by pebble where they do not overlap, and so invariant under replacement.
    double solid_volume() const {
        double v = 0.0;
        for (std::size_t g = 0; g < grains.size(); ++g) {
            const index_range own = pebbles_of(g);
            if (shape_of(grains[g]).overlapping)
                v += volume_of(grains[g]);
            else
                for (std::size_t p = own.begin; p < own.end; ++p) v += sphere_volume(pebbles[p].radius);
        }
        return v;
    }

    /// Adds a shape, and returns its number.
    std::int32_t kind_of(const shape& s) {
        shapes.push_back(s);
        return static_cast<std::int32_t>(shapes.size() - 1);
    }
    /// Adds a clump at rest, of `scale` times the size of its shape, and returns its grain id.
    std::int32_t add(std::int32_t shape_index, const vec3& centre, const quaternion& q, double scale = 1.0) {
        const auto id = static_cast<std::int32_t>(grains.size());
        const shape& s = shapes[static_cast<std::size_t>(shape_index)];
        note_shapes();
        grains.push_back({static_cast<std::int32_t>(pebbles.size()), shape_index, grain::is_whole, id, scale, 1.0, id});
        for (const shape_pebble& p : s.pebbles) {
            pebbles.push_back({centre + rotate(q, scale * p.offset), scale * p.radius});
            mother.push_back(id);
            owner.push_back(id);
        }
        motion.push_back({centre, {}, {}, 1.0 / mass_of(grains.back())});
        turning.push_back({q, {}});
        losses.push_back({});
        return id;
    }

    /// Makes a clump one of another material (contacts::by_material) and density, over that of the specimen (> 0). Its
    /// spin becomes 0.
    void set_material(std::size_t g, std::uint8_t material, double density_ratio = 1.0) {
        materials.resize(pebbles.size(), 0);
        for (std::size_t p = pebbles_of(g).begin; p < pebbles_of(g).end; ++p) materials[p] = material;
        grains[g].density_ratio = density_ratio;
        motion[g].inverse_mass = 1.0 / mass_of(grains[g]);
        set_spin(g, {});
    }

    /// A clump becomes several, in the same place and with the same motion: momentum, angular momentum and kinetic
    /// energy are kept to rounding. The parts stand in the grain's place, in the order of their pebbles, which they
    /// share out among them without rest; grains behind it move up, so contact lists stay sorted by bodies. The first
    /// part keeps the number for life and the losses. Pebbles must have been placed.
    template <class = void> // else every program would compile it
    void split(std::size_t g, std::span<const clump_part> parts) {
        const body_motion moved = motion[g];
        const clump_rotation turned = turning[g];
        const vec3 spin = spin_of(turned.q, turned.l, inverse_inertia(grains[g]));
        divide(g, parts, grains[g].scale);
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const grain& part = grains[g + k];
            const vec3 arm = rotate(turned.q, part.scale * shape_of(part).mass_centre);
            motion[g + k] = {moved.x + arm, moved.v + cross(spin, arm), spin, 1.0 / mass_of(part)};
            const quaternion q = unit(turned.q * shape_of(part).to_input_frame);
            turning[g + k] = {q, rotate(q, scale(inertia_of(part), rotate_back(q, spin)))};
        }
    }
    /// The balls of a grain become clumps, with their momentum and angular momentum; tables as for split(). The frame
    /// of the shapes is that of the world, from the first pebble of each, at scale 1. Returns the kinetic energy that
    /// is lost (J).
    template <class = void> // else every program would compile it
    double freeze(std::size_t g, std::span<const clump_part> parts) {
        std::vector<body_motion> moved;
        std::vector<clump_rotation> turned;
        double lost = 0.0;
        for (const clump_part& part : parts) {
            const shape& form = shapes[static_cast<std::size_t>(part.shape)];
            const auto first = static_cast<std::size_t>(grains[g].first + part.first);
            const vec3 centre = pebbles[first].x + form.mass_centre;
            vec3 momentum, angular;
            for (std::size_t p = first; p < first + form.pebbles.size(); ++p) {
                const body_motion& one = motion[ball(static_cast<std::int32_t>(p))];
                momentum += ball_mass(p) * one.v;
                angular += ball_mass(p) * cross(pebbles[p].x - centre, one.v) + ball_inertia(p) * one.w;
                lost += 0.5 * (ball_mass(p) * norm2(one.v) + ball_inertia(p) * norm2(one.w));
            }
            const double rho = ball_density(first), mass = rho * form.volume;
            const vec3 i = rho * form.inertia_per_density, inverse{1.0 / i.x, 1.0 / i.y, 1.0 / i.z};
            turned.push_back({form.to_input_frame, angular});
            moved.push_back({centre, momentum / mass, spin_of(form.to_input_frame, angular, inverse), 1.0 / mass});
            lost -= 0.5 * norm2(momentum) / mass + rotational_energy(form.to_input_frame, angular, inverse);
        }
        const std::int32_t origin = grains[g].origin;
        divide(g, parts, 1.0);
        for (std::size_t k = 0; k < parts.size(); ++k) grains[g + k].origin = origin;
        for (std::size_t k = 0; k < parts.size(); ++k) motion[g + k] = moved[k], turning[g + k] = turned[k];
        return lost;
    }

    // ---- what an engine asks of bodies that it sweeps (here clumps) ------------------------------------------------
    static constexpr bool turns = true; ///< bodies have an orientation

    /// What displacements are measured from: centre and orientation at the last renewal of the lists.
    struct alignas(32) reference {
        quaternion q;
        vec3 centre;
        double spare = 0.0;
    };

    std::size_t body_count() const { return grains.size(); }
    std::size_t movable_count() const { return motion.size(); } ///< with balls that may be
    bool is_swept(std::size_t g) const { return is_clump(g); }
    std::size_t body_of(std::int32_t pebble) const {
        return static_cast<std::size_t>(owner[static_cast<std::size_t>(pebble)]);
    }
    clump_view view() const { return {pebbles.data(), owner.data(), motion.data(), materials.data()}; }
    /// Of the centre of a pebble of a clump, or of a ball (m/s).
    vec3 velocity_of(std::int32_t pebble) const {
        const std::size_t b = body_of(pebble);
        const body_motion& m = motion[b];
        return b < grains.size() ? m.v + cross(m.w, pebbles[static_cast<std::size_t>(pebble)].x - m.x) : m.v;
    }
    const vec3& spin_of_pebble(std::int32_t pebble) const { return motion[body_of(pebble)].w; } ///< rad/s
    /// Of the body of a pebble (1/kg).
    double inverse_mass_of(std::int32_t pebble) const { return motion[body_of(pebble)].inverse_mass; }
    /// Pebbles of one group stand together; contact lists are sorted by the group of the first pebble.
    std::size_t group_of(std::int32_t pebble) const {
        return static_cast<std::size_t>(mother[static_cast<std::size_t>(pebble)]);
    }
    const vec3& centre(std::size_t g) const { return motion[g].x; }
    const vec3& velocity(std::size_t g) const { return motion[g].v; } ///< of the centre (m/s)
    const vec3& spin(std::size_t g) const { return motion[g].w; }     ///< rad/s
    void set_velocity(std::size_t g, const vec3& v) { motion[g].v = v; }
    /// Puts a clump elsewhere; its pebbles are not placed.
    void set_place(std::size_t g, const vec3& x, const quaternion& q) { motion[g].x = x, turning[g].q = q; }
    /// Sets the angular momentum with it.
    void set_spin(std::size_t g, const vec3& w) {
        motion[g].w = w;
        turning[g].l = rotate(turning[g].q, scale(inertia_of(grains[g]), rotate_back(turning[g].q, w)));
    }
    double bounding_radius(std::size_t g) const { return shape_of(grains[g]).circumscribed_radius * grains[g].scale; }
    index_range pebbles_of(std::size_t g) const {
        const auto first = static_cast<std::size_t>(grains[g].first);
        return {first, first + shape_of(grains[g]).pebbles.size()};
    }
    double body_mass(std::size_t g) const { return mass_of(grains[g]); } ///< kg
    /// kg m^2; infinite about axes whose inverse is 0, about which a clump does not turn.
    vec3 body_inertia(std::size_t g) const {
        vec3 i = inertia_of(grains[g]);
        const vec3 inverse = inverse_inertia(grains[g]);
        for (int a = 0; a < 3; ++a)
            if (inverse[a] == 0.0) i[a] = std::numeric_limits<double>::infinity();
        return i;
    }
    mat3 body_axes(std::size_t g) const { return matrix(turning[g].q); }
    double kinetic_energy(std::size_t g) const {
        return 0.5 * mass_of(grains[g]) * norm2(motion[g].v) +
               rotational_energy(turning[g].q, turning[g].l, inverse_inertia(grains[g]));
    }
    reference refer(std::size_t g) const { return {turning[g].q, motion[g].x}; }
    /// Upper bound (m) of the way that a point of the body has gone since then; stretch: of the space in between.
    double moved(std::size_t g, const reference& since, const vec3& stretch) const {
        return way_of(motion[g].x - scale(stretch, since.centre), since.q, turning[g].q, bounding_radius(g));
    }
    /// Largest speed of a point of the body (m/s) beside a flow with the velocity rate * x.
    double surface_speed(std::size_t g, const vec3& rate) const {
        return norm(motion[g].v - scale(rate, motion[g].x)) + bounding_radius(g) * norm(motion[g].w);
    }
    /// Moves bodies under their loads by a rule (integrators/concepts.hpp), and places those of their pebbles that are
    /// `wanted`. further(body): way (m) to be added to that of a body when
    /// it is held against the allowance. Returns what the most mobile body has used of its own.
    template <class Rule, class Further>
    margin_use advance(std::span<const moving_body> bodies, const Rule& rule, const body_items& wanted,
                       const allowance<reference>& allowed, Further&& further) {
        margin_use use = margin_use::within;
        clump_strip s;
        for (; !bodies.empty(); bodies = bodies.subspan(s.size)) {
            s.size = std::min(clump_strip::length, bodies.size());
            const moving_body* const some = bodies.data();
            const reference* const since = allowed.since.data();
            const vec3 stretch = allowed.stretch;
            with_widest_registers([ =, this, &s ](auto width)
                                      __attribute__((always_inline)) { this->fill(width, s, some, since, stretch); });
            if constexpr (!integrators::forgetful<decltype(rule.scheme)>)
                for (std::size_t k = 0; k < s.size; ++k) s.body[k] = some[k].body;
            clast::advance(s, rule);
            with_widest_registers([ =, this, &s, &wanted ](auto width) __attribute__((always_inline)) {
                for (std::size_t k = 0; k < s.size; k += 4) {
                    axes_of_four axes;
                    this->take(width, s, k, some, axes);
                    for (std::size_t l = 0; l < 4 && k + l < s.size; ++l) {
                        const std::size_t g = some[k + l].body;
                        const placement<width()> to(motion[g], axes[l], shape_of(grains[g]), grains[g].first);
                        for (std::int32_t p : wanted.of(g)) to.put(p, pebbles[static_cast<std::size_t>(p)]);
                    }
                }
            });
            for (std::size_t k = 0; k < s.size; ++k) {
                const std::size_t g = bodies[k].body;
                losses[g].damping += s.damped[k];
                losses[g].friction += bodies[k].load.dissipated;
                use = std::max(use, use_of(s.moved[k] + further(g), allowed.margins[g]));
            }
        }
        return use;
    }
    /// Places the pebbles of a clump, or some of them.
    void place(std::size_t g) {
        const auto to = placement_of(g);
        const index_range all = pebbles_of(g);
        for (std::size_t p = all.begin; p < all.end; ++p) to.put(static_cast<std::int32_t>(p), pebbles[p]);
    }
    void place(std::size_t g, std::span<const std::int32_t> some) {
        const auto to = placement_of(g);
        for (std::int32_t p : some) to.put(p, pebbles[static_cast<std::size_t>(p)]);
    }
    /// Moves a body elsewhere at another velocity (an image in a periodic cell); its pebbles are not placed.
    void shift(std::size_t g, const vec3& by, const vec3& faster) { motion[g].x += by, motion[g].v += faster; }
    double smallest_mass() const {
        double least = std::numeric_limits<double>::infinity();
        for (const grain& one : grains) least = std::min(least, mass_of(one));
        return least;
    }

    template <class A> void archive(A& a) {
        a(shapes, density, of_shape, grains, pebbles, mother, owner, motion, turning, losses, materials, numbers);
    }

  private:
    /// Moments of inertia of a grain over those of its shape in the density of the specimen.
    static double inertia_ratio(const grain& g) {
        return g.scale * g.scale * (g.scale * g.scale) * g.scale * g.density_ratio;
    }
    /// Principal moments (kg m^2).
    vec3 inertia_of(const grain& g) const { return (density * inertia_ratio(g)) * shape_of(g).inertia_per_density; }
    double ball_density(std::size_t p) const { // kg/m^3
        return density * grains[static_cast<std::size_t>(mother[p])].density_ratio;
    }
    /// Gives the pebbles of a grain to so many clumps of one scale in its place, whose motion is still to be set.
    template <class = void> // else every program would compile it
    void divide(std::size_t g, std::span<const clump_part> parts, double scale) {
        note_shapes();
        const std::size_t more = parts.size() - 1, before = grains.size();
        const grain whole = grains[g];
        const auto up = static_cast<std::int32_t>(more), place = static_cast<std::int32_t>(g);
        for (std::int32_t& o : owner) o += o > place ? up : 0; // balls, too, which are numbered behind all grains
        for (std::int32_t& m : mother) m += m > place ? up : 0;
        const auto open = [&](auto& table) {
            table.insert(table.begin() + static_cast<std::ptrdiff_t>(g) + 1, more, {});
        };
        open(grains), open(motion), open(turning), open(losses);
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const std::int32_t id = k == 0 ? whole.id : static_cast<std::int32_t>(before + k - 1);
            grains[g + k] = {
                whole.first + parts[k].first, parts[k].shape, grain::is_whole, id, scale, whole.density_ratio,
                k == 0 ? whole.origin : id};
            const index_range own = pebbles_of(g + k);
            for (std::size_t p = own.begin; p < own.end; ++p) mother[p] = owner[p] = static_cast<std::int32_t>(g + k);
        }
    }
    void note_shapes() {
        for (std::size_t k = of_shape.size(); k < shapes.size(); ++k) {
            const double m = density * shapes[k].volume;
            const vec3 i = density * shapes[k].inertia_per_density;
            of_shape.push_back({{1.0 / i.x, 1.0 / i.y, 1.0 / i.z}, shapes[k].circumscribed_radius, m});
        }
    }
    /// Where the pebbles of a clump are: x = X + (scale R) o, by columns of scale R.
    template <std::size_t N> class placement {
      public:
        [[gnu::always_inline]] placement(const body_motion& m, const double (&axes)[3][4], const shape& s,
                                         std::int32_t first)
            : pebbles_(s.pebbles.data()), first_(first),
              x_(quad<N>::load(&m)), axes_{quad<N>::load(axes[0]), quad<N>::load(axes[1]), quad<N>::load(axes[2])} {}
        [[gnu::always_inline]] void put(std::int32_t p, clump_pebble& to) const {
            const vec3& o = pebbles_[p - first_].offset;
            const quad<N> x = x_ + (o.x * axes_[0] + o.y * axes_[1] + o.z * axes_[2]);
            x.with_fourth_of(quad<N>::load(&to)).store(&to);
        }

      private:
        const shape_pebble* pebbles_;
        std::int32_t first_;
        quad<N> x_, axes_[3];
    };
    placement<own_width::value> placement_of(std::size_t g) const {
        const mat3 m = grains[g].scale * matrix(turning[g].q);
        const double axes[3][4] = {
            {m(0, 0), m(1, 0), m(2, 0)}, {m(0, 1), m(1, 1), m(2, 1)}, {m(0, 2), m(1, 2), m(2, 2)}};
        return {motion[g], axes, shape_of(grains[g]), grains[g].first};
    }
    /// Fills a strip whose size is set with bodies and where displacements count from; unused lanes repeat the last
    /// body.
    template <std::size_t N, std::size_t Loop>
    [[gnu::always_inline]] void fill(register_width<N, Loop>, clump_strip& s, const moving_body* bodies,
                                     const reference* since, const vec3& stretch) const {
        using row = quad<N>;
        constexpr std::size_t block = quad_size;
        for (std::size_t k = 0; k < s.lanes(); k += 4) {
            const std::byte *load[4], *move[4], *turn[4], *then[4], *common[4];
            double reach[4], per_inertia[4];
            for (std::size_t l = 0; l < 4; ++l) {
                const moving_body& one = bodies[std::min(k + l, s.size - 1)];
                const std::size_t g = one.body;
                const constants& c = of_shape[static_cast<std::size_t>(grains[g].shape)];
                const double scale = grains[g].scale;
                load[l] = bytes_of(one.load), move[l] = bytes_of(motion[g]), turn[l] = bytes_of(turning[g]);
                then[l] = bytes_of(since[g]), common[l] = bytes_of(c);
                reach[l] = c.reach * scale;
                s.scale[k + l] = scale;
                per_inertia[l] = 1.0 / inertia_ratio(grains[g]);
            }
            row r[4];
            const auto each = [&r](const std::byte* const(&records)[4], std::size_t where, double* a, double* b,
                                   double* c) __attribute__((always_inline)) {
                row::load(records, where, r);
                row::columns(r, a, b, c);
            };
            each(load, 0, s.fx + k, s.fy + k, s.fz + k);
            each(load, block, s.mx + k, s.my + k, s.mz + k);
            each(move, 0, s.x + k, s.y + k, s.z + k);
            each(move, block, s.vx + k, s.vy + k, s.vz + k), row::fourth_column(r, s.inverse_mass + k);
            each(move, 2 * block, s.wx + k, s.wy + k, s.wz + k);
            each(turn, 0, s.qw + k, s.qx + k, s.qy + k), row::fourth_column(r, s.qz + k);
            each(turn, block, s.lx + k, s.ly + k, s.lz + k);
            each(then, 0, s.tw + k, s.tx + k, s.ty + k), row::fourth_column(r, s.tz + k);
            each(then, block, s.cx + k, s.cy + k, s.cz + k);
            each(common, 0, s.ix + k, s.iy + k, s.iz + k);
            row(reach[0], reach[1], reach[2], reach[3]).store(s.reach + k);
            for (std::size_t l = 0; l < 4; ++l)
                s.ix[k + l] *= per_inertia[l], s.iy[k + l] *= per_inertia[l], s.iz[k + l] *= per_inertia[l];
            for (std::size_t l = k; l < k + 4; ++l) s.cx[l] *= stretch.x, s.cy[l] *= stretch.y, s.cz[l] *= stretch.z;
        }
    }
    /// Columns of the matrices of four orientations, times the scales, with a spare number each.
    using axes_of_four = double[4][3][4];
    /// Takes the new state of up to four bodies from place k of a strip on.
    template <std::size_t N, std::size_t Loop>
    [[gnu::always_inline]] void take(register_width<N, Loop>, const clump_strip& s, std::size_t k,
                                     const moving_body* bodies, axes_of_four& axes) {
        static constexpr double nothing[4] = {};
        const auto each = [&](auto& records, std::size_t block, const double* a, const double* b, const double* c,
                              const double* d) __attribute__((always_inline)) {
            quad<N> record[4];
            quad<N>::records(a, b, c, d, record);
            for (std::size_t l = 0; l < 4 && k + l < s.size; ++l)
                record[l].store(reinterpret_cast<std::byte*>(&records[bodies[k + l].body]) + block);
        };
        constexpr std::size_t block = quad_size;
        each(motion, 0, s.x + k, s.y + k, s.z + k, nothing);
        each(motion, block, s.vx + k, s.vy + k, s.vz + k, s.inverse_mass + k);
        each(motion, 2 * block, s.wx + k, s.wy + k, s.wz + k, nothing);
        each(turning, 0, s.nw + k, s.nx + k, s.ny + k, s.nz + k);
        each(turning, block, s.lx + k, s.ly + k, s.lz + k, nothing);
        const auto column = [&](std::size_t c, const double* x, const double* y, const double* z)
            __attribute__((always_inline)) {
            quad<N> record[4];
            quad<N>::records(x, y, z, nothing, record);
            for (std::size_t l = 0; l < 4; ++l) (s.scale[k + l] * record[l]).store(axes[l][c]);
        };
        column(0, s.r00 + k, s.r10 + k, s.r20 + k);
        column(1, s.r01 + k, s.r11 + k, s.r21 + k);
        column(2, s.r02 + k, s.r12 + k, s.r22 + k);
    }
};

} // namespace bodies
} // namespace clast
