// SPDX-License-Identifier: MIT
// A closed surface around the z axis between two platens, hung on rows of nodes that move radially: where it is, what
// touches it, what it encloses. How fast its nodes move is said by faceted_cylinder.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <fmt/core.h>

#include <clast/boundaries/axial.hpp>
#include <clast/boundaries/cylinder_settings.hpp>
#include <clast/boundaries/facet_rings.hpp>
#include <clast/boundaries/plate.hpp>
#include <clast/boundaries/polygon.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>
#include <clast/measure/sample.hpp>

namespace clast::boundaries {

/// Rows of nodes and two platens. Facets: 0 bottom platen, 1 top platen, 2 + row * columns + i a node, rows from the
/// bottom, node i at the azimuth 2 pi (i + 1/2) / columns. A node's velocity is positive inward (dR/dt = -V). Row k
/// stands at the share (k + 1/2) / rows of the height and moves with it.
///
/// Between nodes the surface is of plates (plate.hpp): a quadrilateral of two neighbouring nodes in two neighbouring
/// rows falls into four triangles around the mean of its corners; below the first row and above the last one the wall
/// is vertical, also beyond the platens. With all nodes at one radius R it is the regular prism whose tiles have the
/// apothem R cos(pi / columns), that of a wall of tiles of that radius.
///
/// Everything that a node feels is a derivative: with U the elastic energy of grains at the wall and V the volume
/// enclosed, its load is -dU/dR and its area dV/dR, so that a uniform pressure p loads it with p times its area, and a
/// load times a velocity is exactly the work done. A load on a plate goes to its nodes by the weights by which they
/// move the point of contact.
///
/// A template without a choice: what it does is compiled only in programs that have such a wall.
template <class = void> class node_rows : public facet_rings<> {
  public:
    // --- contact ---------------------------------------------------------------------------------------------------
    /// Whether a facet could come within `reach` (pebble radius plus margin, m) of x. Conservative: never false if one
    /// is.
    bool near(const vec3& x, double reach) const {
        if (platens_.near(x.z, reach)) return true;
        const surroundings around = quads_around(x, reach, 0.0);
        if (around.out_of_reach) return false;
        plates_near seen;
        return gather(x, reach, 0.0, 0.0, around, seen) > 0.0;
    }
    /// Contacts of a sphere with the facets as they will be `ahead` seconds later at their present velocities.
    touches touch(const vec3& x, double r, double ahead = 0.0) const {
        touches out;
        platens_.touch_sphere(x, r, ahead, out);
        // the way out may be longer than the deepest overlap and then meets more plates
        double margin = 0.25 * r;
        surroundings around = quads_around(x, r + margin, ahead);
        if (around.out_of_reach) return out;
        plates_near seen;
        const double deepest = gather(x, r, margin, ahead, around, seen);
        if (deepest <= 0.0) return out;
        if (2.0 * deepest > margin) {
            margin = 2.0 * deepest;
            gather(x, r, margin, ahead, quads_around(x, r + margin, ahead), seen);
        }
        push_out(
            seen, x, r, [this](int node) { return outward(node); }, out);
        return out;
    }
    /// Whether a pebble is lost: its centre is beyond a platen, or beyond the surface, by more than its radius.
    bool outside(const vec3& x, double r) const {
        if (!(x.z > platens_.bottom - r && x.z < platens_.top + r)) return true; // also for NaN
        const int strip = strip_at(x.z), below = std::max(strip, 0), above = std::min(strip + 1, rings_ - 1);
        const double share = above > below ? (x.z - level(below)) * per_spacing_ : 0.0;
        const int i = dir_.towards(x.x, x.y);
        const double limit = (1.0 - share) * edge_towards(below, i, x) + share * edge_towards(above, i, x) + r;
        return !(x.x * x.x + x.y * x.y <= limit * limit);
    }
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
    /// Of a wall that still is a cylinder: apothem of its prism (m).
    double radius() const { return apothem_[0] * flat_; }
    /// Area of a facet (m^2): of a node dV/dR, for a platen the mean section. d volume / dt = - sum of area times
    /// velocity.
    double area(int facet) const {
        return facet < first_lateral_facet ? section() : area_[index(facet - first_lateral_facet)];
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
    }

  protected:
    /// A cylinder at rest of so many rows, whatever the settings say of them. Throws run_error where the height or the
    /// radius leaves no room for the smallest pebble.
    node_rows(int rows, const cylinder_settings& of_checked_sizes);

    /// Every node has an area of its own.
    static constexpr bool hidden(int, int) { return false; }
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

    double flat_ = 1.0; // apothem over radius of a regular row; face i of a row lies between its nodes i - 1 and i

  private:
    struct point {
        double x, y;
    };
    /// A quadrilateral between the corners A, B, C, D (left, right, right above, left above) and its middle plane,
    /// which is parallel to both diagonals: A and C lie as far on one side of it as B and D on the other.
    struct quadrilateral {
        vec3 middle, normal; ///< normal: inward unit vector of the middle plane
        double bent = 0.0;   ///< distance of the corners from the plane (m)
        double least = 0.0; ///< of the corners' radii, as an apothem: no point is nearer to the axis along the face (m)
    };
    /// Strip at a height.
    int strip_at(double z) const {
        const double q = std::floor((z - bottom()) * per_spacing_ - 0.5);
        return q <= -1.0 ? -1 : q >= rings_ - 1 ? rings_ - 1 : static_cast<int>(q);
    }
    double level(int row) const { return bottom() + (row + 0.5) * spacing(); }
    /// Upward velocity of a row (m/s).
    double row_velocity(int row) const { return rise((row + 0.5) / rings_); }
    vec3 outward(int facet) const {
        const std::size_t i = index((facet - first_lateral_facet) % around_);
        return {cosine_[i], sine_[i], 0.0};
    }
    /// Distance from the axis of a row's face i in the direction of x (m).
    double edge_towards(int row, int i, const vec3& x) const {
        const point a = at_[tile(row, dir_.wrap(i - 1))], b = at_[tile(row, i)];
        const double rho = std::sqrt(x.x * x.x + x.y * x.y);
        const double along = (b.y - a.y) * x.x - (b.x - a.x) * x.y;
        return rho > 0.0 ? (a.x * b.y - a.y * b.x) * rho / along : 0.0;
    }
    double row_area(int row) const {
        double sum = 0.0;
        for (int i = 0; i < around_; ++i) {
            const point a = at_[tile(row, dir_.wrap(i - 1))], b = at_[tile(row, i)];
            sum += a.x * b.y - a.y * b.x;
        }
        return 0.5 * sum;
    }

    /// Quadrilaterals that a sphere may touch: strip q lies between the rows q and q + 1, -1 below the first and
    /// rings_ - 1 above the last.
    struct surroundings {
        int first = 0, last = 0;
        double least = 0.0;        ///< least apothem of their faces (m)
        bool out_of_reach = false; ///< none of their plates is within reach
    };
    surroundings quads_around(const vec3& x, double reach, double ahead) const {
        const double drift = std::abs(ahead) * std::max(std::abs(platens_.velocity[0]), std::abs(platens_.velocity[1]));
        surroundings s{strip_at(x.z - reach - drift), strip_at(x.z + reach + drift)};
        double least = strip_least_[index(s.first + 1)];
        for (int q = s.first + 1; q <= s.last; ++q) least = std::min(least, strip_least_[index(q + 1)]);
        s.least = least - flat_ * std::abs(ahead) * lateral_speed_;
        const double inner = s.least - reach;
        s.out_of_reach = inner >= 0.0 && x.x * x.x + x.y * x.y <= inner * inner;
        return s;
    }
    /// Collects the plates within r + margin of x in the strips around it; none where no quadrilateral is within r.
    /// Returns the deepest overlap with a single one (m), 0 without any.
    double gather(const vec3& x, double r, double margin, double ahead, const surroundings& around,
                  plates_near& seen) const;
    std::array<vec3, 4> corners_of(int strip, int i, double ahead) const {
        const int left = dir_.wrap(i - 1);
        if (strip >= 0 && strip < rings_ - 1)
            return {node_at(strip, left, ahead), node_at(strip, i, ahead), node_at(strip + 1, i, ahead),
                    node_at(strip + 1, left, ahead)};
        // the vertical ends: on beyond the platens, further than any pebble reaches
        const int row = strip < 0 ? 0 : rings_ - 1;
        const vec3 on{0.0, 0.0, spacing() + 2.0 * radius()}, l = node_at(row, left, ahead), r = node_at(row, i, ahead);
        if (strip < 0) return {l - on, r - on, r, l};
        return {l, r, r + on, l + on};
    }
    static quadrilateral quadrilateral_of(const std::array<vec3, 4>& corner) {
        quadrilateral q;
        q.middle = 0.25 * ((corner[0] + corner[1]) + (corner[2] + corner[3]));
        q.normal = unit(cross(corner[3] - corner[1], corner[2] - corner[0]));
        q.bent = std::abs(dot(corner[0] - q.middle, q.normal));
        return q;
    }
    quadrilateral quadrilateral_at(int strip, int i, double ahead) const {
        if (ahead != 0.0) return quadrilateral_of(corners_of(strip, i, ahead));
        return quads_[index((strip + 1) * around_ + i)];
    }
    vec3 node_at(int row, int i, double ahead) const {
        const std::size_t j = tile(row, i);
        vec3 x{at_[j].x, at_[j].y, level(row)};
        if (ahead != 0.0)
            x += vec3{-ahead * velocity_[j] * cosine_[index(i)], -ahead * velocity_[j] * sine_[index(i)],
                      ahead * row_velocity(row)};
        return x;
    }
    void refresh();
    void check_state() const;

    std::vector<double> cosine_, sine_; // of the nodes' azimuths
    std::vector<point> at_;             // per node
    std::vector<double> strip_least_;   // per strip, from -1 on: least apothem
    double per_spacing_ = 0.0;          // 1/m
    std::vector<double> area_;          // per node
    std::vector<quadrilateral> quads_;  // per strip, from -1 on, and face
};

// --- implementation ------------------------------------------------------------------------------------------------

namespace detail {

using corner_parts = std::array<std::array<double, 4>, 3>;
/// Corners of a quadrilateral's four triangles: two nodes that follow each other, and the mean of all.
inline constexpr std::array<corner_parts, 4> quarter_parts{{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0.25, 0.25, 0.25, 0.25}}},
                                                            {{{0, 1, 0, 0}, {0, 0, 1, 0}, {0.25, 0.25, 0.25, 0.25}}},
                                                            {{{0, 0, 1, 0}, {0, 0, 0, 1}, {0.25, 0.25, 0.25, 0.25}}},
                                                            {{{0, 0, 0, 1}, {1, 0, 0, 0}, {0.25, 0.25, 0.25, 0.25}}}}};
} // namespace detail

