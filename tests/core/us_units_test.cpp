// Values in printed text get their US customary value; other text is unchanged.
#include "ripstop/core/us_units.h"

#include <gtest/gtest.h>

namespace ripstop {
namespace {

TEST(UsUnits, FollowEveryValueWithAUnit) {
  EXPECT_EQ(with_us_units("drag 218.1 N at 20 m/s"), "drag 218.1 N (49.03 lbf) at 20 m/s (65.6 ft/s)");
  EXPECT_EQ(with_us_units("22 kg, 1.5 m2, 304.8 m"), "22 kg (48.5 lb), 1.5 m2 (16.1 ft2), 304.8 m (1000 ft)");
  EXPECT_EQ(with_us_units("75 J, 0.0254 m, 100 Pa"),
            "75 J (55.3 ft lbf), 0.0254 m (1 in), 100 Pa (0.0145 psi)");
  EXPECT_EQ(with_us_units("10.8 mm, 50 to 100 mm"), "10.8 mm (0.425 in), 50 to 100 mm (1.97 to 3.94 in)");
}

TEST(UsUnits, AHeightOfZeroIsInFeet) {
  EXPECT_EQ(with_us_units("0 m"), "0 m (0 ft)");
}

TEST(UsUnits, HaveNoExponentWhereTheValueHasNone) {
  EXPECT_EQ(with_us_units("apogee 3048 m, 12 m3"), "apogee 3048 m (10000 ft), 12 m3 (732000 in3)");
}

TEST(UsUnits, ConvertBothEndsOfARangeAndAnUncertainty) {
  EXPECT_EQ(with_us_units("10 to 20 m/s"), "10 to 20 m/s (32.8 to 65.6 ft/s)");
  EXPECT_EQ(with_us_units("7.8 to 8.624 m/s"), "7.8 to 8.624 m/s (25.59 to 28.29 ft/s)");
  EXPECT_EQ(with_us_units("1234 +- 0.01 N"), "1234 +- 0.01 N (277.4 +- 0.002 lbf)");
  EXPECT_EQ(with_us_units("1.000 +- 0.010 m"), "1.000 +- 0.010 m (3.281 +- 0.033 ft)");
}

TEST(UsUnits, LeaveOtherTextUnchanged) {
  for (const char* text : {"12 gores", "C_D 0.75 on S0", "runs/m-3 m2x", "flow.cells = [3, 3]", "after 3.5 s",
                           "", "-", "2.", "20 metres", "x2 m"})
    EXPECT_EQ(with_us_units(text), text);
}

}  // namespace
}  // namespace ripstop
