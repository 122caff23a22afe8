#include "ripstop/flight/opening_load.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

OpeningConditions conditions(double mass) {
  return {mass, 40, 1.2, 10, 0.8, 2, 1.7, 0};
}

/// The largest of tau^j (v/v_s)^2 by small steps of m dv/dt = -D, independent of the closed form.
double stepped_factor(double a, double j, double largest) {
  const double end = std::pow(largest, 1 / j), d = 1e-5;
  double speed = 1, most = 0;
  for (double tau = 0; tau < end; tau += d) {
    const double half = speed - d / 2 * std::pow(tau, j) * speed * speed / a;
    speed -= d * std::pow(tau + d / 2, j) * half * half / a;
    most = std::max(most, std::pow(tau + d, j) * speed * speed);
  }
  return most;
}

TEST(OpeningLoad, TheForceFactorSolvesTheEquationOfMotion) {
  for (const double a : {0.02, 0.19, 0.7, 3.0, 40.0})
    for (const double j : {0.5, 1.0, 2.0, 6.0})
      for (const double largest : {1.0, 1.7})
        EXPECT_NEAR(force_factor(a, j, largest).factor / stepped_factor(a, j, largest), 1, 2e-3)
            << a << " " << j << " " << largest;
}

// Ludtke, NOLTR 72-146, for solid cloth (j = 6): x = 16/49 (21 M / 4)^(6/7), up to
// M = 4/21, where the canopy is just open.
TEST(OpeningLoad, OfSolidClothIsLudtkesClosedForm) {
  for (const double m : {0.01, 0.05, 0.15}) {
    const ForceFactor x = force_factor(m, 6);
    EXPECT_NEAR(x.factor, 16.0 / 49 * std::pow(21 * m / 4, 6.0 / 7), 1e-12);
    EXPECT_LT(x.time, 1);
  }
  EXPECT_NEAR(force_factor(4.0 / 21, 6).time, 1, 1e-12);
}

// Knacke, NWC TP 6575, Fig. 5-51: X_1 over A for n = 1, 2 and 1/2. The points were read off the figure by others
// (github.com/AjoAceite777/Parachute-Opening-Shock); the print itself was not seen. The curves of the figure lie up to
// 0.05 above the closed form where A is 1 and more.
TEST(OpeningLoad, PflanzFactorIsThatOfTheHandbooksFigureAsItWasReadOff) {
  struct Point {
    double n, a, x;
  };
  const Point points[] = {
      {1, 0.00987, 0.0442},  {1, 0.0520, 0.1053},   {1, 0.1252, 0.1666},    {1, 0.2993, 0.2604},
      {1, 0.6915, 0.4019},   {1, 3.709, 0.7814},    {1, 7.228, 0.8881},     {2, 0.01896, 0.0348},
      {2, 0.0503, 0.0719},   {2, 0.1149, 0.1331},   {2, 0.2331, 0.2270},    {2, 0.4291, 0.3580},
      {2, 1.0993, 0.6241},   {2, 3.711, 0.8744},    {0.5, 0.00998, 0.0947}, {0.5, 0.0939, 0.2125},
      {0.5, 0.3151, 0.3260}, {0.5, 0.6458, 0.4159}, {0.5, 1.798, 0.6030},   {0.5, 10.06, 0.9220}};
  for (const Point& p : points)
    EXPECT_NEAR(force_factor(p.a, p.n).factor, p.x, p.a < 0.3 ? 0.01 : 0.05) << p.n << " " << p.a;
}

TEST(OpeningLoad, AtInfiniteMassEveryMethodGivesTheOpeningCoefficient) {
  const OpeningConditions c = conditions(1e9);
  const double expected = 1.7 * steady_force(c);
  EXPECT_DOUBLE_EQ(infinite_mass_load(c).load, expected);
  EXPECT_NEAR(pflanz_load(c).load / expected, 1, 1e-6);
  EXPECT_NEAR(ludtke_load(c).load / expected, 1, 1e-6);
  EXPECT_NEAR(momentum_impulse_load(c).load.load / expected, 1, 1e-6);
}

TEST(OpeningLoad, WithoutMassThereIsNone) {
  const OpeningConditions c = conditions(1e-9);
  const double scale = infinite_mass_load(c).load;
  EXPECT_LT(pflanz_load(c).load / scale, 1e-5);
  EXPECT_LT(ludtke_load(c).load / scale, 1e-5);
  EXPECT_LT(momentum_impulse_load(c).load.load / scale, 1e-5);
}

TEST(OpeningLoad, RisesWithTheMassTowardsItsLimit) {
  double pflanz = 0, ludtke = 0, momentum = 0;
  for (double mass = 0.1; mass < 1e6; mass *= 1.5) {
    const OpeningConditions c = conditions(mass);
    EXPECT_GT(pflanz_load(c).load, pflanz);
    EXPECT_GT(ludtke_load(c).load, ludtke);
    EXPECT_GT(momentum_impulse_load(c).load.load, momentum);
    pflanz = pflanz_load(c).load, ludtke = ludtke_load(c).load, momentum = momentum_impulse_load(c).load.load;
    EXPECT_LT(std::max({pflanz, ludtke, momentum}), infinite_mass_load(c).load);
  }
}

TEST(OpeningLoad, MomentumImpulseKeepsMomentum) {
  for (const double mass : {0.5, 5.0, 500.0})
    for (const double angle : {0.0, 45.0, 90.0}) {
      OpeningConditions c = conditions(mass);
      c.path_angle = angle;
      const MomentumImpulse m = momentum_impulse_load(c, 0.4);
      const double gravity = mass * 9.80665 * std::sin(angle * M_PI / 180) * c.filling_time;
      EXPECT_NEAR(m.load.load * 0.4 * c.filling_time, mass * c.speed * (1 - m.speed_ratio) + gravity,
                  1e-9 * mass * c.speed);
    }
}

TEST(OpeningLoad, QuantitiesThatAreNotAboveZeroAreRefusedByName) {
  OpeningConditions c = conditions(-2);
  try {
    pflanz_load(c);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("mass (kg) of -2"), std::string::npos) << error.what();
  }
  c = conditions(2);
  c.speed = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ludtke_load(c), Error);
  EXPECT_THROW(momentum_impulse_load(conditions(1), 0), Error);
}

}  // namespace
}  // namespace ripstop
