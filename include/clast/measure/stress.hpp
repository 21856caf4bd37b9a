// SPDX-License-Identifier: MIT
// Stress from contact forces, and how far bodies are from equilibrium.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <clast/boundaries/touch.hpp>
#include <clast/core/vector.hpp>

namespace clast::measure {

/// Calls f(force, branch, point) for every force that one body passes on to another or to a facet: force (N) on the
/// second partner, branch (m) from the first centre to the second centre, or to the point of the wall that takes the
/// force: branches that end elsewhere, at the surface of a pebble that reaches into the wall, would add the overlap to
/// the length of the specimen. Bonds of clusters are such forces, too.
template <class Engine, class F> void each_branch(const Engine& e, F&& f) {
    const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
    const auto& s = e.grains;
    e.each_contact([&](const auto& row, const auto& pair) {
        if (row.depth == 0.0) return;
        const auto& p = s.pebbles[at(pair.i)];
        f(-row.force, e.branch_of(row, pair), p.x + (p.radius - 0.5 * row.depth) * row.normal);
    });
    e.each_wall_row([&](const auto& w) {
        const auto& p = s.pebbles[at(w.pebble)];
        vec3 way = boundaries::lateral_push(w.touch); // out of all that it touches
        for (const boundaries::touch& t : w.touch) {
            const vec3 point = boundaries::point_on_wall(w.touch, t, p.x, p.radius);
            f(-w.share(t) * t.normal, point - e.centre_of(w.pebble), point);
            if (t.at_platen()) way += t.depth * t.normal;
        }
        if (norm2(w.friction) > 0.0) {
            const vec3 point = p.x + way - p.radius * unit(w.force - w.friction);
            f(-w.friction, point - e.centre_of(w.pebble), point);
        }
    });
    e.breakage().each_bond(s, [&](std::int32_t i, std::int32_t j, const auto& bond) {
        const vec3 xi = s.pebbles[at(i)].x, d = s.pebbles[at(j)].x - xi;
        f(-(bond.n * unit(d) + bond.v), d, xi + s.pebbles[at(i)].radius * unit(d));
    });
}

/// Love-Weber stress (Pa, compression positive) over a volume (m^3): (1/V) sum f (x) l over all branches.
template <class Engine> mat3 love_weber(const Engine& e, double volume) {
    mat3 sum;
    each_branch(e, [&](const vec3& force, const vec3& branch, const vec3&) { sum += outer(force, branch); });
    return (1.0 / volume) * sum;
}

/// Mean stress p' (Pa) in a measurement sphere: the branches whose contact point lies inside.
template <class Engine> double mean_stress_in_sphere(const Engine& e, const vec3& centre, double radius) {
    double sum = 0.0;
    each_branch(e, [&](const vec3& force, const vec3& branch, const vec3& point) {
        if (norm2(point - centre) < radius * radius) sum += dot(force, branch);
    });
    return sum / (4.0 * std::numbers::pi * radius * radius * radius); // trace / 3 over 4/3 pi R^3
}

/// How far from rest, how connected, how deep.
struct contact_state {
    double unbalanced_ratio = 0.0;      ///< max |F_unbalanced| over bodies / mean over bodies of sum |F_contact|
    double mean_contact_force = 0.0;    ///< N, over touching contacts, facets included
    double coordination = 0.0;          ///< touching neighbours per body
    double max_overlap_over_r = 0.0;    ///< largest, over the radius of the smaller pebble; platens and wall included
    double median_overlap_over_r = 0.0; ///< of the same
    double mean_overlap = 0.0;          ///< of touching pebbles (m)
    std::int64_t contacts = 0;          ///< touching pebble pairs
    double passing = 0.0;        ///< largest overlap over `passing_overlap`: two pebbles pass each other from 1 on
    std::int32_t passing_i = -1; ///< its pebbles
    std::int32_t passing_j = -1; ///< or at_platen, at_wall

