// SPDX-License-Identifier: MIT
#include <clast/grains/mixture.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include <catch.hpp>

using namespace clast;

TEST_CASE("a shape alone is a mixture: as many grains of its size as come nearest to the volume") {
    const shape s = shapes::tetrahedron_4(circumscribed(0.02));
    const mixture m = s;
    REQUIRE(m.parts().size() == 1);
    CHECK(m.parts()[0].share == 1.0);
    CHECK(m.d50() == s.diameter);
    CHECK(m.smallest_diameter() == s.diameter);
    CHECK(m.largest_diameter() == s.diameter);
    CHECK(m.smallest_radius() == s.pebbles[0].radius);
    CHECK(m.largest_radius() == s.pebbles[0].radius);
    const auto grains = m.grains_of(10.4 * s.volume);
    REQUIRE(grains.size() == 10);
    CHECK(m.grains_of(10.6 * s.volume).size() == 11);
    for (const mixture_grain& g : grains) CHECK((g.part == 0 && g.scale == 1.0));
    CHECK(m.volume(grains[0]) == s.volume);
    CHECK(m.reach(grains[0]) == s.circumscribed_radius);
}

TEST_CASE("shapes of a mixture share the mass, each at its own size, and the largest grains come first") {
    const mixture m({{shapes::apollonian_14(circumscribed(0.02)), 3.0},
                     {shapes::tetrahedron_4(circumscribed(0.03)), 1.0},
                     {shapes::sphere(0.01), 1.0}});
    const double volume = 1e-3;
    double of_part[3] = {}, before = 1.0;
    for (const mixture_grain& g : m.grains_of(volume)) {
        of_part[g.part] += m.volume(g);
        CHECK(m.diameter(g) <= before);
        before = m.diameter(g);
    }
    const double share[] = {0.6, 0.2, 0.2};
    for (std::size_t k = 0; k < 3; ++k)
        CHECK(std::abs(of_part[k] - share[k] * volume) <= 0.5 * m.parts()[k].form.volume);
    CHECK(m.d50() == m.parts()[0].form.diameter); // 20 % are finer than 14B's 2 cm, 80 % not coarser
    CHECK(m.smallest_diameter() == Approx(0.01));
    CHECK(m.largest_diameter() == Approx(0.03));
    CHECK(m.smallest_radius() == m.parts()[0].form.pebbles[13].radius); // 4.6 mm * 0.5: the small ones of 14B
    CHECK(m.largest_radius() == m.parts()[1].form.pebbles[0].radius);
}

TEST_CASE("a grading gives all shapes of a mixture its sizes, whatever size they are given in") {
    const grading curve({{0.01, 0.0}, {0.02, 0.4}, {0.04, 1.0}});
    const mixture m(
        {{shapes::apollonian_14(circumscribed(1.0)), 0.7}, {shapes::tetrahedron_4(circumscribed(5.0)), 0.3}}, curve);
    CHECK(m.smallest_diameter() == 0.01);
    CHECK(m.largest_diameter() == 0.04);
    CHECK(m.d50() == Approx(curve.size_at(0.5)));
    CHECK(m.smallest_radius() == Approx(shapes::apollonian_14(circumscribed(0.01)).pebbles[13].radius));
    CHECK(m.largest_radius() == Approx(shapes::tetrahedron_4(circumscribed(0.04)).pebbles[0].radius));
    const double volume = 0.01;
    double of_part[2] = {}, finer[2] = {}, before = 1.0;
    for (const mixture_grain& g : m.grains_of(volume)) {
        of_part[g.part] += m.volume(g);
        finer[g.part] += m.diameter(g) < 0.02 ? m.volume(g) : 0.0;
        CHECK(m.diameter(g) <= before);
        before = m.diameter(g);
    }
    for (std::size_t k = 0; k < 2; ++k) {
        CHECK(of_part[k] == Approx((k == 0 ? 0.7 : 0.3) * volume).epsilon(1e-3));
        CHECK(finer[k] / of_part[k] == Approx(0.4).epsilon(5e-3));
    }
}

TEST_CASE("shares are those of the mass: a rock of half the density fills twice the room") {
    mixture m({{shapes::sphere(0.01), 1.0, 0, 1.0}, {shapes::tetrahedron_4(circumscribed(0.01)), 1.0, 1, 0.5}});
    double of_part[2] = {};
    for (const mixture_grain& g : m.grains_of(3e-4)) of_part[g.part] += m.volume(g);
    CHECK(of_part[0] == Approx(1e-4).epsilon(5e-3));
    CHECK(of_part[1] == Approx(2e-4).epsilon(5e-3));
}

TEST_CASE("a mixture of nothing, of empty shapes or of shares that are none is refused") {
    const auto refusal = [](const std::vector<mixture_part>& parts) -> std::string {
        try {
            (void)mixture(parts);
        } catch (const input_error& e) {
            return e.what();
        }
        return {};
    };
    CHECK(refusal({}).find("no shape") != std::string::npos);
    CHECK(refusal({{shape{}, 1.0}}).find("a shape with pebbles") != std::string::npos);
    CHECK(refusal({{shapes::sphere(0.01), 1.0}, {shapes::tetrahedron_4(circumscribed(0.01)), 0.0}})
              .find("share of shape '4B'") == 0);
    CHECK(refusal({{shapes::sphere(0.01), 1.0, 0, 0.0}}).find("density ratio of shape 'sphere'") == 0);
    CHECK(refusal({{shapes::sphere(0.01), 1.0}}).empty());
}

TEST_CASE("the paper's specimen holds 4961 grains of either shape in the equivalent reading, and more in the other") {
    const double solid = 0.42 * std::numbers::pi * 0.15 * 0.15 * 0.7; // 30 x 70 cm, porosity 58 %
    CHECK(mixture(shapes::tetrahedron_4(0.02)).grains_of(solid).size() == 4961);
    CHECK(mixture(shapes::apollonian_14(0.02)).grains_of(solid).size() == 4961);
    CHECK(mixture(shapes::tetrahedron_4(circumscribed(0.02))).grains_of(solid).size() == 13658);
    CHECK(mixture(shapes::apollonian_14(circumscribed(0.02))).grains_of(solid).size() == 9471);
    // what walls have to suit is the sphere around the largest grain
    const grading curve({{0.01, 0.0}, {0.04, 1.0}});
    CHECK(mixture(shapes::tetrahedron_4(1.0), curve).largest_circumscribed() == Approx(0.0560).epsilon(2e-3));
    CHECK(mixture(shapes::tetrahedron_4(circumscribed(1.0)), curve).largest_circumscribed() ==
          Approx(0.04).epsilon(1e-14));
}
