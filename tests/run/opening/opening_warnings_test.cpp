// Time and warnings of an opening before it is computed, and the message of one that diverges.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../../refusal.h"
#include "../../small_case.h"
#include "ripstop/case/opening.h"
#include "ripstop/case/payload.h"
#include "ripstop/fsi/opening.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/quality.h"

namespace ripstop {
namespace {

// The estimate of --check: cloth predicted and corrected, and steps of the air in all its cells.
TEST(OpeningWarnings, TheTimeOfACoupledInflationCountsTheFlowAndItsCellsAreCheckedFirst) {
  Case given = small_opening_in_air();
  given.flow.cells = {18, 18, 27};
  const Settings resolved = resolve(opening_case(given));
  const LoadSource source = load_source(resolved);
  const auto solver = make_opening(with_engine(resolved, opening_problem(resolved, source, 1)));
  const InflationState start = solver->start();
  const double cloth =
      solver->problem().settings.duration_s / start.step * solver->mesh().node_count() / 1.25e8;
  EXPECT_GT(opening_seconds(*solver, start), 2 * cloth);
  EXPECT_LT(cells_across(resolved), 10);
  const std::vector<std::string> warnings = opening_warnings(resolved, *solver);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("number of flow cells across the inflated canopy"), std::string::npos);
}

TEST(OpeningWarnings, AnOpeningAtTheRateOfDescentIsWarnedOf) {
  Case given = small_opening_in_air();
  given.payload.mass_kg = 2, given.flow.density_kg_m3 = 1.2;
  for (const double share : {1.2, 3.0}) {
    given.flow.speed_m_s = share * payload_first_speed(given, 1.2);
    const Settings resolved = resolve(opening_case(given));
    const InflationProblem problem = opening_problem(resolved, load_source(resolved), 1);
    const auto solver = make_opening(with_engine(resolved, problem));
    EXPECT_EQ(opening_warnings(resolved, *solver).size(), share < 1.5 ? 1u : 0u);
  }
}

/// Makes the motion of the cloth diverge in the first block.
struct DivergingStart : InflationObserver {
  std::vector<std::string> warnings;
  void warned(const std::string& text) override { warnings.push_back(text); }
  void begin(const Opening&, InflationState& state, InflationHistory&) override {
    state.cloth.v[state.cloth.v.size() / 2] = NAN;
  }
};

TEST(OpeningWarnings, OnlyCoarseCellsAreTheProbableCauseOfADivergence) {
  Case given = small_opening_in_air();
  given.payload.mass_kg = 2, given.flow.density_kg_m3 = 1.2;
  given.flow.speed_m_s = 1.2 * payload_first_speed(given, 1.2);  // also warned of
  for (const bool coarse : {false, true}) {
    if (coarse) given.flow.cells = {18, 18, 27};
    const Settings resolved = resolve(opening_case(given));
    const LoadSource source = load_source(resolved);
    DivergingStart diverging;
    const std::string message =
        refusal_of([&] { run_inflation(resolved, source, opening_problem(resolved, source, 1), diverging); },
                   ExitCode::diverged);
    ASSERT_EQ(diverging.warnings.size(), coarse ? 2u : 1u);
    EXPECT_NE(diverging.warnings[0].find("rate of descent"), std::string::npos);
    EXPECT_EQ(message.find("rate of descent"), std::string::npos) << message;
    EXPECT_EQ(message.find("; the probable cause is the number of flow cells across") != std::string::npos,
              coarse)
        << message;
  }
}

}  // namespace
}  // namespace ripstop
