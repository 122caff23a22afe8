// A flow is the same in all directions of the axes: it is solved along the axis nearest to its stream.
#include "ripstop/flow/cartesian/march_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"

namespace ripstop::march_frames {
namespace {

using cartesian::MarchFrame;

double largest(Vec3 v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TEST(MarchFrame, HasTheStreamNearestToItsZ) {
  for (const Vec3 stream : {Vec3{0, 0, 30}, Vec3{0, 0, -30}, Vec3{30, 0, 0}, Vec3{-30, 1, 2}, Vec3{1, 30, -2},
                            Vec3{1, -30, -20}, Vec3{20, 5, -21}, Vec3{20, 20, 20}}) {
    const MarchFrame frame(stream);
    EXPECT_EQ(frame.into(stream).z, largest(stream));
    EXPECT_EQ(frame.back(frame.into(stream)), stream);
    const Vec3 a{1, 2, 3}, b{-2, 5, 7};
    EXPECT_EQ(cross(frame.into(a), frame.into(b)), frame.into(cross(a, b)));  // no reflection
    EXPECT_EQ(frame.same(), stream.z == largest(stream));
  }
}

CartesianSettings one_thread() {
  CartesianSettings settings;
  settings.threads = 1, settings.second_order = true;
  return settings;
}

/// Vectors of a problem turned with its stream from z into another axis.
using Turn = std::function<Vec3(Vec3)>;

Vec3 unturned(Vec3 v) {
  return v;
}

std::vector<Triangle> turned_by(const Turn& turn, std::vector<Triangle> surface) {
  for (Triangle& t : surface) t = {turn(t.a), turn(t.b), turn(t.c)};
  return surface;
}

/// A disk of cloth, off the axis, and porous cells behind it, which a force on the air pulls as well. The box is a cube.
FlowProblem problem_of(const Turn& turn) {
  FlowProblem problem;
  problem.grid = graded({{-3, -3, -3}, {6, 6, 6}, 26, 26, 26}, {-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}, 1.2);
  problem.air.velocity = turn({0, 0, 20});
  problem.sides = Sides::far_field;
  const auto behind = turned_by(turn, disk(0.6, {0.1, 0.13, 0.53}));
  problem.bodies = {sheet_body(turned_by(turn, disk(1, {0.01, 0.12, 0.03})), {5, 1.2}, "disk"),
                    porous_body({cut_cells(problem.grid, behind), 0, 4}, "cells")};
  for (FlowBody& body : problem.bodies) body.moment_about = turn({0, 0.5, -1});
  problem.body_force.resize(static_cast<std::size_t>(problem.grid.cells()));
  for (const int cell : problem.bodies[1].porous().cells)
    problem.body_force[static_cast<std::size_t>(cell)] = turn({3, 0, -10});
  return problem;
}

void expect_same(const FlowField& field, const FlowField& along_z, const Turn& turn) {
  EXPECT_TRUE(field.converged);
  ASSERT_EQ(field.bodies.size(), along_z.bodies.size());
  const double drag = norm(along_z.porous_force);
  EXPECT_NEAR(norm(field.porous_force - turn(along_z.porous_force)), 0, 1e-3 * drag);
  EXPECT_NEAR(norm(field.momentum_deficit - turn(along_z.momentum_deficit)), 0, 1e-3 * drag);
  for (std::size_t n = 0; n < field.bodies.size(); ++n) {
    EXPECT_NEAR(norm(field.bodies[n].force - turn(along_z.bodies[n].force)), 0, 1e-3 * drag);
    EXPECT_NEAR(norm(field.bodies[n].moment - turn(along_z.bodies[n].moment)), 0, 1e-3 * drag);
  }
  for (const Vec3 point : {Vec3{0.2, -0.3, 0.4}, Vec3{1, 0.5, -2}, Vec3{-0.1, 0.2, 2.5}}) {
    EXPECT_NEAR(norm(sample(field.grid, field.velocity, turn(point)) -
                     turn(sample(along_z.grid, along_z.velocity, point))),
                0, 1e-3 * 20);
    EXPECT_NEAR(sample(field.grid, field.pressure, turn(point)),
                sample(along_z.grid, along_z.pressure, point), 1e-3 * 240);
  }
}

const Turn turns[] = {[](Vec3 v) {
                        return Vec3{v.z, v.x, v.y};
                      },
                      [](Vec3 v) {
                        return Vec3{v.x, -v.y, -v.z};
                      },
                      [](Vec3 v) {
                        return Vec3{v.x, -v.z, v.y};
                      }};

TEST(MarchFrame, AStreamAlongAnyAxisHasTheForcesAndFieldsOfOneAlongZ) {
  const auto solved = [](const Turn& turn) {
    const auto engine = make_cartesian(one_thread());
    const auto flow = engine->start(problem_of(turn));
    FlowField field = (flow->advance(300, 1e-5), flow->field());
    field.converged = flow->advance(1, 1e-5).converged;
    return field;
  };
  const FlowField reference = solved(unturned);
  EXPECT_GT(norm(reference.bodies[1].force), 0.02 * norm(reference.porous_force));
  for (const Turn& turn : turns) expect_same(solved(turn), reference, turn);
}

TEST(MarchFrame, StepsInTimeAreTheSameAlongAnyAxis) {
  const auto marched = [](const Turn& turn) {
    const auto engine = make_cartesian(one_thread());
    const auto flow = engine->start(problem_of(turn));
    FlowStep last = flow->march(10, 0.5);
    flow->stream(turn({2, 1, 19}), turn({1, 0, -3}));
    flow->place(0, turned_by(turn, disk(1, {0.01, 0.12, 0.04})));
    last = flow->march(10, 0.5);
    return std::pair(last, flow->sheet_loads());
  };
  const auto [step, loads] = marched(unturned);
  for (const Turn& turn : turns) {
    const auto [other, other_loads] = marched(turn);
    // Each step solves the pressure to a twentieth of its change, not to rounding.
    EXPECT_NEAR(norm(other.force - turn(step.force)), 0, 1e-3 * norm(step.force));
    EXPECT_NEAR(norm(other.momentum_gap - turn(step.momentum_gap)), 0, 1e-5 * norm(step.force));
    EXPECT_NEAR(norm(other.bodies[0].moment - turn(step.bodies[0].moment)), 0, 1e-3 * norm(step.force));
    Vec3 sum, other_sum;
    for (const SheetLoad& load : loads) sum += load.area * load.outward;
    for (const SheetLoad& load : other_loads) other_sum += load.area * load.outward;
    EXPECT_NEAR(norm(other_sum - turn(sum)), 0, 1e-6 * norm(sum));
  }
}

TEST(MarchFrame, ASavedFlowContinuesInItsOwnFrameOnly) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "march_frame";
  const auto engine = make_cartesian(one_thread());
  const auto flow = engine->start(problem_of(turns[0]));
  flow->advance(5, 1e-9);
  flow->save(folder);
  const auto restored = engine->start(problem_of(turns[0]));
  restored->restore(folder);
  EXPECT_EQ(restored->advance(3, 1e-9).last.drag, flow->advance(3, 1e-9).last.drag);
  EXPECT_EQ(restored->field().velocity, flow->field().velocity);
  const auto other = engine->start(problem_of(unturned));
  try {
    other->restore(folder);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
  }
}

}  // namespace
}  // namespace ripstop::march_frames
