// SPDX-License-Identifier: MIT
#include <clast/protocol/follow.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <clast/boundaries/rigid_cylinder.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/core/errors.hpp>
#include <clast/protocol/test_plan.hpp>

#include <catch.hpp>

using namespace clast;
using namespace clast::literals;
using boundaries::drive;

namespace {
boundaries::vessel_settings sizes() {
    boundaries::vessel_settings s;
    s.radius = 0.05, s.bottom = -0.1, s.top = 0.1;
    s.rings = 4, s.tiles_per_ring = 8;
    s.smallest_radius = 0.004, s.largest_radius = 0.01, s.largest_gap = 0.01;
    s.contact_stiffness_floor = 1e6;
    return s;
}
stage of(axis_drive axial, axis_drive lateral, std::optional<axis_drive> lateral_y = {}) {
    return {.name = "shear",
            .axial = std::move(axial),
            .lateral = std::move(lateral),
            .end = until::steps(1),
            .lateral_y = std::move(lateral_y)};
}
/// Shortened by 10 % with every node loaded differently.
template <class B> double worst_volume() {
    B b = B::made(sizes());
    std::vector<boundaries::facet_load> loads(static_cast<std::size_t>(b.facet_count()));
    for (std::size_t f = 0; f < loads.size(); ++f)
        loads[f] = {100.0 + 7.0 * static_cast<double>(f % 5), 1e6 + 1e5 * static_cast<double>(f % 3), 1};
    const stage s = of(drive_by::strain_rate(1_per_s), drive_by::constant_volume());
    boundaries::drives d;
    d.platens = {drive::mode::velocity, 0.5 * b.height(), 0.0, 0.5};
    d.lateral = {drive::mode::volume, 0.0, 1e-3, 0.5};
    const double volume = b.volume(), dt = 1e-5;
    double worst = 0.0;
    for (int k = 0; k < 10'000; ++k) {
        d.platens.value = 0.5 * b.height();
        protocol::follow(d, s, {}, b, volume, dt);
        b.control(loads, d, dt);
        b.advance(dt);
        worst = std::max(worst, std::abs(b.volume() / volume - 1.0));
    }
    CHECK(b.height() < 0.91 * 0.2);
    return worst;
}
} // namespace

TEST_CASE("walls that keep the volume do, whatever they feel, and tiles still move towards one stress") {
    CHECK(worst_volume<boundaries::rigid_cylinder>() < 1e-8); // a step of 1e-5 leaves its square
    CHECK(worst_volume<boundaries::tiles>() < 1e-8);
    using wall = boundaries::tiles;
    wall b = wall::made(sizes());
    std::vector<boundaries::facet_load> loads(static_cast<std::size_t>(b.facet_count()));
    for (auto& l : loads) l = {100.0, 1e6, 1};
    loads[5].force = 200.0;
    boundaries::drives d;
    d.lateral = {drive::mode::volume, 0.0, 1.0, 0.5};
    b.control(loads, d, 1e-4);
    CHECK(b.velocity(5) < b.velocity(8)); // it gives way
}

TEST_CASE("a target follows the specimen, and never asks for tension") {
    const axis_drive stays = drive_by::hold();
    const stage s = of(stays, drive_by::stress_that([](const stage_view& v) { return 300e3 - v.q; }));
    CHECK(protocol::follows(s));
    CHECK_FALSE(protocol::follows(of(stays, drive_by::stress(1_kPa))));
    const auto b = boundaries::rigid_cylinder::made(sizes());
    boundaries::drives d;
    stage_view v;
    v.q = 100e3;
    protocol::follow(d, s, v, b, 0.0, 1e-5);
    CHECK(d.lateral.value == Approx(200e3));
    v.q = 400e3;
    protocol::follow(d, s, v, b, 0.0, 1e-5);
    CHECK(d.lateral.value == 0.0);
}

TEST_CASE("drives that cannot be are refused by the name of their stage") {
    const auto refused = [](const stage& s, bool three_axes, const char* word) {
        test_plan p;
        p.stages = {s};
        std::string said;
        try {
            (void)protocol::completed(p, three_axes);
        } catch (const input_error& e) {
            said = e.what();
        }
        INFO(said);
        CHECK((*word == 0 ? said.empty() : said.find("stage 'shear'") != std::string::npos));
        CHECK(said.find(word) != std::string::npos);
    };
    const axis_drive stress = drive_by::stress(1_kPa);
    const axis_drive stays = drive_by::hold();
    refused(of(stays, stress, stress), true, "");
    refused(of(stays, stress, stress), false, "boundaries::box");
    refused(of(stays, stays, stress), true, "beside lateral_y");
    refused(of(stays, stress, drive_by::size(1_cm)), true, "a stress");
    refused(of(drive_by::constant_volume(), stress), true, "the lateral wall");
    refused(of(stays, drive_by::stress_that({})), true, "follows nothing");
}
