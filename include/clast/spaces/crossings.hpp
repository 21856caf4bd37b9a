// SPDX-License-Identifier: MIT
// The contacts of a list that go across the faces of a periodic cell.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <clast/bodies/contact_list.hpp>
#include <clast/core/parallel.hpp>
#include <clast/core/vector.hpp>
#include <clast/spaces/images.hpp>

namespace clast::spaces {

/// Walks along the contacts across faces while blocks of a list are evaluated, moves their second pebbles to the images
/// that are meant, and keeps their forces, whose work the moving faces do. `cursor`: where in them to go on.
class crossings {
  public:
    /// Finds them in a list. before(pair, pair): order of the list.
    template <class Order> void index(const pair_list& list, const execution& run, Order&& before) {
        row_ = run.where(list.size(), [&](std::size_t k) { return list.image[k] != no_shift; });
        force_.assign(row_.size(), {});
        image_.resize(row_.size());
        for (std::size_t a = 0; a < row_.size(); ++a) image_[a] = list.image[row_[a]];
        order_.resize(row_.size());
        std::iota(order_.begin(), order_.end(), 0U);
        const auto behind = std::lower_bound(row_.begin(), row_.end(), list.shared) - row_.begin();
        std::inplace_merge(
            order_.begin(), order_.begin() + behind, order_.end(),
            [&](std::uint32_t a, std::uint32_t b) { return before(list.pairs[row_[a]], list.pairs[row_[b]]); });
    }
    /// Sets the shifts (m) and relative velocities (m/s) of all images from the edges of the cell.
    void set(const vec3& edges, const vec3& edge_speeds) {
        for (std::size_t image = 0; image < shift_.size(); ++image) {
            shift_[image] = image_shift(image, edges);
            speed_[image] = image_shift(image, edge_speeds);
        }
    }
    /// The first one from a row of the list on.
    std::size_t from(std::size_t row) const {
        return static_cast<std::size_t>(std::lower_bound(row_.begin(), row_.end(), row) - row_.begin());
    }
    /// Operands of a block in a strip: second pebbles are where their images are, and move with them.
    template <class Strip, class Block>
    [[gnu::always_inline]] void adjust(std::size_t& cursor, Strip& s, const Block& block) const {
        each(cursor, block, [&](std::size_t a, std::size_t k) {
            const vec3 &by = shift_[image_[a]], &faster = speed_[image_[a]];
            s.dx[k] += by.x, s.dy[k] += by.y, s.dz[k] += by.z;
            s.vx[k] += faster.x, s.vy[k] += faster.y, s.vz[k] += faster.z;
        });
    }
    /// Keeps the forces of a block.
    template <class Strip, class Block>
    [[gnu::always_inline]] void take(std::size_t& cursor, const Strip& s, const Block& block) {
        each(cursor, block, [&](std::size_t a, std::size_t k) { force_[a] = {s.fx[k], s.fy[k], s.fz[k]}; });
    }
    /// Power (W) of the moving images on the grains.
    double power(const execution& run) const {
        return run.sum(row_.size(), 0.0, [&](std::size_t k) {
            const std::uint32_t a = order_[k];
            return dot(force_[a], speed_[image_[a]]);
        });
    }

  private:
    /// f(a, lane) for every one in a block.
    template <class Block, class F>
    [[gnu::always_inline]] void each(std::size_t& cursor, const Block& block, F&& f) const {
        for (; cursor < row_.size() && row_[cursor] < block.row + block.size; ++cursor)
            f(cursor, block.at + row_[cursor] - block.row);
    }

    std::vector<std::uint32_t> row_;         ///< in the list, ascending
    std::vector<std::uint8_t> image_;        ///< of their second pebbles
    std::vector<vec3> force_;                ///< on their first bodies (N)
    std::vector<std::uint32_t> order_;       ///< their numbers, in the order of one thread
    std::array<vec3, 27> shift_{}, speed_{}; ///< of the images (m, m/s)
};

/// Where there are no faces.
struct no_crossings {
    template <class Order> static void index(const pair_list&, const execution&, Order&&) {}
    static constexpr std::size_t from(std::size_t) { return 0; }
    template <class Strip, class Block> static constexpr void adjust(std::size_t&, Strip&, const Block&) {}
    template <class Strip, class Block> static constexpr void take(std::size_t&, const Strip&, const Block&) {}
};

} // namespace clast::spaces
