// SPDX-License-Identifier: MIT
// What the closed surface that hangs on rows of nodes (node_net.hpp) encloses, how its nodes move radially, and what
// they feel. How fast they move is said by faceted_cylinder.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <fmt/core.h>

#include <clast/boundaries/axial.hpp>
#include <clast/boundaries/cylinder_settings.hpp>
#include <clast/boundaries/node_net.hpp>
#include <clast/boundaries/polygon.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::boundaries {

/// Rows of nodes and two platens, numbered as in node_net.hpp. A node's velocity is positive inward (dR/dt = -V); its
/// row moves with its share of the height. With all nodes at one radius R the surface is the regular prism whose tiles
/// have the apothem R cos(pi / columns), that of a wall of tiles of that radius.
///
/// Everything that a node feels is a derivative: with U the elastic energy of grains at the wall and V the volume
/// enclosed, its load is -dU/dR and its area dV/dR, so that a uniform pressure p loads it with p times its area, and a
/// load times a velocity is exactly the work done. A load on a plate goes to its nodes by the weights by which they
/// move the point of contact.
///
/// A template without a choice: what it does is compiled only in programs that have such a wall.
template <class = void> class node_rows : public node_net<> {
  public:
    // --- contact, beyond that of node_net --------------------------------------------------------------------------
    /// Whether a sphere has room inside a wall that still is a cylinder, touching nothing.
    bool holds(const vec3& x, double r) const { return facet_rings<>::holds(x, r, radius()); }

    // --- facets ----------------------------------------------------------------------------------------------------
    /// Inward unit vector of a facet's motion.
    vec3 inward(int facet) const {
        if (facet < first_lateral_facet) return {0.0, 0.0, facet == bottom_platen ? 1.0 : -1.0};
        return -outward(facet);
    }
    /// Distance of a node from the axis (m).
    double node_radius(int facet) const { return apothem_[index(facet - first_lateral_facet)]; }
    /// Area of a facet (m^2): of a node dV/dR, for a platen the mean section. d volume / dt = - sum of area times
    /// velocity.
    double area(int facet) const {
        return facet < first_lateral_facet ? section() : area_[index(facet - first_lateral_facet)];
    }
    /// What the stretched sheet exerts on the grains by a node, beyond the pressure (N, inward; 0 without
    /// cylinder_settings::stretching). The sheet is a net of threads along its rows and up its columns that resist
    /// stretching alone: with E t for stretching, the width w of sheet that a thread stands for and its length l0 in
    /// the cylinder that the sheet was at the start, U = E t w (l - l0)^2 / (2 l0) where l > l0, and this is dU/dR.
    double stretching_force(int facet) const {
        return facet < first_lateral_facet || pull_.empty() ? 0.0 : pull_[index(facet - first_lateral_facet)];
    }
    double stretching_energy() const { return stretching_energy_; } ///< U (J)
    /// Mean pressure (Pa) that the wall answers to: that of a cell around the sheet, whose own pull is left out.
    double lateral_stress(std::span<const facet_load> loads) const {
        return (this->lateral_force(loads) - pull_of_all_) / lateral_area_;
    }
    /// By how much that misses a target sigma (Pa, > 0), over sigma.
    double confining_error(std::span<const facet_load> loads, double sigma) const {
        return std::abs(this->lateral_force(loads) - pull_of_all_ - sigma * lateral_area_) / (sigma * lateral_area_);
    }

    // --- motion ----------------------------------------------------------------------------------------------------
    /// Moves all facets by dt (s). Throws run_error if the membrane tears or the platens meet.
    void advance(double dt) {
        move(dt);
        refresh();
        check_state();
    }
    /// Velocity (m/s) of the surface where a touch is: its part that the facet answers for.
    vec3 velocity_at(const boundaries::touch& t, const vec3&) const {
        if (t.facet == bottom_platen) return {0.0, 0.0, platens_.velocity[0]};
        if (t.facet == top_platen) return {0.0, 0.0, -platens_.velocity[1]};
        const std::size_t j = index(t.facet - first_lateral_facet), i = j % index(around_);
        return {-velocity_[j] * cosine_[i], -velocity_[j] * sine_[i], row_velocity(static_cast<int>(j) / around_)};
    }

    // --- measures --------------------------------------------------------------------------------------------------
    /// Area of the specimen at a platen (m^2): 0 the bottom one, 1 the top one.
    double end_section(int platen) const { return row_area(platen == bottom_platen ? 0 : rings_ - 1); }
    /// Area of the specimen at a height between the platens (m^2).
    double section_at(double z) const;
    /// Axial stress of the laboratory (axial.hpp, Pa).
    double axial_stress(std::span<const facet_load> loads) const { return boundaries::axial_stress(*this, loads); }
    /// Rate of work done on the specimen by all facets (W): force times inward velocity, and vertical force times that
    /// of the rows, which move with the platens.
    double power(std::span<const facet_load> loads) const {
        double sum = 0.0;
        for (int f = 0; f < facet_count(); ++f) {
            const facet_load& l = loads[index(f)];
            sum += l.force * velocity(f);
            if (f >= first_lateral_facet)
                sum += (l.edge[0] + l.edge[1]) * row_velocity((f - first_lateral_facet) / around_);
        }
        return sum;
    }
    /// The platens (as squares around the wall) and the quadrilaterals between nodes.
    std::vector<facet_view> view(std::span<const facet_load> loads) const;

    /// Complete state, for checkpoints.
    template <class A> void archive(A& a) {
        facet_rings<>::archive(a);
        a(flat_, cosine_, sine_, at_, quads_, strip_least_, per_spacing_, area_);
        if constexpr (A::reading) place(), stretch();
    }

    static constexpr bool stretches = true; ///< it has a use for cylinder_settings::stretching

  protected:
    /// A cylinder at rest of so many rows, whatever the settings say of them. Throws run_error where the height or the
    /// radius leaves no room for the smallest pebble.
    node_rows(int rows, const cylinder_settings& of_checked_sizes);

    /// Every node has an area of its own.
    static constexpr bool hidden(int, int) { return false; }
    /// Default of largest_radius, in radii: at half of its height a specimen has 1.4 times its radius in the mean, and
    /// its bulge more; what holds a joined wall together is its slope limit.
    static constexpr double tears_at = 2.5;
    /// Nodes share faces, smoothly: each may answer on its own to what all of them would do together.
    static constexpr bool solved_together = false;
    /// Largest steps (m) between neighbours up a column and around a row, slopes of 0.9 at the start: plates of a ridge
    /// turn by less than a right angle then.
    double largest_gap() const { return 0.9 * spacing(); }
    double largest_step() const { return 0.9 * regular_width(around_, radius()); }
    /// What the sheet adds to the loads of its nodes because it resists kinks: a force on the grains for each (N,
    /// inward, all together 0), and by how much that grows at most with a metre (N/m). stiffness: k (N/m) of the energy
    /// k / 2 sum (L R)^2, where L R is the sum of a node's differences from its neighbours in the column and, times the
    /// square of the ratio of sides, in the row.
    double resist_kinks(double stiffness, std::vector<double>& force) const;
    /// Speed of the nodes for one of the prism's faces (m/s).
    double speed_of_faces(double v) const { return v / flat_; }

  private:
    double row_area(int row) const {
        double sum = 0.0;
        for (int i = 0; i < around_; ++i) {
            const point a = at_[tile(row, dir_.wrap(i - 1))], b = at_[tile(row, i)];
            sum += a.x * b.y - a.y * b.x;
        }
        return 0.5 * sum;
    }

    void refresh();
    /// Finds what the sheet exerts because it is longer than it was.
    void stretch();
    void check_state() const;

    std::vector<double> area_; // per node
    // what follows from the places of nodes
    std::vector<double> pull_; // per node; empty without stretching
    double pull_of_all_ = 0.0, stretching_energy_ = 0.0;
};

