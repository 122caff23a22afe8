// Solid bodies that move through the cells of a flow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"

namespace ripstop::rigid_motion {
namespace {

constexpr double density = 1.2;

FlowProblem box(Vec3 stream, std::vector<Triangle> surface) {
  FlowProblem problem;
  problem.grid = graded({{-3, -3, -3}, {6, 6, 7}, 30, 30, 34}, {-1.1, -1.1, -1.4}, {1.1, 1.1, 1.6}, 1.2);
  problem.air.velocity = stream, problem.air.density = density;
  problem.sides = Sides::far_field;
  problem.bodies = {sheet_body(std::move(surface), impermeable, "solid")};
  return problem;
}

std::unique_ptr<FlowEngine> engine() {
  CartesianSettings settings;
  settings.threads = 1, settings.second_order = true;
  return make_cartesian(settings);
}

std::vector<Triangle> shifted(std::vector<Triangle> surface, Vec3 by) {
  for (Triangle& t : surface)
    for (Vec3* p : {&t.a, &t.b, &t.c}) *p += by;
  return surface;
}

SheetMotion rigid(const RigidMotion& motion) {
  SheetMotion sheet;
  sheet.rigid = motion;
  return sheet;
}

// Cells pass from air to body and back; each has the velocity of the stream.
TEST(RigidMotion, ABodyThatDriftsWithTheStreamLeavesItUniform) {
  const Vec3 stream{3, -2, 20};
  const std::vector<Triangle> start = sphere(1, {0.02, 0.01, 0});
  const auto maker = engine();
  const auto flow = maker->start(box(stream, start));
  const double length = 1.5e-3;
  for (int n = 0; n < 20; ++n) {
    flow->place(0, shifted(start, n * length * stream), rigid({stream, {}, {}}));
    EXPECT_NEAR(norm(flow->step(length).force), 0, 1e-3) << "of 1.2 x 200 x 0.8 N";
  }
  double most = 0;
  for (const Vec3 velocity : flow->field().velocity) most = std::max(most, norm(velocity - stream));
  EXPECT_LT(most, 1e-4);
}

/// Mean force along z of a cube at a relative speed of 20 m/s, while it moves at `moves`.
double drag(double moves) {
  constexpr double length = 1.2e-3;
  constexpr int steps = 150;
  // The mean of its place in the second half is that of a cube at rest.
  const std::vector<Triangle> start = block({1, 1, 1}, {0.03, 0.02, 0.5 - 0.75 * steps * length * moves});
  const auto maker = engine();
  const auto flow = maker->start(box({0, 0, 20 + moves}, start));
  double sum = 0;
  for (int n = 0; n < steps; ++n) {
    const Vec3 velocity{0, 0, moves};
    flow->place(0, shifted(start, n * length * velocity), rigid({velocity, {}, {}}));
    const double force = flow->step(length).force.z;
    if (n >= steps / 2) sum += force / (steps - steps / 2);
  }
  return sum;
}

// The wake is that of half a passage, and the cube moves by three cells.
TEST(RigidMotion, TheDragDependsOnTheRelativeSpeedOnly) {
  const double at_rest = drag(0);
  EXPECT_GT(at_rest, 0.8 * 0.5 * density * 400);
  EXPECT_NEAR(drag(-5) / at_rest, 1, 0.06);
  EXPECT_NEAR(drag(5) / at_rest, 1, 0.06);
}

// Each face has the velocity of the body at its centre, so that the cells inside neither gain nor lose air. With one
// velocity for all faces of a triangle the defect is above 0.01.
TEST(RigidMotion, ABodyThatTurnsNeitherTakesNorGivesAir) {
  const Vec3 about{0.03, 0.02, 0}, spin{4, 1, 3};
  const std::vector<Triangle> surface = sphere(1.6, about);  // its place does not change
  const auto maker = engine();
  const auto flow = maker->start(box({0, 0, 5}, surface));
  FlowStep last;
  for (int n = 0; n < 30; ++n) {
    flow->place(0, surface, rigid({{}, spin, about}));
    last = flow->step(4e-3);
    EXPECT_NEAR(norm(last.momentum_gap), 0, 1e-8 * 30) << n;
  }
  EXPECT_LT(last.mass_defect, 3e-4);
}

// The stream is along x: the axes of the march are others than those of the problem.
TEST(RigidMotion, IsTheSameInTheAxesOfTheMarch) {
  const Vec3 stream{20, 1, 0};
  const std::vector<Triangle> start = sphere(1, {0, 0, 0});
  const auto maker = engine();
  const auto flow = maker->start(box(stream, start));
  for (int n = 0; n < 10; ++n) {
    flow->place(0, shifted(start, n * 1e-3 * stream), rigid({stream, {}, {}}));
    EXPECT_NEAR(norm(flow->step(1e-3).force), 0, 1e-3);
  }
}

}  // namespace
}  // namespace ripstop::rigid_motion
