// The whole loop on a coarse grid: the air's own load on tight cloth.
#include <gtest/gtest.h>

#include <filesystem>

#include "ripstop/case/assemble.h"
#include "ripstop/case/case.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/fsi/pressure_profile.h"
#include "ripstop/fsi/steady_loop.h"

namespace ripstop {
namespace {

TEST(OfFlow, ACanopyInFlightCarriesTheMomentumLossOfTheAir) {
  Overrides coarse;
  // Ten cells across: with fewer the load may jump as cloth passes from cell to cell.
  coarse.grid = {40, 40, 50};
  coarse.set = {
      {"parachute.mesh.cloth_nodes", "2000"}, {"coupling.load", "of-flow"}, {"coupling.threads", "1"}};
  const Case given =
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/hemispherical/case.toml", coarse);
  CartesianSettings settings;
  settings.threads = 1;
  settings.second_order = true;
  const auto engine = make_cartesian(settings);
  SteadySolver solver(steady_problem(resolve(given)), *engine);
  SteadyState state = solver.start();
  while (!solver.finished(state)) solver.iterate(state);

  const SteadyIteration& last = state.iterations.back();
  EXPECT_TRUE(state.converged);
  EXPECT_LE(last.iteration, 8);
  EXPECT_NEAR(last.nodal_load / last.fluid_force, 1, 0.01);

  // Inside the air of a tight canopy nearly rests; outside it has parted from the cloth.
  const Freestream& air = steady_problem(resolve(given)).flow.air;
  const double q = 0.5 * air.density * air.speed() * air.speed();
  for (const PressureRing& ring :
       pressure_profile(solver.cells(), state.shape, state.sides, state.applied, 12)) {
    EXPECT_GT(ring.inside / q, 0.5) << ring.arc;
    EXPECT_LT(ring.inside / q, 1.05) << ring.arc;
    EXPECT_LT(ring.outside / q, -0.1) << ring.arc;
    EXPECT_GT(ring.outside / q, -1.2) << ring.arc;
  }
}

}  // namespace
}  // namespace ripstop
