// All six faces open to a stream of any direction.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/boundaries.h"
#include "ripstop/flow/cartesian/boundary.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/projections.h"
#include "ripstop/flow/steady.h"

namespace ripstop::far_fields {
namespace {

CartesianSettings one_thread() {
  CartesianSettings settings;
  settings.threads = 1, settings.second_order = true;
  return settings;
}

FlowProblem empty_box(Vec3 velocity) {
  FlowProblem problem;
  problem.grid =
      graded({{-1, -1.1, -1.2}, {2, 2.2, 2.6}, 14, 13, 16}, {-0.3, -0.3, -0.3}, {0.3, 0.3, 0.4}, 1.2);
  problem.air.velocity = velocity;
  problem.sides = Sides::far_field;
  problem.stopping.max_iterations = 200;
  return problem;
}

void expect_uniform(const FlowField& field, Vec3 velocity) {
  const double speed = norm(velocity);
  for (const Vec3& u : field.velocity) ASSERT_NEAR(norm(u - velocity), 0, 1e-11 * speed);
  for (const double p : field.pressure) ASSERT_NEAR(p, 0, 1e-11 * speed * speed);
}

class AnyDirection : public testing::TestWithParam<Vec3> {};
INSTANTIATE_TEST_SUITE_P(FarField, AnyDirection,
                         testing::Values(Vec3{0, 0, 30}, Vec3{0, 0, -30}, Vec3{30, 0, 0}, Vec3{0, -30, 0},
                                         Vec3{10, 0, 28}, Vec3{-12, 17, 21}, Vec3{-3, 25, -11}));

TEST_P(AnyDirection, AUniformStreamIsASteadySolution) {
  const FlowField field = solve(*make_cartesian(one_thread()), empty_box(GetParam()));
  expect_uniform(field, GetParam());
  EXPECT_NEAR(norm(field.momentum_deficit), 0, 1e-6);
}

TEST_P(AnyDirection, AUniformStreamStaysUniformInTime) {
  for (const SmallEddies eddies : {SmallEddies::wale, SmallEddies::des}) {
    CartesianSettings settings = one_thread();
    settings.small_eddies = eddies;
    const auto engine = make_cartesian(settings);
    const auto flow = engine->start(empty_box(GetParam()));
    flow->march(20, 0.7, [](const FlowStep& step) {
      EXPECT_NEAR(norm(step.momentum_gap), 0, 1e-8);
      EXPECT_LT(step.mass_defect, 1e-12);
      return true;
    });
    expect_uniform(flow->field(), GetParam());
  }
}

// As in a frame that moves with a body in flight: all of the air feels the frame's acceleration.
TEST(FarField, AStreamThatTurnsThroughAWholeCircleStaysUniform) {
  const auto engine = make_cartesian(one_thread());
  const auto flow = engine->start(empty_box({0, 0, 20}));
  const auto velocity_at = [](double angle) -> Vec3 {
    return {20 * std::sin(angle), 8 * std::sin(2 * angle), 20 * std::cos(angle)};
  };
  Vec3 velocity = velocity_at(0);
  for (int n = 1; n <= 60; ++n) {
    const double length = 1e-3 * (1 + n % 2);
    const Vec3 next = velocity_at(n * 2 * 3.14159265358979 / 60);
    flow->stream(next, (next - velocity) / length);
    const FlowStep step = flow->step(length);
    EXPECT_NEAR(norm(step.momentum_gap), 0, 1e-7) << n;
    EXPECT_LT(step.mass_defect, 1e-11) << n;
    velocity = next;
  }
  const FlowField field = flow->field();
  for (const Vec3& u : field.velocity) ASSERT_NEAR(norm(u - velocity), 0, 1e-10);
}

FlowProblem disk_in_the_box(Vec3 velocity) {
  FlowProblem problem = empty_box(velocity);
  problem.grid = graded({{-3, -3, -3}, {6, 6, 6}, 26, 26, 26}, {-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}, 1.2);
  problem.bodies = {sheet_body(disk(1, {0.01, 0.02, 0.03}), {0, 1.2})};
  return problem;
}

// A gust: the far field turns at once, the air in the box follows as it is blown out.
TEST(FarField, WhileAGustTurnsTheWindMassAndMomentumAreBalancedInEveryStep) {
  const auto engine = make_cartesian(one_thread());
  const auto flow = engine->start(disk_in_the_box({0, 0, 10}));
  const double largest = 0.5 * 1.2 * 100;
  flow->march(20, 0.5);
  flow->stream({6, -5, 6}, {});
  for (int n = 0; n < 120; ++n) {
    const FlowStep step = flow->march(1, 0.5);
    ASSERT_NEAR(norm(step.momentum_gap), 0, 1e-7 * largest) << n;
    ASSERT_LT(step.mass_defect, n == 1 ? 4e-3 : 2e-3) << n;  // largest after the jump of the inflow
  }
  const FlowField field = flow->field();
  EXPECT_LT(norm(sample(field.grid, field.velocity, {-2.5, 2.5, -2.5}) - Vec3{6, -5, 6}), 1);
}

TEST(FarField, TheForceOnADiskIsTheMomentumThatTheAirLoses) {
  for (const Vec3 velocity :
       {Vec3{0, 0, 30}, Vec3{12, -17, 21}, Vec3{0, 21, 21}, Vec3{-21, 0, -21}, Vec3{0, 5, -30}}) {
    FlowProblem problem = disk_in_the_box(velocity);
    problem.bodies[0].surface = turned(problem.bodies[0].surface, problem.air.direction());
    problem.stopping.max_iterations = 300;
    const FlowField field = solve(*make_cartesian(one_thread()), problem);
    EXPECT_TRUE(field.converged);
    const double drag = norm(field.porous_force);
    EXPECT_NEAR(norm(field.momentum_deficit - field.porous_force), 0, 2e-3 * drag);
    EXPECT_GT(dot(field.porous_force, problem.air.direction()), 0.95 * drag);
  }
}

// Full steps of the march oscillate at 45 degrees; the smaller ones of an oblique stream settle.
TEST(FarField, AStreamAt45DegreesSettlesInAWideBox) {
  FlowProblem problem = empty_box({14.142, 0, 14.142});
  problem.grid = graded({{-5, -5, -5}, {10, 10, 10}, 41, 41, 41}, {-0.8, -0.8, -0.8}, {0.8, 0.8, 0.8}, 1.2);
  problem.bodies = {sheet_body(turned(disk(1, {}), problem.air.direction()), {0, 1.2})};
  problem.stopping = {.residual = 1e-4, .max_iterations = 400};
  const FlowField field = solve(*make_cartesian(one_thread()), problem);
  EXPECT_TRUE(field.converged) << largest_residual(field.last);
}

TEST(FarField, AWindThatIsNotAlongZNeedsTheFarField) {
  FlowProblem problem = empty_box({0, 0, 20});
  problem.sides = Sides::slip;
  const auto engine = make_cartesian(one_thread());
  const auto flow = engine->start(problem);
  EXPECT_NO_THROW(flow->stream({0, 0, 19}, {0, 0, -1}));
  try {
    flow->stream({1, 0, 19}, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("far-field"), std::string::npos);
  }
}

TEST(FarField, AStreamOfNoSpeedOrAboveMach03IsRefused) {
  const auto engine = make_cartesian(one_thread());
  for (const Vec3 velocity : {Vec3{}, Vec3{0, 0, 104}, Vec3{70, 0, 80}}) {
    try {
      engine->start(empty_box(velocity));
      FAIL() << norm(velocity);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find("at most 103"), std::string::npos) << error.what();
    }
  }
  EXPECT_NO_THROW(engine->start(empty_box({0, 0, -102})));
}

TEST(FarField, AJetLeavesItsNozzleAlongZ) {
  FlowProblem problem = empty_box({1, 0, 20});
  problem.sides = Sides::entraining;
  problem.jet = Jet{{NozzleShape::circle, 0.5, 0}, 0.1, 0.05};
  EXPECT_THROW(make_cartesian(one_thread())->start(problem), Error);
  problem.air.velocity = {0, 0, 20};
  EXPECT_NO_THROW(make_cartesian(one_thread())->start(problem));
  problem.sides = Sides::far_field;
  EXPECT_THROW(make_cartesian(one_thread())->start(problem), Error);
}

// The extension test: a kind of boundary is one class and one row.
TEST(Boundaries, AKindIsAddedByOneRow) {
  class Walls final : public cartesian::SideBoundary {
    double mirror() const override { return -1; }
  };
  add_boundary({"walls-of-a-test", "nothing passes", [] { return std::make_unique<Walls>(); }, {}});
  FlowProblem problem = disk_in_the_box({0, 0, 20});
  problem.sides = {"walls-of-a-test"};
  const FlowField mine = solve(*make_cartesian(one_thread()), problem);
  problem.sides = Sides::slip;
  const FlowField slip = solve(*make_cartesian(one_thread()), problem);
  EXPECT_EQ(mine.porous_force, slip.porous_force);
  EXPECT_EQ(mine.pressure, slip.pressure);
  problem.sides = Sides::zero_gradient;
  EXPECT_NE(solve(*make_cartesian(one_thread()), problem).porous_force, slip.porous_force);
}

TEST(Boundaries, AnUnknownWordIsRefusedWithThoseThatThereAre) {
  FlowProblem problem = empty_box({0, 0, 20});
  problem.sides = {"slippery"};
  try {
    make_cartesian(one_thread())->start(problem);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("zero-gradient, slip, entraining, far-field"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace ripstop::far_fields
