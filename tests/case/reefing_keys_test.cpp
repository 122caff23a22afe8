// [[inflation.reefing]]: stages in order, lines that hold something, materials of their own.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "fixture.h"
#include "ripstop/case/opening.h"

namespace ripstop {
namespace {

std::string with_stages(const std::string& stages) {
  return short_case + "[inflation]\ninitial_radius_m = 0.2\npressure_pa = 200\n" + stages;
}

std::string stage(double line, double cut, const std::string& more = "") {
  return fmt::format("[[inflation.reefing]]\nline_m = {}\ncut_s = {}\n{}", line, cut, more);
}

TEST(ReefingKeys, AreReadInOrderAndReadBackAsWritten) {
  const Case given = parse_case(
      with_stages(stage(3, 0.2) + stage(5, 0.5, "material = \"nylon-line-type-iii\"\n")), "case.toml");
  ASSERT_EQ(given.inflation.reefing.size(), 2u);
  EXPECT_EQ(given.inflation.reefing[0].line_m, 3);
  EXPECT_EQ(given.inflation.reefing[1].cut_s, 0.5);
  EXPECT_EQ(reefing_line(given, given.inflation.reefing[0]).name, "spectra-line");
  EXPECT_EQ(reefing_line(given, given.inflation.reefing[1]).name, "nylon-line-type-iii");
  const std::string text = case_toml(resolve(given));
  EXPECT_EQ(case_toml(resolve(parse_case(text, "again.toml"))), text);
}

TEST(ReefingKeys, TheOpeningTakesLengthCutAndCurveOfEveryStage) {
  Case given = parse_case(with_stages(stage(3, 0.2, "material = \"nylon-line-type-iii\"\n")), "case.toml");
  given.parachute.mesh.cloth_nodes = 800;
  const Case opening = opening_case(given);
  const InflationProblem problem = opening_problem(resolve(opening), load_source(resolve(opening)), 1);
  ASSERT_EQ(problem.reefing.size(), 1u);
  EXPECT_EQ(problem.reefing[0].length, 3);
  EXPECT_EQ(problem.reefing[0].cut, 0.2);
  EXPECT_EQ(problem.reefing[0].law.tension(0.1), 815.5);
  EXPECT_EQ(problem.reefing[0].law.tension(-0.1), 0);
}

TEST(ReefingKeys, WhatDoesNotFitIsToldWithItsKey) {
  const auto key_of = [](const std::string& stages) {
    const Outcome outcome = outcome_of(with_stages(stages));
    EXPECT_EQ(outcome.problems.size(), 1u) << outcome.message;
    return outcome.problems.empty() ? std::string() : outcome.problems[0].key;
  };
  EXPECT_EQ(key_of(stage(3, 0.5) + stage(5, 0.5)), "inflation.reefing[1].cut_s");
  EXPECT_EQ(key_of(stage(3, 0.2) + stage(3, 0.5)), "inflation.reefing[1].line_m");
  EXPECT_EQ(key_of(stage(3, 0.2, "material = \"f-111\"\n")), "inflation.reefing[0].material");
  EXPECT_EQ(key_of(stage(0, 0.2)), "inflation.reefing[0].line_m");
  EXPECT_EQ(key_of(stage(3, 0.2, "lenght_m = 4\n")), "inflation.reefing[0].lenght_m");
  EXPECT_EQ(key_of("[[inflation.reefing]]\nline_m = 3\n"), "inflation.reefing[0].cut_s");
}

TEST(ReefingKeys, ALineLongerThanTheSkirtIsRefusedWithTheSkirtsCircumference) {
  const Case given = parse_case(with_stages(""), "case.toml");
  const double round = skirt_circumference(given.parachute);
  EXPECT_NEAR(round, 3 * std::numbers::pi, 0.03 * round);
  EXPECT_TRUE(outcome_of(with_stages(stage(0.99 * round, 0.2))).valid);
  const Outcome outcome = outcome_of(with_stages(stage(1.01 * round, 0.2)));
  ASSERT_EQ(outcome.problems.size(), 1u) << outcome.message;
  EXPECT_EQ(outcome.problems[0].key, "inflation.reefing[0].line_m");
  EXPECT_NE(outcome.message.find("does not reef it"), std::string::npos);
}

}  // namespace
}  // namespace ripstop
