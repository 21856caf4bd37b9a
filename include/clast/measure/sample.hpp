// SPDX-License-Identifier: MIT
// What a test reports: one `sample` per row of series.csv, one `fracture_event` per broken bond, and the views that
// pictures and ParaView files are drawn from. Plain data, so that io knows no engine and the engine knows no file.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <clast/core/vector.hpp>

namespace clast {

/// State of the specimen at one instant. SI units; stress and strain are positive in compression.
struct sample {
    double time = 0.0;               ///< model time (s)
    std::string stage;               ///< name of the running stage
    double axial_strain = 0.0;       ///< 1 - H/H0; H0 at the start of shear, before it that of the vessel
    double volumetric_strain = 0.0;  ///< 1 - V/V0, positive in compression
    double height = 0.0;             ///< platen distance H (m)
    double volume = 0.0;             ///< enclosed volume V (m^3)
    double sigma_1 = 0.0;            ///< sigma_3 + q (Pa)
    double sigma_2 = 0.0;            ///< of the y walls of a box that is driven along three axes, else sigma_3 (Pa)
    double sigma_3 = 0.0;            ///< mean membrane stress: force / area; in such a box of the x walls (Pa)
    double p = 0.0;                  ///< sigma_3 + q / 3 = (sigma_1 + 2 sigma_3) / 3; in such a box the mean (Pa)
    double q = 0.0;                  ///< of the laboratory: (F - sigma_3 A_end) / (V / H), mean of both ends; in such
                                     ///< a box sqrt(3 J_2) (Pa)
    double pore_pressure = 0.0;      ///< where the volume is kept: sigma_3 at the start of the stage - sigma_3 (Pa)
    double q_contacts = 0.0;         ///< from contacts: sigma_1_love_weber - sigma_3_love_weber (Pa)
    double sigma_1_love_weber = 0.0; ///< axial stress from contacts (Pa)
    double sigma_3_love_weber = 0.0; ///< mean radial stress from contacts (Pa)
    double void_ratio = 0.0;         ///< (V - V_s) / V_s with V_s the pebble volume
    double porosity = 0.0;           ///< 1 - V_s / V
    double phi_mob_deg = 0.0;        ///< asin((sigma_1 - sigma_3) / (sigma_1 + sigma_3)) (degrees)
    double inertial_number = 0.0;    ///< paper Eq. 2
    double unbalanced_ratio = 0.0;   ///< max |F_unbalanced| / mean sum |F_contact|
    double confining_error = 0.0;    ///< |sum F - target sum A| / (target sum A), mean since the last sample
    double confining_rms = 0.0;      ///< of the same for each facet that moves on its own: root mean square, now
    double median_overlap_over_r = 0.0; ///< overlap over the smaller radius, of touching contacts, walls included
    double max_overlap_over_r = 0.0;    ///< the largest of them
    double kappa = 0.0;                 ///< k_n / (p d)
    double coordination = 0.0;          ///< touching neighbours per body (grains and boundary facets not counted)
    std::int64_t replaced = 0;          ///< clumps replaced by bonded clusters so far
    std::int64_t broken_tension = 0;    ///< bonds broken in tension so far
    std::int64_t broken_shear = 0;      ///< bonds broken in shear so far
    double hardin_br = 0.0;             ///< relative breakage B_r (Hardin 1985), by equivalent diameters
    double einav_b = 0.0;               ///< B (Einav 2007) towards a grading of dimension 2.6
    std::int64_t escaped = 0;           ///< grains outside the boundary (a run stops at the first)
    double kinetic_energy = 0.0;        ///< (J)
    double elastic_energy = 0.0;        ///< contacts, facets and bonds (J)
    double boundary_work = 0.0;         ///< work done on the specimen by platens and membrane so far (J)
    double friction_dissipation = 0.0;  ///< (J)
    double damping_dissipation = 0.0;   ///< (J)
    double bond_dissipation = 0.0;      ///< energy released by broken bonds and at replacement (J)
    double energy_residual = 0.0;       ///< (work - stored - dissipated) / work of the stage, dimensionless
    std::int64_t steps = 0;             ///< steps so far
    double dt = 0.0;                    ///< time step of grains (s)
    double wall_time = 0.0;             ///< seconds of computer time so far (the only column that is not reproducible)
};

enum class break_mode : std::uint8_t { tension, shear };

/// One broken bond: one fracture of the paper's figures 8 to 10 and 13.
struct fracture_event {
    double time = 0.0;         ///< (s)
    std::string stage;         ///< name of the stage that was running
    double axial_strain = 0.0; ///< as in its row of the series; before shear since the start of that stage
    break_mode mode = break_mode::tension;
    vec3 position;                ///< bond point (m), kept where it happened (paper Fig. 8)
    vec3 normal;                  ///< unit normal of the bond
    std::int32_t mother = -1;     ///< grain id of the broken mother, also where a frozen fragment of it breaks on
    std::int32_t bond = -1;       ///< bond index in the mother's shape, also there
    double normal_force = 0.0;    ///< tension positive (N)
    double shear_force = 0.0;     ///< |V| (N)
    double bending_moment = 0.0;  ///< (N m)
    double twisting_moment = 0.0; ///< (N m)
    double energy = 0.0;          ///< strain energy released (J)
};

enum class pebble_state : std::uint8_t { clump, bonded, fragment }; ///< fragment: has lost at least one bond

/// One pebble, as a picture or a ParaView file wants it.
struct pebble_view {
    vec3 position;
    double radius = 0.0;
    std::int32_t grain = -1;    ///< mother grain id
    std::int32_t fragment = -1; ///< id of the connected component of unbroken bonds (= smallest pebble id in it)
    pebble_state state = pebble_state::clump;
    vec3 displacement; ///< since the start of shear (m)
    vec3 velocity;     ///< (m/s)
};

/// One active facet of a boundary as a quadrilateral.
struct facet_view {
    std::array<vec3, 4> corner; ///< in order around the facet (m)
    double pressure = 0.0;      ///< normal stress carried (Pa)
    double area = 0.0;          ///< active area (m^2)
    std::int32_t ring = -1;     ///< ring from the bottom, -1 for a platen
    std::int32_t tile = -1;     ///< tile in the ring, -1 for a platen
};

} // namespace clast
