// One sheet that shows a canopy: three shaded views coloured by a value a cell, lines, scale and colour bar.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/output/colour.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline output {

struct CanopyPicture {
  std::string title;                      // "Stratos IV, 30 m/s, iteration 12"
  std::string quantity;                   // with unit: "von Mises stress [N/m]"
  std::vector<double> cell_values;        // in the order of cells_of(); not-a-number is drawn grey
  std::optional<ColourRange> range = {};  // absent: all finite values but 1 % at either end
};

/// Draws `mesh` at `positions`: obliquely from upstream, from the front and from the side with all lines.
/// PNG, or SVG with vector text, by the ending of `path`. Returns the colour bar's range. Throws
/// Error(bad_data) for a mesh without cloth, arrays of the wrong length or positions that are not finite,
/// Error(usage) for another ending, Error(io).
ColourRange write_canopy_picture(const std::filesystem::path& path, const CanopyMesh& mesh,
                                 const std::vector<Vec3>& positions, const CanopyPicture& picture);

/// One shape of a contact sheet.
struct CanopyShot {
  std::string caption;  // "t = 12 ms"
  std::vector<Vec3> positions;
  std::vector<double> cell_values;  // in the order of cells_of()
};
/// Draws all shots side by side, obliquely from upstream, at one scale and in one range of colours: at
/// most 12. Throws as write_canopy_picture(); Error(bad_data) without a shot.
void write_contact_sheet(const std::filesystem::path& path, const CanopyMesh& mesh, const std::string& title,
                         const std::string& quantity, const std::vector<CanopyShot>& shots);

}  // namespace ripstop::inline output
