// SPDX-License-Identifier: MIT
// Shapes of grains: templates of non-overlapping pebbles in their principal axes, with exact mass properties.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/core/symmetric.hpp>
#include <clast/core/vector.hpp>

namespace clast {

/// What "a grain of 2 cm" means. PFC's diameter of a clump, and so the paper's, is that of the ball of equal volume.
enum class size_reading : std::uint8_t {
    equivalent,    ///< diameter of the ball of the volume of the pebbles
    circumscribed, ///< diameter of the sphere around the mass centre that contains all pebbles
};
/// Nominal size of a grain: its d in F/d^2, in the inertial number, in the size effect and in sieve curves. A number
/// alone is the equivalent diameter; `circumscribed(0.02)` says the other reading.
struct grain_size {
    double diameter; ///< (m), positive
    size_reading reading = size_reading::equivalent;

    constexpr grain_size(double d, size_reading r = size_reading::equivalent) : diameter(d), reading(r) {}
};
constexpr grain_size circumscribed(double diameter) { return {diameter, size_reading::circumscribed}; }
constexpr grain_size equivalent(double diameter) { return {diameter, size_reading::equivalent}; }

/// One sphere of a shape.
struct shape_pebble {
    vec3 offset;         ///< centre, from the mass centre of the shape, in its principal axes (m)
    double radius = 0.0; ///< (m), positive
};

/// Two touching pebbles of a shape: where a bond is made when the clump becomes a bonded cluster.
struct shape_bond {
    std::int32_t a = 0; ///< index of the first pebble
    std::int32_t b = 0; ///< index of the second pebble, a < b
};

/// The template that all grains of one kind share: a rigid clump of pebbles. Make it with `make_shape` or
/// `shapes::...`, which keep the derived members consistent with the pebbles.
struct shape {
    std::string name;
    std::vector<shape_pebble> pebbles;
    std::vector<shape_bond> bonds;          ///< sorted by (a, b)
    std::vector<std::int32_t> bond_numbers; ///< of a part: what its bonds are called in the whole; empty: their places
    double volume = 0.0;                    ///< of the pebbles (m^3)
    double circumscribed_radius = 0.0;      ///< smallest sphere around the mass centre that contains all pebbles (m)
    double diameter = 0.0;                  ///< nominal, d, by the reading (m)
    size_reading reading = size_reading::equivalent;
    vec3 inertia_per_density;  ///< principal moments of inertia over density (m^5); equal ones are bit-equal
    quaternion to_input_frame; ///< turns principal axes into the axes in which the pebbles were given
    vec3 mass_centre;          ///< mass centre in the frame in which the pebbles were given (m)
    double phi_nominal = 0.0;  ///< sphericity that the source of the shape states; 0 where there is none
    bool overlapping = false;  ///< pebbles overlap: for grains that never break

