// Warnings about the results of a valid case.
#pragma once

#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/flow/flow_grid.h"

namespace ripstop::inline run {

/// A mesh on which this type's diameter may be more than 1 % off; nothing where it is fine enough.
std::vector<std::string> mesh_warnings(const Settings& resolved);
/// Cells of the flow that are too large for the air's own load on the canopy.
std::vector<std::string> grid_warnings(const Settings& resolved);
/// Permeability of another model than the one that is used.
std::vector<std::string> porosity_warnings(const Settings& resolved);
/// Mach and Reynolds number outside the range of the flow model.
std::vector<std::string> range_warnings(const Settings& resolved);
/// Of the air about a canopy in any command: the two above, and the pressure on open cloth.
std::vector<std::string> air_warnings(const Settings& resolved);
/// Of rigid bodies in a flow on these cells: their errors, and fewer than 8 cells across, with the remedy `finer`.
/// `in_time`: the flow is unsteady.
std::vector<std::string> body_warnings(const Settings& resolved, const FlowGrid& grid, bool in_time,
                                       const char* finer);
/// Of a profile whose apex is pulled down.
std::vector<std::string> shape_warnings(const Settings& resolved);
/// Of the materials: see material_warnings().
std::vector<std::string> strain_warnings(const Settings& resolved, double largest_cloth_strain);
/// Of [hardware]: a rated load of a textile part, and a breaking load without the kind.
std::vector<std::string> hardware_warnings(const Settings& resolved);
/// Warnings before the computation: those above, of unstretched cloth.
std::vector<std::string> case_warnings(const Settings& resolved);
/// All of them. With a mesh of the user's own: without those of the mesh and shape of the case.
std::vector<std::string> warnings_of(const Settings& resolved, double largest_cloth_strain,
                                     bool own_mesh = false);

}  // namespace ripstop::inline run
