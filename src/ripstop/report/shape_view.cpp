#include "ripstop/report/shape_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <variant>

#include "ripstop/core/error.h"
#include "ripstop/output/vtk_read.h"

namespace ripstop::inline report {
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
    reject(path, "has cells of a type that Ripstop does not write");
  return {points.begin(), points.end()};
}

ShapeFrame frame_of(const ShapeFiles& files, const VtkFile& canopy, const VtkFile& lines) {
  ShapeFrame frame{files.time, array(canopy, files.canopy, "Points", "Points"), {}, {}};
  for (const VtkData& data : canopy.arrays)
    if (data.section == "CellData" && data.components == 1) frame.cells.push_back({data.name, data.values});
  if (const VtkData* tension = lines.find("CellData", "tension_n")) frame.line_values = tension->values;
  return frame;
}

/// Lines and riser bend by springs over two segments, which lie on their axial springs: a spring whose ends are also
/// joined by two others of its part, each clearly shorter. Its tension is part of the line's at both.
struct Bending {
  std::vector<int> over;                  // numbers of those springs
  std::vector<std::array<int, 2>> share;  // the axial springs below each
};

Bending bending_springs(const ShapeView& view) {
  const std::vector<double>& points = view.frames.back().points;
  const auto length = [&](std::size_t s) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double d = points[3 * view.segments[2 * s] + c] - points[3 * view.segments[2 * s + 1] + c];
      sum += d * d;
    }
    return std::sqrt(sum);
  };
  std::map<int, std::vector<int>> at;  // springs at each node
  for (std::size_t i = 0; i < view.segments.size(); ++i)
    at[view.segments[i]].push_back(static_cast<int>(i / 2));
  const auto other_end = [&](int s, int node) {
    return view.segments[2 * s] == node ? view.segments[2 * s + 1] : view.segments[2 * s];
  };
  Bending found;
  for (std::size_t s = 0; s < view.parts.size(); ++s) {
    const int from = view.segments[2 * s], to = view.segments[2 * s + 1];
    const double limit = length(s) / 1.2;
    std::array<int, 2> pair = {-1, -1};
    for (int first : at[from]) {
      if (view.parts[first] != view.parts[s] || length(first) > limit) continue;
      for (int second : at[to])
        if (view.parts[second] == view.parts[s] && length(second) <= limit &&
            other_end(first, from) == other_end(second, to))
          pair = {first, second};
    }
    if (pair[0] < 0) continue;
    found.over.push_back(static_cast<int>(s));
    found.share.push_back(pair);
  }
  return found;
}

void lay_onto_lines(ShapeView& view) {
  const Bending bending = bending_springs(view);
  for (ShapeFrame& frame : view.frames) {
    if (frame.line_values.empty()) continue;
    for (std::size_t i = 0; i < bending.over.size(); ++i)
      for (int below : bending.share[i]) frame.line_values[below] += frame.line_values[bending.over[i]];
  }
  const auto without = [&](const auto& list, std::size_t each) {
    std::decay_t<decltype(list)> kept;
    for (std::size_t s = 0; s < list.size() / each; ++s)
      if (!std::binary_search(bending.over.begin(), bending.over.end(), static_cast<int>(s)))
        for (std::size_t k = 0; k < each; ++k) kept.push_back(list[each * s + k]);
    return kept;
  };
  view.segments = without(view.segments, 2);
  view.parts = without(view.parts, 1);
  for (ShapeFrame& frame : view.frames) frame.line_values = without(frame.line_values, 1);
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
      reject(pair.canopy, "has a different mesh than the first file of its series");
    for (const CellValues& values : frame.cells)
      if (4 * values.values.size() != view.quads.size())
        reject(pair.canopy, "has arrays of another length than its cells");
    if (!frame.line_values.empty() && frame.line_values.size() != view.parts.size())
      reject(pair.lines, "has arrays of another length than its lines");
    view.frames.push_back(std::move(frame));
  }
  if (!view.frames.empty()) lay_onto_lines(view);
  return view;
}

ShapeView shape_of(const VtkSurface& canopy, const VtkSurface& lines) {
  const auto numbers = [](const VtkArray& array) {
    return std::visit([](const auto& list) { return std::vector<double>(list.begin(), list.end()); },
                      array.values);
  };
  ShapeView view;
  ShapeFrame frame;
  for (const Vec3& p : canopy.points) frame.points.insert(frame.points.end(), {p.x, p.y, p.z});
  view.quads.assign(canopy.polygons.connectivity.begin(), canopy.polygons.connectivity.end());
  view.segments.assign(lines.lines.connectivity.begin(), lines.lines.connectivity.end());
  for (const VtkArray& array : canopy.cell_arrays)
    if (array.components == 1) frame.cells.push_back({array.name, numbers(array)});
  for (const VtkArray& array : lines.cell_arrays) {
    const std::vector<double> values = numbers(array);
    if (array.name == "part") view.parts.assign(values.begin(), values.end());
    if (array.name == "tension_n") frame.line_values = values;
  }
  view.frames.push_back(std::move(frame));
  lay_onto_lines(view);
  return view;
}

}  // namespace ripstop::inline report
