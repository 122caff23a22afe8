#include "ripstop/calibration/porosity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

constexpr double area = 1.72;  // [m2]

MeasuredDrag at(double speed, double drag_area) {
  return {speed, speed, 1.2, drag_area * 0.5 * 1.2 * speed * speed};
}

// C_D = 0.9195 - 1.7794 gamma, with a fixed ripple over the shifts that averages out.
std::vector<PorosityTrial> trials_on_the_printed_line(std::size_t conditions, double ripple) {
  std::vector<PorosityTrial> trials;
  for (std::size_t c = 0; c < conditions; ++c)
    for (const double gamma : {0.18, 0.20, 0.22, 0.24})
      for (const int k : {-1, 0, 1})
        trials.push_back({gamma, 0.01 * k, c, area * (0.9195 - 1.7794 * gamma) * (1 + ripple * k)});
  return trials;
}

TEST(Porosity, OfDragsOnAKnownLineIsTheLine) {
  const auto found =
      calibrate_porosity({at(30, area * (0.9195 - 1.7794 * 0.2121))}, trials_on_the_printed_line(1, 0), area);
  EXPECT_NEAR(found.knob, 0.2121, 1e-12);
  EXPECT_NEAR(found.coefficient.slope, -1.7794, 1e-10);
  EXPECT_NEAR(found.coefficient.intercept, 0.9195, 1e-10);
  EXPECT_NEAR(found.coefficient.r2, 1, 1e-12);
  EXPECT_NEAR(found.error(), 0, 1e-9);
  EXPECT_FALSE(found.outside);
}

TEST(Porosity, IsAveragedOverGridAlignmentsWithTheirScatter) {
  const auto found = calibrate_porosity({at(30, area * (0.9195 - 1.7794 * 0.21))},
                                        trials_on_the_printed_line(1, 0.03), area);
  EXPECT_NEAR(found.knob, 0.21, 1e-12);
  EXPECT_NEAR(found.shift_scatter, 0.03 * std::sqrt(2.0 / 3), 1e-9);
  EXPECT_GT(found.error_computed, 0);
  EXPECT_EQ(found.error_measured, 0);
}

TEST(Porosity, OfSeveralPointsIsTheLeastSquaresOfTheirDragAreas) {
  // Two points 1 % above and below the line at 0.2: the best is between them, the error their scatter.
  const double middle = area * (0.9195 - 1.7794 * 0.2), off = 0.01 * middle;
  const auto found = calibrate_porosity({at(10, middle + off), at(30, middle - off)},
                                        trials_on_the_printed_line(2, 0), area);
  EXPECT_NEAR(found.knob, 0.2, 1e-12);
  // s / sqrt(sum of slopes^2), s^2 = 2 off^2 / 1
  EXPECT_NEAR(found.error_measured, off / (1.7794 * area), 1e-9);
  EXPECT_NEAR(found.misfit, 0.01, 1e-4);
}

TEST(Porosity, OnACurveIsWhereTheCurveMeetsTheMeasurementAndNotWhereALineWould) {
  std::vector<PorosityTrial> trials;
  for (const double gamma : {0.16, 0.20, 0.24, 0.28})
    trials.push_back({gamma, 0, 0, 0.003 / std::pow(gamma, 3)});
  const auto found = calibrate_porosity({at(20, 0.003 / std::pow(0.20, 3))}, trials, area);
  EXPECT_NEAR(found.knob, 0.20, 1e-12);
}

TEST(Porosity, OutsideTheComputedRangeIsReported) {
  const auto found =
      calibrate_porosity({at(30, area * (0.9195 - 1.7794 * 0.3))}, trials_on_the_printed_line(1, 0), area);
  EXPECT_TRUE(found.outside);
  EXPECT_NEAR(found.knob, 0.3, 1e-12);
}

TEST(Porosity, NeedsPointsAndTrials) {
  EXPECT_THROW(calibrate_porosity({}, trials_on_the_printed_line(1, 0), area), Error);
  EXPECT_THROW(calibrate_porosity({at(30, 0.7)}, {{0.2, 0, 0, 0.7}}, area), Error);
}

TEST(Porosity, OfThePrintedTableNeedsTheGammaThatItsCoefficientsFollowFrom) {
  // [NFM] Table 3 prints gamma = 0.22 with a = 65.98 and b = 37.45; they correspond to 0.2121 and 0.12 mm.
  const PressureDrop law = cloth_of(PorosityKnob::gamma, 0.2121, 1.2e-4);
  EXPECT_NEAR(law.linear, 65.98, 0.002 * 65.98);  // t has two digits
  EXPECT_NEAR(law.quadratic, 37.45, 0.05);
  EXPECT_GT(std::abs(cloth_of(PorosityKnob::gamma, 0.22, 1.2e-4).quadratic - 37.45), 3);
}

TEST(Porosity, AsPermeabilityIsTheCreepingLawOfTheTester) {
  const PressureDrop law = cloth_of(PorosityKnob::permeability, 3, 0);
  EXPECT_NEAR(cfm(law), 3, 1e-12);
  EXPECT_EQ(law.quadratic, 0);
  EXPECT_NEAR(law.linear, 8.2e3, 0.05e3);
  EXPECT_THROW(cloth_of(PorosityKnob::permeability, 0, 0), Error);
}

}  // namespace
}  // namespace ripstop
