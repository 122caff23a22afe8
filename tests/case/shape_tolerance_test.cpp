// The tolerance of the shape belongs to the size of the canopy.
#include <gtest/gtest.h>

#include <numbers>

#include "ripstop/case/case.h"
#include "ripstop/case/settings.h"

namespace ripstop {
namespace {

TEST(ShapeTolerance, IsAThousandthOfTheNominalDiameterUnlessItIsGiven) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml");
  for (const double diameter : {0.05, 1.0, 12.0}) {
    given.parachute.nominal_area_m2 = std::numbers::pi / 4 * diameter * diameter;
    EXPECT_NEAR(resolve(given).coupling().shape_tolerance_m, 1e-3 * diameter, 1e-12) << diameter;
  }
  EXPECT_EQ(resolve(given).source("coupling.shape_tolerance_m").from, "0.1 % of the nominal diameter");
  given.coupling.shape_tolerance_m = 0.02;
  EXPECT_EQ(resolve(given).coupling().shape_tolerance_m, 0.02);
}

}  // namespace
}  // namespace ripstop