    template <class A> void archive(A& a) {
        a(name, pebbles, bonds, bond_numbers, volume, circumscribed_radius, diameter, reading, inertia_per_density,
          to_input_frame, mass_centre, phi_nominal, overlapping);
    }
};

/// What a bond of a shape is called in reports: in a part what it was called in the whole.
inline std::int32_t number_of_bond(const shape& s, std::int32_t bond) {
    return s.bond_numbers.empty() ? bond : s.bond_numbers[static_cast<std::size_t>(bond)];
}

/// Moment of inertia of one solid sphere over density about its centre, (2/5)(4/3) pi r^5 (m^5).
constexpr double sphere_inertia_per_density(double radius) {
    return 8.0 / 15.0 * std::numbers::pi * radius * radius * radius * radius * radius;
}

/// Volume of a sphere, 4/3 pi r^3 (m^3).
constexpr double sphere_volume(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

/// Inertia tensor over density of solid spheres about the origin of their offsets (m^5), exact: parallel axes summed
/// over the pebbles, not a hull or a voxel value, so that replacing a clump by its balls keeps kinetic energy and
/// angular momentum to rounding.
inline mat3 inertia_tensor_per_density(const std::vector<shape_pebble>& pebbles) {
    mat3 sum;
    for (const shape_pebble& p : pebbles) {
        const double v = sphere_volume(p.radius);
        const double own = sphere_inertia_per_density(p.radius);
        sum += (own + v * norm2(p.offset)) * mat3::identity() + (-v) * outer(p.offset, p.offset);
    }
    return sum;
}

/// Number of connected pieces of the bond graph; 1 for a shape that holds together.
inline int pieces(const shape& s) {
    std::vector<std::size_t> root(s.pebbles.size());
    for (std::size_t i = 0; i < root.size(); ++i) root[i] = i;
    const auto find = [&root](std::size_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    int count = static_cast<int>(root.size());
    for (const shape_bond& bond : s.bonds) {
        const std::size_t a = find(static_cast<std::size_t>(bond.a));
        const std::size_t b = find(static_cast<std::size_t>(bond.b));
        if (a != b) root[std::max(a, b)] = std::min(a, b), --count;
    }
    return count;
}

/// Wadell sphericity pi^(1/3) (6 V)^(2/3) / A with V and A summed over the pebbles, which must not overlap: 1 for a
/// ball, n^(-1/3) for n equal pebbles. The hull of the pebbles is rounder; published sphericities of clumps usually
/// mean a smoothed surface.
inline double sphericity(const shape& s) {
    double area = 0.0;
    for (const shape_pebble& p : s.pebbles) area += 4.0 * std::numbers::pi * p.radius * p.radius;
    return std::cbrt(std::numbers::pi) * std::cbrt(36.0 * s.volume * s.volume) / area;
}

namespace detail {

struct principal_frame {
    quaternion to_input; ///< principal axes -> axes of the tensor
    int equal = 1;       ///< how many moments are equal: 1, 2 (the last two axes) or 3
};

/// Principal axes of a symmetric tensor. Axes that the tensor leaves free (equal moments) follow the given axes, and
/// signs are fixed, so that the same input gives the same frame with every eigenvalue solver.
inline principal_frame principal_axes(const mat3& tensor) {
    constexpr double same = 1e-9; // relative; far above rounding, far below any intended anisotropy
    const double size = trace(tensor) / 3.0;
    const double off = std::max({std::abs(tensor(0, 1)), std::abs(tensor(0, 2)), std::abs(tensor(1, 2))});
    const double spread =
        std::max({tensor(0, 0), tensor(1, 1), tensor(2, 2)}) - std::min({tensor(0, 0), tensor(1, 1), tensor(2, 2)});
    if (off <= same * size && spread <= same * size) return {{}, 3};

    square_matrix m(3);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) m(i, j) = tensor(static_cast<int>(i), static_cast<int>(j));
    const principal_system system = principal_values(m);
    const std::vector<double>& moment = system.values; // ascending
    const auto axis_of = [&](std::size_t k) { return vec3{system.axes(0, k), system.axes(1, k), system.axes(2, k)}; };
    const auto extreme = [](const vec3& v, bool largest) {
        int at = 0;
        for (int k = 1; k < 3; ++k)
            if (largest ? std::abs(v[k]) > std::abs(v[at]) : std::abs(v[k]) < std::abs(v[at])) at = k;
        return at;
    };
    const auto fix_sign = [&](const vec3& v) { return v[extreme(v, true)] < 0.0 ? -v : v; };
    const bool low = moment[1] - moment[0] <= same * size;
    const bool high = moment[2] - moment[1] <= same * size;
    int equal = 1;
    vec3 axis[3];
    if (low || high) {
        // a body of revolution: its axis comes first, the other two are the given axes as far as possible
        equal = 2;
        axis[0] = fix_sign(axis_of(low ? 2 : 0));
        vec3 given;
        given[extreme(axis[0], false)] = 1.0;
        axis[1] = unit(reject(given, axis[0]));
    } else {
        axis[0] = fix_sign(axis_of(0));
        axis[1] = fix_sign(axis_of(1));
    }
    axis[2] = cross(axis[0], axis[1]);
    return {turning(transpose(mat3{{axis[0], axis[1], axis[2]}})), equal};
}

inline void check_diameter(double diameter) {
    if (!(diameter > 0.0) || !std::isfinite(diameter))
        throw input_error("grain diameter", fmt::format("{} m", diameter), "positive and finite",
                          "Give it in metres, e.g. 0.02 (20 mm).");
}

/// Diameter of a shape in a reading (m). A single ball has one.
inline double diameter_of(const shape& s, size_reading reading) {
    if (reading == size_reading::circumscribed || s.pebbles.size() == 1) return 2.0 * s.circumscribed_radius;
    return std::cbrt(6.0 / std::numbers::pi * s.volume);
}
inline void read_size(shape& s, size_reading reading) {
    s.reading = reading;
    s.diameter = diameter_of(s, reading);
}

/// Volume (m^3), mass centre and, about that, inertia tensor over density (m^5).
struct solid {
    double volume = 0.0;
    vec3 centre;
    mat3 tensor;
};
/// Of the sum of pebbles, whose offsets become those from the mass centre.
inline solid sum_of(std::vector<shape_pebble>& pebbles) {
    solid s;
    vec3 moment;
    for (const shape_pebble& p : pebbles) {
        s.volume += sphere_volume(p.radius);
        moment += sphere_volume(p.radius) * p.offset;
    }
    s.centre = moment / s.volume;
    for (shape_pebble& p : pebbles) p.offset -= s.centre;
    s.tensor = inertia_tensor_per_density(pebbles);
    return s;
}
/// Takes pebbles whose offsets count from their mass centre, turns them to principal axes, and takes the mass
/// properties; inertia is found again from the pebbles where they say it all.
inline void complete(shape& s, std::vector<shape_pebble> pebbles, const solid& whole, bool by_pebbles = true) {
    s.volume = whole.volume;
    s.mass_centre = whole.centre;
    const principal_frame frame = principal_axes(whole.tensor);
    s.to_input_frame = frame.to_input;
    for (shape_pebble& p : pebbles) {
        if (frame.equal < 3) p.offset = rotate_back(frame.to_input, p.offset);
        s.circumscribed_radius = std::max(s.circumscribed_radius, norm(p.offset) + p.radius);
    }
    const mat3 tensor = inertia_tensor_per_density(pebbles), axes = transpose(matrix(frame.to_input)); // in rows
    vec3& inertia = s.inertia_per_density;
    for (int a = 0; a < 3; ++a) inertia[a] = by_pebbles ? tensor(a, a) : dot(axes.row[a], whole.tensor * axes.row[a]);
    // bit-equal moments let the integrator see an isotropic body without a tolerance
    if (frame.equal == 3) inertia.x = inertia.y = inertia.z = (inertia.x + inertia.y + inertia.z) / 3.0;
    if (frame.equal == 2) inertia.y = inertia.z = 0.5 * (inertia.y + inertia.z);
    s.pebbles = std::move(pebbles);
    read_size(s, s.reading);
}

/// Throws input_error for pebbles that are none, by the name of the shape.
inline void check_pebbles(const std::string& option, const std::vector<shape_pebble>& pebbles) {
    if (pebbles.empty())
        throw input_error(option, "no pebbles", "at least one pebble", "Give a centre and a radius for each pebble.");
    for (std::size_t i = 0; i < pebbles.size(); ++i) {
        const shape_pebble& p = pebbles[i];
        if (!is_finite(p.offset) || !(p.radius > 0.0) || !std::isfinite(p.radius))
            throw input_error(option,
                              fmt::format("pebble {}: {} {} {} {}", i, p.offset.x, p.offset.y, p.offset.z, p.radius),
                              "finite coordinates and a positive radius", "Correct this pebble (x y z r, in m).");
    }
}

} // namespace detail

/// Shape from pebbles in any frame (m): moves the origin to the mass centre, turns to principal axes (ascending
/// moments; a body of revolution has its axis first; an isotropic one keeps the given axes), finds the bonds (|gap| <
/// 1e-3 of the smallest radius) and the exact mass properties. Throws input_error if a radius is not positive, a number
/// is not finite, or two pebbles overlap by more than 1e-9 d. Pieces without a common bond are accepted: see `pieces`.
inline shape make_shape(std::string name, std::vector<shape_pebble> pebbles) {
    const std::string option = fmt::format("shape '{}'", name);
    detail::check_pebbles(option, pebbles);
    shape s;
    s.name = std::move(name);
    double smallest = std::numeric_limits<double>::infinity();
    for (const shape_pebble& p : pebbles) smallest = std::min(smallest, p.radius);
    const detail::solid whole = detail::sum_of(pebbles);
    detail::complete(s, std::move(pebbles), whole);
    const std::vector<shape_pebble>& all = s.pebbles;
    for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = a + 1; b < all.size(); ++b) {
            const double touching = all[a].radius + all[b].radius;
            const double distance = norm(all[b].offset - all[a].offset);
            const double gap = distance - touching;
            if (const double size = 2.0 * s.circumscribed_radius; gap < -1e-9 * size)
                throw input_error(
                    option, fmt::format("pebbles {} and {} overlap by {:.3g} m ({:.2g} of d)", a, b, -gap, -gap / size),
                    "pebbles that touch or are apart (tolerance 1e-9 of d = 2 R_circumscribed)",
                    fmt::format("Move them apart, or multiply their radii by {:.12g}; grains that never break may have "
                                "them (overlapping_shape; in the program triaxial: --replacement none).",
                                distance / touching));
            if (gap < 1e-3 * smallest) s.bonds.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)});
        }
    return s;
}

