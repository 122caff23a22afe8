// Sides at which the air of the stream comes in with its total pressure.
#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"

namespace ripstop {
namespace {

// A porous disk of 1 m (loss coefficient 2) in a box of `width` x `width` x 1.5 `width`,
// cells of 1/8 m about it.
FlowField porous_disk(double width, Sides sides, int threads = 1) {
  FlowProblem problem;
  const int n = width > 4 ? 44 : 32;
  problem.grid = {{-width / 2, -width / 2, 0}, {width, width, 1.5 * width}, n, n, n + n / 2};
  if (width > 4)
    problem.grid =
        graded(problem.grid, {-1, -1, 0.45 * 1.5 * width - 1}, {1, 1, 0.45 * 1.5 * width + 2}, 1.2);
  problem.air.velocity = {0, 0, 30};
  problem.sides = sides;
  problem.bodies = {sheet_body(disk(1, {0, 0, 0.45 * 1.5 * width}), {0, problem.air.density})};
  problem.outlet = Outlet::still_air;
  CartesianSettings settings;
  settings.second_order = true;
  settings.threads = threads;
  FlowField field = solve(*make_cartesian(settings), problem);
  EXPECT_TRUE(field.converged);
  return field;
}

TEST(Entraining, TheStreamAlonePassesUnchanged) {
  FlowProblem problem;
  problem.grid = {{-1, -1, 0}, {2, 2, 3}, 12, 13, 18};
  problem.air.velocity = {0, 0, 30};
  problem.sides = Sides::entraining;
  const FlowField field = solve(*make_cartesian(), problem);
  for (const Vec3& u : field.velocity) EXPECT_LT(norm(u - Vec3{0, 0, 30}), 1e-9);
}

TEST(Entraining, ANearSideChangesADiskLessThanAWallDoes) {
  const double far = porous_disk(16, Sides::slip).porous_force.z;
  const double wall = porous_disk(4, Sides::slip).porous_force.z / far - 1;
  const FlowField open = porous_disk(4, Sides::entraining);
  const double entraining = open.porous_force.z / far - 1;
  EXPECT_GT(wall, 0.03);
  EXPECT_LT(std::abs(entraining), 0.4 * wall);
  EXPECT_NEAR(open.momentum_deficit.z, open.porous_force.z, 5e-4 * open.porous_force.z);
}

// A fan that draws air in through the sides: Rankine's actuator disk, its slipstream at U sqrt(1 + C_T).
TEST(Entraining, AFanDrawsInAirWithTheStreamsTotalPressure) {
  FlowProblem problem;
  problem.grid = {{-1.5, -1.5, 0}, {3, 3, 4.5}, 36, 36, 54};
  problem.air.velocity = {0, 0, 30};
  problem.sides = Sides::entraining;
  const FlowGrid& grid = problem.grid;
  const double q = 0.5 * problem.air.density * 30 * 30, thrust = 1.25;
  const int plane = 18;
  problem.body_force.assign(grid.cells(), Vec3{});
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      if (std::hypot(grid.centre(0, i), grid.centre(1, j)) < 0.5)
        problem.body_force[grid.index(i, j, plane)] = {0, 0, thrust * q / grid.width(2, plane)};
  CartesianSettings settings;
  settings.threads = 1;
  settings.second_order = true;
  const FlowField field = solve(*make_cartesian(settings), problem);
  EXPECT_TRUE(field.converged);
  const Vec3 inside{0.04, 0.04, 3.5};
  EXPECT_NEAR(sample(grid, field.velocity, inside).z / 30, std::sqrt(1 + thrust), 0.03);
  int inward = 0;
  for (int k = 0; k < grid.nz; ++k) {
    const int cell = grid.index(0, grid.ny / 2, k);
    const Vec3 u = field.velocity[cell];
    if (u.x > 0.1) ++inward;
    EXPECT_NEAR(field.pressure[cell] + 0.5 * problem.air.density * dot(u, u), q, 0.01 * q) << k;
  }
  EXPECT_GT(inward, grid.nz / 3);
}

TEST(Entraining, TheAnswerDoesNotDependOnTheNumberOfThreads) {
  const FlowField one = porous_disk(4, Sides::entraining, 1), two = porous_disk(4, Sides::entraining, 2);
  EXPECT_EQ(one.pressure, two.pressure);
  EXPECT_EQ(one.porous_force.z, two.porous_force.z);
}

}  // namespace
}  // namespace ripstop
