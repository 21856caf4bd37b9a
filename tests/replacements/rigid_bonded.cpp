// SPDX-License-Identifier: MIT
// Rigid until a bond fails: against grains whose bonds are there from the start, and its own promises.
#include <clast/replacements/rigid_bonded.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <clast/criteria/weibull.hpp>
#include <clast/engine/engine.hpp>
#include <clast/io/archive.hpp>
#include <clast/measure/digest.hpp>
#include <clast/replacements/bonded_from_start.hpp>

#include <catch.hpp>

#include "replacements/crushed.hpp"

static_assert(clast::replacements::replacing<clast::replacements::rigid_bonded>);

using namespace clast;
using replacements::bonded_from_start;
using replacements::rigid_bonded;
using policies = crushed::policies<rigid_bonded>;

namespace {

struct scattered_strength : criteria::weibull<criteria::nominal_force> {
    scattered_strength(criteria::crushing_strength s) : weibull{{s}, 2.0, 0} {}
};
struct scattered : policies {
    using breakage = scattered_strength;
};

double median(std::vector<double> of) {
    std::sort(of.begin(), of.end());
    return 0.5 * (of[(of.size() - 1) / 2] + of[of.size() / 2]);
}
/// Grains of some orientations, each by bonds from the start and by this policy.
struct comparison {
    std::vector<double> first, peak;

    comparison(const shape& form, std::uint64_t count) {
        for (std::uint64_t k = 0; k < count; ++k) {
            auto exact = crushed::seated<bonded_from_start>(form, k);
            auto rigid = crushed::seated<rigid_bonded>(form, k);
            const crushed::outcome a = crushed::crush(exact), b = crushed::crush(rigid);
            first.push_back(b.first / a.first), peak.push_back(b.peak / a.peak);
            UNSCOPED_INFO(k << ": first " << a.first << " and " << b.first << " N, peak " << a.peak << " and " << b.peak
                            << " N, bonds " << a.bonds << " and " << b.bonds);
        }
    }
    double within(const std::vector<double>& of, double tolerance) const {
        return static_cast<double>(
                   std::count_if(of.begin(), of.end(), [&](double x) { return std::abs(x - 1.0) < tolerance; })) /
               static_cast<double>(of.size());
    }
};

} // namespace

TEST_CASE("a grain of four pebbles between rough platens breaks at the force of one that is bonded from the start") {
    const comparison c(shapes::tetrahedron_4(circumscribed(0.02)), 8);
    CHECK(median(c.first) == Approx(1.0).epsilon(0.005));
    CHECK(c.within(c.first, 0.015) >= 0.75);
    CHECK(median(c.peak) == Approx(1.0).epsilon(0.01));
    CHECK(c.within(c.peak, 0.05) >= 0.75);
}

TEST_CASE("a grain of fourteen pebbles between rough platens, too") {
    const comparison c(shapes::apollonian_14(circumscribed(0.02)), 5);
    CHECK(median(c.first) == Approx(1.0).epsilon(0.015));
    CHECK(median(c.peak) == Approx(1.0).epsilon(0.02));
}

TEST_CASE("a burst begins with the worst bond at its strength and ends in rigid pieces that break on by their bonds") {
    auto e = crushed::seated<rigid_bonded>(shapes::apollonian_14(circumscribed(0.02)), 9);
    e.drives.platens.value = 0.1;
    std::vector<fracture_event> events;
    int bursts = 0;
    bool quiet = true; // no cluster
    double last = 0.0;
    std::vector<int> broken(36, 0);
    for (int k = 0; k < 20000 && bursts < 3; ++k) {
        e.step();
        bool bonded = false;
        for (const grain& g : e.grains.grains) bonded = bonded || g.cluster >= 0;
        const auto some = e.take_events();
        if (bonded && quiet) ++bursts;
        for (const fracture_event& one : some) {
            CHECK(one.mother == 0);
            ++broken.at(static_cast<std::size_t>(one.bond));
            last = one.time;
        }
        if (!bonded && !quiet) {
            const double ended = e.time() - last;
            CHECK((ended >= e.settings.replacement.quiet - e.dt() &&
                   ended < e.settings.replacement.quiet + 3.0 * e.dt()));
            std::size_t left = 0; // and what is broken stays so
            for (const grain& g : e.grains.grains) {
                const shape& form = e.grains.shape_of(g);
                left += form.bonds.size();
                for (const std::int32_t number : form.bond_numbers)
                    CHECK(broken.at(static_cast<std::size_t>(number)) == 0);
            }
            CHECK(left == 36 - static_cast<std::size_t>(std::count(broken.begin(), broken.end(), 1)));
        }
        quiet = !bonded;
    }
    REQUIRE(bursts == 3);
    CHECK(*std::max_element(broken.begin(), broken.end()) == 1);
    CHECK(e.grains.grain_count() > 2);
}

