// SPDX-License-Identifier: MIT
// The bonds of a whole shape as one linear system: stiffness matrix, highest frequency, static solution.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <clast/bonds/likeness.hpp>
#include <clast/bonds/parallel.hpp>
#include <clast/core/symmetric.hpp>
#include <clast/grains/shape.hpp>

namespace clast::bonds {

/// Force and moment on one pebble about its centre.
struct pebble_load {
    vec3 force;  ///< N
    vec3 moment; ///< N m
};

/// Distances from the centres of two bonded balls to the point where the bond acts (m).
struct bond_arms {
    double a; ///< from the ball at end a
    double b;
};

/// A shape held together by parallel bonds, in its body frame, at scale 1. Made once per shape and material; grains of
/// every size share it.
struct lattice {
    std::vector<constants> bond;   ///< per bond of the shape
    std::vector<shape_bond> ends;  ///< pebble indices
    std::vector<vec3> normal;      ///< from a to b, body frame
    std::vector<bond_arms> arm;    ///< radius plus half of the gap that a shape may leave: they add up to the distance,
                                   ///< or a bond would turn its grain
    std::vector<double> radius;    ///< per pebble (m)
    std::vector<double> mass;      ///< per pebble (kg)
    std::vector<double> inertia;   ///< per pebble, 2/5 m r^2 (kg m^2)
    std::vector<vec3> offset;      ///< per pebble, body frame (m)
    std::vector<double> per_force; ///< per pebble: at most so much does a force on it load any bond (load_ratio per N)
    std::vector<double> per_moment; ///< the same of a moment (per N m)
    square_matrix pseudo_inverse;   ///< of the 6n x 6n bond stiffness (order: force and moment of pebble 0, 1, ...)
    double highest_frequency = 0.0; ///< largest eigenfrequency with all bonds intact (rad/s)
    int stiffness_power = 0;        ///< of the scale, by which stiffnesses of bonds grow (stiffness_reading)

    lattice() = default;
    /// density (kg/m^3) > 0. Throws input_error if bonds join some pebbles but leave others apart: no force could hold
    /// them.
    lattice(const shape& s, const parallel& material, double density) {
        const std::size_t n = s.pebbles.size();
        stiffness_power = bonds::stiffness_power(material.reading);
        for (const shape_pebble& p : s.pebbles) {
            offset.push_back(p.offset);
            radius.push_back(p.radius);
            mass.push_back(density * sphere_volume(p.radius));
            inertia.push_back(density * sphere_inertia_per_density(p.radius));
        }
        ends = s.bonds;
        if (const int parts = pieces(s); !ends.empty() && parts > 1)
            throw input_error(fmt::format("shape '{}'", s.name), fmt::format("{} pieces without a common bond", parts),
                              "one piece, or no bond at all", "Close the gaps between its pebbles.");
        for (const shape_bond& b : ends) {
            bond.push_back(constants_of(material, radius[at(b.a)], radius[at(b.b)]));
            const vec3 across = offset[at(b.b)] - offset[at(b.a)];
            const double half_gap = 0.5 * (norm(across) - radius[at(b.a)] - radius[at(b.b)]);
            normal.push_back(unit(across));
            arm.push_back({radius[at(b.a)] + half_gap, radius[at(b.b)] + half_gap});
        }
        pseudo_inverse = square_matrix(6 * n);
        per_force.assign(n, 0.0), per_moment.assign(n, 0.0);
        if (ends.empty()) return;
        std::vector<double> weight(6 * n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t a = 0; a < 3; ++a) {
                weight[6 * i + a] = 1.0 / std::sqrt(mass[i]);
                weight[6 * i + 3 + a] = 1.0 / std::sqrt(inertia[i]);
            }
        // scaled by the masses, so that forces and moments are of one unit, rigid motions stand out clearly
        square_matrix scaled = stiffness();
        for (std::size_t i = 0; i < 6 * n; ++i)
            for (std::size_t j = 0; j < 6 * n; ++j) scaled(i, j) *= weight[i] * weight[j];
        const principal_system modes = principal_values(std::move(scaled));
        const double largest = modes.values.back();
        highest_frequency = std::sqrt(largest);
        for (std::size_t k = 0; k < 6 * n; ++k) {
            if (modes.values[k] <= 1e-9 * largest) continue;
            for (std::size_t i = 0; i < 6 * n; ++i)
                for (std::size_t j = 0; j < 6 * n; ++j)
                    pseudo_inverse(i, j) +=
                        weight[i] * modes.axes(i, k) * modes.axes(j, k) * weight[j] / modes.values[k];
        }
        find_bounds();
    }

    std::size_t size() const { return offset.size(); }

    /// Load of a bond over the strength of its material (bonds::load_ratio), for a state of a grain of another size and
    /// density.
    double load_ratio(std::size_t e, const state& s, likeness to = {}) const {
        return to.scale * to.scale * to.density * bonds::load_ratio(bond[e], scaled(s, to.inverse()));
    }

    /// Bond stiffness matrix, built by the bond's own law from unit displacements.
    square_matrix stiffness() const {
        square_matrix k(6 * size());
        for (std::size_t e = 0; e < ends.size(); ++e) {
            const std::size_t side[2] = {at(ends[e].a), at(ends[e].b)};
            for (int moving = 0; moving < 2; ++moving)
                for (int axis = 0; axis < 6; ++axis) {
                    vec3 v[2], w[2];
                    (axis < 3 ? v : w)[moving][axis % 3] = 1.0;
                    state s;
                    stretch(bond[e], s, normal[e],
                            relative_velocity(normal[e], arm[e].a, arm[e].b, v[0], w[0], v[1], w[1]), w[1] - w[0], 1.0);
                    const wrench load = loads(s, normal[e], arm[e].a, arm[e].b);
                    const std::size_t column = 6 * side[moving] + static_cast<std::size_t>(axis);
                    for (int r = 0; r < 3; ++r) {
                        const std::size_t a = 6 * side[0] + static_cast<std::size_t>(r);
                        const std::size_t b = 6 * side[1] + static_cast<std::size_t>(r);
                        k(a, column) -= load.force_a[r];
                        k(a + 3, column) -= load.moment_a[r];
                        k(b, column) += load.force_a[r];
                        k(b + 3, column) -= load.moment_b[r];
                    }
                }
        }
        return k;
    }

