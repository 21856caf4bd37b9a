// SPDX-License-Identifier: MIT
#include <clast/bodies/clump_strip.hpp>

#include <cmath>
#include <cstring>
#include <vector>

#include <clast/core/random.hpp>
#include <clast/integrators/leapfrog.hpp>

#include <catch.hpp>

using namespace clast;

namespace {

struct clump {
    vec3 force, moment, x, v, w, l, inverse, centre;
    quaternion q, then;
    double inverse_mass = 0.0, reach = 0.0;
};

/// Clumps with three, two or no different moments of inertia; every third one spins fast.
std::vector<clump> scene(std::size_t n) {
    random_stream random{11, 3};
    const auto any = [&](double size) { return uniform(random, 0.0, size) * direction(random); };
    std::vector<clump> out(n);
    for (std::size_t k = 0; k < n; ++k) {
        clump& c = out[k];
        const vec3 inertia{1e-6, k % 4 == 0 ? 1e-6 : 1.4e-6, k % 4 < 2 ? 1e-6 : 0.7e-6};
        c.inverse = {1.0 / inertia.x, 1.0 / inertia.y, 1.0 / inertia.z};
        c.inverse_mass = 1.0 / uniform(random, 0.01, 0.1);
        c.force = any(50.0), c.moment = any(0.1), c.x = any(1.0), c.v = k % 5 == 0 ? vec3{} : any(0.3);
        c.q = orientation(random);
        c.l = (k % 3 == 0 ? 1e-6 * 3000.0 : 1e-6 * 1.0) * direction(random);
        c.w = spin_of(c.q, c.l, c.inverse);
        c.centre = c.x + any(1e-4), c.then = unit(c.q * rotation(any(1e-3)));
        c.reach = 0.01;
    }
    return out;
}

clump_strip strip_of(const std::vector<clump>& all, std::size_t begin, std::size_t end) {
    clump_strip s{};
    s.size = end - begin;
    for (std::size_t k = 0; k < s.size; ++k) {
        const clump& c = all[begin + k];
        s.fx[k] = c.force.x, s.fy[k] = c.force.y, s.fz[k] = c.force.z;
        s.mx[k] = c.moment.x, s.my[k] = c.moment.y, s.mz[k] = c.moment.z;
        s.x[k] = c.x.x, s.y[k] = c.x.y, s.z[k] = c.x.z;
        s.vx[k] = c.v.x, s.vy[k] = c.v.y, s.vz[k] = c.v.z;
        s.wx[k] = c.w.x, s.wy[k] = c.w.y, s.wz[k] = c.w.z;
        s.lx[k] = c.l.x, s.ly[k] = c.l.y, s.lz[k] = c.l.z;
        s.qw[k] = c.q.w, s.qx[k] = c.q.x, s.qy[k] = c.q.y, s.qz[k] = c.q.z;
        s.inverse_mass[k] = c.inverse_mass;
        s.ix[k] = c.inverse.x, s.iy[k] = c.inverse.y, s.iz[k] = c.inverse.z;
        s.cx[k] = c.centre.x, s.cy[k] = c.centre.y, s.cz[k] = c.centre.z;
        s.tw[k] = c.then.w, s.tx[k] = c.then.x, s.ty[k] = c.then.y, s.tz[k] = c.then.z;
        s.reach[k] = c.reach;
    }
    return s;
}

} // namespace

TEST_CASE("clumps side by side move as one alone: kick, damping, free rotation, slow or fast") {
    const std::vector<clump> all = scene(16);
    const double h = 1e-5;
    for (const double damping : {0.0, 0.7}) {
        clump_strip s = strip_of(all, 0, all.size());
        advance(s, integrators::rule<integrators::leapfrog>{{damping}, {}, h, h});
        int fast = 0;
        for (std::size_t k = 0; k < all.size(); ++k) {
            const clump& c = all[k];
            const vec3 df = damping_force(c.force, c.v, damping), dm = damping_moment(c.q, c.moment, c.w, damping);
            const vec3 v = c.v + (h * c.inverse_mass) * (c.force + df), l = c.l + h * (c.moment + dm);
            const turned t = advance_rotation(c.q, l, c.inverse, h);
            const double lost = -0.5 * h * (dot(df, c.v + v) + dot(dm, c.w + spin_of(c.q, l, c.inverse)));
            CHECK(norm(vec3{s.vx[k], s.vy[k], s.vz[k]} - v) <= 1e-14 * norm(v));
            CHECK(norm(vec3{s.x[k], s.y[k], s.z[k]} - (c.x + h * v)) <= 1e-15);
            CHECK(norm(vec3{s.lx[k], s.ly[k], s.lz[k]} - l) <= 1e-14 * norm(l));
            CHECK(norm(vec3{s.wx[k], s.wy[k], s.wz[k]} - t.spin) <= 1e-10 * norm(t.spin));
            CHECK(std::abs(s.nw[k] - t.q.w) + std::abs(s.nx[k] - t.q.x) + std::abs(s.ny[k] - t.q.y) +
                      std::abs(s.nz[k] - t.q.z) <
                  4e-15);
            CHECK(std::abs(s.damped[k] - lost) <= 1e-12 * std::abs(lost));
            CHECK((damping == 0.0 ? s.damped[k] == 0.0 : s.damped[k] > 0.0));
            const mat3 m = matrix(t.q);
            CHECK(norm(vec3{s.r00[k], s.r01[k], s.r02[k]} - m.row[0]) < 1e-14);
            CHECK(norm(vec3{s.r20[k], s.r21[k], s.r22[k]} - m.row[2]) < 1e-14);
            // no point on the circumscribed sphere has moved further than it says, and one has nearly
            double farthest = 0.0;
            for (int a = 0; a < 400; ++a) {
                const double z = -1.0 + (a + 0.5) / 200.0, phi = 2.4 * a, r = std::sqrt(1.0 - z * z);
                const vec3 point = c.reach * vec3{r * std::cos(phi), r * std::sin(phi), z};
                farthest =
                    std::max(farthest, norm(c.x + h * v + rotate(t.q, point) - c.centre - rotate(c.then, point)));
            }
            CHECK(farthest <= s.moved[k] * (1.0 + 1e-12));
            CHECK(farthest > 0.6 * s.moved[k]);
            fast += s.angle2[k] >= small_step2;
        }
        CHECK(fast == 6);
    }
}

TEST_CASE("how clumps are grouped does not change a bit") {
    const std::vector<clump> all = scene(16);
    clump_strip whole = strip_of(all, 0, 16);
    advance(whole, integrators::rule<integrators::leapfrog>{{0.7}, {}, 1e-5, 1e-5});
    for (std::size_t begin = 0, n = 1; begin < 16; begin += n, n = n + 2) {
        const std::size_t end = std::min<std::size_t>(16, begin + n);
        clump_strip part = strip_of(all, begin, end);
        advance(part, integrators::rule<integrators::leapfrog>{{0.7}, {}, 1e-5, 1e-5});
        for (std::size_t k = begin; k < end; ++k) {
            const auto same = [&](const clump_strip::row& a, const clump_strip::row& b) {
                return std::memcmp(&a[k], &b[k - begin], sizeof(double)) == 0;
            };
            CHECK(same(whole.x, part.x));
            CHECK(same(whole.vy, part.vy));
            CHECK(same(whole.lz, part.lz));
            CHECK(same(whole.nw, part.nw));
            CHECK(same(whole.nz, part.nz));
            CHECK(same(whole.wx, part.wx));
            CHECK(same(whole.damped, part.damped));
            CHECK(same(whole.moved, part.moved));
        }
    }
}
