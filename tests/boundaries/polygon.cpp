// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <catch.hpp>

#include <clast/boundaries/polygon.hpp>

using namespace clast::boundaries;

namespace {

struct point {
    double x, y;
};

// Area of a large square cut by the half-planes x.n_i <= R_i, one after the other (Sutherland and Hodgman).
double clipped_area(const std::vector<double>& apothem) {
    std::vector<point> shape{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
    const auto n = apothem.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
        const auto beyond = [&](const point& p) { return p.x * std::cos(angle) + p.y * std::sin(angle) - apothem[i]; };
        std::vector<point> kept;
        for (std::size_t j = 0; j < shape.size(); ++j) {
            const point a = shape[j];
            const point b = shape[(j + 1) % shape.size()];
            const double da = beyond(a);
            const double db = beyond(b);
            if (da <= 0.0) kept.push_back(a);
            if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) {
                const double t = da / (da - db);
                kept.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
            }
        }
        shape = kept;
    }
    double twice = 0.0;
    for (std::size_t j = 0; j < shape.size(); ++j) {
        const point a = shape[j];
        const point b = shape[(j + 1) % shape.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

double area_of_tiles(const std::vector<double>& apothem, double half_width) {
    const directions d(static_cast<int>(apothem.size()));
    const double smallest = *std::min_element(apothem.begin(), apothem.end());
    double sum = 0.0;
    for (int i = 0; i < d.count; ++i)
        sum += 0.5 * visible(d, apothem, i, half_width, smallest).width() * apothem[static_cast<std::size_t>(i)];
    return sum;
}

} // namespace

TEST_CASE("visible widths give the exact polygon area, hidden tiles and second neighbours included", "[boundaries]") {
    std::mt19937 random(11);
    for (const int tiles : {6, 7, 20, 40})
        for (const double spread : {1e-6, 2e-3, 5e-3, 20e-3}) {
            std::uniform_real_distribution<double> offset(-spread, spread);
            for (int n = 0; n < 30; ++n) {
                std::vector<double> apothem(static_cast<std::size_t>(tiles), 0.15);
                for (double& one : apothem) one += offset(random);
                CHECK(area_of_tiles(apothem, 10.0) == Approx(clipped_area(apothem)).epsilon(1e-11));
            }
        }
}

TEST_CASE("a regular ring of tiles around a circle has the textbook width and area excess", "[boundaries]") {
    const std::vector<double> apothem(20, 0.15);
    const auto tile = visible(directions(20), apothem, 3, 1.0, 0.15);
    CHECK(tile.width() == Approx(regular_width(20, 0.15)).epsilon(1e-13));
    CHECK(tile.width() == Approx(0.0475).epsilon(2e-3)); // 4.75 cm, 2.38 particles of 2 cm
    CHECK(tile.low == Approx(-tile.high).epsilon(1e-13));
    const double circle = std::numbers::pi * 0.15 * 0.15;
    CHECK(area_of_tiles(apothem, 1.0) / circle - 1.0 == Approx(0.0083).epsilon(0.01)); // below 1 %: paper Fig. 3d
    CHECK(area_of_tiles(std::vector<double>(18, 0.15), 1.0) / circle - 1.0 > 0.01);
}

TEST_CASE("a tile is hidden once it lies R (1 - cos a) behind its neighbours, and has width 0, not less",
          "[boundaries]") {
    std::vector<double> apothem(20, 0.15);
    const double depth = 0.15 * (1.0 / std::cos(0.1 * std::numbers::pi) - 1.0);
    CHECK(depth > 7.3e-3);
    apothem[4] += 0.999 * depth;
    CHECK(visible(directions(20), apothem, 4, 1.0, 0.15).width() > 0.0);
    apothem[4] = 0.15 + 1.001 * depth;
    CHECK(visible(directions(20), apothem, 4, 1.0, 0.15).width() == 0.0);
}

TEST_CASE("tiles wide enough for the largest step leave no slit, narrower ones do", "[boundaries]") {
    const double half = half_width_without_slit(20, 0.15, 5e-3);
    CHECK(2.0 * half == Approx(80e-3).epsilon(2e-3));
    std::vector<double> apothem(20, 0.15);
    apothem[7] -= 5e-3;
    CHECK(area_of_tiles(apothem, half) == Approx(clipped_area(apothem)).epsilon(1e-12));
    CHECK(area_of_tiles(apothem, 0.9 * half) < clipped_area(apothem) * (1.0 - 1e-4));
}

TEST_CASE("the tile that faces a point is found all around", "[boundaries]") {
    const directions d(20);
    for (int i = 0; i < 20; ++i)
        for (const double off : {-0.49, 0.0, 0.49})
            CHECK(d.towards(3.0 * std::cos(d.angle() * (i + off)), 3.0 * std::sin(d.angle() * (i + off))) == i);
}
