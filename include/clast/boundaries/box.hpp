// SPDX-License-Identifier: MIT
// A rigid box of six planes: the cubical cell of true triaxial tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/boundaries/vessel_settings.hpp>
#include <clast/control/servo.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::boundaries {

/// Size and stiffness of a box along the axes (SI units).
struct box_settings {
    vec3 low;                             ///< lower corner (m)
    vec3 high;                            ///< upper corner (m), above `low`
    double wall_stiffness = 3.2e8;        ///< of the piece (N/m), as the platens of the paper's Table 1
    double contact_stiffness_floor = 0.0; ///< stiffness of one pebble-wall contact, least K of the servo (N/m), > 0
};

/// Six rigid planes. Facets: 0 bottom, 1 top (the platens of `drives`), 2 and 3 the walls normal to x at
/// its lower and upper end, 4 and 5 those normal to y. A facet's velocity is positive inward. Opposite walls move
/// alike, on the mean of their forces.
class box {
  public:
    /// Throws input_error for an empty box.
    explicit box(const box_settings& s) : set_(s), low_(s.low), high_(s.high) {
        for (int a = 0; a < 3; ++a)
            if (!(high_[a] > low_[a]))
                throw input_error("box", fmt::format("{} to {} m", low_[a], high_[a]), "low < high",
                                  "Give the corners in metres.");
        if (!(s.contact_stiffness_floor > 0.0))
            throw input_error("box_settings.contact_stiffness_floor", fmt::format("{}", s.contact_stiffness_floor),
                              "> 0 N/m", "Take the stiffness of one pebble-wall contact.");
    }

    /// The vessel of a test: a square prism whose half side is the radius, all six walls as stiff as platens. Has no
    /// rings, tiles, gaps or smallest pebble.
    static box made(const vessel_settings& s) {
        return box({{-s.radius, -s.radius, s.bottom},
                    {s.radius, s.radius, s.top},
                    s.platen_stiffness,
                    s.contact_stiffness_floor});
    }
    /// A box of these stiffnesses, at rest, where this one is now.
    box resized(const vessel_settings& s) const {
        return box({low_, high_, s.platen_stiffness, s.contact_stiffness_floor});
    }

    const vec3& low() const { return low_; }
    const vec3& high() const { return high_; }

    bool near(const vec3& x, double reach) const {
        for (int a = 0; a < 3; ++a)
            if (x[a] - low_[a] < reach || high_[a] - x[a] < reach) return true;
        return false;
    }
    touches touch(const vec3& x, double r, double ahead = 0.0) const {
        touches out;
        for (int a = 0; a < 3; ++a) {
            const double v = speed_[static_cast<std::size_t>(a)] * ahead;
            const double below = r - (x[a] - (low_[a] + v)), above = r - (high_[a] - v - x[a]);
            vec3 n;
            n[a] = 1.0;
            if (below > 0.0) out.add({lower(a), n, below, 1.0});
            if (above > 0.0) out.add({lower(a) + 1, -n, above, 1.0});
        }
        return out;
    }
    bool outside(const vec3& x, double r) const {
        for (int a = 0; a < 3; ++a)
            if (!(x[a] > low_[a] - r && x[a] < high_[a] + r)) return true;
        return false;
    }
    /// Whether a sphere has room inside, touching nothing.
    bool holds(const vec3& x, double r) const { return !near(x, r); }
    int facet_count() const { return 6; }
    double stiffness(int) const { return set_.wall_stiffness; }
    /// Each wall is a neighbour of its own: opposite ones together would crush a grain without a resultant.
    static std::int32_t part_of(std::int32_t facet) { return facet; }
    double velocity(int facet) const { return speed_[axis_of(facet)]; }
    double area(int facet) const {
        const auto a = static_cast<int>(axis_of(facet));
        const vec3 l = high_ - low_;
        return l[(a + 1) % 3] * l[(a + 2) % 3];
    }

