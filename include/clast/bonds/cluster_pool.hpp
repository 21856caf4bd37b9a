// SPDX-License-Identifier: MIT
// Bonded clusters of one shape, advanced with small steps of their own (multirate), eight clusters side by side.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <clast/bonds/lattice.hpp>
#include <clast/bonds/likeness.hpp>
#include <clast/bonds/parallel.hpp>
#include <clast/measure/sample.hpp>

namespace clast::bonds {

/// What a ball of a cluster brings into a sub-cycle and takes out of it.
struct ball_motion {
    vec3 velocity;      ///< m/s
    vec3 spin;          ///< rad/s
    vec3 position = {}; ///< at the middle of the step (m)
};

/// A bond that failed in a sub-cycle.
struct break_report {
    std::int32_t cluster;
    std::int32_t bond;
    break_mode mode;
    state before;      ///< what it carried (world axes)
    std::int32_t step; ///< of the sub-cycle, in which it failed
};
/// Order in which the breaks of one sub-cycle are told, wherever the clusters sat: eight clusters after the other by
/// their numbers, of these by steps, then bonds, then clusters.
inline bool told_before(const break_report& a, const break_report& b) {
    const auto key = [](const break_report& r) {
        return std::tuple(r.cluster / static_cast<std::int32_t>(clast::lanes), r.step, r.bond, r.cluster);
    };
    return key(a) < key(b);
}

/// Clusters of one shape, each of a size of its own. Eight clusters sit side by side in the lanes of a batch, so that
/// one loop over the lanes does the same bond of eight clusters: the compiler makes vectors of it, whatever the
/// instruction set. No lane reads another, so a cluster gives the same bits wherever it sits, and may change its seat:
/// pack() puts clusters that have about the same bonds left together, for a bond that is broken in all lanes costs
/// nothing.
///
/// A cluster of another size or density than the lattice is computed as the similar one of the lattice's own
/// (likeness): the factor of its stiffness is `alive` in a lane. So sizes cost nothing in the loops.
///
/// A cluster is sub-cycled: external loads are frozen over an outer step, and the bonds are integrated with leapfrog
/// steps small enough for the stiffest mode of the intact shape at its scale (removing bonds only lowers it).
/// Frequencies are rounded up to a quarter of an octave above that of scale 1, and a batch takes clusters of one such
/// class.
class cluster_pool {
  public:
    static constexpr std::size_t lanes = clast::lanes;

    cluster_pool() = default;
    /// damping: coefficient of local damping in [0, 1).
    cluster_pool(lattice shape, double damping) : shape_(std::move(shape)), damping_(damping) {}

    const lattice& shape() const { return shape_; }
    std::size_t size() const { return size_; }
    /// Batches that may have intact bonds.
    std::size_t batches() const { return (occupied_ + lanes - 1) / lanes; }
    /// The cluster in a lane of a batch; -1 if it has no intact bond, or nobody sits there.
    std::int32_t living(std::size_t batch, std::size_t lane) const {
        const std::size_t seat = batch * lanes + lane;
        return seat < sitting_.size() && intact_[seat] > 0 ? sitting_[seat] : -1;
    }
    std::size_t bonds() const { return shape_.ends.size(); }

    /// Adds a cluster with the given bond states, the strength of its bonds over the material's (> 0), and what it is
    /// like; returns its number.
    std::size_t add(const std::vector<state>& born, double strength = 1.0, likeness to = {}) {
        const std::size_t c = size_++, seat = sitting_.size(); // behind all others
        seat_.push_back(static_cast<std::int32_t>(seat));
        sitting_.push_back(static_cast<std::int32_t>(c));
        make_room();
        occupied_ = sitting_.size();
        like_[seat] = to;
        strength_[seat] = strength / (to.scale * to.scale * to.density);
        const double stiffness = stiffness_of(to);
        for (std::size_t b = 0; b < bonds(); ++b) {
            put(seat, b, scaled(born[b], to.inverse()));
            value(seat, b, alive) = stiffness;
        }
        intact_[seat] = static_cast<std::int32_t>(bonds());
        return c;
    }

    /// Lets go of all bonds of a cluster; its number stays, for nobody.
    void dissolve(std::size_t cluster) {
        const std::size_t seat = seat_of(cluster);
        for (std::size_t b = 0; b < bonds(); ++b) put(seat, b, {}), value(seat, b, alive) = 0.0;
        intact_[seat] = 0;
    }

