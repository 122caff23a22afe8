// Numbers of finished runs side by side.
#include "ripstop/run/report/compare_runs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "tests/refusal.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

TEST(CompareRuns, ShowsEveryNumberOfBothAndTheDifferenceOfTheLastToTheFirst) {
  const TemporaryFolder root("compare-runs");
  const SteadyResult slow = fly_square_law(root.path / "slow", {{"flow.speed_m_s", "10"}}),
                     fast = fly_square_law(root.path / "fast", {{"flow.speed_m_s", "20"}});
  const RunComparison c = compare_runs({root.path / "slow", root.path / "fast"});
  EXPECT_EQ(c.titles, (std::vector<std::string>{slow.title, fast.title}));
  const auto number = [&](const std::string& key) -> const ComparedNumber* {
    for (const ComparedNumber& n : c.numbers)
      if (n.key == key) return &n;
    return nullptr;
  };
  ASSERT_TRUE(number("drag_n"));
  EXPECT_EQ(number("drag_n")->values, (std::vector<double>{slow.drag, fast.drag}));
  EXPECT_DOUBLE_EQ(*number("drag_n")->difference, fast.drag / slow.drag - 1);
  EXPECT_NEAR(*number("drag_n")->difference, 3, 0.05);  // with the square of the speed
  EXPECT_TRUE(number("projected_diameter_m"));
  EXPECT_FALSE(number("wall_time_s"));
  EXPECT_FALSE(number("title"));
  for (const ComparedNumber& n : c.numbers)  // rounding has no relative change
    if (n.difference) {
      EXPECT_GT(std::abs(n.values.front()), 1e-9) << n.key;
    }
}

TEST(CompareRuns, RefusesOneRunAndFoldersWithoutOne) {
  const TemporaryFolder root("compare-nothing");
  const auto refused = [&](const std::vector<std::filesystem::path>& folders) {
    return refusal_of([&] { compare_runs(folders); }, ExitCode::usage);
  };
  EXPECT_NE(refused({root.path}).find("two or more folders"), std::string::npos);
  EXPECT_NE(refused({root.path, root.path}).find("contains no finished run"), std::string::npos);
}

}  // namespace
}  // namespace ripstop
