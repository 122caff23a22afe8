#include "ripstop/flight/atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

// U.S. Standard Atmosphere, 1976, Table I (geometric height): temperature, pressure, density as printed.
TEST(Atmosphere, HasTheValuesOfTheStandardsTables) {
  struct Row {
    double height, temperature, pressure, density;
  };
  const Row rows[] = {{0, 288.150, 101325, 1.2250},          {1000, 281.651, 8.9876e4, 1.1117},
                      {5000, 255.676, 5.4048e4, 0.73643},    {10000, 223.252, 2.6499e4, 0.41351},
                      {15000, 216.650, 1.2112e4, 0.19476},   {20000, 216.650, 5.5293e3, 0.088910},
                      {25000, 221.552, 2.5492e3, 0.040084},  {30000, 226.509, 1.1970e3, 0.018410},
                      {40000, 250.350, 2.8714e2, 3.9957e-3}, {50000, 270.650, 7.9779e1, 1.0269e-3},
                      {60000, 247.021, 2.1958e1, 3.0968e-4}, {70000, 219.585, 5.2209, 8.2829e-5}};
  for (const Row& row : rows) {
    const StandardAir air = standard_air(row.height);
    EXPECT_NEAR(air.temperature, row.temperature, 1e-3) << row.height;
    EXPECT_NEAR(air.pressure / row.pressure, 1, 5e-5) << row.height;
    EXPECT_NEAR(air.density / row.density, 1, 6e-5) << row.height;
  }
}

TEST(Atmosphere, HasViscosityAndSpeedOfSoundOfTheStandardsTables) {
  EXPECT_NEAR(standard_air(0).viscosity, 1.7894e-5, 1e-9);
  EXPECT_NEAR(standard_air(5000).viscosity, 1.6282e-5, 1e-9);
  EXPECT_NEAR(standard_air(20000).viscosity, 1.4216e-5, 1e-9);
  EXPECT_NEAR(standard_air(0).sound_speed, 340.294, 1e-3);
  EXPECT_NEAR(standard_air(5000).sound_speed, 320.545, 1e-3);
  EXPECT_NEAR(standard_air(15000).sound_speed, 295.069, 1e-3);
}

// dp/dh = -rho g at the geopotential height: the layers join, and pressure and density belong together.
TEST(Atmosphere, CarriesItsOwnWeightEverywhere) {
  for (double height = lowest_height + 10; height < highest_height - 10; height += 487) {
    const double d = 1;
    const double slope = (standard_air(height + d).pressure - standard_air(height - d).pressure) /
                         (geopotential_height(height + d) - geopotential_height(height - d));
    EXPECT_NEAR(-slope / (standard_air(height).density * standard_gravity), 1, 2e-6) << height;
  }
}

TEST(Atmosphere, AHeightThatTheStandardHasNotIsRefused) {
  for (const double height : {-2001.0, 80001.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(standard_air(height), Error) << height;
}

}  // namespace
}  // namespace ripstop
