// Every file is read back by VTK itself (vtk_dump.py) and must hold the same bits.
#include "ripstop/output/vtk.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/process.h"
#include "ripstop/flow/stl.h"

namespace ripstop {
namespace {

using nlohmann::json;

/// Whether VTK reads the file; `text` is the output of vtk_dump.py.
bool vtk_reads(const std::filesystem::path& path, std::string& text) {
  ProcessRequest request;
  request.arguments = {"/usr/bin/python3", RIPSTOP_SOURCE_DIR "/tests/output/vtk_dump.py", path.string()};
  request.on_line = [&](const std::string& line) {
    text += line + '\n';
    return true;
  };
  return run_process(request).succeeded();
}

/// Content of a file as read by VTK. The test fails, and is not skipped, when python3-vtk9 is missing.
json seen_by_vtk(const std::filesystem::path& path) {
  std::string text;
  if (vtk_reads(path, text)) return json::parse(text);
  ADD_FAILURE() << "/usr/bin/python3 with VTK (Debian: python3-vtk9) could not read " << path << "\n" << text;
  return json::object();
}

template <class T>
std::string bits(const std::vector<T>& values) {
  static const char* digits = "0123456789abcdef";
  std::string text;
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  for (std::size_t i = 0; i < values.size() * sizeof(T); ++i) {
    text += digits[bytes[i] >> 4];
    text += digits[bytes[i] & 15];
  }
  return text;
}

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> values;
  for (Vec3 v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
  return values;
}

void expect_array(const json& array, const std::string& name, const std::string& type, int components,
                  const std::string& expected_bits) {
  EXPECT_EQ(array["name"], name);
  EXPECT_EQ(array["type"], type) << name;
  EXPECT_EQ(array["components"], components) << name;
  EXPECT_TRUE(array["bytes"] == expected_bits) << name;
}

std::vector<double> awkward_values() {
  using limits = std::numeric_limits<double>;
  return {-0.0, limits::denorm_min(), limits::max(), -limits::infinity(), limits::quiet_NaN(), 0.1};
}

TEST(Vtp, VtkReadsBackPointsLinesPolygonsAndArraysBitForBit) {
  const TemporaryFolder folder("vtp");
  VtkSurface surface;
  surface.points = {{0, 0, 0}, {1.0 / 3, 0, 0}, {1, 1e-300, 0}, {0, 1, -0.0}, {2, 2, 1e17}};
  surface.lines.add(std::array{0, 4, 2});
  surface.polygons.add(std::array{0, 1, 2, 3});
  surface.polygons.add(std::array{2, 4, 3});
  const std::vector<double> scalars = {0.1, -0.0, 1e308, 5e-324, 3};
  const std::vector<Vec3> vectors = {{1, 2, 3}, {0.1, 0.2, 0.3}, {-1, -2, -3}};
  surface.point_arrays = {vtk_array("mass_kg", scalars)};
  surface.cell_arrays = {vtk_array("force_n", vectors),
                         vtk_array("part", std::vector<std::int32_t>{7, -1, 0}),
                         vtk_array_single("a < \"b\" & c", std::vector<double>{0.1, 0.2, 0.3})};
  write_vtp(folder.path / "a.vtp", surface);

  const json seen = seen_by_vtk(folder.path / "a.vtp");
  EXPECT_EQ(seen["class"], "vtkPolyData");
  expect_array(seen["points"], "Points", "double", 3, bits(flat(surface.points)));
  // VTK cell types: 4 poly-line, 9 quad, 5 triangle.
  EXPECT_EQ(seen["cells"], json::parse(R"([{"type": 4, "points": [0, 4, 2]},
    {"type": 9, "points": [0, 1, 2, 3]}, {"type": 5, "points": [2, 4, 3]}])"));
  ASSERT_EQ(seen["point_arrays"].size(), 1u);
  ASSERT_EQ(seen["cell_arrays"].size(), 3u);
  expect_array(seen["point_arrays"][0], "mass_kg", "double", 1, bits(scalars));
  expect_array(seen["cell_arrays"][0], "force_n", "double", 3, bits(flat(vectors)));
  expect_array(seen["cell_arrays"][1], "part", "int", 1, bits(std::vector<std::int32_t>{7, -1, 0}));
  expect_array(seen["cell_arrays"][2], "a < \"b\" & c", "float", 1, bits(std::vector<float>{.1f, .2f, .3f}));
}

TEST(Vtp, VtkReadsAnEmptySurface) {
  const TemporaryFolder folder("empty");
  write_vtp(folder.path / "empty.vtp", {});
  const json seen = seen_by_vtk(folder.path / "empty.vtp");
  EXPECT_EQ(seen["cells"].size(), 0u);
  EXPECT_EQ(seen["points"]["bytes"], "");
}

TEST(Vti, VtkReadsBackAFieldOfManyCompressedBlocksBitForBit) {
  const TemporaryFolder folder("vti");
  FlowField field;
  field.grid = {{-1, -1.5, 0.25}, {2, 3, 4.1}, 21, 32, 43};  // 28896 cells: 115584 and 346752 bytes
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < field.grid.cells(); ++i) {
    field.pressure.push_back(normal(random));
    field.velocity.push_back({normal(random), normal(random), normal(random)});
  }
  VtkImage image = flow_image(field);
  image.cell_arrays.push_back(vtk_array("exact", field.pressure));
  write_image(folder.path / "flow", image);

