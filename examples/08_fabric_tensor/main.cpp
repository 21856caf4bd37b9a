// SPDX-License-Identifier: MIT
// An observer of the scene: how contacts of a specimen turn towards the axis of compression, from their fabric tensor.
#include <cmath>
#include <cstdint>

#include <clast/clast.hpp>
#include <fmt/core.h>

struct my_policies : clast::triaxial_policies_default {
    using boundary = clast::boundaries::solid_strips;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

/// Mean of n (x) n over touching pairs of grains: the identity / 3 where contacts have no preferred direction.
struct fabric : clast::scene_observer<my_policies> {
    double first = 0.0, last = 0.0; // deviator in shear
    int rows = 0;

    void on_scene(const clast::scene<my_policies>& s, const clast::sample& row) override {
        if (row.stage != "shear") return;
        clast::mat3 sum;
        std::int64_t touching = 0;
        s.each_heavy([&](std::size_t k) {
            const clast::force_row& contact = s.heavy.rows[k];
            if (contact.depth == 0.0) return; // near, but apart
            sum += clast::outer(contact.normal, contact.normal);
            ++touching;
        });
        if (touching == 0) return;
        const clast::mat3 mean = (1.0 / static_cast<double>(touching)) * sum;
        last = mean(2, 2) - 0.5 * (mean(0, 0) + mean(1, 1)); // > 0: more contacts along z than across
        if (rows++ == 0) first = last;
        fmt::print("eps_a {:4.2f} %  q {:5.1f} kPa  contacts {:4}  F_zz {:.4f}  deviator {:+.4f}\n",
                   100.0 * row.axial_strain, row.q / 1e3, touching, mean(2, 2), last);
    }
};

int main() {
    using namespace clast::literals;
    const auto stages = clast::protocol::triaxial_compression(10_cm, 15_cm, 200_kPa, 3_percent, 1e-3);
    clast::triaxial_test<my_policies> test({.grain = clast::shapes::sphere(0.02),
                                            .diameter = 10_cm,
                                            .height = 15_cm,
                                            .confining = 200_kPa,
                                            .breakage = {},
                                            .replacement = {},
                                            .porosity = 0.45,
                                            .tiles_per_ring = 12,
                                            .inertial_number = 1e-3,
                                            .rows = 50},
                                           stages);
    fabric watch;
    test.run(watch);
    return watch.rows > 3 && watch.last > watch.first + 0.02 ? 0 : 1;
}