// --- implementation ------------------------------------------------------------------------------------------------

template <class X>
node_rows<X>::node_rows(int rows, const cylinder_settings& of_checked_sizes) : node_net<>(rows, of_checked_sizes) {
    area_.resize(apothem_.size());
    refresh();
    check_state();
}

template <class X> double node_rows<X>::resist_kinks(double stiffness, std::vector<double>& force) const {
    const double side = spacing() / regular_width(around_, radius()), beside = side * side;
    const auto differences = [&](const std::vector<double>& of, std::vector<double>& into) {
        into.assign(of.size(), 0.0);
        for (int k = 0; k < rings_; ++k)
            for (int i = 0; i < around_; ++i) {
                const std::size_t j = tile(k, i), right = tile(k, dir_.wrap(i + 1));
                const double in_row = beside * (of[j] - of[right]);
                into[j] += in_row, into[right] -= in_row;
                if (k + 1 == rings_) continue;
                const std::size_t above = tile(k + 1, i);
                const double in_column = of[j] - of[above];
                into[j] += in_column, into[above] -= in_column;
            }
    };
    std::vector<double> once;
    differences(apothem_, once);
    differences(once, force);
    for (double& f : force) f *= stiffness;
    const double row_of_l = 4.0 * (1.0 + beside); // sum of the sizes of its elements
    return stiffness * row_of_l * row_of_l;
}

