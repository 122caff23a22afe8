#include "ripstop/parachute/disk_gap_band.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "../printed_materials.h"
#include "cloth.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/core/error.h"
#include "ripstop/mesh/each_spring.h"
#include "ripstop/parachute/build.h"
#include "ripstop/parachute/disk_gap_band.h"
#include "ripstop/parachute/own_mesh.h"

namespace ripstop {
namespace {

using std::numbers::pi;

Design stratos(int nodes = 25600) {
  return printed_stratos(nodes);
}

Design walrus(int nodes = 50300) {
  Design design = stratos(nodes);
  design.canopy = DiskGapBand{1.3, 0.17, 0.085, 0.4};
  design.lines.length_m = 2.0;
  return design;
}

TEST(DiskGapBand, TheClothIsThePatternsWithinATenthOfAPercent) {
  for (const Design& design : {stratos(3000), stratos(), walrus()}) {
    const CanopyMesh mesh = build_mesh(design, printed_materials());
    EXPECT_NEAR(cloth_area(mesh) / computed_area(design), 1, 1e-3);
    EXPECT_NEAR(cloth_nodes(mesh) / double(design.mesh.cloth_nodes), 1, 0.05);
  }
  // Disk minus vent plus band: 1.7215 m2 and 2.938 m2 [NFM] section 2.
  EXPECT_NEAR(cloth_area(build_mesh(stratos(), printed_materials())), 1.7215, 0.0005);
  EXPECT_NEAR(cloth_area(build_mesh(walrus(), printed_materials())), 2.938, 0.001);
}

TEST(DiskGapBand, TheMassIsThatOfClothTapeAndLines) {
  const Design design = stratos();
  const PartMaterials m = printed_materials();
  const CanopyMesh mesh = build_mesh(design, m);
  const double hems = pi * (1.0 + 1.0 + 1.0 + 0.09);  // skirt, upper band edge, disk edge, vent
  const double seams = 6 * (0.3 + 0.455);
  const double lines = 18 * (1.5 + 0.3 + 0.07 + 0.455);
  const double expected = computed_area(design) * m.canopy.areal_density_kg_m2 +
                          (hems + seams) * m.tape->linear_density_kg_m + lines * m.line.linear_density_kg_m;
  EXPECT_NEAR(std::accumulate(mesh.mass.begin(), mesh.mass.end(), 0.0) / expected, 1, 1e-4);
  // The taut line reaches from the skirt to the confluence.
  EXPECT_NEAR(norm(mesh.start[mesh.rigging.confluence] - mesh.start[mesh.rigging.skirt_nodes[0]]), 1.5,
              1e-12);
}

TEST(DiskGapBand, TheStartShapeHasNoStress) {
  const CanopyMesh mesh = build_mesh(stratos(6000), printed_materials());
  each_spring(mesh, [&](const SpringView& s) {
    if (s.patch < 0 || s.direction == bend_row) return;
    EXPECT_NEAR(norm(mesh.start[s.b] - mesh.start[s.a]) / s.rest_length, 1, 1e-12)
        << mesh.patches[s.patch].name << " " << s.direction;
  });
  for (const Tie& tie : mesh.ties) {
    Vec3 place{};
    double weights = 0;
    for (const Tie::Master& master : tie.masters)
      place += master.weight * mesh.start[master.node], weights += master.weight;
    ASSERT_NEAR(weights, 1, 1e-14);
    ASSERT_LT(norm(place - mesh.start[tie.node]), 1e-14);
  }
}

TEST(DiskGapBand, TheQuadsFaceFromTheInsideToTheOutside) {
  const CanopyMesh mesh = build_mesh(stratos(3000), printed_materials());
  for (const Cell& cell : cells_of(mesh)) {
    if (cell.corner[0] < 0) continue;
    const Vec3 a = mesh.start[cell.corner[0]];
    const Vec3 area =
        area_vector(a, mesh.start[cell.corner[1]], mesh.start[cell.corner[2]], mesh.start[cell.corner[3]]);
    if (a.z < 0.3 - 1e-9) {
      EXPECT_GT(dot(area, {a.x, a.y, 0}), 0);  // band: away from the axis
    } else {
      EXPECT_GT(area.z, 0);  // disk: downstream
    }
  }
}

TEST(DiskGapBand, TheSpringsStayNearTheMeanSpacingAlsoRoundTheVent) {
  for (const Design& design : {stratos(), walrus()}) {
    const CanopyMesh mesh = build_mesh(design, printed_materials());
    const double mean = std::sqrt(computed_area(design) / design.mesh.cloth_nodes);
    for (const Patch& patch : mesh.patches) {
      for (const Direction d : {along_row, along_column}) {
        for (std::size_t i = 0; i < patch.width[d].size(); ++i) {
          if (patch.width[d][i] <= 0) continue;
          EXPECT_GT(patch.rest_length[d][i], 0.6 * mean);
          EXPECT_LT(patch.rest_length[d][i], 1.6 * mean);
        }
      }
    }
  }
}

TEST(DiskGapBand, TheStepIsAtLeastFourMicrosecondsOnStratosAndWalrus) {
  for (const Design& design : {stratos(), walrus()}) {
    const ClothPtr cloth = make_cloth(build_mesh(design, printed_materials()));
    const StabilityLimit bound = stability_limit(*cloth, start_state(*cloth));
    EXPECT_GE(bound.stable_step, 4e-6) << bound.part << " node " << bound.node;
  }
}

// A rotation by one gore maps nodes, masses and springs onto nodes, masses and springs.
TEST(DiskGapBand, TheMeshHasTheSymmetryOfItsGores) {
  const CanopyMesh mesh = build_mesh(stratos(3000), printed_materials());
  const auto key = [](Vec3 p) {
    return std::array<long, 3>{std::lround(p.x * 1e7), std::lround(p.y * 1e7), std::lround(p.z * 1e7)};
  };
  std::map<std::array<long, 3>, double> mass_at;  // nodes may share a place where rings meet
  for (int i = 0; i < mesh.node_count(); ++i) mass_at[key(mesh.start[i])] += mesh.mass[i];
  const double c = std::cos(2 * pi / 6), s = std::sin(2 * pi / 6);
  for (const auto& [place, mass] : mass_at) {
    const Vec3 p = 1e-7 * Vec3{double(place[0]), double(place[1]), double(place[2])};
    double found = -1;
    const auto turned = key({c * p.x - s * p.y, s * p.x + c * p.y, p.z});
    for (long dx : {-1, 0, 1}) {
      for (long dy : {-1, 0, 1}) {
        const auto near = mass_at.find({turned[0] + dx, turned[1] + dy, turned[2]});
        if (near != mass_at.end()) found = near->second;
      }
    }
    ASSERT_NEAR(found / mass, 1, 1e-9) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(DiskGapBand, EveryLineRunsFromTheConfluenceOverTheBandAndTheGapToTheVent) {
  const CanopyMesh mesh = build_mesh(stratos(), printed_materials());
  ASSERT_EQ(mesh.rigging.lines.size(), 18u);
  for (const LineRun& line : mesh.rigging.lines) {
    double length = 0;
    int node = mesh.rigging.confluence;
    for (std::size_t i = 0; i < line.springs.size(); ++i) {
      const Spring& spring = mesh.springs[line.springs[i]];
      EXPECT_EQ(spring.a, node);
      node = spring.b;
      length += spring.rest_length;
      if (static_cast<int>(i) + 1 == line.free_springs) {
        EXPECT_NEAR(length, 1.5, 1e-9);
      }
    }
    EXPECT_NEAR(length, 1.5 + 0.3 + 0.07 + 0.455, 1e-9);
    EXPECT_NEAR(std::hypot(mesh.start[node].x, mesh.start[node].y), 0.045, 1e-9);
  }
  EXPECT_EQ(mesh.fixed, std::vector<int>{mesh.rigging.confluence});
}

TEST(DiskGapBand, ARiserSupportsTheConfluence) {
  Design design = stratos(3000);
  design.riser.length_m = 0.4;
  const CanopyMesh mesh = build_mesh(design, printed_materials());
  ASSERT_EQ(mesh.fixed.size(), 1u);
  EXPECT_NEAR(norm(mesh.start[mesh.fixed[0]] - mesh.start[mesh.rigging.confluence]), 0.4, 1e-12);
  double length = 0;
  for (const int spring : mesh.rigging.riser_springs) length += mesh.springs[spring].rest_length;
  EXPECT_NEAR(length, 0.4, 1e-12);
}

TEST(DiskGapBand, TooFewNodesForTheSeamsAreRefusedWithTheReason) {
  Design design = stratos(500);
  design.gores = 7;
  design.lines.count = 19;
  try {
    build_mesh(design, printed_materials());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("number of cloth nodes = 500"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("multiples of 133"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ripstop
