// Lattices of cloth with their masses, springs along paths, nodes tied to others.
#include "ripstop/mesh/builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace ripstop {
namespace {

Fabric cloth() {
  Fabric fabric;
  fabric.name = "cloth";
  fabric.coefficients_n_m = {30006, -18936};
  fabric.tested_strain = 0.33;
  fabric.areal_density_kg_m2 = 0.04;
  return fabric;
}

/// A flat sheet of `columns` x `rows` cells, 0.1 m wide and `height` [m] high.
PatchShape sheet(int columns, int rows, double height) {
  return {rows + 1, columns + 1, false, [=](int row, int column) {
            return Vec3{0.1 * column, height * row, 0};
          }};
}

/// A cylinder of 1 m radius and height that begins at `z`.
PatchShape cylinder(int columns, double z) {
  return {2, columns, true, [=](int row, int column) {
            const double angle = 2 * std::numbers::pi * column / columns;
            return Vec3{std::cos(angle), std::sin(angle), z + row};
          }};
}

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(MeshBuilder, ASheetWeighsItsAreaAndItsCornersAQuarterOfACell) {
  MeshBuilder builder;
  builder.add_patch("sheet", sheet(3, 4, 0.2), cloth());
  const Mesh& mesh = builder.mesh;
  EXPECT_NEAR(total(mesh.patches[0].cell_area), 0.3 * 0.8, 1e-12);
  EXPECT_NEAR(total(mesh.mass), 0.04 * 0.3 * 0.8, 1e-12);
  EXPECT_NEAR(mesh.mass[0], 0.25 * 0.04 * 0.02, 1e-15);
  EXPECT_EQ(mesh.cell_count(), 4 * 4);  // the last column has none
  const std::vector<Cell> cells = cells_of(mesh);
  EXPECT_EQ(std::count_if(cells.begin(), cells.end(), [](const Cell& c) { return c.corner[0] >= 0; }), 12);
}

// On square cells, whose diagonals carry the correct load along the sides.
TEST(MeshBuilder, SpringsAcrossASectionOfASheetAreTogetherAsWideAsTheSheet) {
  MeshBuilder builder;
  builder.add_patch("sheet", sheet(6, 4, 0.1), cloth());
  const Patch& patch = builder.mesh.patches[0];
  for (int row = 0; row < 4; ++row) {
    double width = 0;
    for (int column = 0; column <= 6; ++column) width += patch.width[along_column][row * 7 + column];
    EXPECT_NEAR(width, 0.6, 1e-12) << row;
  }
}

TEST(MeshBuilder, AStrandPutsItsMassOnItsNodesAndItsSpringsAreAsLongAsThePath) {
  MeshBuilder builder;
  const int patch = builder.add_patch("sheet", sheet(3, 2, 0.2), cloth());
  const double before = total(builder.mesh.mass);
  const Path edge = builder.row(patch, 0);
  const std::vector<int> springs =
      builder.add_springs(edge, {builder.law({{1000}, 0}), builder.part("tape"), 0.02, 0.1, 5e-3});
  ASSERT_EQ(springs.size(), 3u);
  double length = 0;
  for (const int s : springs) length += builder.mesh.springs[s].rest_length;
  EXPECT_NEAR(length, edge.length(), 1e-15);
  EXPECT_NEAR(total(builder.mesh.mass) - before, 5e-3 * 0.3, 1e-15);
  EXPECT_EQ(builder.part("tape"), builder.mesh.springs[springs[0]].part);
}

TEST(MeshBuilder, ANodeTiedToATiedNodeFollowsThatOnesMasters) {
  MeshBuilder builder;
  for (int i = 0; i < 4; ++i) builder.add_node({double(i), 1.0 * i * i, 0}, 1);
  builder.tie(2, {{0, 0.5}, {1, 0.5}});
  builder.tie(3, {{2, 0.5}, {1, 0.5}});
  builder.flatten_ties();
  const Tie& second = builder.mesh.ties[1];
  ASSERT_EQ(second.masters.size(), 2u);
  EXPECT_EQ(second.masters[0].node, 0);
  EXPECT_EQ(second.masters[0].weight, 0.25);
  EXPECT_EQ(second.masters[1].weight, 0.75);
  EXPECT_EQ(builder.mesh.start[3].x, 0.75);  // it is put where its masters have it
}

TEST(MeshBuilder, ARingTiedToOneWithHalfTheColumnsFollowsItsChords) {
  MeshBuilder builder;
  const int lower = builder.add_patch("lower", cylinder(8, 0), cloth());
  const int upper = builder.add_patch("upper", cylinder(4, 1), cloth());
  builder.tie_rows(lower, upper);
  builder.flatten_ties();
  const Mesh& mesh = builder.mesh;
  for (int column = 0; column < 8; ++column) {
    const Vec3 p = mesh.start[mesh.patches[lower].node(1, column)];
    EXPECT_NEAR(std::hypot(p.x, p.y), column % 2 == 0 ? 1 : std::sqrt(0.5), 1e-12) << column;
    EXPECT_NEAR(p.z, 1, 1e-15);
  }
}

}  // namespace
}  // namespace ripstop
