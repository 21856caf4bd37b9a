// SPDX-License-Identifier: MIT
#include <clast/engine/step_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/engine/engine.hpp>

#include <catch.hpp>

using namespace clast;

namespace {
struct spheres_alone : triaxial_policies_default {
    using body = bodies::spheres;
    using boundary = boundaries::none;
    using breakage = criteria::none;
    using replacement = replacements::none;
};
constexpr double kn = 1e6, ks = 5e5, r = 0.01;

/// n spheres in a row, overlapping by a hundredth.
engine<spheres_alone> row(int n, double largest_step = 1.0) {
    bodies::spheres s;
    for (int k = 0; k < n; ++k) s.add({1.99 * r * k, 0.0, 0.0}, r);
    return engine<spheres_alone>({.grain_contact = {kn, ks, 0.3},
                                  .platen_contact = {},
                                  .lateral_contact = {},
                                  .breakage = {},
                                  .replacement = {},
                                  .safety = 0.5,
                                  .largest_step = largest_step},
                                 s, spaces::open{});
}
} // namespace

TEST_CASE("the step is that of the body with the stiffest contacts, by hand") {
    const double m = 2650.0 * sphere_volume(r), inertia = 2650.0 * sphere_inertia_per_density(r);
    const double arm = 0.995 * r; // to the middle of the overlap
    for (const int contacts : {1, 2}) {
        const double translation = contacts * kn / m, rotation = contacts * ks * arm * arm / inertia;
        const double by_contacts = 0.5 / std::sqrt(std::max(translation, rotation));
        const double typical = 0.5 * std::sqrt(m / (kn + 2.0 * ks)); // three contacts of mean stiffness
        CHECK(row(contacts + 1).dt() == Approx(std::min(by_contacts, typical)).epsilon(1e-12));
    }
    CHECK(row(1).dt() == Approx(0.5 * std::sqrt(m / (kn + 2.0 * ks))).epsilon(1e-12));
    CHECK(row(3, 1e-7).dt() == 1e-7);
}

TEST_CASE("a count of contacts that surely allows a step never hides a stiffer body") {
    const auto e = row(4);
    scene<spheres_alone> s = e.state();
    s.index_heavy();
    for (std::size_t b = 0; b < 4; ++b)
        for (double step = 1e-7; step < 1e-3; step *= 1.3) {
            if (!rooms::surely_allows(s, b, step)) continue;
            stiffness_sum k(mat3::identity());
            rooms::add_stiffness(s, k, *s.heavy_of, b, s.heavy, s.heavy_wall, s.grains.centre(b));
            CHECK(k.time_step(s.grains.body_mass(b), s.grains.body_inertia(b), s.settings.safety) >= step);
        }
    CHECK(rooms::surely_allows(s, 0, 1e-7));
}
