// SPDX-License-Identifier: MIT
// Which pairs may touch, and until when.
//
// A search names all pairs within a wide margin; the lists hold those of them that may touch while every body goes a
// small margin of its own, and are renewed from what the search has found until the wide margin is used up. To choose
// from sorted pairs costs a fifth of a search or less, so margins may be small, and hardly an open pair is evaluated.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/engine/pebble_pairs.hpp>
#include <clast/engine/scene.hpp>
#include <clast/engine/wall_friction.hpp>

namespace clast::rooms {

template <class S> [[noreturn]] void explain_nan(const S& s) {
    const auto blame = [&](std::string what, std::size_t number) {
        throw run_error({fmt::format("the motion of {} {} is not a finite number", what, number),
                         fmt::format("{} {}", what, number),
                         fmt::format("step {}, t = {:.6g} s", s.totals.steps, s.totals.time),
                         "forces grew without bound: the time step is too large for a contact or a bond, or two "
                         "centres passed each other",
                         "lower `safety` of the time step, the loading rate or the stress"});
    };
    for (std::size_t b = 0; b < s.grains.body_count(); ++b)
        if (!is_finite(s.grains.centre(b))) blame("grain", b);
    s.broken.each_ball(s.grains, [&](std::int32_t p, const body_motion& m) {
        if (!is_finite(m.x)) blame("ball", s.at(p));
    });
    throw run_error({"a displacement is not a finite number", "unknown body",
                     fmt::format("step {}, t = {:.6g} s", s.totals.steps, s.totals.time), "unstable time step",
                     "lower `safety` of the time step"});
}

// ---- threads --------------------------------------------------------------------------------------------------------

/// Whether the bodies of a pair are swept by different threads.
template <class S> auto between_ranges(const S& s) {
    return [&s](const pebble_pair& p) { return s.ranges.are_apart(s.grains.body_of(p.i), s.grains.body_of(p.j)); };
}
/// Cuts the bodies into one range for each thread, by the pairs that the search has found, and brings the pairs between
/// two ranges to the front, of its list and so of those that are chosen from it.
template <class S> void cut_ranges(S& s) {
    const std::size_t pairs = s.near.wide.heavy.size();
    // of the pairs that a search finds about half are listed
    const std::size_t enough = 2 * std::max<std::size_t>(1, s.settings.contacts_per_thread);
    s.ranges.cut(s.grains.body_count(), s.near.wide.heavy.pairs,
                 std::clamp<std::size_t>(pairs / enough, 1, static_cast<std::size_t>(s.settings.run.threads())),
                 s.body_of());
    s.sweeping.resize(s.ranges.size());
    s.acting.assign(s.grains.body_count(), {});
    if (s.ranges.size() > 1) bring_shared_forward(s.near.wide.heavy, between_ranges(s));
}
template <class S> void index_ranges(S& s) {
    s.ranges.index(s.heavy, s.heavy_wall, s.settings.run, s.body_of());
    s.shared_load.resize(s.heavy.shared);
    s.crossings.index(s.heavy, s.settings.run, s.pair_order());
}

// ---- margins --------------------------------------------------------------------------------------------------------

/// How much a strain, or a rate of strain, of the space brings two grains together that a search names (m, m/s).
template <class S> double strain_travel(const S& s, const vec3& strain) {
    return s.space.travel(strain, s.near.widest + s.near.widths.margin());
}
/// The same for its strain since then (m).
template <class S, class Origin> double travel_since(const S& s, const Origin& then) {
    return strain_travel(s, s.space.stretch_since(then.frame) - vec3{1.0, 1.0, 1.0});
}
/// How far (m) every body may go before lists are renewed: half the skin, and more the faster it is. So a few fast
/// bodies neither make renewals due for all nor the lists of all long.
template <class S> void choose_margins(S& s) {
    const execution& run = s.settings.run;
    const std::size_t n = s.grains.body_count();
    std::vector<double>& margins = s.near.margins;
    const vec3 flow = s.space.rates();
    margins.resize(s.grains.movable_count());
    run.for_each(n, [&](std::size_t b) { margins[b] = s.grains.is_swept(b) ? s.grains.surface_speed(b, flow) : 0.0; });
    const double sum = run.sum(n, 0.0, [&](std::size_t b) { return margins[b]; });
    if (!std::isfinite(sum)) explain_nan(s);
    const double usual = sum / static_cast<double>(std::max<std::size_t>(1, n));
    // or the search would not do, and the next be due at once
    const double most = 0.125 * s.near.widths.margin();
    const auto margin = [&](double speed) {
        const double beside = speed > 0.0 ? speed / usual : 0.0; // infinite where all others are at rest
        return std::min(0.5 * s.near.widths.skin() * (1.0 + 2.0 * beside), most);
    };
    run.for_each(n, [&](std::size_t b) { margins[b] = margin(margins[b]); });
    s.broken.each_ball(s.grains,
                       [&](std::int32_t p, const body_motion& m) { margins[s.grains.body_of(p)] = margin(norm(m.v)); });
    s.near.wall_margin = margin(std::max(s.boundary.fastest(), strain_travel(s, flow)));
}
/// Whether the last search has found all pairs that the lists need now.
template <class S> bool wide_lists_hold(const S& s) {
    const auto& wide = s.near.wide;
    const vec3 stretch = s.space.stretch_since(wide.since.frame);
    double largest = s.settings.run.max(s.grains.body_count(), 0.0, [&](std::size_t b) {
        return s.grains.is_swept(b) ? s.grains.moved(b, wide.since.bodies[b], stretch) + s.near.margins[b] : 0.0;
    });
    largest = s.broken.largest(s.grains, s.settings.run, largest, [&](std::int32_t p, const body_motion&) {
        return norm(s.position(p) - wide.since.balls[s.at(p)]) + s.near.margins[s.grains.body_of(p)];
    });
    const double nearer = std::max(2.0 * largest, largest + wide.since.wall_travel) + travel_since(s, wide.since);
    return nearer + s.near.wall_margin < s.near.widths.margin();
}
template <class S, class Origin> void set_origin(const S& s, Origin& now) {
    now.bodies.resize(s.grains.body_count());
    s.settings.run.for_each(s.grains.body_count(), [&](std::size_t b) { now.bodies[b] = s.grains.refer(b); });
    s.broken.note_places(s.grains, now.balls);
    now.frame = s.space.here();
    now.wall_travel = 0.0;
}
/// Lists are renewed before a pair that they leave out can touch: when a body has used up its margin, or walls and
/// strain theirs. use: what heavy bodies have used.
template <class S> void check_margins(S& s, margin_use use) {
    const double worst = s.broken.largest(s.grains, s.settings.run, -1.0, [&](std::int32_t p, const body_motion& m) {
        const double way = norm(s.position(p) - s.near.since.balls[s.at(p)]) + 2.0 * s.dt * norm(m.v);
        return std::isfinite(way) ? way - s.near.margins[s.grains.body_of(p)] : std::numeric_limits<double>::infinity();
    });
    use = std::max(use, worst < 0.0            ? margin_use::within
                        : std::isfinite(worst) ? margin_use::used_up
                                               : margin_use::not_finite);
    if (use == margin_use::not_finite) explain_nan(s);
    if (use == margin_use::used_up ||
        std::max(s.near.since.wall_travel, travel_since(s, s.near.since)) >= s.near.wall_margin) {
        s.near.must_renew = true;
        s.near.widths.skin_is_used_up();
    }
}
/// Walls have moved by a way (m).
template <class S> void count_wall_travel(S& s, double way) {
    s.near.since.wall_travel += way;
    s.near.wide.since.wall_travel += way;
}

// ---- search ---------------------------------------------------------------------------------------------------------

template <class S> list_widths::counts counts(const S& s) { return {s.grains.body_count(), s.grains.pebble_count()}; }

/// Finds all pairs within the wide margin: first bodies by their bounding spheres, then pebbles; and the pebbles near
/// walls.
template <class S> void search(S& s) {
    auto& wide = s.near.wide;
    const std::size_t n = s.grains.body_count();
    if (S::space_type::has_images) {
        s.near.widest = 0.0;
        for (std::size_t b = 0; b < n; ++b) s.near.widest = std::max(s.near.widest, 2.0 * s.grains.bounding_radius(b));
    }
    s.near.widths.choose_margin(counts(s), s.space.room(s.near.widest));
    const double margin = s.near.widths.margin() + contacts::reach_of(s.settings.grain_contact);
    search_spheres spheres;
    spheres.all.reserve(2 * n); // with images
    for (std::size_t b = 0; b < n; ++b)
        if (s.grains.is_swept(b))
            spheres.all.push_back({s.grains.centre(b), s.grains.bounding_radius(b), static_cast<std::int32_t>(b)});
    s.broken.each_ball(s.grains, [&](std::int32_t p, const body_motion&) {
        spheres.all.push_back({s.position(p), s.radius(p), static_cast<std::int32_t>(s.grains.body_of(p))});
    });
    s.space.gather(s, spheres);
    auto found = pebble_pairs(s.grains, s.space, margin, s.settings.run)
                     .of(spheres, typename S::policies::search{}.pairs(spheres.all, margin));
    wide.heavy = std::move(found.heavy);
    wide.light = std::move(found.light);
    s.broken.put_asleep(s.grains, wide.light.pairs, s.asleep); // what a bond carries
    wide.wall.clear();
    for (std::size_t b = 0; S::has_walls && b < n; ++b) {
        if (s.grains.is_swept(b) && !s.boundary.near(s.grains.centre(b), s.grains.bounding_radius(b) + margin))
            continue;
        const index_range own = s.grains.pebbles_of(b);
        for (auto p = static_cast<std::int32_t>(own.begin); p < static_cast<std::int32_t>(own.end); ++p)
            if (s.boundary.near(s.position(p), s.radius(p) + margin)) wide.wall.push_back(p);
    }
    cut_ranges(s);
    set_origin(s, wide.since);
    choose_margins(s); // within the new wide margin
    s.near.must_search = false;
    ++s.totals.rebuilds;
}

// ---- lists ----------------------------------------------------------------------------------------------------------

/// The pairs of one wide list whose gap is not larger than the margins of both bodies, with empty histories. Counts
/// those that do not touch.
template <class S> contact_list<typename S::history> chosen(const S& s, const pair_list& wide, std::size_t& open) {
    const execution& run = s.settings.run;
    const auto margin_of = [&](std::int32_t pebble) { return s.near.margins[s.grains.body_of(pebble)]; };
    const double reach_of_law = contacts::reach_of(s.settings.grain_contact);
    const double strain_margin = S::space_type::has_images ? s.near.wall_margin : 0.0;
    const auto is_open = std::make_unique_for_overwrite<std::uint8_t[]>(wide.size());
    const std::vector<std::uint32_t> kept = run.where(wide.size(), [&](std::size_t k) {
        const pebble_pair& p = wide.pairs[k];
        const double touch = s.radius(p.i) + s.radius(p.j) + reach_of_law;
        const double reach = touch + margin_of(p.i) + margin_of(p.j) + strain_margin,
                     distance2 = norm2(s.apart(wide, k));
        is_open[k] = distance2 < touch * touch ? 0 : 1;
        return distance2 < reach * reach;
    });
    open += run.sum(kept.size(), std::size_t{0}, [&](std::size_t k) { return std::size_t{is_open[kept[k]]}; });
    contact_list<typename S::history> list;
    list.shared = static_cast<std::size_t>(std::lower_bound(kept.begin(), kept.end(), wide.shared) - kept.begin());
    list.pairs.resize(kept.size());
    if (S::space_type::has_images) list.image.resize(kept.size());
    run.for_each(
        kept.size(),
        [&](std::size_t k) {
            list.pairs[k] = wide.pairs[kept[k]];
            if (S::space_type::has_images) list.image[k] = wide.image[kept[k]];
        },
        1024);
    list.resize();
    return list;
}
template <class S> void choose_walls(S& s) {
    // what pebbles remember of walls that rub, and where it is
    std::vector<typename S::wall_grip> old;
    std::vector<std::int32_t> place;
    if (s.walls_rub()) {
        place.assign(s.grains.pebble_count(), -1);
        const auto note = [&](const auto& wall, const auto& grips) {
            for (std::size_t k = 0; k < grips.size(); ++k) {
                place[s.at(wall[k].pebble)] = static_cast<std::int32_t>(old.size());
                old.push_back(grips[k]);
            }
        };
        note(s.heavy_wall, s.heavy_grip);
        if constexpr (S::breakable) note(s.light_wall, s.light_grip);
    }
    s.heavy_wall.clear(), s.light_wall.clear(), s.heavy_grip.clear(), s.light_grip.clear();
    for (std::int32_t p : s.near.wide.wall) {
        const std::size_t body = s.grains.body_of(p);
        if (!s.boundary.near(s.position(p), s.radius(p) + s.near.margins[body] + s.near.wall_margin)) continue;
        boundaries::wall_row w;
        w.pebble = p;
        (body < s.grains.body_count() ? s.heavy_wall : s.light_wall).push_back(w);
    }
    if (!s.walls_rub()) return;
    s.heavy_grip = grips_for(s, s.heavy_wall, place, old);
    if constexpr (S::breakable) s.light_grip = grips_for(s, s.light_wall, place, old);
}
/// Which pebbles of clumps the lists name, and which not.
template <class S> void sort_pebbles(S& s) {
    if constexpr (!S::body_type::turns) return; // bodies are their pebbles
    std::vector<std::uint8_t> named(s.grains.pebble_count(), 0);
    const auto name = [&](const auto& list, const auto& wall) {
        for (const pebble_pair& p : list.pairs) named[s.at(p.i)] = named[s.at(p.j)] = 1;
        for (const auto& w : wall) named[s.at(w.pebble)] = 1;
    };
    name(s.heavy, s.heavy_wall);
    name(s.light, s.light_wall);
    const auto count = static_cast<std::size_t>(std::count(named.begin(), named.end(), 1));
    s.listed.resize(s.grains.body_count(), count);
    s.unlisted.resize(s.grains.body_count(), named.size() - count);
    std::size_t in = 0, out = 0;
    for (std::size_t b = 0; b < s.grains.body_count(); ++b) {
        const index_range own = s.grains.pebbles_of(b);
        for (std::size_t p = own.begin; p < own.end; ++p) { // no branch that depends on the packing
            s.listed.items[in] = s.unlisted.items[out] = static_cast<std::int32_t>(p);
            in += named[p], out += 1U - named[p];
        }
        s.listed.start[b + 1] = static_cast<std::uint32_t>(in);
        s.unlisted.start[b + 1] = static_cast<std::uint32_t>(out);
    }
}
/// The lists of contacts: what margins ask for of that which the last search has found. Histories carry over.
template <class S> void choose_lists(S& s) {
    std::size_t open = 0;
    const auto& wide = s.near.wide;
    auto heavy = chosen(s, wide.heavy, open);
    contact_list<typename S::history> light; // of balls: empty where nothing breaks
    if constexpr (S::breakable) light = chosen(s, wide.light, open);
    const bool anew = s.near.widths.is_fresh(); // else pairs stand in the same part of the same list as before
    s.near.widths.picked(s.totals.steps, open, wide.heavy.size() + wide.light.size() - heavy.size() - light.size());
    const auto take = [&](auto& list, index_range own, const auto& old, index_range there) {
        constexpr std::size_t chunk = 512;
        s.settings.run.for_each(
            (own.end - own.begin + chunk - 1) / chunk,
            [&](std::size_t c) {
                const std::size_t begin = own.begin + c * chunk;
                list.take_histories({begin, std::min(begin + chunk, own.end)}, old, there, s.pair_order());
            },
            1);
    };
    take(heavy, heavy.in_front(), s.heavy, s.heavy.in_front());
    take(heavy, heavy.behind(), s.heavy, s.heavy.behind());
    if (anew) {
        take(heavy, heavy.in_front(), s.heavy, s.heavy.behind());
        take(heavy, heavy.behind(), s.heavy, s.heavy.in_front());
    }
    if constexpr (S::breakable) {
        take(light, light.behind(), s.light, s.light.behind());
        if (anew) {
            take(light, light.behind(), s.heavy, s.heavy.in_front());
            take(light, light.behind(), s.heavy, s.heavy.behind());
            take(heavy, heavy.in_front(), s.light, s.light.behind()); // balls that were frozen
            take(heavy, heavy.behind(), s.light, s.light.behind());
        }
    }
    s.heavy = std::move(heavy);
    s.light = std::move(light);
    s.light.rows.assign(s.light.size(), {});

    if constexpr (S::has_walls) choose_walls(s);
    sort_pebbles(s);
    s.broken.find_halo(s);
    s.heavy_of.reset();
    index_ranges(s);
    set_origin(s, s.near.since);
    s.light_loads.assign(s.loads.size(), {});
    s.near.must_renew = false;
    ++s.totals.renewals;
}

/// Places the pebbles that no contact needed, too.
template <class S> void place_all(S& s) {
    if constexpr (S::body_type::turns)
        s.settings.run.for_each(s.grains.body_count(), [&](std::size_t b) {
            if (s.grains.is_swept(b)) s.grains.place(b, s.unlisted.of(b));
        });
}
/// Lists for the present positions, from a search if the last one does not do.
template <class S> void renew_lists(S& s) {
    place_all(s);
    s.near.widths.choose_skin(counts(s), s.totals.steps);
    choose_margins(s);
    if (!s.near.must_search && !wide_lists_hold(s)) {
        s.near.must_search = true;
        s.near.widths.margin_is_used_up();
    }
    if (s.near.must_search) search(s);
    choose_lists(s);
}
/// First lists, and lists after the boundary was exchanged.
template <class S> void make_lists(S& s) {
    s.loads.assign(static_cast<std::size_t>(s.boundary.facet_count()), {});
    search(s);
    choose_lists(s);
}
/// The lists as one thread would have them, which is how they are saved.
template <class S> void join_lists(S& s) {
    join_shared(s.near.wide.heavy, s.pair_order());
    join_shared(s.heavy, s.pair_order());
}
/// The lists as the threads of this run ask for, after they were saved or read.
template <class S> void part_lists(S& s) {
    s.heavy_of.reset();
    if (!s.near.must_search) { // else pairs may name clumps that are none any more, and the next step cuts anew
        cut_ranges(s);
        bring_shared_forward(s.heavy, between_ranges(s));
        index_ranges(s);
    }
    // like rows, written anew by the next step
    s.light.rows.resize(s.light.size());
    s.loads.resize(static_cast<std::size_t>(s.boundary.facet_count()));
    s.light_loads.resize(s.loads.size());
}

} // namespace clast::rooms
