// A nozzle's jet into still air: by itself, and about a porous disk.
#include "ripstop/flow/jet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"

namespace ripstop::jets {
namespace {

constexpr double speed = 20;  // [m/s]

FlowProblem empty_jet() {
  FlowProblem problem;
  problem.grid = {{-2.5, -2.5, 0}, {5, 5, 8}, 30, 30, 32};
  problem.grid = graded(problem.grid, {-0.7, -0.7, 0}, {0.7, 0.7, 0}, 1.15);
  problem.air.velocity = {0, 0, speed};
  problem.sides = Sides::entraining;
  problem.outlet = Outlet::still_air;
  problem.jet = Jet{{NozzleShape::circle, 1, 0}, 0.02, 0.05};
  return problem;
}

FlowField solved(const FlowProblem& problem, int threads = 1) {
  CartesianSettings settings;
  settings.second_order = true;
  settings.threads = threads;
  return solve(*make_cartesian(settings), problem);
}

// Growth by Brown and Roshko, J. Fluid Mech. 64 (1974), for one side at rest: 0.15 to 0.22; a core of 4 to 6.5
// nozzles. Cells are an eighth of the nozzle.
TEST(OpenJet, HasTheCoreAndTheSpreadingOfFreeJetsAndKeepsItsMomentum) {
  FlowProblem problem = empty_jet();
  problem.stopping.residual = 3e-5;
  problem.stopping.max_iterations = 400;
  const FlowField field = solved(problem);
  EXPECT_TRUE(field.converged);
  const auto axial = [&](double r, double z) { return sample(field.grid, field.velocity, {r, 0, z}).z; };
  double core = 0;
  while (core < 8 && axial(0, core) > 0.98 * speed) core += 0.01;
  EXPECT_GT(core, 4);
  EXPECT_LT(core, 6.5);
  const auto thickness = [&](double z) {
    double steepest = 0;
    for (double r = 0; r < 1.5; r += 0.125)
      steepest = std::max(steepest, (axial(r, z) - axial(r + 0.125, z)) / 0.125);
    return 0.98 * speed / steepest;
  };
  const double growth = (thickness(4) - thickness(1.5)) / 2.5;
  EXPECT_GT(growth, 0.13);
  EXPECT_LT(growth, 0.22);
  const double momentum = problem.air.density * speed * speed * nozzle_area(problem.jet->nozzle);
  EXPECT_NEAR(field.momentum_deficit.z / momentum, 0, 2e-3);
}

TEST(OpenJet, TheAnswerDoesNotDependOnTheNumberOfThreads) {
  FlowProblem problem = empty_jet();
  problem.stopping.max_iterations = 20;
  EXPECT_EQ(solved(problem, 1).pressure, solved(problem, 2).pressure);
}

TEST(OpenJet, OfAnotherNozzleIsNotRestored) {
  FlowProblem problem = empty_jet();
  const auto engine = make_cartesian();
  const TemporaryFolder folder("jet");
  engine->start(problem)->save(folder.path);
  engine->start(problem)->restore(folder.path);
  problem.jet->nozzle.width = 0.9;
  EXPECT_THROW(engine->start(problem)->restore(folder.path), Error);
  problem.jet.reset();
  EXPECT_THROW(engine->start(problem)->restore(folder.path), Error);
}

TEST(OpenJet, WiderThanTheInletIsRefused) {
  FlowProblem problem = empty_jet();
  problem.jet->nozzle.width = 6;
  EXPECT_THROW(make_cartesian()->start(problem), Error);
}

// A porous disk of 1 m (K = 2) that fills a fifth of the tunnel.
double drag_of_disk(FlowGrid box, Vec3 core_low, Vec3 core_high, double z, Sides sides,
                    std::optional<Jet> jet) {
  FlowProblem problem;
  problem.grid = graded(box, core_low, core_high, 1.15);
  problem.air.velocity = {0, 0, speed};
  problem.sides = sides;
  problem.outlet = Outlet::still_air;
  problem.jet = jet;
  problem.bodies = {sheet_body(disk(1, {0, 0, z}), {0, problem.air.density})};
  problem.stopping.max_iterations = 400;
  problem.stopping.residual = 3e-5;
  const FlowField field = solved(problem);
  EXPECT_TRUE(field.converged);
  // The inflow is the momentum of the jet, or of the stream, a fifth of it blocked by the disk.
  const double flows_in =
      problem.air.density * speed * speed * nozzle_area({NozzleShape::circle, 1, 0}) / 0.2;
  EXPECT_NEAR(field.momentum_deficit.z, field.porous_force.z, (jet ? 1e-3 : 1e-4) * flows_in);
  return field.porous_force.z;
}

TEST(OpenJet, HasLessDragOfADiskThanAClosedTunnel) {
  const Vec3 low{-0.7, -0.7, 2.6}, high{0.7, 0.7, 4.4};
  const double side = std::sqrt(nozzle_area({NozzleShape::circle, 1, 0}) / 0.2), width = std::sqrt(1 / 0.2);
  const double free =
      drag_of_disk({{-4, -4, 0}, {8, 8, 10}, 36, 36, 42}, low, high, 3, Sides::entraining, {});
  const double walls =
      drag_of_disk({{-side / 2, -side / 2, 0}, {side, side, 10}, 20, 20, 42}, low, high, 3, Sides::slip, {});
  const double jet = drag_of_disk({{-4, -4, 0}, {8, 8, 10}, 36, 36, 42}, low, high, 3, Sides::entraining,
                                  Jet{{NozzleShape::circle, width, 0}, 0.02, 0.08});
  EXPECT_GT(walls / free, 1.15);  // momentum theory: 1.223
  EXPECT_LT(walls / free, 1.25);
  EXPECT_LT(jet / free, 1.0);  // momentum theory: 1
  EXPECT_GT(jet / free, 0.95);
}

}  // namespace
}  // namespace ripstop::jets
