// SPDX-License-Identifier: MIT
// One triaxial test in one kind of membrane, from a specimen that all kinds share, and how well the membrane keeps its
// balance along the axis: between the bottom and a section z it may pass on sigma_3 (A(z) - A_bottom) and nothing else.
// Prints a line of JSON.
//
// For the cost of a step: --keep FILE saves the state of the end; --from FILE --steps N goes N steps from there, in the
// function steps_to_count, and does nothing else.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/stepped_tiles.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/io/checkpoint.hpp>
#include <clast/io/packing.hpp>
#include <clast/io/shapes.hpp>
#include <clast/measure/digest.hpp>
#include <clast/protocol/triaxial.hpp>

using namespace clast;

namespace {

struct call {
    std::string membrane, shape = "4B", packing, save, keep, from;
    double scale = 0.3, strain = 0.25, inertial_number = 1e-3;
    int rings = 0, around = 10;
    std::int64_t steps = 200;
    std::uint64_t seed = 1;
};

template <class B> struct policies : triaxial_policies_default {
    using breakage = criteria::none;
    using replacement = replacements::none;
    using boundary = B;
};

/// What one state of a specimen says of its membrane.
struct balance {
    double bottom = 0.0, top = 0.0; ///< forces of the platens (N)
    double bottom_area = 0.0, top_area = 0.0;
    double worst = 0.0;                              ///< largest imbalance over sections, over F
    double unequal = 0.0;                            ///< |F_top - F_bottom - sigma_3 (A_top - A_bottom)| / F
    double q = 0.0, q_contacts = 0.0, sigma_3 = 0.0; ///< Pa
};

template <class Test> balance balance_of(const Test& test, int sections) {
    const auto& sim = test.sim();
    const auto& b = sim.boundary;
    const auto loads = sim.loads();
    balance out;
    out.bottom = loads[0].force, out.top = loads[1].force;
    const double low = b.bottom(), h = b.height(), eps = 1e-9 * h;
    out.bottom_area = b.end_section(0), out.top_area = b.end_section(1);
    out.sigma_3 = b.lateral_stress(loads);
    std::vector<double> up(static_cast<std::size_t>(sections), 0.0); // vertical force of the membrane, slice by slice
    sim.each_wall_row([&](const auto& w) {
        const auto& p = sim.grains.pebbles[static_cast<std::size_t>(w.pebble)];
        for (const auto& t : w.touch) {
            if (t.at_platen()) continue;
            const double z = p.x.z - p.radius * t.normal.z, share = std::clamp((z - low) / h, 0.0, 1.0 - 1e-12);
            up[static_cast<std::size_t>(share * sections)] += w.share(t) * t.normal.z;
        }
    });
    const double force = 0.5 * (out.bottom + out.top);
    double sum = 0.0;
    for (int k = 0; k + 1 < sections; ++k) {
        sum += up[static_cast<std::size_t>(k)];
        const double z = low + h * (k + 1) / sections;
        const double area = 0.5 * (b.section_at(z - eps) + b.section_at(z + eps));
        out.worst = std::max(out.worst, std::abs(sum - out.sigma_3 * (area - out.bottom_area)) / force);
    }
    out.unequal = std::abs(out.top - out.bottom - out.sigma_3 * (out.top_area - out.bottom_area)) / force;
    out.q = boundaries::deviator(b, loads);
    const mat3 lw = measure::love_weber(sim, b.volume());
    out.q_contacts = lw(2, 2) - 0.5 * (lw(0, 0) + lw(1, 1));
    return out;
}

template <class Test> struct watch : observer {
    Test* test = nullptr;
    int sections = 1;
    double last = 0.0;      ///< strain of the end
    balance isotropic, end; // end: mean over the last fifth
    double worst_q = 0.0, error = 0.0, volumetric = 0.0, residual = 0.0, overlap = 0.0, peak = 0.0, rms = 0.0;
    int rows = 0;
    std::int64_t steps = 0;
    double seconds = 0.0;
    std::vector<double> shape; ///< mean radius by height at the end (m)
    std::vector<std::array<double, 5>> curve;
    std::chrono::steady_clock::time_point began;

    void on_stage(const std::string& name, bool begins) override {
        if (name == "consolidate" && !begins) isotropic = balance_of(*test, sections);
        if (name == "shear" && begins) began = std::chrono::steady_clock::now(), steps = -test->sim().totals().steps;
        if (name == "shear" && !begins) {
            seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
            steps += test->sim().totals().steps;
            const auto& b = test->sim().boundary;
            for (int k = 0; k < 10; ++k)
                shape.push_back(std::sqrt(b.section_at(b.bottom() + b.height() * (k + 0.5) / 10) / std::numbers::pi));
        }
    }
    void on_row(const sample& s) override {
        if (s.stage != "shear") return;
        const balance now = balance_of(*test, sections);
        peak = std::max(peak, now.q);
        overlap = std::max(overlap, s.max_overlap_over_r);
        residual = s.energy_residual;
        curve.push_back({s.axial_strain, now.q, now.q_contacts, s.volumetric_strain, now.worst});
        if (s.axial_strain < 0.8 * last) return;
        ++rows;
        end.worst += now.worst, end.unequal += now.unequal, end.q += now.q, end.q_contacts += now.q_contacts;
        end.bottom += now.bottom, end.top += now.top, end.sigma_3 += now.sigma_3;
        worst_q = std::max(worst_q, std::abs(now.q - now.q_contacts) / now.q_contacts);
        error += s.confining_error, volumetric = s.volumetric_strain;
        rms += test->sim().boundary.confining_rms(test->sim().loads(), s.sigma_3);
    }
};

/// For tools that count the instructions of one function.
template <class Test> [[gnu::noinline]] void steps_to_count(Test& test, std::int64_t steps) { test.sim().step(steps); }

/// Goes some steps from a state that was kept, and says what the wall had to do in the last of them.
template <class Test> int go_on(Test& test, const call& c) {
    load_checkpoint(c.from, c.membrane, test);
    steps_to_count(test, c.steps);
    std::size_t rows = 0, touching = 0, touches = 0;
    test.sim().each_wall_row([&](const auto& w) {
        ++rows, touching += w.touch.size > 0, touches += static_cast<std::size_t>(w.touch.size);
    });
    fmt::print("{{\"membrane\": \"{}\", \"steps\": {}, \"pebbles_at_wall\": {}, \"touching\": {}, \"touches\": {}, "
               "\"digest\": \"{:016x}\"}}\n",
               c.membrane, c.steps, rows, touching, touches, measure::digest(test.sim()));
    return 0;
}

template <class B> int run(const call& c) {
    const double diameter = 0.3 * c.scale, height = 0.7 * c.scale;
    using test_type = triaxial_test<policies<B>>;
    const mixture grain = shapes::by_name(c.shape, circumscribed(0.02));
    const auto setup = [&](protocol::packing packing) {
        return triaxial_setup<policies<B>>{.grain = grain,
                                           .diameter = quantities::length{diameter},
                                           .height = quantities::length{height},
                                           .confining = quantities::stress{2e6},
                                           .breakage = {},
                                           .replacement = {},
                                           .packing = std::move(packing),
                                           .rings = c.rings > 0 ? c.rings : static_cast<int>(std::lround(36 * c.scale)),
                                           .tiles_per_ring = c.around,
                                           .materials = table_1::of_pieces(),
                                           .inertial_number = c.inertial_number,
                                           .seed = c.seed,
                                           .rows = 500};
    };
    if (!c.save.empty()) { // prepare only
        test_type test(setup({}), protocol::preparation());
        observer silent;
        test.run(silent);
        write_packing(c.save, test.sim().grains);
        return 0;
    }
    std::vector<stage> stages{protocol::consolidation(), protocol::shear(quantities::ratio{c.strain})};
    test_type test(setup(c.packing.empty() ? protocol::packing{} : read_packing(c.packing, grain)),
                   c.packing.empty() ? protocol::triaxial_compression(quantities::ratio{c.strain}) : stages);
    if (!c.from.empty()) return go_on(test, c);
    watch<test_type> w;
    w.test = &test, w.last = c.strain, w.sections = std::max(test.setup().rings, 2);
    test.run(w);
    if (!c.keep.empty()) save_checkpoint(c.keep, c.membrane, test);
    const double n = std::max(w.rows, 1);
    fmt::print("{{\"membrane\": \"{}\", \"shape\": \"{}\", \"scale\": {}, \"seed\": {}, \"grains\": {}, \"rings\": {}, "
               "\"around\": {}, \"I\": {}, \"isotropic_worst\": {:.5f}, \"isotropic_unequal\": {:.5f}, \"worst\": "
               "{:.5f}, \"unequal\": "
               "{:.5f}, \"q_MPa\": {:.4f}, \"q_contacts_MPa\": {:.4f}, \"largest_q_difference\": {:.4f}, "
               "\"peak_q_MPa\": {:.4f}, "
               "\"volumetric\": {:.5f}, \"confining_error\": {:.6f}, \"confining_rms\": {:.4f}, \"residual\": {:.5f}, "
               "\"overlap\": {:.3f}, "
               "\"steps\": {}, \"microseconds_per_step\": {:.2f}, \"radius_mm\": [",
               c.membrane, c.shape, c.scale, c.seed, test.sim().grains.grain_count(), test.setup().rings, c.around,
               c.inertial_number, w.isotropic.worst, w.isotropic.unequal, w.end.worst / n, w.end.unequal / n,
               1e-6 * w.end.q / n, 1e-6 * w.end.q_contacts / n, w.worst_q, 1e-6 * w.peak, w.volumetric, w.error / n,
               w.rms / n, w.residual, w.overlap, w.steps,
               1e6 * w.seconds / static_cast<double>(std::max<std::int64_t>(w.steps, 1)));
    for (std::size_t k = 0; k < w.shape.size(); ++k) fmt::print("{}{:.2f}", k > 0 ? ", " : "", 1e3 * w.shape[k]);
    fmt::print("], \"curve\": [");
    for (std::size_t k = 0; k < w.curve.size(); k += 10)
        fmt::print("{}[{:.4f}, {:.4f}, {:.4f}, {:.5f}, {:.4f}]", k > 0 ? ", " : "", w.curve[k][0], 1e-6 * w.curve[k][1],
                   1e-6 * w.curve[k][2], w.curve[k][3], w.curve[k][4]);
    fmt::print("]}}\n");
    return 0;
}

} // namespace

