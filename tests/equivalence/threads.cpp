// SPDX-License-Identifier: MIT
// Design invariant 1: the same bits for any number of threads, with breakage on.
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>

#include <catch.hpp>

#include "equivalence/toy.hpp"

using namespace clast;

namespace {

struct result {
    std::uint64_t bits;
    std::int64_t broken, steps;
};
template <class Boundary> result run(int threads, double diameter, double height, double strain) {
    using P = toy::bundle<Boundary>;
    const auto setup = toy::setup<P>(threads, diameter, height);
    triaxial_test<P> test(setup, toy::stages(setup, strain));
    test.sim().settings.contacts_per_thread = 8; // cut even toy scenes into ranges
    toy::recorder watch;
    REQUIRE(test.run(watch));
    const engine_totals& t = test.sim().totals();
    CHECK(watch.events.size() == static_cast<std::size_t>(t.broken_tension + t.broken_shear));
    return {toy::fingerprint(test), t.broken_tension + t.broken_shear, t.steps};
}

} // namespace

TEST_CASE("a test in tiles ends with the same bits on 1, 2, 3 and 8 threads, with many broken bonds") {
    // 150 grains: enough that every loop over grains is cut into pieces
    const result one = run<boundaries::tiles>(1, 0.085, 0.1, 0.02);
    INFO(one.steps << " steps, " << one.broken << " broken bonds");
    CHECK(one.broken >= 12);
    for (const int threads : {2, 3, 8}) CHECK(run<boundaries::tiles>(threads, 0.085, 0.1, 0.02).bits == one.bits);
}

TEMPLATE_TEST_CASE("so does a test in strips and rings", "", boundaries::solid_strips, boundaries::ring_walls) {
    const result one = run<TestType>(1, 0.066, 0.075, 0.03);
    CHECK(one.broken >= 12);
    CHECK(run<TestType>(3, 0.066, 0.075, 0.03).bits == one.bits);
}
