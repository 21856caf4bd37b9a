// SPDX-License-Identifier: MIT
#include <clast/engine/sweep.hpp>

#include <cstddef>
#include <vector>

#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {
using rigid = scenes::unbreakable<>;

/// A packing on some threads, with contacts and walls evaluated up to the sweep.
scene<rigid> before_sweep(int threads) {
    auto s = scenes::settings<rigid>();
    s.run = execution(threads);
    s.contacts_per_thread = 8;
    s.scheme.damping = 0.0;
    auto e = scenes::packed<rigid>(s, shapes::tetrahedron_4(circumscribed(0.02)), 40, 0.065, 2e5, 3000);
    scene<rigid> one = e.state();
    rooms::evaluate_walls(one, one.heavy_wall, one.heavy_grip, one.dt, 0.0);
    return one;
}
} // namespace

TEST_CASE("every body is looked at once, with all its forces and before it moves, and then moves by them") {
    for (const int threads : {1, 3}) {
        scene<rigid> s = before_sweep(threads);
        CHECK((s.ranges.size() > 1) == (threads > 1));
        const bodies::clumps before = s.grains;
        std::vector<int> looks(s.grains.body_count(), 0);
        std::vector<vec3> force(s.grains.body_count());
        std::size_t moved = 0;
        (void)rooms::sweep(s, {1.0, 1.0}, s.dt, true, [&](std::size_t body, range_work& work) {
            ++looks[body];
            force[body] = work.ready.back().load.force;
            moved += s.grains.motion[body].x != before.motion[body].x;
        });
        CHECK(moved == 0);
        // by another way: rows of the list, added up
        std::vector<vec3> sum(s.grains.body_count());
        s.each_contact([&](const force_row& row, const pebble_pair& p) {
            sum[s.grains.body_of(p.i)] += row.force, sum[s.grains.body_of(p.j)] -= row.force;
        });
        s.each_wall_row([&](const boundaries::wall_row& w) { sum[s.grains.body_of(w.pebble)] += w.force; });
        double largest = 0.0;
        for (const vec3& f : sum) largest = std::max(largest, norm(f));
        CHECK(largest > 0.0);
        for (std::size_t b = 0; b < sum.size(); ++b) {
            CHECK(looks[b] == 1);
            CHECK(norm(force[b] - sum[b]) < 1e-9 * largest + 1e-12);
            const double m = s.grains.body_mass(b);
            CHECK(norm(s.grains.motion[b].v - before.motion[b].v - (s.dt / m) * force[b]) <
                  1e-13 * (norm(before.motion[b].v) + s.dt / m * largest));
        }
        for (const load_sum& left : s.acting) CHECK((left.force == vec3{} && left.moment == vec3{}));
    }
}

TEST_CASE("a sweep says when a body has used up its margin") {
    scene<rigid> s = before_sweep(1);
    const auto nobody = [](std::size_t, range_work&) {};
    scene<rigid> other = s;
    CHECK(rooms::sweep(s, {1.0, 1.0}, s.dt, false, nobody) == margin_use::within);
    other.near.margins[5] = 0.0;
    CHECK(rooms::sweep(other, {1.0, 1.0}, s.dt, false, nobody) == margin_use::used_up);
}
