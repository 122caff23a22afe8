// C_a is found where it was hidden.
#include "ripstop/calibration/damping.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../printed_materials.h"
#include "ripstop/core/error.h"
#include "ripstop/parachute/build.h"
#include "ripstop/parachute/disk_gap_band.h"

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

// The first points lie in equal ratios from end to end; then a golden section between the best one's neighbours, in
// logarithms.
TEST(DampingCalibration, ItsTrialsAreAGridInLogarithmsAndAGoldenSectionAboutItsBest) {
  const DampingTarget target{oscillator(8.7).peak, {}};
  std::vector<double> told;
  const auto listen = [&](const DampingTrial& trial) { told.push_back(trial.damping); };
  const DampingCalibration grid = calibrate_damping(target, {4, 16, 5, 0}, oscillator, listen);
  ASSERT_EQ(told.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(told[i], 4 * std::pow(2, 0.5 * i), 1e-12) << i;
  EXPECT_NEAR(grid.best.damping, 8, 1e-12);
  EXPECT_NEAR(grid.best.misfit, std::abs(grid.best.peak / target.peak - 1), 1e-12);
  told.clear();
  calibrate_damping(target, {4, 16, 5, 4}, oscillator, listen);
  ASSERT_EQ(told.size(), 9u);
  const double low = std::log(4 * std::sqrt(2)), high = std::log(8 * std::sqrt(2)),
               golden = (std::sqrt(5) - 1) / 2;
  const double a = high - golden * (high - low), b = low + golden * (high - low);
  EXPECT_NEAR(std::log(told[5]), a, 1e-9);
  EXPECT_NEAR(std::log(told[6]), b, 1e-9);
  // 8.7 is nearer to b: it goes on above a, then about that.
  EXPECT_NEAR(std::log(told[7]), a + golden * (high - a), 1e-9);
}

TEST(DampingCalibration, ASearchThatIsNoneIsRefused) {
  for (const DampingSearch& search : {DampingSearch{0, 16, 5, 4}, {4, 4, 5, 4}, {4, 16, 2, 4}}) {
    try {
      calibrate_damping({600, {}}, search, oscillator);
      ADD_FAILURE() << search.from << " " << search.to << " " << search.points;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find("requires 0 < from < to and at least 3 points"),
                std::string::npos);
    }
  }
  EXPECT_NO_THROW(calibrate_damping({600, {}}, {4, 16, 3, 0}, oscillator));
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

/// A small disk-gap-band, folded, at the beginning of its opening.
InflationProblem short_opening(double low_pass_hz) {
  Design design = printed_stratos(600);
  design.canopy = DiskGapBand{1.0, 0.2, 0.07, 0.3};
  design.lines.count = 6;
  design.mesh.line_segment_m = 0.15;
  design.mesh.folds = 6;
  InflationProblem problem{build_mesh(design, printed_materials()), {}, 200, false, 1};
  problem.settings.initial_radius_m = 0.2;
  problem.settings.duration_s = 0.02;
  problem.settings.frames = 4;
  problem.settings.low_pass_hz = low_pass_hz;
  problem.symmetry = 6;
  return problem;
}

// What is measured is filtered; what happens is not.
TEST(DampingCalibration, AFilterOfTheLoadChangesThePeakThatIsComparedAndNotTheOpening) {
  const DampingTrial plain = open_with(8, short_opening(0)), filtered = open_with(8, short_opening(100));
  EXPECT_GT(plain.every_step_peak, 0);
  EXPECT_EQ(plain.peak, plain.every_step_peak);
  EXPECT_EQ(filtered.every_step_peak, plain.every_step_peak);
  EXPECT_LT(filtered.peak, filtered.every_step_peak);
  EXPECT_LT(open_with(80, short_opening(0)).every_step_peak, plain.every_step_peak);
}

}  // namespace
}  // namespace ripstop
