// SPDX-License-Identifier: MIT
// What a replacement policy sees of a clump whose loads are complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <clast/bonds/lattice.hpp>
#include <clast/core/vector.hpp>
#include <clast/criteria/concepts.hpp>
#include <clast/engine/grain_load.hpp>
#include <clast/engine/scene.hpp>
#include <clast/grains/shape.hpp>

namespace clast::rooms {

/// The members of replacements::view_archetype, for clump g of a scene in a step that keeps and indexes rows. Nothing
/// is found before it is asked for. Valid while the sweep is at this clump.
template <class S> class grain_view {
  public:
    grain_view(const S& s, std::size_t g) : s_(s), g_(g) {}

    std::int32_t grain() const { return static_cast<std::int32_t>(g_); }
    std::int64_t id() const { return one().id; }
    double strength_factor() const { return criteria::strength_factor_of(s_.settings.breakage, one().origin); }
    /// Of the criterion, under the forces just evaluated.
    double utilisation() const {
        std::vector<vec3> forces;
        return s_.settings.breakage.utilisation(load_of(s_, g_, forces));
    }
    std::vector<bonds::pebble_load> pebble_loads() const { return rooms::pebble_loads(s_, g_); }
    std::size_t neighbours() const {
        return neighbours_of(s_, g_, [](const acting_force&) {}).size();
    }
    const clast::shape& shape() const { return s_.grains.shape_of(one()); }
    bonds::likeness like() const { return {one().scale, one().density_ratio}; }
    const bonds::lattice& lattice() const requires S::breakable { return s_.broken.pools[s_.at(one().shape)].shape(); }
    const vec3& centre() const { return s_.grains.motion[g_].x; }
    const vec3& velocity() const { return s_.grains.motion[g_].v; }
    const vec3& spin() const { return s_.grains.motion[g_].w; }
    const quaternion& orientation() const { return s_.grains.turning[g_].q; }
    const auto& state() const requires(decltype(S::replacing)::remembers) { return s_.replacing.of_grain[g_]; }

  private:
    const clast::grain& one() const { return s_.grains.grains[g_]; }

    const S& s_;
    std::size_t g_;
};

} // namespace clast::rooms
