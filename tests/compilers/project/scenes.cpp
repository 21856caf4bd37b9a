// SPDX-License-Identifier: MIT
// Two scenes whose bits are compared between compilers, flags and numbers of threads; `../run` builds and compares.
//
//   scenes <folder> [threads]             from nothing to the end: a checksum every 100 steps, and states in the folder
//   scenes <folder> <another folder>      some steps only, from the states that another program left
//   scenes compare <folder> <folder>      how far these steps lead apart
//
// Checksums tell whether any bit differs, and in which 100 steps that begins.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/stepped_tiles.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/core/random.hpp>
#include <clast/engine/engine.hpp>
#include <clast/io/archive.hpp>
#include <clast/spaces/periodic.hpp>
#include <fmt/core.h>

#include "engine/scenes.hpp"

using namespace clast;

namespace {

constexpr std::int64_t row = 100; ///< steps between checksums

/// Clumps of 14 with local damping in a membrane of stepped tiles, pressed until some are bonded clusters that break.
struct clumps {
    using policies = scenes::breakable<boundaries::stepped_tiles>;
    static constexpr const char* name = "clumps";
    static constexpr const char* what = "broken bonds";
    static constexpr double diameter = 0.02, stress = 2e5; // m, Pa

    static engine<policies> start(int threads) {
        auto s = scenes::settings<policies>(1.5e6, 0.12); // Pa; the share of the strength of bonds
        s.run = execution(threads);
        s.contacts_per_thread = 8; // cut even this scene into ranges
        return scenes::packed<policies>(s, shapes::apollonian_14(circumscribed(diameter)), 60, 0.052, stress, 1500);
    }
    static void press(engine<policies>& e) {
        e.breakage_on = true;
        e.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.2}; // each (m/s)
    }
    static std::int64_t events(const engine<policies>& e) {
        return e.totals().broken_tension + e.totals().broken_shear;
    }
    static constexpr std::int64_t steps = 1200, least_events = 20;
};

/// Spheres with dashpots in a periodic cell that two servos and a rate deform.
struct spheres {
    struct policies : triaxial_policies_default {
        using contact = contacts::linear_dashpot;
        using body = bodies::spheres;
        using boundary = boundaries::none;
        using space = spaces::periodic;
        using breakage = criteria::none;
        using replacement = replacements::none;
    };
    static constexpr const char* name = "spheres";
    static constexpr const char* what = "contacts";
    static constexpr double diameter = 0.02, stress = 5e4; // m, Pa

    static engine<policies> start(int threads) {
        constexpr int n = 7;
        bodies::spheres s;
        for (int k = 0; k < n * n * n; ++k) {
            const auto at = [](int i) { return 0.0205 * (i - 0.5 * (n - 1)); };
            random_stream random{3, static_cast<std::uint64_t>(k)};
            s.add({at(k % n), at(k / n % n), at(k / n / n)}, uniform(random, 0.4, 0.5) * diameter);
            s.pebbles.back().v = 0.1 * direction(random);
        }
        const contacts::linear_dashpot law{.kn = 1e6, .ks = 5e5, .mu = 0.3, .gamma = 2000.0};
        engine<policies> e({.grain_contact = law,
                            .platen_contact = law,
                            .lateral_contact = law,
                            .breakage = {},
                            .replacement = {},
                            .scheme = {.damping = 0.0},
                            .safety = 0.4,
                            .run = execution(threads),
                            .contacts_per_thread = 8},
                           s, spaces::periodic({0.0205 * n, 0.0205 * n, 0.0205 * n}));
        for (auto& axis : e.space.axes) axis = {.target = stress, .max_rate = 5.0, .gain = 0.2}; // Pa, 1/s
        e.step(3000);
        return e;
    }
    static void press(engine<policies>& e) { e.space.axes[2] = {.rate = -0.5}; } // 1/s
    static std::int64_t events(const engine<policies>& e) {
        std::int64_t touching = 0;
        e.each_contact([&](const force_row& r, const pebble_pair&) { touching += r.depth > 0.0 ? 1 : 0; });
        return touching;
    }
    static constexpr std::int64_t steps = 1200, least_events = 300;
};

/// What `compare` reads: vectors of one kind after the other.
struct state {
    std::vector<double> places;        ///< of pebbles (m)
    std::vector<double> speeds, spins; ///< of bodies (m/s, rad/s)
    std::vector<double> forces;        ///< of contacts (N)
    template <class A> void archive(A& a) { a(places, speeds, spins, forces); }
};
template <class P> state state_of(engine<P>& e) {
    state s;
    e.place_all();
    const auto add = [](std::vector<double>& to, const vec3& v) { to.insert(to.end(), {v.x, v.y, v.z}); };
    for (const auto& p : e.grains.pebbles) add(s.places, p.x);
    const auto& bodies = [&]() -> const auto& {
        if constexpr (P::body::turns)
            return e.grains.motion;
        else
            return e.grains.pebbles;
    }
    ();
    for (const auto& b : bodies) add(s.speeds, b.v), add(s.spins, b.w);
    e.each_contact([&](const force_row& r, const pebble_pair&) { add(s.forces, r.force); });
    return s;
}

