// The canopy of the report is that of the files that the run left.
#include "ripstop/report/shape_view.h"

#include <gtest/gtest.h>

#include "../refusal.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/vtk.h"

namespace ripstop {
namespace {

struct ShapeOfFiles : testing::Test {
  TemporaryFolder folder{"shape-view"};

  /// A cell of cloth, and a line of two segments with the spring that bends it over both.
  ShapeFiles write(double time, const std::vector<int>& cell, double size = 1) {
    VtkSurface canopy, lines;
    canopy.points = {{0, 0, size}, {size, 0, size}, {size, size, size}, {0, size, size}};
    canopy.polygons.add(cell);
    lines.points = {{0, 0, 1 + time}, {0, 0, 0.5}, {0, 0, 0}};
    for (const auto& ends : {std::array{0, 1}, {0, 2}, {1, 2}}) lines.lines.add(ends);
    lines.cell_arrays = {vtk_array("part", std::vector<std::int32_t>{4, 4, 4}),
                         vtk_array("tension_n", std::vector<double>{10, 3, 12})};
    const ShapeFiles files{time, folder.path / (std::to_string(time) + "-canopy.vtp"),
                           folder.path / (std::to_string(time) + "-lines.vtp")};
    write_vtp(files.canopy, canopy), write_vtp(files.lines, lines);
    return files;
  }
};

TEST_F(ShapeOfFiles, WhatBendsALineIsNoLineAndItsTensionIsTheLines) {
  const ShapeView view = read_shape({write(0, {0, 1, 2, 3}), write(0.1, {0, 1, 2, 3})});
  EXPECT_EQ(view.quads, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(view.segments, (std::vector<int>{0, 1, 1, 2}));
  EXPECT_EQ(view.parts, (std::vector<int>{4, 4}));
  ASSERT_EQ(view.frames.size(), 2u);
  for (const ShapeFrame& frame : view.frames) EXPECT_EQ(frame.line_values, (std::vector<double>{13, 15}));
  EXPECT_EQ(view.frames[1].time, 0.1);
}

TEST_F(ShapeOfFiles, HoweverShortTheLinesAre) {
  for (const double size : {0.01, 100.0}) {
    const ShapeView view = read_shape({write(0, {0, 1, 2, 3}, size)});
    EXPECT_EQ(view.segments, (std::vector<int>{0, 1, 1, 2})) << size;
    EXPECT_EQ(view.frames.at(0).line_values, (std::vector<double>{13, 15})) << size;
  }
}

TEST_F(ShapeOfFiles, FramesOfTwoMeshesAreRefused) {
  ShapeFiles files = write(0, {0, 1, 2, 3});
  VtkSurface canopy;
  canopy.points = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0, 2, 1}, {1, 2, 1}};
  canopy.polygons.add(std::vector<int>{0, 1, 2, 3}), canopy.polygons.add(std::vector<int>{3, 2, 5, 4});
  canopy.cell_arrays = {vtk_array("stress", std::vector<double>{1, 2})};
  ShapeFiles larger = files;
  larger.canopy = folder.path / "larger.vtp";
  write_vtp(larger.canopy, canopy);
  EXPECT_NO_THROW(read_shape({larger}));
  const std::string message = refusal_of([&] { read_shape({files, larger}); }, ExitCode::bad_data);
  EXPECT_NE(message.find("larger.vtp"), std::string::npos) << message;
  EXPECT_NE(message.find("has a different mesh"), std::string::npos) << message;
}

TEST_F(ShapeOfFiles, ValuesThatAreNotOneACellAreRefused) {
  const ShapeFiles first = write(0, {0, 1, 2, 3}), second = write(0.1, {0, 1, 2, 3});
  VtkSurface canopy;
  canopy.points = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  canopy.polygons.add(std::vector<int>{0, 1, 2, 3}), canopy.polygons.add(std::vector<int>{1, 2, 3, 0});
  canopy.cell_arrays = {vtk_array("stress", std::vector<double>{1, 2})};
  write_vtp(second.canopy, canopy);
  const std::string message = refusal_of([&] { read_shape({first, second}); }, ExitCode::bad_data);
  EXPECT_NE(message.find("has arrays of another length than its cells"), std::string::npos) << message;
}

TEST_F(ShapeOfFiles, CellsOfAnotherKindAreRefused) {
  EXPECT_THROW(read_shape({write(0, {0, 1, 2})}), Error);
}

}  // namespace
}  // namespace ripstop
