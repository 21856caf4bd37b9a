// SPDX-License-Identifier: MIT
// Small scenes of every kind of specimen, law and boundary, and the digest with which each ends; `run` compares these
// with those in recorded.txt.
//
//   scenes [regular expression of names]
//
// A line per scene on 1, 2 and 3 threads, and once from a state that was stored half way: name/threads, digest.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <regex>
#include <string>
#include <utility>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/core/random.hpp>
#include <clast/engine/engine.hpp>
#include <clast/io/archive.hpp>
#include <clast/measure/digest.hpp>
#include <clast/spaces/periodic.hpp>
#include <fmt/core.h>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

/// Whole grains of one kind in a boundary.
template <class Boundary, class Body = bodies::clumps, class Contact = contacts::linear>
struct whole : triaxial_policies_default {
    using contact = Contact;
    using body = Body;
    using boundary = Boundary;
    using breakage = criteria::none;
    using replacement = replacements::none;
};

/// The same in a periodic cell.
template <class Body, class Contact = contacts::linear> struct in_cell : whole<boundaries::none, Body, Contact> {
    using space = spaces::periodic;
};

template <class P> engine_settings<P> cut_in_ranges(engine_settings<P> s, int threads) {
    s.run = execution(threads);
    s.contacts_per_thread = 8; // cut even small scenes
    return s;
}
template <class P> engine_settings<P> one_law(const typename P::contact& law, double damping, int threads) {
    typename P::contact wall = law;
    wall.mu = 0.0;
    return cut_in_ranges<P>({.grain_contact = law,
                             .platen_contact = wall,
                             .lateral_contact = wall,
                             .breakage = {},
                             .replacement = {},
                             .scheme = {.damping = damping}},
                            threads);
}

/// Calls f(k, place) for n^3 places on a grid around the origin (m).
template <class F> void each_on_grid(int n, double spacing, F&& f) {
    const auto at = [&](int i) { return spacing * (i - 0.5 * (n - 1)); };
    for (int k = 0; k < n * n * n; ++k) f(k, vec3{at(k % n), at(k / n % n), at(k / n / n)});
}
/// Spheres of 16 to 20 mm that move at random (0.1 m/s).
bodies::spheres spheres(int n, double spacing) {
    bodies::spheres s;
    each_on_grid(n, spacing, [&](int k, const vec3& x) {
        random_stream random{3, static_cast<std::uint64_t>(k)};
        s.add(x, uniform(random, 0.008, 0.01));
        s.pebbles.back().v = 0.1 * direction(random);
    });
    return s;
}
/// Clumps of 20 mm, turned at random, at rest.
bodies::clumps clumps(const shape& grain, int n, double spacing) {
    bodies::clumps s = scenes::empty(grain);
    each_on_grid(n, spacing, [&](int k, const vec3& x) {
        random_stream random{5, static_cast<std::uint64_t>(k)};
        s.add(0, x, orientation(random));
    });
    return s;
}
boundaries::box box(double edge, double stiffness) {
    boundaries::box_settings s;
    s.low = {-0.5 * edge, -0.5 * edge, -0.5 * edge};
    s.high = -s.low;
    s.contact_stiffness_floor = stiffness;
    return boundaries::box(s);
}
template <class P> void press(engine<P>& e, double speed) {
    e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = speed}; // each (m/s)
}

// A scene: start(threads) packs, press(engine) drives; enough(engine): something happened that the digest is of.

/// Clumps of 14 that become clusters and break, between tiles.
struct clumps_14_break_in_tiles {
    using policies = scenes::breakable<boundaries::tiles>;
    static constexpr std::int64_t steps = 1200;
    static engine<policies> start(int threads) {
        auto s =
            cut_in_ranges(scenes::settings<policies>(1e6, 0.08), threads); // Pa; the share of the strength of bonds
        return scenes::packed<policies>(s, shapes::apollonian_14(circumscribed(0.02)), 60, 0.052, 2e5, 2000);
    }
    static void press(engine<policies>& e) {
        e.breakage_on = true;
        ::press(e, 0.2);
    }
    static bool enough(const engine<policies>& e) {
        return e.totals().broken_tension + e.totals().broken_shear >= 20 && e.light_contacts().size() > 0;
    }
};

struct clumps_4_in_ring_walls {
    using policies = scenes::unbreakable<boundaries::ring_walls>;
    static constexpr std::int64_t steps = 3000;
    static engine<policies> start(int threads) {
        return scenes::packed<policies>(cut_in_ranges(scenes::settings<policies>(), threads),
                                        shapes::tetrahedron_4(circumscribed(0.02)), 90, 0.062, 2e5, 2000, 2);
    }
    static void press(engine<policies>& e) { ::press(e, 0.1); }
    static bool enough(const engine<policies>& e) { return e.boundary.axial_stress(e.loads()) > 5e4; }
};

struct spheres_in_box {
    using policies = whole<boundaries::box, bodies::spheres>;
    static constexpr std::int64_t steps = 1500;
    static engine<policies> start(int threads) {
        engine<policies> e(one_law<policies>({1e6, 5e5, 0.3}, 0.5, threads), spheres(7, 0.0205), box(0.1435, 1e6));
        e.drives = scenes::isotropic(1e5, 0.5);
        e.step(2500);
        return e;
    }
    static void press(engine<policies>& e) { ::press(e, 0.1); }
    static bool enough(const engine<policies>& e) { return e.boundary.axial_stress(e.loads()) > 5e4; }
};

