// Extensions of a flow without edits of the solvers: a second canopy and an angle of attack are settings, and a
// boundary is one class and one row. A family and an engine: new_family_test.cpp, new_engine_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "ripstop/case/assemble.h"
#include "ripstop/flow/boundaries.h"
#include "ripstop/flow/cartesian/boundary.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/projections.h"
#include "ripstop/flow/steady.h"
#include "ripstop/fsi/transfer.h"
#include "ripstop/mesh/mesh.h"
#include "ripstop/run/engine.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

/// Nothing passes, and the air slips along it.
class Walls final : public cartesian::SideBoundary {
  double mirror() const override { return -1; }
};
// Before any test reads a case: the engines list their boundaries once.
const bool added = [] {
  add_boundary({"walls-of-a-test", "walls of a test", [] { return std::make_unique<Walls>(); }, {}});
  return true;
}();

Case in_a_wide_box(double angle_deg) {
  Case given = flat_circular_case(1, 600, 10);
  given.flow.angle_of_attack_deg = angle_deg;
  given.flow.box_m = Vec3{6, 6, 6};
  given.flow.cells = {36, 36, 36};
  given.flow.max_iterations = 60;
  given.coupling.threads = 1;
  return given;
}

CartesianSettings one_thread() {
  CartesianSettings settings;
  settings.threads = 1;
  return settings;
}

// The stream turns in the plane of x and z, so that two canopies along y have loads that mirror each other.
TEST(Extension, ASecondCanopyAndAnAngleOfAttackAreSettings) {
  constexpr double angle = 20;
  const Settings resolved = resolve(checked(in_a_wide_box(angle)));
  const CanopyMesh mesh = parachute_mesh(resolved);
  FlowProblem problem = flow_problem(resolved);
  ASSERT_EQ(problem.bodies.size(), 1u);
  problem.bodies.push_back(problem.bodies.front());
  problem.bodies[0].name = "left", problem.bodies[1].name = "right";
  for (const int side : {0, 1}) {
    std::vector<Vec3> shape = mesh.start;
    for (Vec3& x : shape) x.y += side == 0 ? -1 : 1;
    problem.bodies[side].surface = surface_of(cells_of(mesh), shape);
  }
  const FlowField field = solve(*make_cartesian(one_thread()), problem);
  ASSERT_EQ(field.bodies.size(), 2u);
  const Vec3 left = field.bodies[0].force, right = field.bodies[1].force, sum = left + right;
  const Vec3 wind = problem.air.direction();
  EXPECT_NEAR(wind.x, std::sin(angle * M_PI / 180), 1e-12);
  const double drag = dot(left, wind), dynamic_pressure = 0.5 * problem.air.density * 100;
  EXPECT_GT(drag, 0.5 * dynamic_pressure * M_PI / 4);
  EXPECT_NEAR(dot(right, wind) / drag, 1, 0.03);
  EXPECT_NEAR((left.x - right.x) / drag, 0, 0.03);
  EXPECT_NEAR((left.y + right.y) / drag, 0, 0.03);
  EXPECT_NEAR(norm(sum - field.porous_force) / drag, 0, 1e-9);
}

TEST(Extension, ABoundaryOfOneClassAndOneRowIsAWordOfTheCaseAndASolution) {
  Case given = in_a_wide_box(0);
  given.flow.sides = Sides{"walls-of-a-test"};
  const Settings resolved = resolve(checked(given));
  EXPECT_NE(case_toml(resolved).find("sides = \"walls-of-a-test\""), std::string::npos);
  EXPECT_NE(case_schema().find("walls-of-a-test"), std::string::npos);
  EXPECT_NE(case_reference().find("walls of a test"), std::string::npos);
  const auto drag = [&](Sides sides) {
    FlowProblem problem = flow_problem(resolved);
    const CanopyMesh mesh = parachute_mesh(resolved);
    problem.bodies.front().surface = surface_of(cells_of(mesh), mesh.start);
    problem.sides = sides;
    problem.stopping.max_iterations = 20, problem.stopping.average_over = 0;
    return solve(*make_cartesian(one_thread()), problem).porous_force;
  };
  EXPECT_EQ(drag(resolved.flow().sides), drag(Sides::slip));
  EXPECT_NE(drag(Sides::zero_gradient), drag(Sides::slip));  // the force depends on the sides
}

}  // namespace
}  // namespace ripstop
