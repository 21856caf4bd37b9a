// SPDX-License-Identifier: MIT
#include <clast/engine/list_widths.hpp>

#include <cmath>

#include <clast/io/archive.hpp>

#include <catch.hpp>

using namespace clast;

namespace {
constexpr list_widths::counts bodies{1000, 4000};

/// A packing that loses `speed` of its skin in every step, and has `density` open pairs per metre of skin.
struct model {
    double speed, density;
    std::int64_t step = 0;

    std::int64_t steps(double skin) const { return std::max<std::int64_t>(1, std::llround(skin / speed)); }
    std::size_t open(double skin) const { return static_cast<std::size_t>(density * skin); }
    /// Evaluations of open pairs and work of renewals per step.
    double cost(double skin) const {
        return static_cast<double>(open(skin)) + (4.0 * 1000.0 + 0.8 * 4000.0) / static_cast<double>(steps(skin));
    }
    void renew(list_widths& w) {
        w.picked(step, open(w.skin()), 0);
        step += steps(w.skin());
        w.skin_is_used_up();
        w.choose_skin(bodies, step);
    }
};
} // namespace

TEST_CASE("the skin finds the width at which lists cost least") {
    for (const double start : {1e-6, 1e-5, 1e-4}) {
        model packing{2e-7, 1e8};
        list_widths w(start);
        for (int k = 0; k < 40; ++k) packing.renew(w);
        double least = packing.cost(w.skin());
        for (double skin = 1e-6; skin < 1e-3; skin *= 1.05) least = std::min(least, packing.cost(skin));
        CHECK(packing.cost(w.skin()) < 1.05 * least);
    }
}

TEST_CASE("lists that were renewed for another reason teach nothing") {
    list_widths w(1e-5);
    w.picked(0, 1000000, 0);
    w.choose_skin(bodies, 10);
    CHECK(w.skin() == 1e-5);
    w.skin_is_used_up();
    w.choose_skin(bodies, 10); // many open pairs for long
    CHECK(w.skin() < 1e-5);
    const double narrower = w.skin();
    w.choose_skin(bodies, 20);
    CHECK(w.skin() == narrower);
}

TEST_CASE("the skin stays within a factor of 64 of where it started") {
    list_widths narrow(1e-5), wide(1e-5);
    for (int k = 0; k < 40; ++k) {
        narrow.picked(0, 1000000000, 0), wide.picked(0, 0, 0);
        narrow.skin_is_used_up(), wide.skin_is_used_up();
        narrow.choose_skin(bodies, 1000), wide.choose_skin(bodies, 1);
    }
    CHECK(narrow.skin() == 1e-5 / 64);
    CHECK(wide.skin() == 64e-5);
}

TEST_CASE("the margin of searches grows when they come often, and shrinks when renewals look at many pairs") {
    const auto after = [](std::size_t left_out, int picks) {
        list_widths w(1e-5);
        w.choose_margin(bodies);
        for (int k = 0; k < picks; ++k) w.picked(k, 0, left_out);
        w.margin_is_used_up();
        w.choose_margin(bodies);
        return w.margin();
    };
    const double start = list_widths(1e-5).margin();
    CHECK(start == 50e-5);
    CHECK(after(1000, 10) > start);
    CHECK(after(100000, 200) < start);
    // about 40000 evaluations of a search over 0.15 * 20000 of a renewal
    CHECK(after(20000, 13) == Approx(start).epsilon(0.02));
    // nothing learnt, but what there is room for
    list_widths w(1e-5);
    w.choose_margin(bodies, 3e-5);
    CHECK(w.margin() == 3e-5);
    w.choose_margin(bodies, 1e-6);
    CHECK(w.margin() == w.skin());
    w.choose_margin(bodies);
    CHECK(w.margin() == 10.0 * w.skin());
}

TEST_CASE("lists are fresh until they have been picked once after a search") {
    list_widths w(1e-5);
    CHECK(w.is_fresh());
    w.picked(0, 10, 10);
    CHECK(!w.is_fresh());
    w.choose_margin(bodies);
    CHECK(w.is_fresh());
}

TEST_CASE("what lists have taught comes back from an archive") {
    model packing{2e-7, 1e8};
    list_widths w(1e-5), copy;
    for (int k = 0; k < 3; ++k) packing.renew(w);
    w.picked(packing.step, 5, 70000);
    w.margin_is_used_up();
    from_bytes(to_bytes(w), copy);
    CHECK(checksum(copy) == checksum(w));
    w.choose_margin(bodies), copy.choose_margin(bodies);
    CHECK((copy.skin() == w.skin() && copy.margin() == w.margin() && w.margin() != 50e-5));
}
