// A flow engine is added by the list of CONTRIBUTING: an implementation of Flow, and one row of the table. It
// is then a word of the case file, refused where it does not support the case, and used.
#include <gtest/gtest.h>

#include <filesystem>

#include "ripstop/core/toml/problem.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/steady/steady.h"
#include "tests/run/steady/formula_flow.h"

namespace ripstop {
namespace {

class NewEngine : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    add_engine({"formula",
                "a formula of the cells that the canopy cuts",
                {},
                [](const EngineOptions&) { return std::string("formula 1"); },
                [](const EngineOptions&) { return std::make_unique<FormulaEngine>(); }});
  }
  static Case stratos(std::vector<Setting> more = {}) {
    Overrides overrides;
    overrides.engine = "formula";
    overrides.grid = {20, 20, 30};
    overrides.set = std::move(more);
    overrides.set.push_back({"parachute.mesh.cloth_nodes", "800"});
    return read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml", overrides);
  }
};

TEST_F(NewEngine, IsAWordOfTheCaseFileItsSchemaAndItsReference) {
  EXPECT_EQ(engine_of(resolve(stratos())).word, "formula");
  EXPECT_NE(case_toml(resolve(stratos())).find("engine = \"formula\""), std::string::npos);
  EXPECT_NE(case_schema().find("\"formula\""), std::string::npos);
  EXPECT_NE(case_reference().find("a formula of the cells"), std::string::npos);
}

TEST_F(NewEngine, FliesACase) {
  SteadyObserver nobody;
  const SteadySolution solution = run_steady(stratos(), nobody);
  EXPECT_TRUE(solution.result.converged);
  EXPECT_NEAR(solution.result.drag, 0.05 * solution.result.last.cut_cells * solution.result.speed,
              1e-3 * solution.result.drag);
}

TEST_F(NewEngine, RefusesUnsupportedFeaturesBeforeAnyComputation) {
  for (const auto& [key, value] :
       {std::pair{"flow.sides", "entraining"}, std::pair{"flow.average_over", "20"},
        std::pair{"flow.ranks", "2"}, std::pair{"flow.outlet", "still-air"}}) {
    try {
      stratos({{key, value}});
      ADD_FAILURE() << key << " accepted";
    } catch (const InputError& error) {
      ASSERT_EQ(error.problems().size(), 1u);
      EXPECT_EQ(error.problems()[0].key, key);
      EXPECT_NE(error.problems()[0].message.find("formula"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace ripstop
