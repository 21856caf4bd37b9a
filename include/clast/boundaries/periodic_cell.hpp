// SPDX-License-Identifier: MIT
// No wall at all: a box whose opposite faces are one, deformed at given rates or towards given stresses.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <clast/boundaries/drive.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::boundaries {

/// Periodic cell along the axes, centred on the origin. Grains are moved by their velocities only; an image moves with
/// the velocity of the edge that it lies beyond, and a grain that leaves through a face enters by the other with the
/// velocity of that image. Velocities are total ones: start a homogeneous flow with v = rate * x.
class periodic_cell {
  public:
    /// Along one axis: a rate of extension, or a servo to a stress.
    struct axis {
        double rate = 0.0; ///< d ln(edge) / dt (1/s), positive in extension; the servo writes it
        double target =
            std::numeric_limits<double>::quiet_NaN(); ///< stress (Pa, compression positive); NaN: the rate holds
        double max_rate = 1.0;                        ///< of the servo (1/s), > 0
        double gain = 0.1; ///< share of the stress error removed per look at the stress, in (0, 1)
    };
    static constexpr int look = 10; ///< steps between two looks at the stress

    std::array<axis, 3> axes;

    /// Edge lengths (m), > 0; they should exceed four times the largest grain.
    explicit periodic_cell(const vec3& edges) : edges_(edges) {
        for (int a = 0; a < 3; ++a)
            if (!(edges[a] > 0.0 && std::isfinite(edges[a])))
                throw input_error("periodic_cell edge", fmt::format("{} m", edges[a]), "> 0 m",
                                  "Give the cell in metres.");
    }

    const vec3& edges() const { return edges_; }                                                   ///< m
    vec3 edge_speeds() const { return scale({axes[0].rate, axes[1].rate, axes[2].rate}, edges_); } ///< m/s
    /// Stress at the last look (Pa, compression positive): at most `look` steps ago; without servos that of the last
    /// of many steps made at once.
    const vec3& stress() const { return stress_; }
    /// Whether an axis follows a stress.
    bool has_servo() const {
        return std::any_of(axes.begin(), axes.end(), [](const axis& a) { return !std::isnan(a.target); });
    }

    // --- what an engine asks of any boundary: there is no facet ------------------------------------------------------
    bool near(const vec3&, double) const { return false; }
    touches touch(const vec3&, double, double = 0.0) const { return {}; }
    bool outside(const vec3& x, double) const { return !is_finite(x); }
    int facet_count() const { return 0; }
    double stiffness(int) const { return 0.0; }
    double velocity(int) const { return 0.0; }
    double area(int) const { return 0.0; }
    void control(std::span<const facet_load>, const drives&, double, std::span<const coupling>) {}
    void advance(double dt) {
        for (int a = 0; a < 3; ++a) edges_[a] *= std::exp(axes[static_cast<std::size_t>(a)].rate * dt);
    }
    double fastest() const { return 0.0; }
    double volume() const { return edges_.x * edges_.y * edges_.z; }
    double height() const { return edges_.z; }
    double section() const { return edges_.x * edges_.y; }
    double axial_stress(std::span<const facet_load>) const { return stress_.z; }
    double lateral_stress(std::span<const facet_load>) const { return 0.5 * (stress_.x + stress_.y); }
    double confining_error(std::span<const facet_load>, double sigma) const {
        return std::abs(lateral_stress({}) - sigma) / sigma;
    }
    double confining_rms(std::span<const facet_load>, double sigma) const { return confining_error({}, sigma); }
    /// Rate of work done on the specimen (W), from the stress at the last look.
    double power(std::span<const facet_load>) const {
        return -volume() * (stress_.x * axes[0].rate + stress_.y * axes[1].rate + stress_.z * axes[2].rate);
    }
    std::vector<facet_view> view(std::span<const facet_load>) const { return {}; }

    /// Tells the stress (Pa) and the stiffness of the packing along each axis (Pa) after `look` steps of dt (s): servo
    /// axes choose their rates.
    void observe(const vec3& stress, const vec3& modulus, double dt) {
        stress_ = stress;
        for (int a = 0; a < 3; ++a) {
            axis& one = axes[static_cast<std::size_t>(a)];
            if (std::isnan(one.target)) continue;
            const double way = modulus[a] > 0.0 ? (stress[a] - one.target) / modulus[a]
                                                : (one.target > 0.0 ? -1.0 : 0.0); // nothing touches: close
            one.rate = std::clamp(one.gain * way / (look * dt), -one.max_rate, one.max_rate);
        }
    }

    template <class A> void archive(A& a) {
        a(edges_, stress_);
        for (axis& one : axes) a(one.rate, one.target, one.max_rate, one.gain);
    }

  private:
    vec3 edges_;
    vec3 stress_;
};

} // namespace clast::boundaries
