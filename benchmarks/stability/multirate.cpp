// SPDX-License-Identifier: MIT
// Does noise grow in packings at rest, part of whose grains have been replaced by clusters or loose balls? One line per
// stiffness of the bonds and damping, one number per safety of the time step.
//
//   stability_multirate <4B|14B|studs> <one|half|all> <friction> <bond stiffness, ...> <damping, ...> <safety, ...>
//                       <steps> <seed> [<contacts|force|per_area|modulus|loose>]
//
// The stiffness of bonds is a multiple of that of contacts, or by a reading of bonds::stiffness_reading; `loose` lets
// bonds fail at once, and presses the balls again.
#include <cstdlib>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <stability/noise.hpp>

using namespace clast;

namespace {

std::vector<double> numbers(const std::string& text) {
    std::istringstream in(text);
    std::vector<double> all;
    for (std::string one; std::getline(in, one, ',');) all.push_back(std::stod(one));
    return all;
}
/// A ball with six of a fifth of its size on it.
shape studs() {
    const double r = 0.008;
    std::vector<shape_pebble> pebbles{{{}, r}};
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.2, 1.2}) {
            vec3 at;
            at[axis] = side * r;
            pebbles.push_back({at, 0.2 * r});
        }
    return make_shape("studs", pebbles);
}
bonds::parallel bond_of(double stiffness, const std::string& how) {
    bonds::parallel b = noise::stiff(stiffness);
    if (how == "loose") b.tensile_strength = b.cohesion = 1e-30;
    if (how == "contacts" || how == "loose") return b;
    using reading = bonds::stiffness_reading;
    b.reading = how == "per_area" ? reading::per_area : how == "modulus" ? reading::modulus : reading::force;
    b.normal_stiffness = stiffness, b.shear_stiffness = 0.5 * stiffness;
    return b;
}
void map(const std::vector<std::string>& a) {
    using noise::whom;
    const shape grain = a[0] == "4B"    ? shapes::tetrahedron_4(circumscribed(0.02))
                        : a[0] == "14B" ? shapes::apollonian_14(circumscribed(0.02))
                                        : studs();
    const whom who = a[1] == "one" ? whom::one : a[1] == "half" ? whom::half : whom::all;
    const int steps = std::stoi(a[6]);
    const auto rest = noise::packing(grain, 2, 3, static_cast<unsigned>(std::stoi(a[7])), std::stod(a[2]));
    for (const double stiffness : numbers(a[3]))
        for (const double damping : numbers(a[4])) {
            const auto bond = bond_of(stiffness, a.size() > 8 ? a[8] : "contacts");
            const auto base = noise::replaced(rest, who, bond, damping, 0.8);
            std::string line;
            int grows = 0, tried = 0;
            for (const double safety : numbers(a[5])) {
                auto e = base;
                e.settings.safety = safety;
                const double by = noise::growth(e, steps);
                grows += by > 10.0 ? 1 : 0, ++tried;
                line += fmt::format(" {:g}:{}:{:.0e}", safety, e.light_steps(), by);
            }
            fmt::print("{} {} bonds {:g} damping {:g} kinetic/elastic {:.0e}: grows at {} of {} "
                       "(safety:sub-steps:growth{})\n",
                       a[0], a[1], stiffness, damping, base.kinetic_energy() / base.elastic_energy(), grows, tried,
                       line);
        }
}

} // namespace

int main(int count, char** words) {
    const std::vector<std::string> a(words + 1, words + count);
    if (a.size() < 8) {
        fmt::print(stderr,
                   "usage: {} <4B|14B|studs> <one|half|all> <friction> <stiffness,...> <damping,...> "
                   "<safety,...> <steps> <seed> [<contacts|force|per_area|modulus|loose>]\n",
                   words[0]);
        return EXIT_FAILURE;
    }
    try {
        map(a);
    } catch (const std::exception& e) {
        fmt::print(stderr, "{}\n", e.what());
        return EXIT_FAILURE;
    }
    return 0;
}
