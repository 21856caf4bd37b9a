// SPDX-License-Identifier: MIT
// A curved surface of one's own: a ball slides to and fro in a spherical bowl, a pendulum as long as R - r.
#include <cmath>
#include <numbers>

#include <clast/clast.hpp>
#include <fmt/core.h>
namespace walls = clast::boundaries;
struct bowl { // around the origin, at rest: all that a surface is asked for
    double radius;

    bool near(const clast::vec3& x, double reach) const { return norm(x) + reach >= radius; }
    walls::touches touch(const clast::vec3& x, double r, double = 0.0) const {
        walls::touches out;
        const double way = norm(x), depth = way + r - radius; // exact while r < R; facets 0 and 1 would be platens
        if (depth > 0.0) out.add({walls::first_lateral_facet, -1.0 / way * x, depth, 1.0});
        return out;
    }
    static int facet_count() { return 3; }
    static double velocity(int) { return 0.0; }
    void control(std::span<const walls::facet_load>, const walls::drives&, double, std::span<const walls::coupling>) {}
    void advance(double) {}
    static double fastest() { return 0.0; }
    static double power(std::span<const walls::facet_load>) { return 0.0; }
    template <class A> void archive(A& a) { a(radius); }
};
struct heavy : clast::integrators::leapfrog { // a force beside the load: the weight (N), one for equal balls
    clast::vec3 weight;
    static constexpr bool damps() { return true; }
    clast::vec3 extra(const clast::vec3&, const clast::vec3&) const { return weight; }
};
struct my_policies : clast::triaxial_policies_default {
    using body = clast::bodies::spheres;
    using boundary = bowl;
    using scheme = heavy;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};
int main() {
    const double R = 0.11, r = 0.01, g = 9.81, angle = 0.5, k = 1e6; // m, m/s^2, rad, N/m
    clast::bodies::spheres ball;
    const double weight = ball.density * clast::sphere_volume(r) * g;
    const double length = R - r + weight * std::cos(angle) / k; // pressed in as at rest, or it would rattle
    ball.add({length * std::sin(angle), 0, -length * std::cos(angle)}, r);
    const clast::contacts::linear law{k, 0.0, 0.0};
    clast::engine<my_policies> e({law, law, law, {}, {}, heavy{{}, {0, 0, -weight}}, 0.05}, ball, bowl{R});
    double first = 0.0, last = 0.0, force = 0.0;
    for (int passes = 0; passes < 5;) { // five times the lowest point: two periods
        const double before = e.grains.pebbles[0].x.x;
        e.step();
        const double now = e.grains.pebbles[0].x.x;
        if (now * before >= 0.0) continue;
        force = e.loads()[2].force, last = e.time() - e.dt() * now / (now - before);
        if (passes++ == 0) first = last;
    } // closed forms: T = 2 pi sqrt(L/g) / agm(1, cos(angle/2)); at the lowest point N = m g (3 - 2 cos(angle))
    const double c = std::cos(0.5 * angle), agm = 0.25 * (1.0 + c) + 0.5 * std::sqrt(c), period = 0.5 * (last - first);
    const double T = 2.0 * std::numbers::pi * std::sqrt(length / g) / agm, N = weight * (3.0 - 2.0 * std::cos(angle));
    fmt::print("period {:.6f} s, by hand {:.6f} s; force {:.6f} N, by hand {:.6f} N\n", period, T, force, N);
    return std::abs(period / T - 1.0) < 1e-5 && std::abs(force / N - 1.0) < 1e-4 ? 0 : 1;
}