    /// Gives clusters new seats if bonds broke or clusters came since the last time: those of one class of frequencies
    /// in batches of their own, with many bonds first, of equally many those with the same bonds side by side; those
    /// without any behind all batches.
    template <class = void> // else every program would compile it
    void pack() {
        const std::int64_t left = std::accumulate(intact_.begin(), intact_.end(), std::int64_t{0});
        if (std::exchange(packed_clusters_, size_) == size_ && packed_bonds_ == left) return;
        packed_bonds_ = left;
        std::vector<std::int32_t> order(size_);
        std::iota(order.begin(), order.end(), 0);
        std::vector<int> rank(size_); // of classes; those without bonds come last
        for (std::size_t c = 0; c < size_; ++c)
            rank[c] = intact_[seat_of(c)] == 0 ? std::numeric_limits<int>::max() : class_of(like_[seat_of(c)]);
        const auto rank_of = [&rank](std::int32_t c) { return rank[static_cast<std::size_t>(c)]; };
        std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
            const std::size_t i = seat_of(a), j = seat_of(b);
            if (rank_of(a) != rank_of(b)) return rank_of(a) < rank_of(b);
            if (intact_[i] != intact_[j]) return intact_[i] > intact_[j];
            for (std::size_t bond = 0; intact_[i] > 0 && bond < bonds(); ++bond)
                if (is_alive(i, bond) != is_alive(j, bond)) return is_alive(i, bond);
            return a < b;
        });
        std::vector<std::int32_t> seats;
        occupied_ = 0;
        for (std::size_t k = 0; k < size_; ++k) {
            if (k > 0 && rank_of(order[k]) != rank_of(order[k - 1])) seats.resize(whole_lanes(seats.size()), nobody);
            seats.push_back(order[k]);
            if (intact_[seat_of(order[k])] > 0) occupied_ = seats.size();
        }
        seat(seats);
    }

    bool is_intact(std::size_t cluster, std::size_t bond) const { return is_alive(seat_of(cluster), bond); }
    std::int32_t intact_bonds(std::size_t cluster) const { return intact_[seat_of(cluster)]; }
    likeness like(std::size_t cluster) const { return like_[seat_of(cluster)]; }
    state get(std::size_t cluster, std::size_t bond) const {
        return scaled(carried(seat_of(cluster), bond), like(cluster));
    }
    /// Load of a bond over its strength (load_ratio): it fails at 1.
    double load_of(std::size_t cluster, std::size_t bond) const {
        return load_ratio(shape_.bond[bond], carried(seat_of(cluster), bond)) / strength_[seat_of(cluster)];
    }
    /// Elastic energy in the bonds of a cluster (J).
    double energy(std::size_t cluster) const {
        double e = 0.0;
        for (std::size_t b = 0; b < bonds(); ++b)
            if (is_intact(cluster, b)) e += bonds::energy(shape_.bond[b], carried(seat_of(cluster), b));
        return like(cluster).energy() / stiffness_of(like(cluster)) * e;
    }
    /// Elastic energy (J) of one bond of a cluster in a state.
    double energy_of(std::size_t cluster, std::size_t bond, const state& s) const {
        const likeness to = like(cluster);
        return to.energy() / stiffness_of(to) * bonds::energy(shape_.bond[bond], scaled(s, to.inverse()));
    }

    /// Number of inner steps for an outer step (s) of a cluster: its highest mode turns by at most 1 rad per
    /// inner step. Local damping a stiffens a mode by up to (1 + a), so the leapfrog limit of 2 rad shrinks to 1.53 at
    /// a = 0.7; the rest is margin.
    int substeps(double dt, likeness to = {}) const { return substeps_of(dt, class_of(to)); }

    /// Longest step (s) that all clusters with intact bonds take at once (substeps() == 1); infinite without any.
    double longest_step() const {
        int most = std::numeric_limits<int>::min();
        for (std::size_t batch = 0; batch < batches(); ++batch) most = std::max(most, class_of_batch(batch));
        return most == std::numeric_limits<int>::min() ? std::numeric_limits<double>::infinity()
                                                       : 1.0 / frequency_of(most);
    }

    /// Advances the clusters of a batch by dt under frozen loads. `balls` and `load` hold the pebbles of the lanes,
    /// lane by lane (lanes x pebbles); `displacement` receives how far each ball moved. Normals are those of the middle
    /// of the step: with those of its start, a 4B that turns by a quarter at 200 rad/s in steps of 1 us strains its
    /// bonds by 100 N, with these by 0.01 N. Clusters without intact bonds, and empty lanes, are left alone. Returns
    /// the energy taken out by damping per lane; broken bonds are appended to `broken`, ordered by step, bond and lane.
    std::array<double, lanes> advance(std::size_t batch, double dt, std::span<ball_motion> balls,
                                      std::span<const pebble_load> load, std::span<vec3> displacement,
                                      std::vector<break_report>& broken) {
        const std::size_t n = shape_.size();
        std::array<double, lanes> dissipated{};
        std::array<double, lanes> live{};
        for (std::size_t l = 0; l < lanes; ++l) live[l] = living(batch, l) >= 0 ? 1.0 : 0.0;
        const auto lives = std::count(live.begin(), live.end(), 1.0);
        if (lives == 0) return dissipated;

        // lane-wise: v, w, external f and t, displacement (positions before that), summed f and t, normals
        const std::size_t vectors = n * 3 * lanes;
        const auto scratch = std::make_unique_for_overwrite<double[]>(7 * vectors + bonds() * 3 * lanes);
        double* const v = scratch.get();
        double* const w = v + vectors;
        double* const fe = w + vectors;
        double* const te = fe + vectors;
        double* const u = te + vectors;
        double* const f = u + vectors;
        double* const t = f + vectors;
        double* const axis = t + vectors;
        if (lives < static_cast<std::ptrdiff_t>(lanes)) std::fill(v, f, 0.0); // what empty lanes read
        const auto at = [](std::size_t item, std::size_t component, std::size_t lane) {
            return (item * 3 + component) * lanes + lane;
        };
        for (std::size_t l = 0; l < lanes; ++l) {
            if (live[l] == 0.0) continue;
            const likeness& to = like_[batch * lanes + l];
            const double per_length = 1.0 / to.scale, per_force = 1.0 / to.force();
            for (std::size_t i = 0; i < n; ++i) {
                const ball_motion& ball = balls[l * n + i];
                const pebble_load& external = load[l * n + i];
                for (int a = 0; a < 3; ++a) {
                    const std::size_t k = at(i, static_cast<std::size_t>(a), l);
                    v[k] = per_length * ball.velocity[a], w[k] = ball.spin[a];
                    fe[k] = per_force * external.force[a], te[k] = per_force * per_length * external.moment[a];
                    u[k] = ball.position[a]; // for directions only
                }
            }
        }
        std::vector<std::size_t> left; // bonds that a lane has left, in the end the fewest
        left.reserve(bonds());
        for (std::size_t b = 0; b < bonds(); ++b)
            if (!all_zero8(values_.data() + base(batch, b) + alive * lanes)) left.push_back(b);
        with_widest_registers([ =, this, &left ](auto width) __attribute__((always_inline)) {
            turn_along<lanes_of<decltype(width)>>(batch, left, dt, w, u, axis);
        });
        const int steps = substeps_of(dt, class_of_batch(batch));
        const double h = dt / steps;
        // half a drift at either end, so that a step of one sub-step is of second order, too
        for (std::size_t k = 0; k < vectors; ++k) u[k] = 0.5 * h * v[k];
        const auto stretch_bonds = [&](int step, double span) {
            if (with_widest_registers([ =, this, &left ](auto width) __attribute__((always_inline)) {
                    return gather<lanes_of<decltype(width)>>(batch, left, span, v, w, f, t, axis);
                }))
                collect(batch, step, axis, f, t, broken);
        };
        stretch_bonds(0, 0.5 * h);
        for (int step = 1; step <= steps; ++step) {
            with_widest_registers([ =, this, &live, &dissipated ](auto width) __attribute__((always_inline)) {
                kick<lanes_of<decltype(width)>>(h, v, w, fe, te, f, t, u, live, dissipated);
            });
            stretch_bonds(step, step < steps ? h : 0.5 * h);
        }
        for (std::size_t k = 0; k < vectors; ++k) u[k] -= 0.5 * h * v[k];
        for (std::size_t l = 0; l < lanes; ++l) {
            if (live[l] == 0.0) continue;
            const double length = like_[batch * lanes + l].scale;
            dissipated[l] *= like_[batch * lanes + l].energy();
            for (std::size_t i = 0; i < n; ++i)
                for (int a = 0; a < 3; ++a) {
                    const std::size_t k = at(i, static_cast<std::size_t>(a), l);
                    balls[l * n + i].velocity[a] = length * v[k];
                    balls[l * n + i].spin[a] = w[k];
                    displacement[l * n + i][a] = length * u[k];
                }
        }
        return dissipated;
    }

    /// Saved as if everybody sat in the order of their numbers: seats decide no bit.
    template <class A> void archive(A& a) {
        std::vector<std::int32_t> numbers(size_);
        std::iota(numbers.begin(), numbers.end(), 0);
        seat(numbers);
        a(size_, values_, intact_, strength_, like_);
        seat_.resize(size_);
        std::iota(seat_.begin(), seat_.end(), 0);
        sitting_ = seat_;
        occupied_ = size_;
        packed_clusters_ = 0; // to be packed anew
    }

  private:
    /// alive: factor of stiffnesses, 0 where the bond is broken.
    enum field : std::size_t { normal_force = 0, shear = 1, twist = 4, bending = 5, alive = 8, fields = 9 };
    static constexpr std::int32_t nobody = -1;

    /// Stiffness of bonds in the similar cluster over that of the lattice, and class of frequencies.
    double stiffness_of(const likeness& to) const { return to.stiffness(shape_.stiffness_power); }
    int class_of(const likeness& to) const { return to.frequency_class(shape_.stiffness_power); }
    int class_of_batch(std::size_t batch) const {
        int most = std::numeric_limits<int>::min();
        for (std::size_t l = 0; l < lanes; ++l)
            if (living(batch, l) >= 0) most = std::max(most, class_of(like_[batch * lanes + l]));
        return most;
    }
    double frequency_of(int of_class) const { return shape_.highest_frequency * std::exp2(0.25 * of_class); }
    int substeps_of(double dt, int of_class) const {
        return std::max(1, static_cast<int>(std::ceil(dt * frequency_of(of_class))));
    }
    /// Whole batches for all seats.
    void make_room() {
        const std::size_t seats = whole_lanes(sitting_.size());
        values_.resize(seats * bonds() * fields, 0.0);
        intact_.resize(seats, 0);
        strength_.resize(seats, 1.0);
        like_.resize(seats);
    }
    std::size_t base(std::size_t batch, std::size_t bond) const { return (batch * bonds() + bond) * fields * lanes; }
    std::size_t place(std::size_t seat, std::size_t b, std::size_t f) const {
        return base(seat / lanes, b) + f * lanes + seat % lanes;
    }
    double& value(std::size_t seat, std::size_t b, std::size_t f) { return values_[place(seat, b, f)]; }
    double value(std::size_t seat, std::size_t b, std::size_t f) const { return values_[place(seat, b, f)]; }
    std::size_t seat_of(std::size_t cluster) const { return static_cast<std::size_t>(seat_[cluster]); }
    std::size_t seat_of(std::int32_t cluster) const { return seat_of(static_cast<std::size_t>(cluster)); }
    bool is_alive(std::size_t seat, std::size_t bond) const { return value(seat, bond, alive) != 0.0; }
    /// Clusters take seats 0, 1, ... in this order; those of nobody stay empty.
    void seat(const std::vector<std::int32_t>& order) {
        if (order == sitting_) return;
        const auto values = std::exchange(values_, {}), strength = std::exchange(strength_, {});
        const auto like = std::exchange(like_, {});
        const auto intact = std::exchange(intact_, {});
        const auto seats = seat_;
        sitting_ = order;
        make_room();
        for (std::size_t to = 0; to < order.size(); ++to) {
            if (order[to] == nobody) continue;
            const auto from = static_cast<std::size_t>(seats[static_cast<std::size_t>(order[to])]);
            intact_[to] = intact[from];
            strength_[to] = strength[from];
            like_[to] = like[from];
            for (std::size_t b = 0; b < bonds(); ++b)
                for (std::size_t f = 0; f < fields; ++f) value(to, b, f) = values[place(from, b, f)];
            seat_[static_cast<std::size_t>(order[to])] = static_cast<std::int32_t>(to);
        }
    }
    std::size_t end_a(std::size_t b) const { return static_cast<std::size_t>(shape_.ends[b].a); }
    std::size_t end_b(std::size_t b) const { return static_cast<std::size_t>(shape_.ends[b].b); }
    /// Of the similar cluster of the shape's own size, as put() takes it.
    state carried(std::size_t seat, std::size_t b) const {
        return {value(seat, b, normal_force),
                {value(seat, b, shear), value(seat, b, shear + 1), value(seat, b, shear + 2)},
                value(seat, b, twist),
                {value(seat, b, bending), value(seat, b, bending + 1), value(seat, b, bending + 2)}};
    }
    void put(std::size_t seat, std::size_t b, const state& s) {
        value(seat, b, normal_force) = s.n;
        value(seat, b, twist) = s.mt;
        for (int a = 0; a < 3; ++a) {
            value(seat, b, shear + static_cast<std::size_t>(a)) = s.v[a];
            value(seat, b, bending + static_cast<std::size_t>(a)) = s.mb[a];
        }
    }

    /// Turns the bonds `left` of a batch with the balls by a step dt, whose mean positions are x; `axis` receives their
    /// normals.
    template <class L>
    void turn_along(std::size_t batch, const std::vector<std::size_t>& left, double dt, const double* w,
                    const double* x, double* axis) {
        for (const std::size_t b : left)
            for (std::size_t part = 0; part < lanes; part += lanes_in<L>) {
                double* const s = values_.data() + base(batch, b) + part;
                const std::size_t i = end_a(b) * 3 * lanes + part, j = end_b(b) * 3 * lanes + part;
                const vec3_of<L> d = load3<L>(x + j) - load3<L>(x + i);
                const vec3_of<L> normal = ratio(L{} + 1.0, root(norm2(d))) * d; // zero in lanes without a cluster
                state_of<L> bond{{}, load3<L>(s + shear * lanes), {}, load3<L>(s + bending * lanes)};
                turn(bond, normal, 0.5 * (load3<L>(w + i) + load3<L>(w + j)), dt);
                store3(s + shear * lanes, bond.v);
                store3(s + bending * lanes, bond.mb);
                store3(axis + b * 3 * lanes + part, normal);
            }
    }

    /// Kick of all balls of a batch by external and bond loads with local damping, then their drift.
    template <class L>
    void kick(double h, double* v, double* w, const double* fe, const double* te, const double* f, const double* t,
              double* u, const std::array<double, lanes>& live, std::array<double, lanes>& dissipated) const {
        const std::size_t n = shape_.size();
        for (std::size_t part = 0; part < lanes; part += lanes_in<L>) {
            const L on = load<L>(live.data() + part);
            L work{};
            for (std::size_t i = 0; i < n; ++i) {
                const double per_mass = h / shape_.mass[i], per_inertia = h / shape_.inertia[i];
                for (std::size_t k = i * 3 * lanes + part; k < (i + 1) * 3 * lanes; k += lanes) {
                    const L force = on * (load<L>(fe + k) + load<L>(f + k));
                    const L moment = on * (load<L>(te + k) + load<L>(t + k));
                    const L v0 = load<L>(v + k), w0 = load<L>(w + k);
                    const L fd = damping_ * magnitude(force) * sign_of(v0);
                    const L td = damping_ * magnitude(moment) * sign_of(w0);
                    const L v1 = v0 + per_mass * (force - fd), w1 = w0 + per_inertia * (moment - td);
                    work += fd * (v0 + v1) + td * (w0 + w1);
                    store(v + k, v1);
                    store(w + k, w1);
                    store<L>(u + k, load<L>(u + k) + h * v1);
                }
            }
            double* const sum = dissipated.data() + part;
            store<L>(sum, load<L>(sum) + 0.5 * h * work);
        }
    }

    /// Stretches the bonds `left` of a batch by a step h and sums their loads per ball. True if a bond of a lane fails.
    template <class L>
    bool gather(std::size_t batch, const std::vector<std::size_t>& left, double h, const double* v, const double* w,
                double* f, double* t, const double* axis) {
        const std::size_t n = shape_.size();
        std::fill(f, f + n * 3 * lanes, 0.0);
        std::fill(t, t + n * 3 * lanes, 0.0);
        L worst = L{} - 1.0;
        for (const std::size_t b : left)
            for (std::size_t part = 0; part < lanes; part += lanes_in<L>) {
                const L strength = load<L>(strength_.data() + batch * lanes + part);
                double* const s = values_.data() + base(batch, b) + part;
                const constants& c = shape_.bond[b];
                const std::size_t i = end_a(b) * 3 * lanes + part, j = end_b(b) * 3 * lanes + part;
                const double ra = shape_.arm[b].a, rb = shape_.arm[b].b;
                const vec3_of<L> normal = load3<L>(axis + b * 3 * lanes + part);
                const vec3_of<L> wa = load3<L>(w + i), wb = load3<L>(w + j);
                state_of<L> bond{load<L>(s), load3<L>(s + shear * lanes), load<L>(s + twist * lanes),
                                 load3<L>(s + bending * lanes)};
                const L step = h * load<L>(s + alive * lanes);
                stretch(c, bond, normal, relative_velocity(normal, ra, rb, load3<L>(v + i), wa, load3<L>(v + j), wb),
                        wb - wa, step);
                store(s, bond.n);
                store3(s + shear * lanes, bond.v);
                store(s + twist * lanes, bond.mt);
                store3(s + bending * lanes, bond.mb);
                const auto margin = margins_of(c, bond, strength); // negative where no bond is left: its state is zero
                worst = larger(worst, larger(margin.tension, margin.shear));
                const auto wr = loads(bond, normal, ra, rb);
                store3(f + i, load3<L>(f + i) + wr.force_a);
                store3(f + j, load3<L>(f + j) - wr.force_a);
                store3(t + i, load3<L>(t + i) + wr.moment_a);
                store3(t + j, load3<L>(t + j) + wr.moment_b);
            }
        double largest = worst[0];
        for (std::size_t l = 1; l < lanes_in<L>; ++l) largest = std::max(largest, worst[l]);
        return largest >= 0.0;
    }

    /// Reports and removes the bonds that fail after a gather, and takes their loads off the sums: a failed bond lets
    /// go at once.
    void collect(std::size_t batch, int step, const double* axis, double* f, double* t,
                 std::vector<break_report>& broken) {
        for (std::size_t b = 0; b < bonds(); ++b)
            for (std::size_t l = 0; l < lanes; ++l) {
                const std::size_t c = batch * lanes + l; // its seat
                if (c >= sitting_.size() || !is_alive(c, b)) continue;
                const state s = carried(c, b);
                const failure_flags fails = failing(shape_.bond[b], s, strength_[c]);
                if (!fails.tension && !fails.shear) continue;
                const vec3 normal{axis[(b * 3) * lanes + l], axis[(b * 3 + 1) * lanes + l],
                                  axis[(b * 3 + 2) * lanes + l]};
                const wrench wr = loads(s, normal, shape_.arm[b].a, shape_.arm[b].b);
                for (int a = 0; a < 3; ++a) {
                    const auto k = static_cast<std::size_t>(a) * lanes + l;
                    f[end_a(b) * 3 * lanes + k] -= wr.force_a[a];
                    f[end_b(b) * 3 * lanes + k] += wr.force_a[a];
                    t[end_a(b) * 3 * lanes + k] -= wr.moment_a[a];
                    t[end_b(b) * 3 * lanes + k] -= wr.moment_b[a];
                }
                broken.push_back({sitting_[c], static_cast<std::int32_t>(b),
                                  fails.tension ? break_mode::tension : break_mode::shear, scaled(s, like_[c]), step});
                put(c, b, {});
                value(c, b, alive) = 0.0;
                --intact_[c];
            }
    }

    lattice shape_;
    double damping_ = 0.0;
    std::size_t size_ = 0;
    std::vector<double> values_;        ///< [batch][bond][field][lane]
    std::vector<std::int32_t> intact_;  ///< per seat
    std::vector<double> strength_;      ///< per seat, over that of the material, in the similar cluster
    std::vector<likeness> like_;        ///< per seat
    std::vector<std::int32_t> seat_;    ///< per cluster: lane seat % 8 of batch seat / 8
    std::vector<std::int32_t> sitting_; ///< per seat: who sits there
    std::size_t occupied_ = 0;          ///< clusters behind have no bonds
    std::size_t packed_clusters_ = 0;   ///< when seats were given last
    std::int64_t packed_bonds_ = 0;
};

} // namespace clast::bonds
