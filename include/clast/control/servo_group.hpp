// SPDX-License-Identifier: MIT
// Servos of walls that share contacts, solved together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace clast::control {

/// Displacements x that would bring all walls of a group to their target forces at once: K x = e, with e the missing
/// force of each wall and K the stiffness of the contacts at fixed grains.
///
/// Two tiles that share a pebble near their seam pass its whole load to each other over a fraction of a micrometre. On
/// its own diagonal stiffness each of them would either chase the other for ever (stiffness underrated) or lag behind
/// its load (overrated). Together they move at once with the pebble and slowly against each other.
/// K is symmetric and positive definite, and falls into blocks of walls that hang together, mostly two or three tiles.
/// Conjugate gradients with the diagonal as preconditioner solve each of them to 1e-6 of its first residual or in 60
/// passes, whatever comes first: a block of n walls needs about n passes. Walls that were not set keep displacement 0.
class servo_group {
  public:
    /// n walls, none set, none coupled.
    void reset(std::size_t n) {
        diagonal_.assign(n, 0.0);
        error_.assign(n, 0.0);
        x_.assign(n, 0.0);
        links_.clear();
    }
    /// Missing force (N) and stiffness (N/m, > 0) of a wall.
    void set(std::size_t wall, double missing_force, double stiffness) {
        error_[wall] = missing_force;
        diagonal_[wall] = stiffness;
    }
    /// Adds an off-diagonal stiffness (N/m). Of two facets of one wall it belongs on the diagonal, twice.
    void couple(std::size_t a, std::size_t b, double stiffness) {
        if (a == b)
            diagonal_[a] += 2.0 * stiffness;
        else
            links_.push_back({a, b, stiffness});
    }
    void solve() {
        const std::size_t n = diagonal_.size();
        for (std::size_t i = 0; i < n; ++i) x_[i] = diagonal_[i] > 0.0 ? error_[i] / diagonal_[i] : 0.0;
        std::erase_if(links_, [&](const link& l) { return diagonal_[l.a] <= 0.0 || diagonal_[l.b] <= 0.0; });
        if (links_.empty()) return;
        sort_by_block();
        set_up();
        for (std::size_t row = 0; row < wall_of_.size();) {
            const std::size_t first = row, block = block_of_[wall_of_[row]];
            while (row < wall_of_.size() && block_of_[wall_of_[row]] == block) ++row;
            iterate(first, row);
        }
        for (std::size_t r = 0; r < wall_of_.size(); ++r) x_[wall_of_[r]] = rows_.x[r];
    }
    double displacement(std::size_t wall) const { return x_[wall]; }

  private:
    struct link {
        std::size_t a, b;
        double stiffness;
    };
    /// Equations of the coupled walls, block after block.
    struct equations {
        struct entry {
            std::size_t column;
            double stiffness;
        };
        std::vector<double> diagonal, error, x, residual, direction, product;
        std::vector<std::size_t> start; ///< first entry, and the end
        std::vector<entry> entries;     ///< off the diagonal
    };

    /// The first wall of a block, from any of its walls.
    std::size_t block_of(std::size_t wall) {
        while (block_of_[wall] != wall) wall = block_of_[wall] = block_of_[block_of_[wall]];
        return wall;
    }
    /// Finds the blocks, and a row for each coupled wall.
    void sort_by_block() {
        const std::size_t n = diagonal_.size();
        block_of_.resize(n);
        std::iota(block_of_.begin(), block_of_.end(), std::size_t{0});
        links_of_.assign(n, 0);
        for (const link& l : links_) {
            ++links_of_[l.a], ++links_of_[l.b];
            const std::size_t a = block_of(l.a), b = block_of(l.b);
            block_of_[std::max(a, b)] = std::min(a, b);
        }
        first_row_.assign(n + 1, 0); // of each block, then of what is left of it
        for (std::size_t i = 0; i < n; ++i) {
            block_of_[i] = block_of(i);
            if (links_of_[i] > 0) ++first_row_[block_of_[i] + 1];
        }
        std::partial_sum(first_row_.begin(), first_row_.end(), first_row_.begin());
        wall_of_.resize(first_row_[n]);
        row_of_.resize(n);
        for (std::size_t i = 0; i < n; ++i)
            if (links_of_[i] > 0) wall_of_[row_of_[i] = first_row_[block_of_[i]]++] = i;
    }
    void set_up() {
        const std::size_t n = wall_of_.size();
        equations& e = rows_;
        for (std::vector<double>* v : {&e.diagonal, &e.error, &e.x, &e.residual, &e.product}) v->resize(n);
        e.direction.assign(n, 0.0);
        e.start.assign(n + 1, 0);
        for (std::size_t r = 0; r < n; ++r) {
            const std::size_t wall = wall_of_[r];
            e.diagonal[r] = diagonal_[wall], e.error[r] = error_[wall], e.x[r] = x_[wall];
            e.start[r + 1] = e.start[r] + links_of_[wall];
        }
        e.entries.resize(e.start[n]);
        for (const link& l : links_) { // from the last entry of a row to the first
            const std::size_t a = row_of_[l.a], b = row_of_[l.b];
            e.entries[e.start[a] + --links_of_[l.a]] = {b, l.stiffness};
            e.entries[e.start[b] + --links_of_[l.b]] = {a, l.stiffness};
        }
    }
    /// Conjugate gradients in one block, from the displacements that walls would take on their own.
    void iterate(std::size_t first, std::size_t behind) {
        equations& e = rows_;
        multiply(first, behind, e.x);
        double rz = 0.0;
        for (std::size_t r = first; r < behind; ++r) {
            e.residual[r] = e.error[r] - e.product[r];
            rz += e.residual[r] * e.residual[r] / e.diagonal[r];
        }
        const double at_first = rz;
        double beta = 0.0;
        for (int pass = 0; pass < 60 && rz > 1e-12 * at_first && rz > 0.0; ++pass) {
            for (std::size_t r = first; r < behind; ++r)
                e.direction[r] = e.residual[r] / e.diagonal[r] + beta * e.direction[r];
            multiply(first, behind, e.direction);
            double dq = 0.0;
            for (std::size_t r = first; r < behind; ++r) dq += e.direction[r] * e.product[r];
            if (!(dq > 0.0)) break;
            const double alpha = rz / dq;
            double next = 0.0;
            for (std::size_t r = first; r < behind; ++r) {
                e.x[r] += alpha * e.direction[r];
                e.residual[r] -= alpha * e.product[r];
                next += e.residual[r] * e.residual[r] / e.diagonal[r];
            }
            beta = next / rz;
            rz = next;
        }
    }
    void multiply(std::size_t first, std::size_t behind, const std::vector<double>& v) {
        for (std::size_t r = first; r < behind; ++r) {
            double force = rows_.diagonal[r] * v[r];
            for (std::size_t k = rows_.start[r]; k < rows_.start[r + 1]; ++k)
                force += rows_.entries[k].stiffness * v[rows_.entries[k].column];
            rows_.product[r] = force;
        }
    }

    std::vector<double> diagonal_, error_, x_; ///< per wall
    std::vector<link> links_;
    std::vector<std::size_t> block_of_, row_of_, links_of_; ///< per wall
    std::vector<std::size_t> first_row_;                    ///< per block, named by its first wall
    std::vector<std::size_t> wall_of_;                      ///< per row
    equations rows_;
};

} // namespace clast::control
