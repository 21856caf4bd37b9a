// SPDX-License-Identifier: MIT
// A whole triaxial test of the paper, made from a few strong quantities: what most users start from.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <clast/boundaries/vessel_settings.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/core/errors.hpp>
#include <clast/core/quantity.hpp>
#include <clast/engine/engine.hpp>
#include <clast/grains/mixture.hpp>
#include <clast/protocol/packing.hpp>
#include <clast/protocol/preparation.hpp>
#include <clast/protocol/runner.hpp>
#include <clast/protocol/stage.hpp>

namespace clast {

/// Stiffness and friction of the pieces after Table 1 of the paper; a contact inherits from both of its pieces in
/// series. Platens and membrane have no friction by default (paper section 1: the usual frictionless walls).
///
/// The table prints 5.8e6 and 2.9e6 N/m for grains. They are read as values of a contact, as the contact table of PFC
/// takes them, so a piece has twice as much; `table_1::of_pieces()` is the other reading, in which two grains share
/// 2.9e6 N/m. Manual, page "readings".
struct table_1 {
    contacts::piece pebble{1.16e7, 5.8e6, 0.3};
    contacts::piece platen{3.2e8, 1.6e8, 0.0};
    contacts::piece membrane{3.2e6, 1.6e6, 0.0};
    double density = 2650.0; ///< kg/m^3; not given in the paper: it enters the inertial number and the time step only