template <class X> double node_rows<X>::section_at(double z) const {
    const int k = strip_at(z);
    if (k < 0) return row_area(0);
    if (k >= rings_ - 1) return row_area(rings_ - 1);
    const double share = (z - level(k)) * per_spacing_;
    const auto between = [](const vec3& a, const vec3& b, double part) { return (1.0 - part) * a + part * b; };
    double sum = 0.0;
    for (int i = 0; i < around_; ++i) {
        const int left = dir_.wrap(i - 1);
        const vec3 a = node_at(k, left), b = node_at(k, i), c = node_at(k + 1, i), d = node_at(k + 1, left);
        const vec3 middle = 0.25 * ((a + b) + (c + d));
        // along the section: the left edge, two lines to the middle, the right edge
        const bool low = share < 0.5;
        const double part = low ? 2.0 * share : 2.0 * (1.0 - share);
        const std::array<vec3, 4> p{between(a, d, share), between(low ? a : d, middle, part),
                                    between(low ? b : c, middle, part), between(b, c, share)};
        for (std::size_t j = 0; j < 3; ++j) sum += p[j].x * p[j + 1].y - p[j].y * p[j + 1].x;
    }
    return 0.5 * sum;
}

template <class X> void node_rows<X>::refresh() {
    place();
    // dV = sum over corners of outward area / 3 times displacement, for a closed surface of triangles
    std::fill(area_.begin(), area_.end(), 0.0);
    volume_ = 0.0;
    const double rise = spacing();
    const auto along = [&](std::size_t node, int i, const point& n) {
        area_[node] += n.x * cosine_[index(i)] + n.y * sine_[index(i)];
    };
    for (const int row : {0, rings_ - 1}) { // the vertical ends, half a spacing high
        for (int i = 0; i < around_; ++i) {
            const int left = dir_.wrap(i - 1);
            const std::size_t l = tile(row, left), r = tile(row, i);
            const point half{0.25 * rise * (at_[r].y - at_[l].y), -0.25 * rise * (at_[r].x - at_[l].x)};
            along(l, left, half), along(r, i, half);
        }
        volume_ += 0.5 * rise * row_area(row);
    }
    for (int k = 0; k + 1 < rings_; ++k)
        for (int i = 0; i < around_; ++i) {
            const int left = dir_.wrap(i - 1);
            const std::array<std::size_t, 4> node{tile(k, left), tile(k, i), tile(k + 1, i), tile(k + 1, left)};
            const std::array<int, 4> column{left, i, i, left};
            const std::array<double, 4> z{0.0, 0.0, rise, rise};
            point middle{0.0, 0.0};
            for (const std::size_t j : node) middle.x += 0.25 * at_[j].x, middle.y += 0.25 * at_[j].y;
            std::array<point, 4> normal; // of the triangles, as long as their area / 3
            point whole{0.0, 0.0};
            for (std::size_t t = 0; t < 4; ++t) {
                const std::size_t next = (t + 1) % 4;
                const point a = at_[node[t]], b = at_[node[next]];
                const double abz = z[next] - z[t], amz = 0.5 * rise - z[t];
                normal[t] = {((b.y - a.y) * amz - abz * (middle.y - a.y)) / 6.0,
                             (abz * (middle.x - a.x) - (b.x - a.x) * amz) / 6.0};
                whole.x += normal[t].x, whole.y += normal[t].y;
                volume_ += 0.5 * ((a.x + b.x + middle.x) * normal[t].x + (a.y + b.y + middle.y) * normal[t].y);
            }
            for (std::size_t t = 0; t < 4; ++t) {
                const std::size_t last = (t + 3) % 4;
                along(node[t], column[t],
                      {normal[t].x + normal[last].x + 0.25 * whole.x, normal[t].y + normal[last].y + 0.25 * whole.y});
            }
        }
    lateral_area_ = 0.0;
    for (const double a : area_) lateral_area_ += a;
    stretch();
}

