// SPDX-License-Identifier: MIT
// A closed surface around the z axis between two platens, hung on rows of nodes: where it is and what touches it. What
// it encloses and how it moves is said by node_rows.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <clast/boundaries/cylinder_settings.hpp>
#include <clast/boundaries/facet_rings.hpp>
#include <clast/boundaries/plate.hpp>
#include <clast/boundaries/quadrilateral.hpp>
#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>

namespace clast::boundaries {

/// Rows of nodes and two platens. Facets: 0 bottom platen, 1 top platen, 2 + row * columns + i a node, rows from the
/// bottom, node i at the azimuth 2 pi (i + 1/2) / columns. Row k stands at the share (k + 1/2) / rows of the height.
///
/// Between nodes the surface is of plates (plate.hpp): a quadrilateral of two neighbouring nodes in two neighbouring
/// rows falls into four triangles around the mean of its corners (quadrilateral.hpp); below the first row and above the
/// last one the wall is vertical, also beyond the platens.
///
/// A template without a choice: what it does is compiled only in programs that have such a wall.
template <class = void> class node_net : public facet_rings<> {
  public:
    /// Whether a facet could come within `reach` (pebble radius plus margin, m) of x. Conservative: never false if one
    /// is.
    bool near(const vec3& x, double reach) const {
        if (platens_.near(x.z, reach)) return true;
        const surroundings around = quads_around(x, reach, 0.0);
        if (around.out_of_reach) return false;
        if (in_front(x, reach)) return true;
        plates_near seen;
        return gather(x, reach, 0.0, 0.0, around, seen) > 0.0;
    }
    /// Contacts of a sphere with the facets as they will be `ahead` seconds later at their present velocities.
    touches touch(const vec3& x, double r, double ahead = 0.0) const {
        touches out;
        platens_.touch_sphere(x, r, ahead, out);
        // the way out may be longer than the deepest overlap and then meets more plates
        double margin = 0.25 * r;
        const double inner = least_ - nearer(ahead) - (r + margin);
        if (inner >= 0.0 && x.x * x.x + x.y * x.y <= inner * inner) return out;
        if (touch_one(x, r, margin, ahead, out).has_value()) return out;
        const surroundings around = quads_around(x, r + margin, ahead);
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

    /// Of a wall that still is a cylinder: apothem of its prism (m).
    double radius() const { return apothem_[0] * flat_; }

  protected:
    struct point {
        double x, y;
    };

    /// A cylinder of this apothem as a prism, of so many rows. What is made of this calls place() last.
    node_net(int rows, const cylinder_settings& of_checked_sizes);

    /// Puts all that follows from nodes and platens where those are now.
    void place();

    /// Strip at a height.
    int strip_at(double z) const {
        const double q = (z - bottom()) * per_spacing_ - 0.5;
        return q >= 0.0 ? std::min(static_cast<int>(std::min(q, 1e9)), rings_ - 1) : -1;
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
    /// Quadrilaterals that a sphere may touch: strip q lies between the rows q and q + 1, -1 below the first and
    /// rings_ - 1 above the last.
    struct surroundings {
        int first = 0, last = 0;
        double least = 0.0;        ///< least apothem of their faces (m)
        bool out_of_reach = false; ///< none of their plates is within reach
    };
    /// How far a row rises or sinks, and how much nearer a face comes, at most (m).
    double drift(double ahead) const {
        if (ahead == 0.0) return 0.0;
        return std::abs(ahead) * std::max(std::abs(platens_.velocity[0]), std::abs(platens_.velocity[1]));
    }
    double nearer(double ahead) const { return ahead == 0.0 ? 0.0 : flat_ * std::abs(ahead) * lateral_speed_; }
    surroundings quads_around(const vec3& x, double reach, double ahead) const {
        const double up = reach + drift(ahead);
        surroundings s{strip_at(x.z - up), strip_at(x.z + up)};
        double least = strip_least_[index(s.first + 1)];
        for (int q = s.first + 1; q <= s.last; ++q) least = std::min(least, strip_least_[index(q + 1)]);
        s.least = least - nearer(ahead);
        const double inner = s.least - reach;
        s.out_of_reach = inner >= 0.0 && x.x * x.x + x.y * x.y <= inner * inner;
        return s;
    }
    /// Nodes in the order of corners; the ends are vertical and go on beyond the platens, further than any pebble
    /// reaches.
    corners corners_of(int strip, int i, double ahead) const {
        const int i_left = dir_.wrap(i - 1);
        const std::size_t low = index((strip + 1) * around_), left = index(i_left), right = index(i),
                          high = low + index(around_);
        corners c{node_[low + left], node_[low + right], node_[high + right], node_[high + left]};
        if (ahead != 0.0) {
            const int below = std::max(strip, 0), above = std::min(strip + 1, rings_ - 1);
            c = {node_at(below, i_left) + way_of(below, left, ahead), node_at(below, i) + way_of(below, right, ahead),
                 node_at(above, i) + way_of(above, right, ahead), node_at(above, i_left) + way_of(above, left, ahead)};
            if (strip < 0) c[0].z -= beyond(), c[1].z -= beyond();
            if (strip == rings_ - 1) c[2].z += beyond(), c[3].z += beyond();
        }
        return c;
    }
    double beyond() const { return spacing() + 2.0 * radius(); }
    /// How far a node goes (m).
    vec3 way_of(int row, std::size_t i, double ahead) const {
        const double v = velocity_[tile(row, static_cast<int>(i))];
        return {-ahead * v * cosine_[i], -ahead * v * sine_[i], ahead * row_velocity(row)};
    }
    /// Numbers of the facets of a quadrilateral's nodes, in the order of its corners.
    std::array<std::int32_t, 4> nodes_of(int strip, int i) const {
        const int left = dir_.wrap(i - 1), low = std::max(strip, 0), top = std::min(strip + 1, rings_ - 1);
        const auto facet = [this](int row, int column) {
            return static_cast<std::int32_t>(tile(row, column)) + first_lateral_facet;
        };
        return {facet(low, left), facet(low, i), facet(top, i), facet(top, left)};
    }
    std::size_t quad(int strip, int i) const { return index((strip + 1) * around_ + i); }
    /// f(corners, quadrilateral, normals of its quarters).
    template <class F> auto with_quad(int strip, int i, double ahead, F&& f) const {
        const std::size_t j = quad(strip, i);
        if (ahead == 0.0) return f(corners_[j], quads_[j], normals_[j]);
        const corners c = corners_of(strip, i, ahead);
        const quadrilateral q = quadrilateral::of(c);
        return f(c, q, normals_of_quarters(c, q.middle));
    }
    double before_quad(const vec3& x, int strip, int i, double ahead) const {
        return ahead == 0.0 ? quads_[quad(strip, i)].before(x)
                            : quadrilateral::of(corners_of(strip, i, ahead)).before(x);
    }
    const vec3& node_at(int row, int i) const { return node_[index((row + 1) * around_ + i)]; }
    /// Calls f(face) for the faces that may be within reach of x, `facing` first, as long as it returns true; `least`:
    /// apothem of the nearest.
    template <class F> bool each_face(const vec3& x, double reach, double least, int facing, F&& f) const {
        const auto may = [&](int i) { return x.x * dir_.cosine[index(i)] + x.y * dir_.sine[index(i)] + reach > least; };
        if (!f(facing)) return false;
        for (int m = 1; 2 * m <= around_; ++m) { // by turns: a face out of reach rules out those behind it
            const int right = dir_.wrap(facing + m), left = dir_.wrap(facing - m);
            const bool on_right = may(right), on_left = may(left);
            if (!on_right && !on_left) break;
            if (on_right && !f(right)) return false;
            if (on_left && left != right && !f(left)) return false;
        }
        return true;
    }
    /// Collects the plates within r + margin of x in the strips around it; none where no quadrilateral is within r.
    /// Returns the deepest overlap with a single one (m), 0 without any.
    double gather(const vec3& x, double r, double margin, double ahead, const surroundings& around,
                  plates_near& seen) const;
    /// What is easy, as it is for nearly all spheres: adds the contacts of one that touches, by less than margin, a
    /// plate of the quadrilateral in front of it on its face, and no other (then true), or sees that it touches none
    /// (false). Nothing, and nothing done, where it may be otherwise.
    std::optional<bool> touch_one(const vec3& x, double r, double margin, double ahead, touches& out) const;

    /// Whether a sphere that rests in a quadrilateral is free of all others: each of them lies between two rows and
    /// between two planes through the axis.
    bool is_free_beyond(const resting_sphere& s, int strip, int face, const corners& c, double ahead,
                        double tolerance) const;
    /// Whether the face of a plate in front of x is within reach: what near() is about, most often.
    bool in_front(const vec3& x, double reach) const;

    double flat_ = 1.0; // apothem over radius of a regular row; face i of a row lies between its nodes i - 1 and i
    std::vector<double> cosine_, sine_; // of the nodes' azimuths
    std::vector<point> at_;             // per node
    std::vector<double> strip_least_;   // per strip, from -1 on: least apothem
    double per_spacing_ = 0.0;          // 1/m
    std::vector<quadrilateral> quads_;  // per strip, from -1 on, and face
    // What place() makes of these, not archived: nodes, with a row of places far above and below, and the normals of
    // quarters in the order of quads_.
    std::vector<vec3> node_;
    std::vector<corners> corners_;
    std::vector<quarter_normals> normals_;
    double least_ = 0.0; // of strip_least_ (m)
};

// --- implementation ------------------------------------------------------------------------------------------------

template <class X>
node_net<X>::node_net(int rows, const cylinder_settings& of_checked_sizes)
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
    strip_least_.resize(index(rings_) + 1);
}

template <class X>
double node_net<X>::gather(const vec3& x, double r, double margin, double ahead, const surroundings& around,
                           plates_near& seen) const {
    seen.clear();
    double deepest = 0.0;
    const double reach = r + margin, slack = nearer(ahead);
    const auto keep = [&](const plate& p) {
        const separation s = separate(p, x);
        if (s.distance >= reach) return;
        deepest = std::max(deepest, r - s.distance);
        seen.add(p, s);
    };
    struct near_one {
        int strip, face;
        double above; ///< least distance along the normal of the middle plane, or 0 where it is behind
    };
    // those triangles of a quadrilateral that are within reach
    const auto look_into = [&](const near_one& o, const corners& c, const quadrilateral& q,
                               const quarter_normals& normals) {
        const place_among_quarters at(c, q, x);
        const double aside2 = std::max(0.0, reach * reach - o.above * o.above), off = at.aside(c);
        const double past_alpha2 = aside2 * norm2(at.a), past_beta2 = aside2 * norm2(at.b);
        for (std::size_t k = 0; k < 4; ++k) {
            const double right = k == 1 || k == 2 ? at.alpha : -at.alpha, high = k >= 2 ? at.beta : -at.beta;
            if (right < -off && (right + off) * (right + off) > past_alpha2) continue;
            if (high < -off && (high + off) * (high + off) > past_beta2) continue;
            const double past_edge = right + high - at.span - off;
            if (past_edge > 0.0 && past_edge * past_edge > aside2 * norm2(k % 2 == 0 ? at.a + at.b : at.a - at.b))
                continue;
            keep(quarter(c, q.middle, k, normals[k], nodes_of(o.strip, o.face)));
        }
    };
    bool within = false; // a quadrilateral is within r
    std::array<near_one, 24> ones;
    std::size_t count = 0;
    each_face(x, reach, around.least, dir_.towards(x.x, x.y), [&](int i) {
        const double forward = x.x * dir_.cosine[index(i)] + x.y * dir_.sine[index(i)] + reach;
        for (int strip = around.first; strip <= around.last; ++strip) {
            if (forward <= quads_[quad(strip, i)].least - slack) continue;
            const double above = before_quad(x, strip, i, ahead);
            if (above >= reach) continue;
            within = within || above < r;
            if (count < ones.size()) ones[count++] = {strip, i, std::max(above, 0.0)};
        }
        return true;
    });
    if (within)
        for (std::size_t k = 0; k < count; ++k) {
            const near_one& o = ones[k];
            with_quad(o.strip, o.face, ahead, [&](const auto&... of) { look_into(o, of...); });
        }
    return deepest;
}

template <class X>
std::optional<bool> node_net<X>::touch_one(const vec3& x, double r, double margin, double ahead, touches& out) const {
    const int strip = strip_at(x.z), face = dir_.towards(x.x, x.y);
    return with_quad(
        strip, face, ahead,
        [&](const corners& c, const quadrilateral& q, const quarter_normals& normals) -> std::optional<bool> {
            const std::size_t own = place_among_quarters(c, q, x).quarter(), next = (own + 1) % 4;
            const vec3& n = normals[own];
            const double depth = r - dot(x - c[own], n), tolerance = plate_precision * r;
            const bool touches_it = depth > 0.0;
            if (touches_it ? depth >= margin : depth > -tolerance) return {};
            const resting_sphere free{touches_it ? x + depth * n : x, r, c[own], n};
            foot f{};
            if (touches_it) {
                // not by an edge, where another plate is as near
                f = foot_inside(c[own], c[next], q.middle, free.y, 1e-6);
                if (!f.on_face) return {};
            }
            // No way out is shorter than an overlap: one that frees the sphere from all plates is that of the deepest.
            const double allowed = touches_it ? tolerance : 0.0;
            if (!free.is_free_of(c, q.middle, normals, own, allowed)) return {};
            if (!is_free_beyond(free, strip, face, c, ahead, allowed)) return {};
            if (!touches_it) return false;
            std::array<double, 4> part;
            part.fill(0.25 * f.weights[2]);
            part[own] += f.weights[0], part[next] += f.weights[1];
            const std::size_t left = index(dir_.wrap(face - 1)), right = index(face);
            const double along_left = -dot(n, vec3{cosine_[left], sine_[left], 0.0}),
                         along_right = -dot(n, vec3{cosine_[right], sine_[right], 0.0});
            const std::array<std::int32_t, 4> node = nodes_of(strip, face);
            for (std::size_t i = 0; i < 4; ++i)
                out.add({node[i], n, part[i] * depth, i == 0 || i == 3 ? along_left : along_right, part[i]});
            return true;
        });
}

template <class X>
bool node_net<X>::is_free_beyond(const resting_sphere& s, int strip, int face, const corners& c, double ahead,
                                 double tolerance) const {
    const double low = s.y.z - s.r, high = s.y.z + s.r;
    const int first = low < c[0].z ? strip_at(low - drift(ahead)) : strip,
              last = high > c[3].z ? strip_at(high + drift(ahead)) : strip;
    const auto of = [&](int i) {
        for (int k = first; k <= last; ++k) {
            if ((i == face && k == strip) || before_quad(s.y, k, i, ahead) >= s.r) continue;
            if (!with_quad(k, i, ahead,
                           [&](const corners& corner, const quadrilateral& q, const quarter_normals& normals) {
                               return s.is_free_of(corner, q.middle, normals, 4, tolerance);
                           }))
                return false;
        }
        return true;
    };
    // past the plane through the axis and the node i, towards larger azimuths (m)
    const auto past = [&](int i) { return s.y.y * cosine_[index(i)] - s.y.x * sine_[index(i)]; };
    if (first < last && !of(face)) return false;
    for (int i = face; past(i) > -s.r;) {
        i = dir_.wrap(i + 1);
        if (i == face) break;
        if (!of(i)) return false;
    }
    for (int i = dir_.wrap(face - 1); i != face && past(i) < s.r; i = dir_.wrap(i - 1))
        if (!of(i)) return false;
    return true;
}

template <class X> bool node_net<X>::in_front(const vec3& x, double reach) const {
    return with_quad(strip_at(x.z), dir_.towards(x.x, x.y), 0.0,
                     [&](const corners& c, const quadrilateral& q, const quarter_normals& normals) {
                         const std::size_t k = place_among_quarters(c, q, x).quarter();
                         const double distance = dot(x - c[k], normals[k]);
                         return distance > 0.0 && distance < reach &&
                                foot_inside(c[k], c[(k + 1) % 4], q.middle, x, 0.0).on_face;
                     });
}

template <class X> void node_net<X>::place() {
    node_.resize(apothem_.size() + 2 * index(around_));
    corners_.resize(quads_.size());
    normals_.resize(quads_.size());
    for (int k = 0; k < rings_; ++k) {
        const double z = level(k);
        for (int i = 0; i < around_; ++i) {
            const std::size_t j = tile(k, i);
            at_[j] = {apothem_[j] * cosine_[index(i)], apothem_[j] * sine_[index(i)]};
            node_[j + index(around_)] = {at_[j].x, at_[j].y, z};
        }
    }
    for (int i = 0; i < around_; ++i) {
        vec3 &far_below = node_[index(i)], &far_above = node_[index((rings_ + 1) * around_ + i)];
        far_below = node_at(0, i), far_above = node_at(rings_ - 1, i);
        far_below.z -= beyond(), far_above.z += beyond();
    }
    per_spacing_ = 1.0 / spacing();
    for (int strip = -1; strip < rings_; ++strip) {
        const int low = std::max(strip, 0), high = std::min(strip + 1, rings_ - 1);
        double least = apothem_[tile(low, 0)];
        for (int i = 0; i < around_; ++i) {
            const int left = dir_.wrap(i - 1);
            quadrilateral& q = quads_[quad(strip, i)];
            const corners& c = corners_[quad(strip, i)] = corners_of(strip, i, 0.0);
            q = quadrilateral::of(c);
            normals_[quad(strip, i)] = normals_of_quarters(c, q.middle);
            q.least = std::min(std::min(apothem_[tile(low, left)], apothem_[tile(low, i)]),
                               std::min(apothem_[tile(high, left)], apothem_[tile(high, i)]));
            least = std::min(least, q.least);
            q.least *= flat_;
        }
        strip_least_[index(strip + 1)] = flat_ * least;
    }
    least_ = *std::min_element(strip_least_.begin(), strip_least_.end());
}

} // namespace clast::boundaries
