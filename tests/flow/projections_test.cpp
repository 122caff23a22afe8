// Drag, lift, tangential and normal force, and their signs.
#include "ripstop/flow/projections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ripstop {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(Projections, OnTheAxisTheTangentialForceIsTheDrag) {
  const Attitude attitude{{0, 0, 1}, {0, 0, 20}};
  const ForceComponents f = components({3, 4, 50}, attitude);
  EXPECT_DOUBLE_EQ(f.drag, 50);
  EXPECT_DOUBLE_EQ(f.tangential, 50);
  EXPECT_DOUBLE_EQ(f.normal, 3);
  EXPECT_EQ(angle_of_attack(attitude), 0);
}

// C_T = C_D cos a + C_L sin a, C_N = C_D sin a - C_L cos a.
TEST(Projections, TangentialAndNormalForceFollowFromDragAndLift) {
  for (const double angle : {5.0, 20.0, 70.0, 120.0}) {
    for (const double azimuth : {0.0, 45.0, 200.0}) {
      const Vec3 axis{0, 0, 1}, wind = 7 * wind_direction(angle, azimuth);
      EXPECT_NEAR(angle_of_attack({axis, wind}), angle, 1e-9);
      const ForceComponents f = components({1.5, -2, 8}, {axis, wind});
      const double c = std::cos(angle * degree), s = std::sin(angle * degree);
      EXPECT_NEAR(f.tangential, f.drag * c + f.lift * s, 1e-12);
      EXPECT_NEAR(f.normal, f.drag * s - f.lift * c, 1e-12);
      EXPECT_NEAR(f.drag * f.drag + f.lift * f.lift + f.side * f.side, 1.5 * 1.5 + 4 + 64, 1e-12);
    }
  }
}

// A canopy's axis leans by a small turn about its confluence; the wind stays.
TEST(Projections, ANormalForceReducesTheAngleOfAttackAndAPositiveMomentIncreasesIt) {
  const Vec3 wind = 10 * wind_direction(20, 30), axis{0, 0, 1};
  const Vec3 normal = normal_direction({axis, wind});
  EXPECT_LT(angle_of_attack({axis + 0.01 * normal, wind}), 20);
  const double force = 5, arm = 2;  // along the normal, at a point on the axis
  const BodyLoad load{force * normal, cross(arm * axis, force * normal)};
  const Coefficients c = coefficients(load, {axis, wind}, {1.2, 3, 1.5});
  const double unit = 0.5 * 1.2 * 100 * 3;
  EXPECT_NEAR(c.normal, force / unit, 1e-12);
  EXPECT_NEAR(c.moment, -arm * force / (unit * 1.5), 1e-12);
  const Vec3 turned = axis + 0.01 * cross(-load.moment, axis);  // by a moment of the other sign
  EXPECT_GT(angle_of_attack({turned, wind}), 20);
}

TEST(Projections, ATurnTakesZToTheAxisAndKeepsLengthsAndHandedness) {
  for (const Vec3 axis :
       {wind_direction(0), wind_direction(33, 70), wind_direction(90, 45), Vec3{0, 0, -1}}) {
    const Vec3 x = turned({1, 0, 0}, axis), y = turned({0, 1, 0}, axis), z = turned({0, 0, 1}, axis);
    EXPECT_NEAR(norm(z - axis), 0, 1e-15);
    EXPECT_NEAR(norm(cross(x, y) - z), 0, 1e-15);
    EXPECT_NEAR(dot(x, y), 0, 1e-15);
  }
}

TEST(Projections, TheWindOfAnAngleLiesInThePlaneOfItsAzimuth) {
  EXPECT_EQ(wind_direction(0, 77), (Vec3{0, 0, 1}));
  const Vec3 wind = wind_direction(90, 30);
  EXPECT_NEAR(wind.x, std::sqrt(3) / 2, 1e-15);
  EXPECT_NEAR(wind.y, 0.5, 1e-15);
  EXPECT_NEAR(wind.z, 0, 1e-15);
}

}  // namespace
}  // namespace ripstop
