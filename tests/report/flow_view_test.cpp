// The air of the report is the field's own.
#include "ripstop/report/flow_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/file.h"
#include "ripstop/output/vtk.h"

namespace ripstop {
namespace {

// A linear field comes back at the view's own places, and the view covers the canopy and no more than the box.
TEST(FlowView, ALinearFieldIsThatOfThePlacesThatItNames) {
  const TemporaryFolder folder("flow-view");
  FlowField field;
  field.grid = {{-2, -3, -1}, {4, 6, 10}, 20, 24, 30};
  const FlowGrid& grid = field.grid;
  const auto pressure = [](Vec3 p) { return p.x + 10 * p.y + 100 * p.z; };
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        field.pressure.push_back(pressure(grid.centre(i, j, k)));
        field.velocity.push_back({0, 0, 2 + grid.centre(0, i)});
      }
  const FlowView view =
      read_flow(write_image(folder.path / "flow", flow_image(field)), {-0.5, -0.6, 1}, {0.5, 0.6, 2}, 4000);
  ASSERT_EQ(view.pressure.size(), std::size_t(view.cells[0]) * view.cells[1] * view.cells[2]);
  EXPECT_LE(view.pressure.size(), 4000u);
  const double wide = 1.2, low[] = {-0.5, -0.6, 1}, high[] = {0.5, 0.6, 2};
  const double origin[] = {view.origin.x, view.origin.y, view.origin.z};
  const double spacing[] = {view.spacing.x, view.spacing.y, view.spacing.z};
  for (int axis = 0; axis < 3; ++axis) {
    const double from = origin[axis] - 0.5 * spacing[axis], to = from + view.cells[axis] * spacing[axis];
    EXPECT_NEAR(from, low[axis] - 0.75 * wide, 1e-6) << axis;
    EXPECT_NEAR(to, high[axis] + (axis == 2 ? 2 : 0.75) * wide, 1e-6) << axis;
  }
  std::size_t cell = 0;
  for (int k = 0; k < view.cells[2]; ++k)
    for (int j = 0; j < view.cells[1]; ++j)
      for (int i = 0; i < view.cells[0]; ++i, ++cell) {
        const Vec3 at{origin[0] + i * spacing[0], origin[1] + j * spacing[1], origin[2] + k * spacing[2]};
        ASSERT_NEAR(view.pressure[cell], pressure(at), 1e-3) << i << " " << j << " " << k;
        ASSERT_NEAR(view.speed[cell], 2 + at.x, 1e-5);
      }
}

TEST(FlowView, EveryPointOfAStreamlineHasTheSpeedOfTheAirThere) {
  const TemporaryFolder folder("flow-view");
  FlowField field;
  field.grid = {{-2, -3, -1}, {4, 6, 10}, 20, 24, 30};
  for (int cell = 0; cell < field.grid.cells(); ++cell) {
    field.pressure.push_back(0);
    field.velocity.push_back({0, 0, 2 + field.grid.centre(0, cell % field.grid.nx)});
  }
  const FlowView view =
      read_flow(write_image(folder.path / "flow", flow_image(field)), {-0.5, -0.6, 1}, {0.5, 0.6, 2}, 4000);
  std::size_t points = 0;
  for (const int length : view.lengths) points += static_cast<std::size_t>(length);
  EXPECT_GT(view.lengths.size(), 100u);
  ASSERT_EQ(view.streamlines.size(), 3 * points);
  ASSERT_EQ(view.streamline_speed.size(), points);
  for (std::size_t n = 0; n < points; ++n)
    ASSERT_NEAR(view.streamline_speed[n], 2 + view.streamlines[3 * n], 1e-5) << n;
  std::size_t first = 0;  // of a line
  for (const int length : view.lengths) {
    for (std::size_t n = first + 1; n < first + static_cast<std::size_t>(length); ++n) {
      ASSERT_NEAR(view.streamlines[3 * n], view.streamlines[3 * first], 1e-9);
      ASSERT_GT(view.streamlines[3 * n + 2], view.streamlines[3 * n - 1]);
    }
    first += static_cast<std::size_t>(length);
  }
}

// Beyond the outermost centres the field is that of the outermost cells, which are wide where the grid is graded.
TEST(FlowView, AtTheEdgeOfTheBoxIsTheOutermostCell) {
  const TemporaryFolder folder("flow-view");
  FlowField field;
  field.grid = graded({{-2, -2, 0}, {4, 4, 6}, 20, 20, 26}, {-0.7, -0.7, 2}, {0.7, 0.7, 3.5}, 1.2);
  const FlowGrid& grid = field.grid;
  for (int cell = 0; cell < grid.cells(); ++cell) {
    field.pressure.push_back(grid.centre(0, cell % grid.nx));
    field.velocity.push_back({0, 0, 1});
  }
  const FlowView view =
      read_flow(write_image(folder.path / "flow", flow_image(field)), {-1.9, -1.9, 0.1}, {1.9, 1.9, 5.9});
  EXPECT_NEAR(view.origin.x - 0.5 * view.spacing.x, -2, 1e-9);
  const double first = grid.centre(0, 0), last = grid.centre(0, grid.nx - 1);
  ASSERT_LT(view.origin.x, first);
  for (std::size_t cell = 0; cell < view.pressure.size(); ++cell) {
    const double x = view.origin.x + view.spacing.x * static_cast<double>(cell % view.cells[0]);
    ASSERT_NEAR(view.pressure[cell], std::clamp(x, first, last), 1e-6) << cell;
  }
}

}  // namespace
}  // namespace ripstop
