#include "ripstop/flight/descent.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"

namespace ripstop {
namespace {

TEST(Descent, AtTheTerminalSpeedDragIsWeight) {
  const double mass = 4, area = 2.2, density = 1.1;
  const double v = terminal_speed(mass, area, density);
  EXPECT_NEAR(0.5 * density * v * v * area, mass * standard_gravity, 1e-12);
  EXPECT_NEAR(drag_area_for(mass, v, density), area, 1e-12);
}

// The T-10 personnel parachute: 35 ft nominal, a flat area of 962 ft2; 250 lb all up fall at about 19 to 20 ft/s with
// the C_D of about 0.7 to 0.8 that the handbooks give the type.
TEST(Descent, APersonnelParachuteFallsAsItIsKnownTo) {
  const double area = 962 * 0.3048 * 0.3048, mass = 250 * 0.45359237;
  const double fast = terminal_speed(mass, 0.7 * area, 1.225) / 0.3048;
  const double slow = terminal_speed(mass, 0.8 * area, 1.225) / 0.3048;
  EXPECT_LT(slow, 17.6);
  EXPECT_NEAR(fast, 17.67, 0.1);
}

// In the isothermal layer rho = rho_0 exp(-z / H) with H = R T / g and z the geopotential height, and the integral of
// dz sqrt(rho) has a closed form.
TEST(Descent, InTheIsothermalLayerTheTimeIsTheClosedForm) {
  const double mass = 10, area = 5, from = 19000, to = 12000;
  const StandardAir low = standard_air(to);
  const double scale = low.pressure / (low.density * standard_gravity);  // H
  const double rise = geopotential_height(from) - geopotential_height(to);
  const double closed =
      2 * scale * (1 - std::exp(-rise / (2 * scale))) / terminal_speed(mass, area, low.density);
  // dh / dz = ((r + h) / r)^2: 0.4 % over these heights, with half a percent of it between the ends
  const double stretch = std::pow(1 + 0.5 * (from + to) / 6356766, 2);
  EXPECT_NEAR(descent_time(mass, area, from, to) / (closed * stretch), 1, 2e-4);
}

TEST(Descent, TheTimeAddsUpOverItsParts) {
  const double all = descent_time(3, 1.5, 11500, 0);
  EXPECT_NEAR(descent_time(3, 1.5, 11500, 4321) + descent_time(3, 1.5, 4321, 0), all, 1e-6 * all);
}

TEST(Descent, WithFourTimesTheMassItTakesHalfTheTime) {
  EXPECT_NEAR(descent_time(1, 2, 3000, 0), 2 * descent_time(4, 2, 3000, 0), 1e-9);
}

TEST(Descent, UpwardsIsRefused) {
  EXPECT_THROW(descent_time(1, 1, 100, 100), Error);
  EXPECT_THROW(descent_time(1, 1, 100, 200), Error);
  EXPECT_THROW(descent_time(1, 1, 90000, 0), Error);
}

}  // namespace
}  // namespace ripstop
