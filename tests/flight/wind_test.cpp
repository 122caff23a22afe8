// Wind over height and time.
#include "ripstop/flight/wind.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ripstop {
namespace {

TEST(Wind, UniformWindBlowsInItsDirectionAtAllHeights) {
  Wind wind;
  wind.speed_m_s = 5, wind.direction_deg = 90;
  for (const double height : {-3.0, 0.0, 200.0}) {
    const Vec3 v = wind_velocity(wind, height, 1);
    EXPECT_NEAR(v.x, 0, 1e-12);
    EXPECT_NEAR(v.y, 5, 1e-12);
    EXPECT_EQ(v.z, 0);
  }
}

TEST(Wind, PowerLawHasItsSpeedAtTheReferenceHeight) {
  Wind wind;
  wind.speed_m_s = 4, wind.exponent = 0.25, wind.reference_height_m = 10;
  EXPECT_NEAR(wind_velocity(wind, 10, 0).x, 4, 1e-12);
  EXPECT_NEAR(wind_velocity(wind, 160, 0).x, 8, 1e-12);
  EXPECT_EQ(wind_velocity(wind, -1, 0).x, 0) << "below the ground as at it";
}

TEST(Wind, GustRisesAndFallsOnceWithItsMeanHalfItsPeak) {
  Wind wind;
  wind.gust_m_s = 6, wind.gust_start_s = 2, wind.gust_duration_s = 3;
  EXPECT_EQ(wind_velocity(wind, 0, 2).x, 0);
  EXPECT_NEAR(wind_velocity(wind, 0, 3.5).x, 6, 1e-12);
  EXPECT_EQ(wind_velocity(wind, 0, 5).x, 0);
  double mean = 0;
  for (int n = 0; n < 300; ++n) mean += wind_velocity(wind, 0, 2 + 0.01 * (n + 0.5)).x / 300;
  EXPECT_NEAR(mean, 3, 1e-6);
}

}  // namespace
}  // namespace ripstop
