// SPDX-License-Identifier: MIT
#include <clast/engine/policies.hpp>

#include <type_traits>

#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/constraints/held.hpp>
#include <clast/criteria/one_of.hpp>
#include <clast/fields/gravity.hpp>
#include <clast/searches/brute_force.hpp>
#include <clast/spaces/periodic.hpp>

#include <catch.hpp>

using namespace clast;

namespace {
struct other_membrane : triaxial_policies_default {
    using boundary = boundaries::ring_walls;
};
struct any_criterion : triaxial_policies_default {
    using breakage = criteria::one_of<>;
};
struct rigid : triaxial_policies_default {
    using breakage = criteria::none;
    using replacement = replacements::none;
    using boundary = boundaries::solid_strips;
    using search = searches::brute_force;
};
struct wrong_contact : triaxial_policies_default {
    using contact = int;
};
struct wrong_boundary : triaxial_policies_default {
    using boundary = double;
};
struct wrong_search : triaxial_policies_default {
    using search = boundaries::tiles;
};
struct wrong_criterion : triaxial_policies_default {
    using breakage = searches::brute_force;
};
struct wrong_replacement : triaxial_policies_default {
    using replacement = criteria::none;
};
struct wrong_space : triaxial_policies_default {
    using space = boundaries::tiles;
};
struct clusters_in_a_cell : triaxial_policies_default {
    using space = spaces::periodic;
};
struct wrong_field : triaxial_policies_default {
    using field = spaces::open;
};
struct wrong_constraint : triaxial_policies_default {
    using constraint = fields::gravity;
};
struct heavy_and_held : triaxial_policies_default {
    using field = fields::gravity;
    using constraint = constraints::held;
};
struct incomplete {
    using contact = contacts::linear;
};
static_assert(simulator_policies<triaxial_policies_default>);
static_assert(simulator_policies<other_membrane> && simulator_policies<rigid>);
static_assert(!simulator_policies<wrong_contact> && !simulator_policies<wrong_boundary>);
static_assert(!simulator_policies<wrong_search> && !simulator_policies<wrong_criterion>);
static_assert(!simulator_policies<wrong_replacement> && !simulator_policies<incomplete> &&
              !simulator_policies<wrong_space> && !simulator_policies<clusters_in_a_cell> && !simulator_policies<int>);
static_assert(simulator_policies<heavy_and_held> && !simulator_policies<wrong_field> &&
              !simulator_policies<wrong_constraint>);
} // namespace

TEST_CASE("a bundle is the paper's by default, and what is overridden changes nothing else") {
    static_assert(std::is_same_v<other_membrane::contact, contacts::linear>);
    static_assert(std::is_same_v<other_membrane::replacement, replacements::modified>);
    static_assert(std::is_same_v<triaxial_policies_default::boundary, boundaries::tiles>);
    static_assert(std::is_same_v<triaxial_policies_default::breakage, criteria::nominal_force>);
    SUCCEED("checked at compile time");
}
