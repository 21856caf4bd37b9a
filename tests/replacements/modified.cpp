// SPDX-License-Identifier: MIT
#include <clast/replacements/modified.hpp>

#include <algorithm>
#include <cmath>

#include <clast/core/random.hpp>

#include <catch.hpp>

static_assert(clast::replacements::replacing<clast::replacements::modified>);

using namespace clast;
using replacements::birth;
using replacements::modified;

namespace {

struct loaded {
    bonds::lattice lattice{shapes::apollonian_14(circumscribed(0.02)), bonds::parallel{}, 2650.0};
    std::vector<bonds::pebble_load> load;
    quaternion q;
    vec3 w;

    loaded() : load(14) {
        random_stream random{11, 1};
        q = orientation(random);
        w = 30.0 * direction(random);
        for (bonds::pebble_load& p : load) p = {500.0 * direction(random), direction(random)};
    }
};

} // namespace

TEST_CASE("the paper's replacement: at 90 % of the strength, born with the forces of equilibrium") {
    const modified policy{};
    CHECK(policy.trigger == 0.9);
    CHECK(policy.how == birth::warm_start);
    CHECK(policy.check_interval >= 1);
    CHECK(policy.bond.tensile_strength == 0.3e8); // Table 1
    CHECK(policy.bond.cohesion == 0.6e8);
    CHECK(policy.bond.normal_stiffness == 9.6e8);
    CHECK(policy.bond.shear_stiffness == 4.8e8);
    static_assert(modified::makes_bonds);
}

TEST_CASE("warm start: the bonds of a new cluster carry its load from the first step") {
    const loaded grain;
    const auto states = replacements::born(modified{}.how, grain.lattice, grain.load, grain.q, grain.w);
    const auto exact = grain.lattice.statics(grain.load, grain.q, grain.w);
    REQUIRE(states.size() == 36);
    double most = 0.0;
    for (std::size_t e = 0; e < states.size(); ++e) {
        CHECK((states[e].n == exact[e].n && states[e].v == exact[e].v && states[e].mt == exact[e].mt &&
               states[e].mb == exact[e].mb));
        most = std::max(most, std::abs(states[e].n));
    }
    CHECK(most > 100.0);
}

TEST_CASE("zero-force birth: the bonds of a new cluster carry nothing, whatever its load") {
    const loaded grain;
    modified policy;
    policy.how = birth::zero_force;
    const auto states = replacements::born(policy.how, grain.lattice, grain.load, grain.q, grain.w);
    REQUIRE(states.size() == 36);
    for (const bonds::state& s : states) CHECK((s.n == 0.0 && s.v == vec3{} && s.mt == 0.0 && s.mb == vec3{}));
}
