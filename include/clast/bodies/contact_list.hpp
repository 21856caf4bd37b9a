// SPDX-License-Identifier: MIT
// Pebbles as contacts see them, the pairs that touch or may touch soon, the history of their contact, and the rows that
// they write and the loads that they add to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <type_traits>
#include <vector>

#include <clast/core/vector.hpp>

namespace clast {

/// What contacts read of a pebble, side by side in memory in three blocks of four numbers. Velocities are those of the
/// pebble's own centre.
struct alignas(32) pebble_motion {
    vec3 x;                       ///< centre (m)
    double radius = 0.0;          ///< m
    vec3 v;                       ///< velocity of the centre (m/s)
    double inverse_mass = 0.0;    ///< of the pebble as a ball (1/kg)
    vec3 w;                       ///< spin of its body (rad/s, world axes)
    double inverse_inertia = 0.0; ///< of the pebble as a ball (1/(kg m^2))
};

/// A pebble of a body whose centre is elsewhere: that body's motion says how it moves.
struct alignas(32) clump_pebble {
    vec3 x;              ///< centre (m)
    double radius = 0.0; ///< m
};
static_assert(sizeof(pebble_motion) == 12 * sizeof(double) && sizeof(clump_pebble) == 4 * sizeof(double));

/// Motion of a body (clump or ball): centre at t_n, velocities over the step that led to t_n. In blocks of four
/// numbers, as contacts read them.
struct alignas(32) body_motion {
    vec3 x;                    ///< mass centre (m)
    double spare_x = 0.0;      ///< fills the block
    vec3 v;                    ///< m/s
    double inverse_mass = 0.0; ///< 1/kg
    vec3 w;                    ///< rad/s, world axes
    double spare_w = 0.0;      ///< fills the block

    body_motion() = default;
    body_motion(const vec3& centre, const vec3& velocity, const vec3& spin, double inverse)
        : x(centre), v(velocity), inverse_mass(inverse), w(spin) {}
};
static_assert(sizeof(body_motion) == 12 * sizeof(double));

/// Spheres as contacts read them: each is a body of its own.
struct sphere_view {
    const pebble_motion* pebbles;
    const std::uint8_t* materials; ///< per pebble, where a law reads them
};
/// Pebbles of clumps as contacts read them.
struct clump_view {
    const clump_pebble* pebbles;
    const std::int32_t* owner; ///< per pebble: its body
    const body_motion* bodies;
    const std::uint8_t* materials; ///< per pebble, where a law reads them
};

/// What one contact exerts in this step; balls sum their rows in a fixed order. The force acts in the middle of the
/// overlap: at x_i + (r_i - depth / 2) normal, which is x_j - (r_j - depth / 2) normal.
struct force_row {
    vec3 force;              ///< on pebble i (N); pebble j takes the opposite
    double depth = 0.0;      ///< overlap (m); 0: open
    vec3 normal;             ///< unit vector from i to j
    double dissipated = 0.0; ///< in this step (J)
};

/// What acts on a body, in two blocks of four numbers.
struct alignas(64) load_sum {
    vec3 force; ///< N
    double spare = 0.0;
    vec3 moment;             ///< about its centre (N m)
    double dissipated = 0.0; ///< the loss to friction that is booked on it (J)

    load_sum() = default;
    load_sum(const vec3& f, const vec3& m, double loss = 0.0) : force(f), moment(m), dissipated(loss) {}
};
static_assert(sizeof(load_sum) == 8 * sizeof(double));

struct pebble_pair {
    std::int32_t i; ///< i < j
    std::int32_t j;
    constexpr auto operator<=>(const pebble_pair&) const = default;
};

/// Position of a pair among pairs that are sorted by before(a, b), or their number if it is not there.
template <class Order>
std::size_t find_pair(const std::vector<pebble_pair>& sorted, const pebble_pair& p, Order&& before) {
    const auto it = std::lower_bound(sorted.begin(), sorted.end(), p, before);
    return static_cast<std::size_t>((it != sorted.end() && *it == p ? it : sorted.end()) - sorted.begin());
}

/// The image of a body that is the body itself, of the 27 in a periodic cell (spaces/images.hpp).
inline constexpr std::uint8_t no_shift = 13;

/// Indices from begin to end - 1.
struct index_range {
    std::size_t begin, end;
};

/// Half list of pairs, sorted. Where bodies are cut into ranges, one for each thread, the pairs between two ranges
/// stand in front, sorted as well.
struct pair_list {
    std::vector<pebble_pair> pairs;
    std::vector<std::uint8_t> image; ///< which image of j is meant (spaces/images.hpp); empty where there are none
    std::size_t shared = 0;          ///< number of pairs between two ranges

