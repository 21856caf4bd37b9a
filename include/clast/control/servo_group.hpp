// SPDX-License-Identifier: MIT
// Servos of walls that share contacts, solved together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace clast::control {

/// Displacements x that would bring all walls of a group to their target forces at once: K x = e, with e the missing
/// force of each wall and K the stiffness of the contacts at fixed grains.
///
/// Two tiles that share a pebble near their seam pass its whole load to each other over a fraction of a micrometre. On
/// its own diagonal stiffness each of them would either chase the other for ever (stiffness underrated) or lag behind
/// its load (overrated). Together they move at once with the pebble and slowly against each other.
/// K is symmetric and positive definite; conjugate gradients with the diagonal as preconditioner solve it to 1e-6 of
/// the first residual or in 60 passes, whatever comes first. Walls that were not set keep displacement 0.
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
        residual_ = error_;
        multiply(x_);
        double rz = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            residual_[i] = diagonal_[i] > 0.0 ? error_[i] - product_[i] : 0.0;
            rz += diagonal_[i] > 0.0 ? residual_[i] * residual_[i] / diagonal_[i] : 0.0;
        }
        direction_.assign(n, 0.0);
        double first = rz, beta = 0.0;
        for (int pass = 0; pass < 60 && rz > 1e-12 * first && rz > 0.0; ++pass) {
            for (std::size_t i = 0; i < n; ++i)
                direction_[i] = (diagonal_[i] > 0.0 ? residual_[i] / diagonal_[i] : 0.0) + beta * direction_[i];
            multiply(direction_);
            double dq = 0.0;
            for (std::size_t i = 0; i < n; ++i) dq += direction_[i] * product_[i];
            if (!(dq > 0.0)) break;
            const double alpha = rz / dq;
            double next = 0.0;
            for (std::size_t i = 0; i < n; ++i) {
                if (diagonal_[i] <= 0.0) continue;
                x_[i] += alpha * direction_[i];
                residual_[i] -= alpha * product_[i];
                next += residual_[i] * residual_[i] / diagonal_[i];
            }
            beta = next / rz;
            rz = next;
        }
    }
    double displacement(std::size_t wall) const { return x_[wall]; }

  private:
    struct link {
        std::size_t a, b;
        double stiffness;
    };
    void multiply(const std::vector<double>& v) {
        product_.resize(v.size());
        for (std::size_t i = 0; i < v.size(); ++i) product_[i] = diagonal_[i] * v[i];
        for (const link& l : links_) product_[l.a] += l.stiffness * v[l.b], product_[l.b] += l.stiffness * v[l.a];
    }

    std::vector<double> diagonal_, error_, x_, residual_, direction_, product_;
    std::vector<link> links_;
};

} // namespace clast::control
