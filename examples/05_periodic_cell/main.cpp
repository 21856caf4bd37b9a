// SPDX-License-Identifier: MIT
// Spheres without walls: a periodic cell brings a cloud to 50 kPa by its servos, then compresses it along z.
#include <clast/clast.hpp>
#include <clast/measure/stress.hpp>
#include <fmt/core.h>

struct element : clast::triaxial_policies_default {
    using body = clast::bodies::spheres; // single spheres: no clump, no orientation
    using boundary = clast::boundaries::none;
    using space = clast::spaces::periodic;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

int main() {
    constexpr int n = 6; // spheres along an edge, on a grid of 22 mm around the origin
    clast::bodies::spheres spheres;
    for (int k = 0; k < n * n * n; ++k) {
        const auto at = [](int i) { return 0.022 * (i - 0.5 * (n - 1)); };
        const int id = spheres.add({at(k % n), at(k / n % n), at(k / n / n)}, k % 3 == 0 ? 0.008 : 0.01); // m
        clast::random_stream random{1, static_cast<std::uint64_t>(id)};
        spheres.pebbles[static_cast<std::size_t>(id)].v = 0.1 * clast::direction(random); // m/s
    }
    const clast::contacts::linear law{1e6, 5e5, 0.3}; // k_n, k_s (N/m), mu; a cell has no wall, so one law for all
    clast::engine<element> e({.grain_contact = law,
                              .platen_contact = law,
                              .lateral_contact = law,
                              .breakage = {},
                              .replacement = {},
                              .scheme = {.damping = 0.5}},
                             spheres, clast::spaces::periodic({0.022 * n, 0.022 * n, 0.022 * n}));
    const auto report = [&](const char* when) {
        const clast::mat3 s = clast::measure::love_weber(e, e.space.volume());
        fmt::print("{}: stress {:.1f} {:.1f} {:.1f} kPa, coordination {:.2f}, porosity {:.3f}\n", when, s(0, 0) / 1e3,
                   s(1, 1) / 1e3, s(2, 2) / 1e3, clast::measure::contacts_of(e).coordination,
                   1.0 - e.grains.solid_volume() / e.space.volume());
        return s(2, 2) - s(0, 0);
    };
    for (auto& axis : e.space.axes) axis = {.target = 50e3, .max_rate = 2.0, .gain = 0.2}; // Pa, 1/s
    while (e.time() < 0.3) e.step();
    report("isotropic");
    e.space.axes[2] = {.rate = -0.2}; // 1/s, extension positive; x and y stay at 50 kPa
    while (e.time() < 0.5) e.step();
    return report("compressed") > 0.0 ? 0 : 1;
}