TEST_CASE("the plan scales statics until the worst bond is just at its strength, which follows the grain's") {
    struct view {
        bonds::lattice own{shapes::tetrahedron_4(circumscribed(0.02)), bonds::parallel{}, 2650.0};
        clast::shape form = shapes::tetrahedron_4(circumscribed(0.02));
        std::vector<bonds::pebble_load> load{4};
        double factor = 1.0;
        const clast::shape& shape() const { return form; }
        const bonds::lattice& lattice() const { return own; }
        bonds::likeness like() const { return {}; }
        double strength_factor() const { return factor; }
        std::vector<bonds::pebble_load> pebble_loads() const { return load; }
        quaternion orientation() const { return {}; }
        vec3 spin() const { return {}; }
    } clump;
    clump.load[0].force = {4000.0, 4000.0, 0.0}, clump.load[3].force = {-4000.0, -4000.0, 0.0};
    const auto exact = clump.own.statics(clump.load, {}, {});
    double worst = 0.0;
    for (std::size_t b = 0; b < 6; ++b) worst = std::max(worst, bonds::utilisation(clump.own.bond[b], exact[b]));
    const rigid_bonded policy{};
    clump.factor = 1.001 * worst;
    CHECK(!policy.wants(clump));
    for (const double beyond : {0.999, 0.5}) {
        clump.factor = beyond * worst;
        const auto plan = policy.wants(clump);
        REQUIRE(plan);
        int failing = 0;
        for (std::size_t b = 0; b < 6; ++b) {
            CHECK(plan->born[b].n == Approx(beyond * exact[b].n).margin(1e-9));
            const auto f = bonds::failing(clump.own.bond[b], plan->born[b], clump.factor);
            failing += f.tension || f.shear;
        }
        CHECK((failing >= 1 && failing < 6));
    }
    clump.form.bonds.clear();
    CHECK(!policy.wants(clump));
}

TEST_CASE("pieces keep the strength factor of the grain that they come from") {
    auto s = scenes::settings<scattered>(1e15, 0.005);
    s.replacement.singles_stay_balls = false, s.replacement.check_interval = 1; // the collision is short
    engine<scattered> e = scenes::collision(s, shapes::apollonian_14(circumscribed(0.02)));
    for (int k = 0; k < 4000 && e.grains.grain_count() < 4; ++k) e.step();
    e.take_events();
    REQUIRE(e.grains.grain_count() >= 4);
    scene<scattered> state = e.state();
    rooms::surgery<scene<scattered>> room(state);
    bool other = false;
    for (std::size_t g = 0; g < state.grains.grain_count(); ++g) {
        const grain& one = state.grains.grains[g];
        CHECK((one.origin == 0 || one.origin == 1));
        CHECK(room.strength_factor(static_cast<std::int32_t>(g)) == s.breakage.strength_factor(one.origin));
        other = other || one.id > 1;
    }
    CHECK(other);
}

TEST_CASE("threads and checkpoints in the middle of a burst make no difference") {
    const auto crush = [](int threads, bool stored) {
        auto s = scenes::settings<policies>(1e15, 0.1);
        s.run = execution(threads);
        s.contacts_per_thread = 8;
        auto e = scenes::packed<policies>(s, shapes::apollonian_14(circumscribed(0.02)), 12, 0.04, 2e5, 2500);
        engine<policies> fresh = e;
        const auto press = [](engine<policies>& one) {
            one.breakage_on = true;
            one.drives.platens = {.how = boundaries::drive::mode::velocity, .value = 0.1};
        };
        press(e), press(fresh);
        const auto in_burst = [&] {
            for (const grain& g : e.grains.grains)
                if (g.cluster >= 0 && e.breakage().pools[static_cast<std::size_t>(g.shape)].intact_bonds(
                                          static_cast<std::size_t>(g.cluster)) > 0)
                    return true;
            return false;
        };
        while (!(e.grains.grain_count() > 12 && in_burst())) e.step();
        e.take_events();
        if (stored) {
            from_bytes(to_bytes(e), fresh);
            std::swap(e, fresh);
        }
        e.step(600);
        e.take_events();
        return e;
    };
    const auto digest_of = [](auto e) { return measure::digest_of_state(e); };
    const engine<policies> one = crush(1, false);
    CHECK(one.grains.grain_count() > 16);
    CHECK(one.totals().broken_tension + one.totals().broken_shear > 20);
    CHECK(digest_of(one) == digest_of(crush(3, false)));
    CHECK(digest_of(one) == digest_of(crush(2, true)));
    CHECK(to_bytes(one) == to_bytes(crush(3, true)));
}

TEST_CASE("soft bonds are refused with numbers") {
    auto s = scenes::settings<policies>(1e15);
    CHECK_NOTHROW(scenes::collision(s));
    s.replacement.bond.normal_stiffness = 19.0 * s.grain_contact.kn;
    std::string said;
    try {
        scenes::collision(s);
    } catch (const input_error& e) {
        said = e.what();
    }
    CHECK(said.find("19 times as stiff") != std::string::npos);
    CHECK(said.find("at least 20 times") != std::string::npos);
    s.replacement.bond = {}; // a modulus of 9.6e8 Pa is a bond as soft as a contact
    s.replacement.bond.reading = bonds::stiffness_reading::modulus;
    CHECK_THROWS_AS(scenes::collision(s), input_error);
}