template <class X>
node_rows<X>::node_rows(int rows, const cylinder_settings& of_checked_sizes)
    : facet_rings<>(rows, of_checked_sizes,
                    of_checked_sizes.radius / std::cos(std::numbers::pi / of_checked_sizes.tiles_per_ring)),
      flat_(std::cos(std::numbers::pi / around_)) {
    for (int i = 0; i < around_; ++i) {
        cosine_.push_back(std::cos(dir_.angle() * (i + 0.5)));
        sine_.push_back(std::sin(dir_.angle() * (i + 0.5)));
    }
    const std::size_t nodes = apothem_.size();
    at_.resize(nodes);
    quads_.resize(nodes + index(around_));
    area_.resize(nodes);
    strip_least_.resize(index(rings_) + 1);
    refresh();
    check_state();
}

template <class X>
double node_rows<X>::gather(const vec3& x, double r, double margin, double ahead, const surroundings& around,
                            plates_near& seen) const {
    seen.clear();
    double deepest = 0.0;
    const double reach = r + margin, slack = flat_ * std::abs(ahead) * lateral_speed_;
    const auto keep = [&](const plate& p) {
        const separation s = separate(p, x);
        if (s.distance >= reach) return;
        deepest = std::max(deepest, r - s.distance);
        seen.add(p, s);
    };
    // Those triangles of a quadrilateral that are within reach. In its middle plane x = middle + alpha (C - A) / 2 +
    // beta (D - B) / 2, and the signs of alpha and beta tell the triangles apart.
    const auto look_into = [&](int strip, int i, const quadrilateral& q, double above) {
        const std::array<vec3, 4> corner = corners_of(strip, i, ahead);
        const vec3 up = 0.5 * (corner[2] - corner[0]), across = 0.5 * (corner[3] - corner[1]), d = x - q.middle;
        const vec3 a = cross(q.normal, across), b = cross(up, q.normal);
        const double span = dot(up, a); // = dot(across, b)
        const double alpha = dot(a, d), beta = dot(b, d);
        const double aside2 = std::max(0.0, reach * reach - above * above);
        const double past_alpha2 = aside2 * norm2(a), past_beta2 = aside2 * norm2(b);
        const int left = dir_.wrap(i - 1), low = std::max(strip, 0), top = std::min(strip + 1, rings_ - 1);
        const auto facet = [this](int row, int column) {
            return static_cast<std::int32_t>(tile(row, column)) + first_lateral_facet;
        };
        for (std::size_t k = 0; k < 4; ++k) {
            const double right = k == 1 || k == 2 ? alpha : -alpha, high = k >= 2 ? beta : -beta;
            if (right < 0.0 && right * right > past_alpha2) continue;
            if (high < 0.0 && high * high > past_beta2) continue;
            const double past_edge = right + high - span;
            if (past_edge > 0.0 && past_edge * past_edge > aside2 * norm2(k % 2 == 0 ? a + b : a - b)) continue;
            plate p{corner[k],
                    corner[(k + 1) % 4],
                    q.middle,
                    {},
                    {facet(low, left), facet(low, i), facet(top, i), facet(top, left)},
                    &detail::quarter_parts[k]};
            p.orient();
            keep(p);
        }
    };
    struct near_one {
        int strip, face;
        double above; ///< least distance along the normal of the middle plane, or 0 where it is behind
    };
    bool within = false; // a quadrilateral is within r
    std::array<near_one, 24> ones;
    std::size_t count = 0;
    const auto look_at = [&](int i) { // face i in all strips
        const double forward = x.x * dir_.cosine[index(i)] + x.y * dir_.sine[index(i)] + reach;
        for (int strip = around.first; strip <= around.last; ++strip) {
            const quadrilateral& now = quads_[index((strip + 1) * around_ + i)];
            if (forward <= now.least - slack) continue;
            const quadrilateral q = ahead == 0.0 ? now : quadrilateral_of(corners_of(strip, i, ahead));
            const double above = dot(x - q.middle, q.normal) - q.bent;
            if (above >= reach) continue;
            within = within || above < r;
            if (count < ones.size()) ones[count++] = {strip, i, std::max(above, 0.0)};
        }
    };
    const auto may = [&](int i) {
        return x.x * dir_.cosine[index(i)] + x.y * dir_.sine[index(i)] + reach > around.least;
    };
    const int facing = dir_.towards(x.x, x.y);
    look_at(facing);
    for (int m = 1; 2 * m <= around_; ++m) { // by turns: a face out of reach rules out those behind it
        const int right = dir_.wrap(facing + m), left = dir_.wrap(facing - m);
        const bool on_right = may(right), on_left = may(left);
        if (!on_right && !on_left) break;
        if (on_right) look_at(right);
        if (on_left && left != right) look_at(left);
    }
    if (within)
        for (std::size_t k = 0; k < count; ++k) {
            const near_one& o = ones[k];
            look_into(o.strip, o.face, quadrilateral_at(o.strip, o.face, ahead), o.above);
        }
    return deepest;
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
        const vec3 a = node_at(k, left, 0.0), b = node_at(k, i, 0.0), c = node_at(k + 1, i, 0.0),
                   d = node_at(k + 1, left, 0.0);
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
    for (int k = 0; k < rings_; ++k)
        for (int i = 0; i < around_; ++i) {
            const std::size_t j = tile(k, i);
            at_[j] = {apothem_[j] * cosine_[index(i)], apothem_[j] * sine_[index(i)]};
        }
    per_spacing_ = 1.0 / spacing();
    for (int strip = -1; strip < rings_; ++strip) {
        const int low = std::max(strip, 0), high = std::min(strip + 1, rings_ - 1);
        double least = apothem_[tile(low, 0)];
        for (int i = 0; i < around_; ++i) {
            const int left = dir_.wrap(i - 1);
            quadrilateral& q = quads_[index((strip + 1) * around_ + i)];
            q = quadrilateral_of(corners_of(strip, i, 0.0));
            q.least = std::min(std::min(apothem_[tile(low, left)], apothem_[tile(low, i)]),
                               std::min(apothem_[tile(high, left)], apothem_[tile(high, i)]));
            least = std::min(least, q.least);
            q.least *= flat_;
        }
        strip_least_[index(strip + 1)] = flat_ * least;
    }
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
            v.corner = {node_at(low, left, 0.0), node_at(low, i, 0.0), node_at(high, i, 0.0), node_at(high, left, 0.0)};
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
