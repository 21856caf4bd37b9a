// SPDX-License-Identifier: MIT
// Design invariant 1: stopped and resumed through files, or looked at, a run ends with the bits of an undisturbed one.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/io/checkpoint.hpp>

#include <catch.hpp>

#include "equivalence/toy.hpp"

using namespace clast;

namespace {

constexpr double strain = 0.06;

struct folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("clast_equivalence_" + std::to_string(::getpid()));
    folder() { std::filesystem::create_directories(path); }
    ~folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
};

template <class P> std::unique_ptr<triaxial_test<P>> fresh() {
    const auto setup = toy::setup<P>();
    return std::make_unique<triaxial_test<P>>(setup, toy::stages(setup, strain));
}

/// Draws and measures everything at every pause, and writes a checkpoint.
template <class P> struct curious : toy::recorder {
    triaxial_test<P>* test = nullptr;
    std::filesystem::path file;
    void on_pause() override {
        (void)test->protocol().pebbles();
        (void)test->protocol().facets();
        (void)test->protocol().measure();
        save_checkpoint(file, "toy", *test);
    }
};

/// All columns but the time on the clock.
bool same(sample a, sample b) {
    a.wall_time = b.wall_time = 0.0;
    const auto numbers = [](const sample& s) {
        return std::vector<double>{s.time,
                                   s.axial_strain,
                                   s.volumetric_strain,
                                   s.height,
                                   s.volume,
                                   s.sigma_1,
                                   s.sigma_3,
                                   s.sigma_1_love_weber,
                                   s.void_ratio,
                                   s.inertial_number,
                                   s.unbalanced_ratio,
                                   s.confining_error,
                                   s.max_overlap_over_r,
                                   s.coordination,
                                   s.kinetic_energy,
                                   s.elastic_energy,
                                   s.boundary_work,
                                   s.energy_residual,
                                   s.dt,
                                   static_cast<double>(s.steps),
                                   static_cast<double>(s.replaced)};
    };
    return a.stage == b.stage && numbers(a) == numbers(b);
}

} // namespace

TEMPLATE_TEST_CASE("a run that is stopped and resumed through files ends like one that was not", "", boundaries::tiles,
                   boundaries::solid_strips, boundaries::ring_walls) {
    using P = toy::bundle<TestType>;
    auto reference = fresh<P>();
    toy::recorder whole;
    REQUIRE(reference->run(whole));
    const auto broken = [](const triaxial_test<P>& t) {
        return t.sim().totals().broken_tension + t.sim().totals().broken_shear;
    };
    CHECK(broken(*reference) >= 7);

    const folder place;
    const std::filesystem::path file = place.path / "checkpoint.clast";
    toy::recorder parts;
    auto test = fresh<P>();
    // while packing, where stages change, at the first clusters, at the first breaks, among the pieces
    const std::vector<std::function<bool()>> points = {
        [&] { return test->sim().totals().steps >= 300; },
        [&] { return test->protocol().stage_name() == "consolidate"; },
        [&] { return test->protocol().stage_name() == "shear"; },
        [&] { return test->sim().totals().replaced > 0; },
        [&] { return broken(*test) > 0; },
        [&] { return broken(*test) >= 5; },
    };
    for (const auto& point : points) {
        parts.stop_when = point;
        REQUIRE_FALSE(test->run(parts));
        save_checkpoint(file, "toy", *test);
        test = fresh<P>();
        load_checkpoint(file, "toy", *test);
    }
    parts.stop_when = nullptr;
    REQUIRE(test->run(parts));

    CHECK(toy::fingerprint(*test) == toy::fingerprint(*reference));
    REQUIRE(parts.rows.size() == whole.rows.size());
    std::size_t different = 0;
    for (std::size_t k = 0; k < whole.rows.size(); ++k) different += same(parts.rows[k], whole.rows[k]) ? 0 : 1;
    CHECK(different == 0);
    REQUIRE(parts.events.size() == whole.events.size());
    for (std::size_t k = 0; k < whole.events.size(); ++k) {
        CHECK(parts.events[k].time == whole.events[k].time);
        CHECK(parts.events[k].axial_strain == whole.events[k].axial_strain);
        CHECK(parts.events[k].position == whole.events[k].position);
    }
}

TEST_CASE("a run that is drawn, measured and saved at every pause ends like one that is left alone") {
    using P = toy::bundle<boundaries::tiles>;
    auto reference = fresh<P>(), watched = fresh<P>();
    toy::recorder whole;
    REQUIRE(reference->run(whole));
    const folder place;
    curious<P> watch;
    watch.test = watched.get();
    watch.file = place.path / "checkpoint.clast";
    REQUIRE(watched->run(watch));
    CHECK(toy::fingerprint(*watched) == toy::fingerprint(*reference));
    CHECK(watch.rows.size() == whole.rows.size());
}
