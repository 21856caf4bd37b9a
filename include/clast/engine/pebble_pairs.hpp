// SPDX-License-Identifier: MIT
// From neighbouring bodies to the pairs of their pebbles that are near each other, in the order of contact lists.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <clast/bodies/concepts.hpp>
#include <clast/bodies/contact_list.hpp>
#include <clast/core/parallel.hpp>
#include <clast/core/vector.hpp>
#include <clast/searches/concepts.hpp>
#include <clast/spaces/concepts.hpp>
#include <clast/spaces/images.hpp>

namespace clast {

/// Makes the lists of pairs of pebbles whose gap is less than a margin (m). In a space with images pairs say which
/// image of their second pebble is meant.
template <bodies::swept S, spaces::space Space> class pebble_pairs {
  public:
    pebble_pairs(const S& grains, const Space& space, double margin, const execution& run)
        : grains_(grains), space_(space), margin_(margin), run_(run) {}

    struct lists {
        pair_list heavy; ///< of two swept bodies
        pair_list light; ///< with a ball
    };
    /// near: pairs of spheres whose gap is less than the margin, sorted.
    lists of(const search_spheres& spheres, const std::vector<searches::sphere_pair>& near) const {
        constexpr std::size_t chunk = 256;
        const std::size_t chunks = (near.size() + chunk - 1) / chunk, real = spheres.real();
        found_pairs found(chunks);
        run_.for_each(
            chunks,
            [&](std::size_t c) {
                std::vector<std::int32_t> near_a, near_b; // work space
                for (std::size_t k = c * chunk; k < std::min(near.size(), (c + 1) * chunk); ++k) {
                    const std::size_t first = at(near[k].first), second = at(near[k].second);
                    if (first >= real) continue; // two images
                    const searches::sphere &a = spheres.all[first], &b = spheres.all[second];
                    if (a.id == b.id) continue;
                    add(a, b, spheres.image_of(second), near_a, near_b, found[c][is_ball(a) || is_ball(b) ? 1 : 0]);
                }
            },
            1);
        return {sorted(found, 0), sorted(found, 1)};
    }

  private:
    struct listed_pair {
        pebble_pair pair;
        std::uint8_t image;
    };
    using found_pairs = std::vector<std::array<std::vector<listed_pair>, 2>>; ///< by parts: heavy and light

    static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
    std::int32_t bodies() const { return static_cast<std::int32_t>(grains_.body_count()); }
    bool is_ball(const searches::sphere& s) const { return s.id >= bodies(); }
    searches::sphere pebble(std::int32_t p, std::uint8_t image) const {
        return {space_.across(grains_.pebbles[at(p)].x, image), grains_.pebbles[at(p)].radius};
    }

    /// Pairs of pebbles of two neighbours; those with the same second pebble stand by the first one. near_a, near_b:
    /// work space, pebbles of one that the other may reach.
    void add(const searches::sphere& a, const searches::sphere& b, std::uint8_t image,
             std::vector<std::int32_t>& near_a, std::vector<std::int32_t>& near_b,
             std::vector<listed_pair>& out) const {
        const auto list = [&](std::int32_t p, std::int32_t q) { // seen from q, it is p that lies the other way
            return p < q ? listed_pair{{p, q}, image}
                         : listed_pair{{q, p}, static_cast<std::uint8_t>(2 * no_shift - image)};
        };
        if constexpr (!S::turns) return out.push_back(list(a.id, b.id)); // the search has tested them
        if (is_ball(a) && is_ball(b)) return out.push_back(list(a.id - bodies(), b.id - bodies()));
        collect(a, no_shift, b, near_a);
        collect(b, image, a, near_b);
        std::size_t n = out.size();
        out.resize(n + near_a.size() * near_b.size() + 1);
        for (std::int32_t q : near_b) {
            const searches::sphere pebble_q = pebble(q, image);
            for (std::int32_t p : near_a) {
                out[n] = list(p, q);
                n += searches::within(pebble(p, no_shift), pebble_q, margin_);
            }
        }
        out.resize(n);
    }
    /// Keeps the pebbles of a body that another may reach. All are written: no branch that depends on the packing.
    void collect(const searches::sphere& body, std::uint8_t image, const searches::sphere& other,
                 std::vector<std::int32_t>& kept) const {
        const std::size_t ball = at(body.id - bodies());
        const index_range own = is_ball(body) ? index_range{ball, ball + 1} : grains_.pebbles_of(at(body.id));
        kept.resize(own.end - own.begin + 1);
        std::size_t n = 0;
        for (auto p = static_cast<std::int32_t>(own.begin); p < static_cast<std::int32_t>(own.end); ++p) {
            kept[n] = p;
            n += searches::within(pebble(p, image), other, margin_);
        }
        kept.resize(n);
    }
    /// Pairs in the order of the lists: two counting sorts, by the second pebble and then by the group of the first.
    /// Among equals the search has put first pebbles in order, and both sorts leave them so.
    pair_list sorted(const found_pairs& found, std::size_t which) const {
        const auto counting_sort = [](std::size_t keys, auto&& each, auto&& key, auto&& put) {
            std::vector<std::uint32_t> next(keys + 1, 0);
            each([&](const listed_pair& p) { ++next[key(p) + 1]; });
            std::partial_sum(next.begin(), next.end(), next.begin());
            each([&](const listed_pair& p) { put(next[key(p)]++, p); });
        };
        std::size_t count = 0;
        for (const auto& part : found) count += part[which].size();
        std::vector<listed_pair> by_second(count);
        counting_sort(
            grains_.pebble_count(),
            [&](auto&& f) {
                for (const auto& part : found)
                    for (const listed_pair& p : part[which]) f(p);
            },
            [](const listed_pair& p) { return at(p.pair.j); },
            [&](std::size_t k, const listed_pair& p) { by_second[k] = p; });
        pair_list list;
        list.pairs.resize(count);
        if constexpr (Space::has_images) list.image.resize(count);
        counting_sort(
            grains_.grain_count(), [&](auto&& f) { std::for_each(by_second.begin(), by_second.end(), f); },
            [&](const listed_pair& p) { return grains_.group_of(p.pair.i); },
            [&](std::size_t k, const listed_pair& p) {
                list.pairs[k] = p.pair;
                if constexpr (Space::has_images) list.image[k] = p.image;
            });
        return list;
    }

    const S& grains_;
    const Space& space_;
    double margin_;
    const execution& run_;
};

} // namespace clast
