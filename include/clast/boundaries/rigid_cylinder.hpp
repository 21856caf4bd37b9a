// SPDX-License-Identifier: MIT
// The smooth rigid cylinder that flexible membranes are compared with (paper section 2.2): one curved wall, two
// platens.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/platens.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/boundaries/vessel_settings.hpp>
#include <clast/control/servo.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::boundaries {

/// Size and stiffness of a rigid cylinder around the z axis (SI units).
struct rigid_cylinder_settings {
    double radius = 0.0;                  ///< of the wall's inner side at the start (m), > largest_pebble
    double bottom = 0.0;                  ///< height of the bottom platen (m)
    double top = 0.0;                     ///< height of the top platen (m), at least largest_pebble above `bottom`
    double platen_stiffness = 3.2e8;      ///< of the piece (N/m), paper Table 1
    double wall_stiffness = 3.2e8;        ///< of the piece (N/m); Table 1 has none for it: that of the platens
    double largest_pebble = 0.0;          ///< largest radius of all pebbles (m), > 0: a sphere has to fit into the wall
    double contact_stiffness_floor = 0.0; ///< stiffness of one pebble-wall contact, least K of the servo (N/m), > 0
};

/// A circular cylinder that stays one and moves radially as a whole, with two platens that move alike. Facets: 0 bottom
/// platen, 1 top platen, 2 the wall. A facet's velocity is positive inward (dR/dt = -V); along the axis the wall
/// stands still, which only grains feel whose law has friction there.
///
/// A sphere of radius r whose centre is rho from the axis overlaps the wall by r - (R - rho), exactly, and is pushed
/// towards the axis. For r < R it touches one point of the wall only, and none with its centre on the axis; so a wall
/// narrower than the largest pebble is refused, at construction and in motion.
class rigid_cylinder {
  public:
    /// Throws input_error where a setting makes no sense.
    explicit rigid_cylinder(const rigid_cylinder_settings& settings)
        : set_(settings), platens_{settings.bottom, settings.top, {}}, radius_(settings.radius) {
        const auto demand = [](bool good, const char* name, double value, const char* allowed, const char* way_out) {
            if (!good)
                throw input_error(std::string("rigid_cylinder_settings.") + name, fmt::format("{}", value), allowed,
                                  way_out);
        };
        const char* const in_si = "Give the specimen in metres and newtons.";
        demand(set_.largest_pebble > 0.0, "largest_pebble", set_.largest_pebble, "> 0 m",
               "Take the radius of the largest pebble.");
        demand(set_.radius > set_.largest_pebble && std::isfinite(set_.radius), "radius", set_.radius,
               "above largest_pebble (m)", "A pebble has to fit into the wall: make it wider.");
        demand(std::isfinite(set_.bottom), "bottom", set_.bottom, "finite", in_si);
        demand(set_.top - set_.bottom >= set_.largest_pebble && std::isfinite(set_.top), "top", set_.top,
               "at least largest_pebble above bottom (m)", in_si);
        demand(set_.platen_stiffness > 0.0, "platen_stiffness", set_.platen_stiffness, "> 0 N/m", in_si);
        demand(set_.wall_stiffness > 0.0, "wall_stiffness", set_.wall_stiffness, "> 0 N/m", in_si);
        demand(set_.contact_stiffness_floor > 0.0, "contact_stiffness_floor", set_.contact_stiffness_floor, "> 0 N/m",
               "Take the stiffness of one pebble-wall contact.");
    }

    /// The vessel of a test: takes the sizes, the largest pebble and the stiffnesses; the wall's piece is as stiff as
    /// the platens'. Throws input_error where they make no sense.
    static rigid_cylinder made(const vessel_settings& s) {
        return rigid_cylinder({.radius = s.radius,
                               .bottom = s.bottom,
                               .top = s.top,
                               .platen_stiffness = s.platen_stiffness,
                               .wall_stiffness = s.platen_stiffness,
                               .largest_pebble = s.largest_radius,
                               .contact_stiffness_floor = s.contact_stiffness_floor});
    }
    /// One of these settings, at rest, where this one is now: its radius, bottom and top count.
    rigid_cylinder resized(vessel_settings s) const {
        s.radius = radius(), s.bottom = bottom(), s.top = top();
        return made(s);
    }