    /// `d.platens` drives the walls normal to z, `d.lateral` those normal to x, `d.lateral_y` (`d.lateral` where there
    /// is none) those normal to y, each pair on its own load and area. A lateral velocity is that of each wall, inward;
    /// a volume is taken by all four lateral walls at one speed.
    void control(std::span<const facet_load> loads, const drives& d, double dt, std::span<const coupling> = {}) {
        check(d.platens, "drives.platens");
        check(d.lateral, "drives.lateral");
        if (d.lateral_y) check(*d.lateral_y, "drives.lateral_y");
        const std::array<const drive*, 3> of{&d.lateral, d.lateral_y ? &*d.lateral_y : &d.lateral, &d.platens};
        for (int a = 0; a < 3; ++a) {
            const drive& mine = *of[static_cast<std::size_t>(a)];
            const facet_load& one = loads[static_cast<std::size_t>(lower(a))];
            const facet_load& two = loads[static_cast<std::size_t>(lower(a) + 1)];
            double& v = speed_[static_cast<std::size_t>(a)];
            if (mine.how == drive::mode::servo)
                v = control::inward_velocity({mine.value * area(lower(a)), 0.5 * (one.force + two.force),
                                              0.5 * (one.stiffness + two.stiffness), set_.contact_stiffness_floor, dt,
                                              mine.gain, mine.max_speed});
            else
                v = mine.how == drive::mode::velocity ? mine.value
                    : mine.how == drive::mode::volume ? mine.value / (2.0 * (area(lower(0)) + area(lower(1))))
                                                      : 0.0;
        }
    }
    /// Throws run_error when two walls meet.
    void advance(double dt) {
        for (int a = 0; a < 3; ++a) {
            low_[a] += speed_[static_cast<std::size_t>(a)] * dt;
            high_[a] -= speed_[static_cast<std::size_t>(a)] * dt;
            if (!(high_[a] > low_[a]))
                throw run_error({"two walls of the box met", fmt::format("axis {}", a), "during the last step",
                                 "the load moves the walls faster than grains can resist, or no grain resists",
                                 "load more slowly or lower the speed limit of the servo"});
        }
    }
    double fastest() const { return std::max({std::abs(speed_[0]), std::abs(speed_[1]), std::abs(speed_[2])}); }
    double volume() const {
        const vec3 l = high_ - low_;
        return l.x * l.y * l.z;
    }
    double height() const { return high_.z - low_.z; }
    double bottom() const { return low_.z; }
    /// Half of the shorter horizontal side (m): radius of the widest upright cylinder that fits.
    double radius() const { return 0.5 * std::min(high_.x - low_.x, high_.y - low_.y); }
    double section() const { return area(bottom_platen); }
    /// Area of the specimen at a platen (m^2): the section, at both.
    double end_section(int /*platen*/) const { return section(); }
    double axial_stress(std::span<const facet_load> loads) const { return stress(loads, 2); }
    double lateral_stress(std::span<const facet_load> loads) const {
        return 0.5 * (stress(loads, 0) + stress(loads, 1));
    }
    /// Mean stress of the two walls normal to an axis (Pa, compression positive).
    double stress(std::span<const facet_load> loads, int a) const {
        const auto f = static_cast<std::size_t>(lower(a));
        return 0.5 * (loads[f].force + loads[f + 1].force) / area(lower(a));
    }
    double confining_error(std::span<const facet_load> loads, double sigma) const {
        return std::abs(lateral_stress(loads) - sigma) / sigma;
    }
    double confining_rms(std::span<const facet_load> loads, double sigma) const {
        const double x = stress(loads, 0) / sigma - 1.0, y = stress(loads, 1) / sigma - 1.0;
        return std::sqrt(0.5 * (x * x + y * y));
    }
    double power(std::span<const facet_load> loads) const {
        double sum = 0.0;
        for (int f = 0; f < 6; ++f) sum += loads[static_cast<std::size_t>(f)].force * velocity(f);
        return sum;
    }
    std::vector<facet_view> view(std::span<const facet_load> loads) const {
        std::vector<facet_view> out;
        for (int f = 0; f < 6; ++f) {
            const auto a = static_cast<int>(axis_of(f));
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            vec3 corner = low_;
            corner[a] = f % 2 == 0 ? low_[a] : high_[a];
            std::array<vec3, 4> p{corner, corner, corner, corner};
            p[1][b] = p[2][b] = high_[b];
            p[2][c] = p[3][c] = high_[c];
            out.push_back(
                {p, loads[static_cast<std::size_t>(f)].force / area(f), area(f), f < 2 ? -1 : 0, f < 2 ? -1 : f - 2});
        }
        return out;
    }

    template <class A> void archive(A& a) { a(set_, low_, high_, speed_); }

  private:
    /// Facet at the lower end of axis a.
    static constexpr std::int32_t lower(int a) { return a == 2 ? bottom_platen : first_lateral_facet + 2 * a; }
    static constexpr std::size_t axis_of(int facet) {
        return facet < first_lateral_facet ? 2 : static_cast<std::size_t>((facet - first_lateral_facet) / 2);
    }

    box_settings set_;
    vec3 low_, high_;
    std::array<double, 3> speed_{}; ///< inward (m/s), per axis
};

} // namespace clast::boundaries
