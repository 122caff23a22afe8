// Keys as people read them.
#include "ripstop/core/words.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace ripstop {
namespace {

TEST(Words, AKeyBecomesWordsAndAUnit) {
  EXPECT_EQ(in_words("flow.speed_m_s").with_unit(), "speed [m/s]");
  EXPECT_EQ(in_words("parachute.vent_diameter_m").with_unit(), "vent diameter [m]");
  EXPECT_EQ(in_words("density_kg_m3").with_unit(), "density [kg/m³]");
  EXPECT_EQ(in_words("max_line_tension_n").with_unit(), "maximum line tension [N]");
  EXPECT_EQ(in_words("damping_n_s_m3").with_unit(), "damping [N s/m³]");
  EXPECT_EQ(in_words("pressure_drop_linear_pa_s_m").with_unit(), "pressure drop linear [Pa s/m]");
  EXPECT_EQ(in_words("pressure_drop_quadratic_pa_s2_m2").unit, "Pa s²/m²");
  EXPECT_EQ(in_words("materials.f-111.darcy_1_m2").with_unit(), "darcy [1/m²]");
  EXPECT_EQ(in_words("forchheimer_1_m").unit, "1/m");
  EXPECT_EQ(in_words("coupling_iterations").with_unit(), "coupling iterations");
}

TEST(Words, AnUncertaintyAndASourceNameTheirQuantity) {
  EXPECT_EQ(in_words("rate_of_descent_standard_error_m_s").with_unit(),
            "standard error of the rate of descent [m/s]");
  EXPECT_EQ(in_words("drag_area_uncertainty_m2").with_unit(), "uncertainty of the drag area [m²]");
  EXPECT_EQ(in_words("drag_coefficient_from").with_unit(), "source of the drag coefficient");
  EXPECT_EQ(in_words("from").text, "from");
}

TEST(Words, AMomentIsNoForcePerWidth) {
  EXPECT_EQ(in_words("axial_moment_n_m").unit, "N m");
  EXPECT_EQ(in_words("moment_n_m").unit, "N m");
  EXPECT_EQ(in_words("spreading_moment_n_m").unit, "N m");
  EXPECT_EQ(in_words("max_von_mises_n_m").unit, "N/m");
}

TEST(Words, AnEndingIsAUnitOnlyBehindAName) {
  EXPECT_EQ(in_words("n").with_unit(), "n");
  EXPECT_EQ(in_words("_s").unit, "");
}

TEST(Words, AKeyAndItsValueAreAPhrase) {
  EXPECT_EQ(in_words("coupling.linear", "true"), "linear cloth");
  EXPECT_EQ(in_words("coupling.linear", "false"), "nonlinear cloth");
  EXPECT_EQ(in_words("parachute.vent_diameter_m", "0.09"), "vent diameter 0.09 m");
  EXPECT_EQ(in_words("parachute.tape.inner_hems", "false"), "no inner hems");
}

TEST(Words, ValuesThatDifferNeverLookEqualInAComparison) {
  using Texts = std::pair<std::string, std::string>;
  EXPECT_EQ(rounded_apart(9.97, 10, 2), Texts("9.97", "10"));
  EXPECT_EQ(rounded_apart(25.68, 25.66), Texts("25.68", "25.66"));
  EXPECT_EQ(rounded_apart(7.4, 10, 2), Texts("7.4", "10"));
  EXPECT_EQ(rounded_apart(0.8 + 1e-9, 0.8).second, "0.8");
  EXPECT_NE(rounded_apart(0.8 + 1e-9, 0.8).first, "0.8");
  EXPECT_EQ(rounded_apart(5, 5), Texts("5", "5"));
  EXPECT_NE(rounded_apart(1, std::nextafter(1, 2)).first, rounded_apart(1, std::nextafter(1, 2)).second);
}

TEST(Words, ARoundedNumberHasNoExponentBelow1e15) {
  EXPECT_EQ(rounded(10676.3), "10680");
  EXPECT_EQ(rounded(-10676.3, 3), "-10700");
  EXPECT_EQ(rounded(9999.96), "10000");
  EXPECT_EQ(rounded(0), "0");
  EXPECT_EQ(rounded(6672.3, 3), "6670");
  EXPECT_EQ(rounded(19.3), "19.3");
  EXPECT_EQ(rounded(3e-7), "3e-07");
  EXPECT_EQ(rounded(2.5e15), "2.5e+15");
  EXPECT_EQ(rounded(HUGE_VAL), "inf");
}

}  // namespace
}  // namespace ripstop
