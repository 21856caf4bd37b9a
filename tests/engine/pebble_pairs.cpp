// SPDX-License-Identifier: MIT
#include <clast/engine/pebble_pairs.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <clast/bodies/clumps.hpp>
#include <clast/core/random.hpp>
#include <clast/grains/shape.hpp>
#include <clast/searches/brute_force.hpp>
#include <clast/spaces/open.hpp>
#include <clast/spaces/periodic.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

struct named {
    pebble_pair pair;
    std::uint8_t image;
    auto operator<=>(const named&) const = default;
};

/// Clumps of four and of fourteen pebbles anywhere in a cube around the origin.
bodies::clumps clumps(std::size_t n, double edge) {
    random_stream random{3, n};
    bodies::clumps sp;
    sp.shapes = {shapes::tetrahedron_4(circumscribed(0.03)), shapes::apollonian_14(circumscribed(0.04))};
    for (std::size_t k = 0; k < n; ++k) {
        const auto any = [&] { return uniform(random, -0.5 * edge, 0.5 * edge); };
        sp.add(static_cast<std::int32_t>(k % 2), {any(), any(), any()}, orientation(random));
    }
    return sp;
}
double gap(const bodies::clumps& sp, std::int32_t p, std::int32_t q, const vec3& shift) {
    const auto& a = sp.pebbles[static_cast<std::size_t>(p)];
    const auto& b = sp.pebbles[static_cast<std::size_t>(q)];
    return norm(b.x + shift - a.x) - a.radius - b.radius;
}
bool in_order(const bodies::clumps& sp, const pebble_pair& a, const pebble_pair& b) {
    const std::size_t ga = sp.group_of(a.i), gb = sp.group_of(b.i);
    return ga != gb ? ga < gb : a.j != b.j ? a.j < b.j : a.i < b.i;
}
std::vector<named> sorted(std::vector<named> v) {
    std::sort(v.begin(), v.end());
    return v;
}
std::vector<named> of(const pair_list& list) {
    std::vector<named> v;
    for (std::size_t k = 0; k < list.size(); ++k)
        v.push_back({list.pairs[k], list.image.empty() ? no_shift : list.image[k]});
    return sorted(v);
}

} // namespace

TEST_CASE("pairs of clumps and of loose balls are those of a look at all, in the order of the lists") {
    bodies::clumps sp = clumps(40, 0.12);
    const double margin = 2e-3;
    // two clumps have come apart: their pebbles are balls
    for (const std::size_t g : {3U, 17U}) {
        sp.grains[g].cluster = 0;
        for (std::size_t p = sp.pebbles_of(g).begin; p < sp.pebbles_of(g).end; ++p)
            sp.owner[p] = static_cast<std::int32_t>(sp.grain_count() + p);
    }
    search_spheres spheres;
    for (std::size_t g = 0; g < sp.grain_count(); ++g)
        if (sp.is_clump(g))
            spheres.all.push_back({sp.centre(g), sp.bounding_radius(g), static_cast<std::int32_t>(g)});
        else
            for (std::size_t p = sp.pebbles_of(g).begin; p < sp.pebbles_of(g).end; ++p)
                spheres.all.push_back({sp.pebbles[p].x, sp.pebbles[p].radius, sp.owner[p]});
    std::vector<named> slow, fast;
    for (std::int32_t p = 0; p < static_cast<std::int32_t>(sp.pebble_count()); ++p)
        for (std::int32_t q = p + 1; q < static_cast<std::int32_t>(sp.pebble_count()); ++q) {
            if (sp.body_of(p) == sp.body_of(q) || gap(sp, p, q, {}) >= margin) continue;
            const bool light = std::max(sp.body_of(p), sp.body_of(q)) >= sp.grain_count();
            (light ? fast : slow).push_back({{p, q}, no_shift});
        }
    REQUIRE((slow.size() > 100 && fast.size() > 30));
    for (const int threads : {1, 3}) {
        const execution run(threads);
        const auto found = pebble_pairs(sp, spaces::open{}, margin, run)
                               .of(spheres, searches::brute_force{}.pairs(spheres.all, margin));
        CHECK(of(found.heavy) == sorted(slow));
        CHECK(of(found.light) == sorted(fast));
        CHECK((found.heavy.image.empty() && found.heavy.shared == 0));
        for (const pair_list* list : {&found.heavy, &found.light})
            CHECK(std::is_sorted(list->pairs.begin(), list->pairs.end(),
                                 [&](const auto& a, const auto& b) { return in_order(sp, a, b); }));
    }
}

TEST_CASE("in a periodic cell every pair is found once, with the image that is near") {
    const vec3 edges{0.30, 0.24, 0.27};
    bodies::clumps sp = clumps(150, 0.24);
    const double margin = 2e-3;
    double widest = 0.0;
    search_spheres spheres;
    for (std::size_t g = 0; g < sp.grain_count(); ++g) {
        // spread over the cell
        sp.motion[g].x = {sp.motion[g].x.x * edges.x / 0.24, sp.motion[g].x.y, sp.motion[g].x.z * edges.z / 0.24};
        sp.place(g);
        spheres.all.push_back({sp.centre(g), sp.bounding_radius(g), static_cast<std::int32_t>(g)});
        widest = std::max(widest, 2.0 * sp.bounding_radius(g));
    }
    spheres.add_images(edges, widest + margin);
    REQUIRE(spheres.real() == sp.grain_count());
    REQUIRE(!spheres.image.empty());
    std::vector<named> expected;
    for (std::int32_t p = 0; p < static_cast<std::int32_t>(sp.pebble_count()); ++p)
        for (std::int32_t q = p + 1; q < static_cast<std::int32_t>(sp.pebble_count()); ++q)
            for (std::size_t image = 0; image < 27; ++image)
                if (sp.body_of(p) != sp.body_of(q) && gap(sp, p, q, image_shift(image, edges)) < margin)
                    expected.push_back({{p, q}, static_cast<std::uint8_t>(image)});
    const auto across =
        std::count_if(expected.begin(), expected.end(), [](const named& n) { return n.image != no_shift; });
    REQUIRE(across > 30);
    const execution run(1);
    const auto found = pebble_pairs(sp, spaces::periodic(edges), margin, run)
                           .of(spheres, searches::brute_force{}.pairs(spheres.all, margin));
    CHECK(of(found.heavy) == sorted(expected));
    CHECK(found.light.size() == 0);
}
