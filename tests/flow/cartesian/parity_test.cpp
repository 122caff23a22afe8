// The built-in engine against the real OpenFOAM on the same cells.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "openfoam_installed.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"

namespace ripstop {
namespace {

struct Pair {
  const char* name;
  double darcy, forchheimer;
  double speed;         // [m/s]
  bool incompressible;  // porousSimpleFoam against constant density
};

class Parity : public testing::TestWithParam<Pair> {};

TEST_P(Parity, DragAndFieldsAreThoseOfOpenFoam) {
  if (!openfoam_is_installed()) GTEST_SKIP() << "OpenFOAM is not installed";
  FlowProblem problem;
  problem.grid = {{-1, -1, 0}, {2, 2, 4}, 25, 25, 38};
  problem.air.velocity = {0, 0, GetParam().speed};
  problem.bodies.push_back(porous_body(
      {cut_cells(problem.grid, rigid_disk_gap_band({0, 0, 2})), GetParam().darcy, GetParam().forchheimer}));
  OpenFoamSettings reference;
  reference.folder = std::filesystem::path(testing::TempDir()) / (std::string("parity_") + GetParam().name);
  std::filesystem::remove_all(reference.folder);
  reference.incompressible = GetParam().incompressible;
  CartesianSettings settings;
  settings.threads = 1;
  settings.compressible = !GetParam().incompressible;
  const FlowField theirs = solve(*make_openfoam(reference), problem);
  const FlowField ours = solve(*make_cartesian(settings), problem);
  std::filesystem::remove_all(reference.folder);
  ASSERT_TRUE(theirs.converged);
  ASSERT_TRUE(ours.converged);

  EXPECT_NEAR(ours.porous_force.z / theirs.porous_force.z, 1, 0.005);
  double velocity = 0, pressure = 0;
  for (int cell = 0; cell < problem.grid.cells(); ++cell) {
    const Vec3 du = ours.velocity[cell] - theirs.velocity[cell];
    velocity += dot(du, du);
    pressure += std::pow(ours.pressure[cell] - theirs.pressure[cell], 2);
  }
  const double speed = problem.air.speed(), dynamic = 0.5 * problem.air.density * speed * speed;
  EXPECT_LT(std::sqrt(velocity / problem.grid.cells()) / speed, 0.01);
  EXPECT_LT(std::sqrt(pressure / problem.grid.cells()) / dynamic, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Canopies, Parity,
                         testing::Values(Pair{"open", 6.598, 3.745, 10, false},
                                         Pair{"nearly_solid", 1000, 1000, 10, false},
                                         Pair{"printed_incompressible", 65.98, 37.45, 10, true}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace ripstop
