// SPDX-License-Identifier: MIT
// Reads the scenes that all programs run, and prints the result in the form that they share
// (benchmarks/peers/README.md).
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/spatial_order.hpp>
#include <clast/core/vector.hpp>
#include <clast/criteria/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/grains/shape.hpp>
#include <clast/replacements/none.hpp>
#include <clast/version.hpp>

namespace peers {

struct sphere {
    std::int32_t owner;
    clast::vec3 x;
    double r;
};

struct scene {
    std::map<std::string, double> parameters;
    clast::vec3 low, high; ///< periodic cell or walls (m)
    std::vector<sphere> spheres;
    std::int64_t steps = 0;
    double skin = 0.0; ///< over the mean diameter; 0: the engine's own
    int threads = 1;

    double operator[](const std::string& key) const {
        const auto found = parameters.find(key);
        if (found == parameters.end())
            throw clast::input_error("--parameters", "no " + key, "key value lines", "See benchmarks/peers/README.md.");
        return found->second;
    }
    clast::vec3 centre() const { return 0.5 * (low + high); }
    clast::vec3 rates() const { return {(*this)["rate_x"], (*this)["rate_y"], (*this)["rate_z"]}; }
    /// Homogeneous flow of the start.
    clast::vec3 flow(const clast::vec3& x) const { return clast::scale(rates(), x - centre()); }
    double mean_diameter() const {
        double sum = 0.0;
        for (const sphere& s : spheres) sum += 2.0 * s.r;
        return sum / static_cast<double>(spheres.size());
    }
};

/// Grains in an order in which neighbours stand together, as anyone who makes a specimen would; the other programs sort
/// their atoms themselves.
inline void sort_in_space(scene& s) {
    std::vector<std::size_t> first;
    std::vector<clast::vec3> place;
    for (std::size_t k = 0; k < s.spheres.size(); ++k)
        if (k == 0 || s.spheres[k].owner != s.spheres[k - 1].owner) first.push_back(k), place.push_back(s.spheres[k].x);
    first.push_back(s.spheres.size());
    std::vector<sphere> sorted;
    for (std::size_t g : clast::spatial_order(place, s.mean_diameter()))
        sorted.insert(sorted.end(), s.spheres.begin() + static_cast<std::ptrdiff_t>(first[g]),
                      s.spheres.begin() + static_cast<std::ptrdiff_t>(first[g + 1]));
    s.spheres = std::move(sorted);
}

inline scene read(int argc, char** argv) {
    scene s;
    std::string parameters, state;
    for (int k = 1; k + 1 < argc; k += 2) {
        const std::string option = argv[k], value = argv[k + 1];
        if (option == "--parameters")
            parameters = value;
        else if (option == "--state")
            state = value;
        else if (option == "--steps")
            s.steps = std::atoll(value.c_str());
        else if (option == "--skin")
            s.skin = std::atof(value.c_str());
        else if (option == "--threads")
            s.threads = std::atoi(value.c_str());
        else
            throw clast::input_error(option, value, "--parameters, --state, --steps, --skin, --threads",
                                     "See benchmarks/peers/README.md.");
    }
    std::ifstream p(parameters);
    for (std::string line; std::getline(p, line);) {
        std::istringstream words(line);
        std::string key;
        double value = 0.0;
        if (words >> key >> value && key[0] != '#') s.parameters[key] = value;
    }
    std::ifstream f(state);
    std::string word, kind;
    int version = 0;
    std::size_t count = 0;
    f >> word >> version >> kind >> word >> s.low.x >> s.low.y >> s.low.z >> s.high.x >> s.high.y >> s.high.z >> word >>
        count;
    s.spheres.resize(count);
    for (sphere& one : s.spheres) f >> one.owner >> one.x.x >> one.x.y >> one.x.z >> one.r;
    if (!f || count == 0 || s.parameters.empty() || s.steps <= 0)
        throw clast::input_error("--state", state, "a state file, parameters and a number of steps",
                                 "Make it with benchmarks/peers/scenes.py.");
    sort_in_space(s);
    return s;
}

/// Wall and processor time of steps.
template <class Engine> void timed(Engine& e, std::int64_t steps, double& seconds, double& cpu) {
    const auto cpu_time = [] {
        timespec t;
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin = cpu_time();
    e.step(steps);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    cpu = cpu_time() - cpu_begin;
}

/// The line of JSON. stress: along the axes (Pa, compression positive); pairs: touching.
inline void print(const char* kind, const scene& s, std::size_t n, double seconds, double cpu,
                  const clast::vec3& stress, std::int64_t pairs, std::int64_t rebuilds) {
    fmt::print(
        "{{\"peer\": \"clast\", \"version\": \"{}\", \"scene\": \"{}\", \"n\": {}, \"steps\": {}, \"seconds\": {:.6g}, "
        "\"cpu_seconds\": {:.6g}, \"particle_steps_per_s\": {:.6g}, \"p_Pa\": {:.8g}, \"q_Pa\": {:.8g}, "
        "\"coordination\": {:.6g}, \"rebuilds\": {}, \"threads\": {}}}\n",
        clast::version(), kind, n, s.steps, seconds, cpu,
        static_cast<double>(n) * static_cast<double>(s.steps) / seconds, (stress.x + stress.y + stress.z) / 3.0,
        stress.z - 0.5 * (stress.x + stress.y), 2.0 * static_cast<double>(pairs) / static_cast<double>(n), rebuilds,
        s.threads);
}

/// Settings of an engine at the step that all programs take.
template <class P, class Law>
clast::engine_settings<P> settings(const scene& s, const Law& law, const Law& wall,
                                   typename P::replacement replacement = {}) {
    return {.grain_contact = law,
            .platen_contact = wall,
            .lateral_contact = wall,
            .breakage = {},
            .replacement = replacement,
            .scheme = {.damping = 0.0},
            .safety = 1.0,
            .skin = s.skin * s.mean_diameter(),
            .largest_step = s["dt"],
            .run = clast::execution(s.threads)};
}
/// Spheres alone, under the law of these scenes.
template <class Boundary, class Space = clast::spaces::open> struct spheres_in : clast::triaxial_policies_default {
    using body = clast::bodies::spheres;
    using contact = clast::contacts::linear_dashpot;
    using boundary = Boundary;
    using space = Space;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};
inline clast::contacts::linear_dashpot grain_law(const scene& s) { return {s["kn"], s["kt"], s["mu"], s["gamma_n"]}; }
/// The same at a frictionless wall.
inline clast::contacts::linear_dashpot wall_law(clast::contacts::linear_dashpot law) {
    law.ks = law.mu = 0.0;
    return law;
}
/// The spheres of a scene around `origin`, in its flow.
inline clast::bodies::spheres spheres_of(const scene& s, const clast::vec3& origin) {
    clast::bodies::spheres spheres;
    spheres.density = s["density"];
    for (const sphere& one : s.spheres) {
        const auto p = static_cast<std::size_t>(spheres.add(one.x - origin, one.r));
        spheres.pebbles[p].v = s.flow(one.x);
    }
    return spheres;
}
/// The spheres of each clump or cluster.
inline std::vector<std::vector<sphere>> by_owner(const scene& s) {
    std::vector<std::vector<sphere>> members;
    for (const sphere& one : s.spheres) {
        if (members.empty() || members.back()[0].owner != one.owner) members.emplace_back();
        members.back().push_back(one);
    }
    return members;
}
/// Grains that are all the first one, turned: their orientations from their first three pebbles. `kind` is the shape of
/// the first one.
inline clast::bodies::clumps grains_of(const scene& s, const std::vector<std::vector<sphere>>& members,
                                       const clast::shape& kind) {
    clast::bodies::clumps grains;
    grains.density = s["density"];
    grains.shapes.push_back(kind);
    const auto frame = [](const clast::vec3& a, const clast::vec3& b, const clast::vec3& c) {
        const clast::vec3 e0 = clast::unit(b - a), e1 = clast::unit(clast::reject(c - a, e0));
        return clast::transpose(clast::mat3{{e0, e1, clast::cross(e0, e1)}});
    };
    const clast::mat3 back =
        clast::transpose(frame(kind.pebbles[0].offset, kind.pebbles[1].offset, kind.pebbles[2].offset));
    for (const auto& m : members) {
        clast::mat3 turn;
        const clast::mat3 there = frame(m[0].x, m[1].x, m[2].x);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 3; ++k) turn(i, j) += there(i, k) * back(k, j);
        const clast::quaternion q = clast::turning(turn);
        const clast::vec3 centre = m[0].x - clast::rotate(q, kind.pebbles[0].offset);
        const std::int32_t g = grains.add(0, centre, q);
        grains.motion[static_cast<std::size_t>(g)].v = s.flow(centre);
    }
    return grains;
}
inline clast::boundaries::box walls(const scene& s) {
    return clast::boundaries::box({s.low, s.high, s["kn"], s["kn"]});
}
/// Constant speeds of the walls; those normal to x and y are one pair of rates.
template <class Engine> void drive_walls(Engine& e, const scene& s) {
    const clast::vec3 l = s.high - s.low, rate = s.rates();
    e.drives.platens = {clast::boundaries::drive::mode::velocity, -0.5 * rate.z * l.z, 0.0, 0.5};
    e.drives.lateral = {clast::boundaries::drive::mode::velocity, -0.5 * rate.x * l.x, 0.0, 0.5};
}
template <class Engine> std::int64_t touching_pairs(const Engine& e) {
    std::int64_t pairs = 0;
    e.each_contact([&](const clast::force_row& row, const clast::pebble_pair& pair) {
        bool same = false; // balls of one cluster
        if constexpr (requires { e.grains.mother; })
            same =
                e.grains.mother[static_cast<std::size_t>(pair.i)] == e.grains.mother[static_cast<std::size_t>(pair.j)];
        pairs += row.depth > 0.0 && !same;
    });
    return pairs;
}
/// Runs the steps and prints the result with the stress on the walls.
template <class Engine> void run_in_walls(const char* kind, Engine& e, const scene& s, std::size_t n) {
    double seconds = 0.0, cpu = 0.0;
    timed(e, s.steps, seconds, cpu);
    const auto stress = [&](int axis) { return e.boundary.stress(e.loads(), axis); };
    print(kind, s, n, seconds, cpu, {stress(0), stress(1), stress(2)}, touching_pairs(e), e.totals().rebuilds);
}

} // namespace peers
