// SPDX-License-Identifier: MIT
#include <clast/contacts/rolling.hpp>

#include <cmath>

#include <clast/contacts/linear_dashpot.hpp>
#include <clast/core/vector.hpp>

#include <catch.hpp>

static_assert(clast::contacts::contact_law<clast::contacts::rolling<clast::contacts::linear>>);

using namespace clast;
using contacts::motion;
using contacts::overlap;
using law_type = contacts::rolling<contacts::linear>;

namespace {
const law_type law{{1e6, 5e5, 0.3}, 20.0, 0.1, 10.0, 0.05};
constexpr double depth = 1e-5;                                                                  // m
const overlap<double> o{0, 0, 1, depth, 1.0 / 0.01, 1.0 / 0.03};                                // R = 7.5 mm
constexpr double limit = 0.1 * 7.5e-3 * 1e6 * depth, twist_limit = 0.05 * 7.5e-3 * 1e6 * depth; // N m

motion<double> turned(const vec3& r) {
    motion<double> m{};
    m.mz = 1.0, m.reflect = 0.0; // the normal has not turned
    m.rx = r.x, m.ry = r.y, m.rz = r.z;
    return m;
}
} // namespace

TEST_CASE("rolling is resisted by a spring against the relative rotation, then by a slider, and twisting by its own") {
    law_type::history h{};
    const auto first = law(o, turned({1e-6, -2e-6, 3e-6}), h, 1e-5);
    CHECK(first.mx == Approx(-20.0 * 1e-6));
    CHECK(first.my == Approx(20.0 * 2e-6));
    CHECK(first.mz == Approx(-10.0 * 3e-6));
    CHECK(first.fz == Approx(-1e6 * depth)); // the force is that of the other law
    CHECK(first.dissipated == Approx(0.0).margin(1e-18));
    for (int k = 0; k < 10000; ++k) (void)law(o, turned({1e-6, 0, 1e-6}), h, 1e-5);
    const auto slid = law(o, turned({1e-6, 0, 1e-6}), h, 1e-5);
    CHECK(std::hypot(slid.mx, slid.my) == Approx(limit).epsilon(1e-12));
    CHECK(slid.mz == Approx(-twist_limit).epsilon(1e-12));
    CHECK(slid.dissipated == Approx((limit + twist_limit) * 1e-6).epsilon(1e-3));
}

TEST_CASE("work of the moments is what is stored and what is lost") {
    law_type::history h{};
    double work = 0.0, lost = 0.0;
    vec3 before;
    for (int k = 0; k < 4000; ++k) {
        const vec3 r{2e-5 * std::cos(0.01 * k), 1e-6 * std::sin(0.02 * k), 1e-6 * std::cos(0.015 * k)};
        const auto a = law(o, turned(r), h, 1e-5);
        const vec3 m{a.mx, a.my, a.mz};
        work -= dot(0.5 * (before + m), r);
        before = m;
        lost += a.dissipated;
    }
    const double springs = law.stored(o, h) - 0.5 * 1e6 * depth * depth;
    CHECK(lost > 0.0);
    CHECK(work == Approx(lost + springs).epsilon(1e-10));
}

TEST_CASE("what is not pressed does not resist rolling") {
    law_type::history h{};
    (void)law(o, turned({1e-5, 0, 1e-5}), h, 1e-5);
    const auto open = law({0, 0, 1, -1e-6, 100.0, 100.0}, turned({1e-5, 0, 1e-5}), h, 1e-5);
    CHECK((open.mx == 0.0 && open.mz == 0.0));
    CHECK((h.roll.x == 0.0 && h.twist == 0.0));
}

TEST_CASE("it goes on top of any law, and says what the time step must know") {
    static_assert(contacts::contact_law<contacts::rolling<contacts::linear_dashpot>>);
    static_assert(contacts::contact_law<contacts::rolling<law_type>>); // a stack
    static_assert(contacts::resists_rotation<law_type> && !contacts::resists_rotation<contacts::linear>);
    static_assert(contacts::frictional<law_type>);
    static_assert(!contacts::reads_masses<law_type>() &&
                  contacts::reads_masses<contacts::rolling<contacts::linear_dashpot>>());
    CHECK(law.rolling_stiffness(o) == 20.0);
}
