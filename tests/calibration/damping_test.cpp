// C_a is found where it was hidden.
#include "ripstop/calibration/damping.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

// An oscillator's overshoot falls with damping, its settling time too: peak = 400 (1 + exp(-C_a / 10)).
DampingTrial oscillator(double damping) {
  DampingTrial trial;
  trial.damping = damping;
  trial.peak = 400 * (1 + std::exp(-damping / 10));
  trial.inflation_time = 1 / damping;
  return trial;
}

TEST(DampingCalibration, TheValueThatMadeThePeakIsFound) {
  const double hidden = 8.7;
  const DampingTarget target{oscillator(hidden).peak, {}};
  const DampingCalibration found = calibrate_damping(target, {4, 16, 7, 14}, oscillator);
  EXPECT_NEAR(found.best.damping, hidden, 0.02);
  EXPECT_FALSE(found.at_edge);
  EXPECT_EQ(found.trials.size(), 21u);
}

TEST(DampingCalibration, PeakAndTimeThatContradictEachOtherShareTheError) {
  const DampingTarget target{oscillator(6).peak, 1.0 / 12};
  const DampingCalibration found = calibrate_damping(target, {4, 16, 7, 14}, oscillator);
  EXPECT_GT(found.best.damping, 6);
  EXPECT_LT(found.best.damping, 12.1);
  for (const DampingTrial& trial : found.trials) EXPECT_GE(trial.misfit, found.best.misfit);
}

TEST(DampingCalibration, ABestValueAtTheEdgeOfTheRangeIsSaidToBeNone) {
  EXPECT_TRUE(calibrate_damping({oscillator(40).peak, {}}, {4, 16, 5, 4}, oscillator).at_edge);
  EXPECT_THROW(calibrate_damping({600, {}}, {16, 4, 5, 4}, oscillator), Error);
}

}  // namespace
}  // namespace ripstop