    static constexpr std::int32_t wall = first_lateral_facet;
    const rigid_cylinder_settings& settings() const { return set_; }
    int facet_count() const { return 3; }

    // --- contact ---------------------------------------------------------------------------------------------------
    /// Whether a facet is within `reach` (m) of x.
    bool near(const vec3& x, double reach) const {
        const double inner = radius_ - reach;
        return platens_.near(x.z, reach) || inner <= 0.0 || x.x * x.x + x.y * x.y >= inner * inner;
    }
    /// Contacts of a sphere with the facets as they will be `ahead` seconds later at their present velocities.
    touches touch(const vec3& x, double r, double ahead = 0.0) const {
        touches out;
        platens_.touch_sphere(x, r, ahead, out);
        const double inner = radius_ - wall_velocity_ * ahead - r; // where centres are free
        const double rho2 = x.x * x.x + x.y * x.y;
        if (inner >= 0.0 && rho2 <= inner * inner) return out; // most pebbles: no root
        const double rho = std::sqrt(rho2);
        if (rho - inner > 0.0 && rho > 0.0) out.add({wall, {-x.x / rho, -x.y / rho, 0.0}, rho - inner, 1.0});
        return out;
    }
    /// Whether a pebble is lost: its centre is beyond a facet by more than its radius, or is no number.
    bool outside(const vec3& x, double r) const {
        const double limit = radius_ + r;
        return !(x.z > bottom() - r && x.z < top() + r && x.x * x.x + x.y * x.y < limit * limit);
    }

    /// Whether a sphere has room inside, touching nothing.
    bool holds(const vec3& x, double r) const { return touch(x, r).size == 0 && !outside(x, r); }

    // --- facets ----------------------------------------------------------------------------------------------------
    /// Normal stiffness of the piece (N/m), before the series rule with the pebble.
    double stiffness(int facet) const { return facet == wall ? set_.wall_stiffness : set_.platen_stiffness; }
    /// Velocity of a facet along its inward normal (m/s).
    double velocity(int facet) const {
        return facet == wall ? wall_velocity_ : platens_.velocity[static_cast<std::size_t>(facet)];
    }
    /// Area of a facet (m^2). d volume / dt = - sum of area times velocity.
    double area(int facet) const {
        return facet == wall ? 2.0 * std::numbers::pi * radius_ * height() : std::numbers::pi * radius_ * radius_;
    }

    // --- motion ----------------------------------------------------------------------------------------------------
    /// Sets the velocities from the loads of the last step (one per facet). dt: time until the next call (s). The wall
    /// follows its mean stress, both platens the mean of their two forces. Throws input_error for a drive that makes no
    /// sense.
    void control(std::span<const facet_load> loads, const drives& d, double dt, std::span<const coupling> = {}) {
        check(d.platens, "drives.platens");
        check(d.lateral, "drives.lateral");
        if (d.lateral_y)
            throw input_error("drives.lateral_y", "a drive of its own", "none, at a wall around the axis",
                              "Take boundaries::box for three driven axes.");
        const auto speed = [&](const drive& mine, double area_of_one, double force, double stiffness_of_one) {
            if (mine.how == drive::mode::servo)
                return control::inward_velocity({mine.value * area_of_one, force, stiffness_of_one,
                                                 set_.contact_stiffness_floor, dt, mine.gain, mine.max_speed});
            return mine.how == drive::mode::velocity ? mine.value
                   : mine.how == drive::mode::volume ? mine.value / area_of_one
                                                     : 0.0;
        };
        const facet_load &low = loads[bottom_platen], &high = loads[top_platen], &around = loads[wall];
        const double closing =
            speed(d.platens, section(), 0.5 * (low.force + high.force), 0.5 * (low.stiffness + high.stiffness));
        platens_.velocity = {closing, closing};
        wall_velocity_ = speed(d.lateral, area(wall), around.force, around.stiffness);
    }
    /// Moves all facets by dt (s). Throws run_error where they leave no room for the largest pebble.
    void advance(double dt) {
        platens_.advance(dt);
        radius_ -= wall_velocity_ * dt;
        const auto stop = [this](std::string what, std::string where) {
            throw run_error({std::move(what), std::move(where),
                             fmt::format("specimen radius {:.6g} m, height {:.6g} m, pebbles of up to {:.6g} m radius",
                                         radius(), height(), set_.largest_pebble),
                             "the load moves the boundary faster than grains can resist, or no grain is left to resist",
                             "load more slowly or lower the speed limit of the servo"});
        };
        if (!(radius_ > set_.largest_pebble)) stop("The cylinder closed on its axis", "wall");
        if (!(height() >= set_.largest_pebble)) stop("The platens met", "platens");
    }

