// A flow about a symmetric body is the same in a quarter of the box as in all of it.
#include "ripstop/flow/cartesian/quarter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "even_axis.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"
#include "ripstop/flow/symmetry.h"

namespace ripstop::quarters {
namespace {

CartesianSettings one_thread(bool second_order) {
  CartesianSettings settings;
  settings.threads = 1, settings.second_order = second_order;
  return settings;
}

FlowProblem box(Sides sides) {
  FlowProblem problem;
  problem.grid = graded({{-2, -2, 0}, {4, 4, 6}, 20, 20, 24}, {-0.7, -0.7, 1.3}, {0.7, 0.7, 3}, 1.3);
  problem.air.velocity = {0, 0, 10};
  problem.sides = sides;
  problem.outlet = Outlet::still_air;
  problem.stopping.residual = 1e-7;
  problem.stopping.max_iterations = 800;
  return problem;
}

/// Half a sphere that crosses both planes. No edge of its 52 gores lies on the diagonals of the grid, where rounding
/// would decide which of two triangles a line meets.
std::vector<Triangle> cup() {
  std::vector<OutlinePoint> outline;
  for (int n = 0; n <= 15; ++n)
    outline.push_back({0.5 * std::cos(n * std::numbers::pi / 30), 0.5 * std::sin(n * std::numbers::pi / 30)});
  outline.back().radius = 0;
  return revolve(outline, {0, 0, 1.73}, 52);
}

FlowProblem with_cup(Sides sides) {
  FlowProblem problem = box(sides);
  problem.bodies = {sheet_body(cup(), {200, 0})};
  problem.bodies[0].moment_about = {0.1, 0, 0};
  return problem;
}

FlowProblem with_porous_cells(Sides sides) {
  FlowProblem problem = box(sides);
  problem.bodies = {porous_body({cut_cells(problem.grid, cup()), 0, 60}, "cells")};
  problem.bodies[0].moment_about = {0, 0.1, 0};
  return problem;
}

FlowField solved(FlowProblem problem, bool quarter, bool second_order) {
  problem.quarter = quarter;
  return solve(*make_cartesian(one_thread(second_order)), problem);
}

void expect_alike(const FlowField& quarter, const FlowField& full, double speed) {
  EXPECT_EQ(quarter.grid, full.grid);
  EXPECT_NEAR(quarter.porous_force.z / full.porous_force.z, 1, 1e-4);
  EXPECT_NEAR(quarter.momentum_deficit.z / full.momentum_deficit.z, 1, 1e-4);
  ASSERT_EQ(quarter.bodies.size(), 1u);
  EXPECT_NEAR(quarter.bodies[0].force.z / full.bodies[0].force.z, 1, 1e-4);
  const double moment = norm(full.bodies[0].moment);
  EXPECT_LT(norm(quarter.bodies[0].moment - full.bodies[0].moment), 1e-3 * moment);
  double pressure = 0, velocity = 0;
  for (std::size_t c = 0; c < full.velocity.size(); ++c) {
    pressure = std::max(pressure, std::abs(quarter.pressure[c] - full.pressure[c]));
    velocity = std::max(velocity, norm(quarter.velocity[c] - full.velocity[c]));
  }
  EXPECT_LT(pressure, 1e-4 * speed * speed);
  EXPECT_LT(velocity, 1e-3 * speed);
}

// The iterations about a sheet keep a small cycle, in velocities of 4e-4 of the stream: both flows are part of it.
TEST(Quarter, HasTheFlowOfTheWholeBoxAboutASheet) {
  for (const Sides sides : {Sides::entraining, Sides::slip}) {
    const FlowProblem problem = with_cup(sides);
    const FlowField quarter = solved(problem, true, false), full = solved(problem, false, false);
    expect_alike(quarter, full, 10);
    ASSERT_EQ(quarter.sheet_loads.size(), full.sheet_loads.size()) << sides.word;
    // Face by face, in any order.
    for (const SheetLoad& load : full.sheet_loads) {
      const auto same =
          std::find_if(quarter.sheet_loads.begin(), quarter.sheet_loads.end(), [&](const auto& other) {
            return norm(other.point - load.point) < 1e-9 &&
                   (norm(load.force) == 0) == (norm(other.force) == 0);
          });
      ASSERT_NE(same, quarter.sheet_loads.end());
      EXPECT_NEAR(same->drop, load.drop, 1e-2);  // of 100 Pa
      EXPECT_NEAR(same->area, load.area, 1e-9);
      EXPECT_NEAR(same->cover, load.cover, 1e-9);
      EXPECT_LT(norm(same->outward - load.outward), 1e-6);
    }
  }
}

TEST(Quarter, HasTheFlowOfTheWholeBoxThroughPorousCells) {
  for (const Sides sides : {Sides::zero_gradient, Sides::entraining}) {
    const FlowProblem problem = with_porous_cells(sides);
    expect_alike(solved(problem, true, true), solved(problem, false, true), 10);
  }
}

TEST(Quarter, TheMirroredAxisIsThatOfTheWholeBox) {
  const cartesian::Axis half = testing::even_axis(0, 1, 5), whole = cartesian::whole_of(half);
  EXPECT_EQ(whole.n, 10);
  EXPECT_EQ(whole.edge.front(), -1);
  EXPECT_EQ(whole.edge[5], 0);
  EXPECT_EQ(whole.edge.back(), 1);
  const FlowGrid grid = box(Sides::slip).grid, quarter = cartesian::quarter_of(grid);
  for (const int axis : {0, 1})
    for (int c = 0; c <= quarter.count(axis); ++c)
      EXPECT_NEAR(quarter.edge(axis, c), grid.edge(axis, c + grid.count(axis) / 2), 1e-12);
}

TEST(Quarter, ContinuesFromItsFilesToTheLastBit) {
  FlowProblem problem = with_cup(Sides::entraining);
  problem.quarter = true;
  const auto engine = make_cartesian(one_thread(true));
  const auto flow = engine->start(problem), copy = engine->start(problem);
  flow->advance(5, 1e-9);
  const TemporaryFolder folder("quarter");
  flow->save(folder.path), copy->restore(folder.path);
  flow->advance(5, 1e-9), copy->advance(5, 1e-9);
  EXPECT_EQ(flow->field().velocity, copy->field().velocity);
  problem.quarter = false;
  EXPECT_THROW(engine->start(problem)->restore(folder.path), Error);
}

TEST(Quarter, DoesNotDependOnTheNumberOfThreads) {
  FlowProblem problem = with_cup(Sides::entraining);
  problem.quarter = true, problem.stopping.max_iterations = 20;
  CartesianSettings two = one_thread(true);
  two.threads = 2;
  EXPECT_EQ(solve(*make_cartesian(two), problem).velocity,
            solve(*make_cartesian(one_thread(true)), problem).velocity);
}

std::string refusal(const FlowProblem& problem) {
  try {
    make_cartesian(one_thread(false))->start(problem);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return {};
}

TEST(Quarter, IsRefusedWithItsReasonWhereTheFlowIsNotItsOwnMirrorImage) {
  FlowProblem problem = with_cup(Sides::entraining);
  EXPECT_EQ(why_not_mirrored(problem), "");
  problem.quarter = true;
  FlowProblem odd = problem, shifted = problem, oblique = problem, pulled = problem, few = problem,
              far = problem;
  odd.grid.ny = 21;
  shifted.grid.origin.x += 0.01;
  far.sides = oblique.sides = Sides::far_field;
  oblique.air.velocity = {1, 0, 10};
  pulled.body_force.resize(static_cast<std::size_t>(problem.grid.cells()));
  few.grid = {{-2, -2, 0}, {4, 4, 6}, 6, 8, 24};
  EXPECT_NE(refusal(odd).find("the number of cells across the stream is odd (21)"), std::string::npos);
  EXPECT_NE(refusal(shifted).find("not symmetric about the canopy axis"), std::string::npos);
  EXPECT_NE(refusal(oblique).find("the stream is not along the axis"), std::string::npos);
  EXPECT_NE(refusal(pulled).find("forces act on the air"), std::string::npos);
  EXPECT_NE(refusal(far).find("the far field"), std::string::npos);
  EXPECT_NE(refusal(few).find("6 cells"), std::string::npos);
}

TEST(Quarter, HasNoStepsInTime) {
  FlowProblem problem = with_cup(Sides::entraining);
  problem.quarter = true;
  const auto engine = make_cartesian(one_thread(true));
  const auto flow = engine->start(problem);
  EXPECT_THROW(flow->march(1, 0.5), Error);
  EXPECT_THROW(flow->step(1e-3), Error);
  EXPECT_THROW(flow->longest_step(0.5), Error);
  EXPECT_THROW(flow->stream({0, 0, 5}, {}), Error);
}

}  // namespace
}  // namespace ripstop::quarters
