// Numbers with units as people type them. Factors are those of NIST SP 811.
#include "ripstop/core/quantity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace ripstop {
namespace {

struct Row {
  const char* text;
  const char* unit;
  double value;
};

TEST(TypedNumber, IsConvertedToTheUnitThatIsWanted) {
  constexpr std::array rows{Row{"5 lb", "kg", 2.26796185},
                            Row{"5lb", "kg", 2.26796185},
                            Row{"72 in", "m", 1.8288},
                            Row{"1.2 oz/yd^2", "kg/m2", 1.2 * 0.028349523125 / (0.9144 * 0.9144)},
                            Row{"1.2 oz/yd²", "kg/m2", 1.2 * 0.028349523125 / (0.9144 * 0.9144)},
                            Row{"20 ft/s", "m/s", 6.096},
                            Row{"-40 degF", "K", 233.15},
                            Row{"20 °C", "K", 293.15},
                            Row{"400 lbf", "N", 1779.28864610},
                            Row{"400 lb", "N", 1779.28864610},
                            Row{"25 lb/in", "N/m", 25 * 4.4482216152605 / 0.0254},
                            Row{"350 g", "kg", 0.35},
                            Row{"9 g", "m/s2", 88.25985},
                            Row{"2 ft2", "m2", 0.18580608},
                            Row{"1000 ft", "m", 304.8},
                            Row{"30 g/m", "kg/m", 0.03},
                            Row{"0.02 slug", "", 0},
                            Row{"0.0765 lb/ft3", "kg/m3", 0.0765 * 0.45359237 / std::pow(0.3048, 3)},
                            Row{"0.018 mPa s", "Pa s", 1.8e-5},
                            Row{"1 Mg", "kg", 1000},
                            Row{"+3", "m", 3},
                            Row{"2.5e-1 m", "m", 0.25},
                            Row{"100 cfm", "cfm", 100},
                            Row{"0.508 m/s", "cfm", 100},
                            Row{"90 rad", "deg", 90 * 57.29577951308232},
                            Row{"5 %", "", 0.05},
                            Row{"1 kHz", "Hz", 1000}};
  int refused = 0;
  for (const Row& row : rows) {
    const TypedNumber read = read_typed(row.text, row.unit);
    if (row.value == 0) {
      EXPECT_NE(read.refusal, "") << row.text;
      ++refused;
    } else {
      EXPECT_EQ(read.refusal, "") << row.text;
      EXPECT_NEAR(read.value, row.value, 1e-9 * std::abs(row.value)) << row.text;
    }
  }
  EXPECT_EQ(refused, 1);  // the slug is not on the list
}

TEST(TypedNumber, OfAnotherQuantityIsRefused) {
  EXPECT_EQ(read_typed("5 lb", "m").refusal, "a number, or one with a unit that can be converted to m");
  EXPECT_EQ(read_typed("5 m", "").refusal, "a number without a unit, or a percentage");
  EXPECT_EQ(read_typed("5 m", "K").refusal, "a number, or a temperature in K, degC or degF");
  for (const char* text :
       {"5 lb/in2 s", "5 %", "5 m2", "5 m m", "5 m-1", "5 m^2^2", "1,5 m", "5 m 3", "5 kg/s m"})
    EXPECT_NE(read_typed(text, "m").refusal, "") << text;
}

TEST(TypedNumber, IsANumberFirst) {
  for (const char* text : {"", " ", "lb", "m 5", "+-5 m", "--5", "0x10 m", ".", "five m"})
    EXPECT_NE(read_typed(text, "m").refusal, "") << text;
  for (const char* text : {"inf m", "nan", "1e999 m", "-infinity"})
    EXPECT_EQ(read_typed(text, "m").refusal, "a finite number") << text;
}

TEST(UnitOfKey, IsTheEndOfItsName) {
  EXPECT_EQ(unit_of_key("payload.mass_kg"), "kg");
  EXPECT_EQ(unit_of_key("flow.box_m[2]"), "m");
  EXPECT_EQ(unit_of_key("areal_density_kg_m2"), "kg/m2");
  EXPECT_EQ(unit_of_key("linear_density_kg_m"), "kg/m");
  EXPECT_EQ(unit_of_key("pressure_drop_quadratic_pa_s2_m2"), "Pa s2/m2");
  EXPECT_EQ(unit_of_key("viscosity_pa_s"), "Pa s");
  EXPECT_EQ(unit_of_key("coefficients_n_m[3]"), "N/m");
  EXPECT_EQ(unit_of_key("temperature_k"), "K");
  EXPECT_EQ(unit_of_key("ejection_impulse_n_s"), "N s");
  EXPECT_EQ(unit_of_key("swing_deg_s"), "deg/s");
  EXPECT_EQ(unit_of_key("outside_speed"), "");
  EXPECT_EQ(unit_of_key("cloth_nodes"), "");
}

// Each unit of a key is one that its own numbers can have.
TEST(UnitOfKey, IsReadAsItself) {
  for (const char* key : {"a_pa_s2_m2", "a_n_s2_m4", "a_pa_s_m", "a_n_s_m3", "a_n_s_m", "a_kg_m3", "a_kg_m2",
                          "a_kg_m",     "a_pa_s",    "a_1_m2",   "a_1_m",    "a_m_s2",  "a_m_s",   "a_n_m",
                          "a_cfm",      "a_deg",     "a_m2",     "a_hz",     "a_kg",    "a_pa",    "a_m",
                          "a_n",        "a_s",       "a_k",      "a_n_s",    "a_deg_s", "a_per_s"}) {
    const std::string unit = unit_of_key(key);
    const TypedNumber read = read_typed("3.5 " + unit, unit);
    EXPECT_EQ(read.refusal, "") << key;
    EXPECT_DOUBLE_EQ(read.value, 3.5) << key;
  }
}

}  // namespace
}  // namespace ripstop