int main(int count, char** words) {
    call c;
    for (int k = 1; k + 1 < count; k += 2) {
        const std::string option = words[k], value = words[k + 1];
        if (option == "--membrane") c.membrane = value;
        if (option == "--shape") c.shape = value;
        if (option == "--packing") c.packing = value;
        if (option == "--save") c.save = value;
        if (option == "--keep") c.keep = value;
        if (option == "--from") c.from = value;
        if (option == "--steps") c.steps = std::atoll(value.c_str());
        if (option == "--scale") c.scale = std::atof(value.c_str());
        if (option == "--strain") c.strain = std::atof(value.c_str());
        if (option == "--inertial-number") c.inertial_number = std::atof(value.c_str());
        if (option == "--rings") c.rings = std::atoi(value.c_str());
        if (option == "--around") c.around = std::atoi(value.c_str());
        if (option == "--seed") c.seed = static_cast<std::uint64_t>(std::atoll(value.c_str()));
    }
    try {
        if (c.membrane == "solid") return run<boundaries::solid_strips>(c);
        if (c.membrane == "tiles") return run<boundaries::tiles>(c);
        if (c.membrane == "rings") return run<boundaries::ring_walls>(c);
        if (c.membrane == "stepped") return run<boundaries::stepped_tiles>(c);
        throw input_error("--membrane", c.membrane, "tiles, rings, solid, stepped", "Take one of these.");
    } catch (const input_error& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 2;
    } catch (const run_error& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 3;
    }
}
