// SPDX-License-Identifier: MIT
// A contact law of one's own: Hertz, in plain double and if; sliding is borrowed from the linear law.
#include <algorithm>
#include <cmath>

#include <clast/clast.hpp>
#include <fmt/core.h>

struct hertz {
    double modulus;  // E', 1/E' = sum (1 - nu^2)/E (Pa)
    double mu = 0.0; // friction; a preparation that gets stuck lowers what has this name

    using history = clast::contacts::linear::history; // the shear force
    using overlap = clast::contacts::overlap<double>;
    using motion = clast::contacts::motion<double>;

    // force on i (N) and energy lost in the step (J)
    clast::contacts::response<double> operator()(const overlap& o, const motion& m, history& h, double dt) const {
        if (o.depth <= 0) {
            h = {};
            return {};
        }
        return clast::contacts::linear{normal_stiffness(o) / 1.5, shear_stiffness(o), mu}(o, m, h,
                                                                                          dt); // F = 2/3 k depth
    }
    double stored(const overlap& o, const history& h) const { // elastic energy (J)
        if (o.depth <= 0) return 0;
        const double shear2 = h.x * h.x + h.y * h.y + h.z * h.z;
        return normal_stiffness(o) * o.depth * o.depth / 3.75 + shear2 / (2 * shear_stiffness(o));
    }
    double normal_stiffness(const overlap& o) const { // tangent (N/m), for the time step and the servo
        return 2 * modulus * std::sqrt(o.reduced_radius() * std::max(o.depth, 0.0));
    }
    double shear_stiffness(const overlap& o) const { return 0.8 * normal_stiffness(o); }
};
static_assert(clast::contacts::contact_law<hertz>);

struct my_policies : clast::triaxial_policies_default {
    using contact = hertz;
    using boundary = clast::boundaries::solid_strips;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};

int main() {
    using namespace clast::literals;
    clast::triaxial_setup<my_policies> setup{.grain = clast::shapes::tetrahedron_4(0.02),
                                             .diameter = 8_cm,
                                             .height = 12_cm,
                                             .confining = 500_kPa,
                                             .breakage = {},
                                             .replacement = {},
                                             .materials = {.grain = {1e9, 0.3}, .platen = {4e9}, .membrane = {5e8}},
                                             .inertial_number = 1e-3};
    clast::triaxial_test<my_policies> test(setup, clast::protocol::triaxial_compression(1_percent));
    clast::observer silent;
    test.run(silent);
    const clast::sample s = test.protocol().measure();
    fmt::print("q = {:.1f} kPa at {:.2f} %, energy residual {:.1e}\n", s.q / 1e3, 100 * s.axial_strain,
               s.energy_residual);
    return s.q > 0 ? 0 : 1;
}