    static constexpr std::int32_t at_platen = -1; ///< second partner of a contact that is no pebble
    static constexpr std::int32_t at_wall = -2;   ///< likewise: the lateral wall
};

/// Overlap (m) from which on a pebble counts as one that passes through what it touches, whatever that is: its radius,
/// and not less than half of the largest radius in its grain. A pebble that is smaller is a detail of its grain's
/// surface: once it is pressed in, the large one behind it takes the load, and how deep it has gone says nothing.
template <class Engine> double passing_overlap(const Engine& e, std::int32_t pebble) {
    const auto& s = e.grains;
    const auto own = s.pebbles_of(s.group_of(pebble));
    double largest = 0.0;
    for (std::size_t p = own.begin; p < own.end; ++p) largest = std::max(largest, s.pebbles[p].radius);
    return std::max(s.pebbles[static_cast<std::size_t>(pebble)].radius, 0.5 * largest);
}
/// The same for two pebbles: the larger of both. A small pebble may be inside a large one, whose centre it is far from
/// all the same: with this overlap centres are as far apart as the smaller radius, if both are large in their grains.
template <class Engine> double passing_overlap(const Engine& e, std::int32_t i, std::int32_t j) {
    return std::max(passing_overlap(e, i), passing_overlap(e, j));
}

namespace detail {
/// Collects the overlaps of touching contacts.
struct overlap_survey {
    std::vector<double> ratios;

    /// One overlap (m), over the radius (m) of the smaller pebble; `j` may be no pebble.
    template <class Engine>
    void add(const Engine& e, contact_state& c, double depth, double radius, std::int32_t i, std::int32_t j) {
        ratios.push_back(depth / radius);
        c.max_overlap_over_r = std::max(c.max_overlap_over_r, ratios.back());
        if (!(depth > c.passing * radius)) return; // the limit is a radius at least
        const double part = depth / (j >= 0 ? passing_overlap(e, i, j) : passing_overlap(e, i));
        if (part > c.passing) c.passing = part, c.passing_i = i, c.passing_j = j;
    }
    double median() {
        if (ratios.empty()) return 0.0;
        const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
        std::nth_element(ratios.begin(), middle, ratios.end());
        return *middle;
    }
};
} // namespace detail

/// Bodies here are clumps and fragments (bonded balls count as one).
template <class Engine> contact_state contacts_of(const Engine& e) {
    const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
    const auto& s = e.grains;
    const auto piece = [&](std::int32_t pebble) { return e.breakage().piece_of(s, pebble); };
    const std::size_t pieces = e.breakage().piece_count(s);
    std::vector<vec3> net(pieces);
    std::vector<double> sum(pieces, 0.0);
    std::vector<std::pair<std::size_t, std::size_t>> neighbours;
    contact_state c;
    detail::overlap_survey overlaps;
    double forces = 0.0;
    std::int64_t count = 0;
    e.each_contact([&](const auto& row, const auto& pair) {
        if (row.depth == 0.0) return;
        const std::size_t a = piece(pair.i), b = piece(pair.j);
        const double size = norm(row.force);
        net[a] += row.force, net[b] -= row.force;
        sum[a] += size, sum[b] += size;
        forces += size, ++count, ++c.contacts;
        c.mean_overlap += row.depth;
        if (a != b) neighbours.emplace_back(std::min(a, b), std::max(a, b));
        const double radius = std::min(s.pebbles[at(pair.i)].radius, s.pebbles[at(pair.j)].radius);
        overlaps.add(e, c, row.depth, radius, pair.i, pair.j);
    });
    e.each_wall_row([&](const auto& w) {
        if (w.touch.size == 0) return;
        const std::size_t a = piece(w.pebble);
        const double size = norm(w.force);
        net[a] += w.force, sum[a] += size;
        forces += size, ++count;
        const double radius = s.pebbles[at(w.pebble)].radius, way = norm(boundaries::lateral_push(w.touch));
        if (way > 0.0) overlaps.add(e, c, way, radius, w.pebble, contact_state::at_wall);
        for (const boundaries::touch& t : w.touch)
            if (t.at_platen()) overlaps.add(e, c, t.depth, radius, w.pebble, contact_state::at_platen);
    });
    e.each_outer_force([&](std::size_t b, const vec3& force) { net[b] += force; });
    double largest = 0.0, total = 0.0;
    std::size_t bodies = 0;
    const auto body = [&](std::size_t b) {
        largest = std::max(largest, norm(net[b]));
        total += sum[b];
        ++bodies;
    };
    for (std::size_t b = 0; b < s.body_count(); ++b)
        if (s.is_swept(b)) body(b);
    e.breakage().each_fragment(s, body);
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    c.unbalanced_ratio = total > 0.0 ? largest / (total / static_cast<double>(bodies)) : 0.0;
    if (c.contacts > 0) c.mean_overlap /= static_cast<double>(c.contacts);
    c.median_overlap_over_r = overlaps.median();
    c.mean_contact_force = count > 0 ? forces / static_cast<double>(count) : 0.0;
    c.coordination = bodies > 0 ? 2.0 * static_cast<double>(neighbours.size()) / static_cast<double>(bodies) : 0.0;
    return c;
}

} // namespace clast::measure
