#include <gtest/gtest.h>

#include "ripstop/canopy/stress.h"

namespace ripstop {
namespace {

// Cells of 1, 2 and 5 m2 and a hole next to them.
TEST(StressPeak, SharesAreOfTheClothsAreaAndPeaksOfItsCells) {
  Mesh mesh;
  Patch patch;
  patch.name = "sheet";
  patch.rows = 2;
  patch.columns = 5;
  patch.cell_area = {1, 2, 5, 0, 0};
  for (const Direction d : {along_row, along_column}) patch.rest_length[d].assign(10, 1.0);
  mesh.patches = {patch};
  for (const double y : {0., 1.})
    for (const double x : {0., 1., 3., 8., 9.}) mesh.start.push_back({x, y, 0});
  std::vector<CellStress> stress(5);
  stress[0] = {30, 10, 26, {1, 0, 0}, 30, 10, Tautness::taut, 0.02};
  stress[1] = {40, 0, 40, {0, 1, 0}, 5, 40, Tautness::wrinkled, 0.03};
  stress[2] = {0, 0, 0, {}, 0, 0, Tautness::slack, -0.01};
  const StressPeak peak = stress_peak(mesh, mesh.start, stress);
  EXPECT_DOUBLE_EQ(peak.wrinkled, 2. / 8);
  EXPECT_DOUBLE_EQ(peak.slack, 5. / 8);
  EXPECT_EQ(peak.principal, 40);
  EXPECT_EQ(peak.principal_direction, (Vec3{0, 1, 0}));
  EXPECT_EQ(peak.warp, 30);
  EXPECT_EQ(peak.weft, 40);
  EXPECT_EQ(peak.strain, 0.03);
  EXPECT_EQ(peak.von_mises, 40);
  EXPECT_EQ(peak.patch, "sheet");
  EXPECT_EQ(peak.place, (Vec3{2, 0.5, 0}));
}

// Half as wide as cut, a cell has twice the force per present width.
TEST(StressPeak, GatheredClothCountsWithItsWidthAsCut) {
  Mesh mesh;
  Patch patch;
  patch.rows = patch.columns = 2;
  patch.cell_area = {0.02, 0};
  for (const Direction d : {along_row, along_column}) patch.rest_length[d].assign(4, 0.1);
  mesh.patches = {patch};
  mesh.start = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.1, 0.1, 0}};
  std::vector<CellStress> stress(2);
  stress[0].warp = stress[0].principal_max = 80;
  const StressPeak peak = stress_peak(mesh, mesh.start, stress);
  EXPECT_NEAR(peak.warp, 40, 1e-12);
  EXPECT_NEAR(peak.principal, 40, 1e-12);
}

// 20 mm wide: all of it counts, from the corner too.
TEST(StressPeak, APatchNarrowerThanTheStripCountsAsFarAsItGoes) {
  Mesh mesh;
  Patch patch;
  patch.rows = 2, patch.columns = 5;
  patch.cell_area = {25e-6, 25e-6, 25e-6, 25e-6, 0};
  for (const Direction d : {along_row, along_column}) patch.rest_length[d].assign(10, 0.005);
  mesh.patches = {patch};
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 5; ++column) mesh.start.push_back({0.005 * column, 0.005 * row, 0});
  std::vector<CellStress> stress(5);
  stress[0].warp = 40;
  EXPECT_NEAR(stress_peak(mesh, mesh.start, stress).warp, 10, 1e-12);
}

// 100 N pull on the corner cell of a square sheet, whatever the cells.
TEST(StressPeak, APointLoadIsSpreadOverTheStripThatStrengthIsMeasuredOn) {
  for (const int cells : {15, 30, 35}) {
    Mesh mesh;
    const double h = 0.3 / cells;
    Patch patch;
    patch.rows = patch.columns = cells + 1;
    const std::size_t count = patch.rows * patch.columns;
    patch.cell_area.assign(count - patch.columns, 0.0);
    for (int row = 0; row < cells; ++row)
      for (int column = 0; column < cells; ++column) patch.cell_area[row * patch.columns + column] = h * h;
    for (const Direction d : {along_row, along_column}) patch.rest_length[d].assign(count, h);
    for (int row = 0; row <= cells; ++row)
      for (int column = 0; column <= cells; ++column) mesh.start.push_back({column * h, row * h, 0});
    mesh.patches = {patch};
    std::vector<CellStress> stress(count - patch.columns);
    const double width = strip_width / 2 + h / 2;  // of the square about the corner's cell, in one direction
    stress[0].warp = stress[0].von_mises = 100 / h;
    const StressPeak peak = stress_peak(mesh, mesh.start, stress);
    EXPECT_NEAR(peak.warp, 100 * h / (width * width), 1e-9) << cells;
    EXPECT_EQ(peak.von_mises, peak.warp);
    EXPECT_EQ(peak.weft, 0);
  }
}

}  // namespace
}  // namespace ripstop