  const json seen = seen_by_vtk(folder.path / "flow.vti");
  EXPECT_EQ(seen["class"], "vtkImageData");
  EXPECT_EQ(seen["dimensions"], (json{22, 33, 44}));  // points
  EXPECT_EQ(seen["origin"], (json{-1, -1.5, 0.25}));
  const Vec3 spacing = field.grid.spacing();
  EXPECT_EQ(seen["spacing"], (json{spacing.x, spacing.y, spacing.z}));
  const std::vector<double> velocity = flat(field.velocity);
  ASSERT_EQ(seen["cell_arrays"].size(), 3u);
  expect_array(seen["cell_arrays"][0], "pressure_pa", "float", 1,
               bits(std::vector<float>(field.pressure.begin(), field.pressure.end())));
  expect_array(seen["cell_arrays"][1], "velocity_m_per_s", "float", 3,
               bits(std::vector<float>(velocity.begin(), velocity.end())));
  expect_array(seen["cell_arrays"][2], "exact", "double", 1, bits(field.pressure));
}

TEST(Vtr, VtkReadsBackGradedCellsBitForBit) {
  const TemporaryFolder folder("vtr");
  FlowField field;
  field.grid = graded({{-3, -2, 0}, {6, 4, 10}, 20, 21, 30}, {-0.5, -0.4, 2.5}, {0.5, 0.4, 4.5}, 1.4);
  for (int i = 0; i < field.grid.cells(); ++i) {
    field.pressure.push_back(i);
    field.velocity.push_back({1.0 * i, 2.0 * i, 3.0 * i});
  }
  EXPECT_EQ(write_image(folder.path / "flow", flow_image(field)), folder.path / "flow.vtr");
  const json seen = seen_by_vtk(folder.path / "flow.vtr");
  EXPECT_EQ(seen["class"], "vtkRectilinearGrid");
  for (int axis = 0; axis < 3; ++axis)
    expect_array(seen["coordinates"][axis], std::string(1, "xyz"[axis]), "double", 1,
                 bits(field.grid.edges(axis)));
  expect_array(seen["cell_arrays"][0], "pressure_pa", "float", 1,
               bits(std::vector<float>(field.pressure.begin(), field.pressure.end())));
}

TEST(Vti, ABlockThatIsExactlyFullNeedsNoPartialOne) {
  const TemporaryFolder folder("block");
  VtkImage image{{{0, 0, 0}, {1, 1, 1}, 32, 32, 64}, {}};  // 65536 doubles: two blocks of 2^18 bytes
  std::vector<double> values(65536);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0 / static_cast<double>(i + 1);
  image.cell_arrays = {vtk_array("v", values)};
  write_image(folder.path / "block", image);
  const json seen = seen_by_vtk(folder.path / "block.vti");
  expect_array(seen["cell_arrays"][0], "v", "double", 1, bits(values));
}

TEST(Vtp, ValuesThatAreNotFiniteOrDenormalSurvive) {
  const TemporaryFolder folder("awkward");
  VtkSurface surface;
  surface.points.resize(awkward_values().size());
  surface.point_arrays = {vtk_array("v", awkward_values())};
  surface.polygons.add(std::array{0, 1, 2, 3, 4, 5});
  write_vtp(folder.path / "a.vtp", surface);
  const json seen = seen_by_vtk(folder.path / "a.vtp");
  expect_array(seen["point_arrays"][0], "v", "double", 1, bits(awkward_values()));
}

TEST(Pvd, ListsTheFilesThatExistWithTheirIterationAsTime) {
  const TemporaryFolder folder("pvd");
  make_folder(folder.path / "shape");
  VtkSurface surface;
  surface.points = {{0, 0, 0}};
  write_vtp(folder.path / "shape/1.vtp", surface);
  write_vtp(folder.path / "shape/a&b.vtp", surface);
  write_pvd(folder.path / "shape.pvd", {{1, "shape/1.vtp"}, {2, "shape/gone.vtp"}, {2.5, "shape/a&b.vtp"}});
  const json seen = seen_by_vtk(folder.path / "shape.pvd");
  EXPECT_EQ(seen,
            json::parse(R"([{"time": 1.0, "class": "vtkPolyData"}, {"time": 2.5, "class": "vtkPolyData"}])"));
}

TEST(Vtk, InconsistentSizesAreAnErrorAndNoFile) {
  const TemporaryFolder folder("reject");
  VtkSurface short_array, wild_point;
  short_array.points.resize(3);
  short_array.point_arrays = {vtk_array("short", std::vector<double>(2))};
  EXPECT_THROW(write_vtp(folder.path / "a.vtp", short_array), Error);
  wild_point.points.resize(3);
  wild_point.polygons.add(std::array{0, 1, 3});
  EXPECT_THROW(write_vtp(folder.path / "a.vtp", wild_point), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

TEST(Vtk, TheCheckItselfNoticesADamagedFile) {
  const TemporaryFolder folder("damaged");
  VtkSurface surface;
  surface.points.resize(1000, Vec3{1, 2, 3});
  surface.polygons.add(std::array{0, 1, 2});
  write_vtp(folder.path / "a.vtp", surface);
  std::string bytes = read_file(folder.path / "a.vtp"), text;
  EXPECT_TRUE(vtk_reads(folder.path / "a.vtp", text)) << text;
  bytes[bytes.find("\n_") + 40] ^= 0x55;  // in the first compressed block
  write_file(folder.path / "b.vtp", bytes);
  EXPECT_FALSE(vtk_reads(folder.path / "b.vtp", text));
}

TEST(Stl, VtkReadsBackTheTriangles) {
  const TemporaryFolder folder("stl");
  const std::vector<Triangle> surface = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                         {{0, 0, 0}, {0, 1, 0}, {0, 0.1, 2}}};
  write_stl(folder.path / "a.stl", surface);
  const json seen = seen_by_vtk(folder.path / "a.stl");
  std::vector<float> corners;
  for (const Triangle& t : surface) {
    for (double value : flat({t.a, t.b, t.c})) corners.push_back(static_cast<float>(value));
  }
  expect_array(seen["points"], "Points", "float", 3, bits(corners));
  EXPECT_EQ(seen["cells"],
            json::parse(R"([{"type": 5, "points": [0, 1, 2]}, {"type": 5, "points": [3, 4, 5]}])"));
}

/// Two rows of a ring with one hole, and a line.
Mesh small_mesh() {
  Mesh mesh;
  Patch patch;
  patch.rows = 2;
  patch.columns = 4;
  patch.periodic = true;
  patch.cell_area = {1, 0, 1, 1};
  mesh.patches = {patch};
  for (int row : {1, 2}) {
    for (int column = 0; column < 4; ++column) {
      const double angle = column * 1.5707963267948966;
      mesh.start.push_back({row * std::cos(angle), row * std::sin(angle), 0});
    }
  }
  mesh.start.push_back({0, 0, -2});
  mesh.springs = {{8, 4, 1, 1, 0, 0, 3}, {8, 6, 1, 1, 0, 0, 5}};
  return mesh;
}

TEST(Vtp, ACanopyShowsItsClothWithoutHolesAndItsLines) {
  const TemporaryFolder folder("canopy");
  const Mesh mesh = small_mesh();
  VtkSurface canopy = canopy_surface(mesh, mesh.start);
  canopy.cell_arrays = {vtk_array("pressure_pa", cloth_cells_only(mesh, {10, 11, 12, 13}))};
  write_vtp(folder.path / "canopy.vtp", canopy);
  const json seen = seen_by_vtk(folder.path / "canopy.vtp");
  EXPECT_EQ(seen["cells"],
            json::parse(R"([{"type": 9, "points": [0, 1, 5, 4]}, {"type": 9, "points": [2, 3, 7, 6]},
                                           {"type": 9, "points": [3, 0, 4, 7]}])"));
  expect_array(seen["cell_arrays"][0], "pressure_pa", "double", 1, bits(std::vector<double>{10, 12, 13}));

  write_vtp(folder.path / "lines.vtp", spring_lines(mesh, mesh.start));
  const json lines = seen_by_vtk(folder.path / "lines.vtp");
  EXPECT_EQ(lines["cells"], json::parse(R"([{"type": 3, "points": [8, 4]}, {"type": 3, "points": [8, 6]}])"));
  expect_array(lines["cell_arrays"][0], "part", "int", 1, bits(std::vector<std::int32_t>{3, 5}));
}

}  // namespace
}  // namespace ripstop
