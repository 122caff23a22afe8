// Files of the calibration of the damping: a row and two points for each trial.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/opening/damping.h"
#include "tests/output/read_png.h"

namespace ripstop {
namespace {

DampingTrial trial(double damping, double peak, double target) {
  DampingTrial t;
  t.damping = damping;
  t.peak = t.every_step_peak = peak;
  t.misfit = std::abs(peak / target - 1);
  return t;
}

// The errors are 20, 10 and 5 % of the peak, once below it: both curves leave their middle in other directions.
TEST(DampingFiles, HaveEveryTrialInTheTableAndInThePicture) {
  DampingResult result;
  result.title = "Opened three times";
  result.target.peak = 500;
  result.found.trials = {trial(4, 600, 500), trial(8, 550, 500), trial(16, 475, 500)};
  result.found.best = result.found.trials.back();
  const TemporaryFolder root("damping");
  const std::filesystem::path folder = root.path / "made";
  write_damping(folder, result);
  const CsvTable table = read_csv(folder / "damping.csv");
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(nlohmann::json::parse(read_file(folder / "result.json")).at("damping_n_s_m3"), 16);
  const Png plot = read_png(folder / "misfit.png");
  for (const std::size_t series : {0, 1}) {
    int least = plot.width, most = 0;
    for (int y = 0; y < plot.height; ++y)
      for (int x = 0; x < plot.width; ++x)
        if (plot.shows(x, y, series_colour(series))) least = std::min(least, x), most = std::max(most, x);
    EXPECT_GT(most - least, plot.width / 2) << series;
  }
}

}  // namespace
}  // namespace ripstop
