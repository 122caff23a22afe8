// --json: the result alone on standard output, the same as result.json.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

using nlohmann::json;

class JsonOption : public testing::Test {
 protected:
  json result_of(std::vector<std::string> arguments, int code = 0) {
    const std::string out = (folder_.path / arguments.front()).string(), printed = out + ".stdout";
    arguments.insert(arguments.end(), {"--out", out, "--json"});
    EXPECT_EQ(wait_for(start(arguments, printed)), code) << arguments.front();
    const std::string text = read_file(printed);
    EXPECT_EQ(text, read_file(std::filesystem::path(out) / "result.json")) << arguments.front();
    return json::parse(text);
  }
  TemporaryFolder folder_{"json-option"};
};

TEST_F(JsonOption, OfFabricHasTheLoadsOfTheCloth) {
  const json r = result_of({"fabric", stratos, "--pressure", "240", "--set",
                            "parachute.mesh.cloth_nodes=1500", "--set", "coupling.threads=1"});
  EXPECT_TRUE(r.at("converged"));
  EXPECT_EQ(r.at("pressure_pa"), 240);
  EXPECT_NEAR(r.at("line_tension_n").get<double>() / r.at("pressure_load_n").get<double>(), 1, 1e-3);
  for (const char* key : {"projected_diameter_m", "max_line_tension_n", "max_von_mises_n_m"})
    EXPECT_GT(r.at(key), 0) << key;
}

TEST_F(JsonOption, OfCouponAndPatternHasTheRowsOfTheirTables) {
  const json coupon = result_of({"coupon", "f-111", "--strain", "0.1", "--points", "3", "--cells", "4"});
  ASSERT_EQ(coupon.at("points").size(), 3u);
  EXPECT_DOUBLE_EQ(coupon.at("points")[2].at("strain"), 0.1);
  EXPECT_GT(coupon.at("points")[2].at("load_n_per_m"), coupon.at("points")[1].at("load_n_per_m"));
  const json pattern = result_of({"pattern", stratos});
  EXPECT_NEAR(pattern.at("cloth_area_m2"), 1.7215, 1e-4);
  EXPECT_GT(pattern.at("bill").size(), 3u);
}

TEST_F(JsonOption, OfARunThatIsFinishedIsStillItsResult) {
  const std::vector<std::string> command = {"inflate",    stratos, "--pressure",    "500",
                                            "--duration", "0.002", "--cloth-nodes", "1000",
                                            "--threads",  "1"};
  // Such a short opening does not settle, and reports this both times.
  const json first = result_of(command, 4);
  EXPECT_GT(first.at("peak_load_n"), 0);
  EXPECT_FALSE(first.at("settled"));
  EXPECT_EQ(result_of(command, 4), first);
}

TEST_F(JsonOption, OfAnEquilibriumThatWasNotFoundComesWithItsExitCode) {
  const json r = result_of({"fabric", stratos, "--set", "parachute.mesh.cloth_nodes=500", "--set",
                            "coupling.threads=1", "--set", "coupling.cloth_tolerance=1e-16"},
                           4);
  EXPECT_FALSE(r.at("converged"));
}

}  // namespace
}  // namespace ripstop
