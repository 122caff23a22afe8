#include "ripstop/output/vtk.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <new>
#include <type_traits>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/markup.h"

namespace ripstop::inline output {
namespace {

static_assert(std::endian::native == std::endian::little, "the raw data are declared as LittleEndian");

[[noreturn]] void reject(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ExitCode::bad_data, fmt::format("{} was not written: {}", path.string(), reason));
}

template <class T>
const char* type_name() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, float>) return "Float32";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

/// The XML head and the raw block behind it, filled together.
struct Document {
  std::filesystem::path path;
  std::string head, appended;
};

/// Appends [#blocks][block size][size of a last, partial block or 0][compressed sizes...][blocks...].
void append_compressed(std::string& out, const char* bytes, std::size_t size) {
  constexpr std::size_t block = 1 << 18;
  const std::size_t blocks = (size + block - 1) / block;
  std::vector<std::uint64_t> header = {blocks, block, size % block};
  std::string data;
  for (std::size_t begin = 0; begin < size; begin += block) {
    const std::size_t length = std::min(block, size - begin);
    uLongf packed = compressBound(length);
    const std::size_t end = data.size();
    data.resize(end + packed);
    // Level 1: flow fields shrink little at any level, and this one is several times faster than the default.
    if (compress2(reinterpret_cast<Bytef*>(data.data() + end), &packed,
                  reinterpret_cast<const Bytef*>(bytes + begin), length, 1) != Z_OK) {
      throw std::bad_alloc();  // the only failure left when the buffer is large enough
    }
    data.resize(end + packed);
    header.push_back(packed);
  }
  out.append(reinterpret_cast<const char*>(header.data()), header.size() * sizeof(header[0]));
  out += data;
}

template <class T>
void add_array(Document& document, const std::string& name, int components, const std::vector<T>& values) {
  document.head += fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
      type_name<T>(), escaped_markup(name), components, document.appended.size());
  append_compressed(document.appended, reinterpret_cast<const char*>(values.data()),
                    values.size() * sizeof(T));
}

void add_arrays(Document& document, const char* element, const std::vector<VtkArray>& arrays,
                std::size_t count) {
  document.head += fmt::format("<{}>\n", element);
  for (const VtkArray& array : arrays) {
    if (array.components != 1 && array.components != 3) {
      reject(document.path,
             fmt::format("array {} has {} components, not 1 or 3", array.name, array.components));
    }
    std::visit(
        [&](const auto& values) {
          if (values.size() != count * static_cast<std::size_t>(array.components)) {
            reject(document.path, fmt::format("array {} has {} values for {} times {} components", array.name,
                                              values.size(), count, array.components));
          }
          add_array(document, array.name, array.components, values);
        },
        array.values);
  }
  document.head += fmt::format("</{}>\n", element);
}

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (Vec3 v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
  return values;
}

void add_points(Document& document, const std::vector<Vec3>& points) {
  document.head += "<Points>\n";
  add_array(document, "Points", 3, flat(points));
  document.head += "</Points>\n";
}

void check_cells(const Document& document, const VtkCells& cells, std::size_t points) {
  for (std::int64_t point : cells.connectivity) {
    if (point < 0 || point >= static_cast<std::int64_t>(points)) {
      reject(document.path, fmt::format("a cell has point {} of {}", point, points));
    }
  }
}

void add_cells(Document& document, const VtkCells& cells) {
  add_array(document, "connectivity", 1, cells.connectivity);
  add_array(document, "offsets", 1, cells.offsets);
}

void write(const Document& document, const char* type, const std::string& attributes) {
  write_file(document.path,
             fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" "
                         "byte_order=\"LittleEndian\" header_type=\"UInt64\" "
                         "compressor=\"vtkZLibDataCompressor\">\n<{0}{1}>\n{2}</{0}>\n"
                         "<AppendedData encoding=\"raw\">\n_{3}\n</AppendedData>\n</VTKFile>\n",
                         type, attributes, document.head, document.appended));
}

}  // namespace

VtkArray vtk_array(std::string name, std::vector<double> values) {
  return {std::move(name), 1, std::move(values)};
}

VtkArray vtk_array(std::string name, std::vector<std::int32_t> values) {
  return {std::move(name), 1, std::move(values)};
}

VtkArray vtk_array(std::string name, const std::vector<Vec3>& vectors) {
  return {std::move(name), 3, flat(vectors)};
}

VtkArray vtk_array_single(std::string name, const std::vector<double>& values) {
  std::vector<float> single(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) single[i] = static_cast<float>(values[i]);
  return {std::move(name), 1, std::move(single)};
}