template <class X> void node_rows<X>::stretch() {
    if (set_.stretching <= 0.0) return;
    pull_.assign(apothem_.size(), 0.0);
    stretching_energy_ = 0.0;
    // a thread between two nodes: f(stretch) -> its pull, as long as it is stretched
    const auto pull = [&](double length, double at_start, double width) {
        const double longer = length - at_start;
        if (longer <= 0.0) return 0.0;
        stretching_energy_ += 0.5 * set_.stretching * width * longer * longer / at_start;
        return set_.stretching * width * longer / at_start;
    };
    const double rise = spacing(), rise_at_start = (set_.top - set_.bottom) / rings_;
    const double side_at_start = regular_width(around_, set_.radius);
    for (int k = 0; k < rings_; ++k)
        for (int i = 0; i < around_; ++i) {
            const int left = dir_.wrap(i - 1);
            const std::size_t a = tile(k, left), b = tile(k, i);
            const double x = at_[b].x - at_[a].x, y = at_[b].y - at_[a].y, side = std::sqrt(x * x + y * y);
            const double in_row = pull(side, side_at_start, rise_at_start) / side;
            pull_[a] -= in_row * (x * cosine_[index(left)] + y * sine_[index(left)]);
            pull_[b] += in_row * (x * cosine_[index(i)] + y * sine_[index(i)]);
            if (k + 1 == rings_) continue;
            const std::size_t above = tile(k + 1, i);
            const double step = apothem_[above] - apothem_[b], slope = std::sqrt(rise * rise + step * step);
            const double in_column = pull(slope, rise_at_start, side_at_start) * step / slope;
            pull_[b] -= in_column, pull_[above] += in_column;
        }
    pull_of_all_ = 0.0;
    for (const double f : pull_) pull_of_all_ += f;
}

template <class X> void node_rows<X>::check_state() const {
    check_height();
    for (std::size_t j = 0; j < apothem_.size(); ++j)
        if (!(flat_ * apothem_[j] >= least() && flat_ * apothem_[j] <= set_.largest_radius && area_[j] > 0.0))
            stop("The membrane is torn",
                 fmt::format("node {} of row {}, at {:.6g} m from the axis (allowed {:.6g} to {:.6g} m), of {:.3g} m^2",
                             static_cast<int>(j) % around_, static_cast<int>(j) / around_, apothem_[j], least() / flat_,
                             set_.largest_radius / flat_, area_[j]));
}

template <class X> std::vector<facet_view> node_rows<X>::view(std::span<const facet_load> loads) const {
    std::vector<facet_view> out = view_of_platens(loads, std::array{end_section(0), end_section(1)});
    const auto pressure = [&](int row, int i) {
        return loads[tile(row, i) + index(first_lateral_facet)].force / area_[tile(row, i)];
    };
    for (int q = -1; q < rings_; ++q)
        for (int i = 0; i < around_; ++i) {
            const int low = std::max(q, 0), high = std::min(q + 1, rings_ - 1), left = dir_.wrap(i - 1);
            facet_view v;
            v.corner = {node_at(low, left), node_at(low, i), node_at(high, i), node_at(high, left)};
            if (q < 0) v.corner[0].z = v.corner[1].z = bottom();
            if (q == rings_ - 1) v.corner[2].z = v.corner[3].z = top();
            v.pressure = 0.25 * (pressure(low, left) + pressure(low, i) + pressure(high, i) + pressure(high, left));
            const vec3 middle = 0.25 * ((v.corner[0] + v.corner[1]) + (v.corner[2] + v.corner[3]));
            for (std::size_t t = 0; t < 4; ++t)
                v.area += 0.5 * norm(cross(v.corner[(t + 1) % 4] - v.corner[t], middle - v.corner[t]));
            v.ring = q + 1, v.tile = i;
            out.push_back(v);
        }
    return out;
}

} // namespace clast::boundaries