    // --- measures --------------------------------------------------------------------------------------------------
    double radius() const { return radius_; }                        ///< of the wall (m)
    double bottom() const { return platens_.bottom; }                ///< height of the bottom platen (m)
    double top() const { return platens_.top; }                      ///< height of the top platen (m)
    double height() const { return platens_.height(); }              ///< between platens (m)
    double section() const { return area(bottom_platen); }           ///< pi R^2 (m^2)
    double volume() const { return area(bottom_platen) * height(); } ///< enclosed (m^3)
    /// Largest facet speed (m/s).
    double fastest() const {
        return std::max({std::abs(platens_.velocity[0]), std::abs(platens_.velocity[1]), std::abs(wall_velocity_)});
    }
    /// Area of the specimen at a platen (m^2): the section, at both.
    double end_section(int /*platen*/) const { return section(); }
    /// Axial stress (Pa, compression positive): mean force of the two platens / section, as of a straight specimen.
    double axial_stress(std::span<const facet_load> loads) const {
        return 0.5 * (loads[bottom_platen].force + loads[top_platen].force) / section();
    }
    /// Mean stress of the wall: sum of its radial forces / area (Pa, compression positive).
    double lateral_stress(std::span<const facet_load> loads) const { return loads[wall].force / area(wall); }
    /// |F - sigma A| / (sigma A) of the wall for the target stress sigma (Pa, > 0).
    double confining_error(std::span<const facet_load> loads, double sigma) const {
        return std::abs(lateral_stress(loads) - sigma) / sigma;
    }
    /// Rate of work done on the specimen by all facets (W).
    double power(std::span<const facet_load> loads) const {
        double sum = 0.0;
        for (int f = 0; f < facet_count(); ++f) sum += loads[static_cast<std::size_t>(f)].force * velocity(f);
        return sum;
    }
    /// For pictures: the platens as squares around the wall, the wall as 36 strips that share its area and pressure.
    std::vector<facet_view> view(std::span<const facet_load> loads) const {
        std::vector<facet_view> out;
        const double side = 1.05 * radius_;
        for (int f = 0; f < first_lateral_facet; ++f) {
            const double z = f == bottom_platen ? bottom() : top();
            out.push_back({{{{-side, -side, z}, {side, -side, z}, {side, side, z}, {-side, side, z}}},
                           loads[static_cast<std::size_t>(f)].force / section(),
                           area(f),
                           -1,
                           -1});
        }
        constexpr int strips = 36;
        const auto at = [this](int i, double z) {
            const double angle = 2.0 * std::numbers::pi * i / strips;
            return vec3{radius_ * std::cos(angle), radius_ * std::sin(angle), z};
        };
        for (int i = 0; i < strips; ++i)
            out.push_back({{{at(i, bottom()), at(i + 1, bottom()), at(i + 1, top()), at(i, top())}},
                           lateral_stress(loads),
                           area(wall) / strips,
                           0,
                           i});
        return out;
    }

    /// Complete state, for checkpoints.
    template <class A> void archive(A& a) { a(set_, platens_, radius_, wall_velocity_); }

  private:
    rigid_cylinder_settings set_;
    platens platens_;
    double radius_;              ///< present one (m)
    double wall_velocity_ = 0.0; ///< inward (m/s)
};

} // namespace clast::boundaries
