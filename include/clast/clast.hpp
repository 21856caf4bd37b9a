// SPDX-License-Identifier: MIT
// Everything that a simulator needs. Files (CSV, ParaView, checkpoints) are in clast/io and included apart.
#pragma once

#include <clast/bodies/clumps.hpp>
#include <clast/bodies/spheres.hpp>
#include <clast/boundaries/box.hpp>
#include <clast/boundaries/none.hpp>
#include <clast/boundaries/rigid_cylinder.hpp>
#include <clast/boundaries/ring_walls.hpp>
#include <clast/boundaries/solid_strips.hpp>
#include <clast/boundaries/stepped_tiles.hpp>
#include <clast/boundaries/tiles.hpp>
#include <clast/constraints/held.hpp>
#include <clast/constraints/none.hpp>
#include <clast/contacts/by_material.hpp>
#include <clast/contacts/hertz_mindlin.hpp>
#include <clast/contacts/linear.hpp>
#include <clast/contacts/linear_dashpot.hpp>
#include <clast/contacts/rolling.hpp>
#include <clast/criteria/none.hpp>
#include <clast/criteria/one_of.hpp>
#include <clast/engine/engine.hpp>
#include <clast/fields/gravity.hpp>
#include <clast/fields/none.hpp>
#include <clast/grains/grading.hpp>
#include <clast/grains/mixture.hpp>
#include <clast/grains/shape.hpp>
#include <clast/integrators/leapfrog.hpp>
#include <clast/protocol/triaxial.hpp>
#include <clast/replacements/modified.hpp>
#include <clast/replacements/none.hpp>
#include <clast/searches/brute_force.hpp>
#include <clast/searches/cell_grid.hpp>
#include <clast/searches/hierarchical_grid.hpp>
#include <clast/spaces/open.hpp>
#include <clast/spaces/periodic.hpp>
#include <clast/version.hpp>
