// Cells that grow outward from a fine core.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "openfoam_installed.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"

namespace ripstop {
namespace {

CartesianSettings settings(bool second_order) {
  CartesianSettings s;
  s.threads = 1;
  s.threads = 1;
  s.second_order = second_order;
  return s;
}

// Porous disk of loss coefficient K = 1 in a box of six diameters.
FlowField porous_disk(const FlowGrid& grid) {
  FlowProblem problem;
  problem.grid = grid;
  problem.air.velocity = {0, 0, 10};
  problem.sides = Sides::slip;
  problem.bodies = {sheet_body(disk(1, {0, 0, 3}), {0, 0.5 * problem.air.density})};
  problem.outlet = Outlet::still_air;
  problem.stopping.residual = 1e-4;
  problem.stopping.max_iterations = 250;
  return solve(*make_cartesian(settings(true)), problem);
}

TEST(GradedGrid, GivesTheDragOfUniformCellsThatAreAsFineAllOver) {
  const FlowGrid box{{-3, -3, 0}, {6, 6, 9}, 60, 60, 90};
  FlowGrid few = box;
  few.nx = few.ny = 32, few.nz = 46;
  const FlowGrid fine = graded(few, {-0.7, -0.7, 2.5}, {0.7, 0.7, 4.2}, 1.2);
  EXPECT_NEAR(fine.spacing().x, box.spacing().x, 0.01);
  const FlowField uniform = porous_disk(box), wide = porous_disk(fine);
  EXPECT_NEAR(wide.porous_force.z / uniform.porous_force.z, 1, 0.01);
  EXPECT_NEAR(wide.momentum_deficit.z / wide.porous_force.z, 1, 0.005);
}

TEST(GradedGrid, TheAnswerIsOpenFoamsOnTheSameCells) {
  if (!openfoam_is_installed()) GTEST_SKIP() << "OpenFOAM is not installed";
  FlowProblem problem;
  problem.grid = graded({{-2, -2, 0}, {4, 4, 8}, 22, 22, 34}, {-0.5, -0.5, 1.6}, {0.5, 0.5, 3}, 1.25);
  problem.air.velocity = {0, 0, 10};
  problem.bodies.push_back(
      porous_body({cut_cells(problem.grid, rigid_disk_gap_band({0, 0, 2})), 65.98, 37.45}));
  OpenFoamSettings reference;
  reference.folder = std::filesystem::path(testing::TempDir()) / "parity_graded";
  std::filesystem::remove_all(reference.folder);
  const FlowField theirs = solve(*make_openfoam(reference), problem);
  const FlowField ours = solve(*make_cartesian(settings(false)), problem);
  std::filesystem::remove_all(reference.folder);
  ASSERT_TRUE(theirs.converged);
  ASSERT_TRUE(ours.converged);
  EXPECT_NEAR(ours.porous_force.z / theirs.porous_force.z, 1, 0.005);
  EXPECT_NEAR(theirs.momentum_deficit.z / theirs.porous_force.z, 1, 0.005);
  double velocity = 0, pressure = 0, volume = 0;
  for (int cell = 0; cell < problem.grid.cells(); ++cell) {
    const Vec3 du = ours.velocity[cell] - theirs.velocity[cell];
    const double v = problem.grid.cell_volume(cell);
    velocity += v * dot(du, du);
    pressure += v * std::pow(ours.pressure[cell] - theirs.pressure[cell], 2);
    volume += v;
  }
  EXPECT_LT(std::sqrt(velocity / volume) / 10, 0.01);
  EXPECT_LT(std::sqrt(pressure / volume) / (0.5 * problem.air.density * 100), 0.01);
}

}  // namespace
}  // namespace ripstop
