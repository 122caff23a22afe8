// Steps of cloth and flow together.
#include "ripstop/fsi/coupled_step.h"

#include <gtest/gtest.h>

#include "../small_case.h"
#include "ripstop/case/opening.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/fsi/coupled_opening.h"

namespace ripstop {
namespace {

// Far above the stability limit the prediction diverges, as the cloth does that strain makes stiffer during the step.
TEST(CoupledStep, IsTakenInSmallerStepsWhereThePredictionDiverges) {
  const Settings resolved = resolve(opening_case(small_opening_in_air()));
  const auto end_of = [&](double step_fraction) {
    InflationProblem problem = opening_problem(resolved, load_source(resolved), 1);
    problem.air->engine = make_cartesian({});
    problem.settings.step_fraction = step_fraction;
    CoupledOpening opening(problem);
    InflationState state = opening.start();
    opening.advance(state);
    return state;
  };
  const InflationState usual = end_of(0.9), too_long = end_of(3.6);
  EXPECT_EQ(usual.step_changes, 0);
  EXPECT_GT(too_long.step_changes, 0);
  EXPECT_NEAR(too_long.peak_load / usual.peak_load, 1, 0.05);
}

}  // namespace
}  // namespace ripstop
