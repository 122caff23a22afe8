// Several bodies in one flow, each with a force and a moment of its own.
#include "ripstop/flow/bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"

namespace ripstop::several_bodies {
namespace {

constexpr double density = 1.2, speed = 20;

CartesianSettings one_thread() {
  CartesianSettings settings;
  settings.threads = 1, settings.second_order = true;
  return settings;
}

FlowBody porous_disk(std::string name, Vec3 centre) {
  return sheet_body(disk(1, centre), {0, density}, std::move(name));
}

// Room for two disks ten diameters apart, across the stream. The cells around both are equal.
FlowProblem wide_box() {
  FlowProblem problem;
  problem.grid = {{-15, -5, -5}, {30, 10, 15}, 120, 36, 44};
  problem.grid = graded(problem.grid, {-6, -0.8, -0.8}, {6, 0.8, 1.2}, 1.2);
  problem.air.velocity = {0, 0, speed}, problem.air.density = density;
  problem.sides = Sides::far_field;
  problem.stopping.residual = 1e-4;
  return problem;
}

TEST(Bodies, TwoTenDiametersApartHaveTheForceOfOne) {
  FlowProblem one = wide_box(), two = wide_box();
  const double pitch = one.grid.width(0, one.grid.cell_at(0, 0));
  const double left = -std::round(5 / pitch) * pitch, right = left + std::round(10 / pitch) * pitch;
  one.bodies = {porous_disk("left", {left, 0, 0})};
  two.bodies = {porous_disk("left", {left, 0, 0}), porous_disk("right", {right, 0, 0})};
  const FlowField alone = solve(*make_cartesian(one_thread()), one),
                  both = solve(*make_cartesian(one_thread()), two);
  ASSERT_EQ(both.bodies.size(), 2u);
  const double force = alone.porous_force.z;
  EXPECT_NEAR(both.bodies[0].force.z / force, 1, 0.01);
  EXPECT_NEAR(both.bodies[1].force.z / force, 1, 0.01);
  EXPECT_NEAR(norm(both.bodies[0].force + both.bodies[1].force - both.porous_force), 0, 1e-9 * force);
}

FlowProblem narrow_box() {
  FlowProblem problem;
  problem.grid = graded({{-3, -3, -3}, {6, 6, 7}, 26, 26, 30}, {-0.9, -0.9, -0.9}, {0.9, 0.9, 1.6}, 1.2);
  problem.air.velocity = {0, 0, speed}, problem.air.density = density;
  problem.sides = Sides::far_field;
  return problem;
}

TEST(Bodies, AMomentIsThatOfTheForcesAboutTheBodysPoint) {
  FlowProblem problem = narrow_box();
  problem.bodies = {porous_disk("disk", {0.2, 0, 0})};
  problem.bodies[0].moment_about = {0, 0, 2};
  const auto engine = make_cartesian(one_thread());
  const auto flow = engine->start(problem);
  flow->march(20, 0.7);
  const FlowField field = flow->field();
  BodyLoad sum;
  for (const SheetLoad& load : field.sheet_loads)
    sum.force += load.force, sum.moment += cross(load.point - Vec3{0, 0, 2}, load.force);
  ASSERT_EQ(field.bodies.size(), 1u);
  EXPECT_NEAR(norm(field.bodies[0].force - sum.force), 0, 1e-12 * norm(sum.force));
  EXPECT_NEAR(norm(field.bodies[0].moment - sum.moment), 0, 1e-12 * norm(sum.moment));
  EXPECT_NEAR(field.bodies[0].moment.y, -0.2 * field.bodies[0].force.z, 0.02 * field.bodies[0].force.z);
}

TEST(Bodies, ASheetAndPorousCellsAddUpToTheForceOnBoth) {
  FlowProblem problem = narrow_box();
  PorousCells cells{cut_cells(problem.grid, disk(0.6, {0, 0, 1.1})), 0, 20};
  problem.bodies = {porous_disk("disk", {0, 0, 0}), porous_body(cells, "screen")};
  const FlowField field = solve(*make_cartesian(one_thread()), problem);
  ASSERT_EQ(field.bodies.size(), 2u);
  EXPECT_GT(field.bodies[1].force.z, 0.01 * field.bodies[0].force.z);
  EXPECT_NEAR(norm(field.bodies[0].force + field.bodies[1].force - field.porous_force), 0,
              1e-9 * norm(field.porous_force));
}

TEST(Bodies, EachIsPlacedByItself) {
  FlowProblem apart = narrow_box(), moved = narrow_box();
  apart.bodies = {porous_disk("front", {0, 0, 0}), porous_disk("rear", {0, 0, 1})};
  moved.bodies = {porous_disk("front", {0, 0, 0.5}), porous_disk("rear", {0, 0, 1})};
  const auto engine = make_cartesian(one_thread());
  const auto began = engine->start(apart), placed = engine->start(moved);
  placed->place(0, apart.bodies[0].surface);
  began->march(5, 0.7), placed->march(5, 0.7);
  EXPECT_EQ(began->field().porous_force, placed->field().porous_force);
}

/// The largest drop across the surface of a body in the last ten of 60 steps, over the dynamic pressure, and the largest
/// mass defect after the first five.
struct Disturbance {
  double drop = 0, defect = 0, coefficient = 0;
};
Disturbance in_time(std::vector<Triangle> surface, double area) {
  FlowProblem problem = narrow_box();
  problem.bodies = {sheet_body(std::move(surface), impermeable, "solid")};
  const auto engine = make_cartesian(one_thread());
  const auto flow = engine->start(problem);
  const double q = 0.5 * density * speed * speed;
  Disturbance most;
  flow->march(60, 0.7, [&](const FlowStep& step) {
    EXPECT_NEAR(norm(step.momentum_gap), 0, 1e-8 * q * area) << "step " << step.step;
    if (step.step > 5) most.defect = std::max(most.defect, step.mass_defect);
    for (const SheetLoad& load : flow->sheet_loads())
      if (step.step > 50 && load.area > 0) most.drop = std::max(most.drop, std::abs(load.drop) / q);
    most.coefficient = step.force.z / (q * area);
    return true;
  });
  return most;
}

/// The force along z in one step of length 1e-4 s about a sphere after 30 steps, in a frame that accelerates [m/s2].
double force_with(double acceleration) {
  FlowProblem problem = narrow_box();
  problem.bodies = {sheet_body({}, {0, 1}, "canopy"),
                    sheet_body(sphere(1, {0.02, 0.01, 0.5}), impermeable, "sphere")};
  const auto engine = make_cartesian(one_thread());
  const auto flow = engine->start(problem);
  double now = speed;
  const auto step = [&](double gained) {
    constexpr double length = 1e-4;
    now += length * gained;
    flow->stream({0, 0, now}, {0, 0, gained});
    const BodyLoad load = flow->step(length).bodies.at(1);
    return without_displaced_air(load, problem.bodies[1], {0, 0, density * gained}).force.z;
  };
  for (int n = 0; n < 30; ++n) step(0);
  return step(acceleration);
}

// Half of the mass of the displaced air in potential flow. A stream that a pressure gradient accelerates would add the
// whole of it (buoyancy), but this one accelerates with its frame. On 7 cells across the sphere it is 0.73.
TEST(Bodies, InAnAcceleratingFrameASphereHasTheForceOfItsAddedMass) {
  constexpr double acceleration = 50, displaced = density * 3.14159265 / 6;  // [kg]
  EXPECT_NEAR((force_with(acceleration) - force_with(0)) / (displaced * acceleration), 0.5, 0.25);
}

// Air inside would be joined to the flow by the smallest of leaks only: the mass defect rose to 0.1, and the drag of a
// cube in time to twice the measured one.
TEST(Bodies, ASolidBodyHasNoAirInsideThatDisturbsTheFlowInTime) {
  const Disturbance cube = in_time(block({1, 1, 1}, {0, 0, 0.5}), 1),
                    ball = in_time(sphere(1, {0.02, 0.01, 0.5}), 0.785398);
  for (const Disturbance& of : {cube, ball}) {
    EXPECT_LT(of.defect, 2e-3);
    EXPECT_LT(of.drop, 3);
  }
  EXPECT_GT(cube.coefficient, 0.8);
  EXPECT_LT(cube.coefficient, 1.5);
  EXPECT_LT(ball.coefficient, cube.coefficient);
}

// The drops of all faces, those inside included, add up to the pressure on the surface and the small friction of the
// eddies that act on the air inside.
TEST(Bodies, TheForceOnASolidBodyIsThatOfThePressureOnItsSurface) {
  FlowProblem problem = narrow_box();
  problem.bodies = {sheet_body(block({1, 1, 1}, {0.03, 0.02, 0.5}), impermeable, "solid")};
  const auto engine = make_cartesian(one_thread());
  const auto flow = engine->start(problem);
  flow->march(30, 0.7);
  const FlowField field = flow->field();
  Vec3 pressed;
  for (const SheetLoad& load : field.sheet_loads) {
    if (!load.outside) continue;
    const double area = norm(load.force) / std::abs(load.drop);
    const Vec3 n = load.outward;  // along an axis, by the faces of a cube
    pressed += (-*load.outside * area) * Vec3{std::round(n.x), std::round(n.y), std::round(n.z)};
  }
  EXPECT_GT(field.bodies[0].force.z, 50);
  EXPECT_NEAR(norm(pressed - field.bodies[0].force), 0, 0.05 * field.bodies[0].force.z);
}

std::string refusal(const FlowProblem& problem) {
  try {
    make_cartesian(one_thread())->start(problem);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return {};
}

TEST(Bodies, OfOneNameAreRefused) {
  FlowProblem problem = narrow_box();
  problem.bodies = {porous_disk("main", {0, 0, 0}), porous_disk("main", {0, 0, 1})};
  EXPECT_NE(refusal(problem).find("bodies 1 and 2 have the same name \"main\""), std::string::npos);
}

TEST(Bodies, ThatCutEachOtherAreRefused) {
  FlowProblem problem = narrow_box();
  problem.bodies = {porous_disk("main", {0, 0, 0}),
                    sheet_body(hemispherical_cup(0.8, {0.3, 0, -0.2}), {1e4, 0}, "drogue")};
  EXPECT_NE(refusal(problem).find("\"main\" and \"drogue\" intersect"), std::string::npos);
  problem.bodies[1].surface = hemispherical_cup(0.8, {0.3, 0, 0.1});
  EXPECT_EQ(refusal(problem), "");
}

TEST(Bodies, ThatLeaveTheBoxAreRefused) {
  FlowProblem problem = narrow_box();
  problem.bodies = {porous_disk("main", {2.6, 0, 0})};
  const std::string said = refusal(problem);
  EXPECT_NE(said.find("\"main\" extends from x = 2.1 to 3.1 m"), std::string::npos) << said;
  EXPECT_NE(said.find("-3 to 3 m"), std::string::npos) << said;
  EXPECT_NE(said.find("change the position of the body"), std::string::npos) << said;
  problem.bodies = {porous_disk("main", {2.4, 0, 0})};
  EXPECT_EQ(refusal(problem), "");
}

}  // namespace
}  // namespace ripstop::several_bodies
