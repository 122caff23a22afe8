#include "ripstop/flight/atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

/// Half of the last digit of a number with five of them.
double half_of_the_fifth_digit(double value) {
  return 0.5 * std::pow(10, std::floor(std::log10(value)) - 4);
}

// U.S. Standard Atmosphere, 1976, at geometric heights: temperature, pressure and density of
// www.pdas.com/bigtables.html, rounded to five digits there (read as the row of it that another program carries; the
// sea level's 101,325 Pa is between two of its numbers). The government's print has the pressure of 10, 15 and 60 km
// one lower in the fifth digit, 2.6499e4, 1.2111e4 and 2.1958e1: its equations give 26,499.90, 12,111.83 and
// 21.95867.
TEST(Atmosphere, HasTheValuesOfTheStandardsTables) {
  struct Row {
    double height, temperature, pressure, density;
  };
  const Row rows[] = {{5000, 255.676, 5.4048e4, 7.3643e-1},  {10000, 223.252, 2.6500e4, 4.1351e-1},
                      {15000, 216.650, 1.2112e4, 1.9476e-1}, {20000, 216.650, 5.5293e3, 8.8910e-2},
                      {25000, 221.552, 2.5492e3, 4.0084e-2}, {30000, 226.509, 1.1970e3, 1.8410e-2},
                      {35000, 236.513, 5.7459e2, 8.4634e-3}, {40000, 250.350, 2.8714e2, 3.9957e-3},
                      {45000, 264.164, 1.4910e2, 1.9663e-3}, {50000, 270.650, 7.9779e1, 1.0269e-3},
                      {55000, 260.771, 4.2525e1, 5.6810e-4}, {60000, 247.021, 2.1959e1, 3.0968e-4},
                      {65000, 233.292, 1.0930e1, 1.6321e-4}, {70000, 219.585, 5.2209, 8.2829e-5},
                      {75000, 208.399, 2.3881, 3.9921e-5},   {80000, 198.639, 1.0525, 1.8458e-5}};
  for (const Row& row : rows) {
    const StandardAir air = standard_air(row.height);
    EXPECT_NEAR(air.temperature, row.temperature, 0.5e-3) << row.height;
    EXPECT_NEAR(air.pressure, row.pressure, half_of_the_fifth_digit(row.pressure)) << row.height;
    EXPECT_NEAR(air.density, row.density, half_of_the_fifth_digit(row.density)) << row.height;
  }
  EXPECT_EQ(standard_air(0).temperature, 288.15);
  EXPECT_EQ(standard_air(0).pressure, 101325);
  EXPECT_NEAR(standard_air(0).density, 1.2250, 0.5e-4);
}

// The equations of the standard for one height, by hand:
TEST(Atmosphere, AtFifteenKilometresIsTheEquationsOwnValue) {
  const double r = 6356766, rise = r * 15000 / (r + 15000) - 11000;
  EXPECT_NEAR(rise, 3964.688, 0.5e-3);
  const double per_metre = 9.80665 * 28.9644 / 8314.32;  // g / R
  const double tropopause = 101325 * std::pow(216.65 / 288.15, per_metre / 0.0065);
  const StandardAir air = standard_air(15000);
  EXPECT_NEAR(air.pressure, tropopause * std::exp(-per_metre * rise / 216.65), 1e-6);
  EXPECT_NEAR(air.pressure, 12111.83, 0.5e-2);
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
