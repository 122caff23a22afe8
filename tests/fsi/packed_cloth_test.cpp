// Cloth in a bag: it moves with the bag, and leaves it with its momentum.
#include "ripstop/fsi/packed_cloth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../printed_materials.h"
#include "ripstop/fsi/folded_start.h"
#include "ripstop/parachute/build.h"
#include "ripstop/parachute/disk_gap_band.h"

namespace ripstop {
namespace {

struct Packed {
  CanopyMesh mesh;
  FoldedStart folded;
  ClothPtr cloth;
};

Packed packed_canopy(ThreadTeam& team) {
  Design design = printed_stratos(1200);
  design.canopy = DiskGapBand{1.0, 0.2, 0.07, 0.3};
  design.lines.count = 6;
  design.mesh.line_segment_m = 0.15;
  design.mesh.folds = 6;
  const CanopyMesh cut = build_mesh(design, printed_materials());
  Packed p;
  p.folded = folded_start(cut, {0.14, 6, 0}, 6, team);
  p.mesh = with_creases(cut, p.folded);
  for (Patch& patch : p.mesh.patches)
    for (SpringLaw& law : patch.law) law.compression = 0;
  p.cloth = make_cloth(p.mesh);
  return p;
}

TEST(PackedCloth, LiesInATenthOfItsLengthAndKeepsTheSkirtInPlace) {
  ThreadTeam team(1);
  const Packed p = packed_canopy(team);
  const PackedCloth packed({1, 0, 0, 10, 0.1}, p.mesh, p.folded.positions);
  double low = 1e300, high = -1e300, folded_low = 1e300, folded_high = -1e300;
  for (const Patch& patch : p.mesh.patches)
    for (int n = patch.first_node; n < patch.first_node + patch.rows * patch.columns; ++n) {
      low = std::min(low, packed.positions()[n].z), high = std::max(high, packed.positions()[n].z);
      folded_low = std::min(folded_low, p.folded.positions[n].z);
      folded_high = std::max(folded_high, p.folded.positions[n].z);
    }
  EXPECT_DOUBLE_EQ(low, folded_low);
  EXPECT_NEAR(high - low, 0.1 * (folded_high - folded_low), 1e-12);
}

// A heavy bag moves off at 10 m/s from lines that are held: what the riser takes is the momentum of the cloth.
TEST(PackedCloth, StrippedAtConstantSpeedConservesMomentum) {
  ThreadTeam team(1);
  const Packed p = packed_canopy(team);
  const double u = 10;
  const PackedCloth packed({1e6, 0, 0, u, 0.1}, p.mesh, p.folded.positions);
  BagMotion motion = packed.start(u);
  ClothState state = start_state(*p.cloth);
  set_positions(state, *p.cloth, packed.positions());
  packed.carry({u, 1.2, 0}, 0, *p.cloth, state, motion);
  const double brought = momentum(*p.cloth, state).z;
  const Loads none{std::vector<double>(p.mesh.cell_count(), 0.0), {}};
  StepRecord record;
  double impulse = 0;
  constexpr int count = 40;
  for (int n = 0; n < 100000 && !packed.empty(motion); ++n) {
    const double dt = 0.3 * stability_limit(*p.cloth, state).stable_step;
    step(state, *p.cloth, none, dt, count, team, &record);
    for (const Vec3& force : record.fixed_force) impulse += dt * force.z;
    packed.carry({u, 1.2, 0}, count * dt, *p.cloth, state, motion);
  }
  ASSERT_TRUE(packed.empty(motion));
  EXPECT_NEAR(motion.speed, 0, 1e-3);
  const double left = momentum(*p.cloth, state).z;
  EXPECT_NEAR((impulse + left) / brought, 1, 0.01);
  EXPECT_GT(impulse, 0.5 * brought);
}

TEST(PackedCloth, BagIsSlowedByItsDragAndPulledByTheStripForce) {
  ThreadTeam team(1);
  const Packed p = packed_canopy(team);
  double mass = 0.2;
  for (const Patch& patch : p.mesh.patches)
    for (int n = patch.first_node; n < patch.first_node + patch.rows * patch.columns; ++n)
      mass += p.mesh.mass[n];
  const PackedCloth packed({0.2, 0.05, 3, 10, 0.1}, p.mesh, p.folded.positions);
  BagMotion motion = packed.start(20);
  ClothState state = start_state(*p.cloth);
  packed.carry({20, 1.2, 0}, 0, *p.cloth, state, motion);
  const BagMotion before = motion;
  packed.carry({20, 1.2, 9.81}, 1e-4, *p.cloth, state, motion);
  EXPECT_NEAR((motion.speed - before.speed) / 1e-4, 9.81 + (3 - 0.6 * 100 * 0.05) / mass, 0.2);
  EXPECT_NEAR(motion.travel, 1e-4 * 10, 1e-5);
}

TEST(PackedCloth, IsShieldedFromTheAir) {
  ThreadTeam team(1);
  const Packed p = packed_canopy(team);
  const PackedCloth packed({0.2, 0.05, 3, 10, 0.1}, p.mesh, p.folded.positions);
  const std::vector<Cell> cells = cells_of(p.mesh);
  BagMotion motion = packed.start(20);
  motion.travel = 0.2;
  Loads loads{std::vector<double>(cells.size(), 7.0), std::vector<Vec3>(p.mesh.node_count(), Vec3{1, 0, 0})};
  packed.shield(motion, cells, loads);
  int kept = 0, taken = 0;
  double strip = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) loads.cell_pressure[c] == 0 ? ++taken : ++kept;
  for (int n = 0; n < p.mesh.node_count(); ++n) {
    EXPECT_TRUE(!packed.holds(n, motion) || norm(loads.node_force[n]) == 0);
    strip += loads.node_force[n].z;
  }
  EXPECT_GT(kept, 10);
  EXPECT_GT(taken, 10);
  EXPECT_NEAR(strip, 3, 1e-9);
}

}  // namespace
}  // namespace ripstop
