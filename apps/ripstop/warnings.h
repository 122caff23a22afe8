// What the materials of a case have to say about a run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"

namespace ripstop {

/// A line each on standard error; on a terminal the word "warning" is red.
void print_warnings(const std::vector<std::string>& warnings);

/// The warnings of a result. Returns the exit status: ExitCode::not_converged where it is not usable.
int print_result_warnings(const std::optional<std::vector<std::string>>& warnings,
                          const std::optional<bool>& usable);

/// Says on standard error which keys of a case have a new name.
void print_deprecations(const std::vector<std::string>& deprecations);

/// Says on standard error when the mesh is too coarse for the size of the inflated canopy.
void print_mesh_warning(const Settings& resolved);

/// Says on standard error what is doubtful of a case that is valid: mesh, grid, porosity.
void print_case_warnings(const Settings& resolved);

/// Repeats on standard error what the fits of the case's materials found doubtful, and says when the canopy's
/// cloth was strained beyond its tests.
void print_material_warnings(const Settings& resolved, double largest_cloth_strain);

}  // namespace ripstop
