#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"

namespace ripstop {
namespace {

// On these cells the wake of this canopy ends in a limit cycle, with OpenFOAM as with this engine.
FlowProblem restless_wake() {
  FlowProblem problem;
  problem.grid = {{-1, -1, 0}, {2, 2, 4}, 25, 25, 38};
  problem.air.velocity = {0, 0, 30};
  problem.bodies.push_back(
      porous_body({cut_cells(problem.grid, rigid_disk_gap_band({0, 0, 2})), 65.98, 37.45}));
  return problem;
}

CartesianSettings one_thread() {
  CartesianSettings settings;
  settings.threads = 1;
  return settings;
}

TEST(FlowAverage, MeanAndDeviationAreThoseOfTheDragsThatWereReported) {
  FlowProblem problem = restless_wake();
  problem.stopping.max_iterations = 60;
  problem.stopping.average_over = 25;
  std::vector<double> drag;
  const FlowField field = solve(*make_cartesian(one_thread()), problem, [&](const FlowProgress& progress) {
    drag.push_back(progress.drag);
    return true;
  });
  ASSERT_FALSE(field.converged);
  ASSERT_EQ(field.average.iterations, 25);
  drag.erase(drag.begin(), drag.end() - 25);
  double mean = 0, squares = 0;
  for (double d : drag) mean += d / 25;
  for (double d : drag) squares += (d - mean) * (d - mean);
  EXPECT_NEAR(field.porous_force.z, mean, 1e-10 * mean);
  EXPECT_NEAR(field.average.drag_deviation, std::sqrt(squares / 24), 1e-9 * mean);
  EXPECT_GT(field.average.drag_deviation, 0);
}

TEST(FlowAverage, TheMeanOfALimitCycleIsRepeatableAndConservesMomentum) {
  FlowProblem problem = restless_wake();
  const auto engine = make_cartesian(one_thread());
  problem.stopping.max_iterations = 700;
  problem.stopping.average_over = 300;
  const auto flow = engine->start(problem);
  const FlowField first = solve_to_rest(*flow, problem.stopping);
  problem.stopping.max_iterations = 300;
  const FlowField second = solve_to_rest(*flow, problem.stopping);  // continues from the last iteration
  ASSERT_FALSE(first.converged);
  ASSERT_FALSE(second.converged);
  EXPECT_LT(std::abs(second.porous_force.z - first.porous_force.z), first.average.drag_deviation);
  EXPECT_NEAR(first.momentum_deficit.z / first.porous_force.z, 1, 0.005);
  EXPECT_NEAR(second.momentum_deficit.z / second.porous_force.z, 1, 0.005);
}

TEST(FlowAverage, ARunThatSettlesIsNotAveragedAndKeepsItsBits) {
  FlowProblem problem = restless_wake();
  problem.grid.nx = problem.grid.ny = 16, problem.grid.nz = 24;
  problem.bodies = {porous_body({cut_cells(problem.grid, rigid_disk_gap_band({0, 0, 2})), 65.98, 37.45})};
  problem.air.velocity = {0, 0, 10};
  const FlowField plain = solve(*make_cartesian(one_thread()), problem);
  problem.stopping.average_over = problem.stopping.max_iterations;
  const FlowField field = solve(*make_cartesian(one_thread()), problem);
  ASSERT_TRUE(field.converged);
  EXPECT_EQ(field.average.iterations, 0);
  EXPECT_EQ(field.porous_force, plain.porous_force);
  ASSERT_EQ(field.pressure.size(), plain.pressure.size());
  EXPECT_EQ(std::memcmp(field.pressure.data(), plain.pressure.data(), plain.pressure.size() * sizeof(double)),
            0);
}

TEST(FlowAverage, LoadsOnASheetStillAddUpToItsForce) {
  FlowProblem problem = restless_wake();
  problem.bodies.clear();
  problem.bodies = {sheet_body(disk(0.6, {0, 0, 1.5}), {100, 40})};
  problem.outlet = Outlet::still_air;
  problem.stopping.max_iterations = 30;
  problem.stopping.average_over = 20;
  const FlowField field = solve(*make_cartesian(one_thread()), problem);
  ASSERT_EQ(field.average.iterations, 20);
  Vec3 sum;
  for (const SheetLoad& load : field.sheet_loads) sum += load.force;
  EXPECT_GT(field.average.drag_deviation, 0);
  EXPECT_NEAR(sum.z, field.porous_force.z, 1e-9 * field.porous_force.z);
}

TEST(FlowAverage, AWindowLongerThanTheRunIsRefused) {
  FlowProblem problem = restless_wake();
  problem.stopping.max_iterations = 10;
  for (const int window : {-1, 11}) {
    problem.stopping.average_over = window;
    EXPECT_THROW(solve(*make_cartesian(one_thread()), problem), Error);
  }
}

}  // namespace
}  // namespace ripstop
