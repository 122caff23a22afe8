// ripstop compare and ripstop photogrammetry on a small case.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(Compare, SplitsTheDifferenceOfTheLinearModelAndItsRunsServePhotogrammetry) {
  const fs::path folder = fs::temp_directory_path() / ("ripstop_compare_test_" + std::to_string(getpid()));
  const std::string source = RIPSTOP_SOURCE_DIR;
  ASSERT_EQ(wait_for(start({"compare", source + "/examples/stratos-iv/case.toml", "--linear", "--speed", "30",
                            "--grid", "24,24,36", "--set", "parachute.mesh.cloth_nodes=1500", "--out",
                            (folder / "compare").string()})),
            0);
  const json result = json::parse(read_file(folder / "compare/result.json"));
  ASSERT_EQ(result.at("models").size(), 5u);
  EXPECT_EQ(result.at("models")[0].at("drag_difference"), 0);
  double together = 0;  // of all materials, minus the sum of each alone
  for (std::size_t i = 1; i < 5; ++i)
    together += (i == 1 ? 1 : -1) * (result.at("models")[i].at("drag_n").get<double>() -
                                     result.at("models")[0].at("drag_n").get<double>());
  EXPECT_NEAR(result.at("beyond_sum_n").get<double>(), together, 1e-9);
  // K_2 of the published tape is positive: without it the tape is softer and stretches more.
  const auto tape = [&](int k) {
    return result.at("models")[k].at("strain").at("tape").at("mean").get<double>();
  };
  EXPECT_GT(tape(4), tape(0));
  EXPECT_GT(read_csv(folder / "compare/profile.csv").rows.size(), 20u);

  ASSERT_EQ(
      wait_for(start({"photogrammetry", source + "/validation/ojf/stratos-iv-images.toml", "--run",
                      (folder / "compare/model=nonlinear").string(), "--out", (folder / "images").string()})),
      0);
  const json images = json::parse(read_file(folder / "images/result.json"));
  EXPECT_NEAR(images.at("camera_distance_m").get<double>(), 3.79, 0.1);
  for (const json& size : images.at("diameters"))
    EXPECT_NEAR(size.at("computed_m").get<double>(), 1.0, 0.1) << size.at("name");
  EXPECT_TRUE(fs::exists(folder / "images/profile.svg"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace ripstop
