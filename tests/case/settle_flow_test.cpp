// What a case says of its flow without saying it: model, box and numerics from the cloth and the canopy.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fixture.h"
#include "ripstop/case/assemble.h"

namespace ripstop {
namespace {

const std::string short_case = R"(
[parachute]
type = "flat-circular"
nominal_diameter_m = 3.0
vent_diameter_m = 0.3
gores = 12
lines = { count = 12, length_m = 3.0 }
[flow]
speed_m_s = 8
density_kg_m3 = 1.2
)";

TEST(SettledFlow, OfAShortCaseIsASheetInABoxThatScalesWithTheCanopy) {
  const Case value = parse_case(short_case, "short");
  const FlowSettings& flow = value.flow;
  EXPECT_EQ(flow.porosity_model, PorosityModel::sheet);
  EXPECT_EQ(flow.sides, Sides::entraining);
  EXPECT_EQ(flow.convection, Convection::second_order);
  const double d = 0.7 * 3.0;
  EXPECT_NEAR(flow.box_m.x, 6 * d, 1e-9);
  EXPECT_NEAR(flow.box_m.z, 9 * d, 1e-9);
  EXPECT_NEAR(canopy_position(value), 4 * d, 1e-9);
  const FlowGrid grid = flow_grid(value);
  EXPECT_NEAR(grid.spacing().x / d, 0.04, 0.002);
  EXPECT_NEAR(grid.spacing().z / d, 0.04, 0.002);
  const FlowProblem problem = flow_problem(value);
  EXPECT_TRUE(problem.porous.empty());
  ASSERT_EQ(problem.sheets.size(), 1u);
  EXPECT_EQ(problem.sheets[0].linear, 8169.3);
}

TEST(SettledFlow, KeepsWhatTheCaseGives) {
  const Case value =
      parse_case(short_case + "box_m = [8, 8, 10]\nsides = \"slip\"\nresidual = 1e-4\n", "own box");
  EXPECT_EQ(value.flow.box_m.x, 8);
  EXPECT_EQ(value.flow.core.size_m.x, 0) << "a box of one's own has the cells of one's own";
  EXPECT_EQ(value.flow.sides, Sides::slip);
  EXPECT_EQ(value.flow.residual, 1e-4);
  EXPECT_EQ(value.flow.average_over, 60);
}

TEST(SettledFlow, OfClothWithCalibratedCoefficientsIsThePapers) {
  const Case value = parse_case(
      replaced(short_case, "gores = 12", "gores = 12\ncanopy_material = \"f-111\"") + "box_m = [8, 8, 10]\n",
      "paper");
  EXPECT_EQ(value.flow.porosity_model, PorosityModel::paper);
  EXPECT_EQ(value.flow.sides, Sides::zero_gradient);
  EXPECT_EQ(value.flow.residual, 1e-5);
  EXPECT_EQ(value.flow.average_over, 0);
  EXPECT_EQ(flow_problem(value).porous.size(), 1u);
}

TEST(SettledFlow, OfASheetIsRefusedForOpenFoamBeforeAnythingIsComputed) {
  try {
    parse_case(short_case + "engine = \"openfoam\"\n", "short");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    EXPECT_EQ(error.problems()[0].key, "flow.engine");
    EXPECT_NE(error.problems()[0].message.find("f-111-physical"), std::string::npos);
  }
}

TEST(SettledFlow, WhatOpenFoamHasNotIsRefusedWhenTheCaseIsRead) {
  const std::string paper = replaced(short_case, "gores = 12", "gores = 12\ncanopy_material = \"f-111\"") +
                            "engine = \"openfoam\"\n";
  parse_case(paper, "paper");
  for (const char* line : {"sides = \"entraining\"", "average_over = 20", "outlet = \"still-air\""}) {
    try {
      parse_case(paper + line + "\n", "paper");
      ADD_FAILURE() << line << " accepted";
    } catch (const InputError& error) {
      ASSERT_EQ(error.problems().size(), 1u);
      EXPECT_EQ(error.problems()[0].key, "flow." + std::string(line).substr(0, std::string(line).find(' ')));
    }
  }
}

TEST(SettledFlow, ReadsAgainAsItWasWritten) {
  const Case value = parse_case(short_case, "short");
  const Case again = parse_case(case_toml(value), "resolved");
  EXPECT_EQ(case_json(again), case_json(value));
}

TEST(SettledFlow, HoldsEveryFamilyOfTheExamples) {
  for (const char* name : {"flat-circular", "conical", "hemispherical", "quarter-spherical", "extended-skirt",
                           "ringslot", "cross", "elliptical"}) {
    const Case value = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / name /
                                 "case.toml");  // checks the box
    EXPECT_EQ(value.flow.porosity_model, PorosityModel::sheet) << name;
    EXPECT_EQ(value.flow.cells[0], 80) << name;
  }
}

}  // namespace
}  // namespace ripstop
