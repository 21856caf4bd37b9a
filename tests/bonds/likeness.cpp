// SPDX-License-Identifier: MIT
#include <clast/bonds/likeness.hpp>

#include <cmath>
#include <cstddef>

#include <clast/bonds/lattice.hpp>

#include <catch.hpp>

using namespace clast;
using namespace clast::bonds;

TEST_CASE("frequencies of a lattice of another size and density go with the root of the stiffness of the similar one") {
    const shape s = shapes::apollonian_14(circumscribed(0.02));
    for (const stiffness_reading reading :
         {stiffness_reading::force, stiffness_reading::per_area, stiffness_reading::modulus}) {
        parallel bond;
        bond.reading = reading;
        const lattice own(s, bond, 2650.0);
        for (const likeness to : {likeness{0.3, 1.0}, likeness{2.5, 1.0}, likeness{1.0, 3.0}, likeness{0.7, 0.4}}) {
            const lattice other(scaled_by(s, to.scale), bond, to.density * 2650.0);
            const double ratio = other.highest_frequency / own.highest_frequency;
            CHECK(std::sqrt(to.stiffness(own.stiffness_power)) == Approx(ratio).epsilon(1e-9));
            const double rounded = std::exp2(0.25 * to.frequency_class(own.stiffness_power));
            CHECK(rounded >= ratio * (1.0 - 1e-9));
            CHECK(rounded <= ratio * 1.19); // a quarter of an octave
            // stiffness: energies over scale^5 density at displacements over scale
            const double k = other.bond[0].kn, similar = k / (to.force() / to.scale);
            CHECK(similar / own.bond[0].kn == Approx(to.stiffness(own.stiffness_power)).epsilon(1e-12));
        }
    }
    CHECK(likeness{}.frequency_class(0) == 0);
    CHECK(likeness{}.stiffness(2) == 1.0);
}

TEST_CASE("states are scaled there and back: forces by scale^4, moments by scale^5, both by the density") {
    const state s{1.0, {2.0, 3.0, -4.0}, 5.0, {6.0, -7.0, 8.0}};
    const likeness to{0.5, 4.0};
    const state there = scaled(s, to);
    CHECK(there.n == 0.25);
    CHECK(there.v == vec3{0.5, 0.75, -1.0});
    CHECK(there.mt == 0.625);
    CHECK(there.mb == vec3{0.75, -0.875, 1.0});
    const state back = scaled(there, to.inverse());
    CHECK((back.n == s.n && back.v == s.v && back.mt == s.mt && back.mb == s.mb));
}
