// SPDX-License-Identifier: MIT
#include <clast/engine/body_ranges.hpp>

#include <algorithm>
#include <vector>

#include <clast/core/random.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

std::size_t body_of(std::int32_t pebble) { return static_cast<std::size_t>(pebble) / 2; } // two pebbles each

bool before(const pebble_pair& a, const pebble_pair& b) {
    const std::size_t ga = body_of(a.i), gb = body_of(b.i);
    return ga != gb ? ga < gb : a.j != b.j ? a.j < b.j : a.i < b.i;
}

/// Pairs of pebbles of bodies that are near each other in number, and a few that are far apart; sorted.
pair_list pairs_of(std::int32_t bodies) {
    random_stream random{5, static_cast<std::uint64_t>(bodies)};
    const auto any = [&](std::int32_t n) { return static_cast<std::int32_t>(uniform(random, 0.0, n)); };
    pair_list list;
    for (std::int32_t i = 0; i < 2 * bodies; ++i)
        for (const std::int32_t j : {i + 1 + any(6), i + 2 + any(30), any(2 * bodies)})
            if (j > i && j < 2 * bodies && body_of(i) != body_of(j) && i % 14 != 0) list.pairs.push_back({i, j});
    std::sort(list.pairs.begin(), list.pairs.end(), before);
    list.pairs.erase(std::unique(list.pairs.begin(), list.pairs.end()), list.pairs.end());
    return list;
}
struct wall_row {
    std::int32_t pebble;
};

} // namespace

TEST_CASE("ranges hold all bodies in order, with about equally many pairs") {
    for (const std::int32_t n : {1, 2, 50, 1000})
        for (const std::size_t count : {1U, 2U, 3U, 8U}) {
            const pair_list list = pairs_of(n);
            body_ranges ranges;
            ranges.cut(static_cast<std::size_t>(n), list.pairs, count, body_of);
            REQUIRE(ranges.size() == count);
            CHECK(ranges[0].bodies.begin == 0);
            CHECK(ranges[count - 1].bodies.end == static_cast<std::size_t>(n));
            std::size_t most = 0, ends = 0; // of pairs
            for (std::size_t r = 0; r < count; ++r) {
                if (r > 0) CHECK(ranges[r].bodies.begin == ranges[r - 1].bodies.end);
                std::size_t mine = 0;
                for (const pebble_pair& p : list.pairs)
                    mine += std::size_t{ranges[r].has(body_of(p.i))} + std::size_t{ranges[r].has(body_of(p.j))};
                most = std::max(most, mine), ends += mine;
            }
            CHECK(ends == 2 * list.size());
            if (n == 1000) CHECK(static_cast<double>(most) < 1.1 * static_cast<double>(ends / count));
        }
}

TEST_CASE("every pair is in the range of both of its bodies, or in front and in the range of either") {
    for (const std::int32_t n : {1, 50, 1000})
        for (const int threads : {1, 3})
            for (const std::size_t count : {1U, 2U, 3U, 8U}) {
                const auto bodies = static_cast<std::size_t>(n);
                pair_list list = pairs_of(n);
                std::vector<wall_row> wall;
                for (std::int32_t p = 5; p < 2 * n; p += 11) wall.push_back({p});
                body_ranges ranges;
                ranges.cut(bodies, list.pairs, count, body_of);
                bring_shared_forward(
                    list, [&](const pebble_pair& p) { return ranges.are_apart(body_of(p.i), body_of(p.j)); });
                ranges.index(list, wall, execution(threads), body_of);
                CHECK((count == 1 || n == 1) == (list.shared == 0));
                std::vector<int> own(list.size(), 0), first(list.size(), 0), second(list.size(), 0);
                std::size_t bad = 0;
                for (std::size_t r = 0; r < count; ++r) {
                    const body_range& range = ranges[r];
                    std::size_t row = range.rows.begin;
                    for (std::size_t b = range.bodies.begin; b < range.bodies.end; ++b) {
                        for (; row < ranges.end_of(b); ++row)
                            ++own[row],
                                bad += body_of(list.pairs[row].i) != b || !range.has(body_of(list.pairs[row].j));
                        bad += row != ranges.end_of(b);
                    }
                    bad += row != range.rows.end;
                    for (std::size_t k = range.first_shared; k < list.shared && range.has(body_of(list.pairs[k].i));
                         ++k)
                        ++first[k];
                    for (const std::uint32_t k : range.incoming)
                        ++second[k], bad += !range.has(body_of(list.pairs[k].j));
                    CHECK(std::is_sorted(range.incoming.begin(), range.incoming.end()));
                    // wall rows before are of other ranges
                    for (std::size_t k = 0; k < wall.size(); ++k)
                        bad += (k < range.first_wall) != (body_of(wall[k].pebble) < range.bodies.begin);
                }
                for (std::size_t k = 0; k < list.size(); ++k)
                    bad += own[k] != (k < list.shared ? 0 : 1) || first[k] != 1 - own[k] || second[k] != 1 - own[k];
                CHECK(bad == 0);
            }
}

TEST_CASE("more ranges than bodies: some are empty") {
    pair_list list;
    list.pairs = {{0, 2}, {2, 4}};
    body_ranges ranges;
    ranges.cut(3, list.pairs, 8, body_of);
    bring_shared_forward(list, [&](const pebble_pair& p) { return ranges.are_apart(body_of(p.i), body_of(p.j)); });
    ranges.index(list, std::vector<wall_row>{}, execution(1), body_of);
    std::size_t bodies = 0;
    for (std::size_t r = 0; r < ranges.size(); ++r) bodies += ranges[r].bodies.end - ranges[r].bodies.begin;
    CHECK(bodies == 3);
    CHECK(list.shared == 2);
    ranges.cut(0, {}, 2, body_of);
    CHECK(ranges[1].bodies.end == 0);
}
