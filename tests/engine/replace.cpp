// SPDX-License-Identifier: MIT
#include <clast/engine/replace.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <clast/engine/engine.hpp>
#include <clast/grains/overlapping_shape.hpp>

#include <catch.hpp>

#include "engine/scenes.hpp"

using namespace clast;

namespace {
/// What a policy was asked to do, in order: what, and the grain.
struct diary {
    std::vector<std::pair<char, std::int32_t>> entries;
    std::vector<std::int64_t> ids;
};
/// Changes nothing, or cuts off the first pebble.
struct observed {
    static constexpr bool replaces = true, makes_bonds = false;
    struct plan {
        std::int32_t grain;
    };
    std::shared_ptr<diary> book = std::make_shared<diary>();
    int every = 3;
    bool cuts = false;

    int looks_every() const { return every; }
    template <class View> std::optional<plan> wants(const View& clump) const {
        book->entries.emplace_back('w', clump.grain());
        if (clump.shape().pebbles.size() < 4) return std::nullopt;
        return plan{clump.grain()};
    }
    template <class Surgery> void act(std::int32_t grain, const plan& p, Surgery& surgery) const {
        book->entries.emplace_back('a', grain);
        book->ids.push_back(p.grain);
        if (cuts) surgery.split(grain, std::vector<replacements::pebble_run>{{0, 1}, {1, 1}, {2, 2}});
        surgery.again_in(grain, 2);
    }
    template <class Surgery> void again(std::int32_t grain, Surgery&) const { book->entries.emplace_back('g', grain); }
};
struct policies : scenes::breakable<> {
    using replacement = observed;
};
using entries = std::vector<std::pair<char, std::int32_t>>;

/// Three grains of four pebbles each.
engine<policies> three(bool cuts, int every = 3) {
    auto s = scenes::settings<policies>(1e6);
    s.replacement.cuts = cuts, s.replacement.every = every;
    std::vector<shape_pebble> square;
    for (const double x : {-0.004, 0.004})
        for (const double y : {-0.004, 0.004}) square.push_back({{x, y, 0.0}, 0.004});
    bodies::clumps sp = scenes::empty(make_shape("square", square));
    for (int k = 0; k < 3; ++k) sp.add(0, {0.0, 0.0, 0.0079 * (k - 1)}, sp.shapes[0].to_input_frame);
    return engine<policies>(std::move(s), std::move(sp), boundaries::solid_strips(scenes::cylinder(0.2, 0.4)));
}
/// What is told of the next step.
entries next(engine<policies>& e) {
    e.step();
    return std::exchange(e.settings.replacement.book->entries, {});
}
} // namespace

TEST_CASE(
    "clumps are looked at every so many steps, those wanted are acted on in order, and asked about again in time") {
    engine<policies> e = three(false);
    const entries looked{{'w', 0}, {'w', 1}, {'w', 2}, {'a', 0}, {'a', 1}, {'a', 2}};
    const entries again{{'g', 2}, {'g', 1}, {'g', 0}};
    CHECK(next(e) == looked); // step 0
    CHECK(next(e).empty());
    CHECK(next(e) == again); // two steps later
    CHECK(next(e) == looked);
    e.breakage_on = false;
    CHECK(next(e).empty());
    CHECK(next(e) == again); // what was promised holds
    CHECK(next(e).empty());
    CHECK(e.totals().replaced == 0);
    CHECK(e.totals().rebuilds == 1); // nothing has changed
}

TEST_CASE("what is wanted, and who is asked about again, follows grains that move up") {
    engine<policies> e = three(true);
    CHECK(next(e) == entries{{'w', 0}, {'w', 1}, {'w', 2}, {'a', 0}, {'a', 3}, {'a', 6}});
    CHECK(e.settings.replacement.book->ids == std::vector<std::int64_t>{0, 1, 2}); // with their own plans
    CHECK(e.grains.grain_count() == 9);
    CHECK(next(e).empty());
    CHECK(next(e) == entries{{'g', 6}, {'g', 3}, {'g', 0}});
    CHECK(next(e).size() == 9); // parts are looked at like any other clump
}

TEST_CASE("grains whose pebbles overlap move like others, but not where they may be replaced") {
    const shape lump = scaled_to(overlapping_shape("lump", {{{0, 0, 0}, 1.0}, {{1, 0, 0}, 0.8}}, overlaps::as_union),
                                 circumscribed(0.02));
    using rigid = scenes::unbreakable<>;
    auto s = scenes::settings<rigid>();
    s.scheme.damping = 0.0;
    s.safety = 0.1;
    engine<rigid> e = scenes::collision(s, lump);
    const double before = e.kinetic_energy();
    const vec3 p = scenes::momentum(e.grains);
    CHECK(e.grains.body_mass(0) == Approx(e.grains.density * lump.volume));
    CHECK(e.grains.solid_volume() == Approx(2.0 * lump.volume).epsilon(1e-14));
    e.step(4000);
    CHECK(e.losses().friction > 0.0); // they met
    CHECK(e.elastic_energy() == 0.0);
    CHECK(norm(scenes::momentum(e.grains) - p) < 1e-12 * norm(p));
    CHECK(e.kinetic_energy() + e.losses().friction == Approx(before).epsilon(1e-3));
    std::string text;
    try {
        using breaking = scenes::breakable<>;
        (void)scenes::collision(scenes::settings<breaking>(1e6), lump);
    } catch (const input_error& error) {
        text = error.what();
    }
    CHECK(text.find("shape 'lump'") == 0);
    CHECK(text.find("replacements::none") != std::string::npos);
}
