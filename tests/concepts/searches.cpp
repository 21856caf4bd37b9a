// SPDX-License-Identifier: MIT
#include <clast/searches/concepts.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

/// The poorest search: finds nothing.
struct archetype {
    explicit archetype(int) {}
    std::vector<searches::sphere_pair> pairs(std::span<const searches::sphere>, double) { return {}; }
};

struct wrong_answer {
    int pairs(std::span<const searches::sphere>, double) { return 0; }
};

static_assert(searches::search<archetype>);
static_assert(!searches::search<wrong_answer>);
static_assert(!searches::search<int>);

} // namespace

TEST_CASE("the poorest search can be asked") { CHECK(archetype(1).pairs({}, 0.1).empty()); }
