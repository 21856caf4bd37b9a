// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <catch.hpp>

#include <clast/control/gap_control.hpp>

using namespace clast::control;

namespace {

struct pair_result {
    double va, vb;
    gap_events events;
};

// Two walls with a step of twice the limit, under the given velocities.
pair_result control_pair(double ra, double rb, double va, double vb) {
    const chain two{0, 1, 2, false, 0, 0.004};
    const std::vector<double> r{ra, rb};
    std::vector<double> v{va, vb};
    std::vector<std::uint8_t> latch{0};
    gap_events events;
    REQUIRE(latch_gaps(two, {}, r, latch) == 1);
    control_gaps({two}, {}, r, v, latch, false, events);
    return {v[0], v[1], events};
}

} // namespace

TEST_CASE("of two tiles that move the same way the one that opens the gap is slowed to half of the other",
          "[control]") {
    auto p = control_pair(0.158, 0.150, 1.0, 3.0); // both inward, the inner one runs away
    CHECK(p.va == 1.0);
    CHECK(p.vb == 0.5);
    p = control_pair(0.158, 0.150, -3.0, -1.0); // both outward, the outer one runs away
    CHECK(p.va == -0.5);
    CHECK(p.vb == -1.0);
    p = control_pair(0.150, 0.158, 2.0, 2.0); // same speed inward: still open, so the inner one waits
    CHECK(p.va == 1.0);
    CHECK(p.vb == 2.0);
    CHECK(p.events.slowed == 1);
    CHECK(p.events.relaxed == 0);
}

TEST_CASE("tiles that part from each other, or from one at rest, are both stopped", "[control]") {
    for (const auto& p : {control_pair(0.158, 0.150, -1.0, 3.0), control_pair(0.150, 0.158, 1.0, -1.0),
                          control_pair(0.158, 0.150, 0.0, 3.0), control_pair(0.158, 0.150, -2.0, 0.0)}) {
        CHECK(p.va == 0.0);
        CHECK(p.vb == 0.0);
        CHECK(p.events.relaxed == 1);
    }
}

TEST_CASE("a gap that closes is left alone, and released below nine tenths of its limit", "[control]") {
    const auto p = control_pair(0.158, 0.150, 3.0, -1.0);
    CHECK(p.va == 3.0);
    CHECK(p.vb == -1.0);
    const chain two{0, 1, 2, false, 0, 0.004};
    std::vector<std::uint8_t> latch{0};
    CHECK(latch_gaps(two, {}, std::vector{0.15, 0.1539}, latch) == 0); // below the limit: free
    CHECK(latch_gaps(two, {}, std::vector{0.15, 0.1541}, latch) == 1);
    CHECK(latch_gaps(two, {}, std::vector{0.15, 0.1537}, latch) == 1); // hysteresis
    CHECK(latch_gaps(two, {}, std::vector{0.15, 0.1535}, latch) == 0);
}

TEST_CASE("under random forcing no gap of a column or a ring exceeds its limit by more than one step of motion",
          "[control]") {
    constexpr int rings = 36;
    constexpr int around = 8;
    constexpr double g_lim = 4e-3;
    constexpr double d_max = 5e-3;
    constexpr double speed = 0.02;
    constexpr double dt = 1e-3; // coarse: 20 um per step
    std::vector<chain> chains;
    for (int i = 0; i < around; ++i) chains.push_back({i, around, rings, false, i * rings, g_lim});
    for (int k = 0; k < rings; ++k) chains.push_back({k * around, 1, around, true, around * rings + k * around, d_max});
    std::vector<double> r(rings * around, 0.15), v(r.size()), raw(r.size());
    std::vector<std::uint8_t> latch(2 * r.size(), 0);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> push(-speed, speed);
    gap_events events;
    double worst = 0.0;
    int longest = 0;
    bool widened = false;
    bool faster = false;
    bool reached = false;
    for (int step = 0; step < 1500; ++step) {
        if (step % 300 == 0) // forcing that persists, so that every tile runs away for a while
            for (double& one : raw) one = push(random);
        for (std::size_t j = 0; j < v.size(); ++j) v[j] = std::clamp(raw[j] + 0.3 * push(random), -speed, speed);
        const auto proposed = v;
        int latched = 0;
        for (const chain& c : chains) latched += latch_gaps(c, {}, r, latch);
        reached = reached || latched > 0;
        longest = std::max(longest, control_gaps(chains, {}, r, v, latch, step % 2 == 0, events));
        for (std::size_t j = 0; j < v.size(); ++j) faster = faster || std::abs(v[j]) > std::abs(proposed[j]);
        const auto before = r;
        for (std::size_t j = 0; j < r.size(); ++j) r[j] -= v[j] * dt;
        for (const chain& c : chains)
            for (int j = 0; j < c.pairs(); ++j) {
                const auto [a, b, l] = detail::pair_of(c, j);
                const double gap = std::abs(r[a] - r[b]);
                worst = std::max(worst, gap - c.limit);
                widened = widened || (latch[l] && gap > std::abs(before[a] - before[b]) + 1e-15);
            }
    }
    CHECK(reached);
    CHECK_FALSE(widened);
    CHECK_FALSE(faster);
    CHECK(worst <= 2.0 * speed * dt + 1e-15);
    CHECK(longest <= rings);
    CHECK(events.slowed > 0);
    CHECK(events.relaxed > 0);
}

