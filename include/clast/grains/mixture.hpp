// SPDX-License-Identifier: MIT
// What the grains of a specimen are: one shape or several with their shares, of one size each or by a sieve curve.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/core/vector.hpp>
#include <clast/grains/grading.hpp>
#include <clast/grains/shape.hpp>

namespace clast {

/// A shape of a mixture, its share of the mass, and of which rock it is.
struct mixture_part {
    shape form;
    double share = 1.0;         ///< > 0; shares of a mixture count in their sum
    std::uint8_t material = 0;  ///< number of the rock, for contacts::by_material
    double density_ratio = 1.0; ///< of its density over that of the specimen, > 0
};

/// A grain of a mixture that has no place yet.
struct mixture_grain {
    std::size_t part = 0; ///< of the mixture
    double scale = 1.0;   ///< its size over that of its shape
};
/// A grain of a mixture in its place.
struct placed_grain : mixture_grain {
    vec3 centre;  ///< mass centre (m)
    quaternion q; ///< turns the axes of the shape into those of the world
};

/// Shapes with shares of the mass, and a grading that all of them have. A shape alone is a mixture, too: all grains are
/// as large as the shape. With a grading only the proportions of shapes count.
class mixture {
  public:
    /// Throws input_error, here and below, if there is no shape, one has no pebble, or a share is not positive.
    mixture(shape one, grading sizes = {})
        : mixture(std::vector<mixture_part>{{std::move(one), 1.0}}, std::move(sizes)) {}
    explicit mixture(std::vector<mixture_part> parts, grading sizes = {})
        : parts_(std::move(parts)), sizes_(std::move(sizes)) {
        if (parts_.empty())
            throw input_error("grain", "no shape", "one shape or several", "Take shapes::tetrahedron_4(0.02).");
        double sum = 0.0;
        for (const mixture_part& p : parts_) {
            if (p.form.pebbles.empty())
                throw input_error("grain", "0", "a shape with pebbles", "Take shapes::tetrahedron_4(0.02).");
            if (!(p.share > 0.0 && std::isfinite(p.share)))
                throw input_error("share of shape '" + p.form.name + "'", fmt::format("{:g}", p.share),
                                  "above 0, finite", "Leave a shape out that has no share.");
            if (!(p.density_ratio > 0.0 && std::isfinite(p.density_ratio)))
                throw input_error("density ratio of shape '" + p.form.name + "'", fmt::format("{:g}", p.density_ratio),
                                  "above 0, finite", "1 is the density of the specimen.");
            sum += p.share;
        }
        for (mixture_part& p : parts_) p.share /= sum;
    }

    const std::vector<mixture_part>& parts() const { return parts_; }
    const grading& sizes() const { return sizes_; }
    const shape& form(const mixture_grain& g) const { return parts_[g.part].form; }
    double diameter(const mixture_grain& g) const { return g.scale * form(g).diameter; } ///< nominal (m)
    /// Of the pebbles of a grain (m^3).
    double volume(const mixture_grain& g) const { return g.scale * g.scale * g.scale * form(g).volume; }
    /// Radius of the circumscribed sphere (m).
    double reach(const mixture_grain& g) const { return g.scale * form(g).circumscribed_radius; }

    /// Nominal sizes of grains (m): the smallest, the largest, and the one that halves the mass.
    double smallest_diameter() const { return over_diameters(false); }
    double largest_diameter() const { return over_diameters(true); }
    double d50() const {
        if (!sizes_.empty()) return sizes_.size_at(0.5);
        double d = over_diameters(true); // the smallest one up to which half of the mass is
        for (const mixture_part& p : parts_) {
            double finer = 0.0;
            for (const mixture_part& o : parts_) finer += o.form.diameter <= p.form.diameter ? o.share : 0.0;
            if (finer >= 0.5) d = std::min(d, p.form.diameter);
        }
        return d;
    }
    /// Diameter of the largest sphere around a grain (m).
    double largest_circumscribed() const {
        double d = 0.0;
        for (const mixture_part& p : parts_) {
            const double scale = sizes_.empty() ? 1.0 : sizes_.largest() / p.form.diameter;
            d = std::max(d, 2.0 * scale * p.form.circumscribed_radius);
        }
        return d;
    }
    /// Radii of pebbles (m): the smallest and the largest.
    double smallest_radius() const { return over_radii(false); }
    double largest_radius() const { return over_radii(true); }

    /// Grains that have a volume of pebbles (m^3) among them, from the largest to the smallest: as near as whole grains
    /// get to it, to the shares of shapes and to the grading (grading::sizes).
    std::vector<mixture_grain> grains_of(double volume) const {
        double lightness = 0.0; // volume of a unit of mass: lighter rocks fill more room
        for (const mixture_part& p : parts_) lightness += p.share / p.density_ratio;
        std::vector<std::vector<double>> scales(parts_.size()); // of each shape, falling
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const shape& s = parts_[k].form;
            const double own = parts_[k].share / parts_[k].density_ratio / lightness * volume, d = s.diameter;
            if (sizes_.empty()) {
                scales[k].assign(static_cast<std::size_t>(std::llround(own / s.volume)), 1.0);
            } else {
                scales[k] = sizes_.sizes(own, s.volume / (d * d * d));
                for (double& size : scales[k]) size /= d;
            }
        }
        std::vector<mixture_grain> all;
        std::vector<std::size_t> next(parts_.size());
        while (true) { // the largest of those that come next
            std::size_t most = parts_.size();
            for (std::size_t k = 0; k < parts_.size(); ++k)
                if (next[k] < scales[k].size() &&
                    (most == parts_.size() ||
                     diameter({k, scales[k][next[k]]}) > diameter({most, scales[most][next[most]]})))
                    most = k;
            if (most == parts_.size()) return all;
            all.push_back({most, scales[most][next[most]++]});
        }
    }

  private:
    double over_diameters(bool largest) const {
        if (!sizes_.empty()) return largest ? sizes_.largest() : sizes_.smallest();
        double d = parts_.front().form.diameter;
        for (const mixture_part& p : parts_) d = largest ? std::max(d, p.form.diameter) : std::min(d, p.form.diameter);
        return d;
    }
    double over_radii(bool largest) const {
        double r = largest ? 0.0 : std::numeric_limits<double>::infinity();
        for (const mixture_part& p : parts_) {
            const double scale = sizes_.empty() ? 1.0 : over_diameters(largest) / p.form.diameter;
            for (const shape_pebble& one : p.form.pebbles)
                r = largest ? std::max(r, scale * one.radius) : std::min(r, scale * one.radius);
        }
        return r;
    }

    std::vector<mixture_part> parts_;
    grading sizes_;
};

/// Sizes that walls and speeds have to suit (m).
struct grain_sizes {
    double d50 = 0.0;                   ///< nominal diameter of a grain that halves the mass
    double largest_circumscribed = 0.0; ///< diameter of the largest sphere around a grain
    double smallest_radius = 0.0;       ///< of a pebble
    double largest_radius = 0.0;        ///< of a pebble
};
inline grain_sizes sizes_of(const mixture& m) {
    return {m.d50(), m.largest_circumscribed(), m.smallest_radius(), m.largest_radius()};
}

} // namespace clast
