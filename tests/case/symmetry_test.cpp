// The part of the flow domain that a steady run solves: flow.symmetry.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cost.h"
#include "ripstop/case/summary.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/engines.h"

namespace ripstop {
namespace {

Settings mirrored_canopy(std::vector<Setting> set) {
  Overrides overrides;
  overrides.set = std::move(set);
  overrides.set.push_back({"parachute.mesh.cloth_nodes", "1500"});
  return resolve(
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml", overrides));
}

std::string full_because(std::vector<Setting> set) {
  set.insert(set.begin(), {"flow.symmetry", "auto"});
  const SteadyProblem problem = steady_problem(mirrored_canopy(std::move(set)));
  EXPECT_EQ(problem.flow.quarter, problem.full_box_because.empty());
  return problem.full_box_because;
}

const Setting nine_gores{"parachute.gores", "9"}, nine_lines{"parachute.lines.count", "9"},
    no_vent_lines{"parachute.vent_lines", "false"};

TEST(Symmetry, AutoSolvesAQuarterWhereCanopyCellsAndStreamAreMirrored) {
  EXPECT_EQ(full_because({}), "");
  EXPECT_TRUE(steady_problem(mirrored_canopy({})).flow.quarter) << "auto is the default";
  EXPECT_EQ(full_because({{"flow.symmetry", "quarter"}}), "");
  EXPECT_EQ(full_because({{"flow.symmetry", "full"}}), "flow.symmetry is \"full\"");
  EXPECT_EQ(full_because({nine_gores, nine_lines, no_vent_lines}), "the number of gores is odd (9)");
  EXPECT_EQ(full_because({{"flow.cells", "[81, 80, 98]"}}),
            "the number of cells across the stream is odd (81)");
  EXPECT_EQ(full_because({{"flow.unsteady", "true"}}), "the flow is unsteady");
  EXPECT_EQ(full_because({{"flow.porosity_model", "paper"}}),
            "the \"paper\" model is compared with the full domain of its source");
  EXPECT_EQ(full_because({{"flow.porosity_model", "paper"}, {"flow.symmetry", "quarter"}}), "");
  EXPECT_EQ(full_because({{"flow.core.off_axis", "0.25"}}),
            "the cells are not symmetric about the canopy axis");
}

TEST(Symmetry, AutoSolvesTheFullDomainOnCoarseCellsAndInAnOpenJet) {
  const Setting coarse{"flow.cells", "[40, 40, 50]"}, fine{"flow.cells", "[64, 64, 78]"};
  const Setting quarter{"flow.symmetry", "quarter"};
  EXPECT_EQ(full_because({coarse}), "there are 10.0 flow cells across the canopy, fewer than 16");
  EXPECT_EQ(full_because({coarse, quarter}), "");
  EXPECT_EQ(full_because({fine}), "");
  const Setting jet{"flow.tunnel.kind", "open-jet"}, width{"flow.tunnel.width_m", "3"};
  EXPECT_EQ(full_because({jet, width}), "the stream is an open jet");
}

TEST(Symmetry, AutoSolvesTheFullDomainOfACross) {
  const Settings cross =
      resolve(read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/cross/case.toml", {}));
  EXPECT_EQ(steady_problem(cross).full_box_because, "the cloth of a cross wrinkles without symmetry");
}

// One of the three canopies is its own mirror image, the cluster is not.
TEST(Symmetry, TheEstimateForAClusterOfThreeIsThatOfTheFullDomain) {
  const Settings three = resolve(
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/cluster-of-three/case.toml", {}));
  EXPECT_NE(steady_problem(three).full_box_because, "");
  EXPECT_EQ(summarize(three).memory, cost_of(three, false).memory);
}

TEST(Symmetry, OpenFoamSolvesAQuarterExceptOnCellsFittedToTheCloth) {
  const Setting engine{"flow.engine", "openfoam"};
  EXPECT_EQ(full_because({engine}), "");
  EXPECT_EQ(full_because({engine, {"flow.symmetry", "quarter"}}), "");
  EXPECT_EQ(full_because({engine, {"flow.mesh", "fitted"}}), "the cells are fitted to the cloth");
}

TEST(Symmetry, AnEngineWithoutPlanesOfSymmetrySolvesTheFullDomain) {
  EngineRecord without = engine_of("openfoam");
  without.word = "without-mirrors", without.can.quarters = false;
  add_engine(without);
  const Setting engine{"flow.engine", without.word};
  EXPECT_EQ(full_because({engine}), "the flow engine \"without-mirrors\" has no planes of symmetry");
  EXPECT_THROW(mirrored_canopy({engine, {"flow.symmetry", "quarter"}}), Error);
}

TEST(Symmetry, AQuarterIsRefusedWithTheReason) {
  const auto refusal = [](std::vector<Setting> set) -> std::string {
    set.push_back({"flow.symmetry", "quarter"});
    try {
      steady_problem(mirrored_canopy(std::move(set)));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal({nine_gores, nine_lines, no_vent_lines}),
            "flow.symmetry = \"quarter\": not possible, because the number of gores is odd (9); set it to "
            "\"auto\" or \"full\"");
  EXPECT_NE(refusal({{"flow.cells", "[80, 81, 98]"}}).find("odd (81)"), std::string::npos);
  EXPECT_NE(refusal({{"flow.unsteady", "true"}}).find("the flow is unsteady"), std::string::npos);
}

}  // namespace
}  // namespace ripstop
