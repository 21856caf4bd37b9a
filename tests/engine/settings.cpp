// SPDX-License-Identifier: MIT
#include <clast/engine/settings.hpp>

#include <functional>
#include <limits>
#include <string>

#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/engine/engine.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {
using spheres_alone = scenes::unbreakable_spheres<>;
using settings_type = engine_settings<spheres_alone>;

std::string refusal(const std::function<void(settings_type&, bodies::spheres&)>& change) {
    settings_type s{.grain_contact = {1e6, 5e5, 0.3},
                    .platen_contact = {},
                    .lateral_contact = {},
                    .breakage = {},
                    .replacement = {}};
    bodies::spheres one;
    change(s, one);
    one.add({}, 0.01);
    try {
        engine<spheres_alone> e(s, one, spaces::open{});
        e.step();
    } catch (const input_error& e) {
        return e.what();
    }
    return {};
}
} // namespace

TEST_CASE("values that make no sense are refused by the name of the member, with what is allowed") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    CHECK(refusal([](settings_type&, bodies::spheres&) {}).empty());
    const auto names = [](const std::string& text, const std::string& member) {
        INFO(text);
        CHECK(text.find(member + ": ") == 0);
        CHECK(text.find("Allowed: ") != std::string::npos);
    };
    for (const double wrong : {0.0, -1.0, 5.0, nan})
        names(refusal([&](settings_type& s, bodies::spheres&) { s.safety = wrong; }), "engine_settings.safety");
    for (const double wrong : {1.5, -0.1, nan})
        names(refusal([&](settings_type& s, bodies::spheres&) { s.scheme.damping = wrong; }),
              "engine_settings.scheme.damping");
    for (const double wrong : {0.0, 0.29})
        names(refusal([&](settings_type& s, bodies::spheres&) {
                  s.light_bodies = stepping::sub_steps, s.scheme.damping = wrong;
              }),
              "engine_settings.light_bodies");
    names(refusal([](settings_type& s, bodies::spheres&) { s.light_bodies = stepping::sub_steps, s.safety = 0.85; }),
          "engine_settings.light_bodies");
    CHECK(refusal([](settings_type& s, bodies::spheres&) { s.light_bodies = stepping::sub_steps; }).empty());
    for (const double wrong : {-0.3, nan, inf})
        names(refusal([&](settings_type& s, bodies::spheres&) { s.grain_contact.mu = wrong; }),
              "engine_settings.grain_contact.mu");
    for (const double wrong : {0.0, -2650.0, nan})
        names(refusal([&](settings_type&, bodies::spheres& b) { b.density = wrong; }), "density of the bodies");
    names(refusal([](settings_type& s, bodies::spheres&) { s.skin = -1e-3; }), "engine_settings.skin");
    for (const double wrong : {0.0, -1e-5, nan})
        names(refusal([&](settings_type& s, bodies::spheres&) { s.largest_step = wrong; }),
              "engine_settings.largest_step");
    // bodies that nothing would ever stop say nothing about a step
    const auto without_stiffness = [](settings_type& s, bodies::spheres&) { s.grain_contact = {}; };
    names(refusal(without_stiffness), "engine_settings.largest_step");
    CHECK(refusal([&](settings_type& s, bodies::spheres& b) {
              without_stiffness(s, b);
              s.largest_step = 1e-4;
          }).empty());
    names(refusal([](settings_type& s, bodies::spheres&) { s.expected_overlap = 0.0; }),
          "engine_settings.expected_overlap");
}

TEST_CASE("light bodies take sub-steps where these have been found stable, if not told otherwise") {
    settings_type s{
        .grain_contact = {}, .platen_contact = {}, .lateral_contact = {}, .breakage = {}, .replacement = {}};
    CHECK(takes_sub_steps(s)); // the defaults
    s.scheme.damping = 0.3;
    CHECK(takes_sub_steps(s));
    s.scheme.damping = 0.29;
    CHECK_FALSE(takes_sub_steps(s));
    s.scheme.damping = 0.7, s.safety = 0.81;
    CHECK_FALSE(takes_sub_steps(s));
    s.safety = 0.8, s.light_bodies = stepping::one_step;
    CHECK_FALSE(takes_sub_steps(s));
}
