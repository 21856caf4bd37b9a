// SPDX-License-Identifier: MIT
// A replacement of one's own: where its criterion says so, a grain becomes two rigid halves, without any bond. Here a
// grain of 4 balls between two platens.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <clast/clast.hpp>
#include <fmt/core.h>

struct in_halves {
    static constexpr bool replaces = true, makes_bonds = false;
    struct plan {
        std::int32_t cut, pebbles;
    };
    int looks_every() const { return 10; } // steps
    template <class View> std::optional<plan> wants(const View& clump) const {
        const auto n = static_cast<std::int32_t>(clump.shape().pebbles.size());
        if (n < 4 || clump.utilisation() < 1.0) return std::nullopt; // pairs of balls are not split further
        return plan{n / 2, n};
    }
    template <class Surgery> void act(std::int32_t grain, const plan& p, Surgery& surgery) const {
        surgery.split(grain, std::array<clast::replacements::pebble_run, 2>{{{0, p.cut}, {p.cut, p.pebbles - p.cut}}});
    }
};
struct my_policies : clast::triaxial_policies_default {
    using boundary = clast::boundaries::solid_strips;
    using replacement = in_halves;
};

int main() {
    using namespace clast;
    bodies::clumps rock;
    rock.shapes.push_back(shapes::tetrahedron_4(0.02));
    rock.add(0, {0, 0, 0}, {});
    const double r = rock.pebbles[0].radius, half = rock.pebbles[0].x.z + r;
    const contacts::piece pebble{5.8e6, 2.9e6, 0.3}, platen{3.2e8, 1.6e8, 0.0}, wall{3.2e6, 1.6e6, 0.0};
    const contacts::linear at_wall = contacts::linear::between(pebble, wall);
    const boundaries::solid_strips cell(
        {.radius = 0.05, .bottom = -half, .top = half, .smallest_radius = r, .contact_stiffness_floor = at_wall.kn});
    engine<my_policies> sim({.grain_contact = contacts::linear::between(pebble, pebble),
                             .platen_contact = contacts::linear::between(pebble, platen),
                             .lateral_contact = at_wall,
                             .breakage = {criteria::crushing_strength(2e6)}, // F/d^2 (Pa)
                             .replacement = {}},
                            rock, cell);
    sim.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.02}; // each platen (m/s)
    double most = 0.0;                                                              // N
    for (int row = 0; sim.boundary.height() > 1.95 * half; sim.step()) {
        most = std::max(most, sim.loads()[1].force);
        const double way = 2 * half - sim.boundary.height();
        if (way >= row * 5e-5)
            fmt::print("{:5.2f} mm  {:5.0f} N  grains {}\n", 1e3 * 5e-5 * row++, sim.loads()[1].force,
                       sim.grains.grain_count());
    }
    fmt::print("gave way at {:.0f} N\n", most); // 2 MPa of (20 mm)^2 are 800 N
    return sim.grains.grain_count() == 2 && std::abs(most / 800.0 - 1.0) < 0.05 ? 0 : 1;
}
