// SPDX-License-Identifier: MIT
// Balls and clusters through t_n in sub-steps of their own.
//
// A contact that involves a ball is integrated with the step that the lightest ball needs, over the span from
// t_n - dt/2 to t_n + dt/2; its mean force over that span acts on the clump at t_n, which is what a leapfrog asks for.
// Bonds take a smaller step still. So a replacement does not shrink the step of the specimen, and every force has the
// opposite force in the same step. Sub-steps make energy that damping has to take; where it takes too little, all
// bodies go by one step (stepping, settings.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <clast/bodies/contact_list.hpp>
#include <clast/bonds/cluster_pool.hpp>
#include <clast/engine/bond_failure.hpp>
#include <clast/engine/kernel.hpp>
#include <clast/engine/scene.hpp>
#include <clast/engine/step_limit.hpp>
#include <clast/engine/walls.hpp>

namespace clast::rooms {

/// Light contacts: clumps are where their velocity takes them, `ahead` seconds from t_n, balls have been placed by
/// their sub-step. All rows are kept.
template <class S> struct light_job {
    S& scene;
    double ahead;

    [[gnu::always_inline]] void adjust(strip_of<S>& s, const contact_block& block) const {
        const auto& g = scene.grains;
        const auto is_clump = [&g](std::int32_t p) { return g.body_of(p) < g.grain_count(); };
        for (std::size_t k = block.at; k < block.at + block.size; ++k) {
            const pebble_pair& p = scene.light.pairs[block.row + k - block.at];
            vec3 by;
            if (is_clump(p.i))
                by -= ahead * g.velocity_of(p.i);
            else // a ball is placed elsewhere than its motion, which trails it
                s.aix[k] = s.aiy[k] = s.aiz[k] = 0.0;
            if (is_clump(p.j))
                by += ahead * g.velocity_of(p.j);
            else
                s.ajx[k] = s.ajy[k] = s.ajz[k] = 0.0;
            s.dx[k] += by.x, s.dy[k] += by.y, s.dz[k] += by.z;
        }
    }
    template <class Width>
    [[gnu::always_inline]] void take(Width, const strip_of<S>& s, const contact_block& block) const {
        keep_rows(s, block, scene.light.rows.data());
    }
};
/// Rows of the light contacts and their wall, `ahead` seconds from t_n. h: span since the last evaluation (s).
template <class S> void evaluate_light(S& s, double h, double ahead) {
    each_chunk(s.settings.run, s.light.size(), [&](index_range some) {
        evaluate(s.light, some, s.grains.view(), s.settings.grain_contact, h, light_job<S>{s, ahead});
    });
    evaluate_walls(s, s.light_wall, s.light_grip, h, ahead);
}
/// Sum of the light rows of one body about its centre, in the order of the list; `ahead` seconds from t_n, like the
/// centre. Friction losses are booked on side i.
template <class S> load_sum sum_light(const S& s, std::size_t body, const vec3& centre, double ahead) {
    load_sum sum;
    for (const incidence::entry& one : s.light_of.of(body)) {
        vec3 arm = s.position(one.pebble) - centre;
        if (ahead != 0.0) arm += ahead * s.grains.velocity_of(one.pebble);
        if (one.row() < s.light.size()) {
            const force_row& row = s.light.rows[one.row()];
            const double side = one.side();
            const vec3 f = side * row.force;
            sum.force += f;
            sum.moment += cross(arm + (side * (s.radius(one.pebble) - 0.5 * row.depth)) * row.normal, f);
            sum.dissipated += (0.5 + 0.5 * side) * row.dissipated; // on side i
        } else {
            const boundaries::wall_row& w = s.light_wall[one.row() - s.light.size()];
            sum.force += w.force;
            sum.moment += cross(arm, w.force);
            if (!s.light_grip.empty()) {
                const auto& grip = s.light_grip[one.row() - s.light.size()];
                sum.moment += grip.moment;
                sum.dissipated += grip.dissipated;
            }
        }
    }
    return sum;
}

/// Places balls where they will be in `later` seconds at their velocity.
template <class S> void place_balls(S& s, double later) {
    s.settings.run.for_each(s.broken.balls.size(), [&](std::size_t k) {
        const std::int32_t p = s.broken.balls[k];
        const body_motion& m = s.grains.motion[s.grains.ball(p)];
        s.grains.pebbles[s.at(p)].x = m.x + later * m.v;
    });
}
/// What acts on a ball in the middle of a sub-step.
template <class S> load_sum load_of_ball(const S& s, std::int32_t pebble) {
    const std::size_t b = s.grains.ball(pebble);
    load_sum sum = sum_light(s, b, s.position(pebble), 0.0);
    if constexpr (S::field_type::acts)
        sum.force += s.settings.field.force(
            {s.grains.ball_mass(s.at(pebble)), s.position(pebble), s.grains.motion[b].v, s.broken.time});
    return sum;
}
/// A ball without a bond, by one sub-step h (s).
template <class S> void advance_ball(S& s, std::int32_t pebble, double h) {
    const std::size_t p = s.at(pebble), b = s.grains.ball(pebble);
    body_motion& m = s.grains.motion[b];
    const load_sum sum = load_of_ball(s, pebble);
    const auto& scheme = s.settings.scheme;
    const vec3 df = scheme.extra(sum.force, m.v), dm = scheme.extra(sum.moment, m.w);
    const vec3 v = m.v, w = m.w;
    m.v = scheme.kick(v, sum.force + df, h / s.grains.ball_mass(p));
    m.w = scheme.kick(w, sum.moment + dm, h / s.grains.ball_inertia(p));
    m.x += 0.5 * h * (v + m.v);
    s.grains.losses[b].damping -= 0.5 * h * (dot(df, v + m.v) + dot(dm, w + m.w));
    s.grains.losses[b].friction += sum.dissipated;
}

/// The clusters of one batch of a pool, by one sub-step.
template <class S>
void advance_batch(S& s, std::size_t which, std::size_t batch, double h, std::vector<bonds::break_report>& report) {
    bonds::cluster_pool& pool = s.broken.pools[which];
    const std::size_t n = pool.shape().size();
    std::vector<bonds::ball_motion> balls(lanes * n);
    std::vector<bonds::pebble_load> load(lanes * n);
    std::vector<vec3> moved(lanes * n);
    std::array<std::int32_t, lanes> first{};
    std::array<bool, lanes> live{};
    for (std::size_t l = 0; l < lanes; ++l) {
        const std::int32_t cluster = pool.living(batch, l);
        live[l] = cluster >= 0;
        if (!live[l]) continue;
        first[l] = s.grains.grains[s.at(s.broken.members[which][s.at(cluster)])].first;
        for (std::size_t k = 0; k < n; ++k) {
            const std::int32_t p = first[l] + static_cast<std::int32_t>(k);
            const std::size_t b = s.grains.ball(p);
            const body_motion& m = s.grains.motion[b];
            const load_sum sum = load_of_ball(s, p);
            balls[l * n + k] = {m.v, m.w, s.position(p)};
            load[l * n + k] = {sum.force, sum.moment};
            s.grains.losses[b].friction += sum.dissipated;
        }
    }
    const auto lost = pool.advance(batch, h, balls, load, moved, report);
    for (std::size_t l = 0; l < lanes; ++l) {
        if (!live[l]) continue;
        for (std::size_t k = 0; k < n; ++k) {
            body_motion& m = s.grains.motion[s.grains.ball(first[l]) + k];
            m.x += moved[l * n + k];
            m.v = balls[l * n + k].velocity;
            m.w = balls[l * n + k].spin;
        }
        s.grains.losses[s.grains.ball(first[l])].damping += lost[l];
    }
}
/// Clusters feel the contact forces of the middle of the sub-step, constant over it, while their bonds take small
/// steps. Forces held on from the instant at which they were evaluated would feed energy into every contact.
template <class S> void advance_clusters(S& s, std::size_t which, double h) {
    bonds::cluster_pool& pool = s.broken.pools[which];
    pool.pack();
    std::vector<std::vector<bonds::break_report>> reports(pool.batches());
    s.settings.run.for_each(
        pool.batches(), [&](std::size_t batch) { advance_batch(s, which, batch, h, reports[batch]); }, 1);
    std::vector<bonds::break_report> broken;
    for (const auto& batch : reports) broken.insert(broken.end(), batch.begin(), batch.end());
    std::sort(broken.begin(), broken.end(), bonds::told_before);
    const std::size_t listed = s.light.size();
    for (const bonds::break_report& r : broken) part(s, which, r);
    if (s.light.size() != listed) s.index_light();
}

/// Light bodies from t_n - lag to t_n + dt/2 in sub-steps; the mean of what they do to clumps and facets.
template <class S> void advance_light_bodies(S& s) {
    if constexpr (S::breakable) {
        auto& b = s.broken;
        if (!b.has_balls()) return;
        const double span = b.lag + 0.5 * s.dt;
        const double h = span / s.light_steps, share = 1.0 / s.light_steps;
        b.halo_load.resize(s.grains.grain_count());
        b.halo_list.clear();
        for (std::size_t g = 0; g < s.grains.grain_count(); ++g)
            if (b.halo[g] != 0) b.halo_list.push_back(g), b.halo_load[g] = {};
        std::fill(s.light_loads.begin(), s.light_loads.end(), boundaries::facet_load{});
        for (int k = 0; k < s.light_steps; ++k) {
            const double ahead = (k + 0.5) * h - b.lag;
            b.time = s.totals.time + ahead;
            place_balls(s, 0.5 * h);
            evaluate_light(s, h, ahead);
            s.couplings.clear(); // those of the last sub-step are kept
            add_loads(s, s.light_wall, share, s.light_loads, &s.couplings);
            s.settings.run.for_each(b.halo_list.size(), [&](std::size_t i) {
                const std::size_t g = b.halo_list[i];
                const body_motion& m = s.grains.motion[g];
                const load_sum sum = sum_light(s, g, m.x + ahead * m.v, ahead);
                breakage_state::mean_load& mean = b.halo_load[g];
                mean.force += share * sum.force;
                mean.moment += share * sum.moment;
                mean.dissipated += sum.dissipated;
            });
            s.settings.run.for_each(b.balls.size(), [&](std::size_t i) {
                if (b.bonded[s.at(b.balls[i])] == 0) advance_ball(s, b.balls[i], h);
            });
            for (std::size_t p = 0; p < b.pools.size(); ++p) advance_clusters(s, p, h);
        }
    }
}
/// After heavy bodies have moved: balls trail t_n by half a step, and are placed where they are at t_n.
template <class S> void bring_balls_to_step(S& s) {
    if constexpr (S::breakable) {
        s.broken.lag = 0.5 * s.dt;
        place_balls(s, s.broken.lag);
    }
}

// ---- sub-steps ------------------------------------------------------------------------------------------------------

/// Step (s) that a ball allows, with its own mass and its contacts. stiffness: of a typical contact (N/m).
template <class S> double ball_limit(const S& s, std::int32_t pebble, double stiffness) {
    const double mass = s.grains.ball_mass(s.at(pebble)), inertia = s.grains.ball_inertia(s.at(pebble));
    stiffness_sum k(mat3::identity());
    add_stiffness(s, k, s.light_of, s.grains.ball(pebble), s.light, s.light_wall, s.position(pebble));
    return std::min(typical_limit(s, mass, stiffness),
                    k.time_step(mass, {inertia, inertia, inertia}, s.settings.safety));
}
/// Step (s) that all balls allow, each by itself. A cluster is as slow as it is heavy only as long as its bonds are far
/// stiffer than its contacts, and none of them breaks: a small ball at its surface that is let go within a sub-step has
/// the contact force of the whole for the rest of it. Infinite without balls.
template <class S> double limit_of_balls(const S& s) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const std::vector<std::int32_t>& balls = s.broken.balls;
    if (balls.empty()) return infinite;
    const double stiffness = typical_stiffness(s);
    return -s.settings.run.max(balls.size(), -infinite,
                               [&](std::size_t k) { return -ball_limit(s, balls[k], stiffness); });
}
/// Shrinks the step to what balls and bonds together allow, so that neither takes another: frequencies add up in their
/// squares. What balls trail is still half of a longer step, which takes sub-steps for once.
template <class S> void take_one_step(S& s, double balls) {
    double bonds = std::numeric_limits<double>::infinity();
    for (const bonds::cluster_pool& pool : s.broken.pools) bonds = std::min(bonds, pool.longest_step());
    s.dt = std::min(s.dt, 1.0 / std::sqrt(1.0 / (balls * balls) + 1.0 / (bonds * bonds)));
    s.estimate_due = s.estimate_due || s.broken.lag > 0.5 * s.dt;
}
/// Sub-steps of light bodies, or a step that they can take as well (stepping). Follows estimate_step().
template <class S> void estimate_light_steps(S& s) {
    if constexpr (S::breakable) {
        const double balls = limit_of_balls(s);
        if (s.broken.has_balls() && !takes_sub_steps(s.settings)) take_one_step(s, balls);
        const double limit = std::min(s.dt, balls);
        // the span is (old dt + dt) / 2, and dt grows by 2 % at most
        s.light_steps =
            std::max(1, static_cast<int>(std::ceil(std::max(s.dt, 0.5 * s.dt + s.broken.lag) / limit - 1e-9)));
    }
}

} // namespace clast::rooms