void write(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!out.flush()) throw input_error(fmt::format("cannot write {}", file.string()));
}
std::vector<std::byte> read(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw input_error(fmt::format("cannot read {}", file.string()));
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    std::vector<std::byte> bytes(text.size());
    std::transform(text.begin(), text.end(), bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
    return bytes;
}

/// A state and where some steps from it lead.
struct leg {
    std::string from, to;
    std::int64_t steps;
};
/// Packed grains, in whose motion rounding grows slowly.
template <class Scene> leg early() {
    return {fmt::format("{}.packed", Scene::name), fmt::format("{}.packed.end", Scene::name), row};
}
/// At the end. Balls that swing in bonds under local damping of 0.7 part by a factor of 3 to 4 per step (with bond
/// steps ten times finer, too; at a damping of 0.3 they do not): so clusters are followed for one step.
template <class Scene> leg late() {
    return {fmt::format("{}.pressed", Scene::name), fmt::format("{}.pressed.end", Scene::name), 1};
}
template <class P> void advance(engine<P>& e, std::int64_t steps) {
    e.step(steps);
    (void)e.take_events();
}

template <class Scene> bool run(const std::filesystem::path& folder, int threads) {
    auto e = Scene::start(threads);
    const auto print = [&] { fmt::print("{} step {} checksum {:016x}\n", Scene::name, e.totals().steps, checksum(e)); };
    print();
    Scene::press(e);
    write(folder / early<Scene>().from, to_bytes(e));
    advance(e, row);
    write(folder / early<Scene>().to, to_bytes(state_of(e)));
    print();
    for (std::int64_t k = row; k < Scene::steps; k += row) {
        advance(e, row);
        print();
    }
    write(folder / late<Scene>().from, to_bytes(e));
    advance(e, late<Scene>().steps);
    write(folder / late<Scene>().to, to_bytes(state_of(e)));
    print();
    const bool enough = Scene::events(e) >= Scene::least_events;
    fmt::print("{}: {} replaced, {} {}, {} lists{}\n", Scene::name, e.totals().replaced, Scene::events(e), Scene::what,
               e.totals().rebuilds, enough ? "" : ": TOO FEW, the scene shows nothing");
    return enough;
}
template <class Scene> void follow(const std::filesystem::path& folder, const std::filesystem::path& other) {
    for (const leg& l : {early<Scene>(), late<Scene>()}) {
        auto e = Scene::start(1);
        from_bytes(read(other / l.from), e);
        advance(e, l.steps);
        write(folder / l.to, to_bytes(state_of(e)));
    }
}

/// Largest difference of two equally long lists; infinite where lengths differ or a number is none.
double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = a.size() == b.size() ? 0.0 : HUGE_VAL;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
        const double d = std::abs(a[k] - b[k]);
        largest = std::isfinite(d) ? std::max(largest, d) : HUGE_VAL;
    }
    return largest;
}
/// Differences over the scales of a granular medium under a stress p: d, sqrt(p / rho), the same over d, and p d^2.
/// Contacts make forces of places: an error of 1e-16 d in a place is one of 1e-16 k / (p d), some 1e-13, in a force.
template <class Scene> bool compare(const std::filesystem::path& one, const std::filesystem::path& other) {
    constexpr double limit = 1e-12, limit_of_forces = 1e-10;
    const double speed = std::sqrt(Scene::stress / 2700.0);
    bool good = true;
    for (const leg& l : {early<Scene>(), late<Scene>()}) {
        state a, b;
        from_bytes(read(one / l.to), a);
        from_bytes(read(other / l.to), b);
        const double places = distance(a.places, b.places) / Scene::diameter;
        const double speeds = distance(a.speeds, b.speeds) / speed;
        const double spins = distance(a.spins, b.spins) / (speed / Scene::diameter);
        const double forces = distance(a.forces, b.forces) / (Scene::stress * Scene::diameter * Scene::diameter);
        const bool near = places <= limit && std::max({speeds, spins, forces}) <= limit_of_forces;
        good = good && near;
        fmt::print("  {}, {} step(s): places differ by {:.1e}, speeds {:.1e}, spins {:.1e}, forces {:.1e}{}\n", l.from,
                   l.steps, places, speeds, spins, forces, near ? "" : ": TOO MUCH");
    }
    return good;
}

} // namespace

int main(int count, char** words) try {
    const std::vector<std::string> w(words + 1, words + count);
    if (w.size() == 3 && w[0] == "compare") {
        const bool first = compare<clumps>(w[1], w[2]);
        return compare<spheres>(w[1], w[2]) && first ? 0 : 1;
    }
    if (w.empty()) throw input_error("scenes <folder> [threads, or a folder to start from]");
    std::filesystem::create_directories(w[0]);
    if (w.size() > 1 && w[1].find_first_not_of("0123456789") != std::string::npos) {
        follow<clumps>(w[0], w[1]);
        follow<spheres>(w[0], w[1]);
        return 0;
    }
    const int threads = w.size() > 1 ? std::stoi(w[1]) : 1;
    const bool first = run<clumps>(w[0], threads);
    return run<spheres>(w[0], threads) && first ? 0 : 1;
} catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
}