    /// The printed stiffness as that of a pebble in series with what it touches.
    static table_1 of_pieces() {
        table_1 t;
        t.pebble.normal_stiffness = 5.8e6, t.pebble.shear_stiffness = 2.9e6;
        return t;
    }
    contacts::linear between_grains() const { return contacts::linear::between(pebble, pebble); }
    contacts::linear at_platen() const { return contacts::linear::between(pebble, platen); }
    contacts::linear at_membrane() const { return contacts::linear::between(pebble, membrane); }
};

/// Contacts of a law that Table 1 knows nothing of, given one by one. At a wall whose law has mu = 0 the law sees
/// no tangential motion and no history. Its normal stiffness under a small overlap must be positive, for the servo.
template <class L> struct contacts_of_law {
    L grain;                 ///< pebble against pebble
    L platen;                ///< pebble against platen
    L membrane;              ///< pebble against the lateral wall
    double density = 2650.0; ///< of the pebbles (kg/m^3)

    L between_grains() const { return grain; }
    L at_platen() const { return platen; }
    L at_membrane() const { return membrane; }
};

/// What the setup of a test asks for its contacts: Table 1 for `contacts::linear`, else the three laws.
template <class L>
using materials_of = std::conditional_t<std::same_as<L, contacts::linear>, table_1, contacts_of_law<L>>;

/// What a triaxial test is made of. Members without a default must be given, or the program does not compile.
template <class P> struct triaxial_setup {
    mixture grain;                       ///< a shape that all grains have, or several, and a grading
    quantities::length diameter;         ///< of the specimen: of the circle that the membrane's polygon circumscribes
    quantities::length height;           ///< of the specimen as packed
    quantities::stress confining;        ///< sigma_3 of consolidation and shear
    typename P::breakage breakage;       ///< criterion, {} for criteria::none
    typename P::replacement replacement; ///< {} for replacements::none
    /// Where grains start, in place of a cloud (read_packing); then porosity, vessel and seed say nothing, and sizes
    /// are those of the packing. The vessel starts at the size of the specimen or, where it does not hold the grains,
    /// at the smallest size that does.
    protocol::packing packing{};
    double porosity = 0.58;                        ///< as packed, counted with pebble volumes (paper section 2.3)
    int rings = 36;                                ///< V_sec; solid strips ignore it
    int tiles_per_ring = 20;                       ///< H_part
    double membrane_stiffness = 0.0;               ///< E t of a membrane of one sheet (tiles, ring_walls; N/m)
    materials_of<typename P::contact> materials{}; ///< table_1, or contacts_of_law for a law of one's own
    double inertial_number = 1e-4;                 ///< largest in shear (paper section 2.2)
    double damping = 0.7;                          ///< local damping
    double safety = 0.8;                           ///< of the time-step estimate
    /// Least size of the cloud's vessel over that of the specimen: grains that fill little of their circumscribed
    /// spheres, slender ones, get a larger one, in which these spheres take a quarter of the room.
    double vessel = 1.8;
    std::uint64_t seed = 1;
    int threads = 1;                                 ///< never changes a result
    std::int64_t rows = 500;                         ///< rows of the series over 25 % of strain
    [[no_unique_address]] typename P::field field{}; ///< that acts on every grain: gravity, or one's own
};

/// Stages of the paper's protocol (section 2.3), as data. Take them, change them, or write your own.
namespace protocol {

// Sizes, stress and inertial number are those of the setup, unless they are given: a test compares them then.

/// Servo control of membrane and platens to an isotropic stress until the error is below 0.1 % and the specimen rests.
inline stage consolidation() {
    return {.name = "consolidate",
            .axial = drive_by::stress_of_setup(),
            .lateral = drive_by::stress_of_setup(),
            .end = until::stresses_within(1e-3) && until::unbalanced_below(1e-3),
            .membrane_here = true,
            .walls_at_rest = true,
            .hands_over = true,
            .ends_at_standstill = true,
            .if_stuck = "Grains may go on breaking or rearranging: lower the stress, or allow more steps."};
}

inline stage consolidation(quantities::stress confining) {
    stage s = consolidation();
    s.axial = s.lateral = drive_by::stress(confining);
    return s;
}

/// Shear by both platens at a limited inertial number, at constant lateral stress.
inline stage shear(quantities::ratio strain) {
    return {.name = "shear",
            .axial = drive_by::inertial_number_of_setup(),
            .lateral = drive_by::stress_of_setup(),
            .end = until::axial_strain(strain),
            .most_steps = 100'000'000,
            .reference_here = true};
}
inline stage shear(quantities::stress confining, quantities::ratio strain, double inertial_number = 1e-4) {
    stage s = shear(strain);
    s.axial = drive_by::inertial_number(inertial_number);
    s.lateral = drive_by::stress(confining);
    return s;
}

/// Extension from the end of shear until q has fallen to the given value.
inline stage unloading(quantities::stress q) {
    return {.name = "unload",
            .axial = drive_by::inertial_number_of_setup(-1.0),
            .lateral = drive_by::stress_of_setup(),
            .end = until::deviator_below(q),
            .most_steps = 100'000'000};
}
inline stage unloading(quantities::stress confining, quantities::stress q, double inertial_number = 1e-4) {
    stage s = unloading(q);
    s.axial = drive_by::inertial_number(-inertial_number);
    s.lateral = drive_by::stress(confining);
    return s;
}

/// The paper's test: preparation, consolidation, shear.
inline std::vector<stage> triaxial_compression(quantities::ratio strain) {
    std::vector<stage> s = preparation();
    s.push_back(consolidation());
    s.push_back(shear(strain));
    return s;
}
inline std::vector<stage> triaxial_compression(quantities::length diameter, quantities::length height,
                                               quantities::stress confining, quantities::ratio strain,
                                               double inertial_number = 1e-4) {
    std::vector<stage> s = preparation(diameter, height);
    s.push_back(consolidation(confining));
    s.push_back(shear(confining, strain, inertial_number));
    return s;
}

} // namespace protocol

/// Specimen, boundary, engine and runner of one test, ready to run.
template <class P> class triaxial_test {
  public:
    using boundary_type = typename P::boundary;
    using runner_type = runner<P>;

    /// Throws input_error where the setup makes no sense (tiles smaller than a pebble, a cloud too dense, ...), and
    /// where stages go to sizes or lateral stresses none of which is that of the setup.
    triaxial_test(triaxial_setup<P> setup, std::vector<stage> stages)
        : setup_(check(std::move(setup))), sim_(make_engine(setup_)),
          run_(sim_, make_plan(setup_, std::move(stages)), membrane_settings(setup_)) {}
    triaxial_test(const triaxial_test&) = delete;
    triaxial_test& operator=(const triaxial_test&) = delete;

    /// Runs to the end of the last stage, or until the observer asks to stop (then false).
    bool run(observer& watch) { return run_.run(watch) == runner_type::outcome::finished; }

    const triaxial_setup<P>& setup() const { return setup_; }
    engine<P>& sim() { return sim_; }
    const engine<P>& sim() const { return sim_; }
    runner_type& protocol() { return run_; }
    const runner_type& protocol() const { return run_; }

    template <class A> void archive(A& a) { run_.archive(a); }

  private:
    static triaxial_setup<P> check(triaxial_setup<P> s) {
        const auto demand = [](bool good, const char* name, double value, const char* allowed, const char* way_out) {
            if (!good) throw input_error(name, fmt::format("{:g}", value), allowed, way_out);
        };
        const double d = s.diameter.si(), h = s.height.si();
        demand(s.porosity > 0.2 && s.porosity < 0.95, "porosity", s.porosity, "0.2 to 0.95", "The paper uses 0.58.");
        // toys; results that mean something need 10 grains and more across
        const double largest = sizes(s).largest_circumscribed;
        demand(d >= 2.2 * largest, "diameter (m)", d, "at least 2.2 grain diameters", "Make the specimen larger.");
        demand(h >= 2.2 * largest, "height (m)", h, "at least 2.2 grain diameters", "Make the specimen larger.");
        demand(s.confining.si() > 0.0, "confining (Pa)", s.confining.si(), "> 0", "The paper uses 1.5 and 2 MPa.");
        demand(s.damping >= 0.0 && s.damping < 1.0, "damping", s.damping, "0 to below 1", "0.7 is the default.");
        demand(s.safety > 0.0 && s.safety <= 1.0, "safety", s.safety, "above 0, at most 1", "0.8 is the default.");
        demand(s.inertial_number > 0.0 && s.inertial_number <= 1e-2, "inertial_number", s.inertial_number,
               "above 0, at most 0.01", "1e-4 is quasi-static; 1e-3 is the usual upper bound.");
        constexpr bool stretches = requires { requires boundary_type::stretches; };
        demand(stretches || s.membrane_stiffness == 0.0, "membrane_stiffness (N/m)", s.membrane_stiffness,
               "0 with this boundary", "Only a wall that is one sheet stretches: tiles, ring_walls.");
        demand(s.vessel >= 1.2, "vessel", s.vessel, "at least 1.2", "1.8 is the default.");
        demand(s.threads >= 1, "threads", s.threads, ">= 1", "Take available_threads().");
        return s;
    }
    /// Stages may go to several sizes and stresses on their way, but the ones that the setup was made for are among
    /// them: number of grains, speeds and rows follow from those. Stresses of seating, below 1 %, are free.
    static void compare(const triaxial_setup<P>& s, const std::vector<stage>& stages) {
        const auto one_of_them = [&](const char* name, const char* unit, double si_to_unit, double expected,
                                     auto&& target_of) {
            const stage* other = nullptr;
            for (const stage& one : stages) {
                const double target = target_of(one);
                if (!(target > 0.0)) continue;
                if (std::abs(target - expected) <= 1e-9 * expected) return;
                other = &one;
            }
            if (other != nullptr)
                throw input_error(
                    fmt::format("{} of the setup, and of stage '{}'", name, other->name),
                    fmt::format("{:g} and {:g} {}", si_to_unit * expected, si_to_unit * target_of(*other), unit),
                    "the same in the setup and in one of the stages",
                    "Leave it out of the stages: protocol::triaxial_compression(25_percent) takes it from the setup.");
        };
        using kind = axis_drive::kind;
        const auto target = [](const axis_drive& a, kind how, double of_setup) {
            return a.how != how ? 0.0 : a.of_setup ? a.value * of_setup : a.value;
        };
        const double d = s.diameter.si(), h = s.height.si(), sigma = s.confining.si();
        one_of_them("diameter", "mm", 1e3, d,
                    [&](const stage& one) { return 2.0 * target(one.lateral, kind::reach, 0.5 * d); });
        one_of_them("height", "mm", 1e3, h, [&](const stage& one) { return target(one.axial, kind::reach, h); });
        one_of_them("confining", "kPa", 1e-3, sigma, [&](const stage& one) {
            const double stress = target(one.lateral, kind::stress, sigma);
            return one.skip_if_relaxed || stress < 0.01 * sigma ? 0.0 : stress;
        });
    }
    static grain_sizes sizes(const triaxial_setup<P>& s) {
        return s.packing.empty() ? sizes_of(s.grain) : s.packing.sizes();
    }
    static boundaries::vessel_settings membrane_settings(const triaxial_setup<P>& s) {
        boundaries::vessel_settings m;
        m.radius = 0.5 * s.diameter.si();
        m.bottom = -0.5 * s.height.si();
        m.top = 0.5 * s.height.si();
        m.rings = s.rings;
        m.tiles_per_ring = s.tiles_per_ring;
        const grain_sizes grains = sizes(s);
        m.membrane_stiffness = s.membrane_stiffness;
        m.smallest_radius = grains.smallest_radius;
        m.largest_radius = grains.largest_radius;
        // Steps up to a grain, or a quarter of the radius in a slender specimen, where a tile that finds no grain would
        // else dig through to the axis. The paper's limit is the smallest particle, so that nothing slips out between
        // two rings; here tiles have ledges and nothing can, and with the smallest pebble of 14B (4.6 mm) the confining
        // stress of a bulging specimen was off by up to 0.8 %.
        m.largest_gap = std::max(2.0 * m.smallest_radius, std::min(grains.largest_circumscribed, 0.25 * m.radius));
        // under an overlap that is small, but not nothing: some laws start from zero stiffness
        const double r = m.smallest_radius;
        m.contact_stiffness_floor = s.materials.at_membrane().normal_stiffness({0, 0, 1, 1e-3 * r, 1.0 / r, 0.0});
        if (!(m.contact_stiffness_floor > 0.0))
            throw input_error("materials.membrane", "no normal stiffness",
                              "a law with a stiffness under a small overlap",
                              "A law other than contacts::linear has no default: give materials its three contacts.");
        if constexpr (std::same_as<typename P::contact, contacts::linear>) {
            m.platen_stiffness = s.materials.platen.normal_stiffness;
            m.wall_stiffness = s.materials.membrane.normal_stiffness;
        }
        return m;
    }
    /// How much larger than the specimen (of a volume, m^3) the vessel of a cloud is.
    static double size_of_vessel(const triaxial_setup<P>& s, const std::vector<mixture_grain>& grains, double volume) {
        double spheres = 0.0;
        for (const mixture_grain& g : grains) spheres += sphere_volume(s.grain.reach(g));
        return std::max(s.vessel, std::cbrt(spheres / (0.25 * volume)));
    }
    /// A vessel that is so many times larger than the specimen.
    static boundary_type vessel_of(const triaxial_setup<P>& s, double larger) {
        boundaries::vessel_settings sizes = membrane_settings(s);
        sizes.radius *= larger;
        sizes.bottom *= larger;
        sizes.top *= larger;
        return boundary_type::made(sizes);
    }
    /// Adds a cloud of grains, and returns its vessel.
    static boundary_type add_cloud(const triaxial_setup<P>& s, typename P::body& sp) {
        // porosity counts in what encloses the specimen, a polygon or a square, not in the inscribed circle
        const double volume = vessel_of(s, 1.0).volume();
        const std::vector<mixture_grain> grains = s.grain.grains_of((1.0 - s.porosity) * volume);
        double spheres = 0.0;
        for (const mixture_grain& g : grains) spheres += sphere_volume(s.grain.reach(g));
        boundary_type vessel = vessel_of(s, std::max(s.vessel, std::cbrt(spheres / (0.25 * volume))));
        protocol::add(sp, s.grain, protocol::cloud_of(sp, s.grain, grains, protocol::inside(vessel), s.seed));
        return vessel;
    }
    /// Adds the grains of a packing, and returns a vessel that holds them.
    static boundary_type add_packing(const triaxial_setup<P>& s, typename P::body& sp) {
        const std::vector<searches::sphere>& pebbles = s.packing.pebbles();
        protocol::add(sp, s.grain, s.packing.grains());
        const double porosity = 1.0 - sp.solid_volume() / vessel_of(s, 1.0).volume();
        if (!(porosity >= 0.2 && porosity <= 0.9))
            throw input_error("packing", fmt::format("a porosity of {:.3g} at the size of the specimen", porosity),
                              "0.2 to 0.9", "Give the specimen the diameter and height that the packing was made for.");
        for (double larger = 1.0;; larger *= 1.01) {
            boundary_type vessel = vessel_of(s, larger);
            const std::size_t out = protocol::first_outside(protocol::inside(vessel), pebbles);
            if (out == pebbles.size()) return vessel;
            if (larger < 4.0) continue;
            const searches::sphere& p = pebbles[out];
            throw input_error(fmt::format("packing, grain {}", p.id + 1),
                              fmt::format("a pebble at {:.4g} {:.4g} {:.4g} m", p.centre.x, p.centre.y, p.centre.z),
                              fmt::format("inside four times the specimen, which has a radius of {:.4g} m and a height "
                                          "of {:.4g} m around 0 0 0",
                                          0.5 * s.diameter.si(), s.height.si()),
                              "Leave this grain out, or make the specimen larger.");
        }
    }
    static engine<P> make_engine(const triaxial_setup<P>& s) {
        typename P::body sp;
        sp.density = s.materials.density;
        boundary_type vessel = s.packing.empty() ? add_cloud(s, sp) : add_packing(s, sp);
        return engine<P>({.grain_contact = s.materials.between_grains(),
                          .platen_contact = s.materials.at_platen(),
                          .lateral_contact = s.materials.at_membrane(),
                          .breakage = s.breakage,
                          .replacement = s.replacement,
                          .scheme = {.damping = s.damping},
                          .safety = s.safety,
                          .run = execution(s.threads),
                          .field = s.field},
                         std::move(sp), std::move(vessel));
    }
    static test_plan make_plan(const triaxial_setup<P>& s, std::vector<stage> stages) {
        test_plan p;
        compare(s, stages);
        p.stages = std::move(stages);
        p.radius = 0.5 * s.diameter.si();
        p.height = s.height.si();
        p.grain_diameter = sizes(s).d50;
        p.confining = s.confining.si();
        p.inertial_number = s.inertial_number;
        // a test that is sheared faster need not be consolidated more slowly
        p.consolidation_inertial_number = std::max(p.consolidation_inertial_number, s.inertial_number);
        p.final_inertial_number = std::max(p.final_inertial_number, s.inertial_number);
        p.row_strain = 0.25 / static_cast<double>(s.rows);
        return p;
    }

    triaxial_setup<P> setup_;
    engine<P> sim_;
    runner_type run_;
};

/// For a bundle that does not fit (triaxial_policies): an error that says what is missing, and nothing after it.
template <class P>
requires(!triaxial_policies<P>) class triaxial_test<P> : public triaxial_test<repaired_test_policies<P>> {
    static_assert(sizeof(check_test_policies<P>) > 0);

  public:
    triaxial_test(triaxial_setup<P>, std::vector<stage>);
};

} // namespace clast
