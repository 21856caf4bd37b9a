// SPDX-License-Identifier: MIT
// Which bodies each thread sweeps, and where their contacts are in the list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/bodies/contact_list.hpp>
#include <clast/core/parallel.hpp>

namespace clast {

/// Bodies that one thread sweeps, and the contacts whose first body is among them (those shared with another range
/// excepted).
struct body_range {
    index_range bodies{0, 0};
    index_range rows{0, 0};
    std::size_t first_shared = 0;        ///< of the shared contacts whose first body is in the range
    std::size_t first_wall = 0;          ///< of the wall rows of its bodies
    std::vector<std::uint32_t> incoming; ///< shared contacts whose second body is in it

    bool has(std::size_t body) const { return bodies.begin <= body && body < bodies.end; }
};

/// Bodies, cut into consecutive ranges.
class body_ranges {
  public:
    std::size_t size() const { return ranges_.size(); }
    const body_range& operator[](std::size_t r) const { return ranges_[r]; }
    /// Behind the last contact whose first body this is, in the list of its range; where it has none, behind that of
    /// the bodies before it.
    std::size_t end_of(std::size_t body) const { return end_[body]; }

    /// Cuts bodies 0 to n - 1 into so many ranges (>= 1) that have about equally many pairs. A pair counts for both of
    /// its bodies, so that those between two ranges count half for either. body_of(pebble): its body.
    template <class F> void cut(std::size_t n, const std::vector<pebble_pair>& pairs, std::size_t count, F&& body_of) {
        std::vector<std::uint32_t> pairs_of(n, 0);
        for (const pebble_pair& p : pairs) ++pairs_of[body_of(p.i)], ++pairs_of[body_of(p.j)];
        ranges_.resize(count);
        end_.resize(n);
        std::size_t body = 0, sum = 0;
        for (std::size_t r = 0; r < count; ++r) {
            ranges_[r].bodies.begin = body;
            while (body < n && (r + 1 == count || sum < (r + 1) * 2 * pairs.size() / count)) sum += pairs_of[body++];
            ranges_[r].bodies.end = body;
        }
    }
    /// Whether two bodies are in different ranges.
    bool are_apart(std::size_t a, std::size_t b) const {
        const auto range_of = [&](std::size_t body) {
            return std::partition_point(ranges_.begin(), ranges_.end(),
                                        [&](const body_range& r) { return r.bodies.end <= body; });
        };
        return ranges_.size() > 1 && range_of(a) != range_of(b);
    }
    /// Finds the contacts of ranges and bodies in a list whose pairs between two ranges are in front, and the first
    /// wall row of every range; wall rows have a member `pebble`, and are sorted by it.
    template <class Wall, class F>
    void index(const pair_list& list, const Wall& wall, const execution& run, F&& body_of) {
        const auto first_of = [](const auto& sorted, index_range within, auto&& body_of_item, std::size_t body) {
            const auto begin = sorted.begin();
            return static_cast<std::size_t>(
                std::partition_point(begin + static_cast<std::ptrdiff_t>(within.begin),
                                     begin + static_cast<std::ptrdiff_t>(within.end),
                                     [&](const auto& item) { return body_of_item(item) < body; }) -
                begin);
        };
        const auto first_body = [&](const pebble_pair& p) { return body_of(p.i); };
        const auto wall_body = [&](const auto& w) { return body_of(w.pebble); };
        run.for_each(
            ranges_.size(),
            [&](std::size_t number) {
                body_range& r = ranges_[number];
                r.rows = {first_of(list.pairs, list.behind(), first_body, r.bodies.begin),
                          first_of(list.pairs, list.behind(), first_body, r.bodies.end)};
                r.first_shared = first_of(list.pairs, list.in_front(), first_body, r.bodies.begin);
                r.first_wall = first_of(wall, {0, wall.size()}, wall_body, r.bodies.begin);
                for (std::size_t b = r.bodies.begin; b < r.bodies.end; ++b) end_[b] = 0;
                for (std::size_t k = r.rows.begin; k < r.rows.end; ++k)
                    end_[first_body(list.pairs[k])] = static_cast<std::uint32_t>(k + 1);
                auto end = static_cast<std::uint32_t>(r.rows.begin);
                for (std::size_t b = r.bodies.begin; b < r.bodies.end; ++b) end_[b] = end = std::max(end, end_[b]);
                r.incoming.clear();
                for (std::uint32_t k = 0; k < list.shared; ++k)
                    if (r.has(body_of(list.pairs[k].j))) r.incoming.push_back(k);
            },
            1);
    }

  private:
    std::vector<body_range> ranges_;
    std::vector<std::uint32_t> end_; ///< per body
};

} // namespace clast
