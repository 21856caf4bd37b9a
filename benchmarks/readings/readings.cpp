// SPDX-License-Identifier: MIT
// How hard the grains of a triaxial test are pressed that never break, in one reading of the paper's Table 1: the
// largest force over d^2 that each grain meets until the end, and so the share of grains that a criterion with a
// strength, scattered or not, would replace. Prints a line of JSON.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <clast/boundaries/tiles.hpp>
#include <clast/criteria/weibull.hpp>
#include <clast/io/shapes.hpp>
#include <clast/protocol/triaxial.hpp>

using namespace clast;

namespace {

struct call {
    std::string shape = "4B", grain_size = "equivalent", stiffness = "contact";
    double scale = 0.5, strain = 0.25, inertial_number = 1e-4, confining = 2e6;
    std::uint64_t seed = 1;
};

/// Breaks no grain, and remembers by grain the largest force of a neighbour and of a contact (N).
struct recorder {
    static constexpr bool evaluated = true;
    static constexpr criteria::needs needs = criteria::needs::largest_force | criteria::needs::grain_id;
    std::vector<double>*of_neighbour = nullptr, *of_contact = nullptr;

    double utilisation(const criteria::grain_load& load) const {
        const auto g = static_cast<std::size_t>(load.grain);
        if (of_neighbour->size() <= g) of_neighbour->resize(g + 1), of_contact->resize(g + 1);
        (*of_neighbour)[g] = std::max((*of_neighbour)[g], load.largest_force);
        (*of_contact)[g] = std::max((*of_contact)[g], load.largest_single);
        return 0.0;
    }
};
struct policies : triaxial_policies_default {
    using breakage = recorder;
    using boundary = boundaries::tiles;
};

struct watch : observer {
    double kappa = 0.0, median_overlap = 0.0, largest_overlap = 0.0, q = 0.0, peak = 0.0, volumetric = 0.0;
    double void_ratio = 0.0;
    void on_row(const sample& s) override {
        if (s.stage != "shear") return;
        if (kappa == 0.0) kappa = s.kappa, void_ratio = s.void_ratio;
        median_overlap = s.median_overlap_over_r;
        largest_overlap = std::max(largest_overlap, s.max_overlap_over_r);
        q = s.q, peak = std::max(peak, s.q), volumetric = s.volumetric_strain;
    }
};

double quantile(std::vector<double> v, double part) {
    std::sort(v.begin(), v.end());
    return v[std::min(v.size() - 1, static_cast<std::size_t>(part * static_cast<double>(v.size())))];
}
/// Share (%) of grains whose largest force reaches 90 % of their strength.
double share(const std::vector<double>& stress, double strength, double m, std::uint64_t seed) {
    int over = 0;
    for (std::size_t g = 0; g < stress.size(); ++g)
        over += stress[g] >=
                0.9 * strength * (m > 0.0 ? criteria::weibull_factor(seed, static_cast<std::int64_t>(g), m) : 1.0);
    return 100.0 * over / static_cast<double>(stress.size());
}

int run(const call& c) {
    const grain_size size{0.02,
                          c.grain_size == "circumscribed" ? size_reading::circumscribed : size_reading::equivalent};
    std::vector<double> of_neighbour, of_contact;
    triaxial_test<policies> test({.grain = shapes::by_name(c.shape, size),
                                  .diameter = quantities::length{0.3 * c.scale},
                                  .height = quantities::length{0.7 * c.scale},
                                  .confining = quantities::stress{c.confining},
                                  .breakage = {&of_neighbour, &of_contact},
                                  .replacement = {},
                                  .rings = static_cast<int>(std::lround(36 * c.scale)),
                                  .tiles_per_ring = std::max(10, static_cast<int>(std::lround(20 * c.scale))),
                                  .materials = c.stiffness == "series" ? table_1::of_pieces() : table_1{},
                                  .inertial_number = c.inertial_number,
                                  .seed = c.seed},
                                 protocol::triaxial_compression(quantities::ratio{c.strain}));
    watch w;
    const auto began = std::chrono::steady_clock::now();
    test.run(w);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    for (double& f : of_neighbour) f /= size.diameter * size.diameter;
    for (double& f : of_contact) f /= size.diameter * size.diameter;
    fmt::print(
        "{{\"shape\": \"{}\", \"grain_size\": \"{}\", \"stiffness\": \"{}\", \"scale\": {}, \"seed\": {}, \"I\": {}, "
        "\"confining_MPa\": {}, \"grains\": {}, \"kappa\": {:.1f}, \"void_ratio\": {:.3f}, \"median_overlap\": "
        "{:.4f}, \"largest_overlap\": {:.3f}, \"peak_q_MPa\": {:.3f}, \"q_MPa\": {:.3f}, \"volumetric\": {:.4f}, "
        "\"steps\": {}, \"seconds\": {:.0f}",
        c.shape, c.grain_size, c.stiffness, c.scale, c.seed, c.inertial_number, 1e-6 * c.confining,
        test.sim().grains.grain_count(), w.kappa, w.void_ratio, w.median_overlap, w.largest_overlap, 1e-6 * w.peak,
        1e-6 * w.q, w.volumetric, test.sim().totals().steps, seconds);
    const std::vector<double>* const recorded[] = {&of_neighbour, &of_contact};
    const char* const names[] = {"resultant", "single"};
    for (int k = 0; k < 2; ++k) {
        const std::vector<double>& all = *recorded[k];
        fmt::print(", \"{}\": {{\"p50\": {:.2f}, \"p90\": {:.2f}, \"p99\": {:.2f}, \"max\": {:.2f}", names[k],
                   1e-6 * quantile(all, 0.5), 1e-6 * quantile(all, 0.9), 1e-6 * quantile(all, 0.99),
                   1e-6 * quantile(all, 1.0));
        for (const char* rock : {"weak", "medium", "strong"})
            for (const double m : {0.0, 10.0, 3.0})
                fmt::print(", \"{}_{}\": {:.2f}", rock, m > 0.0 ? fmt::format("m{:g}", m) : "none",
                           share(all, criteria::strength_of_class(rock), m, c.seed));
        fmt::print("}}");
    }
    fmt::print("}}\n");
    return 0;
}

} // namespace

int main(int count, char** words) {
    call c;
    for (int k = 1; k + 1 < count; k += 2) {
        const std::string option = words[k], value = words[k + 1];
        if (option == "--shape") c.shape = value;
        if (option == "--grain-size") c.grain_size = value;
        if (option == "--stiffness") c.stiffness = value;
        if (option == "--scale") c.scale = std::atof(value.c_str());
        if (option == "--strain") c.strain = std::atof(value.c_str());
        if (option == "--confining") c.confining = std::atof(value.c_str());
        if (option == "--inertial-number") c.inertial_number = std::atof(value.c_str());
        if (option == "--seed") c.seed = static_cast<std::uint64_t>(std::atoll(value.c_str()));
    }
    try {
        return run(c);
    } catch (const input_error& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 2;
    } catch (const run_error& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 3;
    }
}
