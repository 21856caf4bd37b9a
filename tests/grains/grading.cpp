// SPDX-License-Identifier: MIT
#include <clast/grains/grading.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <catch.hpp>

using namespace clast;

namespace {
std::string refusal(const std::vector<sieve>& curve) {
    try {
        (void)grading(curve);
    } catch (const input_error& e) {
        return e.what();
    }
    return {};
}
const std::vector<sieve> rockfill = {{5e-3, 0.0}, {1e-2, 0.2}, {2e-2, 0.55}, {2.5e-2, 0.55}, {4e-2, 1.0}};
} // namespace

TEST_CASE("a sieve curve is straight over the logarithm of size, both ways round") {
    const grading g(rockfill);
    CHECK(g.smallest() == 5e-3);
    CHECK(g.largest() == 4e-2);
    CHECK(g.finer(4e-3) == 0.0);
    CHECK(g.finer(5e-3) == 0.0);
    CHECK(g.finer(1e-2) == Approx(0.2).epsilon(1e-14));
    CHECK(g.finer(std::sqrt(2.0) * 1e-2) == Approx(0.375).epsilon(1e-14)); // half way in the logarithm
    CHECK(g.finer(2.2e-2) == Approx(0.55).epsilon(1e-14));                 // none between 20 and 25 mm
    CHECK(g.finer(4e-2) == 1.0);
    CHECK(g.finer(1.0) == 1.0);
    CHECK(g.size_at(0.0) == 5e-3);
    CHECK(g.size_at(0.375) == Approx(std::sqrt(2.0) * 1e-2).epsilon(1e-14));
    CHECK(g.size_at(0.55) == Approx(2e-2).epsilon(1e-14));
    CHECK(g.size_at(1.0) == Approx(4e-2).epsilon(1e-14));
    for (double share = 0.01; share < 1.0; share += 0.01)
        CHECK(g.finer(g.size_at(share)) == Approx(share).epsilon(1e-12));
}

TEST_CASE("a parallel grading has the same shares at sizes that keep their ratios") {
    const grading g(rockfill), small = g.parallel_to(1e-2);
    CHECK(small.largest() == 1e-2);
    CHECK(small.smallest() == Approx(1.25e-3).epsilon(1e-14));
    for (double d = 6e-3; d < 4e-2; d *= 1.1) CHECK(small.finer(0.25 * d) == Approx(g.finer(d)).margin(1e-12));
}

TEST_CASE("grains of a grading have its curve by mass, to half a grain of the class, and the volume asked for") {
    const grading g(rockfill);
    const double per_cube = 0.3; // of a lean shape
    for (const double volume : {2e-4, 3e-3, 1e-2}) {
        const std::vector<double> sizes = g.sizes(volume, per_cube);
        const auto volume_of = [&](double d) { return per_cube * d * d * d; };
        double total = 0.0;
        for (std::size_t k = 0; k < sizes.size(); ++k) {
            total += volume_of(sizes[k]);
            CHECK(sizes[k] > g.smallest());
            CHECK(sizes[k] < g.largest());
            CHECK(!(sizes[k] > 2e-2 && sizes[k] < 2.5e-2));
            if (k > 0) CHECK(sizes[k] <= sizes[k - 1]);
        }
        CHECK(std::abs(total - volume) < volume_of(1e-2)); // half a grain of the finest class would be volume_of(8 mm)
        for (std::size_t k = 1; k + 1 < rockfill.size(); ++k) {
            double coarser = 0.0;
            for (const double d : sizes) coarser += d > rockfill[k].size ? volume_of(d) : 0.0;
            // half a grain of the next coarser class that has mass: there is none from 20 to 25 mm
            const double coarse = rockfill[k].finer == 0.55 ? 4e-2 : rockfill[k + 1].size;
            CHECK(std::abs(coarser - (1.0 - rockfill[k].finer) * volume) < 0.5 * volume_of(coarse));
        }
        if (volume < 0.01) continue; // many grains: within the classes, too
        for (double d = 6e-3; d < 4e-2; d *= 1.2) {
            double finer = 0.0;
            for (const double one : sizes) finer += one < d ? volume_of(one) : 0.0;
            CHECK(finer / total == Approx(g.finer(d)).margin(5e-3));
        }
    }
    CHECK(g.sizes(0.0, per_cube).empty());
}

TEST_CASE("a curve that makes no sense is refused with the point and a way out") {
    const auto names = [](const std::string& text, const char* what) {
        INFO(text);
        CHECK(text.find("grading") == 0);
        CHECK(text.find(what) != std::string::npos);
        CHECK(text.find("Allowed") != std::string::npos);
    };
    CHECK(refusal(rockfill).empty());
    names(refusal({}), "0 points");
    names(refusal({{0.01, 1.0}}), "1 points");
    names(refusal({{0.01, 0.0}, {0.02, 1.2}}), "20 mm, 120 % finer");
    names(refusal({{-0.01, 0.0}, {0.02, 1.0}}), "-10 mm");
    names(refusal({{0.01, 0.0}, {std::nan(""), 1.0}}), "nan");
    names(refusal({{0.01, 0.0}, {0.02, 0.5}, {0.02, 1.0}}), "20 mm, 50 % finer, then 20 mm, 100 % finer");
    names(refusal({{0.01, 0.0}, {0.02, 0.5}, {0.03, 0.4}, {0.04, 1.0}}), "30 mm, 40 % finer");
    names(refusal({{0.01, 0.05}, {0.02, 1.0}}), "from 5 % to 100 %");
    names(refusal({{0.01, 0.0}, {0.02, 0.9}}), "from 0 % to 90 %");
}