struct clumps_14_in_box {
    using policies = whole<boundaries::box>;
    static constexpr std::int64_t steps = 1000;
    static engine<policies> start(int threads) {
        engine<policies> e(one_law<policies>({2.9e6, 1.45e6, 0.3}, 0.7, threads),
                           clumps(shapes::apollonian_14(circumscribed(0.02)), 5, 0.0205), box(0.104, 2.9e6));
        e.drives = scenes::isotropic(2e5, 0.5);
        e.step(1500);
        return e;
    }
    static void press(engine<policies>& e) { ::press(e, 0.1); }
    static bool enough(const engine<policies>& e) { return e.boundary.axial_stress(e.loads()) > 1e5; }
};

/// Nothing but dashpots takes energy out.
struct spheres_in_cell_with_dashpots {
    using policies = in_cell<bodies::spheres, contacts::linear_dashpot>;
    static constexpr std::int64_t steps = 1200;
    static engine<policies> start(int threads) {
        constexpr int n = 7;
        const contacts::linear_dashpot law{.kn = 1e6, .ks = 5e5, .mu = 0.3, .gamma = 2000.0};
        auto s = one_law<policies>(law, 0.0, threads);
        s.safety = 0.4;
        engine<policies> e(s, spheres(n, 0.0205), spaces::periodic({0.0205 * n, 0.0205 * n, 0.0205 * n}));
        for (auto& axis : e.space.axes) axis = {.target = 5e4, .max_rate = 5.0, .gain = 0.2}; // Pa, 1/s
        e.step(2000);
        return e;
    }
    static void press(engine<policies>& e) { e.space.axes[2] = {.rate = -0.5}; } // 1/s
    static bool enough(const engine<policies>& e) { return e.space.stress().z > 2e4; }
};

struct clumps_4_in_cell {
    using policies = in_cell<bodies::clumps>;
    static constexpr std::int64_t steps = 1500;
    static engine<policies> start(int threads) {
        constexpr int n = 5;
        engine<policies> e(one_law<policies>({2.9e6, 1.45e6, 0.3}, 0.3, threads),
                           clumps(shapes::tetrahedron_4(circumscribed(0.02)), n, 0.0205),
                           spaces::periodic({0.0205 * n, 0.0205 * n, 0.0205 * n}));
        for (auto& axis : e.space.axes) axis = {.target = 1e5, .max_rate = 5.0, .gain = 0.2};
        e.step(6000);
        return e;
    }
    static void press(engine<policies>& e) { e.space.axes[2] = {.rate = -1.0}; }
    static bool enough(const engine<policies>& e) { return e.space.stress().z > 5e4; }
};

struct clumps_4_of_hertz {
    using policies = whole<boundaries::solid_strips, bodies::clumps, scenes::hertz>;
    static constexpr std::int64_t steps = 1500;
    static engine<policies> start(int threads) {
        engine_settings<policies> s{.grain_contact = {5e8, 0.3},
                                    .platen_contact = {9e8},
                                    .lateral_contact = {4e8},
                                    .breakage = {},
                                    .replacement = {}};
        return scenes::packed<policies>(cut_in_ranges(s, threads), shapes::tetrahedron_4(circumscribed(0.02)), 90,
                                        0.062, 2e5, 2000);
    }
    static void press(engine<policies>& e) { ::press(e, 0.1); }
    static bool enough(const engine<policies>& e) { return e.boundary.axial_stress(e.loads()) > 1e5; }
};

/// Goes on from `e`, through an archive into another engine half way if `stored`.
template <class Scene, class Engine> std::uint64_t end_of(Engine e, bool stored, const std::string& name) {
    constexpr std::int64_t half = Scene::steps / 2;
    Scene::press(e);
    e.step(half);
    (void)e.take_events();
    if (stored) {
        Engine other = Scene::start(2);
        from_bytes(to_bytes(e), other);
        e = std::move(other);
    }
    e.step(Scene::steps - half);
    (void)e.take_events();
    if (!Scene::enough(e)) throw input_error(fmt::format("{}: too little happened for the scene to show much", name));
    return measure::digest(e);
}
template <class Scene> void run(const std::string& name, const std::regex& wanted) {
    const auto print = [&](const std::string& how, int threads, bool stored) {
        const std::string line = fmt::format("{}/{}", name, how);
        if (std::regex_search(line, wanted))
            fmt::print("{} {:016x}\n", line, end_of<Scene>(Scene::start(threads), stored, line));
    };
    for (const int threads : {1, 2, 3}) print(std::to_string(threads), threads, false);
    print("stored", 3, true);
}

} // namespace

int main(int count, char** words) try {
    const std::regex wanted(count > 1 ? words[1] : "", std::regex::extended);
    run<clumps_14_break_in_tiles>("clumps_14_break_in_tiles", wanted);
    run<clumps_4_in_ring_walls>("clumps_4_in_ring_walls", wanted);
    run<spheres_in_box>("spheres_in_box", wanted);
    run<clumps_14_in_box>("clumps_14_in_box", wanted);
    run<spheres_in_cell_with_dashpots>("spheres_in_cell_with_dashpots", wanted);
    run<clumps_4_in_cell>("clumps_4_in_cell", wanted);
    run<clumps_4_of_hertz>("clumps_4_of_hertz", wanted);
    return 0;
} catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
}
