// A flat sheet of cloth that was deformed in its plane, such as a pulled coupon, coloured by a value a cell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/mesh/mesh.h"
#include "ripstop/output/colour.h"

namespace ripstop::inline output {

struct SheetPicture {
  std::string title;
  std::string quantity;             // with unit: "von Mises stress [N/m]"
  std::vector<double> cell_values;  // in the order of cells_of()
  std::vector<Vec3> outline;        // of the sheet as cut, drawn dashed; empty: none [m]
};

/// Draws the cells of `mesh` at `positions` as seen along -z, y upward. PNG, or SVG with vector text, by the
/// ending of `path`. Returns the colour bar's range. Throws as write_canopy_picture().
ColourRange write_sheet_picture(const std::filesystem::path& path, const Mesh& mesh,
                                const std::vector<Vec3>& positions, const SheetPicture& picture);

}  // namespace ripstop::inline output
