// The shipped examples agree with the paper.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "fixture.h"
#include "ripstop/case/resolve.h"

namespace ripstop {
namespace {

TEST(Example, StratosIvHasThePrintedAreaAndItsDefaultsAreThePapers) {
  const Case given = read_case(examples / "stratos-iv" / "case.toml");
  EXPECT_NEAR(computed_area(given.parachute), 1.7215, 1e-4);  // disk - vent + band
  EXPECT_EQ(nominal_area(given.parachute), computed_area(given.parachute));
  EXPECT_EQ(given.parachute.lines.count, 18);
  EXPECT_EQ(given.parachute.gores, 6);
  EXPECT_NEAR(line_length_on_disk(given.parachute), 0.455, 1e-12);
  EXPECT_EQ(given.measured.size(), 5u);
  EXPECT_EQ(resolve(given).flow().canopy_position_m, 2);
}

TEST(Example, WalrusHasThePrintedNominalAreaAndTheMeasuredDrags) {
  const Case given = read_case(examples / "walrus" / "case.toml");
  EXPECT_NEAR(computed_area(given.parachute), 2.938, 1e-3);
  EXPECT_EQ(nominal_area(given.parachute), 3.37);
  ASSERT_EQ(given.measured.size(), 5u);
  EXPECT_EQ(given.measured.front().drag_n, 73.5);
  EXPECT_EQ(given.measured.back().drag_n, 621);
}

TEST(Example, TheClothReachesItsSpecifiedBreakingLoadAndTheLineAForceOfARealCord) {
  const Case given = read_case(examples / "walrus" / "case.toml");
  const Fabric& cloth = canopy_fabric(given);
  const double e = cloth.tested_strain;
  EXPECT_NEAR(cloth.coefficients_n_m[0] * e + cloth.coefficients_n_m[1] * e * e, cloth.break_load_n_m,
              0.02 * cloth.break_load_n_m);
  const Line& line = suspension_line(given);
  EXPECT_NEAR(line.coefficients_n[0] * 0.04 + line.coefficients_n[1] * 0.04 * 0.04, 9300, 50);
}

TEST(Case, TheBasisDecidesWhichSpeedTheAirHas) {
  Case given = read_case(examples / "stratos-iv" / "case.toml");
  EXPECT_EQ(air(given).speed, 30);
  EXPECT_EQ(air(given).density, 1.2);
  given.flow.speed_basis = SpeedBasis::measured;
  EXPECT_EQ(air(given).speed, 27.1);
  apply({.speed = 15}, given);
  EXPECT_EQ(air(given).speed, 16);
  EXPECT_EQ(air(given).density, 1.196);
  ASSERT_NE(measured_row(given), nullptr);
  EXPECT_EQ(measured_row(given)->drag_n, 100.2);
}

}  // namespace
}  // namespace ripstop