VtkArray vtk_array_single(std::string name, const std::vector<Vec3>& vectors) {
  VtkArray array = vtk_array_single(std::move(name), flat(vectors));
  array.components = 3;
  return array;
}

void VtkCells::add(std::span<const int> points) {
  connectivity.insert(connectivity.end(), points.begin(), points.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
}

VtkSurface triangle_surface(const std::vector<Triangle>& triangles) {
  VtkSurface surface;
  for (const Triangle& t : triangles) {
    const int first = static_cast<int>(surface.points.size());
    surface.points.insert(surface.points.end(), {t.a, t.b, t.c});
    surface.polygons.add(std::array{first, first + 1, first + 2});
  }
  return surface;
}

void write_vtp(const std::filesystem::path& path, const VtkSurface& surface) {
  Document document{path, {}, {}};
  check_cells(document, surface.lines, surface.points.size());
  check_cells(document, surface.polygons, surface.points.size());
  document.head = fmt::format(
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n",
      surface.points.size(), surface.lines.size(), surface.polygons.size());
  add_arrays(document, "PointData", surface.point_arrays, surface.points.size());
  add_arrays(document, "CellData", surface.cell_arrays, surface.lines.size() + surface.polygons.size());
  add_points(document, surface.points);
  document.head += "<Lines>\n";
  add_cells(document, surface.lines);
  document.head += "</Lines>\n<Polys>\n";
  add_cells(document, surface.polygons);
  document.head += "</Polys>\n</Piece>\n";
  write(document, "PolyData", "");
}

std::filesystem::path write_image(const std::filesystem::path& stem, const VtkImage& image) {
  const FlowGrid& grid = image.grid;
  Document document{stem.string() + (grid.uniform() ? ".vti" : ".vtr"), {}, {}};
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", grid.nx, grid.ny, grid.nz);
  document.head = fmt::format("<Piece Extent=\"{}\">\n", extent);
  add_arrays(document, "CellData", image.cell_arrays, static_cast<std::size_t>(grid.cells()));
  if (!grid.uniform()) {
    document.head += "<Coordinates>\n";
    for (int axis = 0; axis < 3; ++axis)
      add_array(document, std::string(1, "xyz"[axis]), 1, grid.edges(axis));
    document.head += "</Coordinates>\n</Piece>\n";
    write(document, "RectilinearGrid", fmt::format(" WholeExtent=\"{}\"", extent));
    return document.path;
  }
  document.head += "</Piece>\n";
  const Vec3 spacing = grid.spacing();
  write(document, "ImageData",
        fmt::format(" WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\"", extent, grid.origin.x,
                    grid.origin.y, grid.origin.z, spacing.x, spacing.y, spacing.z));
  return document.path;
}

void write_pvd(const std::filesystem::path& path, const std::vector<VtkSeriesFile>& series) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const VtkSeriesFile& entry : series) {
    std::error_code ignored;
    if (!std::filesystem::exists(path.parent_path() / entry.file, ignored)) continue;
    text += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", entry.time,
                        escaped_markup(entry.file.generic_string()));
  }
  write_file(path, text + "</Collection>\n</VTKFile>\n");
}

VtkSurface canopy_surface(const Mesh& mesh, const std::vector<Vec3>& positions) {
  VtkSurface surface;
  surface.points = positions;
  for (const Cell& cell : cells_of(mesh)) {
    if (cell.corner[0] >= 0) surface.polygons.add(cell.corner);
  }
  return surface;
}

std::vector<double> cloth_cells_only(const Mesh& mesh, const std::vector<double>& cell_values) {
  const std::vector<Cell> cells = cells_of(mesh);
  if (cells.size() != cell_values.size()) {
    throw Error(ExitCode::bad_data,
                fmt::format("{} values for {} cells of the mesh", cell_values.size(), cells.size()));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].corner[0] >= 0) values.push_back(cell_values[i]);
  }
  return values;
}

VtkSurface spring_lines(const Mesh& mesh, const std::vector<Vec3>& positions) {
  VtkSurface surface;
  surface.points = positions;
  std::vector<std::int32_t> parts;
  for (const Spring& spring : mesh.springs) {
    surface.lines.add(std::array{spring.a, spring.b});
    parts.push_back(spring.part);
  }
  surface.cell_arrays.push_back(vtk_array("part", std::move(parts)));
  return surface;
}

VtkImage flow_image(const FlowField& field) {
  return {field.grid,
          {vtk_array_single("pressure_pa", field.pressure),
           vtk_array_single("velocity_m_per_s", field.velocity)}};
}

}  // namespace ripstop::inline output
