// The drag area of a computed opening over its way through the air, from a folder that a test wrote.
#include "ripstop/run/opening/opening_record.h"

#include <gtest/gtest.h>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/run_folder.h"
#include "tests/refusal.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

struct OpeningRecords : testing::Test {
  TemporaryFolder root{"opening-record"};
  Case given = checked(flat_circular_case(2, 600, 10));  // q = 60 Pa
  std::filesystem::path folder = root.path / "opened";

  void write(const CsvTable& history, double steady, const CsvTable* smooth = nullptr) {
    std::filesystem::remove_all(folder);
    const auto claimed = open_run_folder({folder}, resolve(given), "inflation", 1);
    write_csv(claimed->own("history.csv"), history);
    if (smooth) write_csv(claimed->own("history_low_pass.csv"), *smooth);
    write_file(claimed->own("result.json"), "{\"steady_load_n\": " + csv_number(steady) + "}");
    claimed->seal();
  }
  std::string refusal(ExitCode code, const Case& asked) const {
    return refusal_of([&] { opening_record(folder, resolve(asked)); }, code);
  }
};

const CsvTable opening_history{{"time_s", "load_mean_n", "load_largest_n"},
                               {{0.1, -6, 1}, {0.2, 30, 99}, {0.2, 500, 500}, {0.3, 120, 130}}};

TEST_F(OpeningRecords, IsLoadOverDynamicPressureOverTheWayAndGoesOnWithoutARepeatedTime) {
  write(opening_history, 90);
  const OpeningRecord record = opening_record(folder, resolve(given));
  ASSERT_EQ(record.distance.size(), 3u);
  const double way[] = {1, 2, 3}, area[] = {0, 0.5, 2};
  for (int i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(record.distance[i], way[i]);
    EXPECT_DOUBLE_EQ(record.drag_area[i], area[i]);
  }
  EXPECT_DOUBLE_EQ(record.steady_drag_area, 1.5);
}

TEST_F(OpeningRecords, TakesTheLowPassedLoadWhereThereIsOne) {
  const CsvTable smooth{{"time_s", "load_n"}, {{0.5, 60}}};
  write(opening_history, 90, &smooth);
  const OpeningRecord record = opening_record(folder, resolve(given));
  EXPECT_EQ(record.distance, std::vector<double>{5});
  EXPECT_EQ(record.drag_area, std::vector<double>{1});
}

TEST_F(OpeningRecords, OfAnotherParachuteOrWithoutALoadIsRefused) {
  write(opening_history, 90);
  const Case larger = checked(flat_circular_case(2.1, 600, 10));
  EXPECT_EQ(
      refusal(ExitCode::usage, larger),
      folder.string() + ": is an opening of another parachute: S0 is 3.14159 m2 there and 3.46361 m2 here");
  write(opening_history, 0);
  EXPECT_EQ(refusal(ExitCode::bad_data, given), folder.string() + ": its history has no load");
  write({opening_history.columns, {}}, 90);
  EXPECT_EQ(refusal(ExitCode::bad_data, given), folder.string() + ": its history has no load");
  folder = root.path / "nowhere";
  EXPECT_EQ(refusal(ExitCode::usage, given), folder.string() + ": holds no finished run of ripstop inflate");
}

}  // namespace
}  // namespace ripstop
