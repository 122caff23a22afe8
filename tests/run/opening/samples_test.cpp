#include "ripstop/run/opening/samples.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "ripstop/case/opening.h"
#include "ripstop/core/error.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "tests/refusal.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

TEST(Samples, StatisticIsThatOfTheValuesThatAreThere) {
  const auto s = statistic_of({2.0, std::nullopt, 4.0, 9.0});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->openings, 3);
  EXPECT_DOUBLE_EQ(s->mean, 5);
  EXPECT_DOUBLE_EQ(s->standard_deviation, std::sqrt(13.0));
  EXPECT_EQ(s->lowest, 2);
  EXPECT_EQ(s->highest, 9);
  EXPECT_FALSE(statistic_of({std::nullopt}));
}

TEST(Samples, WarningsNameTheOpeningsThatHaveNotFilledOrMustNotBeUsed) {
  SampleSummary summary;
  summary.samples = 3, summary.folders = {"sample-001", "sample-002", "sample-003"};
  summarise_samples({R"({"peak_load_n": 10, "filling_time_s": 0.5, "filled": true, "usable": true})",
                     R"({"peak_load_n": 4, "filled": false, "usable": true})",
                     R"({"peak_load_n": 7, "filling_time_s": 0.3, "filled": true, "usable": false})"},
                    summary);
  EXPECT_EQ(summary.peak_load->openings, 3);
  EXPECT_EQ(summary.filling_time->openings, 2);
  EXPECT_DOUBLE_EQ(summary.filling_time->mean, 0.4);
  EXPECT_FALSE(summary.opening_force_coefficient);
  ASSERT_EQ(summary.warnings.size(), 2U);
  EXPECT_NE(summary.warnings[0].find("1 of 3 openings ended before the canopy had filled"),
            std::string::npos);
  EXPECT_NE(summary.warnings[0].find("sample-002"), std::string::npos);
  EXPECT_NE(summary.warnings[1].find("sample-003"), std::string::npos);
}

TEST(Samples, SeedPerturbsTheFoldsByAHundredthOfTheirRadius) {
  Case given = checked(flat_circular_case(2, 600, 10));
  given.inflation.initial_radius_m = 0.2;
  const Settings resolved = resolve(given);
  const Settings first = with_seed(resolved, 1), third = with_seed(resolved, 3);
  EXPECT_EQ(first.inflation().imperfection_seed, 1);
  EXPECT_EQ(third.inflation().imperfection_seed, 3);
  EXPECT_DOUBLE_EQ(first.inflation().imperfection_m, 0.002);
  EXPECT_EQ(resolved.inflation().imperfection_seed, 0);
}

// Without a cell centre between the layers of its folds the air passes as if there were no canopy.
TEST(CoupledStart, FoldsWithBothLayersBetweenTheSameCellCentresAreRefused) {
  Case given = small_payload_case(20);
  given.parachute.gores = given.parachute.lines.count = 8;
  given.inflation.air = AirModel::coupled, given.inflation.initial_radius_m = 0.108;
  const auto make = [&](std::array<int, 3> cells) {
    given.flow.cells = cells;
    const Settings resolved = resolve(opening_case(checked(given)));
    make_opening(with_engine(resolved, opening_problem(resolved, load_source(resolved), 1)));
  };
  const std::string message = refusal_of([&] { make({40, 40, 50}); }, ExitCode::usage);
  EXPECT_NE(message.find("do not resolve the 8 folds"), std::string::npos) << message;
  EXPECT_NO_THROW(make({64, 64, 80}));
}

}  // namespace
}  // namespace ripstop
