// A case made in code, without any file, is checked, resolved and reported like one that was read.
#include <gtest/gtest.h>

#include <algorithm>

#include "../small_case.h"
#include "fixture.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/opening.h"

namespace ripstop {
namespace {

Case made() {
  return flat_circular_case(3.0, 2000, 8);
}

const std::string written_case =
    replaced(short_case, "length_m = 3.0 }",
             "length_m = 3.0 }\ntape = { material = \"nylon-tape\" }\nmesh = { cloth_nodes = 2000 }");

std::vector<std::string> messages(const std::vector<Problem>& problems) {
  std::vector<std::string> texts;
  for (Problem problem : problems) {
    problem.origin = {};
    texts.push_back(to_text(problem));
  }
  std::sort(texts.begin(), texts.end());
  return texts;
}

TEST(MadeInCode, IsTheCaseThatAFileWithTheSameValuesIs) {
  EXPECT_TRUE(validate(made()).empty());
  const Case given = checked(made());
  EXPECT_EQ(case_json(resolve(given)), case_json(resolve(parse_case(written_case, "case.toml"))));
  EXPECT_EQ(steady_problem(resolve(given)).mesh.node_count(),
            steady_problem(resolve(parse_case(written_case, "case.toml"))).mesh.node_count());
}

TEST(MadeInCode, HasTheSameMistakesWithoutFileAndLine) {
  Case given = made();
  given.flow.speed_m_s = 200;
  given.flow.cells = {20, 20, 1};
  given.parachute.lines.length_m = 1;
  given.parachute.lines.material = "f-111";
  given.coupling.relaxation = 0;
  given.inflation.sheet_s.assign(13, 1);
  given.title = "two\nlines";
  std::string text = replaced(written_case, "speed_m_s = 8", "speed_m_s = 200\ncells = [20, 20, 1]");
  text = replaced(text, "length_m = 3.0 }", "length_m = 1.0, material = \"f-111\" }");
  text = "title = \"two\\nlines\"\n" + text + "[coupling]\nrelaxation = 0\n";
  std::vector<std::string> expected = messages(outcome_of(text).problems);
  EXPECT_EQ(expected.size(), 6u);
  expected.push_back(
      "inflation.sheet_s = [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1]: must have 0 to 12 numbers, not 13");
  std::sort(expected.begin(), expected.end());
  const std::vector<Problem> problems = validate(given);
  EXPECT_EQ(messages(problems), expected);
  for (const Problem& problem : problems)
    EXPECT_TRUE(problem.origin.file.empty() && problem.origin.line == 0);
  EXPECT_THROW(checked(given), InputError);
}

TEST(MadeInCode, EmptyLacksTheRequiredKeysOfEveryCase) {
  std::vector<std::string> keys;
  for (const Problem& problem : validate(Case{})) keys.push_back(problem.key);
  for (const char* key :
       {"parachute.gores", "parachute.lines.count", "parachute.disk_diameter_m", "flow.speed_m_s"})
    EXPECT_NE(std::find(keys.begin(), keys.end(), key), keys.end()) << key;
}

TEST(MadeInCode, AnEngineThatThereIsNotIsOneMistake) {
  Case given = made();
  given.flow.engine = "builtn";
  const std::vector<Problem> problems = validate(given);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "flow.engine");
  EXPECT_NE(problems[0].allowed.find("openfoam"), std::string::npos);
}

TEST(MadeInCode, AMaterialOfItsOwnComesBeforeTheLibrarys) {
  Case given = made();
  Fabric cloth = std::get<Fabric>(library_material("f-111-physical"));
  cloth.resistance = {100, 200, {}, {}, {}};
  given.materials["f-111-physical"] = cloth;
  EXPECT_EQ(flow_problem(resolve(checked(given))).bodies.at(0).drop().quadratic, 200);
}

TEST(Opening, IsMeshedToFoldWithTheSegmentsAndTheCompressionThatItGives) {
  Case given = made();
  given.inflation.line_segment_m = 0.1;
  given.inflation.cloth_compression = 0.25;
  const Case opening = opening_case(checked(given));
  EXPECT_FALSE(opening.parachute.mesh.sewn_straight);
  EXPECT_EQ(opening.parachute.mesh.folds, 12);
  EXPECT_EQ(opening.parachute.mesh.line_segment_m, 0.1);
  EXPECT_EQ(canopy_fabric(opening).compression, 0.25);
  EXPECT_EQ(reinforcement_tape(opening)->compression, 0.25);
  EXPECT_EQ(canopy_fabric(opening).buckling_strain, 1);
  EXPECT_EQ(reinforcement_tape(opening)->buckling_strain, 1);
  const Case plain = opening_case(checked(made()));
  EXPECT_EQ(plain.parachute.mesh.line_segment_m, made().parachute.mesh.line_segment_m);
  EXPECT_EQ(case_json(resolve(opening_case(opening))), case_json(resolve(opening)));
}

TEST(Opening, WrinklesUnlessAMaterialOrTheOpeningPreventsIt) {
  Case given = checked(made());
  std::get<Tape>(given.materials.at(*given.parachute.tape.material)).buckling_strain = 0.01;
  const Case opening = opening_case(given);
  EXPECT_EQ(canopy_fabric(opening).buckling_strain, wrinkling_strain);
  EXPECT_EQ(canopy_fabric(opening).compression, canopy_fabric(given).compression);
  EXPECT_EQ(reinforcement_tape(opening)->buckling_strain, 0.01);
}

TEST(Opening, OfCoupledAirDampsItsClothUnlessTheCaseGivesTheDamping) {
  Case given = checked(made());
  EXPECT_FALSE(opening_case(given).inflation.cloth_damping_s);
  given.inflation.air = AirModel::coupled;
  EXPECT_EQ(opening_case(given).inflation.cloth_damping_s, 1e-5);
  given.inflation.cloth_damping_s = 0;
  EXPECT_EQ(opening_case(given).inflation.cloth_damping_s, 0);
}

TEST(Opening, TakesItsPressureFromOneSource) {
  Case given = checked(made());
  EXPECT_THROW(load_source(resolve(given)), Error);
  given.inflation.drag_coefficient = 0.8;
  const double area = nominal_area(given.parachute);
  EXPECT_NEAR(*load_source(resolve(given)).steady_drag, 0.8 * area * 0.5 * 1.2 * 8 * 8, 1e-9);
  given.inflation.pressure_pa = 300;
  EXPECT_THROW(load_source(resolve(given)), Error);
  given.inflation.pressure_pa.reset();
  apply({.pressure = 250}, given);
  EXPECT_FALSE(load_source(resolve(given)).steady_drag);
  EXPECT_EQ(opening_problem(resolve(opening_case(given)), load_source(resolve(given)), 1).pressure, 250);
  EXPECT_THROW(apply({.pressure = -1}, given), InputError);
}

}  // namespace
}  // namespace ripstop
