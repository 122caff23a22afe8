#include "ripstop/flow/flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ripstop {
namespace {

Vec3 centre(const FlowGrid& grid, int cell) {
  const Vec3 h = grid.spacing();
  const int i = cell % grid.nx, j = cell / grid.nx % grid.ny, k = cell / (grid.nx * grid.ny);
  return grid.origin + Vec3{(i + 0.5) * h.x, (j + 0.5) * h.y, (k + 0.5) * h.z};
}

TEST(Sample, IsExactForLinearFieldsBetweenCentresAndConstantBeyond) {
  const FlowGrid grid{{-1, 2, 0.5}, {2, 1, 3}, 5, 4, 7};
  const auto linear = [](Vec3 p) { return 3 - 2 * p.x + 5 * p.y + 0.7 * p.z; };
  std::vector<double> scalar(grid.cells());
  std::vector<Vec3> vector(grid.cells());
  for (int c = 0; c < grid.cells(); ++c) {
    const Vec3 p = centre(grid, c);
    scalar[c] = linear(p);
    vector[c] = {linear(p), p.y, -p.z};
  }
  const Vec3 low = centre(grid, 0), high = centre(grid, grid.cells() - 1);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> wide(-3, 6);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 p{wide(random), wide(random), wide(random)};
    const Vec3 inside{std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y),
                      std::clamp(p.z, low.z, high.z)};
    EXPECT_NEAR(sample(grid, scalar, p), linear(inside), 1e-13 * 50);
    const Vec3 v = sample(grid, vector, p);
    EXPECT_NEAR(norm(v - Vec3{linear(inside), inside.y, -inside.z}), 0, 1e-12);
  }
}

TEST(Sample, WorksOnAGridOneCellThick) {
  const FlowGrid grid{{0, 0, 0}, {1, 1, 1}, 1, 1, 2};
  const std::vector<double> field = {2, 4};
  EXPECT_DOUBLE_EQ(sample(grid, field, {0.9, 0.1, 0.5}), 3);
}

using Polygon = std::vector<Vec3>;

/// The part of a convex polygon where sign * (component - bound) <= 0 (Sutherland and Hodgman).
Polygon clip(const Polygon& polygon, double Vec3::*axis, double bound, double sign) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double da = sign * (a.*axis - bound), db = sign * (b.*axis - bound);
    if (da <= 0) kept.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

/// Whether a box, enlarged by `margin` on all sides, contains a part of the triangle.
bool brute_force(const Triangle& t, Vec3 low, Vec3 high, double margin) {
  Polygon polygon = {t.a, t.b, t.c};
  for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    polygon = clip(polygon, axis, low.*axis - margin, -1);
    polygon = clip(polygon, axis, high.*axis + margin, 1);
  }
  return !polygon.empty();
}

TEST(CutCells, AreThoseThatHoldAPartOfTheSurfaceClippedToThem) {
  const FlowGrid grid{{-1, -0.5, 0}, {2, 1, 3}, 11, 7, 13};
  const Vec3 half = 0.5 * grid.spacing();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> wide(-0.3, 1.3), narrow(-0.1, 0.1);
  int cut = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const auto point = [&] {
      return grid.origin +
             Vec3{wide(random) * grid.size.x, wide(random) * grid.size.y, wide(random) * grid.size.z};
    };
    Triangle t{point(), point(), point()};
    if (trial % 2 == 1) {  // smaller than a cell
      t.b = t.a + Vec3{narrow(random), narrow(random), narrow(random)};
      t.c = t.a + Vec3{narrow(random), narrow(random), narrow(random)};
    }
    const std::vector<int> cells = cut_cells(grid, {t});
    cut += static_cast<int>(cells.size());
    EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end()));
    for (int c = 0; c < grid.cells(); ++c) {
      const Vec3 p = centre(grid, c);
      const bool found = std::binary_search(cells.begin(), cells.end(), c);
      if (brute_force(t, p - half, p + half, -1e-9)) {
        EXPECT_TRUE(found) << trial << " cell " << c;
      }
      if (!brute_force(t, p - half, p + half, 1e-9)) {
        EXPECT_FALSE(found) << trial << " cell " << c;
      }
    }
  }
  EXPECT_GT(cut, 1000);
}

/// Two triangles of the rectangle [x0, x1] x [y0, y1] at height z.
std::vector<Triangle> rectangle(double x0, double x1, double y0, double y1, double z) {
  return {{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}}, {{x0, y0, z}, {x1, y1, z}, {x0, y1, z}}};
}

TEST(CutCells, APlaneInsideALayerCutsThatLayerOnly) {
  const FlowGrid grid{{0, 0, 0}, {1, 1, 1}, 8, 8, 8};
  const std::vector<int> cells = cut_cells(grid, rectangle(-1, 2, -1, 2, 0.4));
  ASSERT_EQ(cells.size(), 64u);
  EXPECT_EQ(cells.front(), grid.index(0, 0, 3));
  EXPECT_EQ(cells.back(), grid.index(7, 7, 3));
}

TEST(CutCells, APlaneInAFaceOfTheGridTouchesTheCellsOnBothSides) {
  for (const double origin : {0.0, -0.3, 7.1}) {  // not all faces are round numbers
    const FlowGrid grid{{origin, origin, origin}, {0.7, 0.7, 0.7}, 7, 7, 7};
    const double face = origin + 3 * grid.spacing().z;
    EXPECT_EQ(
        cut_cells(grid, rectangle(origin + 0.01, origin + 0.69, origin + 0.01, origin + 0.69, face)).size(),
        2u * 49);
    const double below = face - 1e-12;
    EXPECT_EQ(
        cut_cells(grid, rectangle(origin + 0.01, origin + 0.69, origin + 0.01, origin + 0.69, below)).size(),
        49u);
  }
}

TEST(CutCells, APointOfContactIsEnough) {
  const FlowGrid grid{{0, 0, 0}, {2, 2, 2}, 2, 2, 2};
  const std::vector<int> all = {0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(cut_cells(grid, {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}), all);
  EXPECT_EQ(cut_cells(grid, {{{2, 2, 2}, {3, 2, 2}, {2, 3, 3}}}), std::vector<int>{7});
}

TEST(CutCells, OutsideTheGridNothingIsCut) {
  const FlowGrid grid{{0, 0, 0}, {1, 1, 1}, 4, 4, 4};
  EXPECT_TRUE(cut_cells(grid, rectangle(-1, 2, -1, 2, 1.01)).empty());
  EXPECT_TRUE(cut_cells(grid, rectangle(5, 6, 5, 6, 0.5)).empty());
  EXPECT_TRUE(cut_cells(grid, {}).empty());
}

}  // namespace
}  // namespace ripstop
