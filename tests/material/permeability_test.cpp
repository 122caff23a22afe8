#include "ripstop/material/permeability.h"

#include <gtest/gtest.h>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

TEST(Permeability, ErgunGivesThePrintedTapeColumn) {
  const PressureDrop tape = ergun({0.05, 0.5e-3});  // [NFM] Table 3, gamma printed; thickness: see docs
  EXPECT_NEAR(tape.linear, 1206.7, 0.05);
  EXPECT_NEAR(tape.quadratic, 2858.33, 0.005);
}

TEST(Permeability, ThePrintedCanopyColumnIsGamma0p2121AndATenthOfAMillimetre) {
  const ErgunCloth canopy = ergun_cloth({65.98, 37.45});
  EXPECT_NEAR(canopy.porosity, 0.2121, 5e-5);
  EXPECT_NEAR(canopy.thickness, 0.12e-3, 0.002e-3);
  const PressureDrop printed_gamma = ergun({0.22, 0.12e-3});
  EXPECT_GT(37.45 / printed_gamma.quadratic, 1.1);  // the printed 0.22 disagrees with the printed b
}

TEST(Permeability, ErgunAndItsInverseUndoEachOther) {
  for (const ErgunCloth cloth : {ErgunCloth{0.05, 5e-4}, ErgunCloth{0.3, 7.6e-5}, ErgunCloth{0.9, 2e-4}}) {
    const ErgunAir air{1.1, 1.7e-5};
    const ErgunCloth back = ergun_cloth(ergun(cloth, air), air);
    EXPECT_NEAR(back.porosity / cloth.porosity, 1, 1e-12);
    EXPECT_NEAR(back.thickness / cloth.thickness, 1, 1e-12);
  }
}

TEST(Permeability, ThePrintedCanopyAsARealPressureDropLets225CfmThrough) {
  EXPECT_NEAR(cfm({65.98, 37.45}), 225, 1);
}

TEST(Permeability, ThreeCfmAtHalfAnInchOfWaterIsALinearResistanceOf8200) {
  const PermeabilityFit fit = fit_permeability({{124.5, 3 * 5.08e-3}});
  EXPECT_TRUE(fit.one_point);
  EXPECT_NEAR(fit.law.linear, 8.2e3, 40);
  EXPECT_EQ(fit.law.quadratic, 0);
  EXPECT_NEAR(cfm(fit.law), 3, 1e-12);
}

TEST(Permeability, PointsOnALawGiveTheLawBack) {
  const PressureDrop law{420, 900};
  std::vector<FlowPoint> points;
  for (double v : {0.05, 0.1, 0.3, 0.8, 2.0}) points.push_back({pressure_drop(law, v), v});
  const PermeabilityFit fit = fit_permeability(points);
  EXPECT_NEAR(fit.law.linear / law.linear, 1, 1e-10);
  EXPECT_NEAR(fit.law.quadratic / law.quadratic, 1, 1e-10);
  EXPECT_NEAR(fit.r2, 1, 1e-12);
  for (const FlowPoint& p : points) EXPECT_NEAR(velocity_at(law, p.pressure) / p.velocity, 1, 1e-12);
}

TEST(Permeability, ALawThatWouldPushAirUpstreamIsHeldAtZero) {
  // Pressure that grows slower than the velocity: b would be negative.
  const PermeabilityFit fit = fit_permeability({{100, 0.1}, {150, 0.2}, {180, 0.3}});
  EXPECT_TRUE(fit.on_bound);
  EXPECT_GE(fit.law.linear, 0);
  EXPECT_EQ(fit.law.quadratic, 0);
  // And one that grows faster than its square: a would be. Relative errors count.
  const std::vector<FlowPoint> steep = {{10, 0.1}, {60, 0.2}, {180, 0.3}};
  const PermeabilityFit square = fit_permeability(steep);
  EXPECT_TRUE(square.on_bound);
  EXPECT_EQ(square.law.linear, 0);
  const auto error = [&](double quadratic) {
    double sum = 0;
    for (const FlowPoint& p : steep)
      sum += std::pow(pressure_drop({0, quadratic}, p.velocity) / p.pressure - 1, 2);
    return sum;
  };
  EXPECT_LT(error(square.law.quadratic), error(1.001 * square.law.quadratic));
  EXPECT_LT(error(square.law.quadratic), error(0.999 * square.law.quadratic));
}

TEST(Permeability, CfmTypedAsMetresASecondIsCaught) {
  EXPECT_THROW(fit_permeability({{124.5, 225.0}}), Error);
  EXPECT_THROW(fit_permeability({{-124.5, 0.1}}), Error);
  EXPECT_THROW(fit_permeability({}), Error);
  EXPECT_THROW(ergun({1.2, 1e-4}), Error);
  EXPECT_THROW(ergun_cloth({8200, 0}), Error);
}

}  // namespace
}  // namespace ripstop
