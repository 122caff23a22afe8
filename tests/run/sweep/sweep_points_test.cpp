#include <gtest/gtest.h>

#include <set>

#include "ripstop/core/error.h"
#include "ripstop/run/steady/compare.h"
#include "ripstop/run/sweep/sweep.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

const std::filesystem::path stratos_case =
    std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml";

TEST(SweepPoints, AreEveryCombinationEachOneStepFromItsNeighbour) {
  const std::vector<SweepAxis> axes = {
      sweep_axis("flow.speed_m_s", {"10", "15", "20", "25", "30"}, "--speeds"),
      sweep_axis("materials.f-111.darcy_1_m2", {"50", "60"}, "--vary")};
  const std::vector<SweepPoint> points = sweep_points(stratos_case, {}, axes);
  ASSERT_EQ(points.size(), 10u);
  std::set<std::string> folders;
  int cold = 0;
  for (const SweepPoint& point : points) {
    folders.insert(point.folder);
    if (point.start < 0) {
      ++cold;
      EXPECT_EQ(point.values, (std::vector<std::string>{"20", "50"}));
      continue;
    }
    const SweepPoint& neighbour = points[point.start];
    const double step =
        std::abs(point.resolved.flow().nominal_speed_m_s - neighbour.resolved.flow().nominal_speed_m_s) / 5 +
        std::abs(as_cells(point.resolved.materials().canopy.resistance).darcy -
                 as_cells(neighbour.resolved.materials().canopy.resistance).darcy) /
            10;
    EXPECT_DOUBLE_EQ(step, 1) << point.folder;
    EXPECT_LE(std::abs(neighbour.resolved.flow().nominal_speed_m_s - 20),
              std::abs(point.resolved.flow().nominal_speed_m_s - 20));
  }
  EXPECT_EQ(cold, 1);
  EXPECT_EQ(folders.size(), 10u);
}

TEST(SweepPoints, TakeTheDensityOfTheirOwnSpeed) {
  const auto points =
      sweep_points(stratos_case, {}, {sweep_axis("flow.speed_m_s", {"10", "25"}, "--speeds")});
  EXPECT_DOUBLE_EQ(points[0].resolved.flow().density_kg_m3, 1.202);
  EXPECT_DOUBLE_EQ(points[1].resolved.flow().density_kg_m3, 1.204);
}

TEST(SweepPoints, WithAValueTwiceAreRefused) {
  EXPECT_THROW(sweep_points(stratos_case, {}, {sweep_axis("flow.speed_m_s", {"10", "10"}, "--speeds")}),
               Error);
}

TEST(SweepPoints, OfMoreThanTenThousandRunsAreRefusedBeforeTheyAreMade) {
  std::vector<std::string> many;
  for (int i = 0; i < 101; ++i) many.push_back(std::to_string(10 + i));
  std::vector<std::string> fewer(many.begin(), many.end() - 1);
  const auto axes = {sweep_axis("flow.speed_m_s", many, "--speeds"),
                     sweep_axis("flow.viscosity_ratio", fewer, "--vary")};
  try {
    sweep_points(stratos_case, {}, axes);
    FAIL() << "10100 runs were accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("10100 runs"), std::string::npos) << error.what();
  }
}

TEST(SweepPoints, OfOneFolderNameAreNumbered) {
  SweepAxis axis{"model", {"a b", "a-b", "a_b"}, {{}, {}, {}}};
  std::set<std::string> folders;
  const std::vector<SweepPoint> points = sweep_points(stratos_case, {}, {axis});
  for (const SweepPoint& point : points) folders.insert(point.folder);
  EXPECT_EQ(folders.size(), 3u);
  EXPECT_EQ(sweep_points(stratos_case, {}, {}).at(0).folder, "run");
  const auto two = sweep_points(
      stratos_case, {},
      {sweep_axis("flow.speed_m_s", {"10"}, ""), sweep_axis("materials.f-111.darcy_1_m2", {"50"}, "")});
  EXPECT_EQ(two.at(0).folder, "speed_m_s=10_darcy_1_m2=50");
}

TEST(SweepPoints, AsManyRunSideBySideAsCoresMemoryAndPointsAllow) {
  const auto points = sweep_points(stratos_case, {}, {sweep_axis("flow.speed_m_s", {"10", "20"}, "")});
  EXPECT_EQ(fitting_jobs({points[0]}), 1);
  EXPECT_GE(fitting_jobs(points), 1);
  EXPECT_LE(fitting_jobs(points), 2);
  std::vector<SweepPoint> large = points;
  large[1].resolved = edited(large[1].resolved, [](Case& given) {
    given.flow.cells = std::array{2000, 2000, 2000};
  });
  EXPECT_EQ(fitting_jobs(large), 1);
  std::vector<SweepPoint> wide = points;
  wide[0].resolved = edited(wide[0].resolved,
                            [](Case& given) { given.flow.engine = "openfoam", given.flow.ranks = 100000; });
  EXPECT_EQ(fitting_jobs(wide), 1);
}

TEST(SteadyResult, OfATextThatIsNoResultIsRefused) {
  EXPECT_THROW(steady_result_from_json("{}"), Error);
  EXPECT_THROW(steady_result_from_json("nonsense"), Error);
}

TEST(SteadyResult, ReturnsFromItsJsonWithoutAbsentValues) {
  SteadyResult result;
  result.title = "a \"quoted\" title";
  result.drag = 1.0 / 3;
  result.iterations = 7;
  result.converged = true;
  result.stress.place = {1, 2, 0.1};
  result.ledger.line_tension = 1e-300;
  result.measured = Measured{30, 29.5, 1.2, 400, {}, {}};
  const std::string json = to_json(result);
  EXPECT_EQ(to_json(steady_result_from_json(json)), json);
  EXPECT_NE(json.find("\"drag_n\": 0.3333333333333333"), std::string::npos) << json;
  EXPECT_EQ(json.find("known_drag_coefficient"), std::string::npos) << json;
  EXPECT_EQ(json.find("printed_linear_n"), std::string::npos) << json;
}

TEST(SweepPoints, OfLinearModelsEveryKindOfLineKeepsItsFirstCoefficientOnly) {
  Case given = read_case(stratos_case);
  Line riser = riser_line(given);
  riser.name = given.parachute.riser.material = "strap";
  riser.coefficients_n = {1000, 200, 30};
  given.materials.insert_or_assign(riser.name, riser);
  const SweepAxis models = linear_models(resolve(given));
  ASSERT_EQ(models.values[3], "linear lines");
  ASSERT_EQ(models.settings[3].size(), 2u);
  EXPECT_EQ(models.settings[3][1].key, "materials.strap.coefficients_n");
  EXPECT_EQ(models.settings[3][1].value, "[1000]");
}

}  // namespace
}  // namespace ripstop
