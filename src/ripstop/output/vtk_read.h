// Reads back the files of vtk.h: those that Ripstop wrote itself, not VTK XML at large.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace ripstop::inline output {

/// One array of a file as doubles.
struct VtkData {
  std::string section;  // "PointData", "CellData", "Points", "Lines", "Polys", "Coordinates"
  std::string name;
  int components = 1;
  std::vector<double> values;
};

struct VtkFile {
  std::vector<VtkData> arrays;
  std::array<std::vector<double>, 3> edges;  // of a grid's cells along x, y and z [m]; else empty

  /// Null when there is none.
  const VtkData* find(const std::string& section, const std::string& name) const;
};

/// Throws Error(bad_data) for a file that is damaged or not one of Ripstop's, Error(io).
VtkFile read_vtk(const std::filesystem::path& path);

}  // namespace ripstop::inline output