    /// Upper bound of the load_ratio of any bond under such a load in statics(): found without solving for bonds, up to
    /// some twenty times too high.
    double load_bound(const std::vector<pebble_load>& load, const vec3& spin, likeness to = {}) const {
        double sum = 0.0;
        const double turning = to.scale * to.density * norm2(spin) * (to.scale * to.scale * to.scale);
        for (std::size_t i = 0; i < size(); ++i)
            sum += per_force[i] * (norm(load[i].force) + turning * mass[i] * norm(offset[i])) +
                   per_moment[i] / to.scale * norm(load[i].moment);
        return sum / (to.scale * to.scale);
    }

    /// Bond states (world axes) that hold the intact cluster in equilibrium under loads on its pebbles (world axes)
    /// while it moves as a rigid body: the loads less the d'Alembert forces of the rigid motion, K u = f solved with
    /// minimum norm. `spin` is the angular velocity (rad/s).
    std::vector<state> statics(std::vector<pebble_load> load, const quaternion& q, vec3 spin, likeness to = {}) const {
        // a cluster of the shape's own size under these moments is similar: all forces and masses' accelerations agree
        const double scale = to.scale;
        for (pebble_load& one : load) one.moment = (1.0 / scale) * one.moment;
        spin = (scale * scale * std::sqrt(to.density)) * spin;
        const std::size_t n = size();
        // rigid motion under the loads
        vec3 force, moment;
        double total = 0.0;
        mat3 tensor;
        std::vector<vec3> from_centre(n);
        for (std::size_t i = 0; i < n; ++i) {
            from_centre[i] = rotate(q, offset[i]);
            force += load[i].force;
            moment += load[i].moment + cross(from_centre[i], load[i].force);
            total += mass[i];
            tensor += (inertia[i] + mass[i] * norm2(from_centre[i])) * mat3::identity() +
                      (-mass[i]) * outer(from_centre[i], from_centre[i]);
        }
        const vec3 linear = force / total;
        const vec3 gyroscopic = cross(spin, tensor * spin);
        const vec3 angular = solve(tensor, moment - gyroscopic);
        std::vector<double> f(6 * n);
        for (std::size_t i = 0; i < n; ++i) {
            const vec3 acceleration =
                linear + cross(angular, from_centre[i]) + cross(spin, cross(spin, from_centre[i]));
            const vec3 rest = rotate_back(q, load[i].force - mass[i] * acceleration);
            const vec3 turn_rest = rotate_back(q, load[i].moment - inertia[i] * angular);
            for (std::size_t k = 0; k < 3; ++k) {
                f[6 * i + k] = rest[static_cast<int>(k)];
                f[6 * i + 3 + k] = turn_rest[static_cast<int>(k)];
            }
        }
        const std::vector<double> u = pseudo_inverse * f;
        std::vector<state> born(ends.size());
        const auto part = [&](std::size_t pebble, std::size_t first) {
            const double* at = u.data() + 6 * pebble + first;
            return vec3{at[0], at[1], at[2]};
        };
        for (std::size_t e = 0; e < ends.size(); ++e) {
            const std::size_t i = at(ends[e].a), j = at(ends[e].b);
            state s;
            stretch(bond[e], s, normal[e],
                    relative_velocity(normal[e], arm[e].a, arm[e].b, part(i, 0), part(i, 3), part(j, 0), part(j, 3)),
                    part(j, 3) - part(i, 3), 1.0);
            born[e] = {s.n, rotate(q, s.v), scale * s.mt, scale * rotate(q, s.mb)};
        }
        return born;
    }

  private:
    /// The load ratio of a sum of loads is at most the sum of theirs, because it is made of norms; of the three axes,
    /// by Cauchy and Schwarz, at most the length of the load times the root of the sum of their squares.
    void find_bounds() {
        for (std::size_t e = 0; e < ends.size(); ++e) {
            const std::size_t i = at(ends[e].a), j = at(ends[e].b);
            for (std::size_t p = 0; p < size(); ++p)
                for (const bool turns : {false, true}) {
                    double sum = 0.0;
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        const std::size_t column = 6 * p + axis + (turns ? 3 : 0);
                        const auto part = [&](std::size_t pebble, std::size_t first) {
                            const std::size_t row = 6 * pebble + first;
                            return vec3{pseudo_inverse(row, column), pseudo_inverse(row + 1, column),
                                        pseudo_inverse(row + 2, column)};
                        };
                        state s;
                        stretch(bond[e], s, normal[e],
                                relative_velocity(normal[e], arm[e].a, arm[e].b, part(i, 0), part(i, 3), part(j, 0),
                                                  part(j, 3)),
                                part(j, 3) - part(i, 3), 1.0);
                        state back = s; // a load of either sign
                        back.n = -s.n;
                        const double most = std::max(bonds::load_ratio(bond[e], s), bonds::load_ratio(bond[e], back));
                        sum += most * most;
                    }
                    double& bound = (turns ? per_moment : per_force)[p];
                    bound = std::max(bound, std::sqrt(sum));
                }
        }
    }
    static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
};

} // namespace clast::bonds
