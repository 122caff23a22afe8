// Meshes that users put together themselves.
#include "ripstop/parachute/own_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../refusal.h"
#include "ripstop/canopy/stress.h"
#include "ripstop/cloth/cloth.h"

namespace ripstop::inline parachute {
namespace {

PartMaterials materials() {
  PartMaterials made;
  made.canopy.name = "cloth";
  made.canopy.coefficients_n_m = {20000};
  made.canopy.areal_density_kg_m2 = 0.04;
  made.line = made.riser = {"line", "", "", {5000}, 0.01, 0, 0, 0.002, 0, 0};
  return made;
}

constexpr int rows = 25, columns = 24;
constexpr double radius = 0.3, length = 1.2;

/// The outer side is outward: columns go against the clock seen from +z.
ClothLattice tube() {
  ClothLattice lattice{rows, columns, true, {}};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double angle = 2 * std::numbers::pi * column / columns;
      lattice.points.push_back(
          {radius * std::cos(angle), radius * std::sin(angle), length * row / (rows - 1)});
    }
  return lattice;
}

ClothLattice square(double width) {
  return {2, 2, false, {{0, 0, 0}, {width, 0, 0}, {0, width, 0}, {width, width, 0}}};
}

OwnMesh square_on_a_line() {
  OwnMesh mesh(materials());
  mesh.add_cloth("square", square(0.5));
  const int end = mesh.add_nodes({{0.2, 0.2, -1}});
  mesh.add_line({end, 0}, {});
  mesh.fix({end});
  return mesh;
}

}  // namespace

// N = p R around a tube, with R of the loaded shape; its ends are fixed and 2 R away.
TEST(OwnMesh, ATubeUnderPressureCarriesPressureTimesRadius) {
  OwnMesh own(materials());
  own.add_cloth("tube", tube());
  for (const int row : {0, rows - 1})
    for (int column = 0; column < columns; ++column) own.fix({row * columns + column});
  const CanopyMesh mesh = own.mesh();
  const ClothPtr cloth = make_cloth(mesh, {});
  ClothState state = start_state(*cloth);
  constexpr double pressure = 400;
  ThreadTeam team(1);
  ASSERT_TRUE(
      relax(state, *cloth, {std::vector<double>(mesh.cell_count(), pressure), {}}, {}, team).converged);
  const Vec3 middle = positions(state, *cloth)[rows / 2 * columns];
  const double carried = cell_stress(*cloth, state)[rows / 2 * columns].weft;
  EXPECT_NEAR(carried / (pressure * std::hypot(middle.x, middle.y)), 1, 0.02);
  EXPECT_GT(std::hypot(middle.x, middle.y), radius);
}

TEST(OwnMesh, HasTheMassOfItsClothAndLines) {
  const CanopyMesh mesh = square_on_a_line().mesh();
  double mass = 0;
  for (const double m : mesh.mass) mass += m;
  EXPECT_NEAR(mass, 0.25 * 0.04 + 0.002 * std::sqrt(0.2 * 0.2 + 0.2 * 0.2 + 1), 1e-12);
  EXPECT_NEAR(cloth_area(mesh), 0.25, 1e-12);
  ASSERT_EQ(mesh.rigging.lines.size(), 1u);
}

TEST(OwnMesh, ClothMayBeCutLargerThanItIsAtTheStart) {
  OwnMesh own(materials());
  ClothLattice lattice = square(0.5);
  lattice.flat = square(0.6).points;
  own.add_cloth("square", lattice);
  own.fix({0, 1});
  EXPECT_NEAR(cloth_area(own.mesh()), 0.36, 1e-12);
  EXPECT_NEAR(own.mesh().patches[0].rest_length[along_row][0], 0.6, 1e-12);
}

TEST(OwnMesh, ATiedNodeLiesWhereItsMastersHaveIt) {
  OwnMesh own = square_on_a_line();
  const int first = own.add_cloth("next", square(0.5));
  own.tie(first, {0, 1}, {0.25, 0.75});
  EXPECT_NEAR(own.mesh().start[static_cast<std::size_t>(first)].x, 0.375, 1e-12);
}

TEST(OwnMesh, RefusesIncompleteMeshesWithTheRemedy) {
  const auto words = [](const OwnMesh& own) { return refusal_of([&] { own.mesh(); }, ExitCode::usage); };
  OwnMesh own(materials());
  EXPECT_NE(words(own).find("no cloth"), std::string::npos);
  own.add_cloth("square", square(0.5));
  EXPECT_NE(words(own).find("no node is fixed"), std::string::npos);
  own.fix({0});
  own.add_nodes({{1, 1, 1}});
  EXPECT_NE(words(own).find("node 4 has no mass"), std::string::npos);
}

TEST(OwnMesh, RefusesImpossibleInputAndStaysAsItWas) {
  OwnMesh own = square_on_a_line();
  const int nodes = own.mesh().node_count();
  const auto refused = [&](const std::function<void()>& what, const char* word) {
    EXPECT_NE(refusal_of(what, ExitCode::usage).find(word), std::string::npos) << word;
  };
  ClothLattice coincident = square(0.5), infinite = square(0.5), few = square(0.5), flat = square(0.5);
  coincident.points[1] = coincident.points[0];
  infinite.points[2].z = INFINITY;
  few.points.pop_back();
  flat.flat.resize(3);
  refused([&] { own.add_cloth("a", coincident); }, "coincide");
  refused([&] { own.add_cloth("a", infinite); }, "point 2");
  refused([&] { own.add_cloth("a", few); }, "3 points for 2 rows of 2");
  refused([&] { own.add_cloth("a", flat); }, "3 points as cut");
  refused([&] { own.add_cloth("square", square(1)); }, "already");
  refused([&] { own.add_cloth("a", {1, 5, false, {}}); }, "at least 2 rows");
  refused([&] { own.add_cloth("a", {2, 2, true, {}}); }, "3 columns");
  refused([&] { own.add_nodes({{0, std::nan(""), 0}}); }, "point 0");
  refused([&] { own.add_line({0, 99}, {}); }, "no node 99");
  refused([&] { own.add_line({0, -1}, {}); }, "no node -1");
  refused([&] { own.add_line({0}, {}); }, "two nodes");
  refused([&] { own.add_line({0, 1}, {0.0}); }, "is 0 m");
  refused([&] { own.add_line({0, 1}, {1, 1}); }, "2 lengths for 2 nodes");
  refused([&] { own.add_tape({0, 1}, {}); }, "no tape");
  refused([&] { own.tie(1, {1}, {}); }, "itself");
  refused([&] { own.tie(4, {1}, {}); }, "fixed");
  refused([&] { own.tie(1, {2}, {0.5}); }, "add up to 0.5");
  own.tie(1, {2}, {});
  refused([&] { own.tie(2, {1}, {}); }, "tied");
  refused([&] { own.tie(1, {3}, {}); }, "already");
  refused([&] { own.fix({1}); }, "tied");
  refused([&] { own.set_skirt({0, 1}); }, "at least 3");
  EXPECT_EQ(own.mesh().node_count(), nodes);
}

}  // namespace ripstop::inline parachute