TEST_CASE("a closed chain also guards the pair of its last and first wall", "[control]") {
    const chain ring{0, 1, 4, true, 0, 0.004};
    const std::vector<double> r{0.150, 0.152, 0.154, 0.156};
    std::vector<double> v{1.0, 0.0, 0.0, -1.0};
    std::vector<std::uint8_t> latch(4, 0);
    gap_events events;
    CHECK(latch_gaps(ring, {}, r, latch) == 1);
    CHECK(latch[3] == 1);
    control_gaps({ring}, {}, r, v, latch, false, events);
    CHECK(v[0] == 0.0);
    CHECK(v[3] == 0.0);
}

TEST_CASE("a held pair moves on together, at the speed that the sum of its loads asks for", "[control]") {
    const chain two{0, 1, 2, false, 0, 0.004};
    const std::vector<double> apothem{0.158, 0.150}, stiffness{3e6, 1e6};
    const std::vector<std::uint8_t> latch{1};
    std::vector<double> holding;
    std::vector<double> v{-1.0, 3.0}; // the outer one out, the inner one in
    CHECK(hold_gaps({two}, apothem, v, stiffness, latch, holding) == 1);
    CHECK(v[0] == Approx(0.0).margin(1e-12)); // (3 (-1) + 1 (3)) / 4
    CHECK(v[1] == Approx(0.0).margin(1e-12));
    v = {1.0, 5.0};
    CHECK(hold_gaps({two}, apothem, v, stiffness, latch, holding) == 1);
    CHECK(v[0] == Approx(2.0).epsilon(1e-12));
    CHECK(v[1] == Approx(2.0).epsilon(1e-12));
    v = {3.0, -1.0}; // closing
    CHECK(hold_gaps({two}, apothem, v, stiffness, latch, holding) == 0);
    CHECK(v == std::vector<double>{3.0, -1.0});
    v = {-1.0, 3.0}; // not latched
    CHECK(hold_gaps({two}, apothem, v, stiffness, {0}, holding) == 0);
    CHECK(v == std::vector<double>{-1.0, 3.0});
}

TEST_CASE("walls held in a row and a ring keep the sum of stiffness times velocity, and none opens", "[control]") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int run = 0; run < 200; ++run) {
        const std::vector<chain> chains{
            {0, 4, 4, false, 0, 0.004}, {0, 1, 4, true, 4, 0.004}, {4, 1, 4, true, 8, 0.004}};
        std::vector<double> apothem(16), stiffness(16), v(16), holding;
        for (std::size_t j = 0; j < 16; ++j)
            apothem[j] = 0.15 + 0.01 * u(random), stiffness[j] = 2e6 * (1.5 + u(random)), v[j] = u(random);
        std::vector<std::uint8_t> latch(12);
        for (auto& l : latch) l = u(random) > 0.0;
        const std::vector<double> before = v;
        hold_gaps(chains, apothem, v, stiffness, latch, holding);
        double sum = 0.0, size = 0.0;
        for (std::size_t j = 0; j < 16; ++j) sum += stiffness[j] * (v[j] - before[j]), size += stiffness[j];
        CHECK(std::abs(sum) < 1e-12 * size);
        for (const chain& c : chains)
            for (int j = 0; j < c.pairs(); ++j) {
                const auto [a, b, l] = detail::pair_of(c, j);
                if (latch[l]) CHECK(detail::opening_rate(apothem[a], apothem[b], v[a], v[b]) < 0.02);
            }
    }
}