/// Shape of pebbles where they are, which may overlap (they count twice there, as everywhere), with these bonds. Pieces
/// that bonds do not hold together have none: it is one rigid body, but can never become a cluster. Not checked, unlike
/// make_shape.
inline shape rigid_shape(std::string name, std::vector<shape_pebble> pebbles, std::vector<shape_bond> bonds) {
    shape s;
    s.name = std::move(name);
    const detail::solid whole = detail::sum_of(pebbles);
    detail::complete(s, std::move(pebbles), whole);
    s.bonds = std::move(bonds);
    if (pieces(s) > 1) s.bonds.clear();
    return s;
}

/// The rigid_shape of a run of pebbles of another: pebbles first to first + count - 1, with their bonds among each
/// other. Its mass_centre and to_input_frame are seen from the principal axes of the whole. first + count is at most
/// the number of pebbles.
inline shape part_of(const shape& whole, std::size_t first, std::size_t count) {
    const auto begin = whole.pebbles.begin() + static_cast<std::ptrdiff_t>(first);
    const auto from = static_cast<std::int32_t>(first), end = static_cast<std::int32_t>(first + count);
    std::vector<shape_bond> bonds;
    for (const shape_bond& b : whole.bonds)
        if (from <= b.a && b.b < end) bonds.push_back({b.a - from, b.b - from});
    shape part = rigid_shape(fmt::format("{} [{}, {})", whole.name, first, first + count),
                             {begin, begin + static_cast<std::ptrdiff_t>(count)}, std::move(bonds));
    detail::read_size(part, whole.reading);
    return part;
}

