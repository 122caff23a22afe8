// height_m in place of density and temperature, a payload in place of the speed, and the factors of the margins.
#include "fixture.h"
#include "ripstop/case/payload.h"
#include "ripstop/flight/atmosphere.h"

namespace ripstop {
namespace {

std::string with_flow(const std::string& keys) {
  return replaced(valid_case, "speed_m_s = 20\nbox", keys + "\nbox");
}

TEST(FlightKeys, AHeightGivesTheStandardAtmosphere) {
  const Case given = parse_case(with_flow("speed_m_s = 12\nheight_m = 3000"), "case.toml");
  const Settings resolved = resolve(given);
  const StandardAir standard = standard_air(3000);
  EXPECT_EQ(resolved.flow().density_kg_m3, standard.density);
  EXPECT_EQ(resolved.flow().temperature_k, standard.temperature);
  EXPECT_EQ(resolved.flow().viscosity_pa_s, standard.viscosity);
  EXPECT_EQ(air(given).density, standard.density);
  EXPECT_NE(source_of(resolved, "flow.density_kg_m3").find("flow.height_m = 3000"), std::string::npos);
}

TEST(FlightKeys, TheResolvedCaseReadsBackWithItsHeight) {
  const Case given = parse_case(with_flow("speed_m_s = 12\nheight_m = 3000"), "case.toml");
  const std::string text = case_toml(resolve(given));
  EXPECT_NE(text.find("height_m = 3000"), std::string::npos);
  EXPECT_EQ(case_toml(resolve(parse_case(text, "again.toml"))), text);
}

TEST(FlightKeys, WithoutAHeightTheAirIsWhatItWas) {
  const Settings resolved = resolve(parse_case(valid_case, "case.toml"));
  EXPECT_EQ(resolved.flow().density_kg_m3, 1.199);
  EXPECT_EQ(resolved.flow().temperature_k, 293.15);
  EXPECT_EQ(resolved.flow().viscosity_pa_s, 1.84e-5);
}

TEST(FlightKeys, AHeightAndAnotherDensityOrTemperatureExcludeEachOther) {
  for (const char* key : {"density_kg_m3", "temperature_k"}) {
    const std::string value = key[0] == 'd' ? "1.2" : "290";
    const Outcome outcome =
        outcome_of(with_flow("speed_m_s = 12\nheight_m = 3000\n" + std::string(key) + " = " + value));
    ASSERT_EQ(outcome.problems.size(), 1u) << key << outcome.message;
    EXPECT_EQ(outcome.problems[0].key, std::string("flow.") + key);
    EXPECT_NE(outcome.message.find("remove flow.height_m = 3000"), std::string::npos) << outcome.message;
  }
  EXPECT_TRUE(outcome_of(with_flow("speed_m_s = 12\nheight_m = 3000\nviscosity_pa_s = 1.7e-5")).valid);
}

TEST(FlightKeys, AHeightThatTheAtmosphereHasNotIsTold) {
  const Outcome outcome = outcome_of(with_flow("speed_m_s = 12\nheight_m = 90000"));
  ASSERT_FALSE(outcome.valid);
  ASSERT_EQ(outcome.problems.size(), 1u) << outcome.message;
  EXPECT_EQ(outcome.problems[0].key, "flow.height_m");
}

TEST(FlightKeys, APayloadStandsInPlaceOfTheSpeed) {
  const Case given = parse_case(with_flow("height_m = 0") + "[payload]\nmass_kg = 4\n", "case.toml");
  const Settings resolved = resolve(given);
  const double drag = 0.5 * 1.225 * resolved.flow().speed_m_s * resolved.flow().speed_m_s * 0.55 *
                      nominal_area(given.parachute);
  EXPECT_NEAR(drag / (4 * standard_gravity), 1, 1e-4);  // 0.55: the middle of the family's range
  EXPECT_GT(suspended_weight(resolve(given), 4), 4 * standard_gravity);
  EXPECT_TRUE(outcome_of(case_toml(resolve(given))).valid);
}

TEST(FlightKeys, NeitherSpeedNorPayloadIsToldWithBothWaysOut) {
  const Outcome outcome = outcome_of(with_flow("height_m = 0"));
  ASSERT_EQ(outcome.problems.size(), 1u) << outcome.message;
  EXPECT_EQ(outcome.problems[0].key, "flow.speed_m_s");
  EXPECT_NE(outcome.message.find("[payload]"), std::string::npos);
}

TEST(FlightKeys, APayloadNeedsAirAndAMassAboveZero) {
  EXPECT_EQ(outcome_of(with_flow("ranks = 1") + "[payload]\nmass_kg = 4\n").problems.at(0).key,
            "flow.height_m");
  const Outcome negative = outcome_of(with_flow("height_m = 0") + "[payload]\nmass_kg = -4\n");
  ASSERT_FALSE(negative.valid);
  EXPECT_EQ(negative.problems.at(0).key, "payload.mass_kg");
  EXPECT_NE(negative.message.find("must be above 0"), std::string::npos) << negative.message;
  EXPECT_EQ(outcome_of(with_flow("speed_basis = \"measured\"\nheight_m = 0") + "[payload]\nmass_kg = 4\n")
                .problems.at(0)
                .key,
            "flow.speed_basis");
}

TEST(FlightKeys, FactorsOfTheMarginsHaveRanges) {
  EXPECT_TRUE(outcome_of(valid_case + "[margins]\nsafety_factor = 2\nseam_efficiency = 0.7\n").valid);
  EXPECT_EQ(outcome_of(valid_case + "[margins]\nseam_efficiency = 1.2\n").problems.at(0).key,
            "margins.seam_efficiency");
  EXPECT_EQ(outcome_of(valid_case + "[margins]\nsafety_factor = 0.5\n").problems.at(0).key,
            "margins.safety_factor");
}

}  // namespace
}  // namespace ripstop