    std::size_t size() const { return pairs.size(); }
    std::uint8_t image_of(std::size_t k) const { return image.empty() ? no_shift : image[k]; }
    index_range in_front() const { return {0, shared}; }
    index_range behind() const { return {shared, size()}; }
    /// Calls f(k) for all pairs, in the order that they would have in one sorted list.
    template <class Order, class F> void each_in_order(Order&& before, F&& f) const {
        std::size_t a = 0, b = shared;
        while (a < shared || b < size()) f(b == size() || (a < shared && before(pairs[a], pairs[b])) ? a++ : b++);
    }
    /// The pair that shall stand at k stands at order[k].
    void reorder(const std::vector<std::uint32_t>& order) {
        permute(pairs, order);
        if (!image.empty()) permute(image, order);
    }
    /// Adds a pair in its place, of a list without images that is sorted by `before`; returns the place.
    template <class Order> std::ptrdiff_t insert(const pebble_pair& p, Order&& before) {
        const auto k = std::lower_bound(pairs.begin(), pairs.end(), p, before) - pairs.begin();
        pairs.insert(pairs.begin() + k, p);
        return k;
    }

    /// A list is saved when it is joined.
    template <class A> void archive(A& a) { a(pairs, image); }

  protected:
    template <class T> static void permute(std::vector<T>& v, const std::vector<std::uint32_t>& order) {
        const std::vector<T> old = v;
        for (std::size_t k = 0; k < order.size(); ++k) v[k] = old[order[k]];
    }
};

/// Brings those pairs of a joined list to the front for which is_shared(pair).
template <class List, class F> void bring_shared_forward(List& list, F&& is_shared) {
    std::vector<std::uint32_t> order(list.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto middle =
        std::stable_partition(order.begin(), order.end(), [&](std::uint32_t k) { return is_shared(list.pairs[k]); });
    list.shared = static_cast<std::size_t>(middle - order.begin());
    if (list.shared > 0) list.reorder(order);
}
/// Makes it one sorted list again.
template <class List, class Order> void join_shared(List& list, Order&& before) {
    if (list.shared == 0) return;
    std::vector<std::uint32_t> order;
    order.reserve(list.size());
    list.each_in_order(before, [&](std::size_t k) { order.push_back(static_cast<std::uint32_t>(k)); });
    list.reorder(order);
    list.shared = 0;
}

/// Sorts the pairs between two ranges and the others again, each for themselves, after the order has changed.
template <class List, class Order> void sort_by(List& list, Order&& before) {
    std::vector<std::uint32_t> order(list.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto less = [&](std::uint32_t a, std::uint32_t b) { return before(list.pairs[a], list.pairs[b]); };
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(list.shared);
    std::stable_sort(order.begin(), middle, less); // images of one pair stay as they stood
    std::stable_sort(middle, order.end(), less);
    list.reorder(order);
}

/// Half list of contacts. An empty history (frictionless law) takes no memory; rows are there after a step that was
/// asked for them, and empty otherwise.
template <class History> struct contact_list : pair_list {
    static constexpr bool remembers = !std::is_empty_v<History>;

    std::vector<History> history; ///< empty if the law has none
    std::vector<force_row> rows;

    /// Adds a pair in its place, with an empty history and an empty row.
    template <class Order> void insert(const pebble_pair& p, Order&& before) {
        const std::ptrdiff_t k = pair_list::insert(p, before);
        if constexpr (remembers) history.insert(history.begin() + k, History{});
        if (!rows.empty() || size() == 1) rows.insert(rows.begin() + k, force_row{});
    }
    /// New pairs: empty histories, no rows yet.
    void resize() {
        rows.clear();
        if constexpr (remembers) history.assign(pairs.size(), {});
    }
    /// Gives contacts of this list the histories that the same pairs have among some contacts of an old one. Both
    /// stretches are sorted by `before`.
    template <class Order>
    void take_histories(index_range mine, const contact_list& old, index_range theirs, Order&& before) {
        if constexpr (remembers) {
            if (mine.begin == mine.end) return;
            const auto at = [&](std::size_t k) { return old.pairs.begin() + static_cast<std::ptrdiff_t>(k); };
            auto was = static_cast<std::size_t>(
                std::lower_bound(at(theirs.begin), at(theirs.end), pairs[mine.begin], before) - old.pairs.begin());
            for (std::size_t k = mine.begin; k < mine.end && was < theirs.end;)
                if (pairs[k] == old.pairs[was])
                    history[k++] = old.history[was++]; // as a rule the next two are equal, too
                else
                    before(pairs[k], old.pairs[was]) ? ++k : ++was;
        }
    }
    /// The contact that shall stand at k stands at order[k].
    void reorder(const std::vector<std::uint32_t>& order) {
        pair_list::reorder(order);
        if (!rows.empty()) permute(rows, order);
        if constexpr (remembers) permute(history, order);
    }

    template <class A> void archive(A& a) {
        pair_list::archive(a);
        if constexpr (remembers) a(history);
        if (rows.size() != pairs.size()) rows.clear(); // written anew by the next step
    }
};

/// Takes the contacts off a list without shared pairs for which gone(pair).
template <class History, class F> void erase_contacts(contact_list<History>& list, F&& gone) {
    std::size_t n = 0;
    for (std::size_t k = 0; k < list.size(); ++k) {
        if (gone(list.pairs[k])) continue;
        list.pairs[n] = list.pairs[k];
        if (!list.image.empty()) list.image[n] = list.image[k];
        if constexpr (contact_list<History>::remembers) list.history[n] = list.history[k];
        if (!list.rows.empty()) list.rows[n] = list.rows[k];
        ++n;
    }
    list.pairs.resize(n);
    if (!list.image.empty()) list.image.resize(n);
    if constexpr (contact_list<History>::remembers) list.history.resize(n);
    if (!list.rows.empty()) list.rows.resize(n);
}

/// For every body the rows that act on it, in the order of the list: what makes sums independent of threads.
class incidence {
  public:
    /// A row, and the pebble through which it acts on the body.
    struct entry {
        std::uint32_t row_and_side;
        std::int32_t pebble;

        std::size_t row() const { return row_and_side >> 1; } ///< contacts first, then rows of the wall
        bool is_second() const { return (row_and_side & 1U) != 0; }
        double side() const { return is_second() ? -1.0 : 1.0; } ///< sign of the row's force on this body
    };

    incidence() = default;
    /// For bodies 0 to n - 1. each(f) calls f(k) for the contacts of the list in the order of the sums; `wall` holds
    /// what has a member `pebble`; body_of(pebble): its body.
    template <class Each, class Wall, class F>
    incidence(std::size_t n, const pair_list& list, Each&& each, const Wall& wall, F&& body_of) : start_(n + 1, 0) {
        const auto each_entry = [&](auto&& f) {
            const auto put = [&](std::size_t row, std::uint32_t side, std::int32_t pebble) {
                f(body_of(pebble), entry{static_cast<std::uint32_t>(row) << 1 | side, pebble});
            };
            each([&](std::size_t k) { put(k, 0, list.pairs[k].i), put(k, 1, list.pairs[k].j); });
            for (std::size_t k = 0; k < wall.size(); ++k) put(list.size() + k, 0, wall[k].pebble);
        };
        each_entry([&](std::size_t body, const entry&) { ++start_[body + 1]; });
        for (std::size_t b = 0; b < n; ++b) start_[b + 1] += start_[b];
        entries_.resize(start_[n]);
        std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
        each_entry([&](std::size_t body, const entry& e) { entries_[next[body]++] = e; });
    }

    std::span<const entry> of(std::size_t body) const {
        return {entries_.data() + start_[body], entries_.data() + start_[body + 1]};
    }

    template <class A> void archive(A& a) { a(start_, entries_); }

  private:
    std::vector<std::uint32_t> start_; ///< per body, plus the end
    std::vector<entry> entries_;
};

} // namespace clast
