// A canopy as the report shows it: cells and lines over points, still or moving, with values to colour by.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/output/vtk.h"

namespace ripstop::inline report {

/// One value a cell.
struct CellValues {
  std::string key;  // "von_mises_n_per_m"
  std::vector<double> values;
};

struct ShapeFrame {
  double time = 0;                  // [s]
  std::vector<double> points;       // x, y, z [m]
  std::vector<CellValues> cells;    // as far as the file had them
  std::vector<double> line_values;  // tension of each segment with its bending springs' [N]; empty: unknown
};

struct ShapeView {
  std::vector<int> quads;     // four points each
  std::vector<int> segments;  // two points each: lines, riser, tape
  std::vector<int> parts;     // of each segment, index into `part_names`
  std::vector<std::string> part_names;
  std::vector<ShapeFrame> frames;  // one, or those of an opening or a flight in time
  /// Of a flight: where its payload, the point `anchor`, has been, over the ground [s], [m]; empty: it does not fly.
  std::vector<double> path_times, path;
  int anchor = 0;
};

/// Of the files of vtk.h: canopy and lines, and the time of each pair. Throws Error(bad_data) for files that do
/// not belong together, Error(io). Springs that bend a line are laid onto the segments below them.
struct ShapeFiles {
  double time = 0;  // [s]
  std::filesystem::path canopy, lines;
};
ShapeView read_shape(const std::vector<ShapeFiles>& files);

/// Of such surfaces in memory: cloth as quads, and lines with their parts.
ShapeView shape_of(const VtkSurface& canopy, const VtkSurface& lines);

}  // namespace ripstop::inline report
