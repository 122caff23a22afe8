// ripstop sweep as a user runs it, killed and started again.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "program.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class Sweep : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> command(const std::string& out, const std::string& vary) const {
    return {"sweep",    std::string(RIPSTOP_SOURCE_DIR) + "/examples/stratos-iv/case.toml",
            "--set",    "parachute.mesh.cloth_nodes=1500",
            "--grid",   "24,24,36",
            "--speeds", "10,20",
            "--vary",   vary,
            "--out",    (folder_ / out).string()};
  }
  // sweep.csv without the wall times, which are this machine's mood.
  std::string table(const std::string& out) const {
    std::istringstream lines(read_file(folder_ / out / "sweep.csv"));
    std::string line, kept;
    std::size_t wall_time = 0;
    while (std::getline(lines, line)) {
      std::istringstream fields(line);
      std::string field;
      for (std::size_t i = 0; std::getline(fields, field, ','); ++i) {
        if (field == "wall_time_s") wall_time = i;
        if (i != wall_time) kept += field + ",";
      }
      kept += "\n";
    }
    return kept;
  }

  fs::path folder_ = fs::temp_directory_path() / ("ripstop_sweep_test_" + std::to_string(getpid()));
};

TEST_F(Sweep, ThatIsKilledAndStartedAgainGivesTheSameTable) {
  const std::string vary = "materials.f-111.forchheimer_1_m=30,45";
  ASSERT_EQ(wait_for(start(command("whole", vary))), 0);
  const std::string whole = table("whole");
  EXPECT_NE(whole.find("converged"), std::string::npos);
  EXPECT_EQ(whole.find("failed"), std::string::npos) << whole;
  for (const char* file : {"drag.svg", "drag.png", "drag_area.svg", "drag_coefficient.png", "diameters.svg"})
    EXPECT_TRUE(fs::exists(folder_ / "whole" / file)) << file;

  // Once as soon as the first run is there, with its neighbours in the middle of theirs.
  const pid_t child = start(command("killed", vary));
  while (!fs::exists(folder_ / "killed" / "sweep.csv")) {
    ASSERT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "ended before its first run";
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  kill(child, SIGKILL);
  wait_for(child);
  EXPECT_NE(table("killed"), whole);
  ASSERT_EQ(wait_for(start(command("killed", vary))), 0);
  EXPECT_EQ(table("killed"), whole);

  // Its folders hold runs of other inputs now: refused, and the table stays.
  std::vector<std::string> other = command("killed", vary);
  other.insert(other.end(), {"--set", "flow.residual=1e-4"});
  EXPECT_EQ(wait_for(start(other)), 2);
  EXPECT_EQ(table("killed"), whole);
}

TEST_F(Sweep, OfAKeyThatDoesNotExistRunsNothing) {
  EXPECT_EQ(wait_for(start(command("typo", "materials.f-111.darci=60,70"))), 2);
  EXPECT_FALSE(fs::exists(folder_ / "typo"));
}

}  // namespace
}  // namespace ripstop
