#include "ripstop/flight/descent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

constexpr double foot = 0.3048, pound = 0.45359237;

// The T-10 personnel parachute carries 360 lb and comes down at 19 to 23 ft/s
// (www.globalsecurity.org/military/systems/aircraft/systems/t-10.htm). Its drag area is 725.58 ft2 in the input that
// Ludtke's program is tried with (its transcription to C, read in a public repository), 0.754 of the 962.1 ft2 of a
// nominal diameter of 35 ft; Knacke has 0.78 to 0.87 for the type (NWC TP 6575, Table 5-1, page 5-3, as
// github.com/nrdptel/hpr-sim carries it).
TEST(Descent, APersonnelParachuteFallsAsItIsKnownTo) {
  const double area = std::numbers::pi / 4 * 35 * 35;
  EXPECT_NEAR(area, 962.1, 0.05);
  for (const double drag_area : {725.58, 0.78 * area, 0.87 * area}) {
    const double speed = terminal_speed(360 * pound, drag_area * foot * foot, standard_air(0).density) / foot;
    EXPECT_GE(speed, 19) << drag_area;
    EXPECT_LE(speed, 23) << drag_area;
  }
}

// The maker's calculator has 13.70 ft/s for 8.57 kg under the IFC-084-S, 84 inches and C_D = 2.2 on the open canopy's
// circle (Fruity Chutes, as the users of another program report it): half of the last digits of mass and speed.
TEST(Descent, AModelRocketsParachuteAgreesWithItsMakersCalculator) {
  const double area = std::numbers::pi / 4 * std::pow(84 * foot / 12, 2);
  const double speed = terminal_speed(8.57, 2.2 * area, 1.225) / foot;
  EXPECT_NEAR(speed, 13.70, 0.005 + 0.5 * 13.70 * 0.005 / 8.57);
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
