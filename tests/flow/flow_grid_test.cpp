#include "ripstop/flow/flow_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/flow.h"

namespace ripstop {
namespace {

FlowGrid wide_box() {
  return graded({{-3, -2, 0}, {6, 4, 10}, 50, 41, 70}, {-0.5, -0.4, 2.5}, {0.5, 0.4, 4.5}, 1.12);
}

TEST(GradedGrid, IsUniformInItsCoreAndGrowsOutwardByAConstantRatioWithinTheBound) {
  const FlowGrid grid = wide_box();
  EXPECT_FALSE(grid.uniform());
  const double low[] = {-0.5, -0.4, 2.5}, high[] = {0.5, 0.4, 4.5};
  const Vec3 h = grid.spacing();
  const double fine[] = {h.x, h.y, h.z};
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> edges = grid.edges(axis);
    const Grading& g = grid.grading[axis];
    EXPECT_EQ(edges.front(), axis == 0 ? -3 : axis == 1 ? -2 : 0);
    EXPECT_EQ(edges.back(), axis == 0 ? 3 : axis == 1 ? 2 : 10);
    for (int c = 0; c + 1 < grid.count(axis); ++c) {
      const double ratio = grid.width(axis, c + 1) / grid.width(axis, c);
      const bool inside = grid.centre(axis, c) > low[axis] && grid.centre(axis, c + 1) < high[axis];
      const double expected = inside                             ? 1
                              : grid.centre(axis, c) < low[axis] ? 1 / g.ratio_before
                                                                 : g.ratio_after;
      EXPECT_NEAR(ratio, expected, 1e-9) << axis << " " << c;
      EXPECT_LT(std::max(ratio, 1 / ratio), 1.12 + 1e-9);
    }
    EXPECT_NEAR(grid.width(axis, grid.cell_at(axis, 0.5 * (low[axis] + high[axis]))), fine[axis], 1e-12);
    EXPECT_LT(fine[axis], 0.6 * (edges.back() - edges.front()) / grid.count(axis));
    for (int c = 0; c < grid.count(axis); ++c) EXPECT_EQ(grid.cell_at(axis, grid.centre(axis, c)), c);
  }
}

TEST(GradedGrid, OneCellOutsideOfTheCoreMakesItGraded) {
  for (const bool before : {true, false}) {
    FlowGrid grid{{0, 0, 0}, {4, 1, 1}, 3, 1, 1};
    if (before)
      grid.grading[0] = {2, 4, 1, 0, 2, 1};
    else
      grid.grading[0] = {0, 2, 0, 1, 1, 2};
    EXPECT_FALSE(grid.uniform()) << before;
    const std::vector<double> edges = grid.edges(0);
    EXPECT_NEAR(edges[1], before ? 2 : 1, 1e-12);
    EXPECT_NEAR(edges[2], before ? 3 : 2, 1e-12);
    EXPECT_NEAR(edges[3], 4, 1e-12);
  }
}

TEST(GradedGrid, VolumesFillTheBoxAndLinearFieldsAreSampledExactly) {
  const FlowGrid grid = wide_box();
  std::vector<double> linear(grid.cells());
  double volume = 0;
  for (int c = 0; c < grid.cells(); ++c) {
    const Vec3 p = grid.centre(c % grid.nx, c / grid.nx % grid.ny, c / grid.nx / grid.ny);
    linear[c] = 2 * p.x - 3 * p.y + 0.5 * p.z + 1;
    volume += grid.cell_volume(c);
  }
  EXPECT_NEAR(volume, 6 * 4 * 10, 1e-9);
  for (const Vec3 p :
       {Vec3{0, 0, 3}, Vec3{-2.1, 1.3, 8.7}, Vec3{1.01, -0.77, 0.9}, Vec3{0.4999, 0.4001, 4.5}})
    EXPECT_NEAR(sample(grid, linear, p), 2 * p.x - 3 * p.y + 0.5 * p.z + 1, 1e-12);
}

TEST(GradedGrid, CellsThatASurfaceCutsAreThoseThatItsPointsLieIn) {
  const FlowGrid grid = wide_box();
  const std::vector<int> cut = cut_cells(grid, disk(3, {0.01, 0.02, 3.013}));
  std::vector<char> expected(grid.cells(), 0);
  const int k = grid.cell_at(2, 3.013);
  for (int i = 0; i <= 3000; ++i) {
    for (int j = 0; j <= 3000; ++j) {
      const double x = 0.01 + 1.4999 * (i / 1500.0 - 1), y = 0.02 + 1.4999 * (j / 1500.0 - 1);
      if (std::hypot(x - 0.01, y - 0.02) < 1.4995)
        expected[grid.index(grid.cell_at(0, x), grid.cell_at(1, y), k)] = 1;
    }
  }
  int missed = 0, sampled = 0;
  std::vector<char> found(grid.cells(), 0);
  for (const int c : cut) {
    found[c] = 1;
    EXPECT_EQ(c / grid.nx / grid.ny, k);
  }
  for (int c = 0; c < grid.cells(); ++c) sampled += expected[c], missed += expected[c] && !found[c];
  EXPECT_EQ(missed, 0);
  EXPECT_LE(static_cast<int>(cut.size()), sampled + 4);  // corners that the points' spacing may pass over
}

TEST(GradedGrid, CoarserKeepsBoxAndCoreWithHalfTheCells) {
  const FlowGrid fine = wide_box(), coarse = coarser(fine);
  EXPECT_EQ(coarse.origin, fine.origin);
  EXPECT_EQ(coarse.size, fine.size);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(coarse.count(axis), 0.5 * fine.count(axis), 2);
    EXPECT_EQ(coarse.grading[axis].core_low, fine.grading[axis].core_low);
    EXPECT_EQ(coarse.grading[axis].core_high, fine.grading[axis].core_high);
  }
}

TEST(GradedGrid, ReportsAnImpossibleGrid) {
  const FlowGrid box{{-3, -2, 0}, {6, 4, 10}, 50, 40, 70};
  const auto message = [&](Vec3 low, Vec3 high, double growth) -> std::string {
    try {
      graded(box, low, high, growth);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({-4, -0.4, 2.5}, {0.5, 0.4, 4.5}, 1.1).find("the domain from -3 m to 3 m"),
            std::string::npos);
  EXPECT_NE(message({-0.5, -0.4, 2.5}, {0.5, 0.4, 4.5}, 1).find("growth = 1"), std::string::npos);
  const std::string few = message({-0.01, -0.4, 2.5}, {0.01, 0.4, 4.5}, 1.02);
  EXPECT_NE(few.find("50 cells along x leave 0 cells in the core region"), std::string::npos) << few;
  EXPECT_TRUE(graded(box, {}, {}, 1.1).uniform());
}

}  // namespace
}  // namespace ripstop
