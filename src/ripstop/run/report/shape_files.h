// The shapes of a run folder for the report.
#pragma once

#include <filesystem>
#include <vector>

#include "ripstop/report/shape_view.h"

namespace ripstop::inline run {

/// "vtk/canopy_0012.vtp" and its lines, in order, without times.
std::vector<ShapeFiles> shape_files(const std::filesystem::path& folder);
/// Those of an opening with their times.
std::vector<ShapeFiles> opening_shapes(const std::filesystem::path& folder);
/// As many, evenly spaced, as fit into a page.
std::vector<ShapeFiles> thinned_out(std::vector<ShapeFiles> files);

}  // namespace ripstop::inline run
