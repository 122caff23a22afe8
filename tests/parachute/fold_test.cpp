// The folded start keeps the cloth as it was cut.
#include "ripstop/parachute/fold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../printed_materials.h"
#include "../turned_symmetry.h"
#include "ripstop/core/error.h"
#include "ripstop/parachute/build.h"
#include "ripstop/parachute/disk_gap_band.h"

namespace ripstop {
namespace {

using std::numbers::pi;

Design disk_gap_band(int nodes, int gores, int lines) {
  Design design = printed_stratos(nodes);
  design.gores = gores;
  design.lines.count = lines;
  return design;
}

CanopyMesh stratos_mesh() {
  return build_mesh(disk_gap_band(25600, 6, 18), printed_materials());
}

double radius(Vec3 p) {
  return std::hypot(p.x, p.y);
}

TEST(Fold, EveryFoldThatFitsKeepsAllLengthsAndEveryTie) {
  const CanopyMesh mesh = stratos_mesh();
  for (const double r : {0.1, 0.2, 0.45}) {
    for (const int folds : {9, 18}) {
      const FoldedStart start = fold(mesh, {r, folds, 0});
      const StartStrain strain = start_strain(mesh, start.positions);
      EXPECT_LT(strain.largest, 1e-9) << r << " " << folds << " " << strain.part;
      for (const Tie& tie : mesh.ties) {
        Vec3 place{};
        for (const Tie::Master& master : tie.masters) place += master.weight * start.positions[master.node];
        ASSERT_LT(norm(place - start.positions[tie.node]), 1e-12);
      }
    }
  }
}

TEST(Fold, TheSkirtsFoldsLieOnEitherSideOfTheGivenRadius) {
  const CanopyMesh mesh = stratos_mesh();
  const FoldedStart start = fold(mesh, {0.1, 0, 0});
  EXPECT_EQ(start.folds, 18);  // one a line
  EXPECT_NEAR(0.5 * (start.inner_radius + start.outer_radius), 0.1, 1e-12);
  double largest = 0, smallest = 1, most_z = 0;
  for (const int node : mesh.rigging.skirt_nodes) {
    largest = std::max(largest, radius(start.positions[node]));
    smallest = std::min(smallest, radius(start.positions[node]));
  }
  for (const Patch& patch : mesh.patches) {
    for (int i = 0; i < patch.rows * patch.columns; ++i) {
      EXPECT_LE(radius(start.positions[patch.first_node + i]), start.outer_radius + 1e-12);
      most_z = std::max(most_z, start.positions[patch.first_node + i].z);
    }
  }
  EXPECT_NEAR(smallest, start.inner_radius, 1e-12);
  EXPECT_NEAR(largest, start.outer_radius, 1e-12);
  // Band, gap and disk hang one behind the other, nearly at full length.
  const double skirt_z = start.positions[mesh.rigging.skirt_nodes[0]].z;
  EXPECT_NEAR(most_z - skirt_z, 0.3 + 0.07 + 0.455, 0.01);
  EXPECT_NEAR(skirt_z - start.positions[mesh.rigging.confluence].z,
              std::sqrt(1.5 * 1.5 - smallest * smallest), 1e-9);
}

TEST(Fold, TheFoldedCanopyHasTheSymmetryOfItsFolds) {
  const CanopyMesh mesh = stratos_mesh();
  const FoldedStart start = fold(mesh, {0.1, 18, 0});
  EXPECT_LT(departure_from_symmetry(mesh, start.positions, 18), 1e-14);
}

TEST(Fold, SlackLinesAreLongerThanTheirWayByTheGivenLengthAndKeepTheirOwn) {
  const CanopyMesh mesh = stratos_mesh();
  const double slack = 0.08;
  const FoldedStart start = fold(mesh, {0.1, 18, slack});
  EXPECT_LT(start_strain(mesh, start.positions).largest, 1e-9);
  for (const LineRun& line : mesh.rigging.lines) {
    double length = 0;
    for (int i = 0; i < line.free_springs; ++i) {
      const Spring& spring = mesh.springs[line.springs[i]];
      const double now = norm(start.positions[spring.b] - start.positions[spring.a]);
      EXPECT_NEAR(now, spring.rest_length, 1e-12);
      length += now;
    }
    const Spring& last = mesh.springs[line.springs[line.free_springs - 1]];
    EXPECT_NEAR(length - norm(start.positions[last.b] - start.positions[mesh.rigging.confluence]), slack,
                1e-9);
  }
}

TEST(Fold, LinesThatEndOnInnerAndOuterFoldsAreSlackWhereTheirWayIsShorter) {
  const CanopyMesh mesh = build_mesh(disk_gap_band(25600, 6, 36), printed_materials());
  const FoldedStart start = fold(mesh, {0.12, 18, 0});  // every second line on an outer fold
  EXPECT_LT(start_strain(mesh, start.positions).largest, 1e-9);
}

TEST(Fold, AnImpossibleRadiusOrNumberOfFoldsIsRefusedWithPossibleOnes) {
  const CanopyMesh mesh = stratos_mesh();
  const auto message = [&](const Folding& folding) -> std::string {
    try {
      fold(mesh, folding);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({0.1, 7, 0}).find("possible: 3, 6, 9, 18"), std::string::npos) << message({0.1, 7, 0});
  EXPECT_NE(message({0.02, 18, 0}).find("more folds"), std::string::npos);
  EXPECT_NE(message({0.6, 18, 0}).find("more folds"), std::string::npos);
  EXPECT_NE(message({0.1, 18, 1.45}).find("slack of the lines"), std::string::npos);
}

}  // namespace
}  // namespace ripstop
