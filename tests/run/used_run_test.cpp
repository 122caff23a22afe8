// The end of a run, as commands take it over that use its numbers.
#include "ripstop/run/used_run.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/run/quality.h"
#include "tests/refusal.h"

namespace ripstop {
namespace {

using Texts = std::vector<std::string>;

TEST(UsedRun, ItsWarningsHaveItsNameBeforeThem) {
  const RunEnd end =
      end_of_run(R"({"warnings": ["one", "two"], "usable": true, "converged": true})", "runs/a");
  EXPECT_TRUE(end.usable);
  EXPECT_EQ(warnings_if_usable(end), (Texts{"runs/a: one", "runs/a: two"}));
  Texts own = {"two"};
  add_warnings_of(end, own);
  EXPECT_EQ(own, (Texts{"two", "runs/a: one"}));
}

TEST(UsedRun, BeyondALimitOrNotConvergedIsRefusedWithTheReasonAndMarkedWhereItIsShown) {
  const RunEnd beyond = end_of_run(
      R"({"warnings": ["coarse", "mass defect: 7 %; the result must not be used"], "usable": false})",
      "runs/b");
  const std::string refused = refusal_of([&] { warnings_if_usable(beyond); }, ExitCode::bad_data);
  EXPECT_NE(refused.find("runs/b: the result of this run must not be used"), std::string::npos) << refused;
  EXPECT_NE(refused.find("mass defect: 7 %"), std::string::npos) << refused;
  EXPECT_EQ(refused.find("coarse"), std::string::npos) << refused;
  ASSERT_EQ(beyond.warnings().size(), 3u);
  EXPECT_NE(beyond.warnings()[0].find("must not be used"), std::string::npos);
  const RunEnd open = end_of_run(R"({"converged": false})", "runs/c");
  EXPECT_NE(refusal_of([&] { warnings_if_usable(open); }, ExitCode::bad_data).find("has not converged"),
            std::string::npos);
}

TEST(UsedRun, TheReasonOfARefusalIsTheWarningBeyondItsLimit) {
  const Judgement judgement = judge({{"cells_across", 3}, {"energy_residual", 0.1}});
  ASSERT_EQ(judgement.warnings.size(), 2u);
  ASSERT_FALSE(judgement.usable);
  const RunEnd end{"runs/a", judgement.warnings, judgement.usable};
  const std::string refused = refusal_of([&] { warnings_if_usable(end); }, ExitCode::bad_data);
  EXPECT_NE(refused.find(without_refusal(judgement.warnings[0])), std::string::npos) << refused;
  EXPECT_EQ(refused.find(refused_text), refused.rfind(refused_text)) << refused;
  EXPECT_EQ(refused.find(judgement.warnings[1]), std::string::npos) << refused;
}

TEST(UsedRun, AnOpeningThatHasNotSettledIsWarnedOfUnlessItDeceleratesAPayload) {
  EXPECT_EQ(end_of_run(R"({"settled": false, "warnings": []})", "a").warnings().size(), 1u);
  EXPECT_TRUE(end_of_run(R"({"settled": false, "speed_at_end_m_s": 8.0})", "a").warnings().empty());
}

TEST(UsedRun, ASweepHasTheWarningsOfItsRunsOnceEach) {
  const RunEnd end = end_of_run(R"({"runs": [
      {"folder": "v=1", "result": {"warnings": ["coarse"], "usable": true}},
      {"folder": "v=2", "result": {"warnings": ["coarse", "fast"], "usable": false}},
      {"folder": "v=3", "status": "failed"}]})",
                                "runs/sweep");
  EXPECT_FALSE(end.usable);
  EXPECT_EQ(end.texts,
            (Texts{"all 2 runs: coarse", "v=2: the result must not be used (exit code 4)", "v=2: fast"}));
}

}  // namespace
}  // namespace ripstop
