// The equation of motion of a point mass.
#include "ripstop/flight/point_mass.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ripstop {
namespace {

constexpr PointMass body{3, 9.81};
constexpr double air_density = 1.1;

TEST(PointMass, AtTerminalSpeedItDoesNotAccelerate) {
  constexpr double area = 0.7;
  const double terminal = std::sqrt(2 * body.mass * body.gravity / (air_density * area));
  const InPlane a = acceleration(body, {0, terminal}, air_density, area);
  EXPECT_EQ(a.level, 0);
  EXPECT_NEAR(a.down, 0, 1e-14 * body.gravity);
}

TEST(PointMass, APullRetardsAsADragOfTheSameForce) {
  constexpr InPlane velocity{12, -5};  // 13 m/s
  constexpr double area = 0.4, drag = 0.5 * air_density * 13 * 13 * area;
  const InPlane by_drag = acceleration(body, velocity, air_density, area);
  const InPlane by_pull = acceleration(body, velocity, air_density, 0, drag);
  EXPECT_NEAR(by_pull.level, by_drag.level, 1e-14 * drag);
  EXPECT_NEAR(by_pull.down, by_drag.down, 1e-14 * drag);
  EXPECT_NEAR(by_drag.level, -drag / body.mass * 12 / 13, 1e-14 * drag);
  EXPECT_NEAR(by_drag.down, body.gravity + drag / body.mass * 5 / 13, 1e-14 * drag);
}

TEST(PointMass, AtRestOnlyWeightAccelerates) {
  const InPlane a = acceleration(body, {0, 0}, air_density, 0.4);
  EXPECT_EQ(a.level, 0);
  EXPECT_EQ(a.down, body.gravity);
}

}  // namespace
}  // namespace ripstop
