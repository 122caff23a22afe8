// The airspeed at which an opening begins, from keys and options of a case.
#include "ripstop/case/opening.h"

#include <gtest/gtest.h>

#include "../refusal.h"
#include "../small_case.h"
#include "fixture.h"
#include "ripstop/case/deployment.h"
#include "ripstop/case/flying.h"

namespace ripstop {
namespace {

/// As ripstop size writes a case: the rate of descent is flow.speed_m_s.
const std::string sized_case = short_case + R"([payload]
mass_kg = 40
deployment_speed_m_s = 20
)";

Settings opening_of(const std::string& text, const Overrides& overrides = {}) {
  return resolve(opening_case(parse_case(text, "case.toml", overrides)));
}

void expect_begins(const Settings& opening, double speed, const std::string& from) {
  EXPECT_EQ(opening.flow().speed_m_s, speed);
  EXPECT_EQ(opening_speed(opening).speed, speed);
  EXPECT_EQ(opening_speed(opening).from, from);
}

TEST(OpeningSpeed, IsTheDeploymentSpeedOfTheCaseUnlessAnOptionGivesAnother) {
  const std::string of_case = "payload.deployment_speed_m_s of the case";
  expect_begins(opening_of(sized_case), 20, of_case);
  expect_begins(opening_of(sized_case, {.set = {{"payload.deployment_speed_m_s", "25"}}}), 25, of_case);
  expect_begins(opening_of(sized_case, {.speed = 30}), 30, "flow.speed_m_s, given by --speed");
  expect_begins(opening_of(sized_case, {.set = {{"flow.speed_m_s", "30"}}}), 30,
                "flow.speed_m_s, given by --set");
  expect_begins(opening_of(short_case), 8, "flow.speed_m_s of the case");
  EXPECT_EQ(resolve(parse_case(sized_case, "case.toml")).flow().speed_m_s, 8);  // of a steady run
}

// case.toml of the run folder, which has no options.
TEST(OpeningSpeed, IsThatOfTheRunInItsCaseFile) {
  for (const Overrides& overrides : {Overrides{}, Overrides{.speed = 30}}) {
    const Settings opening = opening_of(sized_case, overrides);
    EXPECT_EQ(case_toml(opening_of(case_toml(opening))), case_toml(opening));
  }
}

TEST(OpeningSpeed, DoesNotChangeTheTapeOfTheCase) {
  const Settings sized = resolve(parse_case(sized_case, "case.toml"));
  for (const double speed : {10.0, 90.0}) {
    const Settings opening = opening_of(sized_case, {.speed = speed});
    EXPECT_EQ(opening.written().parachute.tape.material, sized.written().parachute.tape.material) << speed;
    EXPECT_EQ(opening.written().materials.size(), sized.written().materials.size());
  }
}

TEST(OpeningSpeed, IsAlsoThatOfTheUniformPressureAndOfTheStartOfADeployment) {
  const Settings uniform = opening_of(sized_case + "[inflation]\ndrag_coefficient = 0.8\n");
  EXPECT_NEAR(*load_source(uniform).steady_drag,
              0.8 * nominal_area(uniform.parachute()) * 0.5 * 1.2 * 20 * 20, 1e-9);
  const Settings deployed = opening_of(sized_case + "[inflation]\nair = \"coupled\"\n[deployment]\n");
  EXPECT_EQ(deployment_of(deployed)->phases.front().payload_speed, 20);
  Case flies = parse_case(sized_case, "case.toml");
  flies.flight.start = FlightSettings::Start::inflation;
  expect_begins(resolve(flight_case(flies)), 20, "payload.deployment_speed_m_s of the case");
}

TEST(OpeningSpeed, OfANominalSpeedKeepsTheDensityOfTheMeasuredRow) {
  const std::string measured = valid_case + "[payload]\ndeployment_speed_m_s = 30\n";
  const Settings opening = opening_of(
      replaced(measured, "speed_m_s = 20\nbox", "speed_m_s = 20\nspeed_basis = \"measured\"\nbox"));
  expect_begins(opening, 30, "payload.deployment_speed_m_s of the case");
  EXPECT_EQ(opening.flow().density_kg_m3, 1.199);
}

TEST(OpeningSpeed, IsRefusedAboveMach03AndWhereNothingGivesIt) {
  const auto refusal = [](const std::string& text, const Overrides& overrides) {
    return refusal_of([&] { opening_of(text, overrides); }, ExitCode::usage);
  };
  const std::string fast = refusal(sized_case, {.set = {{"payload.deployment_speed_m_s", "150"}}});
  for (const char* part : {"payload.deployment_speed_m_s = 150", "100 m/s", "--speed"})
    EXPECT_NE(fast.find(part), std::string::npos) << fast;
  const std::string none = refusal(replaced(sized_case, "deployment_speed_m_s = 20", ""),
                                   {.set = {{"flow.speed_m_s", "", "--unset", true}}});
  for (const char* part : {"--speed", "payload.deployment_speed_m_s"})
    EXPECT_NE(none.find(part), std::string::npos) << none;
}

}  // namespace
}  // namespace ripstop
