// SPDX-License-Identifier: MIT
// A box whose opposite faces are one, deformed at given rates or towards given stresses.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <clast/contacts/concepts.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/packs.hpp>
#include <clast/core/vector.hpp>
#include <clast/integrators/concepts.hpp>
#include <clast/spaces/concepts.hpp>
#include <clast/spaces/crossings.hpp>
#include <clast/spaces/images.hpp>

namespace clast::spaces {

/// The affine flow of a cell: v = rates x.
struct mean_flow {
    vec3 rates; ///< 1/s

    /// Velocity of a step of h (s) beside the flow where it led through; x: where it ended.
    [[gnu::always_inline]] vec3 relative(const vec3& v, const vec3& x, double h) const {
        return v - scale(rates, x - (0.5 * h) * v);
    }
    template <std::size_t N>
    [[gnu::always_inline]] quad<N> relative(const quad<N>& v, const quad<N>& x, double h) const {
        return v - quad<N>(rates.x, rates.y, rates.z, 0.0) * (x - (0.5 * h) * v);
    }
};

/// Periodic cell along the axes, centred on the origin. Grains are moved by their velocities only; an image moves with
/// the velocity of the edge that it lies beyond, and a grain that leaves through a face enters by the other with the
/// velocity of that image. Velocities are total ones: start a homogeneous flow with v = rate * x. Damping sees them
/// beside that flow.
class periodic {
  public:
    /// Along one axis: a rate of extension, or a servo to a stress.
    struct axis {
        double rate = 0.0; ///< d ln(edge) / dt (1/s), positive in extension; the servo writes it
        double target =
            std::numeric_limits<double>::quiet_NaN(); ///< stress (Pa, compression positive); NaN: the rate holds
        double max_rate = 0.0;                        ///< of the servo (1/s), > 0; 0: step_strain in every step
        double gain = 0.1; ///< share of the stress error removed per look at the stress, in (0, 1)
    };
    static constexpr bool has_images = true;
    static constexpr int look = 10; ///< steps between two looks at the stress
    /// Strain of a step at the largest rate of a servo that has none of its own. A step is a share of the time that a
    /// wave takes through a grain, so the inertial number is about 3e-5 of the root of k_n / (p d): at most some 1e-3.
    static constexpr double step_strain = 1e-5;
    using crossings = spaces::crossings;
    using flow_type = mean_flow;
    /// What displacements count from.
    struct frame {
        vec3 edges; ///< m
        template <class A> void archive(A& a) { a(edges); }
    };

    std::array<axis, 3> axes;

    /// Edge lengths (m), > 0; they should exceed four times the largest grain.
    explicit periodic(const vec3& edges) : edges_(edges) {
        for (int a = 0; a < 3; ++a)
            if (!(edges[a] > 0.0 && std::isfinite(edges[a])))
                throw input_error("periodic cell, edge", fmt::format("{} m", edges[a]), "> 0 m",
                                  "Give the cell in metres.");
    }

    const vec3& edges() const { return edges_; }                                                   ///< m
    vec3 edge_speeds() const { return scale({axes[0].rate, axes[1].rate, axes[2].rate}, edges_); } ///< m/s
    double volume() const { return edges_.x * edges_.y * edges_.z; }                               ///< m^3
    /// Stress at the last look (Pa, compression positive): at most `look` steps ago; without servos that of the last
    /// of many steps made at once.
    const vec3& stress() const { return stress_; }
    /// Whether an axis follows a stress.
    bool has_servo() const {
        return std::any_of(axes.begin(), axes.end(), [](const axis& a) { return !std::isnan(a.target); });
    }

