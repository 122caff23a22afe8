// A canopy's sector: found where there is one, and all of the canopy in it. That it rests where the canopy does:
// parachute/symmetry_test.cpp.
#include "ripstop/cloth/sector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "builders.h"

namespace ripstop {
namespace {

using namespace testing;
using std::numbers::pi;

constexpr int gores = 8, columns_round = 8 * gores, disk_rows = 12;

/// A flat disk with a vent, of cloth that wrinkles, its seams and hems taped, with lines across the vent, on lines to a
/// riser.
Mesh canopy() {
  Mesh mesh;
  PatchSpec disk;
  disk.rows = disk_rows, disk.columns = columns_round, disk.periodic = true;
  disk.position = [](int row, int column) {
    const double r = 0.5 - 0.45 * row / (disk_rows - 1), angle = 2 * pi * column / columns_round;
    return Vec3{r * std::cos(angle), r * std::sin(angle), 0};
  };
  FabricSpec fabric;
  fabric.buckling_strain = 1e-6;
  add_patch(mesh, disk, fabric);
  const auto add_node = [&](Vec3 x) {
    mesh.start.push_back(x);
    mesh.mass.push_back(1e-4);
    return mesh.node_count() - 1;
  };
  mesh.laws.push_back({{2000}, 0});
  mesh.parts.push_back("cord");
  const auto join = [&](int a, int b) {
    mesh.springs.push_back({a, b, norm(mesh.start[a] - mesh.start[b]), 1, 0, 0, 0});
  };
  const Patch& patch = mesh.patches[0];
  const int confluence = add_node({0, 0, -0.9}), end = add_node({0, 0, -1});
  mesh.fixed.push_back(end);
  join(end, confluence);
  for (const int row : {0, disk_rows - 1})
    for (int column = 0; column < columns_round; ++column)
      join(patch.node(row, column), patch.node(row, (column + 1) % columns_round));
  for (int gore = 0; gore < gores; ++gore) {
    const int column = gore * columns_round / gores;
    for (int row = 0; row + 1 < disk_rows; ++row) join(patch.node(row, column), patch.node(row + 1, column));
    const Vec3 skirt = mesh.start[patch.node(0, column)];
    const int middle = add_node(0.5 * (skirt + mesh.start[confluence]));
    join(confluence, middle);
    join(middle, patch.node(0, column));
    if (gore < gores / 2)
      join(patch.node(disk_rows - 1, column), patch.node(disk_rows - 1, column + columns_round / 2));
  }
  return mesh;
}

Loads even(const Mesh& mesh, double pressure) {
  return {std::vector<double>(mesh.cell_count(), pressure), {}};
}

TEST(Sector, IsHalfAGoreWhoseImagesAreTheCanopy) {
  const Mesh mesh = canopy();
  Loads loads = even(mesh, 100);
  loads.cell_pressure[3 * columns_round + 1] +=
      columns_round;  // of one cell, in the second column of a half gore
  const auto sector = sector_of(mesh, mesh.start, loads);
  ASSERT_TRUE(sector);
  EXPECT_EQ(sector->images, 2 * gores);
  EXPECT_EQ(sector->mesh.patches[0].columns, columns_round / gores / 2 + 1);
  const std::vector<Vec3> again = sector->whole(sector->mesh.start);
  ASSERT_EQ(again.size(), mesh.start.size());
  for (std::size_t i = 0; i < again.size(); ++i) EXPECT_LT(norm(again[i] - mesh.start[i]), 1e-14) << i;
  double area = 0, of_sector = 0;
  for (const double a : mesh.patches[0].cell_area) area += a;
  for (const double a : sector->mesh.patches[0].cell_area) of_sector += a;
  EXPECT_NEAR(2 * gores * of_sector, area, 1e-12);
  const auto stiffness = [](const Mesh& m) {  // of tape, lines and riser
    double sum = 0;
    for (const Spring& spring : m.springs) sum += spring.scale / spring.rest_length;
    return sum;
  };
  // A line across the vent is two halves, each twice as stiff.
  const double across = gores / 2 / 0.1;
  EXPECT_NEAR(2 * gores * stiffness(sector->mesh), stiffness(mesh) + 3 * across, 1e-9);
  EXPECT_NEAR(sector->loads.cell_pressure[3 * sector->mesh.patches[0].columns + 1],
              100 + columns_round / (2.0 * gores), 1e-12);
}

TEST(Sector, IsAsWideAsTheSpringsAreAlike) {
  const auto images = [](const Mesh& mesh) {
    const auto sector = sector_of(mesh, mesh.start, even(mesh, 100));
    return sector ? sector->images : 0;
  };
  Mesh mesh = canopy();
  const int every_second = columns_round / gores * 2;
  for (int column = 0; column < columns_round; column += every_second)
    mesh.springs.push_back(
        {mesh.patches[0].node(4, column), mesh.patches[0].node(5, column), 0.03, 1, 0, 0, 0});
  EXPECT_EQ(images(mesh), gores) << "tape at every second seam";
  mesh = canopy();
  mesh.springs[2 * columns_round + disk_rows + 2].rest_length *= 1.01;
  EXPECT_EQ(images(mesh), 4) << "one line across the vent is longer: mirrored along it and across";
  mesh = canopy();
  mesh.springs[2 * columns_round + 4].rest_length *= 1.01;
  EXPECT_EQ(images(mesh), 0);
  mesh = canopy();
  mesh.start.back().x += 1e-4;
  EXPECT_EQ(images(mesh), 0);
  mesh = canopy();
  EXPECT_FALSE(sector_of(mesh, mesh.start, {{}, std::vector<Vec3>(mesh.node_count())}));
  mesh = rectangle(5, 9, 0.02);
  for (Vec3& x : mesh.start) x -= Vec3{0.08, 0.04, 0};
  EXPECT_EQ(images(mesh), 0);
}

}  // namespace
}  // namespace ripstop
