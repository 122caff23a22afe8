// The folded start of every family keeps its cloth as cut.
#include "ripstop/fsi/folded_start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "../printed_materials.h"
#include "../turned_symmetry.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/core/error.h"
#include "ripstop/parachute/annular.h"
#include "ripstop/parachute/build.h"
#include "ripstop/parachute/conical.h"
#include "ripstop/parachute/cross.h"
#include "ripstop/parachute/extended_skirt.h"
#include "ripstop/parachute/flat_circular.h"
#include "ripstop/parachute/polygon.h"
#include "ripstop/parachute/profile.h"
#include "ripstop/parachute/ringsail.h"
#include "ripstop/parachute/ringslot.h"
#include "ripstop/parachute/spherical.h"

namespace ripstop {
namespace {

Design design_of(const Canopy& canopy, int gores, int lines) {
  Design design;
  design.canopy = canopy;
  design.gores = gores;
  design.lines.count = lines;
  design.lines.length_m = 1.2;
  design.mesh.cloth_nodes = 2500;
  design.mesh.sewn_straight = false;
  design.mesh.folds = lines;
  return design;
}

struct Family {
  const char* name;
  Design design;
  double radius;
};

std::vector<Family> families() {
  Spherical hemisphere, quarter;
  hemisphere.half_angle_deg = 90;
  quarter.half_angle_deg = 60;
  for (Spherical* canopy : {&hemisphere, &quarter})
    canopy->nominal_diameter_m = 1, canopy->vent_diameter_m = 0.1;
  FlatCircular flat;
  flat.nominal_diameter_m = 1, flat.vent_diameter_m = 0.1;
  Conical cone;
  cone.nominal_diameter_m = 1, cone.vent_diameter_m = 0.1, cone.cone_angle_deg = 30;
  ExtendedSkirt skirt;
  skirt.disk_diameter_m = 0.86, skirt.vent_diameter_m = 0.1, skirt.skirt_height_m = 0.086;
  Ringslot slots;
  slots.nominal_diameter_m = 1, slots.vent_diameter_m = 0.1, slots.rings = 6, slots.slot_height_m = 0.013;
  Ringsail sails;
  sails.nominal_diameter_m = 1, sails.vent_diameter_m = 0.06, sails.sails = 9;
  Annular ring;
  ring.outer_diameter_m = 1, ring.vent_diameter_m = 0.3;
  Polygon hexagon;
  hexagon.across_flats_m = 1, hexagon.vent_diameter_m = 0.1;
  ProfileCanopy ellipse;  // axes 1 : 0.7, with a vent of a tenth of its diameter
  ellipse.pieces.resize(1);
  for (int i = 0; i <= 30; ++i) {
    const double angle = i / 30.0 * std::acos(0.1);
    ellipse.pieces[0].radius_m.push_back(0.5 * std::cos(angle));
    ellipse.pieces[0].height_m.push_back(0.35 * std::sin(angle));
  }
  Cross cross;
  cross.arm_length_m = 1.2, cross.arm_width_m = 0.4;
  return {{"flat circular", design_of(flat, 12, 12), 0.12},
          {"conical", design_of(cone, 12, 12), 0.12},
          {"hemispherical", design_of(hemisphere, 12, 12), 0.12},
          {"quarter-spherical", design_of(quarter, 12, 12), 0.12},
          {"extended skirt", design_of(skirt, 12, 12), 0.12},
          {"ringslot", design_of(slots, 12, 12), 0.12},
          {"ringsail", design_of(sails, 8, 8), 0.1},
          {"cross", design_of(cross, 4, 16), 0.15},
          {"elliptical", design_of(ellipse, 10, 10), 0.12},
          {"annular", design_of(ring, 12, 12), 0.12},
          {"hexagon", design_of(hexagon, 6, 6), 0.2}};
}

class EveryFamily : public testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(All, EveryFamily, testing::ValuesIn(families()), [](const auto& family) {
  std::string name = family.param.name;
  std::erase_if(name, [](char c) { return c == ' ' || c == '-'; });
  return name;
});

TEST_P(EveryFamily, FoldsToTheGivenRadiusWithoutStrain) {
  ThreadTeam team(1);
  const Family& family = GetParam();
  const CanopyMesh mesh = build_mesh(family.design, printed_materials());
  const int symmetry = std::gcd(family.design.gores, family.design.lines.count);
  const FoldedStart start = folded_start(mesh, {family.radius, 0, 0}, symmetry, team);
  const StartStrain strain = start_strain(with_creases(mesh, start), start.positions);
  EXPECT_LT(strain.largest, 1e-3) << strain.part;
  EXPECT_EQ(pierced_share(mesh, start.positions), 0);
  EXPECT_NEAR(0.5 * (start.inner_radius + start.outer_radius) / family.radius, 1, 0.02);
  EXPECT_GT(start.outer_radius, start.inner_radius);
  // The vent lies downstream of the skirt, whose first fold is where it was.
  const Patch &skirt = mesh.patches.front(), &last = mesh.patches.back();
  const Vec3 fold = start.positions[skirt.node(0, 0)], was = mesh.start[skirt.node(0, 0)];
  EXPECT_GT(fold.x * was.x + fold.y * was.y, 0);
  const double vent_z = start.positions[last.node(last.rows - 1, 0)].z;
  EXPECT_GT(vent_z, fold.z);
}

// Of examples/wake. Cloth that resists compression pierces itself on its way from the zigzag, in 0.3 % of the edges;
// cloth that wrinkles from the beginning does not.
TEST(FoldedStart, OfManyFoldsIsComputedAgainWhereEdgesPierceCloth) {
  ThreadTeam team(1);
  FlatCircular flat;
  flat.nominal_diameter_m = 0.6, flat.vent_diameter_m = 0.06;
  Design design = design_of(flat, 8, 8);
  design.lines.length_m = 0.7;
  design.mesh.cloth_nodes = 3000;
  design.mesh.folds = 40;
  const CanopyMesh mesh = build_mesh(design, printed_materials());
  const FoldedStart start = folded_start(mesh, {0.024, 40, 0}, 8, team);
  EXPECT_LT(start_strain(with_creases(mesh, start), start.positions).largest, 1e-3);
  EXPECT_EQ(pierced_share(mesh, start.positions), 0);
  EXPECT_NEAR(0.5 * (start.inner_radius + start.outer_radius) / 0.024, 1, 0.02);
}

// Along a diagonal of its cells a fold crosses their other diagonals and no spring else.
TEST(FoldedStart, OfACrossOnlySpringsThatAFoldShortensAreLeftOut) {
  ThreadTeam team(1);
  const Family cross = families()[7];
  const CanopyMesh mesh = build_mesh(cross.design, printed_materials());
  const FoldedStart start = folded_start(mesh, {cross.radius, 0, 0}, 4, team);
  const CanopyMesh creased = with_creases(mesh, start);
  int kept = 0, left_out = 0;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    for (const Direction d : {shear_up, shear_down, bend_row, bend_column}) {
      const Patch& patch = mesh.patches[p];
      for (int i = 0; i < patch.rows * patch.columns; ++i) {
        if (patch.width[d][i] <= 0) continue;
        const int row = i / patch.columns + direction_offset[d].row;
        const int column = i % patch.columns + direction_offset[d].column;
        const double length =
            norm(start.positions[patch.node(row, column)] - start.positions[patch.first_node + i]);
        const bool shortened = length < 0.99 * patch.rest_length[d][i];
        EXPECT_EQ(creased.patches[p].width[d][i], shortened ? 0 : patch.width[d][i]) << i;
        ++(shortened ? left_out : kept);
      }
    }
  EXPECT_GT(left_out, 0);
  EXPECT_GT(kept, 10 * left_out);
}

TEST(FoldedStart, ARingsailKeepsItsSymmetryAndItsSlotsAreNoWiderThanTheirLines) {
  ThreadTeam team(1);
  const Family sails = families()[6];
  const CanopyMesh mesh = build_mesh(sails.design, printed_materials());
  const FoldedStart start = folded_start(mesh, {sails.radius, 0, 0.05}, 8, team);
  EXPECT_LT(departure_from_symmetry(mesh, start.positions, 8), 1e-12);
  for (const LineRun& line : mesh.rigging.lines) {
    for (const int i : line.springs) {
      const Spring& spring = mesh.springs[i];
      EXPECT_LT(norm(start.positions[spring.b] - start.positions[spring.a]), 1.001 * spring.rest_length);
    }
  }
}

TEST(FoldedStart, MoreFoldsAllowASmallerRadiusAndImpossibleOnesAreRefused) {
  ThreadTeam team(1);
  Family flat = families()[0];
  const CanopyMesh few = build_mesh(flat.design, printed_materials());
  EXPECT_THROW(folded_start(few, {0.03, 12, 0}, 12, team), Error);
  EXPECT_THROW(folded_start(few, {0.6, 12, 0}, 12, team), Error);
  EXPECT_THROW(folded_start(few, {0.12, 7, 0}, 12, team), Error);
  flat.design.mesh.folds = 24;
  const CanopyMesh many = build_mesh(flat.design, printed_materials());
  const FoldedStart start = folded_start(many, {0.06, 24, 0}, 12, team);
  EXPECT_LT(start_strain(with_creases(many, start), start.positions).largest, 1e-4);  // target
  const Family cross = families()[7];
  const CanopyMesh sheet = build_mesh(cross.design, printed_materials());
  EXPECT_THROW(folded_start(sheet, {0.15, 6, 0}, 4, team), Error);
  EXPECT_THROW(folded_start(sheet, {0.02, 4, 0}, 4, team), Error);
}

}  // namespace
}  // namespace ripstop
