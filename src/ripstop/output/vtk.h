// Files for ParaView and other readers of the VTK XML formats: canopy, lines, flow, porous cells, series.
//
// Points are doubles; arrays keep the type they are given. Data are appended raw, little-endian, in zlib
// blocks (VTK File Formats, Kitware; vtkZLibDataCompressor). Every file appears whole or not at all.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop::inline output {

/// One value or vector a point or cell. The name carries the unit where there is one: "pressure_pa".
struct VtkArray {
  std::string name;
  int components = 1;  // 1 or 3, neighbours in `values`
  std::variant<std::vector<double>, std::vector<float>, std::vector<std::int32_t>> values;
};
VtkArray vtk_array(std::string name, std::vector<double> values);
VtkArray vtk_array(std::string name, std::vector<std::int32_t> values);
VtkArray vtk_array(std::string name, const std::vector<Vec3>& vectors);
/// Rounded to float: halves the files of large flow fields.
VtkArray vtk_array_single(std::string name, const std::vector<double>& values);
VtkArray vtk_array_single(std::string name, const std::vector<Vec3>& vectors);

/// Cells as lists of points; offsets[i] is the end of cell i in connectivity, as VTK has it.
struct VtkCells {
  std::vector<std::int64_t> connectivity, offsets;

  void add(std::span<const int> points);
  std::size_t size() const { return offsets.size(); }
};

/// Poly-lines and polygons. Cell arrays hold the lines' values first, then the polygons'.
struct VtkSurface {
  std::vector<Vec3> points;  // [m]
  VtkCells lines, polygons;
  std::vector<VtkArray> point_arrays, cell_arrays;
};
/// Each triangle with its own points.
VtkSurface triangle_surface(const std::vector<Triangle>& triangles);
/// .vtp. Throws Error(bad_data) when an array's length or a cell's point does not fit, Error(io).
void write_vtp(const std::filesystem::path& path, const VtkSurface& surface);

/// A grid with one value a cell, in FlowGrid's order.
struct VtkImage {
  FlowGrid grid;
  std::vector<VtkArray> cell_arrays;
};
/// Writes `stem`.vti, or .vtr where the cells are not all alike, and returns which. Throws as write_vtp().
std::filesystem::path write_image(const std::filesystem::path& stem, const VtkImage& image);

/// One file of a series; `file` is relative to the folder of the .pvd.
struct VtkSeriesFile {
  double time = 0;  // the coupling iteration, or [s]
  std::filesystem::path file;
};
/// .pvd. Entries whose file does not exist (a run ended early, or was tidied up) are left
/// out. Throws Error(io).
void write_pvd(const std::filesystem::path& path, const std::vector<VtkSeriesFile>& series);

/// The cloth cells of a mesh as quads over all its nodes: point numbers are node numbers.
VtkSurface canopy_surface(const Mesh& mesh, const std::vector<Vec3>& positions);
/// Of one value a cell in the order of cells_of(), those that canopy_surface() draws.
std::vector<double> cloth_cells_only(const Mesh& mesh, const std::vector<double>& cell_values);
/// Every irregular spring (line, riser, tape) as a line of two points over all nodes, in the order of
/// Mesh::springs, with its part as the integer array "part".
VtkSurface spring_lines(const Mesh& mesh, const std::vector<Vec3>& positions);
/// Pressure and velocity of a flow, single precision: "pressure_pa", "velocity_m_per_s".
VtkImage flow_image(const FlowField& field);

}  // namespace ripstop::inline output
