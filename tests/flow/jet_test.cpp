#include "ripstop/flow/jet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ripstop {
namespace {

const Nozzle nozzles[] = {
    {NozzleShape::circle, 2.85, 0}, {NozzleShape::octagon, 2.85, 0}, {NozzleShape::rectangle, 2.85, 1.9}};

// Summed over fine squares.
double summed(const Nozzle& nozzle, auto value) {
  const int n = 800;
  const double h = 1.5 * nozzle.width / n;
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) sum += h * h * value((i + 0.5 - n / 2.0) * h, (j + 0.5 - n / 2.0) * h);
  return sum;
}

TEST(Jet, TheAreaOfANozzleIsWhereItsDepthIsPositive) {
  for (const Nozzle& nozzle : nozzles) {
    const double inside = summed(nozzle, [&](double x, double y) { return depth_inside(nozzle, x, y) > 0; });
    EXPECT_NEAR(inside / nozzle_area(nozzle), 1, 5e-3);  // half a square along the outline
    EXPECT_NEAR(std::numbers::pi / 4 * std::pow(equivalent_diameter(nozzle), 2), nozzle_area(nozzle), 1e-12);
  }
  EXPECT_NEAR(nozzle_area(nozzles[1]), 6.73, 0.01);  // the Open Jet Facility's
}

TEST(Jet, AThickerEdgeKeepsTheAirThatPasses) {
  for (const Nozzle& nozzle : nozzles) {
    const Jet jet{nozzle, 0, 0.2};
    const double passes = summed(nozzle, [&](double x, double y) { return speed_share(jet, x, y); });
    EXPECT_NEAR(passes / nozzle_area(nozzle), 1, 0.01);
  }
}

TEST(Jet, TheShearLayerIsAsThickAsTheDifferenceOverTheSlope) {
  const Jet jet{nozzles[0], 0.1, 0.2};
  const double lip = 2.85 / 2, h = 1e-4;
  const double slope = (speed_share(jet, lip - h, 0) - speed_share(jet, lip + h, 0)) / (2 * h);
  EXPECT_NEAR((1 - 0.1) / slope, 0.2, 1e-5);
  EXPECT_NEAR(speed_share(jet, 0, 0), 1, 1e-9);
  EXPECT_NEAR(speed_share(jet, 3, 0), 0.1, 1e-9);
}

TEST(Jet, ACellAdmitsTheMeanOverItsFace) {
  const Jet jet{nozzles[1], 0.02, 1e-6};
  const int n = 11;  // cells across a little more than the nozzle
  const double h = 4.0 / n;
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      sum += h * h * mean_speed_share(jet, i * h - 2, (i + 1) * h - 2, j * h - 2, (j + 1) * h - 2);
  const double area = nozzle_area(jet.nozzle);
  EXPECT_NEAR(sum, area + 0.02 * (16 - area), 0.02 * area);
}

}  // namespace
}  // namespace ripstop