/// A similar shape of f times the size. Throws input_error if f is not positive and finite.
inline shape scaled_by(shape s, double f) {
    detail::check_diameter(f * s.diameter);
    for (shape_pebble& p : s.pebbles) p.offset *= f, p.radius *= f;
    s.volume *= f * f * f;
    s.inertia_per_density *= f * f * f * f * f;
    s.mass_centre *= f;
    s.circumscribed_radius *= f;
    s.diameter *= f;
    return s;
}
/// The same shape with another nominal size. Throws input_error if that is not positive and finite.
inline shape scaled_to(shape s, grain_size size) {
    detail::check_diameter(size.diameter);
    detail::read_size(s, size.reading);
    s = scaled_by(std::move(s), size.diameter / s.diameter);
    s.diameter = size.diameter; // to the last digit
    if (size.reading == size_reading::circumscribed) s.circumscribed_radius = 0.5 * size.diameter;
    return s;
}

/// Ready-made shapes; those from files, and all by their names, are in clast/io/shapes.hpp. The paper
/// (DOI 10.1007/s10035-024-01441-3, section 4) names 14- and 4-ball particles of 2 cm and of nominal sphericity 0.86
/// and 0.71 but gives no coordinates; the two below are the natural non-overlapping packings.
namespace shapes {

/// One pebble: a single sphere; both readings of its size are the same.
inline shape sphere(grain_size size) {
    detail::check_diameter(size.diameter);
    shape s = make_shape("sphere", {{{}, 0.5 * size.diameter}});
    s.phi_nominal = 1.0;
    s.reading = size.reading;
    return s;
}

/// "4B": four equal touching pebbles at the corners of a regular tetrahedron, r = R_c / (1 + sqrt(3/2)), 6 bonds.
/// Isotropic inertia. A nominal size of 2 cm is R_c = 14.0 mm, or 10 mm in the circumscribed reading.
inline shape tetrahedron_4(grain_size size) {
    detail::check_diameter(size.diameter);
    if (size.reading == size_reading::equivalent) return scaled_to(tetrahedron_4(circumscribed(size.diameter)), size);
    const double big = 0.5 * size.diameter;
    const double r = big / (1.0 + std::sqrt(1.5));
    const double c = (big - r) / std::numbers::sqrt3;
    shape s = make_shape("4B", {{{c, c, c}, r}, {{c, -c, -c}, r}, {{-c, c, -c}, r}, {{-c, -c, c}, r}});
    s.phi_nominal = 0.71;
    detail::read_size(s, size.reading);
    return s;
}

/// "14B": octahedral Apollonian packing in a sphere: 6 pebbles r1 = R_c / (1 + sqrt 2) on the axes, and 8 in the
/// octants, each tangent to three big ones and to the circumscribed sphere; 12 + 24 = 36 bonds. Isotropic inertia. A
/// nominal size of 2 cm is R_c = 12.4 mm, or 10 mm in the circumscribed reading.
inline shape apollonian_14(grain_size size) {
    detail::check_diameter(size.diameter);
    if (size.reading == size_reading::equivalent) return scaled_to(apollonian_14(circumscribed(size.diameter)), size);
    const double big = 0.5 * size.diameter;
    const double r1 = big / (1.0 + std::numbers::sqrt2);
    const double axis = std::numbers::sqrt2 * r1;
    // |n s - c1| = r1 + r2 with s = R_c - r2, n = (1,1,1)/sqrt 3 and c1 = (axis, 0, 0) is linear in s
    const double sum = r1 + big;
    const double s = (sum * sum - axis * axis) / (2.0 * (sum - axis / std::numbers::sqrt3));
    const double r2 = big - s;
    const double c = s / std::numbers::sqrt3;
    std::vector<shape_pebble> pebbles = {{{axis, 0, 0}, r1},  {{-axis, 0, 0}, r1}, {{0, axis, 0}, r1},
                                         {{0, -axis, 0}, r1}, {{0, 0, axis}, r1},  {{0, 0, -axis}, r1}};
    for (const double x : {c, -c})
        for (const double y : {c, -c})
            for (const double z : {c, -c}) pebbles.push_back({{x, y, z}, r2});
    shape result = make_shape("14B", std::move(pebbles));
    result.phi_nominal = 0.86;
    detail::read_size(result, size.reading);
    return result;
}

} // namespace shapes

static_assert(std::is_trivially_copyable_v<shape_pebble> && std::is_trivially_copyable_v<shape_bond>);

} // namespace clast
