// Files of vtk.h read back; damaged ones are refused.
#include "ripstop/output/vtk_read.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/vtk.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class VtkRead : public testing::Test {
 protected:
  TemporaryFolder folder{"ripstop-vtk-read"};
  fs::path file(const char* name) const { return folder.path / name; }
};

TEST_F(VtkRead, ASurfaceComesBackBitForBit) {
  VtkSurface surface;
  surface.points = {{0.1, 0, 0}, {1.0 / 3, 0, 0}, {1, 1, -2e-17}, {0, 1, 5}};
  surface.polygons.add(std::array{0, 1, 2, 3});
  surface.lines.add(std::array{0, 2});
  surface.cell_arrays = {vtk_array("a", std::vector<double>{1.0 / 7, 2}),
                         vtk_array("part", std::vector<std::int32_t>{4, -1})};
  write_vtp(file("s.vtp"), surface);
  const VtkFile back = read_vtk(file("s.vtp"));
  const std::vector<double> points = {0.1, 0, 0, 1.0 / 3, 0, 0, 1, 1, -2e-17, 0, 1, 5};
  EXPECT_EQ(back.find("Points", "Points")->values, points);
  EXPECT_EQ(back.find("Polys", "connectivity")->values, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(back.find("Lines", "connectivity")->values, (std::vector<double>{0, 2}));
  EXPECT_EQ(back.find("CellData", "a")->values, (std::vector<double>{1.0 / 7, 2}));
  EXPECT_EQ(back.find("CellData", "part")->values, (std::vector<double>{4, -1}));
  EXPECT_EQ(back.find("CellData", "b"), nullptr);
}

TEST_F(VtkRead, ADamagedHeadIsRefusedBeforeAnythingIsMadeOfIt) {
  FlowField field;
  field.grid.size = {1, 1, 1};
  field.grid.nx = field.grid.ny = field.grid.nz = 2;
  field.pressure.assign(8, 1);
  field.velocity.assign(8, {});
  const std::string whole = read_file(write_image(folder.path / "flow", flow_image(field)));
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_file(file("damaged.vti"), text.replace(at, from.size(), to));
    EXPECT_THROW(read_vtk(file("damaged.vti")), Error) << to;
  };
  for (const char* extent : {"0 2000000000", "0 1e300", "0 nan"})
    refused("WholeExtent=\"0 2", std::string("WholeExtent=\"") + extent);
  for (const char* offset : {"-1", "0.5", "1e300"})
    refused("offset=\"0\"", std::string("offset=\"") + offset + "\"");
  refused("NumberOfComponents=\"", "NumberOfComponents=\"-");
  refused("NumberOfComponents=\"", "NumberOfComponents=\"1e300");
  refused("<DataArray ", "<DataArray><DataArray ");
}

// Larger than one block of the compression.
TEST_F(VtkRead, AFieldAndItsGridComeBack) {
  FlowField field;
  field.grid.origin = {-1, -2, 0};
  field.grid.size = {2, 4, 8};
  field.grid.nx = 40, field.grid.ny = 41, field.grid.nz = 42;
  for (int i = 0; i < field.grid.cells(); ++i) {
    field.pressure.push_back(i);
    field.velocity.push_back({0, 1.0 * i, -1});
  }
  const VtkFile back = read_vtk(write_image(folder.path / "flow", flow_image(field)));
  EXPECT_EQ(back.find("CellData", "pressure_pa")->values, field.pressure);
  EXPECT_EQ(back.find("CellData", "velocity_m_per_s")->values[3 * 777 + 1], 777);
  for (int axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(back.edges[axis].size(), field.grid.edges(axis).size());
    for (std::size_t i = 0; i < back.edges[axis].size(); ++i)
      EXPECT_NEAR(back.edges[axis][i], field.grid.edges(axis)[i], 1e-12);
  }
  const FlowGrid core = graded(field.grid, {-0.2, -0.2, 3}, {0.2, 0.2, 5}, 1.2);
  field.grid = core;
  const VtkFile uneven = read_vtk(write_image(folder.path / "graded", flow_image(field)));
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(uneven.edges[axis], core.edges(axis));
}

TEST_F(VtkRead, IncompleteChangedOrForeignFilesAreRefused) {
  VtkSurface surface;
  surface.points.assign(500, {0.1, 0.2, 0.3});
  for (int i = 0; i < 500; ++i) surface.points[i].x = 1.0 / (i + 1);
  surface.lines.add(std::array{0, 1});
  write_vtp(file("s.vtp"), surface);
  const std::string whole = read_file(file("s.vtp"));
  for (std::size_t size : {whole.size() / 2, std::size_t{40}, std::size_t{0}}) {
    write_file(file("cut.vtp"), whole.substr(0, size));
    EXPECT_THROW(read_vtk(file("cut.vtp")), Error) << size;
  }
  std::string changed = whole;
  changed[changed.find("_", changed.find("<AppendedData")) + 17] ^= '\x7f';  // the size of its one block
  write_file(file("changed.vtp"), changed);
  EXPECT_THROW(read_vtk(file("changed.vtp")), Error);
  write_file(file("other.vtp"), "<?xml version=\"1.0\"?><VTKFile></VTKFile>");
  EXPECT_THROW(read_vtk(file("other.vtp")), Error);
}

}  // namespace
}  // namespace ripstop
