// SPDX-License-Identifier: MIT
// Dense packings for benchmarks, of any size, made in about a second: 1000 spheres (or 216 clumps) are compressed
// without friction in a periodic cell to a given stress, and the cell is then repeated along the three axes. Spheres
// (radii 1 cm +-5 %) at 2 MPa and k_n = 1e7 N/m come to phi = 0.64 to 0.65.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <type_traits>
#include <utility>

#include <clast/bodies/spheres.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/criteria/none.hpp>
#include <clast/engine/engine.hpp>
#include <clast/grains/shape.hpp>
#include <clast/replacements/none.hpp>
#include <clast/spaces/periodic.hpp>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace kernels {

struct spheres : clast::triaxial_policies_default {
    using body = clast::bodies::spheres;
    using boundary = clast::boundaries::none;
    using space = clast::spaces::periodic;
    using breakage = clast::criteria::none;
    using replacement = clast::replacements::none;
};
struct clumps : spheres {
    using body = clast::bodies::clumps;
};

/// Bytes that the program holds on the heap; 0 where the C library does not tell.
inline double heap_in_use() {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
#else
    return 0.0;
#endif
}

struct request {
    double stress = 2e6;  ///< to which the packing is compressed (Pa)
    double damping = 0.3; ///< in the run that is measured
    int threads = 1;
};

inline constexpr clast::contacts::linear law{1e7, 5e6, 0.3};
inline const clast::vec3 shear{0.7, 0.7, -1.4}; ///< rates of extension (1/s): I is about 1e-3

template <class P>
clast::engine<P> make_engine(typename P::body grains, const clast::vec3& edges, const clast::vec3& rates,
                             const request& wanted) {
    clast::spaces::periodic cell(edges);
    for (std::size_t a = 0; a < 3; ++a) cell.axes[a].rate = rates[static_cast<int>(a)];
    return clast::engine<P>({.grain_contact = law,
                             .platen_contact = law,
                             .lateral_contact = law,
                             .breakage = {},
                             .replacement = {},
                             .scheme = {.damping = wanted.damping},
                             .run = clast::execution(wanted.threads)},
                            std::move(grains), cell);
}

/// Compresses grains on a cubic lattice, side^3 in number: one by one, then all together towards the stress.
template <class P, class Add> clast::engine<P> compressed(typename P::body grains, int side, double gap, Add&& add) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int k = 0; k < side * side * side; ++k) {
        const auto at = [&](int i) { return gap * (i - 0.5 * (side - 1)) + 1e-4 * u(random); };
        add(grains, clast::vec3{at(k % side), at(k / side % side), at(k / side / side)}, random);
    }
    constexpr double fast = 4.0; // 1/s
    request calm;
    calm.damping = 0.5;
    clast::engine<P> e =
        make_engine<P>(std::move(grains), {gap * side, gap * side, gap * side}, {-fast, -fast, -fast}, calm);
    e.set_friction(0.0);
    for (auto& axis : e.space.axes) axis.target = calm.stress, axis.max_rate = fast;
    for (int rounds = 0; rounds < 100; ++rounds) {
        e.step(200);
        const clast::vec3 off = e.space.stress() / calm.stress - clast::vec3{1.0, 1.0, 1.0};
        if (rounds > 10 && clast::norm(off) < 0.02) break;
    }
    return e;
}
inline const clast::engine<spheres>& base_of_spheres() {
    static const clast::engine<spheres> e =
        compressed<spheres>({}, 10, 0.0212, [](auto& s, const clast::vec3& x, std::mt19937& random) {
            s.add(x, 0.01 * std::uniform_real_distribution<double>(0.95, 1.05)(random));
        });
    return e;
}
/// pebbles: 4 or 14.
inline const clast::engine<clumps>& base_of_clumps(int pebbles) {
    static std::map<int, clast::engine<clumps>> made;
    if (const auto found = made.find(pebbles); found != made.end()) return found->second;
    clast::bodies::clumps grains;
    grains.shapes.push_back(pebbles == 4 ? clast::shapes::tetrahedron_4(clast::circumscribed(0.02))
                                         : clast::shapes::apollonian_14(clast::circumscribed(0.02)));
    return made
        .emplace(
            pebbles,
            compressed<clumps>(
                std::move(grains), 6, 0.0205,
                [](auto& s, const clast::vec3& x, std::mt19937& random) {
                    std::normal_distribution<double> any;
                    s.add(0, x, clast::unit(clast::quaternion{any(random), any(random), any(random), any(random)}));
                }))
        .first->second;
}

/// copies^3 times the base, in pure shear.
template <class P> clast::engine<P> repeated(const clast::engine<P>& base, int copies, const request& wanted) {
    const clast::vec3 edges = base.space.edges();
    typename P::body grains;
    grains.density = base.grains.density;
    if constexpr (P::body::turns) grains.shapes = base.grains.shapes;
    for (int block = 0; block < copies * copies * copies; ++block) {
        const auto at = [&](int i) { return i - 0.5 * (copies - 1); };
        const clast::vec3 shift =
            clast::scale(edges, {at(block % copies), at(block / copies % copies), at(block / copies / copies)});
        for (std::size_t b = 0; b < base.grains.body_count(); ++b) {
            const clast::vec3 x = base.grains.centre(b) + shift, flow = clast::scale(shear, x);
            if constexpr (P::body::turns) {
                const auto g = static_cast<std::size_t>(grains.add(0, x, base.grains.turning[b].q));
                grains.motion[g].v = flow;
            } else {
                const auto p = static_cast<std::size_t>(grains.add(x, base.grains.bounding_radius(b)));
                grains.pebbles[p].v = flow;
            }
        }
    }
    clast::engine<P> e = make_engine<P>(std::move(grains), static_cast<double>(copies) * edges, shear, wanted);
    e.step(20);
    return e;
}

} // namespace kernels