    // ---- what an engine asks (concepts.hpp) -------------------------------------------------------------------------
    frame here() const { return {edges_}; }
    vec3 stretch_since(const frame& then) const {
        return {edges_.x / then.edges.x, edges_.y / then.edges.y, edges_.z / then.edges.z};
    }
    vec3 rates() const {
        const vec3 speeds = edge_speeds();
        return {speeds.x / edges_.x, speeds.y / edges_.y, speeds.z / edges_.z};
    }
    flow_type flow() const { return {rates()}; }
    /// Those farther apart than `reach` come nearer by more, but not by all that they are farther apart.
    static double travel(const vec3& strain, double reach) {
        return std::max({std::abs(strain.x), std::abs(strain.y), std::abs(strain.z)}) * reach;
    }
    double room(double widest) const { return 0.49 * std::min({edges_.x, edges_.y, edges_.z}) - widest; }
    vec3 across(const vec3& x, std::uint8_t image) const {
        return image == no_shift ? x : x + image_shift(image, edges_);
    }
    void advance(double dt) {
        for (int a = 0; a < 3; ++a) edges_[a] *= std::exp(axes[static_cast<std::size_t>(a)].rate * dt);
    }
    /// Before a search: puts every body that has left the cell back into it, and adds images of those near faces.
    /// Throws run_error where a grain would touch two images of another.
    template <class Scene> void gather(Scene& s, search_spheres& spheres) const {
        bring_back(s, spheres);
        const double reach = s.near.widest + s.near.widths.margin() + contacts::reach_of(s.settings.grain_contact);
        if (!(std::min({edges_.x, edges_.y, edges_.z}) > 2.0 * reach))
            throw run_error({"the periodic cell is too small for its grains",
                             fmt::format("edges {:.4g} x {:.4g} x {:.4g} m", edges_.x, edges_.y, edges_.z),
                             fmt::format("step {}", s.totals.steps), "a grain would touch two images of another",
                             "take a cell of at least four grain diameters"});
        spheres.add_images(edges_, reach);
    }
    /// Whether the stress is looked at in a step. keep_rows: somebody else looks after it; last_of_many: what is looked
    /// at now and then only was left out before.
    bool looks(std::int64_t step, bool keep_rows, bool last_of_many) const {
        return step % look == 0 ? keep_rows || has_servo() : last_of_many && !has_servo();
    }
    template <class Scene> void begin_sweep(Scene& s) const { s.crossings.set(edges_, edge_speeds()); }
    /// Books the work of the images, and looks at the stress of the contacts just evaluated.
    template <class Scene> void end_sweep(Scene& s, bool looks_now) {
        s.totals.boundary_work += s.crossings.power(s.settings.run) * s.dt;
        if (looks_now) observe_contacts(s);
    }

    /// Tells the stress (Pa) and the stiffness of the packing along each axis (Pa) after `look` steps of dt (s): servo
    /// axes choose their rates.
    void observe(const vec3& stress, const vec3& modulus, double dt) {
        stress_ = stress;
        for (int a = 0; a < 3; ++a) {
            axis& one = axes[static_cast<std::size_t>(a)];
            if (std::isnan(one.target)) continue;
            const double way = modulus[a] > 0.0 ? (stress[a] - one.target) / modulus[a]
                                                : (one.target > 0.0 ? -1.0 : 0.0); // nothing touches: close
            const double most = one.max_rate > 0.0 ? one.max_rate : step_strain / dt;
            one.rate = std::clamp(one.gain * way / (look * dt), -most, most);
        }
    }

    template <class A> void archive(A& a) {
        a(edges_, stress_);
        for (axis& one : axes) a(one.rate, one.target, one.max_rate, one.gain);
    }

  private:
    template <class Scene> void bring_back(Scene& s, search_spheres& spheres) const {
        for (searches::sphere& one : spheres.all) {
            vec3 steps;
            for (int a = 0; a < 3; ++a) steps[a] = -std::floor(one.centre[a] / edges_[a] + 0.5);
            if (steps == vec3{}) continue;
            const auto body = static_cast<std::size_t>(one.id);
            // to be moved by a moving face, or to another place in a field, changes a grain's energy
            const auto energy = [&] { return s.grains.kinetic_energy(body) + s.potential_energy(body); };
            const double before = energy();
            s.grains.shift(body, scale(steps, edges_), scale(steps, edge_speeds()));
            s.totals.boundary_work += energy() - before;
            s.grains.place(body);
            one.centre = s.grains.centre(body);
        }
    }
    /// Stress of the contacts just evaluated, and the stiffness of the packing for uniform strain along each axis.
    template <class Scene> void observe_contacts(const Scene& s) {
        vec3 stress, modulus;
        s.each_heavy([&](std::size_t k) {
            const auto& row = s.heavy.rows[k];
            if (row.depth == 0.0) return;
            const auto& p = s.heavy.pairs[k];
            const vec3 branch = s.branch_of(row, p);
            const double kn = s.settings.grain_contact.normal_stiffness(s.overlap_of(p, row.depth));
            for (int a = 0; a < 3; ++a) {
                stress[a] -= row.force[a] * branch[a];
                modulus[a] += kn * branch[a] * branch[a] * row.normal[a] * row.normal[a];
            }
        });
        observe(stress / volume(), modulus / volume(), s.dt);
    }

    vec3 edges_;
    vec3 stress_;
};

} // namespace clast::spaces
