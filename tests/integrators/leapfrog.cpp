// SPDX-License-Identifier: MIT
#include <clast/integrators/leapfrog.hpp>

#include <cmath>

#include <clast/core/packs.hpp>

#include <catch.hpp>

static_assert(clast::integrators::multirate<clast::integrators::leapfrog>);

using namespace clast;
using integrators::leapfrog;

TEST_CASE("leapfrog of an oscillator keeps its discrete energy, and its period is that of theory") {
    // x'' = -x with h: cos(omega h) = 1 - h^2/2
    const double h = 0.1;
    const leapfrog free{0.0};
    double x = 1.0, v = 0.5 * h; // v at -h/2 of x = cos t
    const double omega = std::acos(1.0 - 0.5 * h * h) / h;
    for (int n = 1; n <= 1000; ++n) {
        v = free.kick(v, -x, h);
        x += h * v;
        CHECK(x == Approx(std::cos(omega * h * n)).margin(1e-9));
    }
    CHECK(!free.damps());
}

TEST_CASE("its damping is local damping, of vectors and of records of four numbers") {
    const leapfrog damped{0.7};
    const vec3 force{1.0, -2.0, 3.0}, v{-0.1, 0.0, 0.2};
    CHECK(norm(damped.extra(force, v) - vec3{0.7, 0.0, -2.1}) < 1e-15);
    const quad<2> f(1.0, -2.0, 3.0, 9.0), u(-0.1, 0.0, 0.2, 9.0), d = damped.extra(f, u);
    for (int a = 0; a < 3; ++a) CHECK(d[static_cast<std::size_t>(a)] == damped.extra(force, v)[a]);
    CHECK(damped.damps());
}
