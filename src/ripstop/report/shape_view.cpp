#include "ripstop/report/shape_view.h"

#include <fmt/format.h>

#include "ripstop/core/error.h"
#include "ripstop/output/vtk_read.h"

namespace ripstop {
namespace {

[[noreturn]] void reject(const std::filesystem::path& path, const char* reason) {
  throw Error(ExitCode::bad_data, fmt::format("{}: {}", path.string(), reason));
}

const std::vector<double>& array(const VtkFile& file, const std::filesystem::path& path, const char* section,
                                 const char* name) {
  const VtkData* found = file.find(section, name);
  if (!found) reject(path, fmt::format("has no array {} of {}", name, section).c_str());
  return found->values;
}

/// Cells that all have `corners` points.
std::vector<int> corners_of(const VtkFile& file, const std::filesystem::path& path, const char* section,
                            std::size_t corners) {
  const std::vector<double>& points = array(file, path, section, "connectivity");
  if (points.size() != corners * array(file, path, section, "offsets").size())
    reject(path, "has cells of another kind than Ripstop writes");
  return {points.begin(), points.end()};
}

ShapeFrame frame_of(const ShapeFiles& files, const VtkFile& canopy, const VtkFile& lines) {
  ShapeFrame frame{files.time, array(canopy, files.canopy, "Points", "Points"), {}, {}};
  for (const VtkData& data : canopy.arrays)
    if (data.section == "CellData" && data.components == 1) frame.cells.push_back({data.name, data.values});
  if (const VtkData* tension = lines.find("CellData", "tension_n")) frame.line_values = tension->values;
  return frame;
}

}  // namespace

ShapeView read_shape(const std::vector<ShapeFiles>& files) {
  ShapeView view;
  for (const ShapeFiles& pair : files) {
    const VtkFile canopy = read_vtk(pair.canopy), lines = read_vtk(pair.lines);
    ShapeFrame frame = frame_of(pair, canopy, lines);
    if (view.frames.empty()) {
      view.quads = corners_of(canopy, pair.canopy, "Polys", 4);
      view.segments = corners_of(lines, pair.lines, "Lines", 2);
      const std::vector<double>& parts = array(lines, pair.lines, "CellData", "part");
      view.parts.assign(parts.begin(), parts.end());
    }
    if (!view.frames.empty() && frame.points.size() != view.frames.front().points.size())
      reject(pair.canopy, "is of another mesh than the first of its series");
    for (const CellValues& values : frame.cells)
      if (4 * values.values.size() != view.quads.size())
        reject(pair.canopy, "has arrays of another length than its cells");
    view.frames.push_back(std::move(frame));
  }
  return view;
}

}  // namespace ripstop
